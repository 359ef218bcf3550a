//! Input scenes: files, folders and patterns, read a few scenes at a time.

mod find;

pub use find::no_ids;
#[cfg(feature = "lab")]
pub use find::patterns;

use super::{Failure, output};
use api::import::{Companions, ReadScene, SceneFile, known as known_format};
use api::{Code, Problem};
use base::folder;
use base::netconvert::companions;
use clap::Args;
use find::Known;
use formats::registry;
use scene::Scene;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Scenes of one file in memory at a time.
const AT_A_TIME: usize = 16;

/// Which files, for commands that take many.
#[derive(Args, Clone, Debug)]
pub struct Inputs {
    /// Files, folders or patterns such as 'runs/**/*.json', in any format; - is standard input. The tracks of a
    /// recording (00_tracks.csv) are read with the tables and maps of their folder.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Files processed in parallel. Default: one per core.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    pub jobs: Option<u16>,
}

/// A file of scenes, and its name in results.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Path of the file.
    pub path: PathBuf,
    /// Its name without extensions; a number is appended if another file has the same name.
    pub label: String,
}

/// How files are read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Format; detected if absent.
    pub from: Option<String>,
    /// Inputs that accompany each file.
    pub beside: Companions,
    /// Scenes of each file; all if absent.
    pub index: Option<Range<usize>>,
}

impl Default for Reading {
    fn default() -> Self {
        Self { from: None, beside: companions(), index: None }
    }
}

/// One scene of a file.
pub struct Item {
    /// The scene.
    pub scene: Scene,
    /// Its name in results.
    pub name: String,
    /// What its reader changed or left out: code and sentence.
    pub notes: Vec<formats::ImportWarning>,
}

impl Inputs {
    /// The files in the given order; those of a folder or pattern are sorted by name.
    ///
    /// # Errors
    /// Exit 3 when a folder or pattern has none.
    pub fn sources(&self) -> Result<Vec<Source>, Failure> {
        self.sources_by(None)
    }

    /// The same with the names of a recording's tables from a column file.
    ///
    /// # Errors
    /// Exit 3 when a folder or pattern has none.
    pub fn sources_by(&self, columns: Option<&dyn formats::Source>) -> Result<Vec<Source>, Failure> {
        find::sources(&self.scenes, columns)
    }

    /// Number of workers.
    pub fn workers(&self) -> usize {
        self.jobs.map_or_else(super::parallel::cores, usize::from)
    }
}

impl Source {
    /// The file, for messages.
    pub fn shown(&self) -> String {
        self.path.display().to_string()
    }

    /// The accompanying inputs, including those from the file's folder.
    fn with_folder(&self, beside: &Companions) -> Companions {
        let folder =
            (self.path != Path::new("-")).then(|| folder::beside(&self.path, beside.columns.as_deref()));
        Companions { folder: folder.flatten(), ..beside.clone() }
    }

    /// Whether the file's format holds many scenes.
    fn holds_many(bytes: &[u8], reading: &Reading, name: &str) -> bool {
        let format = match &reading.from {
            Some(id) => registry::by_id(known_format(id)),
            None => registry::identified(&bytes, name).ok(),
        };
        format.is_none_or(|format| format.info().many)
    }

