//! `/v1/place`: places road users on a map.

use super::scene_ref::WithScene;
use crate::app::App;
use crate::http::body::JsonText;
use crate::http::extract::Connection;
use api::home::Subject;
use api::place::{PlaceBody, PlaceReply};
use axum::extract::State;
use base::problem::Refusal;
use experts::Cancel;
use std::time::Duration;
use work::{JobKind, JobRequest};

/// Approximate time of a placement, from a few road users to a whole town.
const PLACE_COST: Duration = Duration::from_millis(50);

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK);

/// Places road users on a map: vehicles on lanes, pedestrians on crosswalks and pavements, cyclists on cycle
/// lanes or on the right, traffic that enters by the arms at a rate, and parked cars. Boxes are at least 0.1
/// m apart and all centres lie in the region. Fewer than requested is no error. Stores nothing.
#[utoipa::path(post, path = "/v1/place", operation_id = "place", tag = "generate",
    request_body(content = ref("#/components/schemas/PlaceBody"), content_type = "application/json",
        example = json!({
            "scene_id": "demo-crossing", "density": {"count": 20}, "seed": 7, "keep": [],
            "types": {"vehicle": 0.7, "pedestrian": 0.2, "cyclist": 0.1},
            "region": {"circle": {"x_m": 0.0, "y_m": 0.0, "radius_m": 60.0}},
        })),
    responses((status = 200, description = "result of the placement", body = ref("#/components/schemas/PlaceReply")),
        Refused))]
pub async fn place(
    State(app): State<App>,
    connection: Connection,
    WithScene(body, Subject { scene, .. }): WithScene<PlaceBody>,
) -> Result<JsonText, Refusal> {
    let operations = app.operations.clone();
    let preparation = app.map_preparation(&scene.map).await?;
    let work = move |cancel: &Cancel| {
        JsonText::of(&PlaceReply::of(&operations.place(&body, &scene, cancel)?, &scene))
    };
    let asked =
        JobRequest { kind: JobKind::Place, cost: PLACE_COST + preparation, caller: connection.into() };
    Ok(app.pool.run(asked, work).await?)
}
