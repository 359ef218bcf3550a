//! From one moment of a run to the next: all move, some enter and leave, some replan, the others react.

use super::agents::{DrivenPlan, EgoMotion, NEVER_PLANNED, Presence};
use super::borders::{departure, has_room};
use super::contacts::{RunFault, Stepped, faults};
use super::error::RunError;
use super::moment::RunMoment;
use super::settings::{EgoState, MOST_RUN_MS};
use super::state::{Run, RunChange, RunDeparture, RunStep};
use crate::generator::Generator;
use crate::maps::KnownMap;
use crate::request::Request;
use scene::Cancel;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::judge::{Fault, FaultKind};
use scene::routes::LaneGraph;
use scene::{AgentId, AgentType, STEP_S, Size, State};
use std::collections::{BTreeMap, BTreeSet};

/// Most road users that plan in one call when a run begins; in a step, at most one more.
const MOST_AT_ONCE: usize = 64;
/// A road user that reacted is due to replan in the next step if its last plan is at least this old, milliseconds.
const SURPRISED_AFTER_MS: i64 = 500;

impl Run {
    /// The checked states of the egos, by index into the scene's agents.
    pub(super) fn checked(&self, egos: &[EgoState]) -> Result<BTreeMap<usize, EgoState>, RunError> {
        let mut known = BTreeMap::new();
        for ego in egos {
            let at = self.index(&ego.id)?;
            if !matches!(self.agents[at].presence, Presence::Ego(_)) {
                return Err(RunError::NotAnEgo(ego.id.clone()));
            }
            ego.check()?;
            if known.insert(at, ego.clone()).is_some() {
                return Err(RunError::EgoTwice(ego.id.clone()));
            }
        }
        match self.egos().into_iter().find(|id| !egos.iter().any(|ego| ego.id == **id)) {
            Some(id) => Err(RunError::EgoMissing(id.clone())),
            None if self.elapsed_ms + u64::from(self.settings.step_ms) > MOST_RUN_MS => {
                Err(RunError::Over { most: self.number })
            }
            None => Ok(known),
        }
    }

    /// Plans all present road users for the first time.
    pub(super) fn plan_all(&mut self, generator: &Generator, cancel: &Cancel) -> Result<(), RunError> {
        let graph = generator.maps().graph(&self.scene.map);
        let all = self.planners();
        for some in all.chunks(MOST_AT_ONCE) {
            self.plan(generator, &graph, some, cancel)?;
        }
        // From now on they plan in turn.
        let interval_ms = i64::from(self.settings.plan_interval_ms);
        for (turn, i) in all.iter().enumerate() {
            if let Presence::Driven(plan) = &mut self.agents[*i].presence {
                plan.planned_ms = -(interval_ms * turn as i64 / all.len().max(1) as i64);
            }
        }
        Ok(())
    }

    /// Makes one step.
    pub(super) fn advance(
        &mut self,
        generator: &Generator,
        egos: BTreeMap<usize, EgoState>,
        cancel: &Cancel,
    ) -> Result<RunStep, RunError> {
        let map = generator.maps().known(&self.scene.map);
        let before: Vec<Option<State>> =
            self.agents.iter().map(|own| own.presence.state(self.elapsed_ms)).collect();
        self.number += 1;
        self.elapsed_ms += u64::from(self.settings.step_ms);
        self.move_egos(egos);
        let left = self.see_off(&map);
        let entered = self.let_in();
        self.pass_vias();
        let faults = self.faults(&before, &map.graph);
        let acting = self.due();
        let changes = self.plan(generator, &map.graph, &acting, cancel)?;
        Ok(RunStep { changes, faults, entered, left, ..self.present() })
    }

    fn move_egos(&mut self, egos: BTreeMap<usize, EgoState>) {
        let step_s = f64::from(self.settings.step_ms) / 1e3;
        for (at, EgoState { state, plan, .. }) in egos {
            if let Presence::Ego(motion) = &mut self.agents[at].presence {
                let brakes_mps2 = ((motion.state.speed_mps() - state.speed_mps()) / step_s).max(0.0);
                *motion = EgoMotion { state, plan, brakes_mps2 };
            }
        }
    }

