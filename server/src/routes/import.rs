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
use formats::native::{MapForm, SceneDoc};
use formats::{FieldProblem, Source};
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
    /// What was uploaded: a file, or the parts `file` of a form of this type, at most so many, each with the parts
    /// `net` and `columns` where they are there.
    fn all(upload: &Arc<Upload>, form: Option<&str>, most: usize) -> Result<Vec<Self>, Problem> {
        let Some(content_type) = form else {
            let beside = transfer::Beside::default();
            return Ok(vec![Self { file: Arc::<Upload>::clone(upload), label: None, beside }]);
        };
        let names = [("file", most), ("net", 1), ("columns", 1)];
        let [files, mut net, mut columns] = upload::parts(upload, content_type, names)?;
        if files.is_empty() {
            return Err(Problem::field("/file", Code::InvalidField, "the form needs a part named file"));
        }
        let source = |part| Arc::new(part) as Arc<dyn Source>;
        let beside = transfer::Beside { net: net.pop().map(source), columns: columns.pop().map(source) };
        let file = |mut part: upload::Part| {
            let label = part.label.take();
            Self { file: source(part), label, beside: beside.clone() }
        };
        Ok(files.into_iter().map(file).collect())
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

/// What a file gave.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImportReply {
    /// A name of the formats table.
    format: &'static str,
    /// Scenes in the order of the file.
    scenes: Vec<ImportedScene>,
    /// Records that are no scenes.
    skipped: Vec<SkippedRecord>,
}

/// One of several files: what it gave, or why it gave nothing.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct ImportedFile {
    /// Name of the file, as the form gave it.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(flatten)]
    read: Option<ImportReply>,
    /// Why nothing of it was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<ProblemDoc>,
}

/// What several files gave.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImportedFiles {
    /// In the order of the form.
    files: Vec<ImportedFile>,
}

/// What a file gave, or each of several.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ImportedBody {
    /// The file that came alone.
    One(ImportReply),
    /// Files of a form that has several.
    Several(ImportedFiles),
}

/// Files that were read.
enum Ready {
    /// Scenes to be stored, in the order of the reply.
    Store(ImportedBody, Vec<(String, PackedScene)>),
    /// The reply of a dry run.
    Tried(PackedText),
}

/// What the worker is to do with an upload.
struct Order {
    upload: Arc<Upload>,
    /// Content-Type of a form.
    form: Option<String>,
    format: Option<String>,
    name: Option<String>,
    /// Scenes to pass over, and how many to take.
    window: (usize, usize),
    most: usize,
    most_files: usize,
    dry_run: bool,
    refuse_nc: bool,
}

refusals!(Refused: CHANGES BODY QUERY SCENE STORE WORK,
    FormatUnknown, CannotRepresent, PickleRefused, LicenceRefused, StoreFull);

/// Stores the scenes of a file, or of the files of a form: each of several is told by itself, and the call is refused
/// when none of them can be read.
#[utoipa::path(post, path = "/v1/import", operation_id = "importScenes", tag = "files", params(ImportParams),
    request_body(content = Vec<u8>, content_type = "application/octet-stream"),
    responses((status = 201, description = "stored", body = ref("#/components/schemas/ImportedBody")),
        (status = 200, description = "dry run", body = ref("#/components/schemas/ImportedBody")), Refused))]
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
    let format = params.format.filter(|f| f != "auto");
    let label = known(format.as_deref().unwrap_or("auto"));
    // Readers take about this long a byte.
    let cost = Duration::from_nanos(20 * upload.expected_bytes());
    let asked = Asked { kind: Kind::Import, cost, caller: connection.into() };
    let (most, most_files) = (app.limits.import_scenes as usize, app.limits.import_files as usize);
    let order = Order {
        upload,
        form,
        format,
        name: params.name,
        window: wanted.map_or((0, most + 1), |range| (range.start, range.len().min(most + 1))),
        most,
        most_files,
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
    let etags = if rows.is_empty() { Vec::new() } else { app.catalog.store.put_new(rows).await? };
    done();
    let first = ids.first().map(|id| format!("/v1/scenes/{id}"));
    for (scene, (id, etag)) in reply.scenes().zip(ids.into_iter().zip(etags)) {
        (scene.id, scene.etag) = (Some(id), Some(etag));
    }
    let text = JsonText::of(&reply)?;
    Ok(match first {
        Some(place) => (StatusCode::CREATED, [(header::LOCATION, place)], text).into_response(),
        None => (StatusCode::CREATED, text).into_response(),
    })
}

