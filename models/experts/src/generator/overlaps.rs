//! Resolves overlaps of drawn drafts without the networks.

use super::actor::PlannedActor;
use super::drafts::Drafts;
use super::motion::Places;
use super::repulsion::{Outline, SceneEnergy, Terms, leading_outlines};
use super::slot::Slot;
use super::trajectory::places;
use crate::planning::Residual;
use crate::tuning::fixed::overlaps::STEP_SHARES;

/// Gradient steps from the leading drafts, one actor after the other, so that of two conflicting actors the
/// second sees the first one's move. A step that does not lower the energy is not taken. The drafts do not
/// change: the result is one more candidate per actor, [`Drafts::settled`].
pub(super) fn resolve_overlaps(
    energy: &SceneEnergy<'_>,
    actors: &[PlannedActor],
    drafts: &mut [Drafts],
    background: &[Outline],
) {
    let mut outlines = leading_outlines(actors, drafts, energy.tuning);
    // The result must not depend on the order of road users in the scene.
    let mut order: Vec<usize> = (0..actors.len()).collect();
    order.sort_by(|a, b| actors[*a].id.cmp(&actors[*b].id));
    // An actor that found no improving step tries again only after a nearby actor has moved.
    let may_look: Vec<bool> = actors.iter().map(|actor| !actor.keeps_still()).collect();
    let mut looks = may_look.clone();
    for _ in 0..energy.tuning.rounds as usize {
        for &i in &order {
            if !std::mem::take(&mut looks[i]) {
                continue;
            }
            let actor = &actors[i];
            let Drafts { leading, modes, settled, .. } = &drafts[i];
            let others = outlines.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
            let others: Vec<&Outline> = others.chain(background).collect();
            let from = settled.as_ref().unwrap_or(leading.of(modes));
            let Some((residual, places)) = step_downhill(energy, actor, *leading, from, &others) else {
                continue;
            };
            drafts[i].settled = Some(residual);
            let now = Outline::new(&places, &actor.plan.present.size, energy.tuning);
            let before = std::mem::replace(&mut outlines[i], now);
            for (k, looks) in looks.iter_mut().enumerate() {
                let near = k == i || outlines[k].near(&outlines[i]) || outlines[k].near(&before);
                *looks |= may_look[k] && near;
            }
        }
    }
}

/// A gradient step from a draft: the longest of a few that lowers the energy.
fn step_downhill(
    energy: &SceneEnergy<'_>,
    actor: &PlannedActor,
    slot: Slot,
    residual: &Residual,
    others: &[&Outline],
) -> Option<(Residual, Places)> {
    let (before, downhill) = energy.downhill(actor, slot, residual, others, Terms::All)?;
    let longest = energy.tuning.share as f32;
    STEP_SHARES.into_iter().find_map(|part| {
        let share = part * longest;
        let moved = std::array::from_fn(|i| residual[i] + share * downhill[i]);
        let places = places(&actor.plan, slot, &moved);
        let lower = energy.at(actor, &places, others, Terms::All).0 < before;
        lower.then(|| (moved, places.map(Some)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use crate::planning::RESIDUAL;
    use crate::planning::pullback::Pullback;
    use crate::tuning::SHIPPED;
    use scene::{Goal, Vec2};

    #[test]
    fn two_on_one_way_part_and_who_is_far_stays() {
        let pullback = Pullback::default();
        let energy = SceneEnergy { pullback: &pullback, tuning: &SHIPPED.overlaps };
        let ride = |id: &str, y: f64| {
            let mut plan = car_on_a_street(8.0, Goal::default());
            for anchor in &mut plan.anchors {
                let moved = anchor.path.points().iter().map(|p| p + Vec2::new(0.0, y));
                anchor.path = scene::routes::Polyline::new(moved);
            }
            PlannedActor::new(id.into(), plan, None)
        };
        let actors = [ride("a", 0.0), ride("b", 1.2), ride("c", 40.0)];
        let mut drafts = vec![Drafts::of(&actors[0], Slot::FIRST); 3];
        resolve_overlaps(&energy, &actors, &mut drafts, &[]);
        assert!(drafts[0].settled.is_some() && drafts[2].settled.is_none());
        let across = |i: usize| {
            let settled = drafts[i].settled.unwrap_or([0.0; RESIDUAL]);
            settled[scene::KNOTS..].iter().sum::<f32>()
        };
        assert!(across(0) < 0.0 && across(1) >= 0.0, "{} {}", across(0), across(1));
    }
}