    /// Removes the driven road users that leave in this step.
    fn see_off(&mut self, map: &KnownMap) -> Vec<RunDeparture> {
        let (step, now_ms) = (self.scene_step(), self.elapsed_ms);
        let mut left = Vec::new();
        for (own, agent) in self.agents.iter_mut().zip(&self.scene.agents) {
            let Presence::Driven(plan) = &own.presence else { continue };
            if let Some(reason) = departure(agent, &plan.at(now_ms), step, &map.graph, map.extent) {
                own.presence = Presence::Gone;
                left.push(RunDeparture { agent: agent.id.clone(), reason });
            }
        }
        left
    }

    /// Lets road users enter at their first recorded place after the start of the run, once its time has come and there
    /// is room.
    fn let_in(&mut self) -> Vec<AgentId> {
        let (step, now_ms, start) = (self.scene_step(), self.elapsed_ms, self.settings.start_step);
        let size = |i: usize| {
            let agent = &self.scene.agents[i];
            agent.conditions.size_of(agent.size)
        };
        let mut there: Vec<(State, Size)> = (0..self.agents.len())
            .filter_map(|i| Some((self.agents[i].presence.state(now_ms)?, size(i))))
            .collect();
        let mut entered = Vec::new();
        for (i, agent) in self.scene.agents.iter().enumerate() {
            if self.agents[i].presence != Presence::Coming {
                continue;
            }
            let first = agent.track.valid_steps().find(|at| *at > start).filter(|at| *at <= step);
            let Some(state) = first.and_then(|at| agent.track.at(at).copied()) else { continue };
            if has_room(&state, &size(i), &there) {
                self.agents[i].presence = Presence::Driven(DrivenPlan::fresh(now_ms, state));
                there.push((state, size(i)));
                entered.push(agent.id.clone());
            }
        }
        entered
    }

    /// Counts the via points that have been passed.
    fn pass_vias(&mut self) {
        let (step, now_ms) = (self.scene_step(), self.elapsed_ms);
        for (own, agent) in self.agents.iter_mut().zip(&self.scene.agents) {
            let Some(state) = own.presence.state(now_ms) else { continue };
            let Some(via) = agent.conditions.via.get(own.vias_passed) else { continue };
            let late = via.time_s.is_some_and(|time_s| step as f64 * STEP_S >= time_s);
            if late || via.time_s.is_none() && (via.position - state.position()).norm() <= via.tolerance_m {
                own.vias_passed += 1;
            }
        }
    }

    fn faults(&self, before: &[Option<State>], graph: &LaneGraph) -> Vec<RunFault> {
        let stepped = self.agents.iter().zip(&self.scene.agents).zip(before);
        let stepped = stepped.filter_map(|((own, agent), before)| {
            let now = own.presence.state(self.elapsed_ms)?;
            let size = agent.conditions.size_of(agent.size);
            Some(Stepped { id: &agent.id, agent_type: agent.kind(), size, now, before: *before })
        });
        faults(&stepped.collect::<Vec<_>>(), self.time_s(), graph)
    }

    /// Road users that can plan, by id.
    fn planners(&self) -> Vec<usize> {
        let plans = |i: &usize| {
            let driven = matches!(self.agents[*i].presence, Presence::Driven(_));
            driven && self.scene.agents[*i].kind() != AgentType::Other
        };
        let mut all: Vec<usize> = (0..self.agents.len()).filter(plans).collect();
        all.sort_by(|a, b| self.scene.agents[*a].id.cmp(&self.scene.agents[*b].id));
        all
    }

    /// Road users that replan in this step, the oldest plans first: about one step's share of all, and those
    /// that have never planned.
    fn due(&self) -> Vec<usize> {
        let all = self.planners();
        let planned_ms = |i: usize| match &self.agents[i].presence {
            Presence::Driven(plan) => plan.planned_ms,
            _ => i64::MAX,
        };
        let interval_ms = i64::from(self.settings.plan_interval_ms);
        let now_ms = self.elapsed_ms as i64;
        let mut due: Vec<usize> =
            all.iter().copied().filter(|i| planned_ms(*i).saturating_add(interval_ms) <= now_ms).collect();
        // A stable sort: plans of one age stay sorted by id.
        due.sort_by_key(|i| planned_ms(*i));
        let steps = self.settings.plan_interval_ms.div_ceil(self.settings.step_ms).max(1) as usize;
        let fresh = due.iter().filter(|i| planned_ms(**i) == NEVER_PLANNED).count();
        due.truncate(all.len().div_ceil(steps).max(fresh).min(MOST_AT_ONCE) + 1);
        due
    }

