//! Sorts of work.

use std::time::Duration;

/// Calls that are expected to take longer wait among themselves.
const PATIENT: Duration = Duration::from_millis(150);

/// A queue of the pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoolLane {
    /// Calls that people wait for.
    Quick,
    /// Calls that take long whoever waits.
    Patient,
    /// Small calls that nobody waits for.
    Background,
    /// Documents, which must be read before it is known what a call asks.
    Document,
}

impl PoolLane {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Quick, Self::Patient, Self::Background, Self::Document];

    /// How far its threads leave the cores to others, as nice(2) counts. What people wait for does so a little, for
    /// whoever draws the answers on the same machine: late pictures hold up answers too. What takes long, or what
    /// nobody waits for, gets a tenth of what that gets.
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
    /// Scenes out of a file.
    Import,
    /// A file out of a scene.
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
            Self::Import => "import",
            Self::Export => "export",
            Self::Document => "document",
        }
    }

    /// Word for people.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Generate => "generation",
            Self::Place => "placement",
            Self::Map => "map",
            Self::Score => "score",
            Self::Import => "import",
            Self::Export => "export",
            Self::Document => "reading or writing of a document",
        }
    }

    /// Queue of such work that is expected to take so long, or that nobody waits for.
    pub fn lane(self, cost: Duration, background: bool) -> PoolLane {
        match self {
            Self::Document => PoolLane::Document,
            _ if cost > PATIENT => PoolLane::Patient,
            _ if background => PoolLane::Background,
            _ => PoolLane::Quick,
        }
    }
}
