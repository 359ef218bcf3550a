//! How fast a path can be driven and what stands in the way.

use super::{LaneGraph, Polyline, Route};
use crate::{SignalState, Vec2};

/// Comfort that limits speed in bends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedRules {
    /// Sideways acceleration v^2 k, m/s2.
    pub lateral_mps2: f64,
    /// Braking ahead of bends, m/s2.
    pub brake_mps2: f64,
}

impl Default for SpeedRules {
    fn default() -> Self {
        Self { lateral_mps2: 2.2, brake_mps2: 2.2 }
    }
}

/// Another road user's box and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Obstacle {
    pub position: Vec2,
    pub heading_rad: f64,
    pub length_m: f64,
    pub width_m: f64,
    pub speed_mps: f64,
}

/// The nearest road user ahead on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// Index among the obstacles given.
    pub index: usize,
    /// Free distance between the boxes along the path, metres; negative when they overlap.
    pub gap_m: f64,
    /// Its speed along the path, m/s; zero when it crosses or comes towards us.
    pub speed_mps: f64,
}

/// The first signal on a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalAhead {
    /// Index among the signals given.
    pub index: usize,
    /// State.
    pub state: SignalState,
    /// Distance along the path to the stop line, metres.
    pub distance_m: f64,
}

/// Speed cap at every point of `path`, m/s.
pub fn speed_caps(_path: &Polyline, limits_mps: &[f64], _rules: SpeedRules) -> Vec<f64> {
    limits_mps.to_vec()
}

/// Nearest obstacle ahead whose centre lies within 1.6 m of the path. The path begins at the road user's centre.
pub fn leader(_path: &Polyline, _own_length_m: f64, _others: &[Obstacle]) -> Option<Leader> {
    None
}

/// First signal on the route. Signals: lane (index into the graph), state, stop point if known.
pub fn first_signal(
    _route: &Route,
    _graph: &LaneGraph,
    _signals: &[(usize, SignalState, Option<Vec2>)],
) -> Option<SignalAhead> {
    None
}

/// Distance along the route's path to the first stop sign, metres.
pub fn stop_sign_distance_m(_route: &Route, _graph: &LaneGraph) -> Option<f64> {
    None
}
