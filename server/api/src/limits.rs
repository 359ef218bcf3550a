//! Limits of one call, the same for every transport.

use schemars::JsonSchema;
use serde::Serialize;

/// Most joint scenes of a call.
pub const SAMPLES: u64 = 32;
/// Most alternatives kept per road user.
pub const MODES: u64 = 6;
/// Most denoising steps.
pub const STEPS: u64 = 100;
/// Greatest scale of the noise.
pub const DIVERSITY: f64 = 2.0;
/// Shortest horizon, seconds.
pub const LEAST_HORIZON_S: f64 = 0.5;
/// Longest horizon, seconds.
pub const MOST_HORIZON_S: f64 = scene::MAX_HORIZON_STEPS as f64 * scene::STEP_S;
/// Longest wait for a draft, milliseconds.
pub const DRAFT_MS: u64 = 1000;
/// Replan intervals, seconds: those of the paper.
pub const REPLAN_S: [f64; 3] = [3.0, 6.0, 9.0];

/// Limits of the work and the reply of one call. A transport may set others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CallLimits {
    /// Road users regenerated or reacting in one call.
    pub regenerated_agents: u64,
    /// Product of samples, modes, road users and steps in a reply.
    pub reply_points: u64,
    /// Expected work of a generation, seconds of a core.
    pub work_s: u64,
}

impl Default for CallLimits {
    fn default() -> Self {
        Self { regenerated_agents: 128, reply_points: 500_000, work_s: u64::MAX }
    }
}

/// A bound in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Bound {
    /// Value, in the unit of the bound's name.
    pub value: u64,
    /// Description of the bounded quantity.
    pub what: &'static str,
}
