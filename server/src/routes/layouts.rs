//! `/v1/map`: new maps from templates.

use crate::app::App;
use crate::http::body::{Json, JsonText};
use crate::http::extract::Connection;
use api::map::{MapBody, TemplateList};
use axum::extract::State;
use base::problem::Refusal;
use std::time::Duration;
use work::{JobKind, JobRequest};

/// Approximate time to build and write a map.
const MAP_COST: Duration = Duration::from_millis(5);

refusals!(Refused: CHANGES BODY WORK);
refusals!(Unread:);

/// Draws a map from a template and its parameters: lanes with links, neighbours and boundaries, kerbs, crosswalks,
/// stop signs, signals over nine seconds. Stores nothing.
#[utoipa::path(post, path = "/v1/map", operation_id = "makeMap", tag = "maps",
    request_body(content = ref("#/components/schemas/MapBody"), content_type = "application/json",
        example = json!({"template": "four-arms", "parameters": {"kerb_radius_m": 6.0, "control": "equal"}})),
    responses((status = 200, description = "the map", body = ref("#/components/schemas/MapReply")), Refused))]
pub async fn make(
    State(app): State<App>,
    connection: Connection,
    Json(body): Json<MapBody>,
) -> Result<JsonText, Refusal> {
    let asked = JobRequest { kind: JobKind::Map, cost: MAP_COST, caller: connection.into() };
    Ok(app.pool.run(asked, move |_| JsonText::of(&body.reply()?)).await?)
}

/// Lists the templates of maps with their parameters.
#[utoipa::path(get, path = "/v1/map/templates", operation_id = "listTemplates", tag = "maps",
    responses((status = 200, description = "all templates", body = ref("#/components/schemas/TemplateList")), Unread))]
pub async fn templates() -> axum::Json<TemplateList> {
    axum::Json(TemplateList::current())
}
