//! Replies of runs.

use super::request::{MotionDoc, StateDoc};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use experts::Run;
use experts::run::{DepartureReason, RunChange, RunFault, RunPeek, RunStep};
use scene::State as AgentState;
use scene::judge::{Fault, Reaction};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Rounds to 0.0001: coordinates and speeds to a tenth of a millimetre (per second), headings to 0.0001 rad.
fn rounded(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

impl From<&AgentState> for StateDoc {
    fn from(state: &AgentState) -> Self {
        let AgentState { x_m, y_m, heading_rad, vx_mps, vy_mps } = *state;
        let [x_m, y_m, heading_rad, vx_mps, vy_mps] = [x_m, y_m, heading_rad, vx_mps, vy_mps].map(rounded);
        Self { x_m, y_m, heading_rad, vx_mps, vy_mps }
    }
}

impl MotionDoc {
    fn of(states: &[AgentState]) -> Self {
        let column = |of: fn(&AgentState) -> f64| states.iter().map(|state| rounded(of(state))).collect();
        Self {
            x_m: column(|s| s.x_m),
            y_m: column(|s| s.y_m),
            heading_rad: column(|s| s.heading_rad),
            vx_mps: column(|s| s.vx_mps),
            vy_mps: column(|s| s.vy_mps),
        }
    }
}

/// A road user that changed its plan because of another.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ChangeDoc {
    /// The road user.
    pub agent: String,
    /// What it does, and its cause.
    pub reaction: Reaction,
}

impl ChangeDoc {
    fn all(changes: &[RunChange]) -> Vec<Self> {
        let doc = |c: &RunChange| Self { agent: c.agent.clone(), reaction: c.reaction.clone() };
        changes.iter().map(doc).collect()
    }
}

/// A fault and its road user.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct RunFaultDoc {
    /// The road user with the fault; in a collision, the one that drove into the other.
    pub agent: String,
    /// The fault, with its time and position.
    pub fault: Fault,
}

impl RunFaultDoc {
    fn all(faults: &[RunFault]) -> Vec<Self> {
        faults.iter().map(|f| Self { agent: f.agent.clone(), fault: f.fault.clone() }).collect()
    }
}

/// Why a road user left.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DepartureWord {
    /// It left the map.
    LeftTheMap,
    /// It reached its goal.
    Arrived,
}

/// A road user that left.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct DepartureDoc {
    /// The road user.
    pub agent: String,
    /// Why.
    pub reason: DepartureWord,
}

/// Result of a step.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct StepReply {
    /// Number of the step; 0 for the start.
    pub number: u64,
    /// Scene time at its end, seconds.
    pub time_s: f64,
    /// States of all present road users by id, egos included.
    pub states: BTreeMap<String, StateDoc>,
    /// Changes of plan with their causes.
    pub changes: Vec<ChangeDoc>,
    /// Collisions and vehicles off the road that began in this step.
    pub faults: Vec<RunFaultDoc>,
    /// Ids of the road users that entered.
    pub entered: Vec<String>,
    /// Road users that left.
    pub left: Vec<DepartureDoc>,
}

impl From<&RunStep> for StepReply {
    fn from(step: &RunStep) -> Self {
        let reason = |reason| match reason {
            DepartureReason::LeftTheMap => DepartureWord::LeftTheMap,
            DepartureReason::Arrived => DepartureWord::Arrived,
        };
        let left = step.left.iter();
        Self {
            number: step.number,
            time_s: rounded(step.time_s),
            states: step.states.iter().map(|(id, state)| (id.clone(), state.into())).collect(),
            changes: ChangeDoc::all(&step.changes),
            faults: RunFaultDoc::all(&step.faults),
            entered: step.entered.clone(),
            left: left.map(|d| DepartureDoc { agent: d.agent.clone(), reason: reason(d.reason) }).collect(),
        }
    }
}

/// A run that has begun.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct RunReply {
    /// Id of the run.
    pub run: String,
    /// Road users that the caller drives.
    pub egos: Vec<String>,
    /// Seed, which repeats the run.
    pub seed: u64,
    /// Length of a step, seconds.
    pub step_s: f64,
    /// Replan interval of the other road users, seconds.
    pub plan_interval_s: f64,
    /// Time without a request after which the server deletes the run, seconds.
    pub idle_s: u64,
    /// Time since the last request that used the run, seconds. Reading its state does not count.
    pub unused_s: u64,
    /// Number of remaining steps.
    pub steps_left: u64,
    /// Current states, in the form of a step.
    pub present: StepReply,
}

impl RunReply {
    /// The reply for a run with this id, the seconds since its last use, and the idle seconds after which it
    /// is dropped.
    pub fn of(id: &str, run: &Run, unused_s: u64, idle_s: u64) -> Self {
        let settings = run.settings();
        Self {
            run: id.to_owned(),
            egos: run.egos().into_iter().cloned().collect(),
            seed: settings.seed,
            step_s: f64::from(settings.step_ms) / 1e3,
            plan_interval_s: f64::from(settings.plan_interval_ms) / 1e3,
            idle_s,
            unused_s,
            steps_left: run.steps_left(),
            present: (&run.present()).into(),
        }
    }
}

/// An event of a followed run: first the run, then each step, last `end` when the server deletes the run.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "event", rename_all = "snake_case")]
#[schemars(rename = "RunEvent")]
pub enum RunEvent<S = StepReply> {
    /// State of the run when following begins.
    Run {
        /// The run.
        run: Box<RunReply>,
    },
    /// A step was made. If steps come faster than they are read, only the last one is sent.
    Step {
        /// The reply to the step.
        step: S,
    },
    /// Keep-alive after a while without events.
    Heartbeat,
    /// The server has deleted the run.
    End,
}

/// Predicted motion of the other road users.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PeekReply {
    /// Scene time of the present, seconds.
    pub time_s: f64,
    /// Motion of the others over nine seconds by id, the first state 0.1 s after the present.
    pub futures: BTreeMap<String, MotionDoc>,
    /// Changes of plan with their causes.
    pub changes: Vec<ChangeDoc>,
    /// The first collision of each ego with each other road user.
    pub faults: Vec<RunFaultDoc>,
}

impl PeekReply {
    /// The reply for a peek.
    pub fn of(run: &Run, peek: &RunPeek) -> Self {
        Self {
            time_s: rounded(run.time_s()),
            futures: peek.futures.iter().map(|(id, states)| (id.clone(), MotionDoc::of(states))).collect(),
            changes: ChangeDoc::all(&peek.changes),
            faults: RunFaultDoc::all(&peek.faults),
        }
    }
}

/// A run as text, without its scene.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SnapshotReply {
    /// Number of steps that the run has made.
    pub number: u64,
    /// Bytes of the snapshot.
    pub bytes: usize,
    /// The snapshot, base64, for `snapshot` of a new run.
    pub snapshot: String,
}

impl SnapshotReply {
    /// The snapshot of a run.
    pub fn of(run: &Run) -> Self {
        let bytes = run.snapshot();
        Self { number: run.number(), bytes: bytes.len(), snapshot: STANDARD.encode(&bytes) }
    }
}
