//! A generation in progress: drives the generator and converts its events to those of the API.

use super::{GenerationPlan, fill};
use crate::compact::FuturesForm;
use crate::events::{CALIBRATED, DraftBody, FinalBody, GeneratedHead, RoundBody, SampleBody, TimingBody};
use crate::problem::Problem;
use crate::score::with_standings;
use experts::{Accepted, Answer, Cancel, Clock, Event, GenerateError, Generator};
use experts::{Warning, WarningCode, sentences};
use scene::preference::Round;
use scene::score::{Score, ScoreInput};
use scene::{Sample, Scene};
use std::sync::Arc;
use std::time::Duration;

/// The events of a generation.
pub enum GenerationEvent {
    /// What will be done; the first event.
    Accepted(Accepted),
    /// The first draft, or the draft after a refinement step.
    Draft(DraftBody),
    /// The answer; the last event.
    Final(Box<GenerationAnswer>),
}

/// A generation in progress. Dropping it ends the work; its [`Cancel`] does so too, between two steps.
pub struct GenerationRun<'g> {
    plan: GenerationPlan,
    generator: &'g Generator,
    inner: experts::Generation<'g>,
    clock: Clock,
    began: Duration,
    /// When a draft was last sent.
    drafted: Option<Duration>,
    over: bool,
}

impl GenerationPlan {
    /// Starts a generation. `clock` decides which drafts come too soon, and measures the score. With a clock
    /// that never advances, a call with a `draft_delay_ms` has no drafts.
    ///
    /// # Errors
    /// The generator's errors.
    pub fn start(
        self,
        generator: &Generator,
        cancel: Cancel,
        clock: Clock,
    ) -> Result<GenerationRun<'_>, Problem> {
        let inner = generator.start(self.request.clone(), cancel)?;
        Ok(GenerationRun { plan: self, generator, inner, clock, began: clock(), drafted: None, over: false })
    }
}

impl Iterator for GenerationRun<'_> {
    type Item = Result<GenerationEvent, Problem>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_watched(&mut |_| {})
    }
}

impl GenerationRun<'_> {
    /// The next event. `watch` sees each step of the generator, even those without an event.
    pub fn next_watched(
        &mut self,
        watch: &mut dyn FnMut(&Event),
    ) -> Option<Result<GenerationEvent, Problem>> {
        while !self.over {
            let Some(event) = self.inner.next() else {
                self.over = true;
                let cause = "the generator ended without an answer";
                return Some(Err(GenerateError::Expert(cause.into()).into()));
            };
            let given = event.map_err(Problem::from).and_then(|event| {
                watch(&event);
                self.given(event)
            });
            self.over =
                !matches!(given, Ok(None | Some(GenerationEvent::Accepted(_) | GenerationEvent::Draft(_))));
            if let Some(given) = given.transpose() {
                return Some(given);
            }
        }
        None
    }

    fn given(&mut self, event: Event) -> Result<Option<GenerationEvent>, Problem> {
        match event {
            Event::Accepted(accepted) => Ok(Some(GenerationEvent::Accepted(accepted))),
            Event::Draft(draft) => {
                let GenerationPlan { drafts, all_modes, draft_delay, draft_interval, form, .. } = &self.plan;
                let now = (self.clock)();
                let soon = match self.drafted {
                    Some(sent) => draft.step > 0 && now.saturating_sub(sent) < *draft_interval,
                    None => now.saturating_sub(self.began) < *draft_delay,
                };
                if soon || !drafts {
                    return Ok(None);
                }
                let futures = self.inner.drafted()?;
                self.drafted = Some((self.clock)());
                Ok(Some(GenerationEvent::Draft(DraftBody::new(&draft, &futures, *all_modes, *form))))
            }
            Event::Final(answer) => {
                let answered = GenerationAnswer::new(&self.plan, answer, self.generator, self.clock);
                Ok(Some(GenerationEvent::Final(Box::new(answered))))
            }
        }
    }

    /// Runs to the answer, without the events before it.
    ///
    /// # Errors
    /// The generator's errors, and a cancelled call.
    pub fn answer(mut self) -> Result<GenerationAnswer, Problem> {
        self.plan.drafts = false;
        for event in self.by_ref() {
            if let GenerationEvent::Final(answered) = event? {
                return Ok(*answered);
            }
        }
        Err(Problem::internal("a generation ended without its answer"))
    }
}

