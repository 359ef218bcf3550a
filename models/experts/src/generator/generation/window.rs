//! One planning window: the stages from its cast to its decisions, each a function of the previous stage's
//! result.

use crate::generator::actor::PlannedActor;
use crate::generator::calibration::calibrated;
use crate::generator::candidates::{MotionCandidate, learned_share, middle};
use crate::generator::cast::{MOST_ACTORS, WindowCast};
use crate::generator::decide::decide;
use crate::generator::decisions::Decisions;
use crate::generator::diversity::DiverseModes;
use crate::generator::draft_relations::DraftRelations;
use crate::generator::draft_traces::trace_of_mode;
use crate::generator::drafting::{Batch, encode, first_drafts, refine};
use crate::generator::drafts::Drafts;
use crate::generator::joint_drafts::JointDrafts;
use crate::generator::moving_off::decide_departures;
use crate::generator::others::{Others, Reacted, replanned};
use crate::generator::road_rules::starts_on_the_road;
use crate::generator::slot::Slot;
use crate::generator::window_setting::WindowSetting;
use crate::request::{Draft, GenerateError, Intermediate, React};
use scene::judge::{About, Trace};
use scene::{AgentFutures, AgentType, Future, Sample};
use std::collections::{BTreeMap, BTreeSet};

/// With fewer actors than this, a draft shows every mode during refinement; otherwise only the likeliest.
const SHOW_ALL_BELOW: usize = 5;

/// One planning window of one call.
pub(super) struct PlanningWindow<'g> {
    pub(super) setting: WindowSetting<'g>,
    /// Subgoals of goals that are due after the window's end, by agent of the scene.
    pub(super) subgoals: BTreeMap<usize, Intermediate>,
    plan: WindowActors,
    /// The agents that do not act; none if the request ignores them.
    others: Others<'g>,
    drafted: SampleDrafts,
}

/// The actors of a window.
struct WindowActors {
    actors: Vec<PlannedActor>,
    /// Actors grouped into network calls.
    batches: Vec<Batch>,
    /// The changes that make the modes of an actor six different futures, one entry per actor.
    diverse: Vec<Option<DiverseModes>>,
}

/// The drafts of the present sample.
#[derive(Default)]
struct SampleDrafts {
    /// Number of the sample, from 0.
    sample: usize,
    /// One entry per actor.
    drafts: Vec<Drafts>,
    /// Relations of the drafts that were shown first.
    relations: Option<DraftRelations>,
}

impl<'g> PlanningWindow<'g> {
    /// First drafts of every actor; [`PlanningWindow::begin_sample`] comes next.
    pub(super) fn plan(setting: WindowSetting<'g>, cast: &WindowCast) -> Result<Self, GenerateError> {
        let tuning = setting.tuning();
        let mut plan = WindowActors::of(&setting, cast)?;
        let mut others = Others::none(tuning);
        if setting.request.stages.background_in_the_way {
            let acting: BTreeSet<usize> = plan.actors.iter().map(|a| a.plan.present.index).collect();
            others = Others::of(&setting.world, setting.workers(), &setting.request, &acting, cast, tuning);
        }
        if setting.request.stages.parted && setting.number == 0 {
            plan.diversify(&setting, &others);
        }
        Ok(Self { setting, subgoals: BTreeMap::new(), plan, others, drafted: SampleDrafts::default() })
    }

    /// The actors.
    pub(super) fn actors(&self) -> &[PlannedActor] {
        &self.plan.actors
    }

    /// Fresh drafts for a sample.
    pub(super) fn begin_sample(&mut self, sample: usize) -> Result<(), GenerateError> {
        let WindowActors { actors, batches, diverse } = &self.plan;
        self.drafted.drafts = first_drafts(&self.setting, actors, batches, diverse, sample)?;
        self.drafted.sample = sample;
        Ok(())
    }

    /// One refinement step for every actor.
    pub(super) fn refine(&mut self, step: usize) -> Result<(), GenerateError> {
        let drafts = refine(self.joint(), &self.plan.batches, step)?;
        self.drafted.drafts = drafts;
        Ok(())
    }

    /// One future per actor, and the reactions of the others.
    pub(super) fn decide(&self) -> Decisions {
        decide(self.joint())
    }

