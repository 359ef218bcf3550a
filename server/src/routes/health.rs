//! `/healthz`, `/readyz`, `/metrics`.

use crate::app::App;
use api::{Code, Problem};
use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;
use base::problem::Refusal;
use base::{metrics as counters, process};
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::atomic::Ordering;
use work::PoolLane;

/// Health of the server in one word, for its operators.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum HealthStatus {
    /// The process answers.
    Ok,
    /// It accepts work.
    Ready,
}

/// Health of the server.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Health {
    status: HealthStatus,
}

refusals!(Refused:);
refusals!(NotYet:, NotReady);

/// The process answers.
#[utoipa::path(get, path = "/healthz", operation_id = "healthz", tag = "server",
    responses((status = 200, description = "the process answers", body = ref("#/components/schemas/Health")),
        Refused))]
pub async fn healthz() -> axum::Json<Health> {
    axum::Json(Health { status: HealthStatus::Ok })
}

/// Checks whether the server accepts work. Experts are loaded, the store reads and writes, the queue has room, and
/// workers, readers and the data folder respond. For long calls and for background calls, at least one worker is not
/// blocked by a call that has ended. `failing` lists those of `experts`, `store`, `queue`, `workers`, `readers`,
/// `long-workers`, `background-workers` and `data` that fail.
#[utoipa::path(get, path = "/readyz", operation_id = "readyz", tag = "server",
    responses((status = 200, description = "ready for work", body = ref("#/components/schemas/Health")),
        NotYet))]
pub async fn readyz(State(app): State<App>) -> Result<axum::Json<Health>, Refusal> {
    let checks = [
        ("experts", app.warm.load(Ordering::Relaxed)),
        ("store", app.catalog.store.is_ready().await),
        ("queue", app.pool.has_room()),
        ("workers", app.pool.answers(PoolLane::Quick).await),
        ("readers", app.pool.answers(PoolLane::Document).await),
        ("long-workers", app.pool.answers(PoolLane::Patient).await),
        ("background-workers", app.pool.answers(PoolLane::Background).await),
        ("data", app.catalog.library.answers().await),
    ];
    let failing: Vec<_> = checks.iter().filter(|(_, fine)| !fine).map(|(name, _)| *name).collect();
    if failing.is_empty() {
        return Ok(axum::Json(Health { status: HealthStatus::Ready }));
    }
    let detail = format!("Not ready: {}.", failing.join(", "));
    Err(Problem::new(Code::NotReady, detail).with(|m| m.failing = Some(failing)).retry_after(1).into())
}

/// Counters in Prometheus' text form.
#[utoipa::path(get, path = "/metrics", operation_id = "metrics", tag = "server",
    responses((status = 200, description = "Prometheus text", content_type = "text/plain", body = String),
        Refused))]
pub async fn metrics(State(app): State<App>) -> impl IntoResponse {
    app.metrics.run_upkeep();
    process::measure();
    counters::memory(app.room.memory.taken(), app.room.memory.most());
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], app.metrics.render())
}
