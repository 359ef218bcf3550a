//! One call: planning windows one after the other, each from the states that the last one reached, and
//! the answer made of what was executed.
//!
//! A window plans 9 s ahead; its first seconds, up to the next re-planning, are executed. The next one
//! sees everybody where they are by then: those with futures where these led, the rest on their log (or
//! straight on where it has ended). Nothing of an earlier window is planned again.

mod scenes;

use super::actor::{Guessed, Role};
use super::report::{self, Outcome};
use super::window::{Decided, MOST_ACTORS, Spec, Window, steps};
use super::{Generator, KnownMap};
use crate::features::world::World;
use crate::request::{
    Accepted, Answer, Cancel, Event, GenerateError, Intermediate, ReachReport, React, Request, Resolved,
    Timings, Warning, WarningCode,
};
use scene::{
    AgentFutures, AgentId, AgentType, Future, HORIZON_STEPS, MAX_HORIZON_STEPS, STEP_S, Sample, Scene, State,
};
use scenes::{find, known_to_the_end, within_reach};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

#[derive(Clone, Copy)]
enum Stage {
    Accept,
    /// First drafts of a window.
    Initial(usize),
    /// A window's refinement step, from 1.
    Step(usize, usize),
    Finish,
    Done,
}

/// What a road user has done so far in the present sample.
struct Progress {
    role: Role,
    /// Of the window in which it first got any.
    futures: AgentFutures,
    /// To where the next window begins, from the step after the call's start or, for one that came in
    /// later, after its first.
    executed: Vec<State>,
    /// Steps of the call that passed before `executed`.
    absent: usize,
    /// Was parked at the start and has not moved.
    parked: bool,
    reach: ReachReport,
    intermediate: Vec<Intermediate>,
}

/// A call under way: yields events until the final one.
pub struct Generation<'g> {
    generator: &'g Generator,
    request: Arc<Request>,
    cancel: Cancel,
    map: Arc<KnownMap>,
    stage: Stage,
    /// Steps after the call's start that each window executes.
    spans: Vec<Range<usize>>,
    /// What the windows are cut from: the call's scene, with what is kept known to the last window's end.
    base: Arc<Scene>,
    /// From where on nothing is known of road users that keep their motion.
    guessed: BTreeMap<usize, Guessed>,
    regenerated: BTreeSet<usize>,
    candidates: BTreeSet<usize>,
    /// Those that keep a future which ends before the call does: they plan on from its end.
    continuing: BTreeSet<usize>,
    /// Those that come in after the start of a call that is about everybody: they plan on where their log
    /// ends.
    arriving: BTreeSet<usize>,
    /// The first window serves all samples, the present one this sample alone.
    first: Option<Window<'g>>,
    later: Option<Window<'g>>,
    sent: BTreeMap<usize, Intermediate>,
    progress: BTreeMap<usize, Progress>,
    sample: usize,
    samples: Vec<Sample>,
    resolved: BTreeMap<AgentId, Resolved>,
    warnings: Vec<Warning>,
    timings: Timings,
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

/// Steps that each window executes, from the call's start.
fn spans(request: &Request) -> Vec<Range<usize>> {
    let horizon = request.horizon_steps.clamp(1, MAX_HORIZON_STEPS);
    let interval = request.replan_steps.unwrap_or(HORIZON_STEPS).clamp(1, HORIZON_STEPS);
    (0..horizon).step_by(interval).map(|from| from..horizon.min(from + interval)).collect()
}

