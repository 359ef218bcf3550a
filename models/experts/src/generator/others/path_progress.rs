//! The motion that an agent has without this call, as a path and the progress along it at each step.

use crate::planning::profile::{Caps, cruising, speed_at};
pub(super) use crate::tuning::fixed::path_progress::BEYOND_M;
use crate::tuning::fixed::path_progress::{HURRIED, LOOK_AHEAD_M, SETTING_OFF_MPS, TAKES_UP_MPS2};
use scene::geometry::obb::OrientedBox;
use scene::geometry::{direction, wrap_angle};
use scene::routes::{LaneGraph, Polyline, Pose, SpeedRules, base_path, best_route_ahead, speed};
use scene::{AgentType, HORIZON_STEPS, STEP_S, Size, State, Vec2};

/// States closer than this are one place of the path, metres, so that jitter at rest does not lengthen it.
const GRAIN_M: f64 = 0.3;
/// Longest gap in a recording that is bridged, steps.
const MOST_BRIDGED: usize = 10;
/// A place of the path.
#[derive(Clone, Copy, Debug)]
struct PathPlace {
    along_m: f64,
    position: Vec2,
    /// Unwrapped along the path.
    heading_rad: f64,
    speed_mps: f64,
}

/// A motion as a path with a progress.
#[derive(Clone, Debug)]
pub(super) struct PathProgress {
    /// Step after the window's start at which the agent is first present: 0 unless it enters later.
    pub(super) enters: usize,
    /// States from `enters` on, one per step.
    pub(super) states: Vec<State>,
    /// Metres along the path, one per state.
    pub(super) along_m: Vec<f64>,
    /// Places of the motion, and the road beyond them where it is known.
    places: Vec<PathPlace>,
    /// Number of places that belong to the motion.
    own: usize,
}

impl PathProgress {
    /// From the known states of an agent at each step of a window, start included. `None` if the agent never
    /// enters or hardly moves.
    pub(super) fn of(known: &[Option<State>], shortest_m: f64) -> Option<Self> {
        let enters = known.iter().position(Option::is_some)?;
        let states = bridged(&known[enters..]);
        let first = states.first()?;
        let place = |s: &State, along_m: f64, heading_rad: f64| PathPlace {
            along_m,
            position: s.position(),
            heading_rad,
            speed_mps: s.speed_mps(),
        };
        let mut places = vec![place(first, 0.0, first.heading_rad)];
        let mut along_m = Vec::with_capacity(states.len());
        let mut last = places[0];
        let mut most = 0.0_f64;
        for state in &states {
            let moved = (state.position() - last.position).norm();
            most = most.max(last.along_m + moved);
            along_m.push(most);
            if moved >= GRAIN_M {
                let heading = last.heading_rad + wrap_angle(state.heading_rad - last.heading_rad);
                last = place(state, last.along_m + moved, heading);
                most = last.along_m;
                places.push(last);
                if let Some(end) = along_m.last_mut() {
                    *end = most;
                }
            }
        }
        let own = places.len();
        (last.along_m >= shortest_m).then_some(Self { enters, states, along_m, places, own })
    }

    /// The same with the likeliest continuation of the road, because an agent that speeds up gets beyond its
    /// own path.
    pub(super) fn extended(mut self, graph: &LaneGraph, agent_type: AgentType) -> Self {
        let (Some(end), Some(last)) = (self.states.last().copied(), self.places.last().copied()) else {
            return self;
        };
        if agent_type == AgentType::Pedestrian {
            return self;
        }
        let speed_mps = end.speed_mps();
        let length_m = BEYOND_M + HURRIED * HORIZON_STEPS as f64 * STEP_S * speed_mps;
        let Some(path) = road_ahead(&end, graph, agent_type, length_m) else { return self };
        let end_m = last.along_m + (end.position() - last.position).norm();
        let mut heading_rad = last.heading_rad;
        self.places.extend((1..=path.length_m() as usize).map(|at| {
            let pose = path.sample(at as f64);
            heading_rad += wrap_angle(pose.heading_rad - heading_rad);
            PathPlace { along_m: end_m + at as f64, position: pose.position, heading_rad, speed_mps }
        }));
        self
    }

