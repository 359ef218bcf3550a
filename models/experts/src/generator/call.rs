//! One call: accepted, first drafts, refinement steps, then the chosen scene.

use super::actor::{Actor, Role, come_near, kept_boxes, kept_state, kept_states};
use super::choice::{Choice, Choosable, medoid_costs, swept};
use super::noise::Key;
use super::realise::{Motion, PER_INSTANT, may_rest, places, realise, rest};
use super::{EncodedMap, Generator, parallel, report};
use crate::features::world::{Present, World};
use crate::features::{INSTANTS, MODES, RESIDUAL, stays_in_the_world};
use crate::net::overlap::{Growth, Obstacle, Poses, Pullback, overlap};
use crate::net::{Context, NetError, Prepared, schedule};
use crate::request::{
    Accepted, Answer, Cancel, Draft, Event, GenerateError, React, Request, Resolved, Shown, Timings, Warning,
};
use scene::geometry::direction;
use scene::motion::{MotionState, Trajectory};
use scene::routes::LaneGraph;
use scene::{AgentFutures, AgentId, AgentType, Future, HORIZON_STEPS, Sample, Scene, State, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

/// Most road users that get new futures in one call.
const MOST_ACTORS: usize = 128;
/// Most road users for which every mode is shown while it refines; above, the likeliest alone.
const SHOW_ALL_BELOW: usize = 5;
/// A start within this of the regenerated ones may react at all, metres.
const REACT_WITHIN_M: f64 = 120.0;
/// Steps of guidance on a conflicting draft, and the share of the push taken at each.
const GUIDANCE: (usize, f32) = (12, 0.35);

/// Cost of a motion that is off the lanes all the time.
const OFF_LANES: f64 = 8.0;

type Residuals = [[f32; RESIDUAL]; MODES];

/// Road users of one expert that run in one network call.
struct Batch {
    agent_type: AgentType,
    actors: Vec<usize>,
    prepared: Prepared,
}

enum Stage {
    Accept,
    Initial,
    Step(usize),
    Finish,
    Done,
}

/// A call under way: yields events until the final one.
pub struct Generation<'g> {
    generator: &'g Generator,
    request: Request,
    cancel: Cancel,
    scene: Arc<Scene>,
    map: Arc<EncodedMap>,
    stage: Stage,
    regenerated: BTreeSet<usize>,
    candidates: BTreeSet<usize>,
    actors: Vec<Actor>,
    batches: Vec<Batch>,
    drafts: Vec<Residuals>,
    /// Slots by falling probability, one list an actor.
    order: Vec<[usize; MODES]>,
    /// The mode that stands for each actor while the others refine.
    standing_for: Vec<usize>,
    sample: usize,
    samples: Vec<Sample>,
    resolved: BTreeMap<AgentId, Resolved>,
    warnings: Vec<Warning>,
    timings: Timings,
    pullback: Pullback,
}

impl From<NetError> for GenerateError {
    fn from(error: NetError) -> Self {
        Self::Expert(error.to_string())
    }
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

impl<'g> Generation<'g> {
    pub(super) fn new(
        generator: &'g Generator,
        request: Request,
        cancel: Cancel,
    ) -> Result<Self, GenerateError> {
        let scene = request.scene.clone();
        let started = Instant::now();
        let map = generator.encoded_map(&scene.map);
        let world = World::new(&scene, map.index.clone(), request.start_step);
        let movable: BTreeSet<usize> =
            world.present.iter().filter(|p| p.agent_type != AgentType::Other).map(|p| p.index).collect();
        let regenerated = match &request.agents {
            None => movable.clone(),
            Some(ids) => find(&scene, &movable, ids)?,
        };
        let candidates = match &request.react {
            React::Nobody => BTreeSet::new(),
            React::Everyone => within_reach(&world, &movable, &regenerated),
            React::Only(ids) => find(&scene, &movable, ids)?.difference(&regenerated).copied().collect(),
        };
        let found = regenerated.len();
        if found > MOST_ACTORS {
            return Err(GenerateError::TooManyAgents { found, most: MOST_ACTORS });
        }
        drop(world);
        let timings = Timings { encode_ms: milliseconds(started), ..Timings::default() };
        Ok(Self {
            generator,
            request,
            cancel,
            scene,
            map,
            stage: Stage::Accept,
            regenerated,
            candidates,
            actors: Vec::new(),
            batches: Vec::new(),
            drafts: Vec::new(),
            order: Vec::new(),
            standing_for: Vec::new(),
            sample: 0,
            samples: Vec::new(),
            resolved: BTreeMap::new(),
            warnings: Vec::new(),
            timings,
            pullback: Pullback::default(),
        })
    }

