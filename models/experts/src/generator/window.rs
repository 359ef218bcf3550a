//! One planning window: who acts in it and what is shown of them. What the networks make of them is
//! [`super::drafting`]'s matter, what is chosen of that [`super::decide`]'s, what happens before and after a window
//! [`super::generation`]'s.

use super::actor::{Actor, Drafts};
use super::background::Background;
use super::candidates::{Candidate, Material, learned_share, middle};
use super::covering::Cover;
use super::drafting::Batch;
use super::reacting::{Answered, Answerers, reacting};
use super::repulsion::SceneEnergy;
use super::slot::Slot;
use super::standing::{self, Names, background_traces};
use super::workers::Workers;
use super::{Generator, KnownMap, costs};
use crate::planning::pullback::Pullback;
use crate::planning::world::World;
use crate::request::{Draft, GenerateError, Intermediate, Request, ShownLast};
use crate::tuning::Tuning;
use scene::judge::{About, Trace};
use scene::motion::Trajectory;
use scene::{AgentFutures, Future, HORIZON_STEPS, Sample, State};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Most road users that get new futures in one call.
pub(super) const MOST_ACTORS: usize = 128;
/// Most road users for which every mode is shown while it refines; above, the likeliest alone.
const SHOW_ALL_BELOW: usize = 5;

/// Who acts in a window. Road users are indices into the scene's agents.
pub(super) struct Cast {
    /// Those that get new futures in any case.
    pub(super) acting: BTreeSet<usize>,
    /// Those that may answer them.
    pub(super) may_react: BTreeSet<usize>,
    /// Those among the acting that were parked when the call began: they stay.
    pub(super) parked: BTreeSet<usize>,
    /// What those among the others do, from the window's start on, that gave up their motion in an earlier window.
    pub(super) resumed: BTreeMap<usize, Vec<State>>,
}

/// One planning window of one call.
pub(super) struct Window<'g> {
    pub(super) generator: &'g Generator,
    pub(super) request: Arc<Request>,
    pub(super) map: Arc<KnownMap>,
    /// The scene at the window's start and what is asked of everybody in it.
    pub(super) world: World<'g>,
    /// From 0.
    pub(super) number: usize,
    pub(super) actors: Vec<Actor>,
    pub(super) batches: Vec<Batch>,
    /// The states on the way that those are sent to whose goal is due after its end, by agent of the scene.
    pub(super) subgoals: BTreeMap<usize, Intermediate>,
    /// Those who get no new futures; nobody where they do not count.
    pub(super) background: Background,
    /// Those among them who may give up what they do.
    pub(super) answerers: Answerers<'g>,
    /// The same as motions that drafts are named by.
    pub(super) traces: Vec<Trace>,
    /// What was said of the drafts that were seen first.
    names: Option<Names>,
    pullback: Pullback,
    /// The present sample, from 0.
    pub(super) sample: usize,
    /// Its drafts, one entry an actor.
    pub(super) drafts: Vec<Drafts>,
}

impl<'g> Window<'g> {
    /// First drafts of everybody concerned; [`Window::begin_sample`] comes next.
    pub(super) fn plan(
        generator: &'g Generator,
        request: Arc<Request>,
        map: Arc<KnownMap>,
        world: World<'g>,
        number: usize,
        cast: &Cast,
    ) -> Result<Self, GenerateError> {
        let mut window = Self {
            generator,
            request,
            map,
            world,
            number,
            actors: Vec::new(),
            batches: Vec::new(),
            subgoals: BTreeMap::new(),
            background: Background::none(),
            answerers: Answerers::none(&generator.tuning),
            traces: Vec::new(),
            names: None,
            pullback: Pullback::default(),
            sample: 0,
            drafts: Vec::new(),
        };
        window.act(cast)?;
        window.answer(cast)?;
        let tuning = &generator.tuning;
        for actor in &mut window.actors {
            actor.keeps_to_the_road = costs::starts_on_the_road(actor, &tuning.choice);
        }
        if window.request.stages.background_in_the_way {
            let Self { world, request, actors, .. } = &window;
            window.answerers = Answerers::of(world, window.workers(), request, actors, cast, tuning);
            window.background = Background::of(&window.answerers, &tuning.overlaps);
            // A call about everybody knows nobody's log after the start.
            let late = window.request.agents.is_some();
            window.traces = background_traces(&window.world, &window.actors, late);
        }
        if window.request.stages.parted && number == 0 {
            window.cover();
        }
        Ok(window)
    }

    /// Plans those that get new futures in any case.
    fn act(&mut self, cast: &Cast) -> Result<(), GenerateError> {
        let (world, later) = (&self.world, self.number > 0);
        let acting: Vec<_> = world.present.iter().filter(|p| cast.acting.contains(&p.index)).collect();
        let mut actors = self.workers().map(&acting, |who| {
            let mut actor = Actor::asked(world, who);
            if later {
                actor.goes_on(cast.parked.contains(&who.index));
            }
            actor
        });
        self.batches = self.encode(&mut actors)?;
        // In a later window it has come to the end of what was picked.
        for actor in actors.iter_mut().filter(|_| !later) {
            actor.pinned = self.request.pinned.get(&actor.id).cloned();
        }
        self.actors = actors;
        Ok(())
    }

