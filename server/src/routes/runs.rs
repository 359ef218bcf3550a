//! `/v1/runs`: stepped traffic around road users that the client drives.

use super::scene_ref::WithScene;
use crate::app::App;
use crate::http::accept::ReplyFormat;
use crate::http::body::{Json, JsonText};
use crate::http::extract::{Connection, Id};
use crate::http::line;
use crate::http::net::Carrier;
use crate::runs::{Follower, HeldRun};
use api::home::Subject;
use api::runs::{PeekBody, PeekReply, RunBody, RunReply, SnapshotReply, StepBody, StepReply};
use api::{Code, Problem};
use axum::Extension;
use axum::body::Bytes;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use base::id;
use base::problem::Refusal;
use formats::native::{MapForm, SceneDoc, write_doc};
use std::time::Duration;
use tokio::sync::OwnedMutexGuard;
use work::{JobKind, JobRequest};

/// Approximate time of the first plan of one road user.
const FIRST_PLAN: Duration = Duration::from_millis(3);
/// Approximate time of a step or a peek.
const STEP_COST: Duration = Duration::from_millis(10);

refusals!(Unbegun: CHANGES BODY SCENE SCENE_REF STORE WORK, TooManyRuns, NonFiniteOutput);

/// Begins a run in a scene, or continues one from a snapshot. The client drives the road users in `egos`; the server
/// drives all others from step to step, with knowledge of the past and of the plans that egos announce. The run is
/// kept in memory and deleted after `idle_s` without use.
#[utoipa::path(post, path = "/v1/runs", operation_id = "beginRun", tag = "runs",
    request_body(content = ref("#/components/schemas/RunBody"), content_type = "application/json",
        example = json!({"scene_id": "demo-crossing", "egos": ["5"], "seed": 7})),
    responses((status = 201, description = "the run", body = ref("#/components/schemas/RunReply")), Unbegun))]
pub async fn begin(
    State(app): State<App>,
    connection: Connection,
    WithScene(body, Subject { scene, .. }): WithScene<RunBody>,
) -> Result<(StatusCode, JsonText), Refusal> {
    app.runs.expects(connection.party)?;
    let cost = FIRST_PLAN * scene.agents.len() as u32 + app.map_preparation(&scene.map).await?;
    let asked = JobRequest { kind: JobKind::Run, cost, caller: connection.into() };
    let operations = app.operations.clone();
    let (idle_s, id) = (app.runs.idle_s(), id::fresh());
    let name = id.clone();
    let work = move |cancel: &_| {
        let run = operations.begin_run(&body, &scene, cancel)?;
        Ok((JsonText::of(&RunReply::of(&name, &run, 0, idle_s))?, run))
    };
    let (reply, run) = app.pool.run(asked, work).await?;
    app.runs.add(&id, run, connection.party)?;
    Ok((StatusCode::CREATED, reply))
}

refusals!(Unseen: WORK, NotFound, NotAcceptable);

/// Returns the state of a run: the current states, the remaining steps, the time since its last use. With NDJSON or SSE
/// in Accept, the reply follows the run: first the run, then each step, until the run is deleted. Reading or following a
/// run does not count as use and changes nothing.
#[utoipa::path(get, path = "/v1/runs/{id}", operation_id = "readRun", tag = "runs",
    params(("id" = String, Path)),
    responses((status = 200, description = "the run", content(
        (ref("#/components/schemas/RunReply") = "application/json"),
        (ref("#/components/schemas/RunEvent") = "application/x-ndjson", extensions(("x-stream-item" = json!(true)))),
        (ref("#/components/schemas/RunEvent") = "text/event-stream", extensions(("x-stream-item" = json!(true)))))),
        Unseen))]
pub async fn read(
    State(app): State<App>,
    connection: Connection,
    Id(id): Id,
    carrier: Option<Extension<Carrier>>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    let form = ReplyFormat::negotiate(&headers)?;
    let (run, unused_s) = app.runs.look(&id)?;
    let held = run.lock().await;
    let reply = RunReply::of(&id, &held.run, unused_s, app.runs.idle_s());
    if form == ReplyFormat::Json {
        return Ok(JsonText::of(&reply)?.into_response());
    }
    let heartbeat = Duration::from_secs(app.limits.heartbeat_s.max(1));
    let carrier = carrier.map(|Extension(carrier)| carrier);
    let place = app.runs.follow(connection.party)?;
    Ok(Follower::new(reply, held.last.subscribe(), (form, heartbeat), (carrier, place))?.reply())
}

refusals!(Unshown: WORK, NotFound);

/// Returns the scene of a run as it was when the run began.
#[utoipa::path(get, path = "/v1/runs/{id}/scene", operation_id = "readRunScene", tag = "runs",
    params(("id" = String, Path)),
    responses((status = 200, description = "the scene", body = ref("#/components/schemas/Scene")), Unshown))]
pub async fn scene(State(app): State<App>, connection: Connection, Id(id): Id) -> Result<JsonText, Refusal> {
    let (run, _) = app.runs.look(&id)?;
    let scene = run.lock().await.run.scene().clone();
    let work = move |_: &_| Ok(write_doc(&SceneDoc::from_scene(&scene, MapForm::Inline)).into());
    Ok(app.pool.run(asked(connection), work).await.map(|text: Bytes| JsonText::from(text))?)
}

refusals!(Unstepped: CHANGES BODY WORK, NotFound, StepOrder, UnknownAgent, NonFiniteOutput);

