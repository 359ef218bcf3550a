//! One planning window: first drafts of everybody concerned, refinement steps, then one future each so
//! that the scene is coherent. What happens before and after it is [`super::rollout`]'s matter.

use super::actor::{Actor, Role, come_near, kept_states};
use super::noise::Key;
use super::realise::{Motion, may_rest, realise, rest, without_creep};
use super::{Generator, KnownMap, twins};
use crate::features::stays_in_the_world;
use crate::net::{Context, NetError, Prepared, schedule};
use crate::planning::pullback::Pullback;
use crate::planning::world::World;
use crate::planning::{MODES, RESIDUAL, STAYS_WITHIN_M};
use crate::request::{Draft, GenerateError, React, Request, Shown};
use crate::weights::EXPERTS;
use scene::motion::Trajectory;
use scene::{AgentFutures, AgentId, AgentType, Future, HORIZON_STEPS, Sample, Scene, State, Vec2};
use std::collections::BTreeSet;
use std::sync::Arc;

mod decide;
mod kerb;
mod options;
mod push;

/// Most road users that get new futures in one call.
pub(super) const MOST_ACTORS: usize = 128;
/// Most road users for which every mode is shown while it refines; above, the likeliest alone.
const SHOW_ALL_BELOW: usize = 5;

/// Temperature of the probabilities where no goal position is fixed: what was learned from simulated drivers
/// is surer than recorded ones warrant (log loss on 71 recorded scenes 1.96 without it, 1.78 with it).
const DOUBT: f64 = 2.5;

pub(super) type Residuals = [[f32; RESIDUAL]; MODES];

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

/// What a window is planned from. Road users are indices into the scene's agents.
pub(super) struct Spec<'a> {
    /// From 0.
    pub(super) number: usize,
    /// Scene step at which the window starts.
    pub(super) step: usize,
    /// The scene as it stands at that step: states reached, conditions that hold from here on.
    pub(super) scene: Arc<Scene>,
    /// Those that get new futures in any case.
    pub(super) moving: Vec<(usize, Role)>,
    /// Those that may answer them.
    pub(super) candidates: &'a BTreeSet<usize>,
    /// Those among the moving that were parked when the call began: they stay.
    pub(super) parked: &'a BTreeSet<usize>,
}

/// What a window decided for one road user.
pub(super) struct Decided {
    /// Index into the scene's agents.
    pub(super) agent: usize,
    /// Index into [`Window::actors`].
    pub(super) actor: usize,
    /// Index into `motions`.
    pub(super) chosen: usize,
    /// Probability, slot and motion, at most as many as were asked for.
    pub(super) motions: Vec<(f64, usize, Motion)>,
}

impl Decided {
    /// The motion that is shown.
    pub(super) fn motion(&self) -> &Motion {
        &self.motions[self.chosen].2
    }

    /// The road user stays where it is.
    pub(super) fn rests(&self) -> bool {
        self.motions[self.chosen].1 == usize::MAX
    }
}

/// One planning window of one call.
pub(super) struct Window<'g> {
    generator: &'g Generator,
    request: Arc<Request>,
    scene: Arc<Scene>,
    map: Arc<KnownMap>,
    number: usize,
    step: usize,
    pub(super) actors: Vec<Actor>,
    batches: Vec<Batch>,
    drafts: Vec<Residuals>,
    /// Slots by falling probability, one list an actor.
    order: Vec<[usize; MODES]>,
    /// The mode that stands for each actor while the others refine.
    standing_for: Vec<usize>,
    /// Where settling led those drafts that it moved.
    settled: Vec<Option<[f32; RESIDUAL]>>,
    sample: usize,
    pullback: Pullback,
}

