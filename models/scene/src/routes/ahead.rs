//! Routes ahead of a road user that has no goal.

use super::{LaneGraph, Pose, Route};
use crate::AgentType;

/// Most routes that are kept.
pub const MAX_ROUTES: usize = 6;

/// How far to look: 9 s at 1.15 of the speed (at least 4 m/s) and 15 m, metres.
pub fn route_length_m(speed_mps: f64) -> f64 {
    9.0 * 1.15 * speed_mps.max(4.0) + 15.0
}

/// Up to [`MAX_ROUTES`] routes of `length_m` from the lanes under the road user.
pub fn routes_ahead(
    _graph: &LaneGraph,
    _pose: Pose,
    _speed_mps: f64,
    _agent_type: AgentType,
    _length_m: f64,
) -> Vec<Route> {
    Vec::new()
}
