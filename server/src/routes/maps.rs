//! `/v1/maps`: immutable maps by content hash.

use super::own::OwnCatalog;
use crate::app::App;
use crate::http::coding;
use crate::http::extract::if_none_match;
use crate::scenes::store::StoredMap;
use crate::scenes::{length, record};
use api::{Code, Problem};
use axum::extract::{Path, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::problem::Refusal;
use scene::ContentHash;
use serde::Serialize;

/// One map of the store.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct MapItem {
    /// Content hash, 64 hex digits.
    sha256: String,
    /// Size of its JSON, bytes.
    bytes: u64,
    /// Number of its lines and areas.
    polylines: u64,
    /// Total number of their points.
    points: u64,
}

/// Maps of the store.
#[derive(Debug, Serialize, schemars::JsonSchema)]
pub struct MapList {
    maps: Vec<MapItem>,
}

refusals!(Refused: STORE);
refusals!(Unread: STORE WORK, NotFound);

/// Lists the maps of saved scenes.
#[utoipa::path(get, path = "/v1/maps", operation_id = "listMaps", tag = "maps",
    responses((status = 200, description = "all maps", body = ref("#/components/schemas/MapList")), Refused))]
pub async fn list(OwnCatalog(catalog): OwnCatalog) -> Result<axum::Json<MapList>, Refusal> {
    let rows = catalog.store.maps().await?.into_iter();
    let maps = rows.map(|StoredMap { sha256, bytes, polylines, points }| MapItem {
        sha256,
        bytes,
        polylines,
        points,
    });
    Ok(axum::Json(MapList { maps: maps.collect() }))
}

/// Reads a map. It never changes, so it may be cached for ever.
#[utoipa::path(get, path = "/v1/maps/{sha256}", operation_id = "readMap", tag = "maps",
    params(("sha256" = String, Path)),
    responses((status = 200, description = "the map", body = ref("#/components/schemas/Map"),
            headers(("ETag" = String, description = "hash of the map"))),
        (status = 304, description = "not changed",
            headers(("ETag" = String, description = "hash of the map"))), Unread))]
pub async fn read(
    State(app): State<App>,
    path: Result<Path<String>, axum::extract::rejection::PathRejection>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    let missing = || Problem::new(Code::NotFound, "No map has this hash.");
    let Path(name) = path.map_err(|_| missing())?;
    let hash = ContentHash::from_hex(name.strip_prefix("sha256:").unwrap_or(&name)).ok_or_else(missing)?;
    let etag = format!("\"{}\"", hash.hex());
    let head = [
        (header::ETAG, etag.clone()),
        (header::CACHE_CONTROL, "private, max-age=31536000, immutable".to_owned()),
        (header::CONTENT_TYPE, "application/json".to_owned()),
    ];
    let map = app.catalog.map(hash).await?.ok_or_else(missing)?;
    if if_none_match(&headers).is_some_and(|tags| tags.contains(&etag)) {
        return Ok((StatusCode::NOT_MODIFIED, head).into_response());
    }
    let bytes = length::of_map(&map);
    let write = move || {
        let json = record::map_json(&map)?;
        Ok(coding::gzip(&headers, &json).ok_or(json))
    };
    let vary = [(header::VARY, "accept-encoding")];
    Ok(match app.pool.document(bytes, write).await? {
        Ok(packed) => {
            let coded =
                [(header::ETAG, coding::marked(&etag)), (header::CONTENT_ENCODING, "gzip".to_owned())];
            (head, vary, coded, packed).into_response()
        }
        Err(json) => (head, vary, json).into_response(),
    })
}
