//! How drafts stand to the others, and what they do: the names of futures while they are refined.

use super::actor::Actor;
use super::background::Known;
use super::candidates::{Candidate, Origin};
use super::slot::Slot;
use super::trajectory::{PER_INSTANT, places};
use super::window::Window;
use crate::planning::world::World;
use crate::planning::{INSTANTS, Modes};
use scene::judge::{About, Manoeuvre, Trace, manoeuvre, relations};
use scene::{AgentType, HORIZON_STEPS, STEP_S, State, Vec2, wrap_angle};
use std::collections::{BTreeMap, BTreeSet};

/// More road users than these are refined at once without names; the answer has them.
const NAMED: usize = 8;

/// Everybody in the background of a window, from the step after its start on; `late` comers too.
pub(super) fn background_traces(world: &World<'_>, actors: &[Actor], late: bool) -> Vec<Trace> {
    let acting: BTreeSet<usize> = actors.iter().map(|a| a.plan.present.index).collect();
    let agents = world.scene.agents.iter().zip(&world.conditions).enumerate();
    agents
        .filter(|(i, _)| !acting.contains(i))
        .filter(|(_, (agent, conditions))| {
            late || agent.state_at(world.step).is_some() || conditions.start.position.is_some()
        })
        .map(|(_, (agent, conditions))| {
            let known = Known::of(&world.scene, agent, world.step);
            let at = |step: usize| known.at(step + 1);
            let size = conditions.size_of(agent.size);
            Trace::new(&agent.id, conditions.kind_of(agent), &size, HORIZON_STEPS, at)
        })
        .collect()
}

/// A draft as others see it: straight from instant to instant.
pub(super) fn trace_of(actor: &Actor, places: &[(Vec2, f64); INSTANTS]) -> Trace {
    let present = &actor.plan.present;
    let knot = |i: usize| match i {
        0 => (present.start.position(), present.start.heading_rad),
        i => places[i - 1],
    };
    let at = |step: usize| {
        let step = step + 1;
        let (i, share) =
            ((step - 1) / PER_INSTANT, ((step - 1) % PER_INSTANT + 1) as f64 / PER_INSTANT as f64);
        let ((from, h0), (to, h1)) = (knot(i), knot(i + 1));
        let position = from + (to - from) * share;
        let heading_rad = h0 + share * wrap_angle(h1 - h0);
        let velocity = (to - from) / (PER_INSTANT as f64 * STEP_S);
        Some(State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y })
    };
    Trace::new(&actor.id, present.agent_type, &present.size, HORIZON_STEPS, at)
}

/// A mode that an actor leads with, as others see it.
pub(super) fn leading(actor: &Actor, slot: Slot, modes: &Modes) -> Trace {
    let start = &actor.plan.present.start;
    if actor.rests {
        return trace_of(actor, &[(start.position(), start.heading_rad); INSTANTS]);
    }
    trace_of(actor, &places(&actor.plan, slot, slot.of(modes)))
}

impl Window<'_> {
    /// Names of first drafts, by actor and slot: refinement changes what a draft does by little, so that later ones
    /// are called the same until the answer says it anew.
    pub(super) fn names(&self, shown: &[Vec<Candidate>]) -> Names {
        let asked = self.actors.iter().filter(|a| a.kept.is_none()).count();
        if !self.request.stages.judged || asked > NAMED {
            return Names::default();
        }
        let each = self.actors.iter().zip(&self.drafts);
        let leading: Vec<Trace> =
            each.map(|(actor, drafts)| leading(actor, drafts.leading, &drafts.modes)).collect();
        let mut names = Names::default();
        for (i, drafts) in shown.iter().enumerate().filter(|(i, _)| self.actors[*i].kept.is_none()) {
            for draft in drafts {
                let Some(slot) = draft.origin.slot() else { continue };
                names.0.insert((i, slot), self.name(i, draft, &leading));
            }
        }
        names
    }

    /// What can be said of a draft.
    fn name(&self, i: usize, draft: &Candidate, leading: &[Trace]) -> About {
        let actor = &self.actors[i];
        let present = &actor.plan.present;
        let states = self.cut(&draft.motion.states);
        let at = |step: usize| states.get(step).copied();
        let me = Trace::new(&actor.id, present.agent_type, &present.size, states.len(), at).going_on();
        let lanes = (present.agent_type != AgentType::Pedestrian).then_some(&*self.map.graph);
        About {
            relations: relations(&me, self.traces.iter().chain(leading), self.world.step + 1),
            manoeuvre: manoeuvre(&states, present.agent_type, lanes),
            ..About::default()
        }
    }
}

/// What is said of first drafts.
#[derive(Default)]
pub(super) struct Names(BTreeMap<(usize, Slot), About>);

impl Names {
    /// Of a draft of an actor.
    pub(super) fn of(&self, actor: usize, draft: &Candidate) -> About {
        if draft.origin == Origin::Rest {
            return About { manoeuvre: Some(Manoeuvre::Stays), ..About::default() };
        }
        let slot = draft.origin.slot();
        slot.and_then(|slot| self.0.get(&(actor, slot))).cloned().unwrap_or_default()
    }
}
