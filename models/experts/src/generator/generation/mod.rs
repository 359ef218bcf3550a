//! One call: planning windows one after the other, each from the states that the previous one reached, and
//! the answer from what was executed.
//!
//! A window plans 9 s ahead. Its first seconds, up to the next replanning, are executed. The next window
//! starts every agent from its state at that time. It is the end of the executed future, else the log, else
//! extrapolated straight on. Motion of an earlier window is not replanned.

mod base_scene;
mod future_relations;
mod ledger;
mod related;
mod remedies;
mod roster;
mod scenes;
mod spans;
mod targets;
mod verdicts;
mod window;

use super::drafting::steps;
use super::resources::Resources;
use super::window_setting::WindowSetting;
use super::{report, rounds};
use crate::clock::milliseconds;
use crate::maps::{KnownMap, Maps};
use crate::planning::pullback::Pullback;
use crate::planning::world::World;
use crate::request::{Accepted, Answer, Event, GenerateError, Request, Warning};
use ledger::Ledger;
use related::Related;
use roster::{CallPart, Roster};
use scene::Cancel;
use scene::{MAX_HORIZON_STEPS, Sample, Scene};
use spans::Spans;
use std::sync::Arc;
use std::time::Duration;
use targets::{Targets, due};
use window::PlanningWindow;

/// The next part of a call.
#[derive(Clone, Copy)]
enum CallStage {
    Accept,
    /// First drafts of the window with this number.
    Initial(usize),
    /// A window's number and its refinement step, from 1.
    Step(usize, usize),
    Finish,
    Done,
}

/// The windows of a call that are planned at present.
struct CallWindows<'g> {
    spans: Spans,
    /// The scene that windows are cut from: the call's scene, with kept motions known to the last window's
    /// end.
    base: Arc<Scene>,
    /// The world at the start of the first window, until that window is planned.
    start: Option<World<'g>>,
    /// `first` serves all samples; `later` serves only the present sample.
    first: Option<PlanningWindow<'g>>,
    later: Option<PlanningWindow<'g>>,
}

impl<'g> CallWindows<'g> {
    fn present(&self) -> Result<&PlanningWindow<'g>, GenerateError> {
        self.later.as_ref().or(self.first.as_ref()).ok_or(GenerateError::NoWindow)
    }

    fn present_mut(&mut self) -> Result<&mut PlanningWindow<'g>, GenerateError> {
        self.later.as_mut().or(self.first.as_mut()).ok_or(GenerateError::NoWindow)
    }
}

/// A call in progress: an iterator of events that ends with the final one.
pub struct Generation<'g> {
    resources: &'g Resources,
    request: Arc<Request>,
    cancel: Cancel,
    map: Arc<KnownMap>,
    stage: CallStage,
    roster: Roster,
    windows: CallWindows<'g>,
    ledger: Ledger,
    related: Related,
}

impl<'g> Generation<'g> {
    pub(super) fn new(
        resources: &'g Resources,
        maps: &Maps,
        mut request: Request,
        cancel: Cancel,
    ) -> Result<Self, GenerateError> {
        let started = (resources.clock)();
        request.horizon_steps = request.horizon_steps.clamp(1, MAX_HORIZON_STEPS);
        let map = maps.known_unless(&request.scene.map, &cancel).ok_or(GenerateError::Cancelled)?;
        let first = |call: Request| Self::new(resources, maps, call, cancel.clone())?.finished();
        let (request, related) = Related::of(&map, request, first)?;
        let request = Arc::new(request);
        let start = world(resources, &map, &request, request.scene.clone(), request.start_step);
        let spans = Spans::of(&request);
        let (roster, base) = Roster::of(&request, &start, &spans)?;
        // Agents that are present at the start have the same state in both scenes.
        let start = World { scene: base.clone().into(), ..start };
        let windows = CallWindows { spans, base, start: Some(start), first: None, later: None };
        let mut ledger = Ledger::default();
        ledger.timings.encode_ms = milliseconds(resources.clock, started);
        let stage = CallStage::Accept;
        Ok(Self { resources, request, cancel, map, stage, roster, windows, ledger, related })
    }

