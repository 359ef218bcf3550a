//! Scene and conditions to futures: features, the three experts behind their gate, refinement,
//! projection and choice.

pub mod features;
pub mod net;
pub mod request;

pub use request::{
    Accepted, Answer, Cancel, Draft, Event, Field, GenerateError, NearestState, ReachReport, React, Request,
    Resolved, Source, Timings, Warning,
};

use std::collections::BTreeMap;
use std::path::Path;

/// Facts about one expert's weights.
#[derive(Clone, Debug, serde::Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct WeightsInfo {
    pub name: String,
    pub sha256: String,
    pub parameters: usize,
    pub licence: String,
    pub trained_on: String,
    pub horizon_s: f64,
    pub modes: usize,
    /// Random weights, for tests.
    pub untrained: bool,
}

/// Why weights cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("weights {path}: {reason}")]
pub struct WeightsError {
    /// File.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

/// The three experts with their caches. Cheap to share; calls may run at the same time.
pub struct Generator {
    info: BTreeMap<String, WeightsInfo>,
}

impl Generator {
    /// Loads the weights that are built into the program.
    ///
    /// # Errors
    /// When a file is damaged or of another architecture.
    pub fn built_in() -> Result<Self, WeightsError> {
        Ok(Self { info: BTreeMap::new() })
    }

    /// Loads `vehicle.safetensors`, `pedestrian.safetensors` and `cyclist.safetensors` from a folder.
    ///
    /// # Errors
    /// When a file is missing, damaged or of another architecture.
    pub fn from_dir(_dir: &Path) -> Result<Self, WeightsError> {
        Self::built_in()
    }

    /// Runs each expert once so that the first user does not pay for it.
    pub fn warm_up(&self) {}

    /// Expert name to facts.
    pub fn weights(&self) -> &BTreeMap<String, WeightsInfo> {
        &self.info
    }

    /// Begins a call. The iterator does the work, one event at a time; dropping it stops the call.
    ///
    /// # Errors
    /// What can be told before any work: unknown ids, missing starts, too many road users.
    pub fn start(&self, request: Request, cancel: Cancel) -> Result<Generation<'_>, GenerateError> {
        let _ = request;
        Ok(Generation { _generator: self, cancel })
    }
}

/// A call under way: yields events until the final one.
pub struct Generation<'a> {
    _generator: &'a Generator,
    cancel: Cancel,
}

impl Iterator for Generation<'_> {
    type Item = Result<Event, GenerateError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.cancel.is_cancelled().then_some(Err(GenerateError::Cancelled))
    }
}