    fn world(&self) -> World<'_> {
        World::new(&self.scene, self.map.index.clone(), self.request.start_step)
    }

    fn accept(&self) -> Accepted {
        let ids = |set: &BTreeSet<usize>| set.iter().map(|i| self.scene.agents[*i].id.clone()).collect();
        let moved = |i: &usize| self.regenerated.contains(i) || self.candidates.contains(i);
        let fixed: BTreeSet<usize> = (0..self.scene.agents.len()).filter(|i| !moved(i)).collect();
        Accepted {
            seed: self.request.seed,
            regenerated: ids(&self.regenerated),
            reacting: ids(&self.candidates),
            fixed: ids(&fixed),
            steps: self.request.steps,
            windows: 1,
            warnings: Vec::new(),
        }
    }

    /// First drafts of everybody concerned.
    fn initial(&mut self) -> Result<Draft, GenerateError> {
        let started = Instant::now();
        let scene = self.scene.clone();
        let world = World::new(&scene, self.map.index.clone(), self.request.start_step);
        let wanted: Vec<_> = world.present.iter().filter(|p| self.regenerated.contains(&p.index)).collect();
        let mut actors = parallel::map(self.generator.threads(), &wanted, |who| {
            Actor::regenerated(&world, who, Role::Regenerated)
        });
        let mut batches = self.encode(&mut actors, 0)?;
        for actor in &mut actors {
            actor.pinned = self.request.pinned.get(&actor.id).cloned();
        }
        let mut reacting = self.reacting(&world, &actors);
        let first = actors.len();
        batches.extend(self.encode(&mut reacting, first)?);
        actors.extend(reacting);
        self.warnings = report::warnings(&world, &actors);
        self.batches = batches;
        self.actors = actors;
        self.order = self.actors.iter().map(|a| by_probability(&a.probability)).collect();
        self.begin_sample()?;
        self.timings.initial_ms = milliseconds(started);
        Ok(self.draft(0))
    }

