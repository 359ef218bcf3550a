//! One generation: drives the generator, turns its events into messages.

use super::events::{AcceptedBody, DraftBody, FinalBody, GeneratedHead, TimingBody};
use super::feed::Feed;
use super::outbox::End;
use super::{Task, kept, scoring};
use crate::base::metrics;
use crate::base::problem::Problem;
use crate::work::Kind;
use experts::weights::EXPERTS;
use experts::{Answer, Draft, Event, GenerateError, Generator};
use formats::native::SampleDoc;
use scene::{Sample, Scene};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Works until the answer is sent, something fails, or the job is stopped.
pub fn generate(feed: &Feed, generator: &Generator, task: Task) {
    let fail = |problem: Problem| {
        if feed.fail(problem) {
            metrics::ended(Kind::Generate.name(), "error");
        }
    };
    let queued = feed.ticket.elapsed();
    metrics::phase("queue", queued.as_secs_f64());
    let scene = Arc::clone(&task.request.scene);
    let generation = match generator.start(task.request, feed.ticket.cancel.clone()) {
        Ok(generation) => generation,
        Err(error) => return fail(error.into()),
    };
    for event in generation {
        match event {
            Ok(Event::Accepted(accepted)) => {
                feed.send(AcceptedBody::new(accepted, feed.ticket.queue_position), None);
            }
            Ok(Event::Draft(draft)) => {
                count(&scene, &draft);
                feed.send(DraftBody::new(&draft, task.all_modes), None);
            }
            Ok(Event::Final(answer)) => {
                let mut body = final_body(&task.head, &answer, queued);
                if task.with_kept {
                    body.samples = answer.samples.iter().map(|sample| with_kept(&scene, sample)).collect();
                }
                if task.score {
                    add_scores(&mut body, &scene, &answer);
                }
                if feed.send(body, Some(End::Final)) {
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
    let types = draft.futures.agents.keys().filter_map(|id| scene.agent(id)).filter_map(expert_of);
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

fn final_body(head: &GeneratedHead, answer: &Answer, queued: Duration) -> FinalBody {
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
        samples: answer.samples.iter().map(SampleDoc::from_sample).collect(),
        resolved: answer.resolved.clone(),
        scores: None,
        warnings: answer.warnings.clone(),
        timing,
        generated: head.clone().dated(),
    }
}

fn with_kept(scene: &Scene, sample: &Sample) -> SampleDoc {
    let mut all = sample.clone();
    kept::fill(scene, &mut all);
    SampleDoc::from_sample(&all)
}

fn add_scores(body: &mut FinalBody, scene: &Scene, answer: &Answer) {
    let began = Instant::now();
    let scores: Vec<_> = answer.samples.iter().map(|sample| scoring::sample(scene, sample)).collect();
    body.timing.score_ms = round(began.elapsed().as_secs_f64() * 1e3);
    body.scores = Some(scores);
}

fn round(ms: f64) -> f64 {
    (ms * 100.0).round() / 100.0
}