impl<'g> Generation<'g> {
    pub(super) fn new(
        generator: &'g Generator,
        mut request: Request,
        cancel: Cancel,
    ) -> Result<Self, GenerateError> {
        request.horizon_steps = request.horizon_steps.clamp(1, MAX_HORIZON_STEPS);
        let started = Instant::now();
        let scene = request.scene.clone();
        let map = generator.known_map(&scene.map);
        let world = World::new(&scene, map.graph.clone(), request.start_step);
        let movable: BTreeSet<usize> =
            world.present.iter().filter(|p| p.agent_type != AgentType::Other).map(|p| p.index).collect();
        let regenerated = match &request.agents {
            None => movable.clone(),
            Some(ids) => find(&scene, &movable, ids)?,
        };
        let spans = spans(&request);
        let candidates = match &request.react {
            React::Nobody => BTreeSet::new(),
            // Who is near is looked at again in each window.
            React::Everyone if spans.len() > 1 => movable.difference(&regenerated).copied().collect(),
            React::Everyone => within_reach(&world, &movable, &regenerated),
            React::Only(ids) => find(&scene, &movable, ids)?.difference(&regenerated).copied().collect(),
        };
        let found = regenerated.len();
        if found > MOST_ACTORS {
            return Err(GenerateError::TooManyAgents { found, most: MOST_ACTORS });
        }
        let everybody = request.agents.is_none() || matches!(request.react, React::Everyone);
        let here: BTreeSet<usize> = world.present.iter().map(|p| p.index).collect();
        drop(world);
        let (base, guessed) = if spans.len() > 1 {
            known_to_the_end(&request, &regenerated, &spans)
        } else {
            (scene.clone(), BTreeMap::new())
        };
        let keeps_a_future = |i: &usize| {
            let generated = scene.generated.as_ref();
            generated.is_some_and(|g| g.chosen_future(&scene.agents[*i].id).is_some())
        };
        let continuing = guessed
            .keys()
            .filter(|i| movable.contains(i) && !regenerated.contains(i) && !candidates.contains(i))
            .filter(|i| keeps_a_future(i))
            .copied()
            .collect();
        let moves = |i: &usize| {
            let agent = &scene.agents[*i];
            agent.conditions.agent_type.unwrap_or(agent.agent_type) != AgentType::Other
        };
        let late = guessed.keys().filter(|i| everybody && !here.contains(i) && moves(i));
        let arriving = late.copied().collect();
        Ok(Self {
            generator,
            request: Arc::new(request),
            cancel,
            map,
            stage: Stage::Accept,
            spans,
            base,
            guessed,
            regenerated,
            candidates,
            continuing,
            arriving,
            first: None,
            later: None,
            sent: BTreeMap::new(),
            progress: BTreeMap::new(),
            sample: 0,
            samples: Vec::new(),
            resolved: BTreeMap::new(),
            warnings: Vec::new(),
            timings: Timings { encode_ms: milliseconds(started), ..Timings::default() },
        })
    }

    fn accept(&self) -> Accepted {
        let agents = &self.request.scene.agents;
        let ids = |set: &BTreeSet<usize>| set.iter().map(|i| agents[*i].id.clone()).collect();
        let reacting = &(&self.candidates | &self.continuing) | &self.arriving;
        let moved = |i: &usize| self.regenerated.contains(i) || self.reacting(i);
        let fixed: BTreeSet<usize> = (0..agents.len()).filter(|i| !moved(i)).collect();
        Accepted {
            seed: self.request.seed,
            regenerated: ids(&self.regenerated),
            reacting: ids(&reacting),
            fixed: ids(&fixed),
            steps: self.request.steps,
            windows: self.spans.len(),
            warnings: Vec::new(),
        }
    }

    fn reacting(&self, agent: &usize) -> bool {
        [&self.candidates, &self.continuing, &self.arriving].iter().any(|set| set.contains(agent))
    }

    /// Steps after the call's start at which the goal of a road user is due; the end when nobody said.
    fn due(&self, agent: usize) -> isize {
        let goal = &self.request.scene.agents[agent].conditions.goal;
        match goal.time_s {
            Some(t) => (t / STEP_S).round() as isize - self.request.start_step as isize,
            None => self.request.horizon_steps as isize,
        }
    }

