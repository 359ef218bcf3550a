//! `/v1/jobs`: cancels a generation by its id.

use crate::app::App;
use crate::http::extract::{Connection, Id};
use axum::extract::State;
use axum::http::StatusCode;

refusals!(Refused: CHANGES, NotFound);

/// Cancels a generation of the same caller (user, token or address). An id without a running or queued job is no error.
#[utoipa::path(delete, path = "/v1/jobs/{job}", operation_id = "cancelJob", tag = "generate",
    params(("job" = String, Path)), responses((status = 204, description = "no longer running"), Refused))]
pub async fn cancel(State(app): State<App>, connection: Connection, Id(job): Id) -> StatusCode {
    app.pool.cancel(connection.party, &job);
    StatusCode::NO_CONTENT
}
