//! One scene: the document, and the content of its small picture.

use crate::app::App;
use crate::http::coding;
use crate::http::extract::{Id, QueryParams, if_none_match};
use crate::routes::own::OwnCatalog;
use crate::scenes::store::StoredText;
use crate::scenes::{length, preview};
use api::Home;
use api::home::not_found;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::memory::MemoryShare;
use base::problem::Refusal;
use formats::native::{self, MapForm};
use serde::Deserialize;
use std::sync::Arc;

/// Query of a read.
#[derive(Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ReadParams {
    /// The whole map or only its hash: `inline` or `ref`.
    #[param(default = "inline", inline)]
    map: MapParam,
}

/// Form of the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum MapParam {
    /// Whole.
    #[default]
    Inline,
    /// `{"ref":"sha256:HEX"}`.
    Ref,
}

refusals!(Unread: QUERY STORE WORK, NotFound);

/// Reads a scene.
#[utoipa::path(get, path = "/v1/scenes/{id}", operation_id = "readScene", tag = "scenes",
    params(("id" = String, Path), ReadParams),
    responses((status = 200, description = "the scene", body = ref("#/components/schemas/Scene"),
            content_type = "application/vnd.dragtraffic.scene+json",
            headers(("ETag" = String, description = "version of the scene"))),
        (status = 304, description = "not changed",
            headers(("ETag" = String, description = "version of the scene"))), Unread))]
pub async fn read(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    QueryParams(params): QueryParams<ReadParams>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    if let Some(opened) = catalog.library.open(&id).await? {
        if !fresh(&headers, &opened.etag) {
            return Ok(not_modified(&opened.etag));
        }
        let form = if params.map == MapParam::Ref { MapForm::Ref } else { MapForm::Inline };
        let json = catalog.written(opened.scene, form).await?;
        return scene_reply(&app, headers, &opened.etag, json, None).await;
    }
    let (summary, text) = catalog.store.get(&id).await?.ok_or_else(not_found)?;
    if !fresh(&headers, &summary.etag) {
        return Ok(not_modified(&summary.etag));
    }
    let StoredText { json, room } = match params.map {
        MapParam::Ref => text,
        MapParam::Inline => catalog.with_map(text, &summary.map_sha).await?,
    };
    scene_reply(&app, headers, &summary.etag, json, Some(room)).await
}

/// Whether the client lacks this version.
fn fresh(headers: &HeaderMap, etag: &str) -> bool {
    let known = if_none_match(headers).unwrap_or_default();
    !known.iter().any(|tag| tag == "*" || tag.trim_start_matches("W/") == etag)
}

/// The reply with a scene. `room` is the memory of its text, until the reply takes its own.
async fn scene_reply(
    app: &App,
    headers: HeaderMap,
    etag: &str,
    json: Vec<u8>,
    room: Option<MemoryShare>,
) -> Result<Response, Refusal> {
    let head = [
        (header::CONTENT_TYPE, native::MEDIA_TYPE.to_owned()),
        (header::VARY, header::ACCEPT_ENCODING.as_str().to_owned()),
    ];
    let bytes = json.len();
    let pack = move || Ok(coding::gzip(&headers, &json).ok_or(json));
    let packed = app.pool.document(bytes, pack).await?;
    drop(room);
    Ok(match packed {
        Ok(packed) => {
            let coded = [(header::ETAG, coding::marked(etag)), (header::CONTENT_ENCODING, "gzip".to_owned())];
            (head, coded, packed).into_response()
        }
        Err(json) => (head, [(header::ETAG, etag.to_owned())], json).into_response(),
    })
}

refusals!(Unpreviewed: STORE WORK, NotFound);

/// Reads the content of a scene's small picture: the scene with simplified lines, and for each road user
/// present at the first step its first and last state.
#[utoipa::path(get, path = "/v1/scenes/{id}/preview", operation_id = "previewScene", tag = "scenes",
    params(("id" = String, Path)),
    responses((status = 200, description = "the scene, reduced", body = ref("#/components/schemas/Scene"),
            content_type = "application/vnd.dragtraffic.scene+json",
            headers(("ETag" = String, description = "version of the scene"))),
        (status = 304, description = "not changed",
            headers(("ETag" = String, description = "version of the scene"))), Unpreviewed))]
pub async fn preview_of(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    let opened = catalog.open(&id).await?;
    let kept = [(header::CACHE_CONTROL, "private, no-cache")];
    if !fresh(&headers, &opened.etag) {
        return Ok((kept, not_modified(&opened.etag)).into_response());
    }
    let (scene, bytes) = (Arc::clone(&opened.scene), length::of_scene(&opened.scene));
    let write = move || Ok(native::write_doc(&preview(&scene)));
    let json = app.pool.document(bytes, write).await?;
    Ok((kept, scene_reply(&app, headers, &opened.etag, json, None).await?).into_response())
}

fn not_modified(etag: &str) -> Response {
    (StatusCode::NOT_MODIFIED, [(header::ETAG, etag.to_owned())]).into_response()
}
