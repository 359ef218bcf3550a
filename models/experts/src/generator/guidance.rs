//! Guidance: moves conflicting drafts of a chosen scene out of each other's way.

use super::actor::PlannedActor;
use super::candidates::{CandidateOrigin, MotionCandidate};
use super::repulsion::{Outline, SceneEnergy, Terms};
use super::slot::Slot;
use super::trajectory::{Rollout, places, to_trajectory};
use crate::planning::{Modes, Residual};
use crate::tuning::GuidanceTuning;

/// A further candidate per mode of an actor that something repels, with the others at their chosen motions.
pub(super) fn guided(
    energy: &SceneEnergy<'_>,
    tuning: &GuidanceTuning,
    actor: &PlannedActor,
    modes: &Modes,
    candidates: &[MotionCandidate],
    others: &[&Outline],
) -> Vec<MotionCandidate> {
    let guide = |candidate: &MotionCandidate| {
        let CandidateOrigin::Mode(slot) = candidate.origin else { return None };
        let motion = out_of_the_way(energy, tuning, actor, slot, slot.of(modes), others)?;
        Some(MotionCandidate { probability: 0.0, origin: CandidateOrigin::Guided(slot), motion })
    };
    candidates.iter().filter_map(guide).collect()
}

/// The draft after steps down the energy gradient; `None` if nothing repels it.
fn out_of_the_way(
    energy: &SceneEnergy<'_>,
    tuning: &GuidanceTuning,
    actor: &PlannedActor,
    slot: Slot,
    residual: &Residual,
    others: &[&Outline],
) -> Option<Rollout> {
    let share = tuning.share as f32;
    let mut moved = *residual;
    let mut repelled = false;
    for _ in 0..tuning.steps as usize {
        // The result only has to clear the boxes; the steps towards it also weigh the road.
        let places = places(&actor.plan, slot, &moved);
        if energy.at(actor, &places, others, Terms::Boxes).0 == 0.0 {
            break;
        }
        let Some((_, downhill)) = energy.downhill(actor, slot, &moved, others, Terms::All) else { break };
        repelled = true;
        for (value, step) in moved.iter_mut().zip(downhill) {
            *value += share * step;
        }
    }
    repelled.then(|| to_trajectory(&actor.plan, slot, &moved))
}
