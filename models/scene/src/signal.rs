//! Traffic signals: one state a step for each controlled lane.

use crate::Vec2;
use serde::{Deserialize, Serialize};

/// State of a signal head, the nine states of WOMD's `TrafficSignalLaneState`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum SignalState {
    #[default]
    Unknown,
    ArrowStop,
    ArrowCaution,
    ArrowGo,
    Stop,
    Caution,
    Go,
    FlashingStop,
    FlashingCaution,
}

impl SignalState {
    /// Traffic on this lane must stop if it can.
    pub fn is_stop(self) -> bool {
        matches!(self, Self::Stop | Self::ArrowStop | Self::FlashingStop)
    }

    /// Traffic on this lane should stop when it can do so comfortably.
    pub fn is_caution(self) -> bool {
        matches!(self, Self::Caution | Self::ArrowCaution)
    }
}

/// The signal of one lane (or signalled crosswalk) over the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Signal {
    /// Lane (or crosswalk) that obeys it.
    pub lane: String,
    /// Where to stop, when the source says it.
    pub stop: Option<Vec2>,
    /// Height of the stop point, when the source has heights.
    pub stop_z_m: Option<f64>,
    /// Run-length: from this step on, this state. First steps rise; never empty.
    pub runs: Vec<(usize, SignalState)>,
}

impl Signal {
    /// State at a step; unknown before the first run.
    pub fn at(&self, step: usize) -> SignalState {
        self.runs.iter().rev().find(|(first, _)| *first <= step).map_or(SignalState::Unknown, |r| r.1)
    }

    /// What it showed last at a step, and how many steps ago that began; unknown before anything is known.
    pub fn last_known(&self, step: usize) -> (SignalState, usize) {
        let mut past = self.runs.iter().rev().filter(|(first, _)| *first <= step);
        let known = past.clone().find(|(_, state)| *state != SignalState::Unknown);
        known.or(past.next()).map_or((SignalState::Unknown, 0), |(first, state)| (*state, step - first))
    }
}