impl<'g> Window<'g> {
    /// First drafts of everybody concerned; [`Window::begin_sample`] comes next.
    pub(super) fn plan(
        generator: &'g Generator,
        request: Arc<Request>,
        map: Arc<KnownMap>,
        spec: Spec<'_>,
    ) -> Result<Self, GenerateError> {
        let mut window = Self {
            generator,
            request,
            scene: spec.scene,
            map,
            number: spec.number,
            step: spec.step,
            actors: Vec::new(),
            batches: Vec::new(),
            drafts: Vec::new(),
            order: Vec::new(),
            standing_for: Vec::new(),
            settled: Vec::new(),
            sample: 0,
            pullback: Pullback::default(),
        };
        let scene = window.scene.clone();
        let mut world = World::new(&scene, window.map.graph.clone(), spec.step);
        world.planning = window.request.stages.planning;
        let role = |index| spec.moving.iter().find(|m| m.0 == index).map(|m| m.1);
        let wanted: Vec<_> =
            world.present.iter().filter_map(|p| role(p.index).map(|role| (p, role))).collect();
        let mut actors = generator.workers.map(&wanted, |(who, role)| {
            let mut actor = Actor::regenerated(&world, who, *role);
            if spec.number > 0 {
                actor.goes_on(spec.parked.contains(&who.index));
            }
            actor
        });
        let mut batches = window.encode(&mut actors, 0)?;
        for actor in &mut actors {
            actor.pinned = window.request.pinned.get(&actor.id).cloned();
        }
        let mut reacting = window.reacting(&world, &actors, spec.candidates);
        let first = actors.len();
        batches.extend(window.encode(&mut reacting, first)?);
        actors.extend(reacting);
        window.order = actors.iter().map(|a| by_probability(&a.probability)).collect();
        for actor in &mut actors {
            actor.keeps_to_the_road = options::starts_on_the_road(actor, &window.map);
        }
        window.batches = batches;
        window.actors = actors;
        Ok(window)
    }