impl ImportedBody {
    fn scenes(&mut self) -> Box<dyn Iterator<Item = &mut ImportedScene> + '_> {
        match self {
            Self::One(read) => Box::new(read.scenes.iter_mut()),
            Self::Several(all) => {
                let read = all.files.iter_mut().filter_map(|file| file.read.as_mut());
                Box::new(read.flat_map(|read| &mut read.scenes))
            }
        }
    }
}

impl Order {
    /// Reads the files and makes their scenes ready: nothing is stored unless all of them can be. Also the formats
    /// of the files that were read.
    fn run(self, room: &Room, cancel: &Cancel) -> Result<(Ready, Vec<&'static str>), Problem> {
        let ready = self.read(room, cancel);
        // A body that is broken is told before what was made of it.
        self.upload.check()?;
        ready
    }

    fn read(&self, room: &Room, cancel: &Cancel) -> Result<(Ready, Vec<&'static str>), Problem> {
        let files = File::all(&self.upload, self.form.as_deref(), self.most_files)?;
        let mut taken = Taken::new(self)?;
        let body = taken.files(&files, cancel)?;
        let ready = match self.dry_run {
            true => Ready::Tried(taken.text.finish(room)?),
            false => Ready::Store(body, taken.rows),
        };
        Ok((ready, taken.formats))
    }
}

/// What there is of an upload so far. Of each scene only what is stored or replied is kept, in compressed form.
struct Taken<'o> {
    order: &'o Order,
    /// Scenes of all files.
    count: usize,
    /// Formats of the files that were read.
    formats: Vec<&'static str>,
    rows: Vec<(String, PackedScene)>,
    /// The reply of a dry run.
    text: TextPacker,
    /// Scenes of the file at hand stand at the end of the text.
    open: bool,
}

/// The text about a file's scenes begins behind this.
const SCENES: &str = "\"scenes\":[";

impl<'o> Taken<'o> {
    fn new(order: &'o Order) -> Result<Self, Problem> {
        let (formats, rows, text) = (Vec::new(), Vec::new(), TextPacker::new()?);
        Ok(Self { order, count: 0, formats, rows, text, open: false })
    }

    fn files(&mut self, files: &[File], cancel: &Cancel) -> Result<ImportedBody, Problem> {
        if let [file] = files {
            return Ok(ImportedBody::One(self.file(file, None, cancel)?));
        }
        let (mut told, mut faults) = (Vec::new(), Vec::new());
        for (at, file) in files.iter().enumerate() {
            self.text.push(if at == 0 { b"{\"files\":[" } else { b"," })?;
            let (name, kept) = (file.label.clone(), self.rows.len());
            told.push(match self.file(file, name.as_deref(), cancel) {
                Ok(read) => ImportedFile { name, read: Some(read), problem: None },
                Err(problem) if self.ends(&problem) => return Err(problem),
                Err(problem) => {
                    self.rows.truncate(kept);
                    let error =
                        FieldProblem::new(format!("/file/{at}"), problem.code.name(), &problem.detail);
                    faults.push((problem.code, error));
                    self.fault(name, &problem)?
                }
            });
        }
        self.text.push(b"]}")?;
        match faults.first().filter(|_| faults.len() == files.len()) {
            None => Ok(ImportedBody::Several(ImportedFiles { files: told })),
            Some((code, _)) => {
                let detail = format!("Not one of the {} files can be read.", files.len());
                let errors = faults.iter().map(|(_, error)| error.clone()).collect();
                Err(Problem::new(*code, detail).with(|m| m.errors = Some(errors)))
            }
        }
    }

    /// It is the call that cannot be answered, not one of its files that cannot be read.
    fn ends(&self, problem: &Problem) -> bool {
        self.count > self.order.most || matches!(problem.code, Code::Cancelled | Code::Internal)
    }