    /// Plans a window and makes it the present one.
    fn begin_window(&mut self, number: usize) -> Result<(), GenerateError> {
        if number == 0 && self.first.is_some() {
            self.later = None;
            return Ok(());
        }
        let started = Instant::now();
        let step = self.request.start_step + self.spans[number].start;
        let mut scene = if number == 0 { self.base.clone() } else { Arc::new(self.reached(number)) };
        self.aim(number, &mut scene);
        let world = World::new(&scene, self.map.graph.clone(), step);
        let answering = self.progress.iter().filter(|(i, _)| !self.regenerated.contains(i));
        // A picked future is kept: after the first window it is a motion like any other that is.
        let picked =
            |i: &&usize| number > 0 && self.request.pinned.contains_key(&self.request.scene.agents[**i].id);
        let regenerated = self.regenerated.iter().filter(|i| !picked(i));
        let regenerated = regenerated.map(|i| (*i, Role::Regenerated));
        let mut moving: Vec<(usize, Role)> =
            regenerated.chain(answering.map(|(i, p)| (*i, p.role))).collect();
        let mut candidates: BTreeSet<usize> =
            self.candidates.iter().filter(|i| !self.progress.contains_key(i)).copied().collect();
        if number > 0 {
            // Nothing is left to keep for those whose log ends in what this window executes.
            let end = self.request.start_step + self.spans[number].end;
            let ended = |i: &&usize| self.guessed.get(i).is_some_and(|g| g.step <= end);
            let room = MOST_ACTORS.saturating_sub(moving.len());
            let seen = |i: &&usize| self.base.agents[**i].track.at(step).is_some();
            let arrived = self.arriving.iter().filter(|i| !self.progress.contains_key(i)).filter(seen);
            let ended: Vec<usize> =
                candidates.iter().chain(arrived).filter(ended).take(room).copied().collect();
            candidates.retain(|i| !ended.contains(i));
            moving.extend(ended.into_iter().map(|i| (i, Role::Reacting)));
            let over = |i: &&usize| self.guessed.get(i).is_some_and(|g| g.step <= step + 1);
            let new = self.continuing.iter().filter(|i| !self.progress.contains_key(i)).filter(over);
            let room = MOST_ACTORS.saturating_sub(moving.len());
            moving.extend(new.take(room).map(|i| (*i, Role::Reacting)));
        }
        if matches!(self.request.react, React::Everyone) {
            let sources = moving.iter().map(|m| m.0).collect();
            candidates = within_reach(&world, &candidates, &sources);
        }
        drop(world);
        let parked = self.progress.iter().filter(|(_, p)| p.parked).map(|(i, _)| *i).collect();
        let spec = Spec { number, step, scene, moving, candidates: &candidates, parked: &parked };
        let window = Window::plan(self.generator, self.request.clone(), self.map.clone(), spec)?;
        if number == 0 {
            let asked = |i: usize| {
                let due = self.due(i).clamp(1, MAX_HORIZON_STEPS as isize);
                (&self.request.scene.agents[i].conditions, due as usize)
            };
            self.warnings = report::warnings(&window.world(), &window.actors, asked);
            self.first = Some(window);
        } else {
            self.later = Some(window);
        }
        if self.sample == 0 {
            self.timings.initial_ms += milliseconds(started);
        }
        Ok(())
    }

