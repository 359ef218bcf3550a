//! Changes of scenes: create, replace, rename, delete.

use super::saved;
use crate::app::App;
use crate::http::body::{self, Json, Reading};
use crate::http::extract::{Id, if_match, if_none_match};
use crate::routes::own::OwnCatalog;
use crate::scenes::store::{Expect, SceneShare};
use crate::scenes::{Catalog, record};
use api::home::not_found;
use api::{Code, Home, Problem};
use axum::extract::{FromRef, FromRequest, Request, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::Response;
use base::id;
use base::problem::Refusal;
use formats::native::SceneDoc;
use serde::Deserialize;

refusals!(Uncreated: CHANGES BODY SCENE STORE WORK, Exists, StoreFull, IdempotencyKeyReused);

/// Saves a new scene; the id of the document is ignored. The same Idempotency-Key and body give the same reply.
#[utoipa::path(post, path = "/v1/scenes", operation_id = "createScene", tag = "scenes",
    params(("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 128, pattern = "^[!-~]+$")),
    request_body(content = ref("#/components/schemas/Scene"), content_type = "application/json"),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/Saved"),
            headers(("ETag" = String, description = "version of the scene"),
                ("Location" = String, description = "address of the scene"))), Uncreated))]
pub async fn create(OwnCatalog(catalog): OwnCatalog, Json(doc): Json<SceneDoc>) -> Result<Response, Refusal> {
    let id = id::fresh();
    let scene = catalog.read(doc).await?;
    let written = catalog.save(&id, Expect::Absent, scene).await?;
    Ok(saved(StatusCode::CREATED, id, written.etag))
}

refusals!(Unreplaced: CHANGES BODY SCENE STORE WORK,
    NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Replaces a scene (If-Match) or makes one under the client's own id (If-None-Match: *).
#[utoipa::path(put, path = "/v1/scenes/{id}", operation_id = "replaceScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = Option<String>, Header), ("If-None-Match" = Option<String>, Header)),
    request_body(content = ref("#/components/schemas/Scene"), content_type = "application/json"),
    responses((status = 200, description = "replaced", body = ref("#/components/schemas/Saved"),
            headers(("ETag" = String, description = "version of the scene"),
                ("Location" = String, description = "address of the scene"))),
        (status = 201, description = "created", body = ref("#/components/schemas/Saved"),
            headers(("ETag" = String, description = "version of the scene"),
                ("Location" = String, description = "address of the scene"))), Unreplaced))]
pub async fn replace(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    request: Request,
) -> Result<Response, Refusal> {
    let expect = match (if_match(request.headers()), if_none_match(request.headers())) {
        (Some(tags), _) => Expect::Etags(tags),
        (None, Some(tags)) if tags == ["*"] => Expect::Absent,
        _ => return Err(precondition_required().into()),
    };
    writable(&catalog, &id)?;
    let Json(doc) = Json::<SceneDoc>::from_request(request, &app).await?;
    let scene = catalog.read(doc).await?;
    let written = catalog.save(&id, expect, scene).await.map_err(|problem| match problem.code {
        // PUT could create it, so it is the precondition that fails (RFC 9110, 13.1.1).
        Code::NotFound => Problem::new(Code::StaleEtag, "There is no scene to replace under this id."),
        _ => problem,
    })?;
    let status = if written.created { StatusCode::CREATED } else { StatusCode::OK };
    Ok(saved(status, id, written.etag))
}

fn precondition_required() -> Problem {
    let detail = "Send If-Match with the ETag you read, or If-None-Match: * to create with PUT.";
    Problem::new(Code::PreconditionRequired, detail)
}

fn writable(catalog: &Catalog, id: &str) -> Result<(), Problem> {
    if catalog.library.has(id) {
        let detail = "This scene is read-only; POST to its /duplicate and change the copy.";
        return Err(Problem::new(Code::ReadOnly, detail));
    }
    Ok(())
}

/// Merge patch of a scene's metadata.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ScenePatch {
    /// New name; null empties it.
    #[serde(deserialize_with = "present")]
    name: Option<Option<String>>,
    /// New tags; null removes all.
    #[serde(deserialize_with = "present")]
    tags: Option<Option<Vec<String>>>,
    /// New notes; null empties them.
    #[serde(deserialize_with = "present")]
    notes: Option<Option<String>>,
    /// Rights of other users on the scene, where scenes have owners; only its owner sets them.
    shared: Option<SceneShare>,
}

/// Distinguishes null from absence.
fn present<'de, D: serde::Deserializer<'de>, T: Deserialize<'de>>(
    d: D,
) -> Result<Option<Option<T>>, D::Error> {
    Option::deserialize(d).map(Some)
}

refusals!(Unrenamed: CHANGES BODY SCENE STORE WORK,
    NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Renames or shares a scene, or changes its tags or notes (RFC 7396 merge patch).
#[utoipa::path(patch, path = "/v1/scenes/{id}", operation_id = "renameScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = String, Header)),
    request_body(content = ref("#/components/schemas/ScenePatch"),
        content_type = "application/merge-patch+json", example = json!({"name": "left turn, late"})),
    responses((status = 200, description = "changed", body = ref("#/components/schemas/Saved"),
            headers(("ETag" = String, description = "version of the scene"),
                ("Location" = String, description = "address of the scene"))), Unrenamed))]
pub async fn rename(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    request: Request,
) -> Result<Response, Refusal> {
    let tags = if_match(request.headers()).ok_or_else(precondition_required)?;
    body::media_type(request.headers(), &["application/merge-patch+json", "application/json"])?;
    writable(&catalog, &id)?;
    let reading = Reading::from_ref(&app);
    let patch: ScenePatch = reading.parse(reading.json(request).await?).await?;
    let (summary, text) = catalog.store.get(&id).await?.ok_or_else(not_found)?;
    let bytes = text.json.len();
    let mut doc = catalog.parsed(text).await?;
    if let Some(name) = patch.name {
        doc.name = name.unwrap_or_default();
    }
    if let Some(tags) = patch.tags {
        doc.meta.tags = tags.unwrap_or_default();
    }
    if let Some(notes) = patch.notes {
        doc.meta.notes = notes.unwrap_or_default();
    }
    // The whole scene is checked again, so that a patch cannot store what a PUT could not.
    catalog.read(doc.clone()).await?;
    let make = move || record::of_doc(&doc, summary.parent_id, summary.meta, summary.map_sha);
    let mut record = app.pool.document(bytes, make).await?;
    record.shared = patch.shared;
    // The scene may have changed between the read above and this write, so the ETag that was read is checked
    // too.
    let held = tags.iter().any(|t| t == "*" || *t == summary.etag);
    let expect = if held { vec![summary.etag] } else { tags };
    let written = catalog.save_record(&id, Expect::Etags(expect), record).await?;
    Ok(saved(StatusCode::OK, id, written.etag))
}

refusals!(Undeleted: CHANGES STORE, NotFound, StaleEtag, PreconditionRequired, ReadOnly, StoreFull);

/// Deletes a scene.
#[utoipa::path(delete, path = "/v1/scenes/{id}", operation_id = "deleteScene", tag = "scenes",
    params(("id" = String, Path), ("If-Match" = String, Header)),
    responses((status = 204, description = "deleted"), Undeleted))]
pub async fn remove(
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    headers: HeaderMap,
) -> Result<StatusCode, Refusal> {
    let tags = if_match(&headers).ok_or_else(precondition_required)?;
    writable(&catalog, &id)?;
    catalog.delete(&id, Expect::Etags(tags)).await?;
    Ok(StatusCode::NO_CONTENT)
}
