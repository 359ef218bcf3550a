//! One planning window: first drafts of everybody concerned, refinement steps, then one future each so
//! that the scene is coherent. What happens before and after it is [`super::rollout`]'s matter.

use super::actor::{Actor, Role, come_near, kept_boxes, kept_state, kept_states};
use super::choice::{Choice, Choosable, distance, medoid_costs, swept};
use super::noise::Key;
use super::realise::{Motion, PER_INSTANT, may_rest, middle, places, realise, rest};
use super::{EncodedMap, Generator, parallel};
use crate::features::world::{Present, World};
use crate::features::{INSTANTS, MODES, RESIDUAL, stays_in_the_world};
use crate::net::overlap::{Growth, Obstacle, Poses, Pullback, overlap};
use crate::net::{Context, NetError, Prepared, schedule};
use crate::request::{Draft, GenerateError, React, Request, Shown};
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::motion::{MotionState, Trajectory};
use scene::{AgentFutures, AgentId, AgentType, Future, HORIZON_STEPS, Sample, Scene, State, Vec2};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Most road users that get new futures in one call.
pub(super) const MOST_ACTORS: usize = 128;
/// Most road users for which every mode is shown while it refines; above, the likeliest alone.
const SHOW_ALL_BELOW: usize = 5;
/// Steps of guidance on a conflicting draft, and the share of the push taken at each.
const GUIDANCE: (usize, f32) = (12, 0.35);

/// Cost of a motion that is off the lanes all the time.
const OFF_LANES: f64 = 8.0;
/// The same for one with a corner beyond the road's edges, and how far beyond counts, metres.
const PAST_EDGES: f64 = 8.0;
const PAST_EDGE_M: f64 = 0.1;

type Residuals = [[f32; RESIDUAL]; MODES];

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
    map: Arc<EncodedMap>,
    number: usize,
    step: usize,
    pub(super) actors: Vec<Actor>,
    batches: Vec<Batch>,
    drafts: Vec<Residuals>,
    /// Slots by falling probability, one list an actor.
    order: Vec<[usize; MODES]>,
    /// The mode that stands for each actor while the others refine.
    standing_for: Vec<usize>,
    sample: usize,
    pullback: Pullback,
}

impl<'g> Window<'g> {
    /// First drafts of everybody concerned; [`Window::begin_sample`] comes next.
    pub(super) fn plan(
        generator: &'g Generator,
        request: Arc<Request>,
        map: Arc<EncodedMap>,
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
            sample: 0,
            pullback: Pullback::default(),
        };
        let scene = window.scene.clone();
        let mut world = World::new(&scene, window.map.index.clone(), spec.step);
        world.sight = window.request.stages.sight;
        let role = |index| spec.moving.iter().find(|m| m.0 == index).map(|m| m.1);
        let wanted: Vec<_> =
            world.present.iter().filter_map(|p| role(p.index).map(|role| (p, role))).collect();
        let mut actors = parallel::map(generator.threads(), &wanted, |(who, role)| {
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
        window.batches = batches;
        window.actors = actors;
        Ok(window)
    }

    /// The scene at the window's start.
    pub(super) fn world(&self) -> World<'_> {
        World::new(&self.scene, self.map.index.clone(), self.step)
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
        let pose = |p: &Present| {
            let mut poses = [[0.0; 4]; INSTANTS];
            for (i, pose) in poses.iter_mut().enumerate() {
                let step = (i + 1) * PER_INSTANT;
                if let Some(s) = kept_state(world.scene, world.agent(p), world.step, step) {
                    *pose = pose_of(s.position(), s.heading_rad);
                }
            }
            (poses, half_size(p))
        };
        self.in_the_way(world).map(pose).collect()
    }

    /// Those who keep their motion and count.
    fn in_the_way<'w>(&self, world: &'w World<'_>) -> impl Iterator<Item = &'w Present> {
        let acting: BTreeSet<usize> = self.actors.iter().map(|a| a.planned.present.index).collect();
        let count = self.request.stages.kept_in_the_way;
        world.present.iter().filter(move |p| count && !acting.contains(&p.index))
    }

