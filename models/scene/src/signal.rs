//! Traffic signals: one state per step for each controlled lane.

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
    /// Whether traffic on this lane must stop if it can.
    pub fn is_stop(self) -> bool {
        matches!(self, Self::Stop | Self::ArrowStop | Self::FlashingStop)
    }

    /// Whether traffic on this lane should stop if it can do so comfortably.
    pub fn is_caution(self) -> bool {
        matches!(self, Self::Caution | Self::ArrowCaution)
    }
}

/// The signal of one lane (or signalled crosswalk) over the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Signal {
    /// Lane (or crosswalk) that obeys it.
    pub lane: String,
    /// Stop point, if the source gives one.
    pub stop: Option<Vec2>,
    /// Height of the stop point, if the source has heights.
    pub stop_z_m: Option<f64>,
    /// Run-length encoding: first step and state. First steps rise; never empty.
    pub runs: Vec<(usize, SignalState)>,
}

impl Signal {
    /// State at a step; unknown before the first run.
    pub fn at(&self, step: usize) -> SignalState {
        self.runs.iter().rev().find(|(first, _)| *first <= step).map_or(SignalState::Unknown, |r| r.1)
    }

    /// The last known state at a step, and the number of steps since it began; unknown before the first known
    /// state.
    pub fn last_known(&self, step: usize) -> (SignalState, usize) {
        let mut past = self.runs.iter().rev().filter(|(first, _)| *first <= step);
        let known = past.clone().find(|(_, state)| *state != SignalState::Unknown);
        known.or(past.next()).map_or((SignalState::Unknown, 0), |(first, state)| (*state, step - first))
    }
}