    /// One of several files that cannot be read.
    fn fault(&mut self, name: Option<String>, problem: &Problem) -> Result<ImportedFile, Problem> {
        metrics::transfer(false, known(self.order.format.as_deref().unwrap_or("auto")), "error");
        let told = ImportedFile { name, read: None, problem: Some(problem.doc(None, None)) };
        if std::mem::take(&mut self.open) {
            self.text.push(b"],\"skipped\":[],\"problem\":")?;
            self.text.push_json(&told.problem)?;
            self.text.push(b"}")?;
        } else {
            self.text.push_json(&told)?;
        }
        Ok(told)
    }

    /// Takes the scenes of a file. `name`: what it is called among several.
    fn file(&mut self, file: &File, name: Option<&str>, cancel: &Cancel) -> Result<ImportReply, Problem> {
        let order = self.order;
        let labels = [order.name.as_deref(), file.label.as_deref()];
        let label = name.or_else(|| labels.into_iter().flatten().next()).unwrap_or_default();
        let wanted =
            transfer::Wanted::of(&file.file, order.format.as_deref(), label, &file.beside, order.window)?;
        let mut read = ImportReply { format: wanted.format, scenes: Vec::new(), skipped: Vec::new() };
        let mut refused = None;
        let skipped = wanted.each(&file.file, |imported| {
            if cancel.is_cancelled() {
                return Err(Problem::new(Code::Cancelled, "The job was cancelled."));
            }
            self.count += 1;
            if self.count > order.most {
                let most = order.most;
                let detail = format!(
                    "The file has more than {most} scenes; take some with index, or use the command line."
                );
                return Err(Problem::field("/query/index", Code::OutOfRange, detail).limit(most as u64));
            }
            if order.refuse_nc && imported.scene.licence().is_some_and(|licence| is_noncommercial(&licence)) {
                let detail = "The source is for non-commercial use only.";
                refused.get_or_insert_with(|| Problem::new(Code::LicenceRefused, detail));
            }
            if refused.is_some() { Ok(()) } else { self.take(imported, name, &mut read) }
        })?;
        if let Some(refused) = refused {
            return Err(refused);
        }
        let skipped = skipped.iter();
        read.skipped = skipped
            .map(|(index, problem)| SkippedRecord { index: *index, problem: problem.doc(None, None) })
            .collect();
        if order.dry_run {
            let (lead, rest) = around_scenes(name, &read)?;
            if !std::mem::take(&mut self.open) {
                self.text.push(lead.as_bytes())?;
            }
            self.text.push(rest.as_bytes())?;
        }
        self.formats.push(read.format);
        Ok(read)
    }

    fn take(
        &mut self,
        imported: transfer::Imported,
        name: Option<&str>,
        read: &mut ImportReply,
    ) -> Result<(), Problem> {
        let transfer::Imported { scene, warnings } = imported;
        let facts = Facts::of(&scene);
        let (counts, steps, called) = (facts.counts, facts.steps, scene.name.clone());
        let mut told =
            ImportedScene { id: None, etag: None, name: called, warnings, counts, steps, scene: None };
        if self.order.dry_run {
            told.scene = Some(SceneDoc::from_scene(&scene, MapForm::Inline));
            drop(scene);
            match std::mem::replace(&mut self.open, true) {
                false => self.text.push(around_scenes(name, read)?.0.as_bytes())?,
                true => self.text.push(b",")?,
            }
            return self.text.push_json(&told);
        }
        let id = id::fresh();
        let row = record::of_scene(scene, &id)?.packed()?;
        self.rows.push((id, row));
        read.scenes.push(told);
        Ok(())
    }
}

/// The text of a reply about a file, before its scenes and behind them. `name`: what it is called among several.
fn around_scenes(name: Option<&str>, read: &ImportReply) -> Result<(String, String), Problem> {
    #[derive(Serialize)]
    struct Told<'a> {
        #[serde(skip_serializing_if = "Option::is_none")]
        name: Option<&'a str>,
        #[serde(flatten)]
        read: &'a ImportReply,
    }
    let text = serde_json::to_string(&Told { name, read }).map_err(Problem::internal)?;
    let (lead, rest) = text.split_once(SCENES).ok_or_else(|| Problem::internal("a reply without scenes"))?;
    Ok((lead.to_owned() + SCENES, rest.to_owned()))
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
