//! Inputs of a baseline, and the recorded future.

use experts::features::AgentFeatures;
use experts::features::{NEIGHBOUR_GOAL, OWN_GOAL, OWN_GOAL_POSITION};
use experts::planning::INSTANTS;

use crate::training::{DraftPoses, Record};

/// Points at the instants, metres, x and y in the road user's frame at the start.
pub(super) type Points = [[f32; 2]; INSTANTS];

/// Removes all goals. The choice of map pieces depends on a goal's position too: see [`asks_for_a_place`].
pub(super) fn forget_goals(features: &mut AgentFeatures) {
    features.own[OWN_GOAL].fill(0.0);
    features.neighbours.iter_mut().for_each(|other| other[NEIGHBOUR_GOAL].fill(0.0));
}

/// Whether a goal's position is fixed, so that map pieces near it are included.
pub(super) fn asks_for_a_place(features: &AgentFeatures) -> bool {
    features.own[OWN_GOAL_POSITION] > 0.0
}

/// The recorded future.
pub(super) struct Truth {
    pub(super) points: Points,
    /// 1 where the recording is valid, else 0.
    pub(super) valid: [f32; INSTANTS],
}

impl Truth {
    /// Taken from the path that the recording follows most closely: its coordinates there are the most
    /// accurate.
    pub(super) fn of(record: &Record) -> Self {
        let target = &record.target;
        let aside = |across: &[f32; INSTANTS]| -> f32 {
            across.iter().zip(&target.valid).map(|(x, valid)| valid * x * x).sum()
        };
        let mode = crate::training::least(&target.across.each_ref().map(aside));
        let coordinates = std::array::from_fn(|i| [target.along[mode][i], target.across[mode][i]]);
        let placed = DraftPoses::new(record, mode, &coordinates);
        Self { points: placed.poses.map(|[x, y, ..]| [x, y]), valid: target.valid }
    }
}