    /// Last step after the window's start at which the agent is present.
    pub(super) fn last_step(&self) -> usize {
        self.enters + self.states.len() - 1
    }

    /// Progress at a step of the window, clamped outside its own steps. After the window it continues at the
    /// last speed.
    pub(super) fn along_at(&self, step: usize) -> f64 {
        let last = self.along_m.len() - 1;
        let i = step.saturating_sub(self.enters).min(last);
        let beyond_s = step.saturating_sub(HORIZON_STEPS) as f64 * STEP_S;
        self.along_m[i] + beyond_s * self.states[last].speed_mps()
    }

    /// Length of the motion's path, metres.
    pub(super) fn length_m(&self) -> f64 {
        self.own.checked_sub(1).map_or(0.0, |last| self.places[last].along_m)
    }

    /// Whether the agent leaves before the window ends.
    pub(super) fn leaves(&self) -> bool {
        self.last_step() < HORIZON_STEPS
    }

    fn index(&self, along_m: f64) -> usize {
        self.places.partition_point(|p| p.along_m <= along_m).clamp(1, self.places.len().max(2) - 1)
    }

    /// Box centre and heading at a progress; straight on beyond the path's end.
    fn place(&self, along_m: f64) -> (Vec2, f64) {
        let i = self.index(along_m);
        let (Some(from), Some(to)) = (self.places.get(i - 1), self.places.get(i)) else {
            return self.places.first().map_or((Vec2::zeros(), 0.0), |p| (p.position, p.heading_rad));
        };
        let share = (along_m - from.along_m) / (to.along_m - from.along_m).max(1e-9);
        let heading = from.heading_rad + share.min(1.0) * (to.heading_rad - from.heading_rad);
        (from.position + share * (to.position - from.position), heading)
    }

    /// Its box at a progress.
    pub(super) fn outline(&self, along_m: f64, size: &Size) -> OrientedBox {
        let (position, heading) = self.place(along_m);
        OrientedBox::new(position, 0.5 * size.length_m, 0.5 * size.width_m, heading)
    }

    /// State at a progress and speed.
    pub(super) fn state(&self, along_m: f64, speed_mps: f64) -> State {
        let (position, heading) = self.place(along_m);
        let chord = self.place(along_m + GRAIN_M).0 - self.place((along_m - GRAIN_M).max(0.0)).0;
        let ahead = if chord.norm() > 1e-6 { chord.normalize() } else { direction(heading) };
        let velocity = ahead * speed_mps;
        State {
            x_m: position.x,
            y_m: position.y,
            heading_rad: wrap_angle(heading),
            vx_mps: velocity.x,
            vy_mps: velocity.y,
        }
    }

    /// Speed at a place of its path. At a place where the agent stood: the speed with which it continued from
    /// there.
    pub(super) fn speed_at_mps(&self, along_m: f64) -> f64 {
        let i = self.places.partition_point(|p| p.along_m <= along_m).saturating_sub(1);
        let own = self.places[i].speed_mps;
        if own >= SETTING_OFF_MPS {
            return own;
        }
        let near = self.places[i..].iter().take_while(|p| p.along_m <= along_m + LOOK_AHEAD_M);
        near.map(|p| p.speed_mps).fold(own, f64::max)
    }

    /// The first step at which it has reached this progress.
    pub(super) fn step_at(&self, along_m: f64) -> Option<usize> {
        let i = self.along_m.iter().position(|a| *a >= along_m - 1e-6)?;
        Some(self.enters + i)
    }
}