    /// Runs the call to its answer.
    pub(super) fn finished(self) -> Result<Answer, GenerateError> {
        for event in self {
            if let Event::Final(answer) = event? {
                return Ok(answer);
            }
        }
        Err(GenerateError::Expert("the call ended without an answer".into()))
    }

    fn accept(&self) -> Accepted {
        let agents = &self.request.scene.agents;
        let ids = |is: fn(CallPart) -> bool| self.roster.with(is).map(|i| agents[i].id.clone()).collect();
        Accepted {
            seed: self.request.seed,
            regenerated: ids(CallPart::is_asked),
            reacting: ids(CallPart::answers),
            fixed: ids(|part| !part.is_asked() && !part.answers()),
            steps: self.request.steps,
            windows: self.windows.spans.count(),
            warnings: Vec::new(),
        }
    }

    /// Plans a window and makes it the present one.
    fn begin_window(&mut self, number: usize) -> Result<(), GenerateError> {
        if number == 0 && self.windows.first.is_some() {
            self.windows.later = None;
            return Ok(());
        }
        let started = (self.resources.clock)();
        let span = self.windows.spans.window(number);
        let mut world = match self.windows.start.take() {
            Some(start) if number == 0 => start,
            _ => {
                let step = self.request.start_step + span.start;
                let scene = scenes::reached(&self.windows.base, &self.roster, &self.ledger, step);
                world(self.resources, &self.map, &self.request, Arc::new(scene), step)
            }
        };
        let executed = |i| self.ledger.progress(i).map_or(&[][..], |p| &p.executed);
        let targets = Targets::of(&self.request, &world, number, executed);
        for (agent, goal) in targets.goals {
            world.aim(agent, goal);
        }
        for (agent, via) in targets.vias {
            world.lead(agent, via);
        }
        let end = self.request.start_step + span.end;
        let mut cast = self.roster.in_window(number, &world, end, &self.ledger);
        cast.parked = self.ledger.parked();
        let (request, map) = (self.request.clone(), self.map.clone());
        let (resources, pullback) = (self.resources, Pullback::default());
        let setting = WindowSetting { resources, request, map, world, number, pullback };
        let mut window = PlanningWindow::plan(setting, &cast)?;
        window.subgoals = targets.subgoals;
        if number == 0 {
            self.ledger.warnings = self.first_warnings(&window);
            self.windows.first = Some(window);
        } else {
            self.windows.later = Some(window);
        }
        if self.ledger.sample() == 0 {
            self.ledger.timings.initial_ms += self.since(started);
        }
        Ok(())
    }

    fn first_warnings(&self, window: &PlanningWindow<'_>) -> Vec<Warning> {
        report::warnings(&window.setting.world, window.actors(), |i| {
            let due = due(&self.request, i).clamp(1, MAX_HORIZON_STEPS as isize);
            (&self.request.scene.agents[i].conditions, due as usize)
        })
    }

    /// Milliseconds since the clock read `started`.
    fn since(&self, started: Duration) -> f64 {
        milliseconds(self.resources.clock, started)
    }

    fn begin(&mut self, number: usize) -> Result<(), GenerateError> {
        self.begin_window(number)?;
        let sample = self.ledger.sample();
        self.windows.present_mut()?.begin_sample(sample)
    }

    fn refine(&mut self, step: usize) -> Result<(), GenerateError> {
        let started = (self.resources.clock)();
        self.windows.present_mut()?.refine(step)?;
        if self.ledger.sample() == 0 {
            let took_ms = self.since(started);
            self.ledger.timings.step_ms.push(took_ms);
        }
        Ok(())
    }

    /// Chooses one future per actor and executes it up to the start of the next window.
    fn execute(&mut self, number: usize) -> Result<(), GenerateError> {
        let started = (self.resources.clock)();
        let span = self.windows.spans.window(number);
        let window = self.windows.present()?;
        let (decisions, base) = (window.decide(), &self.windows.base);
        for decided in &decisions.actors {
            self.ledger.follow(&self.request, base, window, decided, span.clone());
        }
        self.ledger.would_react(window, &decisions);
        for reacted in &decisions.reacted {
            self.ledger.react(&self.request, base, window, reacted, span.clone());
        }
        self.ledger.timings.choice_ms += self.since(started);
        Ok(())
    }

