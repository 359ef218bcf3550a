//! Reproduces the paper by one command: from a folder of recordings to Tables I and II in the paper's form,
//! beside the paper's own figures, on any data; and to its figure of creating, editing and correcting.
//!
//! ```text
//! recordings -> sets (records, list of tests) -> training (weights) -> quality, collisions -> report
//! ```
//!
//! Each step leaves its result in the folder of the run, and a resumed run begins after the last complete
//! step. The same data, settings and seed give the same files; the clock is used only for progress messages.

mod collisions;
mod figure;
mod methods;
pub mod paper;
mod quality;
mod report;
mod run;
mod sets;
#[cfg(test)]
mod tests;
mod training;

pub use collisions::CollisionOptions;
pub use figure::FIGURE_FILE;
pub use report::TABLES_FILE;
pub use run::{OtherRun, Parts, RunOptions, forget, run};
pub use sets::{Centre, Data, SetOptions, Sets};
pub use training::{Length, Schedule, Trained};

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag by which other threads stop a run.
pub type Stop = Arc<AtomicBool>;

/// The run was stopped on request; finished parts are kept.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("stopped; the same command goes on from there")]
pub struct Stopped;

/// # Errors
/// [`Stopped`] if a stop was requested.
fn stopped(stop: &Stop) -> anyhow::Result<()> {
    if stop.load(Ordering::Relaxed) { Err(Stopped.into()) } else { Ok(()) }
}

/// A file with the place of a scene in it.
type ScenePlace = ((sets::Part, usize), usize);

/// Indices of the scenes of the cases, by which figures are resampled.
fn scene_index(cases: &[sets::TestCase]) -> BTreeMap<ScenePlace, usize> {
    let mut out = BTreeMap::new();
    for case in cases {
        let next = out.len();
        out.entry(case.place()).or_insert(next);
    }
    out
}
