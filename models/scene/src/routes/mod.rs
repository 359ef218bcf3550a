//! Routes along the lane graph: where a road user may go, and the paths that lead to a goal.
//!
//! [`LaneGraph`] is built once per map and shared. [`routes_ahead`] and [`routes_to_goal`] list paths.
//! [`base_path`] bends a path so that it starts (and ends) exactly at the road user's start (and goal).
//! [`speed`] computes how fast it can be driven and which obstacles are on it.

pub mod ahead;
mod along;
mod assemble;
pub mod blend;
mod cubic;
pub mod graph;
mod join;
mod links;
mod search;
pub mod speed;
pub mod start;
pub mod to_goal;
mod walks;

pub use crate::geometry::polyline::{Foot, Polyline, Pose};
pub use ahead::{MAX_ROUTES, best_route_ahead, route_length_m, routes_ahead};
pub use blend::{EndPose, base_path};
pub use graph::{AdjacentLane, GraphLane, LaneGraph, LaneHit, LaneSource, assumed_speed_limit_mps};
pub use speed::{LaneSignal, Leader, Obstacle, SignalAhead, SpeedRules};
pub use to_goal::{GoalQuery, GoalRoute, MAX_GOAL_ROUTES, RouteKind, further_routes_to_goal, routes_to_goal};

/// A stretch of one lane on a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Index into [`LaneGraph::lanes`].
    pub lane: usize,
    /// Arc length on the lane where the leg begins, metres.
    pub from_m: f64,
    /// Arc length on the lane where the leg ends, metres.
    pub to_m: f64,
    /// Arc length on [`Route::path`] where the leg begins, metres.
    pub path_from_m: f64,
}

/// A path along lanes, from the road user's place.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Lanes in driving order.
    pub legs: Vec<Leg>,
    /// Lane centres, points about 1 m apart; begins at the road user's foot on the first lane.
    pub path: Polyline,
    /// Speed limit at every point of `path`, m/s; assumed by lane type if the map gives none.
    pub limits_mps: Vec<f64>,
    /// The road user's offset from the path, positive to the left, metres.
    pub lateral_m: f64,
    /// The road user's heading minus the path's, wrapped, radians.
    pub heading_error_rad: f64,
    /// The graph ends where the path does; its continuation is unknown.
    pub terminal: bool,
}

#[cfg(test)]
mod property_tests;
#[cfg(test)]
mod sample_maps;
#[cfg(test)]
mod tests;
