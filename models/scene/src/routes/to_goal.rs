//! Routes to a goal.

use super::{LaneGraph, Pose, Route};
use crate::{AgentType, Vec2};

/// What to look for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalQuery {
    /// Where the road user stands.
    pub pose: Pose,
    /// Its speed, m/s.
    pub speed_mps: f64,
    /// Which lanes it may use.
    pub agent_type: AgentType,
    /// Where it should go.
    pub goal: Vec2,
    /// Heading asked for at the goal, radians.
    pub goal_heading_rad: Option<f64>,
    /// Length of the least-effort motion to the goal, metres: joins much longer than it are dropped.
    pub least_effort_m: Option<f64>,
}

/// How a route reaches the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouteKind {
    /// Along lanes all the way.
    Forward,
    /// By a cubic from the road user onto the lanes that lead to the goal.
    Joined,
    /// Along lanes, then by a cubic to a goal that is off every lane.
    OffLane,
}

/// A route and how it meets the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalRoute {
    /// The route; its path ends at the goal's foot (or at the goal itself, off lane).
    pub route: Route,
    /// How it gets there.
    pub kind: RouteKind,
    /// Offset of the goal from the end of the path, positive left, metres.
    pub goal_lateral_m: f64,
    /// Rank among routes: metres of path and penalties.
    pub cost: f64,
}

/// Up to three distinct routes to the goal, best first; none where no sensible way is known.
pub fn routes_to_goal(_graph: &LaneGraph, _query: &GoalQuery) -> Vec<GoalRoute> {
    Vec::new()
}
