//! The events of a generation in the form of a stream: numbered, with the id of their job.

use api::Problem;
use api::events::{DraftBody, FinalBody};
use base::problem::ProblemDoc;
use experts::Accepted;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Serialize;
use std::borrow::Cow;

/// Body of one type of event.
pub trait EventBody {
    /// Values of `event`; the first one unless the body overrides it.
    const NAMES: &'static [&'static str];
    /// Description of the event in the OpenAPI document.
    const ABOUT: &'static str;

    /// Value of `event`.
    fn name(&self) -> &'static str {
        Self::NAMES.first().copied().unwrap_or_default()
    }
}

fn names<T: EventBody>(_: &mut SchemaGenerator) -> Schema {
    match T::NAMES {
        [one] => json_schema!({"type": "string", "const": one}),
        many => json_schema!({"type": "string", "enum": many}),
    }
}

/// Envelope of every event.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "{T}Event", description = T::ABOUT, transform = formats::never_null)]
pub struct Envelope<'a, T: EventBody> {
    /// Type of the event.
    #[schemars(schema_with = "names::<T>")]
    pub event: &'static str,
    /// Increases by one per event; a gap marks events that were dropped for a slow reader.
    pub seq: u64,
    /// Id of the job.
    pub job: &'a str,
    /// Revision of the request, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub revision: Option<u64>,
    /// Time since the request was read, milliseconds.
    pub elapsed_ms: f64,
    /// Body of the event.
    #[serde(flatten)]
    pub body: T,
}

/// `accepted`: what will be done.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Accepted")]
pub struct AcceptedBody {
    #[serde(flatten)]
    accepted: Accepted,
    /// Number of jobs ahead of this one when it was queued.
    queue_position: usize,
}

impl AcceptedBody {
    /// The body with the call's position in the queue.
    pub fn new(accepted: Accepted, queue_position: usize) -> Self {
        Self { accepted, queue_position }
    }
}

/// `error`: the problem object.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Error")]
pub struct ErrorBody {
    /// The problem, as a refusal before the stream returns it.
    problem: ProblemDoc,
}

impl ErrorBody {
    /// The body for a problem of the operation at `path`.
    pub fn new(problem: &Problem, path: &str) -> Self {
        Self { problem: ProblemDoc::of(problem, Some(path), None) }
    }
}

/// `superseded`: a newer revision took over.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Superseded")]
pub struct SupersededBody {
    /// The newer revision.
    pub by_revision: u64,
}

/// Keep-alive between events, only in NDJSON; SSE uses comments.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "HeartbeatEvent")]
pub struct Heartbeat {
    #[schemars(extend("const" = "heartbeat"))]
    event: &'static str,
}

/// One event of the stream. Exactly one of final, error and superseded ends it.
pub struct StreamEvent;

impl JsonSchema for StreamEvent {
    fn schema_name() -> Cow<'static, str> {
        "Event".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let own = [
            generator.subschema_for::<Envelope<'static, AcceptedBody>>(),
            generator.subschema_for::<Envelope<'static, DraftBody>>(),
            generator.subschema_for::<Envelope<'static, FinalBody>>(),
            generator.subschema_for::<Envelope<'static, ErrorBody>>(),
            generator.subschema_for::<Envelope<'static, SupersededBody>>(),
        ];
        let about = "One event of the stream. Exactly one of final, error and superseded ends it.";
        choice(generator, about, own)
    }
}

/// The schema of one event of a stream: one of its own, or a sign of life.
pub(super) fn choice<const N: usize>(
    generator: &mut SchemaGenerator,
    about: &str,
    own: [Schema; N],
) -> Schema {
    let heartbeat = generator.subschema_for::<Heartbeat>();
    let all: Vec<Schema> = own.into_iter().chain([heartbeat]).collect();
    json_schema!({"description": about, "oneOf": all})
}

macro_rules! names {
    ($($body:ident $name:literal $about:literal;)*) => {$(
        impl EventBody for $body {
            const NAMES: &'static [&'static str] = &[$name];
            const ABOUT: &'static str = $about;
        }
    )*};
}

names! {
    AcceptedBody "accepted" "First event: the planned work.";
    FinalBody "final" "Last event of a call that succeeded: the answer.";
    ErrorBody "error" "Last event of a call that failed or was cancelled.";
    SupersededBody "superseded" "Last event of a call that a newer revision of its client replaced.";
}

impl EventBody for DraftBody {
    const NAMES: &'static [&'static str] = &["initial", "step"];
    const ABOUT: &'static str = "`initial`: the first guess. `step`: after a refinement step. The futures of a \
        later window begin where it begins.";

    fn name(&self) -> &'static str {
        if self.is_first() { "initial" } else { "step" }
    }
}