    /// Candidates that come near what the regenerated ones are about to do.
    fn reacting(&self, world: &World<'_>, actors: &[Actor]) -> Vec<Actor> {
        if self.candidates.is_empty() {
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
        let candidates: Vec<_> =
            world.present.iter().filter(|p| self.candidates.contains(&p.index)).collect();
        let found = parallel::map(self.generator.threads(), &candidates, |who| {
            let kept = kept_states(world.scene, world.agent(who), world.step);
            let asked = matches!(self.request.react, React::Only(_));
            let parked = kept.iter().all(|s| (s.position() - who.start.position()).norm() < 0.5);
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
        let threads = self.generator.threads();
        let mut groups: Vec<(AgentType, Vec<usize>)> = Vec::new();
        for (agent_type, _) in super::EXPERTS {
            let all: Vec<usize> =
                (0..actors.len()).filter(|i| actors[*i].planned.present.agent_type == agent_type).collect();
            let run = all.len().div_ceil(threads).max(4);
            groups.extend(all.chunks(run).map(|part| (agent_type, part.to_vec())));
        }
        let shared = &*actors;
        let results = parallel::map(threads, &groups, |(agent_type, members)| {
            let expert = self.generator.expert(*agent_type)?;
            let map = self.map.encoding(*agent_type, expert)?;
            let features: Vec<_> = members.iter().map(|i| &shared[*i].planned.features).collect();
            let context: Context = expert.encode(map, &features)?;
            let said = expert.initialize(&context)?;
            Ok::<_, GenerateError>((said, expert.prepare_refine(&context)?))
        });
        let mut batches = Vec::with_capacity(groups.len());
        for ((agent_type, members), result) in groups.into_iter().zip(results) {
            let (said, prepared) = result?;
            for (row, index) in members.iter().enumerate() {
                let actor = &mut actors[*index];
                finite(&said.residual[row], 0, &actor.id)?;
                if !actor.keeps_its_path() {
                    actor.residual = said.residual[row];
                    actor.probability = softmax(&said.log_prob[row]);
                }
                actor.stays_probability = stays_in_the_world(f64::from(said.stays[row]));
                let free = actor.planned.target.is_free();
                actor.rests =
                    may_rest(&actor.planned) && (!free || actor.stays_probability > 0.5 || actor.is_parked());
            }
            let actors = members.into_iter().map(|i| i + first).collect();
            batches.push(Batch { agent_type, actors, prepared });
        }
        Ok(batches)
    }

    /// Fresh drafts for the present sample: the modes with the draw's noise.
    fn begin_sample(&mut self) -> Result<(), GenerateError> {
        let (seed, sample) = (self.request.seed, self.sample);
        let likeliest = match self.request.stages.shown {
            Shown::Chosen => sample == 0,
            Shown::Likeliest => true,
            Shown::Drawn => false,
        };
        let key = |agent, step| Key { seed, sample, agent, window: 0, step };
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
        let Some(&(level, _)) = self.levels().first() else {
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
    fn step(&mut self, step: usize) -> Result<(), GenerateError> {
        let started = Instant::now();
        let Some(&level) = self.levels().get(step - 1) else { return Ok(()) };
        let pushes = self.pushes();
        let drafts = &self.drafts;
        let results = parallel::map(self.generator.threads(), &self.batches, |batch| {
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
        if self.sample == 0 {
            self.timings.step_ms.push(milliseconds(started));
        }
        Ok(())
    }

    /// The way downhill in the scene's overlap energy, for every mode of everybody.
    fn pushes(&self) -> Vec<Residuals> {
        let world = self.world();
        let moving: Vec<(Poses, [f32; 2])> = self
            .actors
            .iter()
            .zip(&self.drafts)
            .zip(&self.standing_for)
            .map(|((actor, draft), mode)| {
                (actor_poses(actor, *mode, &draft[*mode]), half_size(&actor.planned.present))
            })
            .collect();
        let kept = self.kept_poses(&world);
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        parallel::map(self.generator.threads(), &indices, |&i| {
            let actor = &self.actors[i];
            if actor.rests {
                return [[0.0; RESIDUAL]; MODES];
            }
            let others = moving.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, m)| m).chain(&kept);
            let near: Vec<&(Poses, [f32; 2])> = others.collect();
            std::array::from_fn(|mode| self.push(actor, mode, &self.drafts[i][mode], &near))
        })
    }

    fn push(
        &self,
        actor: &Actor,
        mode: usize,
        residual: &[f32; RESIDUAL],
        others: &[&(Poses, [f32; 2])],
    ) -> [f32; RESIDUAL] {
        let places = places(&actor.planned, mode, residual);
        let own = poses_of(&places);
        let obstacles = others.iter().map(|(poses, half)| Obstacle { poses, half: *half });
        let found = overlap(&own, half_size(&actor.planned.present), obstacles, Growth::Square);
        if found.energy == 0.0 {
            return [0.0; RESIDUAL];
        }
        let mut route = [[0.0; 2]; INSTANTS];
        for (i, (_, heading)) in places.iter().enumerate() {
            let (sin, cos) = (heading.sin() as f32, heading.cos() as f32);
            let [gx, gy] = found.gradient[i];
            route[i] = [gx * cos + gy * sin, gy * cos - gx * sin];
        }
        self.pullback.push(&route, &actor.planned.features.tangent)
    }

    /// Those who keep their motion, as obstacles.
    fn kept_poses(&self, world: &World<'_>) -> Vec<(Poses, [f32; 2])> {
        let acting: BTreeSet<usize> = self.actors.iter().map(|a| a.planned.present.index).collect();
        let kept = world.present.iter().filter(|p| !acting.contains(&p.index));
        kept.map(|p| {
            let mut poses = [[0.0; 4]; INSTANTS];
            for (i, pose) in poses.iter_mut().enumerate() {
                let step = (i + 1) * PER_INSTANT;
                if let Some(s) = kept_state(world.scene, world.agent(p), world.step, step) {
                    *pose = pose_of(s.position(), s.heading_rad);
                }
            }
            (poses, half_size(p))
        })
        .collect()
    }

    /// The present drafts as futures that can be shown.
    fn draft(&self, step: usize) -> Draft {
        let all = self.request.stream_all || self.actors.len() < SHOW_ALL_BELOW;
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let shown = parallel::map(self.generator.threads(), &indices, |&i| {
            let modes = if all { self.request.modes } else { 1 };
            let motions = self.motions(i, modes);
            (self.actors[i].id.clone(), self.futures(0, &motions))
        });
        Draft {
            window: 0,
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
            let certain = !actor.planned.target.is_free();
            let p = if certain { 1.0 } else { actor.stays_probability };
            out.push((p, usize::MAX, rest(&actor.planned)));
            if certain {
                return out;
            }
            share = 1.0 - p;
        }
        for &slot in self.order[i].iter().take(count.saturating_sub(out.len())) {
            let motion = realise(&actor.planned, slot, &self.drafts[i][slot]);
            out.push((share * actor.probability[slot], slot, motion));
        }
        out
    }

    fn futures(&self, chosen: usize, motions: &[(f64, usize, Motion)]) -> AgentFutures {
        let total: f64 = motions.iter().map(|m| m.0).sum();
        let modes = motions.iter().map(|(p, slot, motion)| Future {
            anchor: u32::try_from(*slot).ok(),
            probability: if total > 0.0 { p / total } else { 1.0 / motions.len() as f64 },
            first_step: self.request.start_step + 1,
            states: self.cut(&motion.states),
        });
        AgentFutures { chosen, modes: modes.collect() }
    }

    /// The asked-for part of a rollout, the start left out.
    fn cut(&self, states: &Trajectory) -> Vec<State> {
        states.iter().skip(1).take(self.request.horizon_steps.min(HORIZON_STEPS)).map(State::from).collect()
    }

    /// Chooses one future each and ends the sample.
    fn finish_sample(&mut self) -> Sample {
        let started = Instant::now();
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let mut motions: Vec<Vec<(f64, usize, Motion)>> =
            parallel::map(self.generator.threads(), &indices, |&i| self.motions(i, MODES));
        let scene = self.scene.clone();
        let world = World::new(&scene, self.map.index.clone(), self.request.start_step);
        let acting: BTreeSet<usize> = self.actors.iter().map(|a| a.planned.present.index).collect();
        let fixed =
            world.present.iter().filter(|p| !acting.contains(&p.index)).map(|p| kept_boxes(&world, p));
        let mut choice = Choice { agents: Vec::new(), fixed: fixed.collect() };
        for (actor, motions) in self.actors.iter().zip(&motions) {
            choice.agents.push(options(actor, motions, &self.map.index.graph));
        }
        let mut chosen = match self.request.stages.shown {
            Shown::Chosen => choice.solve(),
            Shown::Likeliest | Shown::Drawn => self.unchosen(&motions, &choice),
        };
        if self.request.stages.guidance {
            self.guide(&world, &mut choice, &mut motions, &mut chosen);
        }
        let mut sample = Sample::default();
        for (i, actor) in self.actors.iter().enumerate() {
            let Some(shown) = shown_motion(actor, chosen[i]) else { continue };
            let motions = &mut motions[i];
            // A guided motion takes the place of the mode it was made from.
            let index = match motions.get(shown) {
                Some((_, slot, _)) if shown >= self.mode_count(i) => {
                    let slot = *slot;
                    let own = motions[..self.mode_count(i)].iter().position(|m| m.1 == slot).unwrap_or(0);
                    let motion = motions[shown].2.clone();
                    motions[own].2 = motion;
                    own
                }
                _ => shown,
            };
            motions.truncate(self.mode_count(i));
            let keep = self.request.modes.max(1);
            let index = if index >= keep {
                motions.swap(index, 0);
                0
            } else {
                index
            };
            motions.truncate(keep);
            if self.sample == 0 {
                let verdict = report::resolved(&world, actor, &motions[index].2);
                self.resolved.insert(actor.id.clone(), verdict);
            }
            sample.agents.insert(actor.id.clone(), self.futures(index, motions));
        }
        self.timings.choice_ms += milliseconds(started);
        sample
    }

    /// Options that are shown when nothing is chosen: each road user's own, whatever the others do.
    fn unchosen(&self, motions: &[Vec<(f64, usize, Motion)>], choice: &Choice) -> Vec<usize> {
        let option = |(i, motions): (usize, &Vec<(f64, usize, Motion)>)| {
            let actor = &self.actors[i];
            // Options of a reacting road user begin with the motion it keeps.
            if actor.pinned.is_some() || actor.kept.is_some() || actor.rests {
                return 0;
            }
            let slot = self.standing_for[i];
            let found = motions.iter().position(|m| m.1 == slot).unwrap_or(0);
            found.min(choice.agents[i].len().saturating_sub(1))
        };
        motions.iter().enumerate().map(option).collect()
    }

    /// Modes of an actor before guidance added to them.
    fn mode_count(&self, i: usize) -> usize {
        let actor = &self.actors[i];
        if actor.rests && !actor.planned.target.is_free() { 1 } else { MODES }
    }

    /// Where the chosen scene still has conflicts, drafts pushed apart become further options; the choice
    /// takes them only where that costs less.
    fn guide(
        &self,
        world: &World<'_>,
        choice: &mut Choice,
        motions: &mut [Vec<(f64, usize, Motion)>],
        chosen: &mut Vec<usize>,
    ) {
        let conflict = choice.in_conflict(chosen);
        if !conflict.iter().any(|c| *c) {
            return;
        }
        let present: Vec<(Poses, [f32; 2])> = (0..self.actors.len())
            .map(|i| {
                let actor = &self.actors[i];
                let half = half_size(&actor.planned.present);
                match shown_motion(actor, chosen[i]).and_then(|m| motions[i].get(m)) {
                    Some((_, _, motion)) => (poses_of_states(&motion.states), half),
                    None => (poses_of_kept(actor), half),
                }
            })
            .collect();
        let kept = self.kept_poses(world);
        let concerned: Vec<usize> = (0..self.actors.len())
            .filter(|i| conflict[*i] && !self.actors[*i].rests && self.actors[*i].pinned.is_none())
            .collect();
        let guided = parallel::map(self.generator.threads(), &concerned, |&i| {
            let actor = &self.actors[i];
            let others = present.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, p)| p).chain(&kept);
            let others: Vec<&(Poses, [f32; 2])> = others.collect();
            let slots: Vec<(f64, usize)> = motions[i].iter().map(|m| (m.0, m.1)).collect();
            slots
                .into_iter()
                .filter_map(|(p, slot)| {
                    Some((p, slot, self.guided(actor, slot, &self.drafts[i][slot], &others)?))
                })
                .collect::<Vec<_>>()
        });
        for (i, guided) in concerned.into_iter().zip(guided) {
            motions[i].extend(guided);
            choice.agents[i] = options(&self.actors[i], &motions[i], &self.map.index.graph);
        }
        *chosen = choice.solve();
    }

    /// A draft pushed out of others' ways; `None` when nothing pushes it.
    fn guided(
        &self,
        actor: &Actor,
        slot: usize,
        residual: &[f32; RESIDUAL],
        others: &[&(Poses, [f32; 2])],
    ) -> Option<Motion> {
        let mut moved = *residual;
        let mut pushed = false;
        for _ in 0..GUIDANCE.0 {
            let push = self.push(actor, slot, &moved, others);
            if push.iter().all(|p| *p == 0.0) {
                break;
            }
            pushed = true;
            for (value, push) in moved.iter_mut().zip(push) {
                *value += GUIDANCE.1 * push;
            }
        }
        pushed.then(|| realise(&actor.planned, slot, &moved))
    }

    fn answer(&mut self) -> Result<Answer, GenerateError> {
        loop {
            let sample = self.finish_sample();
            self.samples.push(sample);
            self.sample += 1;
            if self.sample >= self.request.samples.max(1) {
                break;
            }
            self.begin_sample()?;
            for step in 1..=self.steps() {
                self.stop_if_cancelled()?;
                self.step(step)?;
            }
        }
        for (id, resolved) in &self.resolved {
            if let crate::request::ReachReport::Unreachable { words, .. } = &resolved.reach {
                let known = |w: &Warning| w.code == "goal-unreachable" && w.agent.as_ref() == Some(id);
                if !self.warnings.iter().any(known) {
                    let agent = Some(id.clone());
                    self.warnings.push(Warning {
                        code: "goal-unreachable".into(),
                        agent,
                        detail: words.clone(),
                    });
                }
            }
        }
        Ok(Answer {
            samples: std::mem::take(&mut self.samples),
            resolved: std::mem::take(&mut self.resolved),
            warnings: std::mem::take(&mut self.warnings),
            timings: std::mem::take(&mut self.timings),
        })
    }

    /// Levels of the refinement steps: from the leapfrog start, or from as high up as many steps need.
    fn levels(&self) -> Vec<(usize, usize)> {
        schedule::ddim(schedule::START.max(self.request.steps), self.request.steps)
    }

    /// Refinement steps.
    fn steps(&self) -> usize {
        self.levels().len()
    }

    fn stop_if_cancelled(&self) -> Result<(), GenerateError> {
        if self.cancel.is_cancelled() { Err(GenerateError::Cancelled) } else { Ok(()) }
    }

    fn advance(&mut self) -> Result<Event, GenerateError> {
        self.stop_if_cancelled()?;
        match self.stage {
            Stage::Accept => {
                self.stage = Stage::Initial;
                Ok(Event::Accepted(self.accept()))
            }
            Stage::Initial => {
                let draft = self.initial()?;
                self.stage = if self.steps() > 0 { Stage::Step(1) } else { Stage::Finish };
                Ok(Event::Draft(draft))
            }
            Stage::Step(step) => {
                self.step(step)?;
                self.stage = if step < self.steps() { Stage::Step(step + 1) } else { Stage::Finish };
                Ok(Event::Draft(self.draft(step)))
            }
            Stage::Finish | Stage::Done => {
                self.stage = Stage::Done;
                Ok(Event::Final(self.answer()?))
            }
        }
    }
}

impl Iterator for Generation<'_> {
    type Item = Result<Event, GenerateError>;

    fn next(&mut self) -> Option<Self::Item> {
        if matches!(self.stage, Stage::Done) {
            return None;
        }
        let event = self.advance();
        if event.is_err() {
            self.stage = Stage::Done;
        }
        Some(event)
    }
}

/// Indices of agents by id; all must be able to move.
fn find(
    scene: &Scene,
    movable: &BTreeSet<usize>,
    ids: &BTreeSet<AgentId>,
) -> Result<BTreeSet<usize>, GenerateError> {
    ids.iter()
        .map(|id| {
            let index = scene.agents.iter().position(|a| a.id == *id);
            let index = index.ok_or_else(|| GenerateError::UnknownAgent(id.clone()))?;
            let missing = GenerateError::StartMissing { agent: id.clone(), field: "position" };
            movable.contains(&index).then_some(index).ok_or(missing)
        })
        .collect()
}

fn within_reach(
    world: &World<'_>,
    movable: &BTreeSet<usize>,
    regenerated: &BTreeSet<usize>,
) -> BTreeSet<usize> {
    let starts: Vec<Vec2> =
        world.present.iter().filter(|p| regenerated.contains(&p.index)).map(|p| p.start.position()).collect();
    world
        .present
        .iter()
        .filter(|p| movable.contains(&p.index) && !regenerated.contains(&p.index))
        .filter(|p| starts.iter().any(|s| (s - p.start.position()).norm() < REACT_WITHIN_M))
        .map(|p| p.index)
        .collect()
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

fn softmax(log_prob: &[f32; MODES]) -> [f64; MODES] {
    let values = log_prob.map(|l| f64::from(l).exp());
    let sum: f64 = values.iter().sum();
    values.map(|v| v / sum.max(1e-12))
}

fn finite(residual: &Residuals, step: usize, agent: &AgentId) -> Result<(), GenerateError> {
    if residual.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(GenerateError::NonFinite { step, agent: agent.clone() })
}

fn half_size(who: &Present) -> [f32; 2] {
    [0.5 * who.size.length_m as f32, 0.5 * who.size.width_m as f32]
}

fn pose_of(position: Vec2, heading_rad: f64) -> [f32; 4] {
    let ahead = direction(heading_rad);
    [position.x as f32, position.y as f32, ahead.x as f32, ahead.y as f32]
}

fn poses_of(places: &[(Vec2, f64); INSTANTS]) -> Poses {
    places.map(|(position, heading)| pose_of(position, heading))
}

fn poses_of_states(states: &[MotionState]) -> Poses {
    std::array::from_fn(|i| {
        let s = &states[((i + 1) * PER_INSTANT).min(states.len() - 1)];
        pose_of(s.position, s.heading_rad)
    })
}

fn poses_of_kept(actor: &Actor) -> Poses {
    let kept = actor.kept.as_deref().unwrap_or_default();
    std::array::from_fn(|i| {
        let state = kept.get((i + 1) * PER_INSTANT - 1);
        state.map_or([0.0; 4], |s| pose_of(s.position(), s.heading_rad))
    })
}

fn actor_poses(actor: &Actor, mode: usize, residual: &[f32; RESIDUAL]) -> Poses {
    if actor.rests {
        let start = &actor.planned.present.start;
        return [pose_of(start.position(), start.heading_rad); INSTANTS];
    }
    poses_of(&places(&actor.planned, mode, residual))
}

/// What an actor can do: its motions, after what it keeps (reacting) or has pinned.
fn options(actor: &Actor, motions: &[(f64, usize, Motion)], graph: &LaneGraph) -> Vec<Choosable> {
    let size = &actor.planned.present.size;
    if let Some(pinned) = &actor.pinned {
        let boxes = super::choice::swept_kept(|step| pinned.get(step - 1).copied(), size);
        return vec![Choosable { boxes, cost: 0.0 }];
    }
    let all: Vec<&Trajectory> = motions.iter().map(|m| &m.2.states).collect();
    let modes: Vec<(&Trajectory, f64)> = motions.iter().take(MODES).map(|m| (&m.2.states, m.0)).collect();
    let mut out = Vec::with_capacity(motions.len() + 1);
    match &actor.kept {
        None => {
            for (motion, cost) in motions.iter().zip(medoid_costs(&all, &modes)) {
                // A goal missed is worse than anything but an overlap.
                let missed = if motion.2.reach.is_reached() { 0.0 } else { 3.0 };
                let off = OFF_LANES * off_lanes(actor, &motion.2.states, graph);
                out.push(Choosable { boxes: swept(&motion.2.states, size), cost: cost + missed + off });
            }
        }
        Some(kept) => {
            let boxes = super::choice::swept_kept(|step| kept.get(step - 1).copied(), size);
            out.push(Choosable { boxes, cost: 0.0 });
            for motion in motions {
                let boxes = swept(&motion.2.states, size);
                let off = OFF_LANES * off_lanes(actor, &motion.2.states, graph);
                out.push(Choosable { boxes, cost: 0.6 + deviation_m(&motion.2.states, kept) / 4.0 + off });
            }
        }
    }
    out
}

/// Share of a vehicle's motion that is away from every lane, for one that starts on a lane.
fn off_lanes(actor: &Actor, states: &Trajectory, graph: &LaneGraph) -> f64 {
    let agent_type = actor.planned.present.agent_type;
    let away = |s: &MotionState| graph.nearest_for(s.position, 2.5, agent_type).is_empty();
    if agent_type != AgentType::Vehicle || states.first().is_none_or(away) {
        return 0.0;
    }
    let looked_at = states.iter().step_by(PER_INSTANT);
    looked_at.filter(|s| away(s)).count() as f64 / (INSTANTS + 1) as f64
}

/// Mean distance of a motion from the kept one, metres.
fn deviation_m(states: &Trajectory, kept: &[State]) -> f64 {
    let pairs = states.iter().skip(1).zip(kept).step_by(5);
    let (sum, n) =
        pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a.position - b.position()).norm(), n + 1.0));
    if n > 0.0 { sum / n } else { 0.0 }
}

/// Which of an actor's motions a chosen option is; `None` for what is kept or pinned.
fn shown_motion(actor: &Actor, option: usize) -> Option<usize> {
    if actor.pinned.is_some() {
        return None;
    }
    match actor.role {
        Role::Reacting if actor.kept.is_some() => option.checked_sub(1),
        _ => Some(option),
    }
}
