//! All operations over one engine.

use crate::export::{self, MotionChoice, WrittenFile};
use crate::feedback::FeedbackDoc;
use crate::generate::{GenerateRequest, GenerationRun};
use crate::home::{Home, SceneRef, Subject};
use crate::import::{Companions, ReadFile, SceneFile};
use crate::info::{BuildInfo, ProgramInfo};
use crate::limits::{Bound, CallLimits};
use crate::map::{MapBody, MapReply};
use crate::place::{PlaceBody, PlaceReply};
use crate::problem::Problem;
use crate::runs::{PeekBody, PeekReply, RunBody, StepBody, StepReply};
use crate::score::{ScoreRequest, score};
use experts::{Cancel, Clock, Engine, Generator, Placer, Run};
use formats::Source;
use scene::Scene;
use scene::score::Score;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

/// The operations. Cheap to clone.
#[derive(Clone)]
pub struct Operations {
    /// Scenes and conditions to futures.
    pub generator: Arc<Generator>,
    /// Maps to road users.
    pub placer: Arc<Placer>,
    /// Bounds of one call.
    pub limits: CallLimits,
    /// What drafts and timings are measured by; it stands unless a carrier hands one in.
    pub clock: Clock,
}

impl Operations {
    /// Over an engine, with the usual bounds and without a clock.
    pub fn new(engine: Engine) -> Self {
        Self {
            generator: Arc::new(engine.generator),
            placer: Arc::new(engine.placer),
            limits: CallLimits::default(),
            clock: || Duration::ZERO,
        }
    }

    /// The scene that a request names.
    ///
    /// # Errors
    /// As [`SceneRef::open`].
    pub async fn open<H: Home>(&self, wanted: SceneRef, home: &H) -> Result<Subject, Problem> {
        wanted.open(home).await
    }

    /// The scenes of a file: `window.1` of them at most, after `window.0`.
    ///
    /// # Errors
    /// As [`SceneFile::of`] and [`SceneFile::read`].
    pub fn import(
        &self,
        file: &dyn Source,
        format: Option<&str>,
        name: &str,
        companions: &Companions,
        window: (usize, usize),
    ) -> Result<ReadFile, Problem> {
        SceneFile::of(file, format, name, companions, window)?.read(file)
    }

    /// Road users where there are none yet.
    ///
    /// # Errors
    /// Every fault of the options; a cancelled call.
    pub fn place(
        &self,
        request: &PlaceBody,
        about: &Subject,
        cancel: &Cancel,
    ) -> Result<PlaceReply, Problem> {
        Ok(PlaceReply::of(&request.run(&about.scene, &self.placer, cancel)?, &about.scene))
    }

    /// A map from nothing.
    ///
    /// # Errors
    /// Every fault of the parameters.
    pub fn map(&self, request: MapBody) -> Result<MapReply, Problem> {
        request.reply()
    }

    /// Futures, event after event. Dropping the iterator ends the work.
    ///
    /// # Errors
    /// Every fault of the options, conditions and ids.
    pub fn generate(
        &self,
        request: &GenerateRequest,
        about: &Subject,
        cancel: Cancel,
    ) -> Result<GenerationRun<'_>, Problem> {
        let mut plan = request.plan(&about.scene, &self.limits, &self.generator)?;
        plan.standings = about.standings.clone();
        plan.start(&self.generator, cancel, self.clock)
    }

    /// The next round of cards, by what a person said of earlier ones.
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

    /// Begins a run: traffic that is stepped, beside road users that the caller drives.
    ///
    /// # Errors
    /// As [`RunBody::begin`].
    pub fn begin_run(&self, request: &RunBody, about: &Subject, cancel: &Cancel) -> Result<Run, Problem> {
        request.begin(&about.scene, &self.generator, cancel)
    }

    /// One step of a run.
    ///
    /// # Errors
    /// As [`StepBody::step`].
    pub fn step_run(&self, request: &StepBody, run: &mut Run, cancel: &Cancel) -> Result<StepReply, Problem> {
        Ok((&request.step(run, &self.generator, cancel)?).into())
    }

    /// What the others of a run would do if egos drove these plans.
    ///
    /// # Errors
    /// As [`PeekBody::peek`].
    pub fn peek_run(&self, request: &PeekBody, run: &Run, cancel: &Cancel) -> Result<PeekReply, Problem> {
        Ok(PeekReply::of(run, &request.peek(run, &self.generator, cancel)?))
    }

    /// Collisions, near misses, off-road driving, kinematics, goals.
    ///
    /// # Errors
    /// Every fault of the given motion and thresholds.
    pub fn score(&self, request: &ScoreRequest, about: &Subject) -> Result<Score, Problem> {
        score(about, request, self.generator.maps())
    }

    /// A scene as a file.
    ///
    /// # Errors
    /// As [`export::write`].
    pub fn export(
        &self,
        scene: &Scene,
        format: &str,
        sample: Option<usize>,
        motion: MotionChoice,
    ) -> Result<WrittenFile, Problem> {
        export::write(scene, format, sample, motion, None)
    }

    /// Version, weights, limits and formats.
    pub fn info(&self, build: BuildInfo, limits: BTreeMap<&'static str, Bound>) -> ProgramInfo {
        ProgramInfo::new(&self.generator, &self.placer, build, limits)
    }
}
