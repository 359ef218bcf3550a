//! Sorts of work.

/// Which queue a job waits in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lane {
    /// Calls that people wait for.
    Long,
    /// Documents, which must be read before it is known what a call asks.
    Short,
}

/// A sort of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Futures.
    Generate,
    /// Road users on a map.
    Place,
    /// Scores of given motion.
    Score,
    /// Scenes out of a file.
    Import,
    /// A file out of a scene.
    Export,
    /// Reading, checking or writing of a JSON document.
    Document,
}

impl Kind {
    /// Label of metrics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Generate => "generate",
            Self::Place => "place",
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
            Self::Score => "score",
            Self::Import => "import",
            Self::Export => "export",
            Self::Document => "reading or writing of a document",
        }
    }

    /// Its queue.
    pub fn lane(self) -> Lane {
        if self == Self::Document { Lane::Short } else { Lane::Long }
    }
}
