//! Copies of scenes.

use super::saved;
use crate::app::App;
use crate::http::body::{self, Reading};
use crate::http::extract::Id;
use crate::routes::own::OwnCatalog;
use crate::scenes::store::Expect;
use api::Problem;
use axum::extract::{FromRef, Request, State};
use axum::http::{StatusCode, header};
use axum::response::Response;
use base::id;
use base::problem::Refusal;
use scene::MAX_NAME_CHARS;
use serde::Deserialize;
use std::sync::Arc;

/// Name of the copy.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DuplicateRequest {
    /// Name of the copy. Default: the original's, with "copy" after it.
    name: Option<String>,
}

refusals!(Uncopied: CHANGES BODY STORE WORK, NotFound, StoreFull, IdempotencyKeyReused);

/// Copies a scene, read-only ones too; `meta.parent_id` names the original.
#[utoipa::path(post, path = "/v1/scenes/{id}/duplicate", operation_id = "duplicateScene", tag = "scenes",
    params(("id" = String, Path), ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 128, pattern = "^[!-~]+$")),
    request_body(content = ref("#/components/schemas/DuplicateRequest"), content_type = "application/json",
        example = json!({"name": "left turn, later"})),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/Saved"),
            headers(("ETag" = String, description = "version of the scene"),
                ("Location" = String, description = "address of the scene"))), Uncopied))]
pub async fn duplicate(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    request: Request,
) -> Result<Response, Refusal> {
    let typed = request.headers().contains_key(header::CONTENT_TYPE);
    if typed {
        body::media_type(request.headers(), body::JSON)?;
    }
    let reading = Reading::from_ref(&app);
    let bytes = reading.json(request).await?;
    let options: DuplicateRequest = if bytes.bytes().is_empty() && !typed {
        DuplicateRequest::default()
    } else {
        reading.parse(bytes).await?
    };
    let scene = catalog.whole(&id).await?;
    let mut scene = Arc::unwrap_or_clone(scene);
    scene.name = match options.name {
        Some(name) if name.chars().count() > MAX_NAME_CHARS => {
            return Err(
                Problem::range("/name", 0.0, MAX_NAME_CHARS as f64, name.chars().count() as f64).into()
            );
        }
        Some(name) => name,
        // The longest names are cut to make room for the word.
        None => scene.name.chars().take(MAX_NAME_CHARS - 5).chain(" copy".chars()).collect(),
    };
    scene.meta.parent_id = Some(id);
    let copy = id::fresh();
    let written = catalog.save(&copy, Expect::Absent, scene).await?;
    Ok(saved(StatusCode::CREATED, copy, written.etag))
}