    fn window(&self) -> Result<&Window<'g>, GenerateError> {
        self.later.as_ref().or(self.first.as_ref()).ok_or_else(no_window)
    }

    fn window_mut(&mut self) -> Result<&mut Window<'g>, GenerateError> {
        self.later.as_mut().or(self.first.as_mut()).ok_or_else(no_window)
    }

    fn begin(&mut self, number: usize) -> Result<(), GenerateError> {
        self.begin_window(number)?;
        let sample = self.sample;
        self.window_mut()?.begin_sample(sample)
    }

    fn refine(&mut self, step: usize) -> Result<(), GenerateError> {
        let started = Instant::now();
        self.window_mut()?.refine(step)?;
        if self.sample == 0 {
            self.timings.step_ms.push(milliseconds(started));
        }
        Ok(())
    }

    /// Chooses one future each and goes along them to where the next window starts.
    fn execute(&mut self, number: usize) -> Result<(), GenerateError> {
        let started = Instant::now();
        let decided = self.window()?.decide();
        for decided in &decided {
            self.follow(number, decided)?;
        }
        self.timings.choice_ms += milliseconds(started);
        Ok(())
    }

    fn follow(&mut self, number: usize, decided: &Decided) -> Result<(), GenerateError> {
        let span = self.spans[number].clone();
        let window = self.later.as_ref().or(self.first.as_ref()).ok_or_else(no_window)?;
        let actor = &window.actors[decided.actor];
        let motion = decided.motion();
        let since_s = (number > 0).then(|| (self.request.start_step + span.start) as f64 * STEP_S);
        let reach = report::reach_report(actor, motion, since_s);
        let still_due = self.due(decided.agent) > span.start as isize;
        let sent = self.sent.get(&decided.agent).copied();
        let mut progress = match self.progress.remove(&decided.agent) {
            Some(known) => Progress { parked: known.parked && decided.rests(), ..known },
            None => {
                let futures = if number == 0 {
                    window.futures(decided.chosen, &decided.motions)
                } else {
                    let (_, slot, motion) = &decided.motions[decided.chosen];
                    window.futures(0, &[(1.0, *slot, motion.clone())])
                };
                let executed = self.before(decided.agent, span.start);
                let absent = span.start - executed.len();
                let role = actor.role;
                let parked = actor.is_parked() && decided.rests();
                let reach = reach.clone();
                Progress { role, futures, executed, absent, parked, reach, intermediate: Vec::new() }
            }
        };
        progress.executed.extend(motion.states.iter().skip(1).take(span.len()).map(State::from));
        // What was asked lies behind after the goal: the verdict stands.
        if still_due {
            if let Some(sent) = sent {
                progress.intermediate.push(Intermediate { reached: motion.reach.is_reached(), ..sent });
            }
            progress.reach = reach;
        }
        self.progress.insert(decided.agent, progress);
        Ok(())
    }

    /// What a road user that keeps its motion did before a window in which it first gives it up. The first
    /// state of one that came in later is its start and left out like any other's.
    fn before(&self, agent: usize, steps: usize) -> Vec<State> {
        let track = &self.base.agents[agent].track;
        let start = self.request.start_step;
        let late = usize::from(track.at(start).is_none());
        (1..=steps).filter_map(|i| track.at(start + i).copied()).skip(late).collect()
    }

    /// Ends a sample: one continuous future each.
    fn finish_sample(&mut self) -> Result<(), GenerateError> {
        let mut progress = std::mem::take(&mut self.progress);
        if self.sample == 0 {
            self.resolve(&progress)?;
            self.warn_of_guesses(&progress);
        }
        let mut sample = Sample::default();
        for (i, progress) in &mut progress {
            let mut futures =
                std::mem::replace(&mut progress.futures, AgentFutures { chosen: 0, modes: Vec::new() });
            if let Some(future) = futures.modes.get_mut(futures.chosen) {
                let states = std::mem::take(&mut progress.executed);
                let first_step = self.request.start_step + 1 + progress.absent;
                *future = Future { first_step, states, ..future.clone() };
            }
            sample.agents.insert(self.request.scene.agents[*i].id.clone(), futures);
        }
        self.samples.push(sample);
        self.sample += 1;
        Ok(())
    }

    /// What became of everybody's conditions, by the first sample.
    fn resolve(&mut self, progress: &BTreeMap<usize, Progress>) -> Result<(), GenerateError> {
        let world = self.first.as_ref().ok_or_else(no_window)?.world();
        let agents = &self.request.scene.agents;
        let mut resolved = BTreeMap::new();
        for (i, progress) in progress {
            let Some(present) = world.present.iter().find(|p| p.index == *i) else { continue };
            let due = self.due(*i).max(1) as usize;
            let end = progress.executed.get(due - 1).or(progress.executed.last());
            let outcome = Outcome {
                present,
                conditions: &agents[*i].conditions,
                due_step: self.request.start_step + due,
                end: end.copied().unwrap_or(present.start),
                reach: progress.reach.clone(),
                intermediate: progress.intermediate.clone(),
            };
            resolved.insert(agents[*i].id.clone(), report::resolved(&world, outcome));
        }
        self.resolved = resolved;
        Ok(())
    }

    fn warn_of_guesses(&mut self, progress: &BTreeMap<usize, Progress>) {
        let end = self.request.start_step + self.request.horizon_steps;
        for (i, guessed) in &self.guessed {
            if progress.contains_key(i) || !guessed.moving || guessed.step > end {
                continue;
            }
            self.warnings.push(Warning {
                code: WarningCode::Extrapolated,
                agent: Some(self.request.scene.agents[*i].id.clone()),
                detail: format!(
                    "Nothing says where it is from {:.1} s on; taken to go straight on at its speed.",
                    guessed.step as f64 * STEP_S
                ),
            });
        }
    }

    fn answer(&mut self) -> Result<Answer, GenerateError> {
        let windows = self.spans.len();
        self.execute(windows - 1)?;
        self.finish_sample()?;
        while self.sample < self.request.samples.max(1) {
            for number in 0..windows {
                self.stop_if_cancelled()?;
                self.begin(number)?;
                for step in 1..=steps(&self.request) {
                    self.stop_if_cancelled()?;
                    self.refine(step)?;
                }
                self.execute(number)?;
            }
            self.finish_sample()?;
        }
        for (id, resolved) in &self.resolved {
            if let ReachReport::Unreachable { words, .. } = &resolved.reach {
                let known =
                    |w: &Warning| w.code == WarningCode::GoalUnreachable && w.agent.as_ref() == Some(id);
                if !self.warnings.iter().any(known) {
                    let agent = Some(id.clone());
                    let code = WarningCode::GoalUnreachable;
                    self.warnings.push(Warning { code, agent, detail: words.clone() });
                }
            }
        }
        Ok(Answer {
            samples: std::mem::take(&mut self.samples),
            windows,
            resolved: std::mem::take(&mut self.resolved),
            warnings: std::mem::take(&mut self.warnings),
            timings: std::mem::take(&mut self.timings),
        })
    }

    fn stop_if_cancelled(&self) -> Result<(), GenerateError> {
        if self.cancel.is_cancelled() { Err(GenerateError::Cancelled) } else { Ok(()) }
    }

    /// What comes after the last draft of a window.
    fn after(&self, number: usize) -> Stage {
        if number + 1 < self.spans.len() { Stage::Initial(number + 1) } else { Stage::Finish }
    }

    fn advance(&mut self) -> Result<Event, GenerateError> {
        self.stop_if_cancelled()?;
        match self.stage {
            Stage::Accept => {
                self.stage = Stage::Initial(0);
                Ok(Event::Accepted(self.accept()))
            }
            Stage::Initial(number) => {
                if let Some(last) = number.checked_sub(1) {
                    self.execute(last)?;
                }
                self.begin(number)?;
                let refines = steps(&self.request) > 0;
                self.stage = if refines { Stage::Step(number, 1) } else { self.after(number) };
                Ok(Event::Draft(self.window()?.draft(0)))
            }
            Stage::Step(number, step) => {
                self.refine(step)?;
                let more = step < steps(&self.request);
                self.stage = if more { Stage::Step(number, step + 1) } else { self.after(number) };
                Ok(Event::Draft(self.window()?.draft(step)))
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

fn no_window() -> GenerateError {
    GenerateError::Expert("no window is planned".into())
}
