//! Length of a path that breaks the rules of the road: beyond its edges, over a median, against the traffic.

use super::world::AgentAtStart;
use crate::tuning::fixed::legal::{BESIDE_LANES_M, BEYOND_M, EDGE_M, NARROWER_M};
use scene::geometry::direction;
use scene::routes::Polyline;
use scene::score::Drivable;
use scene::{AgentType, Vec2};
use std::f64::consts::FRAC_PI_2;

/// Distance between samples of a path, metres.
const STEP_M: f64 = 1.5;

/// Metres of the first `to_m` of a path on which a road user would break the rules. Riders use pavements, so
/// only crossed edges and wrong-way riding count for them. Nothing counts on foot, or if the map does not
/// define its ground.
pub(super) fn broken_m(ground: &Drivable, who: &AgentAtStart, path: &Polyline, to_m: f64) -> f64 {
    if who.agent_type == AgentType::Pedestrian || ground.is_unknown() {
        return 0.0;
    }
    let drives = who.agent_type != AgentType::Cyclist;
    // Lanes without road edges do not define the room beside them.
    let sides = ground.is_bounded();
    let half_width_m = (0.5 * who.size.width_m - NARROWER_M).max(0.0);
    let pieces = (to_m / STEP_M).ceil().clamp(1.0, 400.0);
    let step_m = to_m / pieces;
    let mut broken = 0.0;
    let mut last: Option<Vec2> = None;
    for i in 0..=pieces as usize {
        let pose = path.extrapolate(i as f64 * step_m);
        if last.is_some_and(|last| ground.crosses_an_edge(last, pose.position)) {
            broken += EDGE_M;
        }
        last = Some(pose.position);
        let left = half_width_m * direction(pose.heading_rad + FRAC_PI_2);
        let beyond = |point: Vec2, most_m: f64| ground.outside_m(point).is_some_and(|m| m > most_m);
        let off = drives
            && (beyond(pose.position, if sides { 0.0 } else { BESIDE_LANES_M })
                || sides && [left, -left].iter().any(|side| beyond(pose.position + side, BEYOND_M)));
        if off || ground.is_wrong_way(pose.position, pose.direction()) == Some(true) {
            broken += step_m;
        }
    }
    broken
}