    /// The present drafts as futures that can be shown.
    pub(super) fn draft(&self, step: usize) -> Draft {
        let all = self.request.stream_all || self.actors.len() < SHOW_ALL_BELOW;
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let shown = parallel::map(self.generator.threads(), &indices, |&i| {
            let modes = if all { self.request.modes } else { 1 };
            let motions = self.motions(i, modes);
            (self.actors[i].id.clone(), self.futures(0, &motions))
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
            let motion = realise(&actor.planned, slot, &self.drafts[i][slot]);
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

    /// Chooses one future each. Those that keep what they do, or whose future is pinned, are left out.
    pub(super) fn decide(&self) -> Vec<Decided> {
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let mut motions: Vec<Vec<(f64, usize, Motion)>> =
            parallel::map(self.generator.threads(), &indices, |&i| {
                let mut motions = self.motions(i, MODES);
                motions.extend(self.extras(i, &motions));
                motions
            });
        let world = self.world();
        let fixed = self.in_the_way(&world).map(|p| kept_boxes(&world, p)).collect();
        let mut choice = Choice { agents: Vec::new(), fixed };
        for (actor, motions) in self.actors.iter().zip(&motions) {
            choice.agents.push(options(actor, motions, &self.map));
        }
        let mut chosen = match self.request.stages.shown {
            Shown::Chosen => choice.solve(),
            Shown::Likeliest | Shown::Drawn => self.unchosen(&motions, &choice),
        };
        if self.request.stages.guidance {
            self.guide(&world, &mut choice, &mut motions, &mut chosen);
        }
        let mut decided = Vec::with_capacity(self.actors.len());
        for (i, actor) in self.actors.iter().enumerate() {
            let Some(shown) = shown_motion(actor, chosen[i]) else { continue };
            let mut motions = std::mem::take(&mut motions[i]);
            // Any other motion takes the place of the mode it is nearest to or was made from.
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
            decided.push(Decided { agent: actor.planned.present.index, actor: i, chosen: index, motions });
        }
        decided
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

    /// Motions that may be shown beside the modes, each under the slot of the mode it is nearest to.
    ///
    /// On the way to a goal that is the first anchor's own base, the formula's answer: it counts among the modes
    /// with a weight of its own. Without one it is, for each path that has several modes, their mean, which is
    /// nearer to all of them than any one is.
    fn extras(&self, i: usize, motions: &[(f64, usize, Motion)]) -> Vec<(f64, usize, Motion)> {
        let actor = &self.actors[i];
        if actor.pinned.is_some() || actor.keeps_its_path() || self.mode_count(i) == 1 {
            return Vec::new();
        }
        let under = |group: &[&(f64, usize, Motion)], weight: f64, motion: Motion| {
            let apart = |m: &(f64, usize, Motion)| distance(&m.2.states, &motion.states);
            let nearest = group.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?.1;
            Some((weight, nearest, motion))
        };
        if has_base(actor) {
            let group: Vec<&(f64, usize, Motion)> = motions.iter().collect();
            let motion = realise(&actor.planned, 0, &[0.0; RESIDUAL]);
            return under(&group, base_weight(actor), motion).into_iter().collect();
        }
        let path = |slot: usize| actor.planned.anchors[slot].identity / 8;
        let mut paths: Vec<Vec<&(f64, usize, Motion)>> = Vec::new();
        for motion in motions.iter().filter(|m| m.1 < MODES) {
            match paths.iter_mut().find(|group| path(group[0].1) == path(motion.1)) {
                Some(group) => group.push(motion),
                None => paths.push(vec![motion]),
            }
        }
        let of_path = |group: Vec<&(f64, usize, Motion)>| {
            let drafts: Vec<_> = group.iter().map(|m| (m.0, m.1, self.drafts[i][m.1])).collect();
            under(&group, 0.0, middle(&actor.planned, &drafts))
        };
        paths.into_iter().filter(|group| group.len() > 1).filter_map(of_path).collect()
    }

    /// Modes of an actor before extras and guidance added to them.
    fn mode_count(&self, i: usize) -> usize {
        let actor = &self.actors[i];
        if actor.rests && (actor.stays_parked || !actor.planned.target.is_free()) { 1 } else { MODES }
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
            let modes = motions[i].iter().take(self.mode_count(i));
            let slots: Vec<(f64, usize)> = modes.map(|m| (m.0, m.1)).collect();
            slots
                .into_iter()
                .filter_map(|(p, slot)| {
                    Some((p, slot, self.guided(actor, slot, &self.drafts[i][slot], &others)?))
                })
                .collect::<Vec<_>>()
        });
        for (i, guided) in concerned.into_iter().zip(guided) {
            motions[i].extend(guided);
            choice.agents[i] = options(&self.actors[i], &motions[i], &self.map);
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
}

/// Levels of the refinement steps: from the leapfrog start, or from as high up as many steps need.
fn levels(request: &Request) -> Vec<(usize, usize)> {
    schedule::ddim(schedule::START.max(request.steps), request.steps)
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

/// Whether the base of the first anchor is an option: it is one motion of its own where there is a place to go.
fn has_base(actor: &Actor) -> bool {
    let moves = actor.pinned.is_none() && !actor.keeps_its_path() && !actor.rests;
    moves && actor.planned.target.position.is_some()
}

/// What the base counts beside the modes, whose probabilities sum to 1. People on foot take the way of least
/// effort more often than anything learned from simulated walkers says.
fn base_weight(actor: &Actor) -> f64 {
    if actor.planned.present.agent_type == AgentType::Pedestrian { 1.0 } else { 0.25 }
}

/// What an actor can do: its motions, after what it keeps (reacting) or has pinned.
fn options(actor: &Actor, motions: &[(f64, usize, Motion)], map: &EncodedMap) -> Vec<Choosable> {
    let size = &actor.planned.present.size;
    if let Some(pinned) = &actor.pinned {
        let boxes = super::choice::swept_kept(|step| pinned.get(step - 1).copied(), size);
        return vec![Choosable { boxes, cost: 0.0 }];
    }
    let all: Vec<&Trajectory> = motions.iter().map(|m| &m.2.states).collect();
    let counted = MODES + usize::from(has_base(actor));
    let modes: Vec<(&Trajectory, f64)> = motions.iter().take(counted).map(|m| (&m.2.states, m.0)).collect();
    let mut out = Vec::with_capacity(motions.len() + 1);
    match &actor.kept {
        None => {
            for (motion, cost) in motions.iter().zip(medoid_costs(&all, &modes)) {
                // A goal missed is worse than anything but an overlap.
                let missed = if motion.2.reach.is_reached() { 0.0 } else { 3.0 };
                let off = off_road(actor, &motion.2.states, map);
                out.push(Choosable { boxes: swept(&motion.2.states, size), cost: cost + missed + off });
            }
        }
        Some(kept) => {
            let boxes = super::choice::swept_kept(|step| kept.get(step - 1).copied(), size);
            out.push(Choosable { boxes, cost: 0.0 });
            for motion in motions {
                let boxes = swept(&motion.2.states, size);
                let off = off_road(actor, &motion.2.states, map);
                out.push(Choosable { boxes, cost: 0.6 + deviation_m(&motion.2.states, kept) / 4.0 + off });
            }
        }
    }
    out
}

/// What it costs a vehicle that starts on a lane to be away from every lane, and one that starts within the
/// road's edges to have a corner beyond them.
fn off_road(actor: &Actor, states: &Trajectory, map: &EncodedMap) -> f64 {
    let present = &actor.planned.present;
    if present.agent_type != AgentType::Vehicle || states.is_empty() {
        return 0.0;
    }
    let away = |s: &MotionState| map.index.graph.nearest_for(s.position, 2.5, present.agent_type).is_empty();
    let beyond = |s: &MotionState| {
        let outline = OrientedBox::of_state(&State::from(s), &present.size);
        map.drivable.box_outside_m(&outline).is_some_and(|outside| outside > PAST_EDGE_M)
    };
    let looked_at = || states.iter().step_by(PER_INSTANT);
    let share = |off: &dyn Fn(&MotionState) -> bool| {
        if off(&states[0]) {
            0.0
        } else {
            looked_at().filter(|s| off(s)).count() as f64 / (INSTANTS + 1) as f64
        }
    };
    OFF_LANES * share(&away) + PAST_EDGES * share(&beyond)
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
