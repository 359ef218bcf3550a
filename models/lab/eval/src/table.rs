//! What a table of the evaluation is.

use super::sheet::Sheet;
use super::stats::Bootstrap;
use super::{Entrants, Judged, Site};
use anyhow::Result;
use lab_train::baselines::Baseline;
use scene::Scene;

/// A table of the evaluation.
#[derive(Debug)]
pub struct TableSpec {
    /// Its number, which the titles of its sheets begin with.
    pub number: usize,
    /// What it is about.
    pub name: &'static str,
    /// Makes it.
    pub(super) make: fn(&mut Trial<'_>) -> Result<Made>,
}

/// Who is judged, on what, and how: what a table is made from.
pub(super) struct Trial<'a> {
    /// The experts.
    pub(super) judged: Vec<Judged>,
    /// Their learned rivals.
    pub(super) baselines: &'a [Baseline],
    /// The scenes.
    pub(super) scenes: &'a [Scene],
    /// The same, made ready.
    pub(super) sites: Vec<Site<'a>>,
    /// Resamples of the scenes.
    pub(super) boot: Bootstrap,
    /// Draws noise, drags and random pictures.
    pub(super) seed: u64,
    /// Steps after which the product plans anew, a line of table 2 each.
    pub(super) replan_steps: &'a [usize],
    /// Whether pictures are wanted.
    pub(super) pictures: bool,
}

impl Trial<'_> {
    /// Everybody who learned to answer.
    pub(super) fn entrants(&self) -> Entrants<'_> {
        Entrants { judged: &self.judged, baselines: self.baselines }
    }
}

/// What a table comes to.
#[derive(Default)]
pub(super) struct Made {
    /// Figures, the same for the same seed.
    pub(super) sheets: Vec<Sheet>,
    /// The clock's readings, never the same twice.
    pub(super) times: Vec<Sheet>,
    /// File name and SVG.
    pub(super) pictures: Vec<(String, String)>,
}

impl From<Vec<Sheet>> for Made {
    fn from(sheets: Vec<Sheet>) -> Self {
        Self { sheets, ..Self::default() }
    }
}
