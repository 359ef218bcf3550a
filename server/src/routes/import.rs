//! `/v1/import`: scenes out of files.

use crate::app::App;
use crate::base::problem::{Code, Problem, ProblemDoc};
use crate::base::{id, metrics};
use crate::http::body::{self, JsonText, Reading, Room};
use crate::http::extract::{Connection, Params};
use crate::http::packed::{PackedText, TextPacker};
use crate::http::upload::{self, Upload};
use crate::scenes::store::PackedScene;
use crate::scenes::{Counts, Facts, record, transfer};
use crate::work::{Asked, Kind};
use axum::extract::{FromRef, Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use experts::Cancel;
use formats::Source;
use formats::native::{MapForm, SceneDoc};
use scene::licence::is_noncommercial;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;
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
    "application/vnd.apache.parquet",
    MULTIPART,
];
const MULTIPART: &str = "multipart/form-data";

/// A file to be read.
struct File {
    file: Arc<dyn Source>,
    /// Name that the file was given: a label, nothing is opened.
    label: Option<String>,
    /// What came with it.
    beside: transfer::Beside,
}

impl File {
    /// What was uploaded: a file, or the parts `file` and, where they are there, `net` and `columns` of a form of
    /// this type.
    fn of(upload: &Arc<Upload>, form: Option<&str>) -> Result<Self, Problem> {
        let Some(content_type) = form else {
            let beside = transfer::Beside::default();
            return Ok(Self { file: Arc::<Upload>::clone(upload), label: None, beside });
        };
        let missing = || Problem::field("/file", Code::InvalidField, "the form needs a part named file");
        let [file, net, columns] = upload::parts(upload, content_type, ["file", "net", "columns"])?;
        let mut file = file.ok_or_else(missing)?;
        let label = file.label.take();
        let source = |part| Arc::new(part) as Arc<dyn Source>;
        let beside = transfer::Beside { net: net.map(source), columns: columns.map(source) };
        Ok(Self { file: Arc::new(file), label, beside })
    }
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

/// A file that was read.
enum Ready {
    /// Scenes to be stored, in the order of the reply.
    Store(ImportReply, Vec<(String, PackedScene)>),
    /// The reply of a dry run, and the name of the format.
    Tried(PackedText, &'static str),
}

/// What the worker is to do with a file.
struct Order {
    upload: Arc<Upload>,
    /// Content-Type of a form.
    form: Option<String>,
    format: Option<String>,
    name: Option<String>,
    /// Scenes to pass over, and how many to take.
    window: (usize, usize),
    most: usize,
    dry_run: bool,
    refuse_nc: bool,
}

refusals!(Refused: CHANGES BODY QUERY SCENE STORE WORK,
    FormatUnknown, CannotRepresent, PickleRefused, LicenceRefused, StoreFull);

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
    let content_type = request.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok());
    let form = content_type.filter(|_| media_type == MULTIPART).map(str::to_owned);
    let upload = Arc::new(Reading::from_ref(&app).upload(request).await?);
    let most = app.limits.import_scenes as usize;
    let format = params.format.filter(|f| f != "auto");
    let label = known(format.as_deref().unwrap_or("auto"));
    // Readers take about this long a byte.
    let cost = Duration::from_nanos(20 * upload.expected_bytes());
    let asked = Asked { kind: Kind::Import, cost, caller: connection.into() };
    let order = Order {
        upload,
        form,
        format,
        name: params.name,
        window: wanted.map_or((0, most + 1), |range| (range.start, range.len().min(most + 1))),
        most,
        dry_run: params.dry_run,
        refuse_nc: app.refuse_nc,
    };
    let place = app.room.import(asked.lane()).await?;
    let room = Arc::clone(&app.room);
    let work = move |cancel: &Cancel| {
        let _place = place;
        order.run(&room, cancel)
    };
    let ready = app.pool.run(asked, work).await.inspect_err(|_| metrics::transfer(false, label, "error"))?;
    let (mut reply, rows) = match ready {
        Ready::Tried(text, format) => {
            metrics::transfer(false, format, "done");
            return Ok(text.into_response());
        }
        Ready::Store(reply, rows) => (reply, rows),
    };
    let ids: Vec<String> = rows.iter().map(|(id, _)| id.clone()).collect();
    let etags = if rows.is_empty() { Vec::new() } else { app.catalog.store.put_new(rows).await? };
    for (scene, (id, etag)) in reply.scenes.iter_mut().zip(ids.into_iter().zip(etags)) {
        (scene.id, scene.etag) = (Some(id), Some(etag));
    }
    metrics::transfer(false, reply.format, "done");
    let first = reply.scenes.first().and_then(|scene| scene.id.clone());
    let text = JsonText::of(&reply)?;
    Ok(match first {
        Some(id) => {
            (StatusCode::CREATED, [(header::LOCATION, format!("/v1/scenes/{id}"))], text).into_response()
        }
        None => (StatusCode::CREATED, text).into_response(),
    })
}

