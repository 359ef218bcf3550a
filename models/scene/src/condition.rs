//! Conditions of a road user: start and goal, each field free (`None`) or fixed, and the via points.

use crate::{Agent, AgentType, GoalRelation, HORIZON_STEPS, LaneMap, STEP_S, Size, Vec2, Via};
use serde::Serialize;

/// Most road edges that one road user may be allowed to drive over.
pub const MAX_CROSSED_EDGES: usize = 32;

/// Where a road user starts. A free field comes from the log, else from defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Start {
    /// Box centre, metres, scene frame.
    pub position: Option<Vec2>,
    /// Radians, wrapped.
    pub heading_rad: Option<f64>,
    /// Along the heading, m/s, not negative.
    pub speed_mps: Option<f64>,
}

/// Where a road user should be at [`Goal::time_s`]. The generator chooses the free fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Goal {
    /// Box centre, metres, scene frame.
    pub position: Option<Vec2>,
    /// Radians, wrapped.
    pub heading_rad: Option<f64>,
    /// m/s, not negative.
    pub speed_mps: Option<f64>,
    /// Scene time at which the goal is due; the end of the horizon if free.
    pub time_s: Option<f64>,
}

impl Goal {
    /// Whether no field but the time is fixed.
    pub fn is_free(&self) -> bool {
        self.position.is_none() && self.heading_rad.is_none() && self.speed_mps.is_none()
    }

    /// Step within the window (1 ..= [`HORIZON_STEPS`]) at which the goal is due, for a window that
    /// starts at `start_s`. A later goal is due at the window's end.
    pub fn step_in_window(&self, start_s: f64) -> usize {
        match self.time_s {
            Some(t) => (((t - start_s) / STEP_S).round().max(1.0) as usize).min(HORIZON_STEPS),
            None => HORIZON_STEPS,
        }
    }
}

/// All conditions that a user fixed for one road user. The default fixes nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Conditions {
    /// Type whose expert is used, in place of the road user's own.
    pub agent_type: Option<AgentType>,
    /// Metres.
    pub length_m: Option<f64>,
    /// Metres.
    pub width_m: Option<f64>,
    /// Start fields.
    pub start: Start,
    /// Goal fields.
    pub goal: Goal,
    /// What the goal is relative to. [`Conditions::goal`] then holds the rest: a time, a speed, or a place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relation: Option<GoalRelation>,
    /// Ids of the road edges that it may drive over on its way to the goal, at most [`MAX_CROSSED_EDGES`].
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub may_cross: Vec<String>,
    /// Places that it passes on its way, in this order, at most [`MAX_VIAS`](crate::MAX_VIAS).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<Via>,
}

impl Conditions {
    /// Whether nothing is fixed.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Indices into [`Conditions::may_cross`] of ids that are not a road edge of this map.
    pub fn unknown_edges(&self, map: &LaneMap) -> Vec<usize> {
        let known = |id: &String| map.road_edges.iter().any(|edge| edge.id == *id);
        (0..self.may_cross.len()).filter(|i| !known(&self.may_cross[*i])).collect()
    }

    /// Size of a road user under these conditions, if `own` is its own size.
    pub fn size_of(&self, own: Size) -> Size {
        Size {
            length_m: self.length_m.unwrap_or(own.length_m),
            width_m: self.width_m.unwrap_or(own.width_m),
            ..own
        }
    }

    /// Type of a road user under these conditions.
    pub fn kind_of(&self, agent: &Agent) -> AgentType {
        self.agent_type.unwrap_or(agent.agent_type)
    }
}
