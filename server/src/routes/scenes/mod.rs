//! `/v1/scenes`: list, read, create, replace, rename, delete, duplicate.

pub mod copy;
pub mod list;
pub mod read;
pub mod write;

use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::base_path::published;
use serde::Serialize;

/// Result of a change.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct Saved {
    /// Id of the scene.
    id: String,
    /// As in the ETag header.
    etag: String,
}

fn saved(status: StatusCode, id: String, etag: String) -> Response {
    let head = [(header::ETAG, etag.clone()), (header::LOCATION, published(&format!("/v1/scenes/{id}")))];
    (status, head, axum::Json(Saved { id, etag })).into_response()
}
