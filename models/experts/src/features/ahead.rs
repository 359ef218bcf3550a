//! Facts about the path ahead: leaders, signals, signs, crossing traffic, the junction.

use crate::planning::anchors::Anchor;
use crate::planning::world::{AgentAtStart, World};
use scene::geometry::direction;
use scene::routes::{AdjacentLane, LaneGraph, Leg, Route, speed};
use scene::{SignalState, wrap_angle};

/// Distance ahead within which standing road users count as a queue, metres.
const QUEUE_M: f64 = 60.0;
/// An agent whose centre comes this near to a path crosses it, metres.
const MEETS_M: f64 = 3.0;

/// Facts about a path that do not depend on its timing.
pub(super) struct PathFacts {
    /// The nearest road user ahead on the path.
    pub(super) leader: Option<speed::Leader>,
    /// The one ahead of the leader.
    pub(super) second: Option<speed::Leader>,
    /// Standing road users on the path within [`QUEUE_M`].
    pub(super) queue: usize,
    /// The first signal on the path.
    pub(super) light: Option<LightAhead>,
    /// Distance to the first stop sign, metres.
    pub(super) stop_sign_m: Option<f64>,
    /// The earliest crossing by a road user that continues straight on.
    pub(super) crossing: Option<CrossingAhead>,
    /// The first junction on the path.
    pub(super) junction: Option<JunctionAhead>,
    /// Number of lanes beside the first one: same direction on the left, same direction on the right,
    /// opposite direction on the left.
    pub(super) beside: [usize; 3],
}

/// A signal on a path.
pub(super) struct LightAhead {
    pub(super) state: SignalState,
    pub(super) distance_m: f64,
    /// Time for which it has been in this state.
    pub(super) age_s: f64,
}

/// Place where another road user crosses a path if it continues straight on.
#[derive(Clone, Copy)]
pub(super) struct CrossingAhead {
    /// Distance along the path.
    pub(super) distance_m: f64,
    /// Time at which it is there.
    pub(super) time_s: f64,
    pub(super) speed_mps: f64,
}

/// The first junction on a path, by the map's connecting lanes.
pub(super) struct JunctionAhead {
    pub(super) from_m: f64,
    pub(super) to_m: f64,
    /// Turn of the path in it, radians to the left.
    pub(super) turn_rad: f64,
    /// Number of successors of the lane before it.
    pub(super) ways: usize,
}

impl PathFacts {
    pub(super) fn of(
        world: &World<'_>,
        who: &AgentAtStart,
        anchor: &Anchor,
        obstacles: &[speed::Obstacle],
    ) -> Self {
        let light = anchor.route.as_ref().and_then(|route| {
            let ahead = speed::first_signal(route, &world.graph, &world.signals)?;
            let age_s = world.signal_ages_s.get(ahead.index).copied()?;
            Some(LightAhead { state: ahead.state, distance_m: ahead.distance_m, age_s })
        });
        let stop_sign_m =
            anchor.route.as_ref().and_then(|route| speed::stop_sign_distance_m(route, &world.graph));
        let ahead = speed::leaders(&anchor.path, who.size.length_m, obstacles);
        let waits = |l: &&speed::Leader| l.gap_m < QUEUE_M && obstacles[l.index].speed_mps < 0.5;
        Self {
            leader: ahead.first().copied(),
            second: ahead.get(1).copied(),
            queue: ahead.iter().filter(waits).count(),
            light,
            stop_sign_m,
            crossing: crossing(anchor, obstacles),
            junction: anchor.route.as_ref().and_then(|route| junction(route, &world.graph)),
            beside: anchor.route.as_ref().map_or([0; 3], |route| beside(route, &world.graph)),
        }
    }
}

/// The first junction that a route passes or begins in.
fn junction(route: &Route, graph: &LaneGraph) -> Option<JunctionAhead> {
    let connects = |leg: &Leg| graph.lanes()[leg.lane].interpolating;
    let first = route.legs.iter().position(connects)?;
    let through = route.legs[first..].iter().take_while(|leg| connects(leg)).count();
    let last = &route.legs[first + through - 1];
    let (from_m, to_m) = (route.legs[first].path_from_m, last.path_from_m + last.to_m - last.from_m);
    let heading = |s_m: f64| route.path.sample(s_m).heading_rad;
    let ways = first.checked_sub(1).map_or(1, |k| graph.lanes()[route.legs[k].lane].successors.len());
    Some(JunctionAhead { from_m, to_m, turn_rad: wrap_angle(heading(to_m) - heading(from_m)), ways })
}

/// Lanes beside the start of a route: see [`PathFacts::beside`].
fn beside(route: &Route, graph: &LaneGraph) -> [usize; 3] {
    let Some(leg) = route.legs.first() else { return [0; 3] };
    let lane = &graph.lanes()[leg.lane];
    let count = |side: &[AdjacentLane], same_way: bool| {
        side.iter().filter(|b| b.same_direction == same_way && b.across(leg.from_m).is_some()).count()
    };
    [count(&lane.left, true), count(&lane.right, true), count(&lane.left, false)]
}

/// The earliest place at which a road user that continues straight on crosses the path.
fn crossing(anchor: &Anchor, obstacles: &[speed::Obstacle]) -> Option<CrossingAhead> {
    let mut soonest: Option<CrossingAhead> = None;
    for other in obstacles.iter().filter(|o| o.speed_mps > 0.5) {
        let (from, ahead) = (other.outline.center(), other.outline.forward());
        for seconds in [1.0, 2.0, 3.0, 4.5, 6.0] {
            if soonest.is_some_and(|s| s.time_s <= seconds) {
                break;
            }
            let there = from + ahead * (other.speed_mps * seconds);
            let Some(foot) = anchor.path.project_within(there, MEETS_M) else { continue };
            let across = direction(foot.heading_rad).dot(&ahead).abs() < 0.75;
            if foot.s_m > 3.0 && across {
                let speed_mps = other.speed_mps;
                soonest = Some(CrossingAhead { distance_m: foot.s_m, time_s: seconds, speed_mps });
                break;
            }
        }
    }
    soonest
}
