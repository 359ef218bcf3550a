//! Results of imported files, as JSON.

use crate::scenes::Counts;
use api::Problem;
use base::problem::ProblemDoc;
use formats::native::SceneDoc;
use schemars::JsonSchema;
use serde::Serialize;

/// One scene of a file.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct ImportedScene {
    /// Id under which it is stored; not in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) id: Option<String>,
    /// As in the ETag header; not in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) etag: Option<String>,
    /// Display name.
    pub(super) name: String,
    /// Changes and omissions of the reader.
    pub(super) warnings: Vec<formats::ImportWarning>,
    /// Road users by type.
    pub(super) counts: Counts,
    /// Number of steps of 0.1 s.
    pub(super) steps: usize,
    /// The scene itself, only in a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scene: Option<SceneDoc>,
}

/// A record of a file that is not a scene.
#[derive(Debug, Serialize, JsonSchema)]
pub struct SkippedRecord {
    /// Position in the file, from 0.
    pub(super) index: usize,
    /// Why.
    pub(super) problem: ProblemDoc,
}

/// Result of importing a file.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImportReply {
    /// Id of the format.
    pub(super) format: &'static str,
    /// Scenes in the order of the file.
    pub(super) scenes: Vec<ImportedScene>,
    /// Records that are not scenes.
    pub(super) skipped: Vec<SkippedRecord>,
}

/// One of several files, with its result or its problem.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct ImportedFile {
    /// Name of the file in the form.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<String>,
    #[serde(flatten)]
    pub(super) read: Option<ImportReply>,
    /// Problem for which nothing was imported.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) problem: Option<ProblemDoc>,
}

/// Results of importing several files.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ImportedFiles {
    /// Results in the order of the form.
    pub(super) files: Vec<ImportedFile>,
}

/// Result of importing a file, or of each of several.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum ImportedBody {
    /// Result of a single file.
    One(ImportReply),
    /// Results of a form with several files.
    Several(ImportedFiles),
}

impl ImportedBody {
    /// All scenes, in the order of the files.
    pub(super) fn scenes(&mut self) -> Box<dyn Iterator<Item = &mut ImportedScene> + '_> {
        match self {
            Self::One(read) => Box::new(read.scenes.iter_mut()),
            Self::Several(all) => {
                let read = all.files.iter_mut().filter_map(|file| file.read.as_mut());
                Box::new(read.flat_map(|read| &mut read.scenes))
            }
        }
    }
}

/// The text of a file's scenes begins after this.
const SCENES: &str = "\"scenes\":[";

/// The text of a file's reply before and after its scenes. `name` is the file's name among several.
pub(super) fn around_scenes(name: Option<&str>, read: &ImportReply) -> Result<(String, String), Problem> {
    #[derive(Serialize)]
    struct NamedReply<'a> {
        #[serde(skip_serializing_if = "Option::is_none")]
        name: Option<&'a str>,
        #[serde(flatten)]
        read: &'a ImportReply,
    }
    let text = serde_json::to_string(&NamedReply { name, read }).map_err(Problem::internal)?;
    let (lead, rest) = text.split_once(SCENES).ok_or_else(|| Problem::internal("a reply without scenes"))?;
    Ok((lead.to_owned() + SCENES, rest.to_owned()))
}
