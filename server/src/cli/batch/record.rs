//! `plan.json`: describes a folder of results. It is written once, before the first chunk.

use super::folder::{BatchFolder, RECORD};
use crate::cli::{Exit, Failure};
use batch::catalogue::CatalogueScene;
use batch::plan::BatchPlan;
use formats::folder::Creation;
use scene::ContentHash;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Value of the document's `format`.
const FORMAT: &str = "dragtraffic.batch";

/// The document.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct BatchRecord {
    format: String,
    version: u32,
    /// Version of the program.
    program: String,
    /// Hashes of weights and tuning.
    pub engine: BTreeMap<String, String>,
    /// Hash of the plan with its inputs, which the results do not contain.
    plan_sha256: String,
    /// The plan without its inputs.
    pub plan: BatchPlan,
    /// The inputs when the run began.
    pub scenes: Vec<CatalogueScene>,
}

impl BatchRecord {
    /// The record of a plan and its inputs.
    pub fn new(plan: &BatchPlan, engine: BTreeMap<String, String>, scenes: Vec<CatalogueScene>) -> Self {
        Self {
            format: FORMAT.into(),
            version: 1,
            program: env!("CARGO_PKG_VERSION").into(),
            engine,
            plan_sha256: ContentHash::of(plan).hex(),
            plan: BatchPlan { scenes: Vec::new(), maps: Vec::new(), ..plan.clone() },
            scenes,
        }
    }

    /// The record of a folder; `None` if there is none.
    ///
    /// # Errors
    /// Exit 3 for a file that is not a record.
    pub fn read(folder: &BatchFolder) -> Result<Option<Self>, Failure> {
        let wrong = |reason: String| Failure::input(format!("{}: {reason}", folder.shown_at(RECORD)));
        let Some(bytes) = folder.find(RECORD)? else { return Ok(None) };
        let record: Self = serde_json::from_slice(&bytes).map_err(|error| wrong(error.to_string()))?;
        if record.format == FORMAT && record.version == 1 {
            Ok(Some(record))
        } else {
            Err(wrong(format!("{FORMAT}, version 1, is expected")))
        }
    }

    /// The record of a folder with results.
    ///
    /// # Errors
    /// Exit 3 if there is none.
    pub fn of(folder: &BatchFolder) -> Result<Self, Failure> {
        let missing = || Failure::input(format!("{}: no results of a batch in this folder", folder.shown()));
        Self::read(folder)?.ok_or_else(missing)
    }

    /// Writes the record to its folder.
    ///
    /// # Errors
    /// Exit 8 when another record exists, 1 when it cannot be written.
    pub fn write(&self, folder: &BatchFolder) -> Result<(), Failure> {
        let mut bytes = serde_json::to_vec_pretty(self).unwrap_or_default();
        bytes.push(b'\n');
        match folder.create(RECORD, &bytes)? {
            Creation::New | Creation::Equal => Ok(()),
            Creation::Different => Err(another(folder, "another plan or other inputs")),
        }
    }

    /// Refuses a folder of another plan, or one made by another engine.
    ///
    /// # Errors
    /// Exit 8.
    pub fn check(
        &self,
        folder: &BatchFolder,
        plan: Option<&BatchPlan>,
        engine: &BTreeMap<String, String>,
    ) -> Result<(), Failure> {
        if plan.is_some_and(|plan| ContentHash::of(plan).hex() != self.plan_sha256) {
            return Err(another(folder, "another plan"));
        }
        if self.engine != *engine {
            return Err(another(folder, "other weights"));
        }
        if self.program != env!("CARGO_PKG_VERSION") {
            return Err(another(folder, &format!("version {} of the program", self.program)));
        }
        Ok(())
    }
}

fn another(folder: &BatchFolder, of: &str) -> Failure {
    let message = format!("{} has results of {of}; give another folder", folder.shown());
    Failure::new(Exit::OutputExists, message)
}
