//! A table of the evaluation.

use super::sheet::Sheet;
use super::stats::Bootstrap;
use super::{Entrants, Judged, Site};
use anyhow::Result;
use lab_train::baselines::Baseline;
use scene::Scene;

/// A table of the evaluation.
#[derive(Debug)]
pub struct TableSpec {
    /// Its number, with which the titles of its sheets begin.
    pub number: usize,
    /// Subject, as a name.
    pub name: &'static str,
    /// Makes it.
    pub(super) make: fn(&mut Trial<'_>) -> Result<Made>,
}

/// Inputs of a table: judged methods, sites and settings.
pub(super) struct Trial<'a> {
    /// The experts.
    pub(super) judged: Vec<Judged>,
    /// Their learned rivals.
    pub(super) baselines: &'a [Baseline],
    /// The scenes.
    pub(super) scenes: &'a [Scene],
    /// The scenes, prepared for the evaluation.
    pub(super) sites: Vec<Site<'a>>,
    /// Resamples of the scenes.
    pub(super) boot: Bootstrap,
    /// Draws noise, drags and random pictures.
    pub(super) seed: u64,
    /// Steps between replans of the product; each is a row of table 2.
    pub(super) replan_steps: &'a [usize],
    /// Whether to draw pictures.
    pub(super) pictures: bool,
}

impl Trial<'_> {
    /// The experts and the trained baselines.
    pub(super) fn entrants(&self) -> Entrants<'_> {
        Entrants { judged: &self.judged, baselines: self.baselines }
    }
}

/// Result of a table.
#[derive(Default)]
pub(super) struct Made {
    /// Figures, the same for the same seed.
    pub(super) sheets: Vec<Sheet>,
    /// Times, which differ in each run.
    pub(super) times: Vec<Sheet>,
    /// File name and SVG.
    pub(super) pictures: Vec<(String, String)>,
}

impl From<Vec<Sheet>> for Made {
    fn from(sheets: Vec<Sheet>) -> Self {
        Self { sheets, ..Self::default() }
    }
}