    /// Extends every plan as far as the generator reads.
    pub(super) fn carry_on(&mut self, graph: &LaneGraph) {
        let now_ms = self.elapsed_ms;
        for (own, agent) in self.agents.iter_mut().zip(&self.scene.agents) {
            if let Presence::Driven(plan) = &mut own.presence {
                plan.carry_on(now_ms, graph, agent.kind());
            }
        }
    }

    /// Replans these road users; all others react to them and to the egos.
    fn plan(
        &mut self,
        generator: &Generator,
        graph: &LaneGraph,
        acting: &[usize],
        cancel: &Cancel,
    ) -> Result<Vec<RunChange>, RunError> {
        self.carry_on(graph);
        let request = RunMoment::of(self, graph, &BTreeMap::new()).request(self, acting);
        self.answer(generator, request, acting, cancel)
    }

    /// Takes over the plans of a call. Returns the road users that reacted.
    pub(super) fn answer(
        &mut self,
        generator: &Generator,
        request: Request,
        acting: &[usize],
        cancel: &Cancel,
    ) -> Result<Vec<RunChange>, RunError> {
        let mut answer = generator.answer_unless(request, cancel.clone())?;
        let now_ms = self.elapsed_ms;
        let mut changes = Vec::new();
        let sample =
            if answer.samples.is_empty() { Default::default() } else { answer.samples.swap_remove(0) };
        let acting: BTreeSet<usize> = acting.iter().copied().collect();
        for i in &acting {
            if let Presence::Driven(plan) = &mut self.agents[*i].presence {
                plan.planned_ms = now_ms as i64;
            }
        }
        for (id, mut futures) in sample.agents {
            let at = self.index(&id)?;
            let Presence::Driven(plan) = &mut self.agents[at].presence else { continue };
            if futures.chosen >= futures.modes.len() {
                continue;
            }
            let states = futures.modes.swap_remove(futures.chosen).states;
            plan.states = std::iter::once(plan.at(now_ms)).chain(states).collect();
            plan.from_ms = now_ms;
            if let Some(reaction) = futures.reaction {
                let interval_ms = i64::from(self.settings.plan_interval_ms);
                if !acting.contains(&at)
                    && (now_ms as i64).saturating_sub(plan.planned_ms) >= SURPRISED_AFTER_MS
                {
                    plan.planned_ms = plan.planned_ms.min(now_ms as i64 - interval_ms);
                }
                changes.push(RunChange { agent: id, reaction });
            }
        }
        Ok(changes)
    }

    /// The first collision of each ego with each other road user, if all drive as in a peek.
    pub(super) fn peeked_faults(
        &self,
        graph: &LaneGraph,
        announced: &BTreeMap<usize, Vec<State>>,
        futures: &BTreeMap<AgentId, Vec<State>>,
    ) -> Vec<RunFault> {
        let mut found = Vec::new();
        for (i, own) in self.agents.iter().enumerate() {
            let Presence::Ego(motion) = &own.presence else { continue };
            let ego = &self.scene.agents[i];
            let expected = || motion.expected(graph, ego.kind()).split_off(1);
            let states = announced.get(&i).cloned().unwrap_or_else(expected);
            let size = ego.conditions.size_of(ego.size);
            for (id, others) in futures {
                let Some(other) = self.scene.agent(id) else { continue };
                let other_size = other.conditions.size_of(other.size);
                let met = |(a, b): (&State, &State)| {
                    overlaps(&OrientedBox::of_state(a, &size), &OrientedBox::of_state(b, &other_size), 0.0)
                };
                let Some(k) = states.iter().zip(others).position(met) else { continue };
                let (time_s, at) = (self.time_s() + (k + 1) as f64 * STEP_S, states[k].position());
                let closing = (states[k].velocity() - others[k].velocity()).norm();
                let fault = Fault {
                    kind: FaultKind::Collision,
                    time_s,
                    until_s: time_s,
                    x_m: at.x,
                    y_m: at.y,
                    extent: Some((closing * 1e3).round() / 1e3),
                    with: Some(id.clone()),
                    edge: None,
                };
                found.push(RunFault { agent: ego.id.clone(), fault });
            }
        }
        found
    }
}
