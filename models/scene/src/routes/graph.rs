//! The lane graph: lanes as polylines with links, neighbours and a spatial index.

use crate::geometry::polyline::Polyline;
use crate::map::LaneType;
use crate::{AgentType, LaneMap, Vec2};

/// One lane of the graph.
#[derive(Clone, Debug)]
pub struct GraphLane {
    /// Lane type.
    pub lane_type: LaneType,
    /// Centre line.
    pub path: Polyline,
    /// Width, assumed from the type where the map gives none, metres.
    pub width_m: f64,
    /// Speed limit, assumed from the type where the map gives none, m/s.
    pub speed_limit_mps: f64,
    /// Lanes that follow.
    pub successors: Vec<usize>,
    /// Lanes that lead here.
    pub predecessors: Vec<usize>,
}

/// Lanes, links and spatial index of one map.
#[derive(Clone, Debug, Default)]
pub struct LaneGraph {
    lanes: Vec<GraphLane>,
}

/// A lane near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneHit {
    /// Index into [`LaneGraph::lanes`].
    pub lane: usize,
    /// Arc length of the foot, metres.
    pub s_m: f64,
    /// Signed offset of the point, positive left, metres.
    pub lateral_m: f64,
    /// Distance to the foot, metres.
    pub distance_m: f64,
    /// Lane heading at the foot, radians.
    pub heading_rad: f64,
}

impl LaneGraph {
    /// Graph of a map.
    pub fn new(_map: &LaneMap) -> Self {
        Self::default()
    }

    /// All lanes; the first are [`LaneMap::lanes`] in order, then paths for people on foot.
    pub fn lanes(&self) -> &[GraphLane] {
        &self.lanes
    }

    /// Lanes within `radius_m` that `agent_type` may use, nearest first.
    pub fn nearest_lanes(&self, _point: Vec2, _radius_m: f64, _agent_type: AgentType) -> Vec<LaneHit> {
        Vec::new()
    }
}
