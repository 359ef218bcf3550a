//! `/v1/search`: tries in one scene, towards a condition on the result.

use super::generate::own_id;
use super::own::own_catalog;
use crate::app::App;
use crate::generation;
use crate::generation::stream::{self, StreamPace};
use crate::http::accept::ReplyFormat;
use crate::http::body::Json;
use crate::http::extract::Connection;
use crate::scenes::length;
use api::AboutScene;
use axum::extract::{FromRequest, Request, State};
use axum::response::Response;
use base::problem::Refusal;
use batch::search::call::SearchBody;
use batch::search::one_scene::SceneSearch;
use std::time::Duration;
use work::Caller;

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK, NotAcceptable, Exists);

/// Searches a scene for results that satisfy a condition. Each try draws the numbers of the situation, generates once
/// and is scored; earlier scores determine the numbers of the next tries. The reply is a stream of events (NDJSON or
/// SSE) or only the last event (JSON), by Accept. Equal requests give equal tries. A search ends after most of
/// `generate_s` with the tries made so far, or at once when the client disconnects. Stores nothing.
#[utoipa::path(post, path = "/v1/search", operation_id = "search", tag = "generate",
    request_body(content = ref("#/components/schemas/SearchBody"), content_type = "application/json",
        example = json!({
            "scene_id": "demo-crossing", "where": "actor.min_ttc_s < 1.5 && collisions == 0", "tries": 20, "found": 3,
            "situation": {"template": "cut-in", "parameters": {"gap_m": {"uniform": [2.0, 8.0]}}},
        })),
    responses((status = 200, description = "the tries", content(
        (ref("#/components/schemas/SearchFinalEvent") = "application/json"),
        (ref("#/components/schemas/SearchEvent") = "application/x-ndjson", extensions(("x-stream-item" = json!(true)))),
        (ref("#/components/schemas/SearchEvent") = "text/event-stream", extensions(("x-stream-item" = json!(true)))))),
        Refused))]
pub async fn search(
    State(app): State<App>,
    connection: Connection,
    request: Request,
) -> Result<Response, Refusal> {
    let form = ReplyFormat::negotiate(request.headers())?;
    let catalog = own_catalog(&app, request.extensions())?;
    let Json(mut body) = Json::<SearchBody>::from_request(request, &app).await?;
    own_id("/job", body.job.as_deref())?;
    let caller = Caller { job: body.job.take(), ..connection.into() };
    app.pool.expects(&caller)?;
    let scene = body.take_scene().open(&catalog).await?.scene;
    let preparation = app.map_preparation(&scene.map).await?;
    // The places of a pattern are searched on the whole map.
    let (bytes, hashes) = (length::of_map(&scene.map), app.patient.generator.hashes());
    let search = app.pool.document(bytes, move || SceneSearch::new(&body, scene, hashes)).await?;
    let pace = StreamPace {
        heartbeat: Duration::from_secs(app.limits.heartbeat_s.max(1)),
        together: Duration::ZERO,
    };
    let reader = generation::submit_search(
        &app.pool,
        app.patient.clone(),
        &app.limits,
        caller,
        (search, preparation),
    )?;
    Ok(stream::reply(reader, form, pace).await)
}
