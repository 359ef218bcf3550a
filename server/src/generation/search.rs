//! One search: each try is an event, and the last event has all of them.

use super::events::{Envelope, ErrorBody, EventBody, choice};
use super::feed::Feed;
use super::outbox::JobEnd;
use api::Operations;
use base::clock;
use base::metrics;
use batch::row::UnitOutcome;
use batch::search::call::{SearchEnd, SearchTry};
use batch::search::one_scene::SceneSearch;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Serialize;
use std::borrow::Cow;
use std::ops::ControlFlow;
use std::time::Duration;
use work::JobKind;

/// `accepted`: what will be tried.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "SearchAccepted")]
pub struct SearchAcceptedBody {
    /// Maximum number of tries.
    tries: u64,
    /// Paths of the numbers that are varied.
    varied: Vec<String>,
    /// Number of jobs ahead of this one when it was queued.
    queue_position: usize,
}

/// `try`: one try.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "SearchTried")]
pub struct SearchTriedBody {
    /// The try.
    #[serde(flatten)]
    of: SearchTry,
    /// Tries so far that satisfy the condition.
    found: usize,
}

/// `final`: all tries.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "SearchFinal")]
pub struct SearchFinalBody {
    /// Why the search ended.
    ended: SearchEnd,
    /// Numbers of the tries that satisfy the condition, in their order.
    found: Vec<u64>,
    /// Number of the try that is nearest to the condition; null without a result.
    nearest: Option<u64>,
    /// All tries.
    tries: Vec<SearchTry>,
}

impl EventBody for SearchAcceptedBody {
    const NAMES: &'static [&'static str] = &["accepted"];
    const ABOUT: &'static str = "First event: the extent of the search.";
}

impl EventBody for SearchTriedBody {
    const NAMES: &'static [&'static str] = &["try"];
    const ABOUT: &'static str = "A try.";
}

impl EventBody for SearchFinalBody {
    const NAMES: &'static [&'static str] = &["final"];
    const ABOUT: &'static str = "Last event of a search that was not cancelled: all tries.";
}

/// Makes tries until the search ends, is stopped, or has taken `time`. After each try it calls `others`, so
/// that other work can run.
pub fn search(feed: &Feed, operations: &Operations, search: &SceneSearch, time: Duration, others: &dyn Fn()) {
    let queue_position = feed.ticket.queue_position;
    feed.send(SearchAcceptedBody { tries: search.tries(), varied: search.varied(), queue_position }, None);
    let until = clock::monotonic() + time;
    let mut tries: Vec<SearchTry> = Vec::new();
    let mut found = Vec::new();
    let mut each = |of: SearchTry| {
        if of.outcome == UnitOutcome::Kept {
            found.push(of.number);
        }
        feed.send(SearchTriedBody { of: of.clone(), found: found.len() }, None);
        tries.push(of);
        others();
        if clock::monotonic() > until {
            ControlFlow::Break(SearchEnd::Time)
        } else {
            ControlFlow::Continue(())
        }
    };
    let outcome = match search.run(operations, &feed.ticket.cancel, &mut each) {
        Ok(ended) => {
            let miss = |of: &SearchTry| Some((of.miss?, of.number));
            let nearest = tries.iter().filter_map(miss).min_by(|a, b| a.0.total_cmp(&b.0));
            let nearest = nearest.map(|(_, number)| number);
            let body = SearchFinalBody { ended, found, nearest, tries };
            feed.send(body, Some(JobEnd::Final)).then_some("final")
        }
        Err(problem) => feed.fail(problem).then_some("error"),
    };
    if let Some(outcome) = outcome {
        metrics::ended(JobKind::Search.name(), outcome);
    }
}

/// One event of a search. Exactly one of final and error ends it.
pub struct SearchEvent;

impl JsonSchema for SearchEvent {
    fn schema_name() -> Cow<'static, str> {
        "SearchEvent".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let own = [
            generator.subschema_for::<Envelope<'static, SearchAcceptedBody>>(),
            generator.subschema_for::<Envelope<'static, SearchTriedBody>>(),
            generator.subschema_for::<Envelope<'static, SearchFinalBody>>(),
            generator.subschema_for::<Envelope<'static, ErrorBody>>(),
        ];
        choice(generator, "One event of a search. Exactly one of final and error ends it.", own)
    }
}
