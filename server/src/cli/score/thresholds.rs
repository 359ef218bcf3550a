//! Thresholds of a score, as flags.

use crate::cli::values::within;
use clap::Args;
use scene::score::{PairChoice, ScoreInput, Threshold, Thresholds};

/// Flags of scoring.
#[derive(Args, Clone, Debug)]
pub struct Counting {
    /// Pairs of road users to check.
    #[arg(long, value_enum, default_value_t)]
    pub pairs: PairChoice,
    /// Collision: intersection over union of two boxes above this share; 0 counts any overlap.
    #[arg(long, value_name = "SHARE", default_value_t = Thresholds::default().iou, value_parser = ranged(Thresholds::IOU, ""))]
    pub iou: f64,
    /// Near miss: time to collision (TTC) below this, s.
    #[arg(long, value_name = "SECONDS", default_value_t = Thresholds::default().ttc_s, value_parser = ranged(Thresholds::TTC_S, "seconds"))]
    pub ttc: f64,
    /// Near miss: gap below this, m.
    #[arg(long, value_name = "METRES", default_value_t = Thresholds::default().gap_m, value_parser = ranged(Thresholds::GAP_M, "metres"))]
    pub gap: f64,
}

impl Counting {
    /// The input with these thresholds.
    pub fn applied<'a>(&self, mut input: ScoreInput<'a>) -> ScoreInput<'a> {
        input.pairs = self.pairs;
        input.thresholds = Thresholds { iou: self.iou, ttc_s: self.ttc, gap_m: self.gap, ..input.thresholds };
        input
    }
}

/// Parses a number in the range of a threshold.
fn ranged(
    of: Threshold,
    unit: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    within(of.range.0, of.range.1, unit)
}
