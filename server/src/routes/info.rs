//! `/v1/info`: description of the server.

use crate::app::App;
use crate::scenes::store::SCHEMA;
use api::Operations;
use api::info::{BuildInfo, ProgramInfo};
use axum::extract::State;
use base::limits::Limits;

/// Description of this program; the command line prints it too.
pub fn of(operations: &Operations, limits: &Limits) -> ProgramInfo {
    let build = BuildInfo { target: env!("BUILD_TARGET"), profile: env!("BUILD_PROFILE") };
    operations.info(build, limits.bounds()).with_store(SCHEMA)
}

refusals!(Refused:);

/// Version, weights, limits and formats.
#[utoipa::path(get, path = "/v1/info", operation_id = "info", tag = "server",
    responses((status = 200, description = "the server", body = ref("#/components/schemas/Info")), Refused))]
pub async fn info(State(app): State<App>) -> axum::Json<ProgramInfo> {
    axum::Json(of(&app.operations, &app.limits))
}