/// Makes a step: the egos take the states of the body, and all others move on and react to them. Steps are numbered
/// from 1. Repeating the last number returns the same reply, whatever the body, so that a client can recover a lost
/// reply; any other number than the next one is refused (`step-order`).
#[utoipa::path(post, path = "/v1/runs/{id}/step", operation_id = "stepRun", tag = "runs",
    params(("id" = String, Path)),
    request_body(content = ref("#/components/schemas/StepBody"), content_type = "application/json",
        example = json!({"number": 1, "egos": [
            {"id": "5", "x_m": 1.8, "y_m": -20.0, "heading_rad": 1.57, "vx_mps": 0.0, "vy_mps": 8.0}]})),
    responses((status = 200, description = "result of the step", body = ref("#/components/schemas/StepReply")),
        Unstepped))]
pub async fn step(
    State(app): State<App>,
    connection: Connection,
    Id(id): Id,
    Json(body): Json<StepBody>,
) -> Result<JsonText, Refusal> {
    let mut held = taken(&app, &id).await?;
    if let Some((_, reply)) = held.last.borrow().as_ref().filter(|(number, _)| *number == body.number) {
        return Ok(JsonText::from(reply.clone()));
    }
    let operations = app.operations.clone();
    let work = move |cancel: &_| {
        let step = operations.step_run(&body, &mut held.run, cancel)?;
        let reply = JsonText::of(&StepReply::from(&step))?;
        held.last.send_replace(Some((step.number, reply.bytes())));
        Ok(reply)
    };
    Ok(app.pool.run(asked(connection), work).await?)
}

refusals!(NoLine: CHANGES, NotFound, UpgradeRequired);

/// A WebSocket for the steps of a run. Messages have the form of those for generations (`GET /v1/generate`), with
/// the body of a step as `body`. A client waits for the reply to a step before it sends the next one.
#[utoipa::path(get, path = "/v1/runs/{id}/step", operation_id = "openRunLine", tag = "runs",
    params(("id" = String, Path)),
    responses((status = 101, description = "the connection is a WebSocket now"), NoLine))]
pub async fn line(
    State(app): State<App>,
    Id(id): Id,
    carrier: Option<Extension<Carrier>>,
    request: Request,
) -> Result<Response, Refusal> {
    app.runs.get(&id)?;
    let opened =
        carrier.and_then(|Extension(carrier)| line::open(request, carrier, format!("/v1/runs/{id}/step")));
    opened.ok_or_else(|| {
        let detail = "A step is asked for by POST, or over a WebSocket.";
        Problem::new(Code::UpgradeRequired, detail).into()
    })
}

refusals!(Unpeeked: CHANGES BODY WORK, NotFound, UnknownAgent, NonFiniteOutput);

/// Predicts the motion of the others over the next nine seconds if the egos drove these plans. The run does
/// not change.
#[utoipa::path(post, path = "/v1/runs/{id}/peek", operation_id = "peekRun", tag = "runs",
    params(("id" = String, Path)),
    request_body(content = ref("#/components/schemas/PeekBody"), content_type = "application/json",
        example = json!({"plans": {}})),
    responses((status = 200, description = "predicted motion", body = ref("#/components/schemas/PeekReply")),
        Unpeeked))]
pub async fn peek(
    State(app): State<App>,
    connection: Connection,
    Id(id): Id,
    Json(body): Json<PeekBody>,
) -> Result<JsonText, Refusal> {
    let held = taken(&app, &id).await?;
    let operations = app.operations.clone();
    let work = move |cancel: &_| {
        let peek = operations.peek_run(&body, &held.run, cancel)?;
        JsonText::of(&PeekReply::of(&held.run, &peek))
    };
    Ok(app.pool.run(asked(connection), work).await?)
}

refusals!(Unsaved: CHANGES WORK, NotFound);

/// Returns the run as text, from which another run can begin: on this server or another, now or later. It continues
/// with the same bytes as this one.
#[utoipa::path(post, path = "/v1/runs/{id}/snapshot", operation_id = "saveRun", tag = "runs",
    params(("id" = String, Path)),
    responses((status = 200, description = "the run", body = ref("#/components/schemas/SnapshotReply")), Unsaved))]
pub async fn snapshot(
    State(app): State<App>,
    connection: Connection,
    Id(id): Id,
) -> Result<JsonText, Refusal> {
    let held = taken(&app, &id).await?;
    let work = move |_: &_| JsonText::of(&SnapshotReply::of(&held.run));
    Ok(app.pool.run(asked(connection), work).await?)
}

refusals!(Undeleted: CHANGES, NotFound);

/// Deletes a run.
#[utoipa::path(delete, path = "/v1/runs/{id}", operation_id = "deleteRun", tag = "runs",
    params(("id" = String, Path)), responses((status = 204, description = "forgotten"), Undeleted))]
pub async fn remove(State(app): State<App>, Id(id): Id) -> Result<StatusCode, Refusal> {
    app.runs.remove(&id)?;
    Ok(StatusCode::NO_CONTENT)
}

/// The run of an id for exclusive use by one request; other requests wait.
async fn taken(app: &App, id: &str) -> Result<OwnedMutexGuard<HeldRun>, Refusal> {
    Ok(app.runs.get(id)?.lock_owned().await)
}

fn asked(connection: Connection) -> JobRequest {
    JobRequest { kind: JobKind::Run, cost: STEP_COST, caller: connection.into() }
}
