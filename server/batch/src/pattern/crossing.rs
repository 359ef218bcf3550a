//! Crossings of lanes.

use scene::routes::{GraphLane, LaneGraph, LaneHit};
use scene::wrap_angle;
use std::collections::BTreeMap;

/// Spacing of the places at which a lane is searched for crossings, metres.
const STEP_M: f64 = 2.0;
/// Radius of the search for lanes at such a place, metres.
const NEAR_M: f64 = 2.5;
/// Limit of searched places per lane.
const MOST_PLACES: usize = 2_000;
/// Most crossings of a lane.
const MOST_CROSSINGS: usize = 32;
/// Smallest angle at which lanes cross, radians: 20 degrees.
const LEAST_RAD: f64 = 0.349;
/// A foot whose distance exceeds its lateral offset by more than this lies beyond an end, metres.
const ABREAST_M: f64 = 0.2;

/// A lane that crosses another.
pub(super) struct LaneCrossing {
    /// The other lane.
    pub(super) other: usize,
    /// Arc length on the own lane, metres.
    pub(super) own_m: f64,
    /// Arc length on the other lane, metres.
    pub(super) other_m: f64,
    /// Heading of the other lane minus that of the own one, radians: positive if the other comes from the
    /// right.
    pub(super) turn_rad: f64,
}

/// The lanes of a kind that cross a lane, in order along it.
pub(super) fn crossings(
    graph: &LaneGraph,
    lane: usize,
    keep: impl Fn(&GraphLane) -> bool,
) -> Vec<LaneCrossing> {
    let path = &graph.lanes()[lane].path;
    let places = ((path.length_m() / STEP_M).ceil() as usize).clamp(1, MOST_PLACES);
    let step_m = (path.length_m() / places as f64).min(STEP_M);
    let mut found = Vec::new();
    let mut before: BTreeMap<usize, LaneHit> = BTreeMap::new();
    for k in 0..=places {
        let here = path.sample(step_m * k as f64);
        let hits = graph.nearest_lanes(here.position, NEAR_M, |i, other| i != lane && keep(other));
        let abreast = hits.into_iter().filter(|hit| hit.distance_m - hit.lateral_m.abs() < ABREAST_M);
        let now: BTreeMap<usize, LaneHit> = abreast.map(|hit| (hit.lane, hit)).collect();
        for (other, hit) in &now {
            let Some(last) = before.get(other) else { continue };
            let changes = (last.lateral_m > 0.0) != (hit.lateral_m > 0.0);
            let turn_rad = wrap_angle(hit.heading_rad - here.heading_rad);
            let crosses = turn_rad.abs() > LEAST_RAD && turn_rad.abs() < std::f64::consts::PI - LEAST_RAD;
            if changes && crosses && found.len() < MOST_CROSSINGS {
                let share = last.lateral_m / (last.lateral_m - hit.lateral_m);
                let own_m = step_m * (k as f64 - 1.0 + share);
                let other_m = last.s_m + share * (hit.s_m - last.s_m);
                found.push(LaneCrossing { other: *other, own_m, other_m, turn_rad });
            }
        }
        before = now;
    }
    found
}