    /// Plans those that may answer them and were asked something before.
    fn answer(&mut self, cast: &Cast) -> Result<(), GenerateError> {
        let near_m = self.tuning().reacting.near_m;
        let (world, react) = (&self.world, &self.request.react);
        let found = reacting(world, self.workers(), &self.actors, &cast.may_react, react, near_m);
        let room = MOST_ACTORS.saturating_sub(self.actors.len());
        let mut found: Vec<Actor> = found.into_iter().take(room).collect();
        let batches = self.encode(&mut found)?;
        self.batches.extend(batches);
        self.actors.extend(found);
        Ok(())
    }

    /// Makes six futures of the modes of those that were asked for.
    fn cover(&mut self) {
        let tuning = self.tuning();
        let leading: Vec<Trace> = self.workers().map(&self.indices(), |&i| {
            let actor = &self.actors[i];
            standing::leading(actor, actor.likeliest(), &actor.modes)
        });
        // Whose motions are withheld must not be told by how others go round them.
        let known = self.request.stages.background_in_the_way;
        let others: Vec<&Trace> = self.traces.iter().chain(leading.iter().filter(|_| known)).collect();
        let covers = self.workers().map(&self.indices(), |&i| {
            let actor = &self.actors[i];
            let asked = actor.kept.is_none() && !actor.keeps_still();
            asked.then(|| Cover::of(actor, &others, learned_share(actor, &tuning.middle), &tuning.duplicates))
        });
        for (actor, cover) in self.actors.iter_mut().zip(covers) {
            let Some(cover) = cover else { continue };
            actor.set_modes(actor.modes, cover.probability);
            actor.cover = Some(cover);
        }
    }

    pub(super) fn workers(&self) -> &'g Workers {
        &self.generator.workers
    }

    pub(super) fn tuning(&self) -> &'g Tuning {
        &self.generator.tuning
    }

    /// Indices of the actors.
    pub(super) fn indices(&self) -> Vec<usize> {
        (0..self.actors.len()).collect()
    }

    /// The scene's energy.
    pub(super) fn energy(&self) -> SceneEnergy<'_> {
        SceneEnergy { pullback: &self.pullback, tuning: &self.tuning().overlaps }
    }

    /// What a person has seen last of an actor: it binds the first sample of the first window.
    pub(super) fn shown_last(&self, actor: &Actor) -> Option<&ShownLast> {
        self.request.shown.get(&actor.id).filter(|_| self.sample == 0 && self.number == 0)
    }

    /// What an actor's candidates are made from.
    pub(super) fn material(&self, i: usize) -> Material<'_> {
        let tuning = &self.tuning().middle;
        let (actor, drafts) = (&self.actors[i], &self.drafts[i]);
        let shown = self.shown_last(actor);
        Material { actor, drafts, window: self.number, tuning, shown }
    }

    /// What stands after a refinement step.
    pub(super) fn draft(&self, step: usize) -> Draft {
        Draft {
            window: self.number,
            sample: self.sample,
            step,
            steps: self.request.steps,
            agents: self.actors.iter().map(|actor| actor.id.clone()).collect(),
        }
    }

    /// The present drafts as futures that can be shown.
    pub(super) fn drafted(&mut self) -> Sample {
        let all = self.request.stream_all || self.actors.len() < SHOW_ALL_BELOW;
        let count = if all { self.request.modes } else { 1 };
        let shown: Vec<Vec<Candidate>> =
            self.workers().map(&self.indices(), |&i| self.material(i).alternatives(count));
        let names = self.names.take().unwrap_or_else(|| self.names(&shown));
        let futures = shown.iter().enumerate().map(|(i, alternatives)| {
            let actor = &self.actors[i];
            let middle = middle(actor);
            let is_middle = |c: &Candidate| middle.is_some() && c.origin.slot() == middle;
            let chosen = alternatives.iter().position(is_middle).unwrap_or(0);
            let mut futures = self.futures(chosen, alternatives);
            for (future, draft) in futures.modes.iter_mut().zip(alternatives) {
                future.about = names.of(i, draft);
            }
            (actor.id.clone(), futures)
        });
        let agents = futures.collect();
        self.names = Some(names);
        Sample { agents, score: serde_json::Value::Null }
    }

    /// Alternatives as futures, cut to what was asked for.
    pub(super) fn futures(&self, chosen: usize, alternatives: &[Candidate]) -> AgentFutures {
        let total: f64 = alternatives.iter().map(|c| c.probability).sum();
        let modes = alternatives.iter().map(|c| Future {
            anchor: c.origin.slot().map(Slot::number),
            probability: if total > 0.0 { c.probability / total } else { 1.0 / alternatives.len() as f64 },
            first_step: self.world.step + 1,
            states: self.cut(&c.motion.states),
            about: About::default(),
        });
        AgentFutures::of(chosen, modes.collect())
    }

    /// The future of somebody who gave up what it did.
    pub(super) fn answer_of(&self, answered: &Answered) -> AgentFutures {
        let left = self.steps_left().saturating_sub(answered.enters);
        let states = answered.states.iter().take(left).copied().collect();
        let future = Future::bare(1.0, self.world.step + answered.enters + 1, states);
        AgentFutures { reaction: answered.reaction.clone(), ..AgentFutures::of(0, vec![future]) }
    }

    fn steps_left(&self) -> usize {
        self.request.start_step + self.request.horizon_steps - self.world.step
    }

    /// The asked-for part of a trajectory, the start left out.
    pub(super) fn cut(&self, states: &Trajectory) -> Vec<State> {
        let left = self.steps_left();
        states.iter().skip(1).take(left.min(HORIZON_STEPS)).map(State::from).collect()
    }
}
