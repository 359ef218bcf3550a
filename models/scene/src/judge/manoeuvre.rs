//! Classifies a motion by its shape and its lanes.

use super::Manoeuvre;
use crate::geometry::{cross, direction};
use crate::routes::{LaneGraph, LaneHit};
use crate::{AgentType, State, wrap_angle};
use std::collections::VecDeque;

/// Steps between the states that are compared.
const STRIDE: usize = 5;
/// A motion shorter than this is a stay, metres.
pub const STAYS_M: f64 = 1.0;
/// Change of heading above which a motion is a turn, radians: 34 degrees.
pub const TURN_RAD: f64 = 0.6;
/// Change of heading above which a motion is a U-turn, radians: 150 degrees.
pub const ROUND_RAD: f64 = 2.6;
/// Below this a motion is straight whatever the lanes, radians and metres.
const AHEAD_RAD: f64 = 0.1;
const AHEAD_M: f64 = 1.2;
/// Greatest distance from the lane that is driven, metres.
pub const ON_LANE_M: f64 = 2.5;
/// Greatest difference of heading from the lane that is driven, radians.
pub const ALONG_LANE_RAD: f64 = 0.8;
/// Number of lanes that are searched between start and end.
const MOST_LANES: usize = 64;
/// Most lane changes of one motion.
const MOST_CHANGES: i32 = 3;

/// Manoeuvre of states on consecutive steps. With lanes, a bend of the road is not a turn, and lane changes
/// are recognized.
pub fn manoeuvre(states: &[State], agent_type: AgentType, lanes: Option<&LaneGraph>) -> Option<Manoeuvre> {
    if states.is_empty() {
        return None;
    }
    let shape = PathShape::of(states);
    if shape.way_m < STAYS_M {
        return Some(Manoeuvre::Stays);
    }
    if shape.backwards_m > 0.5 * shape.way_m {
        return Some(Manoeuvre::Reverse);
    }
    if shape.turn_rad.abs() > ROUND_RAD {
        return Some(Manoeuvre::TurnRound);
    }
    let turned = match shape.turn_rad {
        t if t > TURN_RAD => Some(Manoeuvre::Left),
        t if t < -TURN_RAD => Some(Manoeuvre::Right),
        _ => None,
    };
    if shape.turn_rad.abs() < AHEAD_RAD && shape.aside_m.abs() < AHEAD_M {
        return Some(Manoeuvre::Straight);
    }
    let walks = agent_type == AgentType::Pedestrian;
    let taken = lanes.filter(|_| !walks).and_then(|lanes| taken(lanes, agent_type, states));
    let Some(taken) = taken else { return Some(turned.unwrap_or(Manoeuvre::Straight)) };
    let changed = match taken.shift {
        0 => None,
        shift if shift > 0 => Some(Manoeuvre::LaneLeft),
        _ => Some(Manoeuvre::LaneRight),
    };
    Some(turned.filter(|_| taken.junction).or(changed).unwrap_or(Manoeuvre::Straight))
}

struct PathShape {
    way_m: f64,
    /// Part of the length that is driven backwards, metres.
    backwards_m: f64,
    /// Change of heading, positive to the left, radians.
    turn_rad: f64,
    /// Offset of the end to the left of the start's heading, metres.
    aside_m: f64,
}

impl PathShape {
    fn of(states: &[State]) -> Self {
        let mut shape = Self { way_m: 0.0, backwards_m: 0.0, turn_rad: 0.0, aside_m: 0.0 };
        let end = states.len().saturating_sub(1);
        let mut last = states[0];
        for i in (STRIDE..end).step_by(STRIDE).chain([end]) {
            let state = &states[i];
            let moved = state.position() - last.position();
            shape.way_m += moved.norm();
            if moved.dot(&direction(state.heading_rad)) < 0.0 {
                shape.backwards_m += moved.norm();
            }
            shape.turn_rad += wrap_angle(state.heading_rad - last.heading_rad);
            last = *state;
        }
        let first = &states[0];
        shape.aside_m = cross(direction(first.heading_rad), last.position() - first.position());
        shape
    }
}

/// How the lanes lead from start to end.
struct LaneTransition {
    /// Lane changes to the left minus those to the right.
    shift: i32,
    /// The path leads through a junction or a fork.
    junction: bool,
}

