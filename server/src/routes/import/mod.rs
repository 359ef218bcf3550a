//! `/v1/import`: reads scenes from files.

mod file;
mod order;
mod reply;

pub use reply::ImportedBody;

use super::own::OwnCatalog;
use crate::app::App;
use crate::http::body::{self, JsonText, Reading};
use crate::http::extract::{Connection, QueryParams};
use api::import::{around, range};
use axum::extract::{FromRef, Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::base_path::published;
use base::metrics;
use base::problem::Refusal;
use experts::Cancel;
use order::{ImportOrder, Ready, known};
use serde::Deserialize;
use std::sync::Arc;
use std::time::Duration;
use work::{JobKind, JobRequest};

/// Query of an import.
#[derive(Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ImportParams {
    /// Id of the format; recognised from the content if absent or `auto`.
    format: Option<String>,
    /// Records to take, such as `0..9` (both ends), or one number.
    #[param(pattern = "^[0-9]+(\\.\\.[0-9]+)?$")]
    index: Option<String>,
    /// Part of a map to read: `X,Y,RADIUS` keeps the content within RADIUS metres (10 to 5000) of a position in the
    /// coordinates of the file (longitude, latitude if it has degrees).
    around: Option<String>,
    /// Return the scenes and store nothing.
    dry_run: bool,
    /// Name of the file, a label only.
    name: Option<String>,
}

/// Media types that an upload may have.
const UPLOADS: &[&str] = &[
    "application/octet-stream",
    "application/json",
    "application/vnd.dragtraffic.scene+json",
    "application/gzip",
    "application/x-gzip",
    "application/x-tfrecord",
    "application/x-protobuf",
    "application/xml",
    "text/xml",
    "text/csv",
    "application/vnd.apache.parquet",
    MULTIPART,
];
const MULTIPART: &str = "multipart/form-data";

refusals!(Refused: CHANGES BODY QUERY SCENE STORE WORK,
    FormatUnknown, CannotRepresent, PickleRefused, LicenceRefused, StoreFull, IdempotencyKeyReused);

/// Stores the scenes of a file, or of the files of a form. Each of several files has its own result, and the
/// request is refused if none of them can be read.
#[utoipa::path(post, path = "/v1/import", operation_id = "importScenes", tag = "files",
    params(ImportParams, ("Idempotency-Key" = Option<String>, Header, min_length = 1, max_length = 128, pattern = "^[!-~]+$")),
    request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/ImportedBody"),
            headers(("Location" = String, description = "address of the first stored scene"))),
        (status = 200, description = "dry run", body = ref("#/components/schemas/ImportedBody")), Refused))]
pub async fn import(
    State(app): State<App>,
    connection: Connection,
    OwnCatalog(catalog): OwnCatalog,
    QueryParams(params): QueryParams<ImportParams>,
    request: Request,
) -> Result<Response, Refusal> {
    let media_type = body::media_type(request.headers(), UPLOADS)?;
    let wanted = params.index.as_deref().map(range).transpose()?;
    let around = params.around.as_deref().map(around).transpose()?;
    let content_type = request.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok());
    let form = content_type.filter(|_| media_type == MULTIPART).map(str::to_owned);
    let upload = Arc::new(Reading::from_ref(&app).upload(request).await?);
    let format = params.format.filter(|f| f != "auto");
    let label = known(format.as_deref().unwrap_or("auto"));
    // Readers take about this time per byte.
    let cost = Duration::from_nanos(20 * upload.expected_bytes());
    let asked = JobRequest { kind: JobKind::Import, cost, caller: connection.into() };
    let (most, most_files) = (app.limits.import_scenes as usize, app.limits.import_files as usize);
    let order = ImportOrder {
        upload,
        form,
        format,
        name: params.name,
        window: wanted.map_or((0, most + 1), |range| (range.start, range.len().min(most + 1))),
        most,
        most_files,
        around,
        dry_run: params.dry_run,
        refuse_nc: app.refuse_nc,
    };
    let place = app.room.import(asked.lane()).await?;
    let room = Arc::clone(&app.room);
    let work = move |cancel: &Cancel| {
        let _place = place;
        order.run(&room, cancel)
    };
    let (ready, formats) =
        app.pool.run(asked, work).await.inspect_err(|_| metrics::transfer(false, label, "error"))?;
    let done = || formats.iter().for_each(|format| metrics::transfer(false, format, "done"));
    let (mut reply, rows) = match ready {
        Ready::Tried(text) => {
            done();
            return Ok(text.into_response());
        }
        Ready::Store(reply, rows) => (reply, rows),
    };
    let ids: Vec<String> = rows.iter().map(|(id, _)| id.clone()).collect();
    let etags = if rows.is_empty() { Vec::new() } else { catalog.store.put_new(rows).await? };
    done();
    let first = ids.first().map(|id| published(&format!("/v1/scenes/{id}")));
    for (scene, (id, etag)) in reply.scenes().zip(ids.into_iter().zip(etags)) {
        (scene.id, scene.etag) = (Some(id), Some(etag));
    }
    let text = JsonText::of(&reply)?;
    Ok(match first {
        Some(place) => (StatusCode::CREATED, [(header::LOCATION, place)], text).into_response(),
        None => (StatusCode::CREATED, text).into_response(),
    })
}