/// The answer of a generation.
pub struct GenerationAnswer {
    /// The scene with this call's road users and conditions.
    pub scene: Arc<Scene>,
    /// The generator's answer.
    pub answer: Answer,
    /// Its samples, including the kept futures of other road users if they were requested.
    pub samples: Vec<Sample>,
    /// One per sample, if scores were requested.
    pub scores: Option<Vec<Score>>,
    /// The other members of `generated`; the transport sets its time.
    pub head: GeneratedHead,
    /// Six characters that identify the inputs of the answer.
    pub code: String,
    form: FuturesForm,
    score_ms: f64,
}

impl GenerationAnswer {
    /// The answer of a plan.
    pub fn new(plan: &GenerationPlan, mut answer: Answer, generator: &Generator, clock: Clock) -> Self {
        let named = plan.request.agents.as_ref().is_none_or(|asked| !asked.is_empty());
        if !named && answer.samples.iter().all(|sample| sample.agents.is_empty()) {
            let message = sentences::nothing_generated();
            answer.warnings.push(Warning::of_scene(WarningCode::NothingGenerated, message));
        }
        let scene = Arc::clone(&plan.request.scene);
        let (mut scores, mut score_ms) = (None, 0.0);
        let whole = (plan.with_kept || plan.score).then(|| whole(&scene, &answer.samples));
        if let Some(whole) = whole.as_ref().filter(|_| plan.score) {
            let began = clock();
            scores = Some(scored(plan, &scene, whole, &answer, generator));
            score_ms = clock().saturating_sub(began).as_secs_f64() * 1e3;
        }
        let samples = whole.filter(|_| plan.with_kept).unwrap_or_else(|| answer.samples.clone());
        let (head, code) = (plan.head.clone(), plan.code());
        Self { scene, answer, samples, scores, head, code, form: plan.form, score_ms }
    }

    /// Its JSON body.
    pub fn body(&self) -> FinalBody {
        let Self { answer, samples, .. } = self;
        let t = &answer.timings;
        let timing = TimingBody {
            queue_ms: 0.0,
            encode_ms: round_ms(t.encode_ms),
            initial_ms: round_ms(t.initial_ms),
            step_ms: t.step_ms.iter().copied().map(round_ms).collect(),
            choice_ms: round_ms(t.choice_ms),
            score_ms: round_ms(self.score_ms),
        };
        FinalBody {
            windows: answer.windows,
            samples: samples.iter().map(|sample| SampleBody::new(sample, self.form)).collect(),
            calibrated: CALIBRATED,
            resolved: answer.resolved.clone(),
            scores: self.scores.clone(),
            warnings: answer.warnings.clone(),
            feedback: answer.round.clone().map(|Round { cards, wishes, .. }| RoundBody { cards, wishes }),
            timing,
            code: self.code.clone(),
            generated: self.head.clone(),
        }
    }
}

/// The samples, including the kept futures of other road users.
fn whole(scene: &Scene, samples: &[Sample]) -> Vec<Sample> {
    let mut samples = samples.to_vec();
    samples.iter_mut().for_each(|sample| fill(scene, sample));
    samples
}

fn scored(
    plan: &GenerationPlan,
    scene: &Scene,
    whole: &[Sample],
    answer: &Answer,
    generator: &Generator,
) -> Vec<Score> {
    let drivable = generator.maps().drivable(&scene.map);
    let changed = answer.samples.iter().map(|sample| sample.agents.len());
    let score = |(sample, changed): (&Sample, usize)| {
        let mut input = ScoreInput::of_sample(scene, Some(sample), &drivable);
        input.thresholds = plan.request.thresholds;
        with_standings(&input, changed, plan.standings.as_deref())
    };
    whole.iter().zip(changed).map(score).collect()
}

/// Rounds to a hundredth.
pub fn round_ms(ms: f64) -> f64 {
    (ms * 100.0).round() / 100.0
}
