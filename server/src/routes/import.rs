//! `/v1/import`: scenes out of files.

use super::Params;
use super::scenes::store_new;
use crate::app::App;
use crate::base::metrics;
use crate::base::problem::{Code, Problem};
use crate::http::body;
use crate::scenes::catalog::Facts;
use crate::scenes::transfer;
use axum::body::Bytes;
use axum::extract::{FromRequest, Multipart, Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use formats::native::{MapForm, SceneDoc};
use serde::Deserialize;
use serde_json::{Value, json};
use std::ops::Range;

/// Query of an import.
#[derive(Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ImportParams {
    /// A name of the formats table; recognised from the content when absent or `auto`.
    format: Option<String>,
    /// Records to take, such as `0..9` (both ends), or one number.
    index: Option<String>,
    /// Give the scenes back and store nothing.
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
    MULTIPART,
];
const MULTIPART: &str = "multipart/form-data";

/// What was uploaded.
#[derive(Default)]
struct Upload {
    file: Bytes,
    /// Name that the file was given: a label, nothing is opened.
    label: Option<String>,
    /// The network that the file belongs to.
    net: Option<Vec<u8>>,
}

/// The parts `file` and, where there is one, `net` of a form.
async fn form_of(request: Request) -> Result<Upload, Problem> {
    let broken = |error: String| Problem::new(Code::MalformedFile, error).with("offset", 0);
    let form = Multipart::from_request(request, &()).await;
    let mut form = form.map_err(|error| broken(error.body_text()))?;
    let mut file = None;
    let mut upload = Upload::default();
    while let Some(part) = form.next_field().await.map_err(|error| broken(error.body_text()))? {
        let name = part.name().map(str::to_owned);
        let label = part.file_name().map(str::to_owned);
        match name.as_deref() {
            Some("file") if file.is_none() => {
                upload.label = label;
                file = Some(part.bytes().await.map_err(|error| broken(error.body_text()))?);
            }
            Some("net") if upload.net.is_none() => {
                let bytes = part.bytes().await.map_err(|error| broken(error.body_text()))?;
                upload.net = Some(bytes.to_vec());
            }
            _ => {}
        }
    }
    upload.file =
        file.ok_or_else(|| Problem::field("/file", Code::InvalidField, "the form needs a part named file"))?;
    Ok(upload)
}

/// Stores the scenes of a file.
#[utoipa::path(post, path = "/v1/import", operation_id = "importScenes", tag = "files", params(ImportParams),
    request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses((status = 201, body = ref("#/components/schemas/ImportReply")),
        (status = 200, description = "dry run", body = ref("#/components/schemas/ImportReply"))))]
pub async fn import(
    State(app): State<App>,
    Params(params): Params<ImportParams>,
    request: Request,
) -> Result<Response, Problem> {
    let media_type = body::media_type(request.headers(), UPLOADS)?;
    let wanted = params.index.as_deref().map(range).transpose()?;
    let (mut parts, unread) = request.into_parts();
    let bytes = body::read_upload(Request::from_parts(parts.clone(), unread), &app.limits).await?;
    let Upload { file, label, net } = if media_type == MULTIPART {
        parts.headers.remove(header::CONTENT_ENCODING);
        form_of(Request::from_parts(parts, bytes.into())).await?
    } else {
        Upload { file: bytes, ..Upload::default() }
    };
    let format = params.format.filter(|f| f != "auto");
    let name = params.name.or(label).unwrap_or_default();
    let most = app.limits.import_scenes as usize;
    let asked = format.clone().unwrap_or_else(|| "auto".into());
    let (skip, count) = wanted.map_or((0, most + 1), |range| (range.start, range.len().min(most + 1)));
    let read =
        body::blocking(move || transfer::read(&file, format.as_deref(), &name, skip, count, net)).await;
    let read = read.inspect_err(|_| metrics::transfer(false, known(&asked), "error"))?;
    if read.scenes.len() > most {
        let detail =
            format!("The file has more than {most} scenes; take some with index, or use the command line.");
        return Err(Problem::field("/query/index", Code::OutOfRange, detail).with("limit", most));
    }
    let mut scenes = Vec::new();
    for imported in read.scenes {
        if app.refuse_nc && is_noncommercial(imported.scene.meta.licence.as_deref()) {
            return Err(Problem::new(Code::LicenceRefused, "The source is for non-commercial use only."));
        }
        scenes.push(keep(&app, imported, params.dry_run).await?);
    }
    metrics::transfer(false, read.format, "done");
    let skipped: Vec<Value> = read
        .skipped
        .iter()
        .map(|(index, problem)| json!({"index": index, "problem": problem.body(None, None)}))
        .collect();
    let reply = axum::Json(json!({"format": read.format, "scenes": scenes, "skipped": skipped}));
    Ok(if params.dry_run { reply.into_response() } else { created(&scenes, reply) })
}

fn created(scenes: &[Value], reply: axum::Json<Value>) -> Response {
    let first = scenes.first().and_then(|s| s.get("id")).and_then(Value::as_str);
    match first {
        Some(id) => {
            (StatusCode::CREATED, [(header::LOCATION, format!("/v1/scenes/{id}"))], reply).into_response()
        }
        None => (StatusCode::CREATED, reply).into_response(),
    }
}

async fn keep(app: &App, imported: transfer::Imported, dry_run: bool) -> Result<Value, Problem> {
    let transfer::Imported { scene, warnings } = imported;
    let facts = Facts::of(&scene);
    let mut object =
        json!({"name": scene.name, "warnings": warnings, "counts": facts.counts, "steps": facts.steps});
    if dry_run {
        let doc = body::blocking(move || Ok(json!(SceneDoc::from_scene(&scene, MapForm::Inline)))).await?;
        object["scene"] = doc;
    } else {
        let id = uuid::Uuid::now_v7().to_string();
        object["etag"] = store_new(app, &id, scene).await?.into();
        object["id"] = id.into();
    }
    Ok(object)
}

/// A name of the table, for labels.
fn known(format: &str) -> &'static str {
    transfer::names().into_iter().find(|name| *name == format).unwrap_or("auto")
}

/// Waymo's and Argoverse's terms, by the word the importers set.
fn is_noncommercial(licence: Option<&str>) -> bool {
    licence.is_some_and(|l| l.to_ascii_lowercase().split(['-', ' ', '_']).any(|word| word == "nc"))
}

/// `3` or `0..9`, both ends taken.
pub fn range(text: &str) -> Result<Range<usize>, Problem> {
    let wrong = || Problem::field("/query/index", Code::InvalidField, "a number or FIRST..LAST expected");
    let number = |s: &str| s.trim().parse::<usize>().ok().filter(|n| *n < 1_000_000_000).ok_or_else(wrong);
    match text.split_once("..") {
        None => number(text).map(|n| n..n + 1),
        Some((first, last)) => {
            let (first, last) = (number(first)?, number(last)?);
            if last < first { Err(wrong()) } else { Ok(first..last + 1) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{is_noncommercial, range};

    #[test]
    fn index_ranges() {
        assert_eq!(range("3").ok(), Some(3..4));
        assert_eq!(range("0..9").ok(), Some(0..10));
        for bad in ["", "a", "-1", "5..2", "1..", "..3", "99999999999999999999"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn licences() {
        assert!(is_noncommercial(Some("waymo-nc")));
        assert!(is_noncommercial(Some("CC-BY-NC-SA-4.0")));
        assert!(!is_noncommercial(Some("cc0")));
        assert!(!is_noncommercial(None));
    }
}
