//! The ledger of a call: every agent's motion so far in the present sample, and the parts of the answer.

use super::related::Related;
use super::targets::due;
use super::window::PlanningWindow;
use crate::generator::actor::PlannedActor;
use crate::generator::candidates::MotionCandidate;
use crate::generator::decisions::{Decided, Decisions};
use crate::generator::extrapolation::Guessed;
use crate::generator::others::Reacted;
use crate::generator::report::{self, AgentOutcome};
use crate::planning::world::World;
use crate::request::{
    Answer, ByRoad, Intermediate, ReachReport, Request, Resolved, Timings, Warning, WarningCode,
};
use crate::sentences;
use scene::{AgentFutures, AgentId, Future, STEP_S, Sample, Scene, State};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// The motion of an agent so far in the present sample.
pub(super) struct AgentProgress {
    /// Its futures in the first window that gave it any.
    futures: AgentFutures,
    /// Executed states up to the start of the next window. They begin after the call's start or, for an agent
    /// that entered later, after its first step.
    pub(super) executed: Vec<State>,
    /// Steps of the call that passed before `executed`.
    absent: usize,
    /// The agent was parked at the start and has not moved.
    parked: bool,
    reach: ReachReport,
    intermediate: Vec<Intermediate>,
    /// The agent keeps its path and changes its timing to yield to another agent.
    reacts: bool,
    /// The rest of its plan in the last window, after the executed steps.
    ahead: Vec<State>,
}

impl AgentProgress {
    fn new(futures: AgentFutures, executed: Vec<State>, absent: usize) -> Self {
        let reach = ReachReport::Reached { position_m: 0.0, heading_rad: 0.0, speed_mps: 0.0 };
        let (parked, reacts) = (false, false);
        let (intermediate, ahead) = (Vec::new(), Vec::new());
        Self { futures, executed, absent, parked, reach, intermediate, reacts, ahead }
    }

    /// Adds the states of a known motion that the agent followed up to `steps` after the call's start.
    fn catch_up(&mut self, request: &Request, base: &Scene, agent: usize, steps: usize) {
        let track = &base.agents[agent].track;
        let from = self.absent + self.executed.len() + 1;
        self.executed.extend((from..=steps).filter_map(|i| track.at(request.start_step + i).copied()));
    }
}

/// Everything that a call records on its way to the answer.
#[derive(Default)]
pub(super) struct Ledger {
    progress: BTreeMap<usize, AgentProgress>,
    pub(super) samples: Vec<Sample>,
    resolved: BTreeMap<AgentId, Resolved>,
    /// Reactions to unshown futures in the present sample.
    instead: Instead,
    pub(super) warnings: Vec<Warning>,
    pub(super) timings: Timings,
}

/// The reactions of others to each unshown future of an agent, by agent and future. `None` stands for an
/// agent that keeps its motion.
pub(super) type Instead = BTreeMap<(usize, usize), Vec<(usize, Option<AgentFutures>)>>;

impl Ledger {
    /// The progress of an agent in the present sample, if it got futures.
    pub(super) fn progress(&self, agent: usize) -> Option<&AgentProgress> {
        self.progress.get(&agent)
    }

    /// Agents that got futures in the present sample.
    pub(super) fn acted(&self) -> BTreeSet<usize> {
        self.progress.keys().copied().collect()
    }

    /// Agents that react on their own path: their reached states and the plans from there.
    pub(super) fn reacting(&self) -> BTreeMap<usize, Vec<State>> {
        let reacting = self.progress.iter().filter(|(_, p)| p.reacts);
        let ahead = |p: &AgentProgress| p.executed.last().into_iter().chain(&p.ahead).copied().collect();
        reacting.map(|(i, p)| (*i, ahead(p))).collect()
    }

    /// Agents of the sample that were parked at the start and have not moved.
    pub(super) fn parked(&self) -> BTreeSet<usize> {
        self.progress.iter().filter(|(_, p)| p.parked).map(|(i, _)| *i).collect()
    }

    /// Number of the present sample, from 0.
    pub(super) fn sample(&self) -> usize {
        self.samples.len()
    }

