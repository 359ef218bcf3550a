//! One generation: drives the generator, turns its events into messages.

use super::events::{AcceptedBody, DraftBody, FinalBody, RoundBody, SampleBody, TimingBody};
use super::feed::Feed;
use super::outbox::End;
use super::{Task, kept, scoring};
use crate::base::metrics;
use crate::base::problem::Problem;
use crate::work::Kind;
use experts::weights::EXPERTS;
use experts::{Answer, Draft, Event, GenerateError, Generator};
use scene::preference::Round;
use scene::score::ScoreInput;
use scene::{Sample, Scene};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Works until the answer is sent, something fails, or the job is stopped. Between two events `others` may go.
pub fn generate(feed: &Feed, generator: &Generator, task: Task, others: impl Fn()) {
    let fail = |problem: Problem| {
        if feed.fail(problem) {
            metrics::ended(Kind::Generate.name(), "error");
        }
    };
    let queued = feed.ticket.elapsed();
    metrics::phase("queue", queued.as_secs_f64());
    let scene = Arc::clone(&task.request.scene);
    let mut generation = match generator.start(task.request.clone(), feed.ticket.cancel.clone()) {
        Ok(generation) => generation,
        Err(error) => return fail(error.into()),
    };
    let begun = Instant::now();
    let mut last_draft: Option<Instant> = None;
    while let Some(event) = generation.next() {
        others();
        match event {
            Ok(Event::Accepted(accepted)) => {
                if task.streams {
                    feed.send(AcceptedBody::new(accepted, feed.ticket.queue_position), None);
                }
            }
            Ok(Event::Draft(draft)) => {
                count(&scene, &draft);
                let soon = match last_draft {
                    Some(sent) => draft.step > 0 && sent.elapsed() < task.draft_interval,
                    None => begun.elapsed() < task.draft_delay,
                };
                if task.streams && !soon {
                    let futures = match generation.drafted() {
                        Ok(futures) => futures,
                        Err(error) => return fail(error.into()),
                    };
                    last_draft = Some(Instant::now());
                    feed.send(DraftBody::new(&draft, &futures, task.all_modes, task.form), None);
                    // Who writes it to the socket needs a core now, and all may be at work here: without this it
                    // waits out a time slice.
                    std::thread::yield_now();
                }
            }
            Ok(Event::Final(answer)) => {
                if feed.send(answered(&task, &answer, queued, generator), Some(End::Final)) {
                    metrics::ended(Kind::Generate.name(), "final");
                }
                return;
            }
            Err(error) => return fail(error.into()),
        }
    }
    fail(GenerateError::Expert("the generator ended without an answer".into()).into());
}

fn count(scene: &Scene, draft: &Draft) {
    let types = draft.agents.iter().filter_map(|id| scene.agent(id)).filter_map(expert_of);
    if draft.step == 0 {
        types.for_each(|expert| metrics::agents(expert, 1));
    } else {
        types.collect::<BTreeSet<_>>().into_iter().for_each(metrics::step);
    }
}

/// Name of the expert that an agent runs on.
fn expert_of(agent: &scene::Agent) -> Option<&'static str> {
    EXPERTS.iter().find(|(agent_type, _)| *agent_type == agent.kind()).map(|(_, name)| *name)
}

/// What is told of an answer: its samples, and their scores where they are wanted.
pub fn answered(task: &Task, answer: &Answer, queued: Duration, generator: &Generator) -> FinalBody {
    let scene = &task.request.scene;
    let whole = (task.with_kept || task.score).then(|| whole(scene, &answer.samples));
    let shown = whole.as_ref().filter(|_| task.with_kept).unwrap_or(&answer.samples);
    let mut body = final_body(task, shown, answer, queued);
    if let Some(whole) = whole.as_ref().filter(|_| task.score) {
        let changed = answer.samples.iter().map(|sample| sample.agents.len());
        add_scores(&mut body, scene, whole.iter().zip(changed), generator, task);
    }
    body
}

fn final_body(task: &Task, shown: &[Sample], answer: &Answer, queued: Duration) -> FinalBody {
    let t = &answer.timings;
    metrics::phase("encode", t.encode_ms / 1e3);
    metrics::phase("initial", t.initial_ms / 1e3);
    t.step_ms.iter().for_each(|ms| metrics::phase("step", ms / 1e3));
    let timing = TimingBody {
        queue_ms: round(queued.as_secs_f64() * 1e3),
        encode_ms: round(t.encode_ms),
        initial_ms: round(t.initial_ms),
        step_ms: t.step_ms.iter().copied().map(round).collect(),
        choice_ms: round(t.choice_ms),
        score_ms: 0.0,
    };
    FinalBody {
        windows: answer.windows,
        samples: shown.iter().map(|sample| SampleBody::new(sample, task.form)).collect(),
        resolved: answer.resolved.clone(),
        scores: None,
        warnings: answer.warnings.clone(),
        feedback: answer.round.clone().map(|Round { cards, wishes, .. }| RoundBody { cards, wishes }),
        timing,
        code: task.code(),
        generated: task.head.clone().dated(),
    }
}

/// The samples with the futures that were kept beside the new ones.
fn whole(scene: &Scene, samples: &[Sample]) -> Vec<Sample> {
    let mut samples = samples.to_vec();
    samples.iter_mut().for_each(|sample| kept::fill(scene, sample));
    samples
}

/// Scores whole samples, each with the number of road users that changed in it.
fn add_scores<'a>(
    body: &mut FinalBody,
    scene: &Scene,
    samples: impl Iterator<Item = (&'a Sample, usize)>,
    generator: &Generator,
    task: &Task,
) {
    let began = Instant::now();
    let drivable = generator.maps().drivable(&scene.map);
    let score = |(sample, changed)| {
        let mut input = ScoreInput::of_sample(scene, Some(sample), &drivable);
        input.thresholds = task.request.thresholds;
        scoring::of(&input, changed, task.standings.as_deref())
    };
    let scores: Vec<_> = samples.map(score).collect();
    body.timing.score_ms = round(began.elapsed().as_secs_f64() * 1e3);
    body.scores = Some(scores);
}

fn round(ms: f64) -> f64 {
    (ms * 100.0).round() / 100.0
}
