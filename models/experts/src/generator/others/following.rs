//! An actor that stays on its path and in its order: behind its leaders, and after agents that cross first.

use super::blocks::{Corridor, PathBlock};
use super::giving_way::behind;
use super::path_progress::PathProgress;
use super::yielding::YieldManner;
use crate::generator::motion::Sweep;
use crate::planning::STAYS_WITHIN_M;
use crate::tuning::fixed::following::{ACCELERATES_MPS2, GAP_M, HEADWAY_S};
use scene::State;

/// A motion and the blocks on its path.
pub(in crate::generator) struct Following {
    path: PathProgress,
    blocks: Vec<PathBlock>,
}

impl Following {
    /// For a motion among others; `None` if it hardly moves.
    pub(in crate::generator) fn of(own: &Sweep, others: &[&Sweep]) -> Option<Self> {
        let path = PathProgress::of(own.states(), STAYS_WITHIN_M)?;
        let corridor = Corridor::of(&path, own.size());
        let blocks = others.iter().flat_map(|other| corridor.blocks(other)).collect();
        Some(Self { path, blocks })
    }

    /// States behind the others, one per step from the window's start on, with at most this braking, m/s2.
    /// `None` if the motion does not change.
    pub(in crate::generator) fn braking(&self, brake_mps2: f64) -> Option<Vec<State>> {
        let manner = YieldManner {
            brake_mps2,
            accelerate_mps2: ACCELERATES_MPS2,
            gap_m: GAP_M,
            headway_s: HEADWAY_S,
            pace: 1.0,
            entry: 1.0,
        };
        let paced = behind(&self.path, &self.blocks.iter().collect::<Vec<_>>(), manner);
        (!paced.is_own(&self.path)).then(|| paced.states(&self.path))
    }
}
