//! `/v1/info`: what this server is and can do.

use crate::app::App;
use axum::extract::State;
use scene::AgentType;
use serde_json::{Value, json};

/// Version, weights, limits and formats.
#[utoipa::path(get, path = "/v1/info", operation_id = "info", tag = "server",
    responses((status = 200, body = ref("#/components/schemas/Info"))))]
pub async fn info(State(app): State<App>) -> axum::Json<Value> {
    axum::Json(document(&app.generator, &app.limits))
}

/// The object, for the command line too.
pub fn document(generator: &experts::Generator, limits: &crate::base::limits::Limits) -> Value {
    let range = |t| json!(formats::native::Ranges::of(t));
    json!({
        "name": "dragtraffic",
        "version": env!("CARGO_PKG_VERSION"),
        "build": {"target": env!("BUILD_TARGET"), "profile": env!("BUILD_PROFILE")},
        "device": "cpu",
        "weights": generator.weights(),
        "placement": generator.placement(),
        "limits": limits.to_json(),
        "condition_ranges": {
            "vehicle": range(AgentType::Vehicle),
            "pedestrian": range(AgentType::Pedestrian),
            "cyclist": range(AgentType::Cyclist),
        },
        "formats": crate::scenes::transfer::table(),
        "notices": [],
    })
}
