//! Errors of a run.

use crate::request::GenerateError;
use scene::AgentId;

/// Why bytes are not a snapshot of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// They begin with other bytes than a snapshot does.
    #[error("these bytes are no snapshot of a run")]
    NoSnapshot,
    /// A version of the format that this program does not read.
    #[error("a snapshot of version {0}; this program reads version 1")]
    Version(u8),
    /// The snapshot belongs to a scene with another map, other signals or other road users.
    #[error("the snapshot was taken in another scene")]
    OtherScene,
    /// They end too early.
    #[error("the snapshot ends at byte {0}, within a value")]
    Ends(usize),
    /// Bytes that follow the end of the snapshot.
    #[error("the snapshot goes on after its end at byte {0}")]
    GoesOn(usize),
    /// A value that no run has.
    #[error("byte {at}: {what} that no run has")]
    Value {
        /// Byte offset of the value.
        at: usize,
        /// What the value stands for.
        what: &'static str,
    },
}

/// Why a run cannot begin or continue.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No road user has this id.
    #[error("no road user \"{0}\"")]
    UnknownAgent(AgentId),
    /// An ego is not in the scene at the start of the run.
    #[error("ego \"{0}\" is not in the scene at the start of the run")]
    EgoAbsent(AgentId),
    /// An ego was named twice.
    #[error("ego \"{0}\" is named twice")]
    EgoTwice(AgentId),
    /// A step without the state of an ego.
    #[error("the step has no state of ego \"{0}\"")]
    EgoMissing(AgentId),
    /// A state of a road user that the run itself drives.
    #[error("road user \"{0}\" is no ego of this run")]
    NotAnEgo(AgentId),
    /// A number that is not finite, or outside the range of road users.
    #[error(
        "state {at} of ego \"{agent}\": coordinates within 10,000 m, speeds within 100 m/s, a heading within a turn"
    )]
    NoState {
        /// The ego.
        agent: AgentId,
        /// 0 for the state itself, from 1 on for the states of the plan.
        at: usize,
    },
    /// An announced plan with too many states.
    #[error("the plan of ego \"{agent}\" has {found} states; at most {most}")]
    PlanTooLong {
        /// The ego.
        agent: AgentId,
        /// States of its plan.
        found: usize,
        /// Allowed.
        most: usize,
    },
    /// A setting outside its range.
    #[error("{what} is {got}; {least} to {most} expected")]
    OutOfRange {
        /// The setting.
        what: &'static str,
        /// Least allowed.
        least: usize,
        /// Most allowed.
        most: usize,
        /// Given.
        got: usize,
    },
    /// The run has lasted an hour, the longest duration of a run.
    #[error("the run has made {most} steps, the most that it may make")]
    Over {
        /// Number of steps.
        most: u64,
    },
    /// Bytes that are not a snapshot of a run of this scene.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// The generator failed.
    #[error(transparent)]
    Generate(#[from] GenerateError),
}
