//! `/v1/generate`: conditions to futures.

use super::own::own_catalog;
use crate::app::App;
use crate::generation;
use crate::generation::stream::{self, StreamPace};
use crate::http::accept::ReplyFormat;
use crate::http::body::Json;
use crate::http::extract::Connection;
use crate::http::line;
use crate::http::net::Carrier;
use crate::scenes::length;
use api::{AboutScene, Code, GenerateRequest, Problem};
use axum::Extension;
use axum::extract::{FromRequest, Request, State};
use axum::http::HeaderValue;
use axum::response::Response;
use base::id::is_id;
use base::problem::Refusal;
use std::time::Duration;
use work::Caller;

/// Bytes of a scene that are prepared for a generation while one is read: it is only copied.
const PREPARED: usize = 16;

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK,
    NotAcceptable, Exists, Superseded, StaleRevision, NotAsked, ReplyTooLarge, TooMuchWork, NonFiniteOutput);

/// Generates futures. The reply is a stream of events (NDJSON or SSE) or only the last event (JSON), by
/// Accept. Stores nothing.
#[utoipa::path(post, path = "/v1/generate", operation_id = "generate", tag = "generate",
    request_body(content = ref("#/components/schemas/GenerateRequest"), content_type = "application/json",
        example = json!({
            "scene_id": "demo-crossing", "agents": ["5"], "seed": 7,
            "conditions": {"5": {"goal": {"x_m": 14.0, "y_m": 0.4, "speed_mps": 6.0}}},
        })),
    responses((status = 200, description = "the answer", content(
        (ref("#/components/schemas/FinalEvent") = "application/json"),
        (ref("#/components/schemas/Event") = "application/x-ndjson", extensions(("x-stream-item" = json!(true)))),
        (ref("#/components/schemas/Event") = "text/event-stream", extensions(("x-stream-item" = json!(true)))))),
        Refused))]
pub async fn generate(
    State(app): State<App>,
    connection: Connection,
    request: Request,
) -> Result<Response, Refusal> {
    let form = ReplyFormat::negotiate(request.headers())?;
    let home = own_catalog(&app, request.extensions())?;
    let Json(mut body) = Json::<GenerateRequest>::from_request(request, &app).await?;
    let Caller { job, client, background, .. } = caller_of(&body)?;
    let caller = Caller { job, client, background, ..connection.into() };
    // Opening and preparing a scene costs more than a refusal may.
    app.pool.expects(&caller)?;
    let about = body.take_scene().open(&home).await?;
    let held = about.held.clone();
    let streams = form != ReplyFormat::Json;
    let (operations, bytes) = (app.operations.clone(), length::of_scene(&about.scene));
    let prepare = move || {
        let mut plan = operations.plan(&body, &about)?;
        plan.drafts = streams;
        Ok(plan)
    };
    let plan = app.pool.document(bytes / PREPARED, prepare).await?;
    let pace = StreamPace {
        heartbeat: Duration::from_secs(app.limits.heartbeat_s.max(1)),
        together: plan.draft_delay(),
    };
    let reader = generation::submit(&app.pool, app.lanes(), &app.limits, caller, plan)?;
    let mut reply = stream::reply(reader, form, pace).await;
    if let Some(name) = held.and_then(|name| HeaderValue::from_str(&name).ok()) {
        reply.headers_mut().insert("dragtraffic-scene", name);
    }
    Ok(reply)
}

refusals!(NoLine: CHANGES, UpgradeRequired);

/// A WebSocket for many generations, one after the other or at the same time, at a third of a browser's cost
/// for separate requests. Each text message is a request `{"ask": 1, "body": {..}}` with the body of a `POST`
/// and a number of the client's choice, or a cancellation `{"end": 1}`. Each message of the reply begins with
/// a line `{"ask": 1, "status": 200}`. The first one also has `retry_after_s` and `scene` (the header
/// `Dragtraffic-Scene`) where a `POST` would have them, the last one has `"last": true`. After it come lines
/// as a `POST` streams them as NDJSON, or the problem. A cancelled request also ends with `{"ask": 1, "last":
/// true}`, and then its number is free. An interrupted reply ends with a second `status` and its problem.
/// Requests beyond `line_questions` wait until another one ends; while 64 wait, or 1 MB (`line_bytes`), a
/// further one is refused with 503 `busy`. A message must arrive within `body_read_s`. More than 10 pings a second,
/// or a message that cannot be read, end the WebSocket with its close code.
#[utoipa::path(get, path = "/v1/generate", operation_id = "openLine", tag = "generate",
    responses((status = 101, description = "the connection is a WebSocket now"), NoLine))]
pub async fn line(carrier: Option<Extension<Carrier>>, request: Request) -> Result<Response, Refusal> {
    let opened = carrier.and_then(|Extension(carrier)| line::open(request, carrier, "/v1/generate".into()));
    opened.ok_or_else(|| {
        let detail = "A generation is asked for by POST, or over a WebSocket.";
        Problem::new(Code::UpgradeRequired, detail).into()
    })
}

/// Caller named by the body.
fn caller_of(body: &GenerateRequest) -> Result<Caller, Problem> {
    own_id("/job", body.job.as_deref())?;
    own_id("/client", body.client.as_deref())?;
    let client = match (&body.client, body.revision) {
        (Some(client), Some(revision)) => Some((client.clone(), revision)),
        (None, None) => None,
        _ => {
            let detail = "client and revision are given together";
            return Err(Problem::field("/revision", Code::InvalidField, detail));
        }
    };
    Ok(Caller { job: body.job.clone(), client, background: body.background, ..Caller::default() })
}

/// Refuses an invalid id that the client chose.
pub(super) fn own_id(pointer: &str, id: Option<&str>) -> Result<(), Problem> {
    if id.is_none_or(is_id) {
        return Ok(());
    }
    Err(Problem::field(pointer, Code::InvalidField, "1 to 64 of A-Z a-z 0-9 _ and - expected"))
}
