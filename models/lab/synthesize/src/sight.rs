//! View of a sensor on the ego's roof: trucks and vans occlude tracks, as in recordings.

use scene::geometry::obb::OrientedBox;
use scene::{Agent, Size, State, Vec2};

/// Height of the sensor, metres.
const SENSOR_M: f64 = 2.0;
/// Height of a road user without a known one, metres.
const ASSUMED_HEIGHT_M: f64 = 1.6;
/// Share of a road user's height at which a point must be visible.
const LOOKED_AT: f64 = 0.85;
/// Steps between two computations of visibility.
const LOOK_EVERY: usize = 2;
/// Longest gap that a tracker bridges, steps.
const BRIDGED: usize = 6;

/// Removes states of road users that are occluded for the first one, the ego.
pub fn hide_unseen(agents: &mut [Agent], steps: usize) {
    let mut seen = vec![vec![false; steps]; agents.len()];
    for step in (0..steps).step_by(LOOK_EVERY) {
        let looked = look(agents, step);
        for (flags, sees) in seen.iter_mut().zip(&looked) {
            flags[step..(step + LOOK_EVERY).min(steps)].fill(*sees);
        }
    }
    for (agent, flags) in agents.iter_mut().zip(&mut seen).skip(1) {
        bridge(flags);
        for (state, sees) in agent.track.states.iter_mut().zip(flags) {
            *state = state.take().filter(|_| *sees);
        }
    }
}

/// Marks steps in short gaps as seen.
fn bridge(flags: &mut [bool]) {
    let mut last_seen = None;
    for i in 0..flags.len() {
        if !flags[i] {
            continue;
        }
        if let Some(last) = last_seen
            && i - last <= BRIDGED + 1
        {
            flags[last..i].fill(true);
        }
        last_seen = Some(i);
    }
}

/// A road user that may occlude others, relative to the sensor.
struct Standing {
    outline: OrientedBox,
    height_m: f64,
    distance_m: f64,
    /// Direction from the sensor, and half the angle that the box can cover.
    way: Vec2,
    half_angle_rad: f64,
}

impl Standing {
    fn of(state: &State, size: &Size, sensor: Vec2) -> Self {
        let outline = OrientedBox::of_state(state, size);
        let to = outline.center() - sensor;
        let distance_m = to.norm().max(1e-6);
        let half_angle_rad =
            if outline.radius_m() < distance_m { (outline.radius_m() / distance_m).asin() } else { 4.0 };
        let height_m = size.height_m.unwrap_or(ASSUMED_HEIGHT_M);
        Self { outline, height_m, distance_m, way: to / distance_m, half_angle_rad }
    }

    /// Whether this box blocks the line from the sensor to a point, and is high enough.
    fn hides(&self, sensor: Vec2, point: Vec2, point_height_m: f64) -> bool {
        let Some(share) = entry(&self.outline, sensor, point) else { return false };
        SENSOR_M + share * (point_height_m - SENSOR_M) < self.height_m
    }
}

/// Visible agents at a step.
fn look(agents: &[Agent], step: usize) -> Vec<bool> {
    let Some(sensor) = agents.first().and_then(|ego| ego.track.states[step]).map(|s| s.position()) else {
        return vec![true; agents.len()];
    };
    let standing = |a: &Agent| a.track.states[step].map(|s| Standing::of(&s, &a.size, sensor));
    let all: Vec<Option<Standing>> = agents.iter().map(standing).collect();
    let sees = |i: usize| {
        let Some(target) = &all[i] else { return false };
        let in_the_way = |other: &&Standing| {
            let apart = other.way.dot(&target.way).clamp(-1.0, 1.0).acos();
            other.distance_m < target.distance_m && apart < other.half_angle_rad + target.half_angle_rad
        };
        let others = all.iter().enumerate().skip(1).filter(|(k, _)| *k != i);
        let before: Vec<&Standing> =
            others.filter_map(|(_, other)| other.as_ref()).filter(in_the_way).collect();
        let height_m = LOOKED_AT * target.height_m;
        let points = target.outline.corners().into_iter().chain([target.outline.center()]);
        points.into_iter().any(|point| before.iter().all(|o| !o.hides(sensor, point, height_m)))
    };
    (0..agents.len()).map(|i| i == 0 || sees(i)).collect()
}

/// Position, as a share of the segment between two points, at which the segment enters a box; `None` if it
/// does not.
fn entry(outline: &OrientedBox, from: Vec2, to: Vec2) -> Option<f64> {
    let (a, b) = (outline.local(from), outline.local(to));
    let half = Vec2::new(outline.half_length_m(), outline.half_width_m());
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let way = b[axis] - a[axis];
        if way.abs() < 1e-9 {
            if a[axis].abs() > half[axis] {
                return None;
            }
            continue;
        }
        let (one, two) = ((-half[axis] - a[axis]) / way, (half[axis] - a[axis]) / way);
        enter = enter.max(one.min(two));
        leave = leave.min(one.max(two));
    }
    (enter <= leave).then_some(enter)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, Conditions, Subtype, Track};

    fn standing(id: &str, x_m: f64, y_m: f64, size: [f64; 3]) -> Agent {
        let state = State { x_m, y_m, heading_rad: 0.0, vx_mps: 0.0, vy_mps: 0.0 };
        Agent {
            id: id.to_owned(),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::default(),
            role: None,
            size: Size { length_m: size[0], width_m: size[1], height_m: Some(size[2]) },
            track: Track { first_step: 0, states: vec![Some(state); 20], z_m: None }.into(),
            conditions: Conditions::default(),
        }
    }

    const CAR: [f64; 3] = [4.7, 2.0, 1.5];
    const TRUCK: [f64; 3] = [9.0, 2.6, 3.5];

    fn seen(agents: &[Agent]) -> Vec<usize> {
        let mut agents = agents.to_vec();
        hide_unseen(&mut agents, 20);
        agents.iter().map(|a| a.track.states.iter().flatten().count()).collect()
    }

    #[test]
    fn a_truck_hides_the_car_behind_it_and_a_car_does_not() {
        let ego = standing("ego", 0.0, 0.0, CAR);
        let behind = standing("behind", 30.0, 0.0, CAR);
        let beside = standing("beside", 30.0, 15.0, CAR);
        let truck = standing("truck", 15.0, 0.0, TRUCK);
        let car = standing("car", 15.0, 0.0, CAR);
        assert_eq!(seen(&[ego.clone(), behind.clone(), beside.clone(), truck]), [20, 0, 20, 20]);
        assert_eq!(seen(&[ego, behind, beside, car]), [20; 4]);
    }

    #[test]
    fn one_corner_in_sight_is_enough() {
        let ego = standing("ego", 0.0, 0.0, CAR);
        let truck = standing("truck", 15.0, 0.0, TRUCK);
        let half_hidden = standing("half", 40.0, 4.2, CAR);
        assert_eq!(seen(&[ego, truck, half_hidden]), [20; 3]);
    }

    #[test]
    fn short_gaps_are_bridged_and_long_ones_stay() {
        let mut short = [true, false, false, false, true, true];
        bridge(&mut short);
        assert_eq!(short, [true; 6]);
        let mut long = [false, true, false, false, false, false, false, false, false, true];
        let kept = long;
        bridge(&mut long);
        assert_eq!(long, kept);
    }
}
