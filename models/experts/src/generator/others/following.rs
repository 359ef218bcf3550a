//! An actor that stays on its path and in its place: behind those ahead, after those that cross first.

use super::blocks::{Corridor, PathBlock};
use super::giving_way::behind;
use super::path_progress::PathProgress;
use super::yielding::YieldManner;
use crate::generator::motion::Sweep;
use crate::planning::STAYS_WITHIN_M;
use crate::tuning::fixed::following::{ACCELERATES_MPS2, GAP_M, HEADWAY_S};
use scene::State;

/// States of a motion, one a step from the window's start on, driven behind these others with at most this braking, m/s2;
/// `None` where it stays as it is or hardly goes anywhere.
pub(in crate::generator) fn following(own: &Sweep, others: &[&Sweep], brake_mps2: f64) -> Option<Vec<State>> {
    let path = PathProgress::of(own.states(), STAYS_WITHIN_M)?;
    let corridor = Corridor::of(&path, own.size());
    let blocks: Vec<PathBlock> = others.iter().flat_map(|other| corridor.blocks(other)).collect();
    let manner = YieldManner {
        brake_mps2,
        accelerate_mps2: ACCELERATES_MPS2,
        gap_m: GAP_M,
        headway_s: HEADWAY_S,
        pace: 1.0,
    };
    let paced = behind(&path, &blocks.iter().collect::<Vec<_>>(), manner);
    (!paced.is_own(&path)).then(|| paced.states(&path))
}
