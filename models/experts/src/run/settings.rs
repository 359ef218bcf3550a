//! Settings of a run, and the states of egos.

use super::error::RunError;
use scene::{AgentId, HORIZON_STEPS, MAX_COORDINATE_M, MAX_STEPS, State};

/// Range of the length of a step, milliseconds, both ends included.
pub const RUN_STEP_MS: (u32, u32) = (50, 500);
/// Range of the time between two plans of one road user, milliseconds, both ends included.
pub const PLAN_INTERVAL_MS: (u32, u32) = (200, 5_000);
/// Longest run, milliseconds: one hour.
pub const MOST_RUN_MS: u64 = 3_600_000;
/// Most steps of 0.1 s in an ego's announced plan.
pub const MOST_ANNOUNCED: usize = HORIZON_STEPS;
/// Default refinement steps of a plan, fewer than in a call: with five, no more road users reach their goals
/// without a fault.
const REFINEMENT: usize = 1;
/// Highest speed of an ego's state, m/s.
const FASTEST_MPS: u32 = 100;

/// Settings of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunSettings {
    /// Equal seeds give equal runs.
    pub seed: u64,
    /// Length of a step, milliseconds: [`RUN_STEP_MS`].
    pub step_ms: u32,
    /// Time after which each of the others replans, milliseconds: [`PLAN_INTERVAL_MS`].
    pub plan_interval_ms: u32,
    /// Scene step at which the run begins.
    pub start_step: usize,
    /// Refinement steps of each plan, 0..=100.
    pub refinement: usize,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self { seed: 0, step_ms: 100, plan_interval_ms: 1_000, start_step: 0, refinement: REFINEMENT }
    }
}

impl RunSettings {
    /// Checks all ranges.
    ///
    /// # Errors
    /// The first number outside its range.
    pub(super) fn check(&self) -> Result<(), RunError> {
        let (step, interval) = (RUN_STEP_MS, PLAN_INTERVAL_MS);
        let numbers = [
            ("step_ms", step.0 as usize, step.1 as usize, self.step_ms as usize),
            ("plan_interval_ms", interval.0 as usize, interval.1 as usize, self.plan_interval_ms as usize),
            ("start_step", 0, MAX_STEPS - 1, self.start_step),
            ("refinement", 0, 100, self.refinement),
        ];
        let wrong = numbers.into_iter().find(|(_, least, most, got)| !(*least..=*most).contains(got));
        wrong.map_or(Ok(()), |(what, least, most, got)| Err(RunError::OutOfRange { what, least, most, got }))
    }
}

/// The state of an ego at the end of a step, and its announced plan.
#[derive(Clone, Debug, PartialEq)]
pub struct EgoState {
    /// Id of one of the run's egos.
    pub id: AgentId,
    /// Box centre, heading and velocity at the end of the step.
    pub state: State,
    /// Announced states 0.1 s apart, the first 0.1 s after `state`; at most [`MOST_ANNOUNCED`]. If it is
    /// empty, the others expect the ego to continue along its lane.
    pub plan: Vec<State>,
}

impl EgoState {
    /// A state without a plan.
    pub fn new(id: impl Into<AgentId>, state: State) -> Self {
        Self { id: id.into(), state, plan: Vec::new() }
    }

    /// Checks the plan's length and all numbers.
    ///
    /// # Errors
    /// A plan that is too long, or a number that no state has.
    pub(super) fn check(&self) -> Result<(), RunError> {
        if self.plan.len() > MOST_ANNOUNCED {
            let (agent, found) = (self.id.clone(), self.plan.len());
            return Err(RunError::PlanTooLong { agent, found, most: MOST_ANNOUNCED });
        }
        let wrong = std::iter::once(&self.state).chain(&self.plan).position(|state| !is_state(state));
        wrong.map_or(Ok(()), |at| Err(RunError::NoState { agent: self.id.clone(), at }))
    }
}

/// Whether the state's numbers are finite and in the range of a scene.
pub(super) fn is_state(state: &State) -> bool {
    let State { x_m, y_m, heading_rad, vx_mps, vy_mps } = *state;
    let near = |value: f64, most: f64| value.abs() <= most;
    near(x_m, MAX_COORDINATE_M)
        && near(y_m, MAX_COORDINATE_M)
        && near(heading_rad, std::f64::consts::TAU)
        && near(vx_mps, FASTEST_MPS.into())
        && near(vy_mps, FASTEST_MPS.into())
}