    /// Records the motion of a road user in the steps `span` after the call's start, which a window executes.
    /// `base` has its motion before the window in which it first leaves its kept motion.
    pub(super) fn follow(
        &mut self,
        request: &Request,
        base: &Scene,
        window: &PlanningWindow<'_>,
        decided: &Decided,
        span: Range<usize>,
    ) {
        let agent = decided.agent;
        let actor = &window.actors()[decided.actor];
        let later = span.start > 0;
        let since_s = later.then(|| (request.start_step + span.start) as f64 * STEP_S);
        let reach = report::reach_report(actor, decided.motion(), since_s, decided.blocked_by.as_ref());
        let mut progress = match self.progress.remove(&agent) {
            Some(known) => AgentProgress { parked: known.parked && decided.rests(), reacts: false, ..known },
            None => first_of(window, actor, decided, later, before(base, request, agent, span.start), &reach),
        };
        progress.catch_up(request, base, agent, span.start);
        progress.executed.extend(decided.motion().states.iter().skip(1).take(span.len()).map(State::from));
        // After the goal's time its verdict does not change.
        if due(request, agent) > span.start as isize {
            if let Some(sent) = window.subgoals.get(&agent) {
                let reached = decided.motion().reach.is_reached();
                progress.intermediate.push(Intermediate { reached, ..*sent });
            }
            progress.reach = reach;
        }
        self.progress.insert(agent, progress);
    }

    /// Records the motion of a reacting agent in these steps.
    pub(super) fn react(
        &mut self,
        request: &Request,
        base: &Scene,
        window: &PlanningWindow<'_>,
        reacted: &Reacted,
        span: Range<usize>,
    ) {
        // The agent enters, or departs from its kept motion, after these steps: a later window records that.
        let there = span.len().saturating_sub(reacted.enters);
        let agent = reacted.index;
        if there > 0 && reacted.stays_out() {
            let out = AgentProgress::new(window.reaction(reacted), Vec::new(), 0);
            self.progress.insert(agent, AgentProgress { reacts: true, ..out });
            return;
        }
        if there == 0 || there <= reacted.own && !self.progress.contains_key(&agent) {
            return;
        }
        let mut progress = self.progress.remove(&agent).unwrap_or_else(|| {
            let executed = before(base, request, agent, span.start);
            let absent = window.setting.world.step + reacted.enters - request.start_step - executed.len();
            AgentProgress::new(window.reaction(reacted), executed, absent)
        });
        progress.executed.extend(reacted.states.iter().take(there));
        progress.ahead = reacted.states.iter().skip(there).copied().collect();
        progress.reacts = true;
        self.progress.insert(agent, progress);
    }

    /// Records the reactions of the others to unshown futures.
    pub(super) fn would_react(&mut self, window: &PlanningWindow<'_>, decisions: &Decisions) {
        let shown = || decisions.reacted.iter().map(|a| a.index);
        for decided in &decisions.actors {
            for (k, reactions) in decided.reactions.iter().enumerate() {
                let Some(reactions) = reactions else { continue };
                let who: BTreeSet<usize> = shown().chain(reactions.iter().map(|a| a.index)).collect();
                let future = |agent: usize| {
                    let reacted = reactions.iter().find(|a| a.index == agent)?;
                    Some(window.reaction(reacted))
                };
                let instead = who.into_iter().map(|agent| (agent, future(agent))).collect();
                self.instead.insert((decided.agent, k), instead);
            }
        }
    }

    /// Takes the motions that [`Ledger::would_react`] recorded.
    pub(super) fn take_instead(&mut self) -> Instead {
        std::mem::take(&mut self.instead)
    }

    /// Records that an agent followed a picked future up to `steps` after the call's start.
    pub(super) fn followed(&mut self, request: &Request, base: &Scene, agent: usize, steps: usize) {
        if let Some(progress) = self.progress.get_mut(&agent) {
            progress.catch_up(request, base, agent, steps);
        }
    }

    /// Ends a sample: one continuous future for each agent. The first sample also settles the outcome of all
    /// conditions; `world` is that of the first window.
    pub(super) fn finish_sample(
        &mut self,
        request: &Request,
        world: &World<'_>,
        guesses: impl Iterator<Item = (usize, Guessed)>,
        related: &Related,
    ) -> Sample {
        let progress = std::mem::take(&mut self.progress);
        if self.samples.is_empty() {
            self.resolve(request, world, &progress, related);
            self.warn_of_guesses(request, &progress, guesses);
        }
        let mut sample = Sample::default();
        for (i, AgentProgress { mut futures, executed, absent, .. }) in progress {
            if let Some(future) = futures.modes.get_mut(futures.chosen) {
                let first_step = request.start_step + 1 + absent;
                *future = Future { first_step, states: executed, ..future.clone() };
            }
            sample.agents.insert(request.scene.agents[i].id.clone(), futures);
        }
        related.restore(&mut sample.agents);
        sample
    }