/// Extends a plan to `count` states, along the path of `way` and the road beyond it. Its speed approaches
/// that of the path at each place.
pub(crate) fn extend_along_road(
    plan: &mut Vec<State>,
    way: &[Option<State>],
    graph: &LaneGraph,
    agent_type: AgentType,
    count: usize,
) {
    let (Some(path), Some(last)) = (PathProgress::of(way, 0.0), plan.last().copied()) else { return };
    let path = path.extended(graph, agent_type);
    let apart = |p: &PathPlace| (p.position - last.position()).norm();
    let Some(nearest) = path.places.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))) else { return };
    let ahead = direction(nearest.heading_rad).dot(&(last.position() - nearest.position));
    let (mut along, mut speed) = (nearest.along_m + ahead, last.speed_mps());
    while plan.len() < count {
        let rate = (path.speed_at_mps(along) - speed) / STEP_S;
        let then = (speed + rate.clamp(TAKES_UP_MPS2.0, TAKES_UP_MPS2.1) * STEP_S).max(0.0);
        along += 0.5 * (speed + then) * STEP_S;
        speed = then;
        plan.push(path.state(along, speed));
    }
}

/// The likeliest path along the road from a state on.
fn road_ahead(state: &State, graph: &LaneGraph, agent_type: AgentType, length_m: f64) -> Option<Polyline> {
    let pose = Pose { position: state.position(), heading_rad: state.heading_rad };
    let route = best_route_ahead(graph, pose, agent_type, length_m)?;
    Some(base_path(&route.path, pose, state.speed_mps(), agent_type, None))
}

/// The states of an agent of which one state is known, from that state to the window's end: along the road at its
/// speed, and slower in bends. `None` where no road leads on, and for pedestrians.
pub(super) fn along_road(
    start: &State,
    graph: &LaneGraph,
    agent_type: AgentType,
) -> Option<Vec<Option<State>>> {
    if agent_type == AgentType::Pedestrian {
        return None;
    }
    let speed_mps = start.speed_mps();
    let length_m = BEYOND_M + HORIZON_STEPS as f64 * STEP_S * speed_mps;
    let path = road_ahead(start, graph, agent_type, length_m)?;
    let caps_mps = speed::speed_caps(&path, &[speed_mps], SpeedRules::default());
    let progress = cruising(speed_mps, speed_mps, &Caps::new(path.arc_m(), &caps_mps));
    let at = |step: usize| {
        let pose = path.sample(progress[step]);
        let ahead = pose.direction();
        let position = pose.position + ahead * (progress[step] - path.length_m()).max(0.0);
        let velocity = ahead * speed_at(&progress, step);
        State {
            x_m: position.x,
            y_m: position.y,
            heading_rad: pose.heading_rad,
            vx_mps: velocity.x,
            vy_mps: velocity.y,
        }
    };
    Some(std::iter::once(*start).chain((1..=HORIZON_STEPS).map(at)).map(Some).collect())
}

/// States up to the first long gap, with short gaps bridged.
fn bridged(known: &[Option<State>]) -> Vec<State> {
    let mut out: Vec<State> = Vec::with_capacity(known.len());
    let mut gap = 0;
    for state in known {
        let Some(state) = state else {
            gap += 1;
            if gap > MOST_BRIDGED {
                break;
            }
            continue;
        };
        if let Some(last) = out.last().copied() {
            for i in 1..=gap {
                out.push(state_between(&last, state, i as f64 / (gap + 1) as f64));
            }
        }
        gap = 0;
        out.push(*state);
    }
    out
}

