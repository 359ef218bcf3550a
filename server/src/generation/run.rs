//! One generation: receives its events, counts them and passes them to the feed.

use super::events::AcceptedBody;
use super::feed::Feed;
use super::outbox::JobEnd;
use api::events::FinalBody;
use api::generate::{GenerationAnswer, GenerationEvent, GenerationPlan, round_ms};
use api::{Operations, Problem};
use base::{clock, metrics};
use experts::weights::EXPERTS;
use experts::{Draft, Event};
use scene::Scene;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;
use work::JobKind;

/// Runs until the answer is sent, an error occurs, or the job is stopped. Between two events it calls
/// `others`, so that other work can run.
pub fn generate(feed: &Feed, operations: &Operations, plan: GenerationPlan, others: &dyn Fn()) {
    let queued = feed.ticket.elapsed();
    metrics::phase("queue", queued.as_secs_f64());
    if let Err(problem) = events(feed, operations, plan, queued, others)
        && feed.fail(problem)
    {
        metrics::ended(JobKind::Generate.name(), "error");
    }
}

fn events(
    feed: &Feed,
    operations: &Operations,
    plan: GenerationPlan,
    queued: Duration,
    others: &dyn Fn(),
) -> Result<(), Problem> {
    let (streams, scene) = (plan.drafts, Arc::clone(&plan.request.scene));
    let mut watch = |event: &Event| {
        others();
        if let Event::Draft(draft) = event {
            count(&scene, draft);
        }
    };
    let mut generation = operations.start(plan, feed.ticket.cancel.clone())?;
    while let Some(event) = generation.next_watched(&mut watch) {
        match event? {
            GenerationEvent::Accepted(accepted) => {
                if streams {
                    feed.send(AcceptedBody::new(accepted, feed.ticket.queue_position), None);
                }
            }
            GenerationEvent::Draft(draft) => {
                feed.send(draft, None);
                // The thread that writes to the socket needs a core now, and workers may occupy all of them.
                // Without this it would wait for the end of a time slice.
                std::thread::yield_now();
            }
            GenerationEvent::Final(answered) => {
                if feed.send(final_body(&answered, queued), Some(JobEnd::Final)) {
                    metrics::ended(JobKind::Generate.name(), "final");
                }
            }
        }
    }
    Ok(())
}

fn count(scene: &Scene, draft: &Draft) {
    let types = draft.agents.iter().filter_map(|id| scene.agent(id)).filter_map(expert_of);
    if draft.step == 0 {
        types.for_each(|expert| metrics::agents(expert, 1));
    } else {
        types.collect::<BTreeSet<_>>().into_iter().for_each(metrics::step);
    }
}

/// Name of an agent's expert.
fn expert_of(agent: &scene::Agent) -> Option<&'static str> {
    EXPERTS.iter().find(|(agent_type, _)| *agent_type == agent.kind()).map(|(_, name)| *name)
}

/// The answer with the server's additions: the time in the queue, and the date.
fn final_body(answered: &GenerationAnswer, queued: Duration) -> FinalBody {
    let t = &answered.answer.timings;
    metrics::phase("encode", t.encode_ms / 1e3);
    metrics::phase("initial", t.initial_ms / 1e3);
    t.step_ms.iter().for_each(|ms| metrics::phase("step", ms / 1e3));
    let mut body = answered.body();
    body.timing.queue_ms = round_ms(queued.as_secs_f64() * 1e3);
    body.generated.created_at = clock::now();
    body
}
