//! The lanes under a road user, from which its routes begin.

use super::{LaneGraph, LaneHit, Pose};
use crate::geometry::cross;
use crate::{AgentType, wrap_angle};

/// Distance from a lane's centre that counts as on it, if half its width is less, metres.
const ON_LANE_M: f64 = 2.0;
/// Greatest heading difference to a lane that a road user is on.
pub const ON_LANE_TURN_RAD: f64 = std::f64::consts::FRAC_PI_4;
/// Greatest distance from a lane if none is under the road user, metres.
pub const RELAXED_M: f64 = 6.0;
/// Greatest heading difference in that case.
const RELAXED_TURN_RAD: f64 = 75.0 * std::f64::consts::PI / 180.0;
/// Distance to which a heading difference of one radian is equivalent, metres.
pub(super) const METRES_PER_RAD: f64 = 3.0;
/// Most start lanes, without their neighbours.
pub const MAX_STARTS: usize = 4;
/// Addition to the score of a neighbouring lane, metres.
const CHANGE_SCORE: f64 = 4.0;

/// A place on a lane from which a route can begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StartLane {
    pub lane: usize,
    pub s_m: f64,
    /// Smaller is better: distance and heading difference, metres.
    pub score: f64,
    /// Not under the road user, but a neighbour of a lane that is.
    pub beside: bool,
}

/// Start lanes by ascending score, nearest and straightest first.
pub(super) fn start_lanes(graph: &LaneGraph, pose: Pose, agent_type: AgentType) -> Vec<StartLane> {
    let near = graph.nearest_for(pose.position, RELAXED_M, agent_type);
    let turn = |hit: &LaneHit| turn_rad(hit, pose);
    let pick = |on: &dyn Fn(&LaneHit) -> bool| {
        let starts = near.iter().filter(|h| on(h)).map(|h| StartLane {
            lane: h.lane,
            s_m: h.s_m,
            score: h.distance_m + METRES_PER_RAD * turn(h),
            beside: false,
        });
        let mut starts: Vec<StartLane> = starts.filter(|s| leads_on(graph, s)).collect();
        starts.sort_by(|a, b| a.score.total_cmp(&b.score).then(a.lane.cmp(&b.lane)));
        starts.truncate(MAX_STARTS);
        starts
    };
    let strict = pick(&|h| is_on(graph, h, pose));
    if strict.is_empty() { pick(&|h| turn(h) <= RELAXED_TURN_RAD) } else { strict }
}

/// Whether a pose is on a lane: near it and along it.
fn is_on(graph: &LaneGraph, hit: &LaneHit, pose: Pose) -> bool {
    let half_width_m = ON_LANE_M.max(0.5 * graph.lanes()[hit.lane].width_m);
    hit.distance_m <= half_width_m && turn_rad(hit, pose) <= ON_LANE_TURN_RAD
}

fn turn_rad(hit: &LaneHit, pose: Pose) -> f64 {
    wrap_angle(hit.heading_rad - pose.heading_rad).abs()
}

/// The nearest lane that a pose is on.
pub(super) fn lane_under(graph: &LaneGraph, pose: Pose, agent_type: AgentType) -> Option<LaneHit> {
    let near = graph.nearest_for(pose.position, RELAXED_M, agent_type);
    near.into_iter().find(|hit| is_on(graph, hit, pose))
}

/// Whether the lane continues ahead of the start.
fn leads_on(graph: &LaneGraph, start: &StartLane) -> bool {
    let lane = &graph.lanes()[start.lane];
    lane.path.length_m() - start.s_m > 0.5 || !lane.successors.is_empty()
}

/// Adds the direct neighbours of the start lanes that run in the same direction.
pub(super) fn with_lanes_beside(
    graph: &LaneGraph,
    mut starts: Vec<StartLane>,
    agent_type: AgentType,
) -> Vec<StartLane> {
    for i in 0..starts.len() {
        let from = starts[i];
        for beside in graph.lanes()[from.lane].beside().filter(|b| b.same_direction) {
            let Some(s_m) = beside.across(from.s_m) else { continue };
            let known = starts.iter().any(|s| s.lane == beside.lane);
            let start = StartLane { lane: beside.lane, s_m, score: from.score + CHANGE_SCORE, beside: true };
            if !known && graph.lanes()[beside.lane].carries(agent_type) && leads_on(graph, &start) {
                starts.push(start);
            }
        }
    }
    starts
}

/// Offset (positive left, metres) and heading difference (radians) of a pose from the start of a path.
pub(super) fn errors_at(pose: Pose, path_start: Pose) -> (f64, f64) {
    let lateral_m = cross(path_start.direction(), pose.position - path_start.position);
    (lateral_m, wrap_angle(pose.heading_rad - path_start.heading_rad))
}