    fn finish_sample(&mut self) -> Result<(), GenerateError> {
        for agent in self.roster.with(|part| part == CallPart::Picked) {
            let last = self.request.horizon_steps;
            let ends = self.roster.pick_ends(agent).map_or(last, |step| step - 1 - self.request.start_step);
            self.ledger.followed(&self.request, &self.windows.base, agent, last.min(ends));
        }
        let world = &self.windows.first.as_ref().ok_or(GenerateError::NoWindow)?.setting.world;
        let guesses = self.roster.guesses();
        let mut sample = self.ledger.finish_sample(&self.request, world, guesses, &self.related);
        let instead = self.ledger.take_instead();
        if self.request.stages.judged {
            verdicts::judge(&self.request, &self.map, &self.resources.workers, &mut sample, &instead);
            if self.ledger.samples.is_empty() {
                let ways = remedies::by_road(&self.request, world, &self.map, &sample);
                self.ledger.remedy(ways);
            }
        }
        self.ledger.samples.push(sample);
        Ok(())
    }

    fn answer(&mut self) -> Result<Answer, GenerateError> {
        let windows = self.windows.spans.count();
        self.execute(windows - 1)?;
        self.finish_sample()?;
        while self.ledger.sample() < self.request.samples.max(1) {
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
        let mut answer = self.ledger.answer(windows);
        if let Some(feedback) = &self.request.feedback {
            rounds::choose(&self.request, feedback, &mut answer);
        }
        Ok(answer)
    }

    /// The futures of the last draft event. They are made only when requested, because most drafts are
    /// superseded before anyone displays them. Later results do not depend on this call. `score` is empty.
    ///
    /// # Errors
    /// Before the first draft event.
    pub fn drafted(&mut self) -> Result<Sample, GenerateError> {
        Ok(self.windows.present_mut()?.drafted())
    }

    fn stop_if_cancelled(&self) -> Result<(), GenerateError> {
        if self.cancel.is_cancelled() { Err(GenerateError::Cancelled) } else { Ok(()) }
    }

    /// The stage after the last draft of a window.
    fn after(&self, number: usize) -> CallStage {
        if number + 1 < self.windows.spans.count() {
            CallStage::Initial(number + 1)
        } else {
            CallStage::Finish
        }
    }

    fn advance(&mut self) -> Result<Event, GenerateError> {
        self.stop_if_cancelled()?;
        match self.stage {
            CallStage::Accept => {
                self.stage = CallStage::Initial(0);
                Ok(Event::Accepted(self.accept()))
            }
            CallStage::Initial(number) => {
                if let Some(last) = number.checked_sub(1) {
                    self.execute(last)?;
                }
                self.begin(number)?;
                let refines = steps(&self.request) > 0;
                self.stage = if refines { CallStage::Step(number, 1) } else { self.after(number) };
                Ok(Event::Draft(self.windows.present()?.draft(0)))
            }
            CallStage::Step(number, step) => {
                self.refine(step)?;
                let more = step < steps(&self.request);
                self.stage = if more { CallStage::Step(number, step + 1) } else { self.after(number) };
                Ok(Event::Draft(self.windows.present()?.draft(step)))
            }
            CallStage::Finish | CallStage::Done => {
                self.stage = CallStage::Done;
                Ok(Event::Final(self.answer()?))
            }
        }
    }
}

impl Iterator for Generation<'_> {
    type Item = Result<Event, GenerateError>;

    fn next(&mut self) -> Option<Self::Item> {
        if matches!(self.stage, CallStage::Done) {
            return None;
        }
        let event = self.advance();
        if event.is_err() {
            self.stage = CallStage::Done;
        }
        Some(event)
    }
}

/// A scene at one step, with what the request says about planning.
fn world<'g>(
    resources: &'g Resources,
    map: &KnownMap,
    request: &Request,
    scene: Arc<Scene>,
    step: usize,
) -> World<'g> {
    let world = World::new(scene, map.graph.clone(), step);
    World { planning: request.stages.planning, tuning: &resources.tuning, ..world }
}