impl Order {
    /// Reads the file and makes its scenes ready: nothing is stored unless all of them can be.
    fn run(self, room: &Room, cancel: &Cancel) -> Result<Ready, Problem> {
        let ready = self.read(room, cancel);
        // A body that is broken is told before what was made of it.
        self.upload.check()?;
        ready
    }

    fn read(&self, room: &Room, cancel: &Cancel) -> Result<Ready, Problem> {
        let File { file, label, beside } = File::of(&self.upload, self.form.as_deref())?;
        let name = self.name.clone().or(label).unwrap_or_default();
        let wanted = transfer::Wanted::of(&file, self.format.as_deref(), &name, &beside, self.window)?;
        let format = wanted.format;
        let mut taken = Taken::new(self, format)?;
        let skipped = wanted.each(&file, |imported| {
            if cancel.is_cancelled() {
                return Err(Problem::new(Code::Cancelled, "The job was cancelled."));
            }
            taken.take(imported)
        })?;
        let skipped = skipped.iter();
        let skipped =
            skipped.map(|(index, problem)| SkippedRecord { index: *index, problem: problem.doc(None, None) });
        taken.ready(skipped.collect(), room)
    }
}

/// Scenes of a file so far. Of each only what is stored or replied is kept, in compressed form.
struct Taken<'o> {
    order: &'o Order,
    format: &'static str,
    count: usize,
    refused: Option<Problem>,
    scenes: Vec<ImportedScene>,
    rows: Vec<(String, PackedScene)>,
    text: TextPacker,
}

/// The reply's text about its scenes begins behind this.
const SCENES: &str = "\"scenes\":[";

impl<'o> Taken<'o> {
    fn new(order: &'o Order, format: &'static str) -> Result<Self, Problem> {
        let (scenes, rows, text) = (Vec::new(), Vec::new(), TextPacker::new()?);
        Ok(Self { order, format, count: 0, refused: None, scenes, rows, text })
    }

    fn take(&mut self, imported: transfer::Imported) -> Result<(), Problem> {
        let transfer::Imported { scene, warnings } = imported;
        self.count += 1;
        if self.count > self.order.most {
            let most = self.order.most;
            let detail = format!(
                "The file has more than {most} scenes; take some with index, or use the command line."
            );
            return Err(Problem::field("/query/index", Code::OutOfRange, detail).limit(most as u64));
        }
        if self.order.refuse_nc && scene.licence().is_some_and(|licence| is_noncommercial(&licence)) {
            let detail = "The source is for non-commercial use only.";
            self.refused.get_or_insert_with(|| Problem::new(Code::LicenceRefused, detail));
        }
        if self.refused.is_some() {
            return Ok(());
        }
        let facts = Facts::of(&scene);
        let (counts, steps, name) = (facts.counts, facts.steps, scene.name.clone());
        let mut imported = ImportedScene { id: None, etag: None, name, warnings, counts, steps, scene: None };
        if self.order.dry_run {
            imported.scene = Some(SceneDoc::from_scene(&scene, MapForm::Inline));
            drop(scene);
            if self.count == 1 {
                self.text.push(format!("{{\"format\":\"{}\",{SCENES}", self.format).as_bytes())?;
            } else {
                self.text.push(b",")?;
            }
            return self.text.push_json(&imported);
        }
        let id = id::fresh();
        let row = record::of_scene(scene, &id)?.packed()?;
        self.rows.push((id, row));
        self.scenes.push(imported);
        Ok(())
    }

    fn ready(mut self, skipped: Vec<SkippedRecord>, room: &Room) -> Result<Ready, Problem> {
        if let Some(refused) = self.refused {
            return Err(refused);
        }
        let reply = ImportReply { format: self.format, scenes: self.scenes, skipped };
        if !self.order.dry_run {
            return Ok(Ready::Store(reply, self.rows));
        }
        // The text of a reply without scenes, from the end of their list on where some are written.
        let text = serde_json::to_string(&reply).map_err(Problem::internal)?;
        let rest = match text.split_once(SCENES) {
            Some((_, rest)) if self.count > 0 => rest,
            _ => &text,
        };
        self.text.push(rest.as_bytes())?;
        Ok(Ready::Tried(self.text.finish(room)?, self.format))
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