    /// The scene at the window's start.
    pub(super) fn world(&self) -> World<'_> {
        World::new(&self.scene, self.map.graph.clone(), self.step)
    }

    /// Candidates that come near what the regenerated ones are about to do.
    fn reacting(&self, world: &World<'_>, actors: &[Actor], candidates: &BTreeSet<usize>) -> Vec<Actor> {
        if candidates.is_empty() {
            return Vec::new();
        }
        let paths: Vec<(Vec<Vec2>, f64)> = actors
            .iter()
            .map(|a| {
                let mode = a.likeliest();
                let motion =
                    if a.rests { rest(&a.planned) } else { realise(&a.planned, mode, &a.residual[mode]) };
                let path = motion.states.iter().skip(1).map(|s| s.position).collect();
                (path, a.planned.present.size.length_m)
            })
            .collect();
        let candidates: Vec<_> = world.present.iter().filter(|p| candidates.contains(&p.index)).collect();
        let found = self.generator.workers.map(&candidates, |who| {
            let kept = kept_states(world.scene, world.agent(who), world.step);
            let asked = matches!(self.request.react, React::Only(_));
            let parked = kept.iter().all(|s| (s.position() - who.start.position()).norm() < STAYS_WITHIN_M);
            let reach = |length: f64| 5.0 + 0.5 * (length + who.size.length_m);
            let near = paths.iter().any(|(path, length)| come_near(path, &kept, reach(*length)));
            let unmoved = world.conditions[who.index].start == scene::Start::default();
            if !asked && unmoved && (parked || !near) {
                return None;
            }
            Some(Actor::reacting(world, who, kept))
        });
        found.into_iter().flatten().take(MOST_ACTORS - actors.len()).collect()
    }

    /// Runs encoder and initializer on road users that will be numbered from `first`.
    fn encode(&self, actors: &mut [Actor], first: usize) -> Result<Vec<Batch>, GenerateError> {
        let threads = self.generator.workers.threads();
        let mut groups: Vec<(AgentType, Vec<usize>)> = Vec::new();
        for (agent_type, _) in EXPERTS {
            let all: Vec<usize> =
                (0..actors.len()).filter(|i| actors[*i].planned.present.agent_type == agent_type).collect();
            let run = all.len().div_ceil(threads).max(4);
            groups.extend(all.chunks(run).map(|part| (agent_type, part.to_vec())));
        }
        let shared = &*actors;
        let results = self.generator.workers.map(&groups, |(agent_type, members)| {
            let expert = self.generator.expert(*agent_type)?;
            let features: Vec<_> = members.iter().map(|i| &shared[*i].planned.features).collect();
            let context: Context = expert.encode(&features)?;
            let said = expert.initialize(&context)?;
            let prepared = expert.prepare_refine(&context)?;
            Ok::<_, GenerateError>((said, prepared))
        });
        let mut batches = Vec::with_capacity(groups.len());
        for ((agent_type, members), result) in groups.into_iter().zip(results) {
            let (said, prepared) = result?;
            for (row, index) in members.iter().enumerate() {
                let actor = &mut actors[*index];
                finite(&said.residual[row], 0, &actor.id)?;
                if !actor.keeps_its_path() {
                    actor.residual = said.residual[row];
                    let sure = actor.planned.target.position.is_some();
                    actor.probability = softmax(&said.log_prob[row], if sure { 1.0 } else { DOUBT });
                    if self.request.stages.parted {
                        twins::part(&actor.planned, &mut actor.residual, &mut actor.probability);
                    }
                }
                actor.stays_probability = stays_in_the_world(f64::from(said.stays[row]));
                let free = actor.planned.target.is_free();
                let stays = !free || actor.stays_probability > 0.5 || actor.is_parked();
                actor.rests = actor.stays_parked || (may_rest(&actor.planned, self.number) && stays);
            }
            let actors = members.into_iter().map(|i| i + first).collect();
            batches.push(Batch { agent_type, actors, prepared });
        }
        Ok(batches)
    }

    /// Fresh drafts for the present sample: the modes with the draw's noise.
    pub(super) fn begin_sample(&mut self, sample: usize) -> Result<(), GenerateError> {
        self.sample = sample;
        let (seed, window) = (self.request.seed, self.number);
        let key = |agent, step| Key { seed, sample, agent, window, step };
        let likeliest = match self.request.stages.shown {
            Shown::Chosen => sample == 0,
            Shown::Likeliest => true,
            Shown::Drawn => false,
        };
        self.standing_for =
            self.actors
                .iter()
                .map(|a| {
                    if likeliest {
                        a.likeliest()
                    } else {
                        pick(&a.probability, key(&a.id, usize::MAX).unit())
                    }
                })
                .collect();
        self.drafts = self.actors.iter().map(|a| a.residual).collect();
        self.settled = vec![None; self.actors.len()];
        let Some(&(level, _)) = levels(&self.request).first() else {
            return Ok(());
        };
        for batch in &self.batches {
            let residual: Vec<Residuals> = batch.actors.iter().map(|i| self.drafts[*i]).collect();
            let noise: Vec<Residuals> = batch
                .actors
                .iter()
                .map(|i| key(&self.actors[*i].id, 0).normals(self.request.diversity))
                .collect();
            let expert = self.generator.expert(batch.agent_type)?;
            let noisy = expert.add_noise(&batch.prepared, &residual, &noise, level)?;
            for (i, draft) in batch.actors.iter().zip(noisy) {
                self.drafts[*i] = draft;
            }
        }
        Ok(())
    }

    /// One refinement step for everybody.
    pub(super) fn refine(&mut self, step: usize) -> Result<(), GenerateError> {
        let Some(&level) = levels(&self.request).get(step - 1) else { return Ok(()) };
        let pushes = if self.request.stages.refining.push {
            self.pushes()
        } else {
            vec![[[0.0; RESIDUAL]; MODES]; self.actors.len()]
        };
        let drafts = &self.drafts;
        let results = self.generator.workers.map(&self.batches, |batch| {
            let residual: Vec<Residuals> = batch.actors.iter().map(|i| drafts[*i]).collect();
            let push: Vec<Residuals> = batch.actors.iter().map(|i| pushes[*i]).collect();
            let expert = self.generator.expert(batch.agent_type)?;
            Ok::<_, GenerateError>(expert.refine_step(&batch.prepared, &residual, &push, level, None)?)
        });
        for (batch, result) in self.batches.iter().zip(results) {
            for (i, draft) in batch.actors.iter().zip(result?) {
                finite(&draft, step, &self.actors[*i].id)?;
                self.drafts[*i] = draft;
            }
        }
        // A first scene that is chosen does without: choice and guidance clear it, and its user waits.
        let drawn = self.sample > 0 || self.request.stages.shown != Shown::Chosen;
        if drawn && self.request.stages.refining.settle && step == levels(&self.request).len() {
            self.settle();
        }
        Ok(())
    }

    /// The present drafts as futures that can be shown.
    pub(super) fn draft(&self, step: usize) -> Draft {
        let all = self.request.stream_all || self.actors.len() < SHOW_ALL_BELOW;
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let shown = self.generator.workers.map(&indices, |&i| {
            let modes = if all { self.request.modes } else { 1 };
            let motions = self.motions(i, modes);
            let middle = options::middle_slot(&self.actors[i]);
            let shown = motions.iter().position(|m| middle == Some(m.1)).unwrap_or(0);
            (self.actors[i].id.clone(), self.futures(shown, &motions))
        });
        Draft {
            window: self.number,
            sample: self.sample,
            step,
            steps: self.request.steps,
            futures: Sample { agents: shown.into_iter().collect(), score: serde_json::Value::Null },
        }
    }

    /// Motions of an actor's drafts with their probabilities and slots, likeliest first.
    fn motions(&self, i: usize, count: usize) -> Vec<(f64, usize, Motion)> {
        let actor = &self.actors[i];
        let mut out = Vec::with_capacity(count + 1);
        let mut share = 1.0;
        if actor.rests {
            let certain = self.mode_count(i) == 1;
            let p = if certain { 1.0 } else { actor.stays_probability };
            out.push((p, usize::MAX, rest(&actor.planned)));
            if certain {
                return out;
            }
            share = 1.0 - p;
        }
        for &slot in self.order[i].iter().take(count.saturating_sub(out.len())) {
            let is_middle = options::middle_slot(actor) == Some(slot);
            let learned = if is_middle { options::learned_share(actor) } else { 1.0 };
            let motion = realise(&actor.planned, slot, &self.drafts[i][slot].map(|r| learned * r));
            let motion = without_creep(&actor.planned, self.number, motion);
            out.push((share * actor.probability[slot], slot, motion));
        }
        out
    }

    /// Motions as futures, cut to what was asked for.
    pub(super) fn futures(&self, chosen: usize, motions: &[(f64, usize, Motion)]) -> AgentFutures {
        let total: f64 = motions.iter().map(|m| m.0).sum();
        let modes = motions.iter().map(|(p, slot, motion)| Future {
            anchor: u32::try_from(*slot).ok(),
            probability: if total > 0.0 { p / total } else { 1.0 / motions.len() as f64 },
            first_step: self.step + 1,
            states: self.cut(&motion.states),
        });
        AgentFutures { chosen, modes: modes.collect() }
    }

    /// The asked-for part of a rollout, the start left out.
    fn cut(&self, states: &Trajectory) -> Vec<State> {
        let left = self.request.start_step + self.request.horizon_steps - self.step;
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

fn by_probability(probability: &[f64; MODES]) -> [usize; MODES] {
    let mut order: [usize; MODES] = std::array::from_fn(|i| i);
    order.sort_by(|a, b| probability[*b].total_cmp(&probability[*a]).then(a.cmp(b)));
    order
}

fn pick(probability: &[f64; MODES], at: f64) -> usize {
    let mut left = at;
    for (i, p) in probability.iter().enumerate() {
        if left < *p {
            return i;
        }
        left -= p;
    }
    MODES - 1
}

/// Probabilities, the flatter the higher the temperature.
fn softmax(log_prob: &[f32; MODES], temperature: f64) -> [f64; MODES] {
    let values = log_prob.map(|l| (f64::from(l) / temperature).exp());
    let sum: f64 = values.iter().sum();
    values.map(|v| v / sum.max(1e-12))
}

fn finite(residual: &Residuals, step: usize, agent: &AgentId) -> Result<(), GenerateError> {
    if residual.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(GenerateError::NonFinite { step, agent: agent.clone() })
}
