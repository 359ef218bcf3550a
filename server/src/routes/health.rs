//! `/healthz`, `/readyz`, `/metrics`.

use crate::app::App;
use crate::base::problem::{Code, Problem};
use axum::extract::State;
use axum::http::header;
use axum::response::IntoResponse;
use serde_json::{Value, json};
use std::sync::atomic::Ordering;

/// The process answers.
#[utoipa::path(get, path = "/healthz", operation_id = "healthz", tag = "server",
    responses((status = 200, description = "the process answers")))]
pub async fn healthz() -> axum::Json<Value> {
    axum::Json(json!({"status": "ok"}))
}

/// Experts are warm, the store takes writes, the queue has room.
#[utoipa::path(get, path = "/readyz", operation_id = "readyz", tag = "server",
    responses((status = 200, description = "ready for work")))]
pub async fn readyz(State(app): State<App>) -> Result<axum::Json<Value>, Problem> {
    let checks = [
        ("experts", app.warm.load(Ordering::Relaxed)),
        ("store", app.store.is_writable().await),
        ("queue", app.pool.has_room()),
    ];
    let failing: Vec<_> = checks.iter().filter(|(_, fine)| !fine).map(|(name, _)| *name).collect();
    if failing.is_empty() {
        return Ok(axum::Json(json!({"status": "ready"})));
    }
    let detail = format!("Not ready: {}.", failing.join(", "));
    Err(Problem::new(Code::NotReady, detail).with("failing", json!(failing)).retry_after(1))
}

/// Counters in Prometheus' text form.
#[utoipa::path(get, path = "/metrics", operation_id = "metrics", tag = "server",
    responses((status = 200, description = "Prometheus text", content_type = "text/plain", body = String)))]
pub async fn metrics(State(app): State<App>) -> impl IntoResponse {
    app.metrics.run_upkeep();
    ([(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")], app.metrics.render())
}
