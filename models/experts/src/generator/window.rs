//! One planning window: first drafts of everybody concerned and refinement steps. What is chosen of them is
//! [`super::decide`]'s matter, what happens before and after a window [`super::generation`]'s.

use super::actor::{Actor, Drafts, by_probability};
use super::background::Background;
use super::candidates::{Candidate, Material, leads_by_probability, learned_share, middle};
use super::covering::Cover;
use super::noise::Key;
use super::overlaps::resolve_overlaps;
use super::reacting::{Answered, Answerers, reacting};
use super::repulsion::{SceneEnergy, repulsions};
use super::slot::Slot;
use super::standing::{self, Names, background_traces};
use super::trajectory::may_rest;
use super::widening::widen;
use super::workers::Workers;
use super::{Generator, KnownMap, costs, duplicate_modes};
use crate::features::stays_in_the_world;
use crate::net::{Context, InitialOutput, NetError, Prepared, schedule};
use crate::planning::pullback::Pullback;
use crate::planning::world::World;
use crate::planning::{MODES, Modes, RESIDUAL};
use crate::request::{Draft, GenerateError, Intermediate, Request, Shown, ShownLast};
use crate::tuning::Tuning;
use crate::weights::EXPERTS;
use scene::judge::{About, Trace};
use scene::motion::Trajectory;
use scene::{AgentFutures, AgentId, AgentType, Future, HORIZON_STEPS, Sample, State};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Most road users that get new futures in one call.
pub(super) const MOST_ACTORS: usize = 128;
/// Most road users for which every mode is shown while it refines; above, the likeliest alone.
const SHOW_ALL_BELOW: usize = 5;
/// Fewest road users of a type in one network call, so that cutting them over threads pays.
const FEWEST_IN_BATCH: usize = 4;
/// What is more likely than this to stay does.
const STAYS_ABOVE: f64 = 0.5;

/// Road users of one expert that run in one network call.
struct Batch {
    agent_type: AgentType,
    actors: Vec<usize>,
    prepared: Prepared,
}

