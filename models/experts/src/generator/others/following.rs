//! An actor that stays on its path and in its place: behind those ahead, after those that cross first.

use super::blocks::{Corridor, PathBlock};
use super::giving_way::behind;
use super::path_progress::PathProgress;
use super::yielding::YieldManner;
use crate::generator::motion::Sweep;
use crate::planning::STAYS_WITHIN_M;
use crate::tuning::fixed::following::{ACCELERATES_MPS2, GAP_M, HEADWAY_S};
use scene::State;

/// A motion and what is in the way on its path.
pub(in crate::generator) struct Following {
    path: PathProgress,
    blocks: Vec<PathBlock>,
}

impl Following {
    /// Of a motion among others; `None` where it hardly goes anywhere.
    pub(in crate::generator) fn of(own: &Sweep, others: &[&Sweep]) -> Option<Self> {
        let path = PathProgress::of(own.states(), STAYS_WITHIN_M)?;
        let corridor = Corridor::of(&path, own.size());
        let blocks = others.iter().flat_map(|other| corridor.blocks(other)).collect();
        Some(Self { path, blocks })
    }

    /// States, one a step from the window's start on, driven behind the others with at most this braking, m/s2; `None`
    /// where the motion stays as it is.
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
