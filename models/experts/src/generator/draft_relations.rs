//! Relations of first drafts to other agents, and their manoeuvres, which the editor shows during refinement.

use super::candidates::{CandidateOrigin, MotionCandidate};
use super::draft_traces::trace_of_mode;
use super::joint_drafts::JointDrafts;
use super::slot::Slot;
use scene::AgentType;
use scene::judge::{About, Manoeuvre, Trace, manoeuvre, relations};
use std::collections::BTreeMap;

/// Above this number of regenerated agents, drafts have no relations; the answer has them.
const MOST_NAMED: usize = 8;

/// Relations and manoeuvres of first drafts, by actor and slot. Refinement changes a draft by little, so
/// later drafts keep them until the answer computes them again.
#[derive(Default)]
pub(super) struct DraftRelations(BTreeMap<(usize, Slot), About>);

impl DraftRelations {
    /// For the shown drafts, one list per actor.
    pub(super) fn of(drafts: &JointDrafts<'_>, shown: &[Vec<MotionCandidate>]) -> Self {
        let actors = drafts.actors;
        let asked = actors.iter().filter(|a| a.kept.is_none()).count();
        let mut relations = Self::default();
        if !drafts.setting.request.stages.judged || asked > MOST_NAMED {
            return relations;
        }
        let each = actors.iter().zip(drafts.drafts);
        let leading: Vec<Trace> =
            each.map(|(actor, drafts)| trace_of_mode(actor, drafts.leading, &drafts.modes)).collect();
        for (i, alternatives) in shown.iter().enumerate().filter(|(i, _)| actors[*i].kept.is_none()) {
            for draft in alternatives {
                let Some(slot) = draft.origin.slot() else { continue };
                relations.0.insert((i, slot), about(drafts, i, draft, &leading));
            }
        }
        relations
    }

    /// Relations and manoeuvre of one draft of an actor.
    pub(super) fn about(&self, actor: usize, draft: &MotionCandidate) -> About {
        if draft.origin == CandidateOrigin::Rest {
            return About { manoeuvre: Some(Manoeuvre::Stays), ..About::default() };
        }
        let slot = draft.origin.slot();
        slot.and_then(|slot| self.0.get(&(actor, slot))).cloned().unwrap_or_default()
    }
}

fn about(drafts: &JointDrafts<'_>, i: usize, draft: &MotionCandidate, leading: &[Trace]) -> About {
    let (actor, setting) = (&drafts.actors[i], drafts.setting);
    let present = &actor.plan.present;
    let states = setting.cut(&draft.motion.states);
    let at = |step: usize| states.get(step).copied();
    let me = Trace::new(&actor.id, present.agent_type, &present.size, states.len(), at).going_on();
    let lanes = (present.agent_type != AgentType::Pedestrian).then_some(&*setting.map.graph);
    About {
        relations: relations(&me, drafts.others.traces().chain(leading), setting.world.step + 1),
        manoeuvre: manoeuvre(&states, present.agent_type, lanes),
        ..About::default()
    }
}
