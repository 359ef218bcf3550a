//! Inputs and outputs of the experts as plain numbers: one [`AgentFeatures`] per road user. The tensors of
//! `net` are these arrays stacked. Their knowledge of the map is what the anchors contain.
//!
//! [`tables`] defines each number; a new input is a line there and one where it is computed (`encode`).

pub mod agent;
mod ahead;
pub mod block;
mod encode;
pub mod encounters;
pub mod tables;
mod tangent;
#[cfg(test)]
mod tests;

pub use tables::{
    ANCHOR, NEIGHBOUR, NEIGHBOUR_GOAL, NEIGHBOURS, OWN, OWN_CONDITION, OWN_GOAL, OWN_GOAL_POSITION,
    OWN_GOAL_VALUES,
};

use crate::planning::{INSTANTS, MODES};
use scene::KNOTS;

/// Share of standing road users that get a training record, so that they do not outnumber the moving ones.
pub const STANDING_SHARE: f64 = 0.06;
/// Training records of a moving road user for each record of a standing one.
pub const MOVING_DRAWS: f64 = 2.0;

/// Corrects a network's probability of standing still for the training on few standing road users (see
/// [`STANDING_SHARE`]).
pub fn stays_in_the_world(output: f64) -> f64 {
    let odds = output / (1.0 - output).max(1e-9) * (MOVING_DRAWS / STANDING_SHARE);
    odds / (1.0 + odds)
}

/// Inputs of an expert for one road user.
#[derive(Clone, Debug)]
pub struct AgentFeatures {
    /// State, size, type, condition values with their masks.
    pub own: [f32; OWN],
    /// At most [`NEIGHBOURS`], the most important first.
    pub neighbours: Vec<[f32; NEIGHBOUR]>,
    /// One anchor per mode.
    pub anchors: Box<[[f32; ANCHOR]; MODES]>,
    /// Projections that keep fixed goal fields: along knots, then across knots. `r' = P r`.
    pub tangent: Box<[[[f32; KNOTS]; KNOTS]; 2]>,
}

/// The recorded motion in each anchor's route coordinates, for training only.
#[derive(Clone, Debug)]
pub struct GroundTruth {
    /// Base progress of each anchor at the instants, metres.
    pub base_along: [[f32; INSTANTS]; MODES],
    /// Recorded progress, metres.
    pub along: [[f32; INSTANTS]; MODES],
    /// Recorded lateral offset, metres.
    pub across: [[f32; INSTANTS]; MODES],
    /// 1 if the recording is valid, else 0.
    pub valid: [f32; INSTANTS],
    /// 1 if the road user stands for the whole window.
    pub stays: f32,
}
