//! Intelligent driver model (Treiber, Hennecke and Helbing 2000) along the lane route: speed limit and bends,
//! a leader that keeps its present speed, and a red signal that stays red.

use super::state;
use experts::planning::profile::Caps;
use experts::planning::world::{AgentAtStart, World};
use scene::routes::{Polyline, Route, SpeedRules, base_path, best_route_ahead, route_length_m, speed};
use scene::{HORIZON_STEPS, STEP_S, State};

/// Greatest acceleration, m/s2.
const ACCELERATION: f64 = 1.5;
/// Comfortable braking, m/s2.
const BRAKING: f64 = 2.0;
/// Desired time gap to the leader, seconds.
const TIME_GAP_S: f64 = 1.5;
/// Desired gap at standstill, metres.
const STANDING_GAP_M: f64 = 2.0;
/// Greatest deceleration, m/s2.
const HARDEST: f64 = 8.0;
/// A red signal that requires a greater deceleration is ignored, m/s2.
const TOO_LATE: f64 = 5.0;

/// Obstacle ahead: gap between the own front and its bumper now, metres, and its speed, m/s.
#[derive(Clone, Copy, Debug)]
struct Ahead {
    gap_m: f64,
    speed_mps: f64,
}

/// States at steps 1 ..= 90 of the agent with this index; `None` if it is absent or on no lane.
pub fn intelligent_driver(world: &World<'_>, agent: usize) -> Option<Vec<State>> {
    let who = world.present.iter().find(|p| p.index == agent)?;
    let v0 = world.model(who).start_speed_mps();
    let graph = &world.graph;
    // The present speed underestimates the distance of a driver who accelerates to the limit.
    let length = route_length_m(v0.max(15.0));
    let route = best_route_ahead(graph, who.pose(), who.agent_type, length)?;
    let path = base_path(&route.path, who.pose(), v0, who.agent_type, None);
    let caps = speed::speed_caps(&path, &limits(&path, &route), SpeedRules::default());
    let caps = Caps::new(path.arc_m(), &caps);
    let ahead = everything_ahead(world, who, &route, &path, v0);
    Some(drive(&path, v0, &caps, &ahead))
}

/// Speed limit at the path's points.
fn limits(path: &Polyline, route: &Route) -> Vec<f64> {
    let last = route.limits_mps.len().saturating_sub(1);
    let at = |s: &f64| route.limits_mps.get((*s as usize).min(last)).copied().unwrap_or(f64::INFINITY);
    path.arc_m().iter().map(at).collect()
}

fn everything_ahead(
    world: &World<'_>,
    who: &AgentAtStart,
    route: &Route,
    path: &Polyline,
    v0: f64,
) -> Vec<Ahead> {
    let length_m = who.size.length_m;
    let leader = speed::leader(path, length_m, &world.obstacles(who.index))
        .map(|l| Ahead { gap_m: l.gap_m, speed_mps: l.speed_mps });
    let light = speed::first_signal(route, &world.graph, &world.signals)
        .filter(|light| light.state.is_stop())
        .map(|light| light.distance_m - 0.5 * length_m)
        .filter(|gap| v0 * v0 / (2.0 * gap.max(0.1)) < TOO_LATE)
        // The model's gap at standstill is meant for bumpers, not for stop lines.
        .map(|gap| Ahead { gap_m: gap + STANDING_GAP_M, speed_mps: 0.0 });
    leader.into_iter().chain(light).collect()
}

fn drive(path: &Polyline, v0: f64, caps: &Caps<'_>, ahead: &[Ahead]) -> Vec<State> {
    let (mut s, mut v) = (0.0, v0);
    let mut out = Vec::with_capacity(HORIZON_STEPS);
    for step in 0..HORIZON_STEPS {
        let t = step as f64 * STEP_S;
        let hardest = ahead.iter().map(|a| {
            let gap = (a.gap_m + a.speed_mps * t - s).max(0.1);
            let closing = v * (v - a.speed_mps) / (2.0 * (ACCELERATION * BRAKING).sqrt());
            let wanted = STANDING_GAP_M + (v * TIME_GAP_S + closing).max(0.0);
            (wanted / gap).powi(2)
        });
        let interaction = hardest.fold(0.0, f64::max);
        let free = (v / caps.at(s).max(0.1)).powi(4);
        let rate = (ACCELERATION * (1.0 - free - interaction)).max(-HARDEST);
        let next = (v + rate * STEP_S).max(0.0);
        s += 0.5 * (v + next) * STEP_S;
        v = next;
        let pose = path.extrapolate(s);
        out.push(state(pose.position, pose.heading_rad, pose.direction() * v));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;

    fn road() -> Polyline {
        Polyline::new((0..400).map(|x| Vec2::new(f64::from(x), 0.0)))
    }

    #[test]
    fn alone_it_takes_up_the_limit_and_never_passes_it() {
        let caps = Caps::new(&[0.0], &[14.0]);
        let states = drive(&road(), 4.0, &caps, &[]);
        assert!(states.iter().all(|s| s.speed_mps() <= 14.0));
        assert!(states[89].speed_mps() > 12.0);
        assert!(states.windows(2).all(|w| w[1].x_m > w[0].x_m));
    }

    #[test]
    fn it_stops_at_the_line_and_behind_a_standing_leader() {
        let caps = Caps::new(&[0.0], &[14.0]);
        let line = Ahead { gap_m: 40.0 + STANDING_GAP_M, speed_mps: 0.0 };
        let states = drive(&road(), 10.0, &caps, &[line]);
        assert!(states[89].x_m < 40.2 && states[89].x_m > 35.0, "{}", states[89].x_m);
        let leader = Ahead { gap_m: 30.0, speed_mps: 0.0 };
        let states = drive(&road(), 8.0, &caps, &[leader]);
        assert!(states[89].x_m < 28.5 && states[89].speed_mps() < 0.5, "{}", states[89].x_m);
    }
}
