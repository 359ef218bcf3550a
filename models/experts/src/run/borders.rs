//! Which road users enter and leave.

use crate::tuning::fixed::run::{ARRIVED_M, ENTRY_GAP_M, ENTRY_HEADWAY_S, OFF_MAP_M, OUTSIDE_M};
use scene::geometry::Extent;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, STEP_S, Size, State};

/// Why a road user left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepartureReason {
    /// It left the map.
    LeftTheMap,
    /// It has reached its goal.
    Arrived,
}

/// Whether a road user with this state has left, and why. `extent` is that of the map's lines.
pub(super) fn departure(
    agent: &Agent,
    state: &State,
    scene_step: usize,
    graph: &LaneGraph,
    extent: Option<Extent>,
) -> Option<DepartureReason> {
    let at = state.position();
    let goal = &agent.conditions.goal;
    let is_due = |time_s: f64| scene_step as f64 * STEP_S >= time_s - 1e-9;
    if let (Some(place), Some(time_s)) = (goal.position, goal.time_s)
        && is_due(time_s)
        && (place - at).norm() < ARRIVED_M
    {
        return Some(DepartureReason::Arrived);
    }
    let outside = extent.is_some_and(|extent| extent.outside_m(at) > OUTSIDE_M);
    let rides = matches!(agent.kind(), AgentType::Vehicle | AgentType::Cyclist);
    let off = rides && graph.ground().off_map_m(at, OFF_MAP_M).is_some();
    (outside || off).then_some(DepartureReason::LeftTheMap)
}

/// Whether a road user can enter with this state among those present. No other road user may be within a gap,
/// or reach it in a short time at the closing speed.
pub(super) fn has_room(state: &State, size: &Size, there: &[(State, Size)]) -> bool {
    let own = OrientedBox::of_state(state, size);
    let ahead = own.forward();
    there.iter().all(|(other, other_size)| {
        let faster_mps = (state.velocity() - other.velocity()).dot(&ahead);
        let before_m = ENTRY_GAP_M + ENTRY_HEADWAY_S * faster_mps.max(0.0);
        let behind_m = ENTRY_GAP_M + ENTRY_HEADWAY_S * (-faster_mps).max(0.0);
        let middle = own.center() + ahead * (0.5 * (before_m - behind_m));
        let half_m = own.half_length_m() + 0.5 * (before_m + behind_m);
        let needed = OrientedBox::new(middle, half_m, own.half_width_m(), own.heading_rad());
        !overlaps(&needed, &OrientedBox::of_state(other, other_size), 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Lane, LaneMap};
    use scene::{Subtype, Vec2};

    #[test]
    fn who_comes_in_needs_room_before_and_behind() {
        let size = Size::default_for(AgentType::Vehicle, Subtype::Car);
        let at = |x_m: f64, vx_mps: f64| State { x_m, vx_mps, ..State::default() };
        let room = |other: State| has_room(&at(0.0, 10.0), &size, &[(other, size)]);
        assert!(!room(at(6.0, 10.0)) && room(at(8.0, 10.0)));
        // One that stands 15 m ahead, and one that approaches from behind.
        assert!(!room(at(15.0, 0.0)) && room(at(25.0, 0.0)));
        assert!(!room(at(-15.0, 20.0)) && room(at(-15.0, 10.0)));
        assert!(room(State { y_m: 3.5, ..at(2.0, 10.0) }), "the lane beside");
    }

    #[test]
    fn where_the_road_ends_a_car_leaves_and_a_goal_is_left_at_its_time() {
        let ends = [Vec2::new(0.0, 0.0), Vec2::new(100.0, 0.0)];
        let map = LaneMap { lanes: vec![Lane::street("a", ends.to_vec())], ..LaneMap::default() };
        let graph = LaneGraph::new(&map);
        let mut car = Agent::bare("a", AgentType::Vehicle, Subtype::Car, Vec::new());
        let gone = |car: &Agent, x_m: f64, step: usize| {
            departure(car, &State { x_m, ..State::default() }, step, &graph, Extent::about(ends))
        };
        assert_eq!(gone(&car, 99.0, 10), None);
        assert_eq!(gone(&car, 106.0, 10), Some(DepartureReason::LeftTheMap));
        car.conditions.goal.position = Some(Vec2::new(50.0, 0.0));
        car.conditions.goal.time_s = Some(5.0);
        assert_eq!(gone(&car, 50.5, 49), None);
        assert_eq!(gone(&car, 50.5, 50), Some(DepartureReason::Arrived));
        assert_eq!(gone(&car, 55.0, 50), None);
    }
}
