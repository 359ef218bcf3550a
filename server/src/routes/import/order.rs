//! The work on an upload: reads its files and prepares their scenes.

use super::file::ImportFile;
use super::reply::{
    ImportReply, ImportedBody, ImportedFile, ImportedFiles, ImportedScene, SkippedRecord, around_scenes,
};
use crate::http::body::Room;
use crate::http::packed::{PackedText, TextPacker};
use crate::http::upload::Upload;
use crate::scenes::store::PackedScene;
use crate::scenes::{Facts, record};
use api::import::{ReadScene, SceneFile, names};
use api::{Code, Problem};
use base::problem::ProblemDoc;
use base::{id, metrics};
use experts::Cancel;
use formats::around::Around;
use formats::native::{MapForm, SceneDoc};
use scene::licence::is_noncommercial;
use std::sync::Arc;

/// The result of reading all files.
pub(super) enum Ready {
    /// Scenes to store, in the order of the reply.
    Store(ImportedBody, Vec<(String, PackedScene)>),
    /// The reply of a dry run.
    Tried(PackedText),
}

/// The worker's task for an upload.
pub(super) struct ImportOrder {
    pub(super) upload: Arc<Upload>,
    /// Content-Type of a form.
    pub(super) form: Option<String>,
    pub(super) format: Option<String>,
    pub(super) name: Option<String>,
    /// Number of scenes to skip, and the most to read.
    pub(super) window: (usize, usize),
    pub(super) most: usize,
    pub(super) most_files: usize,
    /// The part of maps to read.
    pub(super) around: Option<Around>,
    pub(super) dry_run: bool,
    pub(super) refuse_nc: bool,
}

impl ImportOrder {
    /// Reads the files and prepares their scenes; nothing is stored unless all can be. Also returns the
    /// formats of the files.
    pub(super) fn run(self, room: &Room, cancel: &Cancel) -> Result<(Ready, Vec<&'static str>), Problem> {
        let _memory = self.upload.reserve(room)?;
        let ready = self.read(room, cancel);
        // A broken body is reported instead of the faults that follow from it.
        self.upload.check()?;
        ready
    }

    fn read(&self, room: &Room, cancel: &Cancel) -> Result<(Ready, Vec<&'static str>), Problem> {
        let mut files = ImportFile::all(&self.upload, self.form.as_deref(), self.most_files)?;
        files.iter_mut().for_each(|file| file.beside.around = self.around);
        let mut taken = ImportProgress::new(self)?;
        let body = taken.files(&files, cancel)?;
        let ready = match self.dry_run {
            true => Ready::Tried(taken.text.finish(room)?),
            false => Ready::Store(body, taken.rows),
        };
        Ok((ready, taken.formats))
    }
}

/// Results of an upload so far. Only the stored or returned form of each scene is kept, compressed.
struct ImportProgress<'o> {
    order: &'o ImportOrder,
    /// Number of scenes in all files.
    count: usize,
    /// Formats of the files so far.
    formats: Vec<&'static str>,
    rows: Vec<(String, PackedScene)>,
    /// The reply of a dry run.
    text: TextPacker,
    /// Whether the text ends within the list of the current file's scenes.
    open: bool,
}

impl<'o> ImportProgress<'o> {
    fn new(order: &'o ImportOrder) -> Result<Self, Problem> {
        let (formats, rows, text) = (Vec::new(), Vec::new(), TextPacker::new()?);
        Ok(Self { order, count: 0, formats, rows, text, open: false })
    }

    fn files(&mut self, files: &[ImportFile], cancel: &Cancel) -> Result<ImportedBody, Problem> {
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
                    let error = problem.as_fault(format!("/file/{at}"));
                    faults.push((problem.code, error));
                    self.fault(name, &problem)?
                }
            });
        }
        self.text.push(b"]}")?;
        match faults.first().filter(|_| faults.len() == files.len()) {
            None => Ok(ImportedBody::Several(ImportedFiles { files: told })),
            Some((code, _)) => {
                let detail = format!("None of the {} files can be read.", files.len());
                let errors = faults.iter().map(|(_, error)| error.clone()).collect();
                Err(Problem::new(*code, detail).with(|m| m.errors = Some(errors)))
            }
        }
    }

    /// Whether the whole call fails, not only one of its files.
    fn ends(&self, problem: &Problem) -> bool {
        self.count > self.order.most || matches!(problem.code, Code::Cancelled | Code::Internal)
    }

    /// The entry of an unreadable file among several.
    fn fault(&mut self, name: Option<String>, problem: &Problem) -> Result<ImportedFile, Problem> {
        metrics::transfer(false, known(self.order.format.as_deref().unwrap_or("auto")), "error");
        let told = ImportedFile { name, read: None, problem: Some(ProblemDoc::of(problem, None, None)) };
        if std::mem::take(&mut self.open) {
            self.text.push(b"],\"skipped\":[],\"problem\":")?;
            self.text.push_json(&told.problem)?;
            self.text.push(b"}")?;
        } else {
            self.text.push_json(&told)?;
        }
        Ok(told)
    }

    /// Processes the scenes of a file. `name` is its name among several.
    fn file(
        &mut self,
        file: &ImportFile,
        name: Option<&str>,
        cancel: &Cancel,
    ) -> Result<ImportReply, Problem> {
        let order = self.order;
        let labels = [order.name.as_deref(), file.label.as_deref()];
        let label = name.or_else(|| labels.into_iter().flatten().next()).unwrap_or_default();
        let wanted = SceneFile::of(&file.file, order.format.as_deref(), label, &file.beside, order.window)?;
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
            .map(|(index, problem)| SkippedRecord {
                index: *index,
                problem: ProblemDoc::of(problem, None, None),
            })
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
        imported: ReadScene,
        name: Option<&str>,
        read: &mut ImportReply,
    ) -> Result<(), Problem> {
        let ReadScene { scene, warnings } = imported;
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

/// The name of a known format, for labels.
pub(super) fn known(format: &str) -> &'static str {
    names().into_iter().find(|name| *name == format).unwrap_or("auto")
}
