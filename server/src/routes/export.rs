//! Files out of scenes: `/v1/scenes/{id}/export` and `/v1/export`.

use super::own::OwnCatalog;
use crate::app::App;
use crate::http::body::Json;
use crate::http::extract::{Connection, Id, QueryParams};
use crate::scenes::length;
use api::export::{self, FilePart, MotionChoice};
use api::{Home, import};
use axum::extract::State;
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use base::metrics;
use base::problem::Refusal;
use experts::{Cancel, preparation};
use formats::native::SceneDoc;
use scene::Scene;
use serde::Deserialize;
use std::sync::Arc;
use std::time::Duration;
use work::{JobKind, JobRequest};

/// Limit of a file's bytes: per byte of the scene's JSON, and for a small scene. With its intermediate data,
/// a writer takes 8 times the scene's JSON plus 64 MB.
const FILE_FACTOR: u64 = 6;
const FILE_BYTES: u64 = 40 << 20;

/// Query of an export.
#[derive(Debug, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ExportParams {
    /// Id of the format.
    #[param(default = "dragtraffic")]
    format: String,
    /// Sample of the generated futures; the chosen one when absent.
    sample: Option<usize>,
    /// `chosen` futures, or only the `log`.
    #[param(default = "chosen", value_type = String, pattern = "^(chosen|log)$")]
    mode: MotionChoice,
}

impl Default for ExportParams {
    fn default() -> Self {
        Self { format: "dragtraffic".into(), sample: None, mode: MotionChoice::Chosen }
    }
}

refusals!(Refused: QUERY STORE WORK, NotFound, FormatUnknown, CannotRepresent, ReplyTooLarge);
refusals!(Unwritten: CHANGES BODY SCENE STORE WORK, FormatUnknown, CannotRepresent, ReplyTooLarge);

/// Exports a scene of this server.
#[utoipa::path(get, path = "/v1/scenes/{id}/export", operation_id = "exportScene", tag = "files",
    params(("id" = String, Path), ExportParams),
    responses((status = 200, description = "the file", content_type = "application/octet-stream", body = Vec<u8>),
        Refused))]
pub async fn stored(
    State(app): State<App>,
    OwnCatalog(catalog): OwnCatalog,
    Id(id): Id,
    connection: Connection,
    QueryParams(params): QueryParams<ExportParams>,
) -> Result<Response, Refusal> {
    let scene = catalog.whole(&id).await?;
    export(&app, connection, scene, params).await
}

/// Exports a scene given in the body.
#[utoipa::path(post, path = "/v1/export", operation_id = "exportUnsaved", tag = "files", params(ExportParams),
    request_body(content = ref("#/components/schemas/Scene"), content_type = "application/json"),
    responses((status = 200, description = "the file", content_type = "application/octet-stream", body = Vec<u8>),
        Unwritten))]
pub async fn unsaved(
    State(app): State<App>,
    connection: Connection,
    QueryParams(params): QueryParams<ExportParams>,
    Json(doc): Json<SceneDoc>,
) -> Result<Response, Refusal> {
    let scene = Arc::new(app.catalog.read(doc).await?);
    export(&app, connection, scene, params).await
}

async fn export(
    app: &App,
    connection: Connection,
    scene: Arc<Scene>,
    params: ExportParams,
) -> Result<Response, Refusal> {
    let bytes = length::of_scene(&scene);
    let licence = scene.licence();
    let name = scene.name.clone();
    let format = import::names().into_iter().find(|n| *n == params.format).unwrap_or("unknown");
    let map = scene.map.clone();
    let most = FILE_FACTOR * bytes as u64 + FILE_BYTES;
    let room = Arc::clone(&app.room);
    let write = move |cancel: &Cancel| {
        // A size that the budget can never hold is refused as too long.
        let most = most.min(room.memory.most() / 2);
        let _memory = room.work(most)?;
        let part = FilePart { most_bytes: Some(most), cancel: cancel.clone(), ..FilePart::default() };
        export::write(&scene, &params.format, params.sample, params.mode, part)
    };
    // Writers take about this time per byte.
    let cost = Duration::from_nanos(20 * bytes as u64);
    // Some formats need the lane graph, which is computed for each file.
    let cost = cost + app.pool.document(bytes, move || Ok(preparation(&map))).await?;
    let asked = JobRequest { kind: JobKind::Export, cost, caller: connection.into() };
    let written = app.pool.run(asked, write).await;
    let file = written.inspect_err(|_| metrics::transfer(true, format, "error"))?;
    metrics::transfer(true, format, "done");
    let mut response = file.bytes.into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(file.media_type));
    let mut set = |header: &'static str, text: String| {
        if let Ok(value) = HeaderValue::from_str(&text) {
            headers.insert(header, value);
        }
    };
    set("content-disposition", format!("attachment; filename=\"{}{}\"", file_name(&name), file.extension));
    if !file.losses.is_empty() {
        set("dragtraffic-loss", formats::registry::loss_header(&file.losses));
        set("dragtraffic-losses", formats::registry::losses_header(&file.losses));
    }
    if let Some(licence) = licence {
        set("dragtraffic-licence", licence.chars().filter(char::is_ascii_graphic).take(64).collect());
    }
    Ok(response)
}

/// A file name that is valid on every file system.
fn file_name(name: &str) -> String {
    let clean = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    let cleaned: String = name.chars().map(clean).take(60).collect();
    let trimmed = cleaned.trim_matches('-');
    if trimmed.is_empty() { "scene".into() } else { trimmed.into() }
}
