//! `/v1/import`: scenes out of files.

use crate::app::App;
use crate::base::problem::{Code, Problem, ProblemDoc};
use crate::base::{id, metrics};
use crate::http::body::{self, JsonText, Reading};
use crate::http::extract::{Connection, Params};
use crate::scenes::store::{Expect, PackedScene};
use crate::scenes::{Counts, Facts, record, transfer};
use crate::work::{Asked, Kind};
use axum::body::Bytes;
use axum::extract::{FromRef, FromRequest, Multipart, Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use formats::native::{MapForm, SceneDoc};
use scene::licence::is_noncommercial;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::time::Duration;

/// Query of an import.
#[derive(Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields, default)]
#[into_params(parameter_in = Query)]
pub struct ImportParams {
    /// A name of the formats table; recognised from the content when absent or `auto`.
    format: Option<String>,
    /// Records to take, such as `0..9` (both ends), or one number.
    #[param(pattern = "^[0-9]+(\\.\\.[0-9]+)?$")]
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
    let broken = |error: String| Problem::new(Code::MalformedFile, error).with(|m| m.offset = Some(0));
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

/// One scene of a file.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct ImportedScene {
    /// Id it was stored under; not in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<String>,
    /// As in the ETag header; not in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    etag: Option<String>,
    /// For people.
    name: String,
    /// What the reader changed or left out.
    warnings: Vec<formats::Warning>,
    /// Road users by type.
    counts: Counts,
    /// Steps of 0.1 s.
    steps: usize,
    /// The scene itself, in a dry run alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<SceneDoc>,
}

/// A record of a file that is no scene.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SkippedRecord {
    /// Position in the file, from 0.
    index: usize,
    /// Why.
    problem: ProblemDoc,
}

/// What an import gave.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImportReply {
    /// A name of the formats table.
    format: &'static str,
    /// Scenes in the order of the file.
    scenes: Vec<ImportedScene>,
    /// Records that are no scenes.
    skipped: Vec<SkippedRecord>,
}

/// A file that was read, its scenes ready to be stored.
struct Ready {
    reply: ImportReply,
    /// Rows in the order of the reply's scenes; none in a dry run.
    rows: Vec<(String, PackedScene)>,
}

/// What the worker is to do with a file.
struct Order {
    upload: Upload,
    format: Option<String>,
    name: String,
    /// Scenes to pass over, and how many to take.
    window: (usize, usize),
    most: usize,
    dry_run: bool,
    refuse_nc: bool,
}

refusals!(Refused: CHANGES BODY QUERY SCENE WORK, FormatUnknown, CannotRepresent, LicenceRefused, StoreFull);

/// Stores the scenes of a file.
#[utoipa::path(post, path = "/v1/import", operation_id = "importScenes", tag = "files", params(ImportParams),
    request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/ImportReply")),
        (status = 200, description = "dry run", body = ref("#/components/schemas/ImportReply")), Refused))]
pub async fn import(
    State(app): State<App>,
    connection: Connection,
    Params(params): Params<ImportParams>,
    request: Request,
) -> Result<Response, Problem> {
    let media_type = body::media_type(request.headers(), UPLOADS)?;
    let wanted = params.index.as_deref().map(range).transpose()?;
    let (mut parts, unread) = request.into_parts();
    let body = Reading::from_ref(&app).upload(Request::from_parts(parts.clone(), unread)).await?;
    let bytes = body.bytes();
    let mut upload = if media_type == MULTIPART {
        parts.headers.remove(header::CONTENT_ENCODING);
        form_of(Request::from_parts(parts, bytes.into())).await?
    } else {
        Upload { file: bytes, ..Upload::default() }
    };
    let most = app.limits.import_scenes as usize;
    let order = Order {
        format: params.format.filter(|f| f != "auto"),
        name: params.name.or_else(|| upload.label.take()).unwrap_or_default(),
        window: wanted.map_or((0, most + 1), |range| (range.start, range.len().min(most + 1))),
        upload,
        most,
        dry_run: params.dry_run,
        refuse_nc: app.refuse_nc,
    };
    // Readers take about this long a byte.
    let cost = Duration::from_nanos(20 * order.upload.file.len() as u64);
    let asked = Asked { kind: Kind::Import, cost, caller: connection.into() };
    let format = known(order.format.as_deref().unwrap_or("auto"));
    let work = move |_: &_| {
        let _body = body;
        order.run()
    };
    let ready = app.pool.run(asked, work).await;
    let Ready { mut reply, rows } = ready.inspect_err(|_| metrics::transfer(false, format, "error"))?;
    for (scene, (id, row)) in reply.scenes.iter_mut().zip(rows) {
        scene.etag = Some(app.catalog.store.put(&id, Expect::Absent, row).await?.etag);
        scene.id = Some(id);
    }
    metrics::transfer(false, reply.format, "done");
    let first = reply.scenes.first().and_then(|scene| scene.id.clone());
    let bytes = if params.dry_run { usize::MAX } else { 0 };
    let text = app.pool.document(bytes, move || JsonText::of(&reply)).await?;
    Ok(match (params.dry_run, first) {
        (true, _) => text.into_response(),
        (false, Some(id)) => {
            (StatusCode::CREATED, [(header::LOCATION, format!("/v1/scenes/{id}"))], text).into_response()
        }
        (false, None) => (StatusCode::CREATED, text).into_response(),
    })
}

impl Order {
    /// Reads the file and makes its scenes ready: nothing is stored unless all of them can be.
    fn run(self) -> Result<Ready, Problem> {
        let Upload { file, net, .. } = self.upload;
        let (skip, count) = self.window;
        let read = transfer::read(&file, self.format.as_deref(), &self.name, skip, count, net)?;
        if read.scenes.len() > self.most {
            let most = self.most;
            let detail = format!(
                "The file has more than {most} scenes; take some with index, or use the command line."
            );
            return Err(Problem::field("/query/index", Code::OutOfRange, detail).limit(most as u64));
        }
        let (mut scenes, mut rows) = (Vec::new(), Vec::new());
        for transfer::Imported { scene, warnings } in read.scenes {
            if self.refuse_nc && scene.licence().is_some_and(|licence| is_noncommercial(&licence)) {
                return Err(Problem::new(Code::LicenceRefused, "The source is for non-commercial use only."));
            }
            let facts = Facts::of(&scene);
            let name = scene.name.clone();
            let doc = self.dry_run.then(|| SceneDoc::from_scene(&scene, MapForm::Inline));
            if !self.dry_run {
                let id = id::fresh();
                let row = record::of_scene(scene, &id)?.packed()?;
                rows.push((id, row));
            }
            let (counts, steps) = (facts.counts, facts.steps);
            scenes.push(ImportedScene { id: None, etag: None, name, warnings, counts, steps, scene: doc });
        }
        let skipped = read.skipped.iter();
        let skipped =
            skipped.map(|(index, problem)| SkippedRecord { index: *index, problem: problem.doc(None, None) });
        Ok(Ready { reply: ImportReply { format: read.format, scenes, skipped: skipped.collect() }, rows })
    }
}

/// A name of the table, for labels.
fn known(format: &str) -> &'static str {
    transfer::names().into_iter().find(|name| *name == format).unwrap_or("auto")
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
    use super::range;

    #[test]
    fn index_ranges() {
        assert_eq!(range("3").ok(), Some(3..4));
        assert_eq!(range("0..9").ok(), Some(0..10));
        for bad in ["", "a", "-1", "5..2", "1..", "..3", "99999999999999999999"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }
}