impl From<NetError> for GenerateError {
    fn from(error: NetError) -> Self {
        Self::Expert(error.to_string())
    }
}

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
    generator: &'g Generator,
    pub(super) request: Arc<Request>,
    pub(super) map: Arc<KnownMap>,
    /// The scene at the window's start and what is asked of everybody in it.
    pub(super) world: World<'g>,
    /// From 0.
    number: usize,
    pub(super) actors: Vec<Actor>,
    batches: Vec<Batch>,
    /// The states on the way that those are sent to whose goal is due after its end, by agent of the scene.
    pub(super) subgoals: BTreeMap<usize, Intermediate>,
    /// Those who get no new futures; nobody where they do not count.
    pub(super) background: Background,
    /// Those among them who may give up what they do.
    pub(super) answerers: Answerers<'g>,
    /// The same as motions that drafts are named by.
    pub(super) traces: Vec<Trace>,
    /// What is said of the sample's first drafts.
    names: Names,
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
            names: Names::default(),
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
            window.answerers = Answerers::of(world, request, actors, cast, tuning);
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
        for actor in &mut actors {
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

    /// Runs encoder and initializer on road users that will be numbered after the actors there are.
    fn encode(&self, actors: &mut [Actor]) -> Result<Vec<Batch>, GenerateError> {
        let first = self.actors.len();
        let mut groups: Vec<(AgentType, Vec<usize>)> = Vec::new();
        for (agent_type, _) in EXPERTS {
            let of_type = |i: &usize| actors[*i].plan.present.agent_type == agent_type;
            let all: Vec<usize> = (0..actors.len()).filter(of_type).collect();
            let run = all.len().div_ceil(self.workers().threads()).max(FEWEST_IN_BATCH);
            groups.extend(all.chunks(run).map(|part| (agent_type, part.to_vec())));
        }
        let shared = &*actors;
        let results = self.workers().map(&groups, |(agent_type, members)| {
            let expert = self.generator.expert(*agent_type)?;
            let features: Vec<_> = members.iter().map(|i| &shared[*i].plan.features).collect();
            let context: Context = expert.encode(&features)?;
            let output = expert.initialize(&context)?;
            let prepared = expert.prepare_refine(&context)?;
            Ok::<_, GenerateError>((output, prepared))
        });
        let mut batches = Vec::with_capacity(groups.len());
        for ((agent_type, members), result) in groups.into_iter().zip(results) {
            let (output, prepared) = result?;
            for (row, index) in members.iter().enumerate() {
                self.initialize(&mut actors[*index], &output, row)?;
            }
            let actors = members.into_iter().map(|i| i + first).collect();
            batches.push(Batch { agent_type, actors, prepared });
        }
        Ok(batches)
    }

    /// Sets an actor's first modes, and whether it rests, from a row of the initializer's output.
    fn initialize(&self, actor: &mut Actor, output: &InitialOutput, row: usize) -> Result<(), GenerateError> {
        finite(&output.residual[row], 0, &actor.id)?;
        let sure = actor.plan.target.position.is_some();
        let temperature = if sure { 1.0 } else { self.tuning().probability.temperature };
        let mut modes = output.residual[row];
        let mut probability = softmax(&output.log_prob[row], temperature);
        if self.request.stages.parted {
            let tuning = &self.tuning().duplicates;
            duplicate_modes::replace(&actor.plan, &mut modes, &mut probability, tuning);
        }
        actor.set_modes(modes, probability);
        actor.stays_probability = stays_in_the_world(f64::from(output.stays[row]));
        let free = actor.plan.target.is_free();
        let waits = actor.plan.sets_off();
        let stays = !free || (actor.stays_probability > STAYS_ABOVE && !waits) || actor.is_parked();
        actor.rests = actor.stays_parked || (may_rest(&actor.plan, self.number) && stays);
        Ok(())
    }

    /// Fresh drafts for a sample: the modes with the draw's noise.
    pub(super) fn begin_sample(&mut self, sample: usize) -> Result<(), GenerateError> {
        self.sample = sample;
        let (seed, window) = (self.request.seed, self.number);
        let key = Key { seed, sample, agent: "", window, step: 0 };
        let likeliest_leads = leads_by_probability(self.request.stages.shown, sample);
        let fresh = |actor: &Actor| {
            let leading = if likeliest_leads {
                actor.likeliest()
            } else {
                pick(&actor.probability, Key { agent: &actor.id, step: usize::MAX, ..key }.unit())
            };
            Drafts::of(actor, leading)
        };
        self.drafts = self.actors.iter().map(fresh).collect();
        if let Some(&(level, _)) = levels(&self.request).first() {
            self.add_noise(key, level)?;
        }
        let (diversity, tuning) = (self.request.diversity, &self.generator.tuning.diversity);
        let widened = self.workers().map(&self.indices(), |&i| {
            let actor = &self.actors[i];
            let cover = actor.cover.as_ref()?;
            Some((cover.offset, widen(actor, cover, diversity, Key { agent: &actor.id, ..key }, tuning)))
        });
        for (drafts, widened) in self.drafts.iter_mut().zip(widened) {
            let Some((offset, (added, probability))) = widened else { continue };
            drafts.add(&offset);
            drafts.add(&added);
            drafts.probability = probability;
            drafts.order = by_probability(&probability);
        }
        Ok(())
    }

    /// The draw's noise, which refinement takes out again but for a trace.
    fn add_noise(&mut self, key: Key<'_>, level: usize) -> Result<(), GenerateError> {
        for batch in &self.batches {
            let modes: Vec<Modes> = batch.actors.iter().map(|i| self.drafts[*i].modes).collect();
            let noise = |i: &usize| Key { agent: &self.actors[*i].id, ..key }.normals(self.request.diversity);
            let noise: Vec<Modes> = batch.actors.iter().map(noise).collect();
            let expert = self.generator.expert(batch.agent_type)?;
            let noisy = expert.add_noise(&batch.prepared, &modes, &noise, level)?;
            for (i, modes) in batch.actors.iter().zip(noisy) {
                self.drafts[*i].modes = modes;
            }
        }
        Ok(())
    }

    /// One refinement step for everybody.
    pub(super) fn refine(&mut self, step: usize) -> Result<(), GenerateError> {
        let levels = levels(&self.request);
        let Some(&level) = levels.get(step - 1) else { return Ok(()) };
        let Self { actors, drafts, background, .. } = &*self;
        let refining = &self.request.stages.refining;
        let repulsions = if refining.repulsion {
            repulsions(&self.energy(), self.workers(), actors, drafts, &background.outlines)
        } else {
            vec![[[0.0; RESIDUAL]; MODES]; actors.len()]
        };
        let results = self.workers().map(&self.batches, |batch| {
            let modes: Vec<Modes> = batch.actors.iter().map(|i| drafts[*i].plain()).collect();
            let repulsion: Vec<Modes> = batch.actors.iter().map(|i| repulsions[*i]).collect();
            let expert = self.generator.expert(batch.agent_type)?;
            Ok::<_, GenerateError>(expert.refine_step(&batch.prepared, &modes, &repulsion, level, None)?)
        });
        for (batch, result) in self.batches.iter().zip(results) {
            for (i, modes) in batch.actors.iter().zip(result?) {
                finite(&modes, step, &self.actors[*i].id)?;
                self.drafts[*i].refined(modes);
            }
        }
        // A first sample that is chosen does without: choice and guidance clear it, and its user waits.
        let drawn = self.sample > 0 || self.request.stages.shown != Shown::Chosen;
        if drawn && self.request.stages.refining.resolve_overlaps && step == levels.len() {
            let mut drafts = std::mem::take(&mut self.drafts);
            resolve_overlaps(&self.energy(), &self.actors, &mut drafts, &self.background.outlines);
            self.drafts = drafts;
        }
        Ok(())
    }

    /// The present drafts as futures that can be shown.
    pub(super) fn draft(&mut self, step: usize) -> Draft {
        let all = self.request.stream_all || self.actors.len() < SHOW_ALL_BELOW;
        let count = if all { self.request.modes } else { 1 };
        let shown: Vec<Vec<Candidate>> =
            self.workers().map(&self.indices(), |&i| self.material(i).alternatives(count));
        if step == 0 {
            self.names = self.names(&shown);
        }
        let futures = shown.iter().enumerate().map(|(i, alternatives)| {
            let actor = &self.actors[i];
            let middle = middle(actor);
            let is_middle = |c: &Candidate| middle.is_some() && c.origin.slot() == middle;
            let chosen = alternatives.iter().position(is_middle).unwrap_or(0);
            let mut futures = self.futures(chosen, alternatives);
            for (future, draft) in futures.modes.iter_mut().zip(alternatives) {
                future.about = self.names.of(i, draft);
            }
            (actor.id.clone(), futures)
        });
        let futures = futures.collect();
        Draft {
            window: self.number,
            sample: self.sample,
            step,
            steps: self.request.steps,
            futures: Sample { agents: futures, score: serde_json::Value::Null },
        }
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

/// Levels of the refinement steps: from the leapfrog start, or from as high up as many steps need.
fn levels(request: &Request) -> Vec<(usize, usize)> {
    schedule::ddim(request.stages.refining.start.max(request.steps), request.steps)
}

/// Refinement steps of a call.
pub(super) fn steps(request: &Request) -> usize {
    levels(request).len()
}

/// The mode at a share `at` of all probability.
fn pick(probability: &[f64; MODES], at: f64) -> Slot {
    let mut left = at;
    for (slot, p) in Slot::all().zip(probability) {
        if left < *p {
            return slot;
        }
        left -= p;
    }
    Slot::new(MODES - 1)
}

/// Probabilities, the flatter the higher the temperature.
fn softmax(log_prob: &[f32; MODES], temperature: f64) -> [f64; MODES] {
    let values = log_prob.map(|l| (f64::from(l) / temperature).exp());
    let sum: f64 = values.iter().sum();
    values.map(|v| v / sum.max(1e-12))
}

fn finite(modes: &Modes, step: usize, agent: &AgentId) -> Result<(), GenerateError> {
    if modes.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(GenerateError::NonFinite { step, agent: agent.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_follows_the_probabilities() {
        let probability = [0.5, 0.0, 0.25, 0.25, 0.0, 0.0];
        let slots = [0.0, 0.49, 0.5, 0.76, 0.999].map(|at| pick(&probability, at).index());
        assert_eq!(slots, [0, 0, 2, 3, 3]);
        assert_eq!(pick(&probability, 1.0).index(), MODES - 1);
    }

    #[test]
    fn temperature_flattens() {
        let log_prob = [0.0, -1.0, -2.0, -3.0, -4.0, -5.0];
        let (sharp, flat) = (softmax(&log_prob, 1.0), softmax(&log_prob, 2.5));
        assert!(sharp[0] > flat[0] && sharp[5] < flat[5]);
        assert!((flat.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
