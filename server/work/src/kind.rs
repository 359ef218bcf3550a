//! Kinds of work, and the lanes of the pool.

use std::time::Duration;

/// Calls that are expected to take longer use the patient lane.
const PATIENT: Duration = Duration::from_millis(150);

/// A queue of the pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoolLane {
    /// Interactive calls.
    Quick,
    /// Long calls, with or without a waiting caller.
    Patient,
    /// Small calls without a waiting caller.
    Background,
    /// Documents, which must be parsed before the cost of a call is known.
    Document,
}

impl PoolLane {
    /// All lanes.
    pub const ALL: [Self; 4] = [Self::Quick, Self::Patient, Self::Background, Self::Document];

    /// Niceness of its threads, as in nice(2). The quick lane is slightly nice, so that the browser on the
    /// same machine can draw its answers in time. Long work, and work without a waiting caller, gets a tenth
    /// of its share.
    pub fn nice(self) -> i32 {
        match self {
            Self::Document => 0,
            Self::Quick => 5,
            Self::Patient | Self::Background => 15,
        }
    }

    /// Label of metrics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Patient => "patient",
            Self::Background => "background",
            Self::Document => "document",
        }
    }
}

/// A kind of job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobKind {
    /// Futures.
    Generate,
    /// Road users on a map.
    Place,
    /// Maps from templates.
    Map,
    /// Scores of given motion.
    Score,
    /// Steps of a run.
    Run,
    /// Tries towards a condition.
    Search,
    /// Scenes from a file.
    Import,
    /// A file from a scene.
    Export,
    /// Reading, checking or writing of a JSON document.
    Document,
}

impl JobKind {
    /// Label of metrics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Generate => "generate",
            Self::Place => "place",
            Self::Map => "map",
            Self::Score => "score",
            Self::Run => "run",
            Self::Search => "search",
            Self::Import => "import",
            Self::Export => "export",
            Self::Document => "document",
        }
    }

    /// Noun for messages.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Generate => "generation",
            Self::Place => "placement",
            Self::Map => "map",
            Self::Score => "score",
            Self::Run => "step of a run",
            Self::Search => "search",
            Self::Import => "import",
            Self::Export => "export",
            Self::Document => "reading or writing of a document",
        }
    }

    /// Lane of this kind of work, by its expected time and whether a caller waits.
    pub fn lane(self, cost: Duration, background: bool) -> PoolLane {
        match self {
            Self::Document => PoolLane::Document,
            _ if cost > PATIENT => PoolLane::Patient,
            _ if background => PoolLane::Background,
            _ => PoolLane::Quick,
        }
    }
}
