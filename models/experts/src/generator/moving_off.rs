//! Decides which vehicles at rest on a lane move off, and when. The signal and the agent ahead decide first,
//! then whether the vehicle already rolls, then the learned decision.

use super::actor::PlannedActor;
use super::motion::KeptMotion;
use super::window_setting::WindowSetting;
use crate::planning::STAYS_WITHIN_M;
use crate::planning::anchors::Anchor;
use crate::planning::world::{AgentAtStart, World};
use crate::tuning::fixed::moving_off::{AT_LINE_M, IN_QUEUE_M, ROLLS_MPS};
use scene::routes::speed::leader;
use scene::{AgentType, STANDING_MPS, State};

/// Steps from the start of the agent ahead to that of the next: two seconds, as in queues at signals.
const NEXT_STEPS: usize = 20;

/// Decision for an agent at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Departure {
    Stays,
    /// Moves off at this step.
    Moves(usize),
}

/// Decides again whether each of these actors stays at rest. An agent is decided after the one ahead of it.
pub(super) fn decide_departures(setting: &WindowSetting<'_>, actors: &mut [PlannedActor]) {
    let mut known: Vec<Option<Departure>> = vec![None; actors.len()];
    for i in 0..actors.len() {
        departure(&setting.world, actors, i, &mut known);
    }
    for (actor, departure) in actors.iter_mut().zip(known) {
        if !may_move_off(actor) {
            continue;
        }
        match departure {
            Some(Departure::Moves(step)) => {
                actor.rests = false;
                actor.plan.departs = step;
            }
            Some(Departure::Stays) => actor.rests = true,
            None => {}
        }
    }
}

/// Whether it is a vehicle at rest on a lane with neither a goal nor a via point.
fn may_move_off(actor: &PlannedActor) -> bool {
    let plan = &actor.plan;
    plan.present.agent_type == AgentType::Vehicle
        && plan.is_free()
        && plan.present.start.speed_mps() < STANDING_MPS
        && !actor.stays_parked
        && !actor.is_parked()
}

fn departure(
    world: &World<'_>,
    actors: &[PlannedActor],
    i: usize,
    known: &mut Vec<Option<Departure>>,
) -> Departure {
    if let Some(departure) = known[i] {
        return departure;
    }
    let actor = &actors[i];
    let learned = if actor.rests { Departure::Stays } else { Departure::Moves(0) };
    // Agents in a ring wait for each other, so the learned decision applies.
    known[i] = Some(learned);
    let decided =
        if may_move_off(actor) { by_the_road(world, actors, i, known).unwrap_or(learned) } else { learned };
    known[i] = Some(decided);
    decided
}

/// The decision by signal, agent ahead and own speed, in this order.
fn by_the_road(
    world: &World<'_>,
    actors: &[PlannedActor],
    i: usize,
    known: &mut Vec<Option<Departure>>,
) -> Option<Departure> {
    let (actor, plan) = (&actors[i], &actors[i].plan);
    // The wait at a red signal that turns green already includes the delay of the queue.
    if plan.sets_off() {
        return Some(Departure::Moves(0));
    }
    let slot = actor.likeliest().index();
    if plan.lights[slot].first().is_some_and(|gate| gate.is_red(0) && gate.line_m() < AT_LINE_M) {
        return Some(Departure::Stays);
    }
    let obstacles = world.obstacles(plan.present.index);
    let ahead = |anchor: &Anchor| leader(&anchor.path, plan.present.size.length_m, &obstacles);
    let queued = plan
        .anchors
        .iter()
        .filter_map(ahead)
        .find(|ahead| ahead.gap_m < IN_QUEUE_M && ahead.speed_mps < STANDING_MPS);
    if let Some(ahead) = queued {
        let who = world.present.iter().filter(|p| p.index != plan.present.index).nth(ahead.index)?;
        let of_actor = actors.iter().position(|a| a.plan.present.index == who.index);
        let first = match of_actor {
            Some(ahead) => departure(world, actors, ahead, known),
            None => as_kept(world, who),
        };
        return Some(match first {
            Departure::Moves(step) => Departure::Moves(step + NEXT_STEPS),
            Departure::Stays => Departure::Stays,
        });
    }
    let rolls = plan.present.start.speed_mps() > ROLLS_MPS;
    rolls.then_some(Departure::Moves(0))
}

/// The decision for an agent that keeps its motion.
fn as_kept(world: &World<'_>, who: &AgentAtStart) -> Departure {
    let left = |state: &State| (state.position() - who.start.position()).norm() > STAYS_WITHIN_M;
    KeptMotion::states(world, who).iter().position(left).map_or(Departure::Stays, Departure::Moves)
}