    /// The outcome of every agent's conditions.
    fn resolve(
        &mut self,
        request: &Request,
        world: &World<'_>,
        progress: &BTreeMap<usize, AgentProgress>,
        related: &Related,
    ) {
        let agents = &request.scene.agents;
        for (i, progress) in progress {
            let Some(present) = world.present.iter().find(|p| p.index == *i) else { continue };
            let due = due(request, *i).max(1) as usize;
            let end = progress.executed.get(due - 1).or(progress.executed.last());
            let outcome = AgentOutcome {
                present,
                conditions: &agents[*i].conditions,
                due_step: request.start_step + due,
                end: end.copied().unwrap_or(present.start),
                states: std::iter::once(present.start).chain(progress.executed.iter().copied()).collect(),
                reach: progress.reach.clone(),
                intermediate: progress.intermediate.clone(),
                unrelated: related.unrelated.get(i),
            };
            self.resolved.insert(agents[*i].id.clone(), report::resolved(world, outcome));
        }
        for (id, report) in related.reports() {
            self.resolved.insert(id.clone(), report.clone());
        }
    }

    /// Records the remedies for goals that are reached off the road.
    pub(super) fn remedy(&mut self, ways: BTreeMap<AgentId, ByRoad>) {
        for (id, way) in ways {
            if let Some(resolved) = self.resolved.get_mut(&id) {
                resolved.by_road = Some(way);
            }
        }
    }

    fn warn_of_guesses(
        &mut self,
        request: &Request,
        progress: &BTreeMap<usize, AgentProgress>,
        guesses: impl Iterator<Item = (usize, Guessed)>,
    ) {
        let end = request.start_step + request.horizon_steps;
        for (i, guessed) in guesses {
            if progress.contains_key(&i) || !guessed.moving || guessed.step > end {
                continue;
            }
            let message = sentences::motion_ends(guessed.step as f64 * STEP_S);
            let id = &request.scene.agents[i].id;
            self.warnings.push(Warning::of(WarningCode::Extrapolated, id, message));
        }
    }

    /// The answer, once all samples are finished.
    pub(super) fn answer(&mut self, windows: usize) -> Answer {
        for (id, resolved) in &self.resolved {
            if let ReachReport::Unreachable { message, .. } = &resolved.reach {
                let known =
                    |w: &Warning| w.code == WarningCode::GoalUnreachable && w.agent.as_ref() == Some(id);
                if !self.warnings.iter().any(known) {
                    self.warnings.push(Warning::of(WarningCode::GoalUnreachable, id, message.clone()));
                }
            }
        }
        for (id, resolved) in &self.resolved {
            for (k, via) in resolved.via.iter().enumerate().filter(|(_, via)| !via.passed) {
                let message = sentences::via_missed(k + 1, via.distance_m, via.time_s, via.tolerance_m);
                self.warnings.push(Warning::of(WarningCode::ViaMissed, id, message));
            }
        }
        let Self { samples, resolved, warnings, timings, .. } = std::mem::take(self);
        Answer { samples, windows, resolved, warnings, timings, round: None }
    }
}

/// The part of the answer from a road user's first window, with its alternatives. An agent that joins in a
/// later window has only its shown future.
fn first_of(
    window: &PlanningWindow<'_>,
    actor: &PlannedActor,
    decided: &Decided,
    later: bool,
    executed: Vec<State>,
    reach: &ReachReport,
) -> AgentProgress {
    let mut futures = if later {
        window.futures(actor, 0, &[MotionCandidate { probability: 1.0, ..decided.shown().clone() }])
    } else {
        window.futures(actor, decided.chosen, &decided.alternatives)
    };
    futures.reaction.clone_from(&decided.reaction);
    let absent = window.setting.world.step - window.setting.request.start_step - executed.len();
    let parked = actor.is_parked() && decided.rests();
    AgentProgress { parked, reach: reach.clone(), ..AgentProgress::new(futures, executed, absent) }
}

/// States of an agent before the window in which it first leaves its kept motion. The start is left out, as
/// for any agent; for an agent that entered later it is the first state.
fn before(base: &Scene, request: &Request, agent: usize, steps: usize) -> Vec<State> {
    let track = &base.agents[agent].track;
    let start = request.start_step;
    let late = usize::from(track.at(start).is_none());
    (1..=steps).filter_map(|i| track.at(start + i).copied()).skip(late).collect()
}
