//! The operations that need the engine. The others are in their own modules: reading a file
//! ([`crate::import::SceneFile`]), opening a scene ([`crate::SceneRef::open`]), building a map
//! ([`crate::map::MapBody::reply`]) and writing a file ([`crate::export`]).

use crate::feedback::FeedbackDoc;
use crate::generate::{GenerateRequest, GenerationPlan, GenerationRun};
use crate::home::Subject;
use crate::info::{BuildInfo, ProgramInfo};
use crate::limits::{Bound, CallLimits};
use crate::place::PlaceBody;
use crate::problem::Problem;
use crate::runs::{PeekBody, RunBody, StepBody};
use crate::score::{ScoreRequest, score};
use experts::placement::Placement;
use experts::run::{RunPeek, RunStep};
use experts::{Cancel, Clock, Engine, Generator, Placer, Run};
use scene::Scene;
use scene::score::Score;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

/// The operations over one engine. Cheap to clone.
#[derive(Clone)]
pub struct Operations {
    /// Scenes and conditions to futures.
    pub generator: Arc<Generator>,
    /// Maps to road users.
    pub placer: Arc<Placer>,
    /// Limits of one call.
    pub limits: CallLimits,
    /// Clock for drafts and timings. It never advances unless a transport sets another one.
    pub clock: Clock,
}

impl Operations {
    /// Operations over an engine, with the default limits and without a clock.
    pub fn new(engine: Engine) -> Self {
        Self {
            generator: Arc::new(engine.generator),
            placer: Arc::new(engine.placer),
            limits: CallLimits::default(),
            clock: || Duration::ZERO,
        }
    }

    /// The same engine with separate threads, `threads` for each generation.
    pub fn beside(&self, threads: usize) -> Self {
        Self { generator: Arc::new(self.generator.beside(threads)), ..self.clone() }
    }

    /// Checks a generation, which can then be priced and queued before it starts.
    ///
    /// # Errors
    /// Every fault of the options, conditions and ids.
    pub fn plan(&self, request: &GenerateRequest, about: &Subject) -> Result<GenerationPlan, Problem> {
        let mut plan = request.plan(&about.scene, &self.limits, &self.generator)?;
        plan.standings = about.standings.clone();
        Ok(plan)
    }

    /// Starts a plan: an iterator of its events. Dropping the iterator ends the work.
    ///
    /// # Errors
    /// A scene that the engine refuses; a cancelled call.
    pub fn start(&self, plan: GenerationPlan, cancel: Cancel) -> Result<GenerationRun<'_>, Problem> {
        plan.start(&self.generator, cancel, self.clock)
    }

    /// [`Self::plan`] followed by [`Self::start`].
    ///
    /// # Errors
    /// Those of both.
    pub fn generate(
        &self,
        request: &GenerateRequest,
        about: &Subject,
        cancel: Cancel,
    ) -> Result<GenerationRun<'_>, Problem> {
        self.start(self.plan(request, about)?, cancel)
    }

    /// The next round of cards, from a person's feedback on earlier ones.
    ///
    /// # Errors
    /// As [`Self::generate`].
    pub fn feedback(
        &self,
        request: &GenerateRequest,
        feedback: FeedbackDoc,
        about: &Subject,
        cancel: Cancel,
    ) -> Result<GenerationRun<'_>, Problem> {
        let request = GenerateRequest { feedback: Some(feedback), ..request.clone() };
        self.generate(&request, about, cancel)
    }

    /// Places road users on a map.
    ///
    /// # Errors
    /// Every fault of the options; a cancelled call.
    pub fn place(
        &self,
        request: &PlaceBody,
        scene: &Arc<Scene>,
        cancel: &Cancel,
    ) -> Result<Placement, Problem> {
        request.run(scene, &self.placer, cancel)
    }

    /// Begins a run: stepped traffic around road users that the caller drives.
    ///
    /// # Errors
    /// As [`RunBody::begin`].
    pub fn begin_run(&self, request: &RunBody, scene: &Arc<Scene>, cancel: &Cancel) -> Result<Run, Problem> {
        request.begin(scene, &self.generator, cancel)
    }

    /// Makes one step of a run.
    ///
    /// # Errors
    /// As [`StepBody::step`].
    pub fn step_run(&self, request: &StepBody, run: &mut Run, cancel: &Cancel) -> Result<RunStep, Problem> {
        request.step(run, &self.generator, cancel)
    }

    /// What the others of a run would do if egos drove these plans.
    ///
    /// # Errors
    /// As [`PeekBody::peek`].
    pub fn peek_run(&self, request: &PeekBody, run: &Run, cancel: &Cancel) -> Result<RunPeek, Problem> {
        request.peek(run, &self.generator, cancel)
    }

    /// Scores collisions, near misses, off-road driving, kinematics and goals.
    ///
    /// # Errors
    /// Every fault of the given motion and thresholds.
    pub fn score(&self, request: &ScoreRequest, about: &Subject) -> Result<Score, Problem> {
        score(about, request, self.generator.maps())
    }

    /// Version, weights, limits and formats.
    pub fn info(&self, build: BuildInfo, limits: BTreeMap<&'static str, Bound>) -> ProgramInfo {
        ProgramInfo::new(&self.generator, &self.placer, build, limits)
    }
}