    fn joint(&self) -> JointDrafts<'_> {
        let SampleDrafts { sample, drafts, .. } = &self.drafted;
        let (setting, actors, others) = (&self.setting, &self.plan.actors[..], &self.others);
        JointDrafts { setting, actors, drafts, others, sample: *sample }
    }

    /// The state of the window after a refinement step.
    pub(super) fn draft(&self, step: usize) -> Draft {
        Draft {
            window: self.setting.number,
            sample: self.drafted.sample,
            step,
            steps: self.setting.request.steps,
            agents: self.actors().iter().map(|actor| actor.id.clone()).collect(),
        }
    }

    /// The present drafts as futures that can be shown.
    pub(super) fn drafted(&mut self) -> Sample {
        let (request, joint) = (&self.setting.request, self.joint());
        let all = request.stream_all || joint.actors.len() < SHOW_ALL_BELOW;
        let count = if all { request.modes } else { 1 };
        let shown: Vec<Vec<MotionCandidate>> =
            self.setting.workers().map(&joint.indices(), |&i| joint.material(i).alternatives(count));
        let known = self.drafted.relations.as_ref();
        let new = known.is_none().then(|| DraftRelations::of(&joint, &shown));
        let relations = known.or(new.as_ref());
        let futures = shown.iter().enumerate().map(|(i, alternatives)| {
            let actor = &joint.actors[i];
            let middle = middle(actor);
            let is_middle = |c: &MotionCandidate| middle.is_some() && c.origin.slot() == middle;
            let chosen = alternatives.iter().position(is_middle).unwrap_or(0);
            let mut futures = self.futures(actor, chosen, alternatives);
            for (future, draft) in futures.modes.iter_mut().zip(alternatives) {
                future.about = relations.map(|relations| relations.about(i, draft)).unwrap_or_default();
            }
            (actor.id.clone(), futures)
        });
        let agents = futures.collect();
        if new.is_some() {
            self.drafted.relations = new;
        }
        Sample { agents, score: serde_json::Value::Null }
    }

    /// Alternatives of an actor as futures, cut to the requested steps.
    pub(super) fn futures(
        &self,
        actor: &PlannedActor,
        chosen: usize,
        alternatives: &[MotionCandidate],
    ) -> AgentFutures {
        let tuning = &self.setting.tuning().probability;
        let plan = &actor.plan;
        let walks = plan.present.agent_type == AgentType::Pedestrian;
        let sure = plan.target.position.is_some();
        let probability =
            calibrated(alternatives.iter().map(|c| c.probability).collect(), (sure, walks), tuning);
        let modes = alternatives.iter().zip(probability).map(|(c, probability)| Future {
            anchor: c.origin.slot().map(Slot::number),
            probability,
            first_step: self.setting.world.step + 1,
            states: self.setting.cut(&c.motion.states),
            about: About::default(),
        });
        AgentFutures::of(chosen, modes.collect())
    }

    /// The future of an agent that reacts.
    pub(super) fn reaction(&self, reacted: &Reacted) -> AgentFutures {
        let future = reacted.future(&self.setting);
        AgentFutures { reaction: reacted.reaction.clone(), ..AgentFutures::of(0, vec![future]) }
    }
}

impl WindowActors {
    /// Plans the actors of a window: first the acting agents, then those that react by replanning.
    fn of(setting: &WindowSetting<'_>, cast: &WindowCast) -> Result<Self, GenerateError> {
        let (world, workers, later) = (&setting.world, setting.workers(), setting.number > 0);
        let acting: Vec<_> = world.present.iter().filter(|p| cast.acting.contains(&p.index)).collect();
        let mut actors = workers.map(&acting, |who| {
            let mut actor = PlannedActor::asked(world, who);
            if later {
                actor.goes_on(cast.parked.contains(&who.index));
            }
            actor
        });
        let mut batches = encode(setting, &mut actors, 0)?;
        decide_departures(setting, &mut actors);
        // In a later window, an actor is at the end of its picked future.
        for actor in actors.iter_mut().filter(|_| !later) {
            actor.pinned = setting.request.pinned.get(&actor.id).cloned();
        }
        let tuning = setting.tuning();
        // In a run all others may react, so the names in the request do not restrict them.
        let named = matches!(setting.request.react, React::Only(_)) && !setting.request.under_way;
        let found = replanned(world, workers, &actors, &cast.may_react, named, tuning.reacting.near_m);
        let room = MOST_ACTORS.saturating_sub(actors.len());
        let mut found: Vec<PlannedActor> = found.into_iter().take(room).collect();
        batches.extend(encode(setting, &mut found, actors.len())?);
        actors.extend(found);
        for actor in &mut actors {
            actor.keeps_to_the_road = starts_on_the_road(actor, &tuning.choice);
        }
        let diverse = actors.iter().map(|_| None).collect();
        Ok(Self { actors, batches, diverse })
    }

    /// Makes the modes of the actors that the call regenerates six different futures.
    fn diversify(&mut self, setting: &WindowSetting<'_>, others: &Others<'_>) {
        let (tuning, workers) = (setting.tuning(), setting.workers());
        let leading: Vec<Trace> =
            workers.map(&self.actors, |actor| trace_of_mode(actor, actor.likeliest(), &actor.modes));
        // Withheld motions must not influence the drafts of others.
        let known = setting.request.stages.background_in_the_way;
        let traces: Vec<&Trace> = others.traces().chain(leading.iter().filter(|_| known)).collect();
        let diverse = workers.map(&self.actors, |actor| {
            let asked = actor.kept.is_none() && !actor.keeps_still();
            let share = learned_share(actor, &tuning.middle);
            asked.then(|| DiverseModes::of(actor, &traces, share, &tuning.duplicates))
        });
        for (actor, diverse) in self.actors.iter_mut().zip(&diverse) {
            if let Some(diverse) = diverse {
                actor.set_modes(actor.modes, diverse.probability);
            }
        }
        self.diverse = diverse;
    }
}