    /// Reads scene after scene, passes each to `take` and returns their number. Records that are not scenes
    /// are printed and skipped.
    ///
    /// # Errors
    /// Exit 3, and the errors of `take`.
    pub fn each(
        &self,
        reading: &Reading,
        take: &mut dyn FnMut(Item) -> Result<(), Failure>,
    ) -> Result<usize, Failure> {
        let bytes = output::read(&self.path)?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let beside = self.with_folder(&reading.beside);
        let many = Self::holds_many(&bytes, reading, &name);
        let wanted = reading.index.clone().unwrap_or(0..usize::MAX);
        let (mut at, mut count) = (wanted.start, 0);
        let mut known = Known::default();
        while at < wanted.end {
            let most = AT_A_TIME.min(wanted.end - at);
            let read = SceneFile::of(&bytes, reading.from.as_deref(), &name, &beside, (at, most))
                .and_then(|file| file.read(&bytes));
            let read = match read {
                Err(problem) if at == wanted.start => return Err(refused(&self.path, &problem)),
                Err(problem) => {
                    output::complain(&format!(
                        "{}: left out from scene {at} on: {}",
                        self.shown(),
                        problem.detail
                    ));
                    break;
                }
                Ok(read) => read,
            };
            for (index, problem) in &read.skipped {
                output::complain(&format!("{}: scene {index} left out: {}", self.shown(), problem.detail));
            }
            let found = read.scenes.len() + read.skipped.len();
            let numbers = (at..).filter(|i| read.skipped.iter().all(|(skipped, _)| skipped != i));
            for (index, imported) in numbers.zip(read.scenes) {
                take(self.item(many, &mut known, index, imported))?;
                count += 1;
            }
            if found < most || !many {
                break;
            }
            at += most;
        }
        if count == 0 {
            return Err(Failure::input(format!("{}: no scene at that index", self.shown())));
        }
        Ok(count)
    }

    /// The same, but `take` also gets records that are not scenes: their name and problem.
    ///
    /// # Errors
    /// The errors of `take`.
    pub fn each_or_problem(
        &self,
        take: &mut dyn FnMut(String, Result<Item, Problem>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let bytes = match std::fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let problem = Problem::new(Code::MalformedFile, format!("cannot be read: {}", error.kind()));
                return take(self.label.clone(), Err(problem));
            }
        };
        let reading = Reading::default();
        let file_name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let many = Self::holds_many(&bytes, &reading, &file_name);
        let (mut known, mut index, mut failure) = (Known::default(), 0, None);
        let found =
            SceneFile::of(&bytes, None, &file_name, &self.with_folder(&reading.beside), (0, usize::MAX));
        let read = found.and_then(|file| {
            file.each(&bytes, |read| {
                let item = self.item(many, &mut known, index, read);
                index += 1;
                take(item.name.clone(), Ok(item)).map_err(|error| {
                    failure = Some(error);
                    Problem::internal("a scene was not taken")
                })
            })
        });
        if let Some(failure) = failure {
            return Err(failure);
        }
        match read {
            Err(problem) => take(self.label.clone(), Err(problem)),
            Ok(skipped) => skipped
                .into_iter()
                .try_for_each(|(index, problem)| take(format!("{}-{index:06}", self.label), Err(problem))),
        }
    }

    /// A scene with its name: that of the file, or its own in a file of many.
    fn item(&self, many: bool, known: &mut Known, index: usize, read: ReadScene) -> Item {
        let name = if many { known.name(self.name_of(&read.scene, index)) } else { self.label.clone() };
        Item { scene: read.scene, name, notes: read.warnings }
    }

    /// Name of a scene in a file of many: its id in the source, else its index.
    fn name_of(&self, scene: &Scene, index: usize) -> String {
        let clean = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        let id = scene.meta.source_id.as_deref().unwrap_or_default();
        let id: String = id.chars().map(clean).take(60).collect();
        if id.is_empty() { format!("{}-{index:06}", self.label) } else { id }
    }

    /// The first selected scene.
    ///
    /// # Errors
    /// Exit 3.
    pub fn first(&self, reading: &Reading) -> Result<Item, Failure> {
        let at = reading.index.as_ref().map_or(0, |range| range.start);
        let reading = Reading { index: Some(at..at + 1), ..reading.clone() };
        let mut first = None;
        self.each(&reading, &mut |item| {
            first = Some(item);
            Ok(())
        })?;
        first.ok_or_else(|| Failure::input(format!("{}: no scene in it", self.shown())))
    }
}

/// Converts a file's problem to a failure of the command.
pub fn refused(path: &Path, problem: &Problem) -> Failure {
    let mut message = format!("{}: {}", path.display(), problem.detail);
    for error in problem.members.errors.iter().flatten().skip(1) {
        message.push_str(&format!("\n  {error}"));
    }
    Failure::input(message)
}

/// What readers changed or left out, one line each.
pub fn notes(source: &Source, notes: &[formats::ImportWarning]) -> Vec<String> {
    notes.iter().map(|note| format!("{}: {}: {}", source.shown(), note.code, note.detail)).collect()
}