/// The state between two others at a share of the way.
pub(crate) fn state_between(a: &State, b: &State, share: f64) -> State {
    let mix = |p: f64, q: f64| p + share * (q - p);
    State {
        x_m: mix(a.x_m, b.x_m),
        y_m: mix(a.y_m, b.y_m),
        heading_rad: wrap_angle(a.heading_rad + share * wrap_angle(b.heading_rad - a.heading_rad)),
        vx_mps: mix(a.vx_mps, b.vx_mps),
        vy_mps: mix(a.vy_mps, b.vy_mps),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::LaneMap;
    use scene::map::Lane;

    fn going(speed_mps: f64, steps: usize) -> Vec<Option<State>> {
        let at = |i: usize| State { x_m: 0.1 * speed_mps * i as f64, vx_mps: speed_mps, ..State::default() };
        (0..steps).map(|i| Some(at(i))).collect()
    }

    #[test]
    fn a_path_is_its_motion() {
        let path = PathProgress::of(&going(8.0, 91), 0.5).unwrap();
        assert!((path.length_m() - 72.0).abs() < 1e-9 && !path.leaves());
        assert!((path.along_at(30) - 24.0).abs() < 1e-9);
        let state = path.state(24.0, 3.0);
        assert!((state.x_m - 24.0).abs() < 1e-9 && (state.vx_mps - 3.0).abs() < 1e-9);
        assert_eq!(path.step_at(40.0), Some(50));
    }

    #[test]
    fn who_comes_later_begins_there_and_gaps_are_bridged() {
        let mut known = going(8.0, 91);
        known[..20].fill(None);
        known[50..55].fill(None);
        let path = PathProgress::of(&known, 0.5).unwrap();
        assert_eq!((path.enters, path.last_step()), (20, 90));
        known[70..85].fill(None);
        let path = PathProgress::of(&known, 0.5).unwrap();
        assert!(path.leaves() && path.last_step() == 69);
    }

    #[test]
    fn a_plan_is_carried_on_along_the_way_it_is_on() {
        let way = going(8.0, 120);
        let mut plan = vec![State { x_m: 20.0, vx_mps: 2.0, ..State::default() }];
        extend_along_road(&mut plan, &way, &LaneGraph::new(&LaneMap::default()), AgentType::Vehicle, 91);
        assert_eq!(plan.len(), 91);
        assert!((plan[1].x_m - 20.2).abs() < 0.05 && (plan[90].vx_mps - 8.0).abs() < 1e-6);
    }

    #[test]
    fn beyond_a_path_the_road_goes_on() {
        // Along x up to 72 m, then left around a circle of 20 m radius.
        let bend = |i: i32| (f64::from(i) * 0.05 - 0.05).max(0.0);
        let point = |i: i32| Vec2::new(72.0 + 20.0 * bend(i).sin(), 20.0 * (1.0 - bend(i).cos()));
        let points: Vec<Vec2> = std::iter::once(Vec2::new(-10.0, 0.0)).chain((0..32).map(point)).collect();
        let map = LaneMap { lanes: vec![Lane::street("1", points)], ..LaneMap::default() };
        let graph = LaneGraph::new(&map);
        let centre = Vec2::new(72.0, 20.0);
        let path = PathProgress::of(&going(8.0, 91), 0.5).unwrap();
        assert!((path.place(92.0).0.y).abs() < 1e-6);
        let led = path.clone().extended(&graph, AgentType::Vehicle);
        assert_eq!((led.length_m(), &led.states), (path.length_m(), &path.states));
        let off_m = |along_m: f64| ((led.place(along_m).0 - centre).norm() - 20.0).abs();
        assert!([75.0, 80.0, 85.0, 90.0].into_iter().all(|along_m| off_m(along_m) < 0.8));
        assert!((led.place(92.0).1 - 1.0).abs() < 0.15);
        // Pedestrians go straight on, and so does every agent without a road.
        let walks = path.clone().extended(&graph, AgentType::Pedestrian);
        let nowhere = path.clone().extended(&LaneGraph::new(&LaneMap::default()), AgentType::Vehicle);
        assert!([walks, nowhere].iter().all(|c| c.place(92.0).0.y.abs() < 1e-6));
    }

    #[test]
    fn what_trembles_goes_nowhere() {
        let mut known = going(0.0, 91);
        for (i, state) in known.iter_mut().flatten().enumerate() {
            state.x_m = 0.1 * (i % 2) as f64;
        }
        assert!(PathProgress::of(&known, 0.5).is_none());
    }
}