fn taken(lanes: &LaneGraph, agent_type: AgentType, states: &[State]) -> Option<LaneTransition> {
    let on = |state: &State| -> Vec<LaneHit> {
        let along = |hit: &LaneHit| wrap_angle(hit.heading_rad - state.heading_rad).abs() < ALONG_LANE_RAD;
        lanes.nearest_for(state.position(), ON_LANE_M, agent_type).into_iter().filter(along).collect()
    };
    let start = on(states.first()?).first()?.lane;
    // If the map ends before the motion does, the last place on a lane shows where it went.
    let ends = states.iter().rev().step_by(STRIDE).map(on).find(|hits| !hits.is_empty())?;
    let nearest = ends.first()?.distance_m;
    // At forks and merges, lanes overlap.
    let is_end = |lane: usize| ends.iter().any(|e| e.lane == lane && e.distance_m < nearest + 0.3);
    // Lanes with the fewest changes first: on along the lane, then beside it.
    let mut queue = VecDeque::from([(start, 0_i32, false)]);
    let mut seen: Vec<(usize, i32)> = Vec::new();
    while let Some((at, shift, junction)) = queue.pop_front() {
        if seen.contains(&(at, shift)) || seen.len() >= MOST_LANES {
            continue;
        }
        seen.push((at, shift));
        let lane = &lanes.lanes()[at];
        let junction = junction || lane.interpolating;
        if is_end(at) {
            return Some(LaneTransition { shift, junction });
        }
        let parts = lane.successors.len() > 1;
        for next in lane.successors.iter().rev() {
            queue.push_front((*next, shift, junction || parts));
        }
        if shift.abs() < MOST_CHANGES {
            let beside = |side: i32| move |b: &crate::routes::AdjacentLane| (b.lane, shift + side);
            let left = lane.left.iter().filter(|b| b.same_direction).map(beside(1));
            let right = lane.right.iter().filter(|b| b.same_direction).map(beside(-1));
            queue.extend(left.chain(right).map(|(lane, shift)| (lane, shift, junction)));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LaneMap;
    use crate::Vec2;
    use crate::map::Lane;

    /// From the origin to the east, turning by `turn_rad` in all and drifting aside by `aside_m`.
    fn ride(speed_mps: f64, turn_rad: f64, aside_m: f64) -> Vec<State> {
        let mut at = Vec2::zeros();
        (0..90)
            .map(|i| {
                let share = f64::from(i) / 89.0;
                let heading_rad = turn_rad * share;
                let v = direction(heading_rad) * speed_mps;
                at += v * 0.1;
                let y_m = at.y + aside_m * share;
                State { x_m: at.x, y_m, heading_rad, vx_mps: v.x, vy_mps: v.y }
            })
            .collect()
    }

    fn of(states: &[State], lanes: Option<&LaneGraph>) -> Manoeuvre {
        manoeuvre(states, AgentType::Vehicle, lanes).unwrap()
    }

    #[test]
    fn the_shape_says_what_it_does() {
        assert_eq!(of(&ride(0.0, 0.0, 0.0), None), Manoeuvre::Stays);
        assert_eq!(of(&ride(8.0, 0.1, 0.0), None), Manoeuvre::Straight);
        assert_eq!(of(&ride(8.0, 1.5, 0.0), None), Manoeuvre::Left);
        assert_eq!(of(&ride(8.0, -1.5, 0.0), None), Manoeuvre::Right);
        assert_eq!(of(&ride(8.0, 3.1, 0.0), None), Manoeuvre::TurnRound);
        assert_eq!(of(&ride(-2.0, 0.0, 0.0), None), Manoeuvre::Reverse);
        assert!(manoeuvre(&[], AgentType::Vehicle, None).is_none());
    }

    /// Two lanes to the east, side by side.
    fn street() -> LaneGraph {
        let lane = |id: &str, y: f64| {
            Lane::street(id, (0..=40).map(|i| Vec2::new(4.0 * f64::from(i) - 20.0, y)).collect::<Vec<_>>())
        };
        LaneGraph::new(&LaneMap { lanes: vec![lane("a", 0.0), lane("b", 3.5)], ..LaneMap::default() })
    }

    #[test]
    fn lanes_tell_a_change_of_lane_from_a_bend() {
        let street = street();
        assert_eq!(of(&ride(10.0, 0.0, 0.0), Some(&street)), Manoeuvre::Straight);
        assert_eq!(of(&ride(10.0, 0.0, 3.5), Some(&street)), Manoeuvre::LaneLeft);
        // The map ends at 140 m.
        assert_eq!(of(&ride(20.0, 0.0, 3.5), Some(&street)), Manoeuvre::LaneLeft);
        let mut back = ride(10.0, 0.0, -3.5);
        back.iter_mut().for_each(|s| s.y_m += 3.5);
        assert_eq!(of(&back, Some(&street)), Manoeuvre::LaneRight);
        // A road with the same bend.
        let bend: Vec<Vec2> = ride(10.0, 0.9, 0.0).iter().step_by(3).map(State::position).collect();
        let bend = LaneGraph::new(&LaneMap { lanes: vec![Lane::street("a", bend)], ..LaneMap::default() });
        assert_eq!(of(&ride(10.0, 0.9, 0.0), Some(&bend)), Manoeuvre::Straight);
        assert_eq!(of(&ride(10.0, 0.9, 0.0), None), Manoeuvre::Left);
    }
}
