//! `/v1/score`: collisions, near misses, off-road driving, kinematics, goals.

use super::scene_ref::WithScene;
use crate::app::App;
use crate::http::body::JsonText;
use crate::http::extract::Connection;
use api::score::ScoreRequest;
use axum::extract::State;
use base::problem::Refusal;
use std::time::Duration;
use work::{JobKind, JobRequest};

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK);

/// Scores a scene: chosen futures or the given motion, and the log of the rest.
#[utoipa::path(post, path = "/v1/score", operation_id = "score", tag = "score",
    request_body(content = ref("#/components/schemas/ScoreRequest"), content_type = "application/json",
        example = json!({"scene_id": "demo-crossing"})),
    responses((status = 200, description = "the score", body = ref("#/components/schemas/ScoreReply")),
        Refused))]
pub async fn score(
    State(app): State<App>,
    connection: Connection,
    WithScene(request, about): WithScene<ScoreRequest>,
) -> Result<JsonText, Refusal> {
    let operations = app.operations.clone();
    let scene = &about.scene;
    // Measured: 256 road users over 600 steps take half a second.
    let cost = Duration::from_nanos(3_200 * (scene.agents.len() * scene.time.steps) as u64);
    let cost = cost + app.map_preparation(&scene.map).await?;
    let asked = JobRequest { kind: JobKind::Score, cost, caller: connection.into() };
    let work = move |_: &_| JsonText::of(&operations.score(&request, &about)?);
    Ok(app.pool.run(asked, work).await?)
}
