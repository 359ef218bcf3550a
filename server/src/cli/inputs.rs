//! Scenes to work on: files, folders and patterns, read a few scenes at a time.

use super::{Failure, output};
use crate::base::problem::Problem;
use crate::scenes::transfer;
use clap::Args;
use formats::registry::{self, FORMATS};
use scene::Scene;
use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Scenes of one file that are in memory at a time.
const AT_A_TIME: usize = 16;
/// Most files of one call.
const MOST_FILES: usize = 1_000_000;
/// Ends of file names that say nothing about the scene.
const ENDS: [&str; 9] = [".json", ".tfrecord", ".gz", ".net.xml", ".xml", ".csv", ".scene", ".fcd", ".zst"];

/// Which files, for commands that take many.
#[derive(Args, Clone, Debug)]
pub struct Inputs {
    /// Files, folders or patterns such as 'runs/**/*.json', of any format; - is stdin.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
    /// Files worked on at the same time; one a core when absent.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    pub jobs: Option<u16>,
}

/// A file of scenes and what it is called in results.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Where.
    pub path: PathBuf,
    /// Its name without endings; another file of the same name has a number behind it.
    pub label: String,
}

/// How files are read.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// Format; recognised when absent.
    pub from: Option<String>,
    /// The network that recordings belong to.
    pub net: Option<Vec<u8>>,
    /// Scenes of each file; all when absent.
    pub index: Option<Range<usize>>,
}

/// Names that were given.
#[derive(Default)]
struct Known(HashMap<String, usize>);

impl Known {
    /// The name, with a number behind it where another one has it.
    fn name(&mut self, name: String) -> String {
        let count = self.0.entry(name.clone()).and_modify(|count| *count += 1).or_insert(1);
        if *count > 1 { format!("{name}-{count}") } else { name }
    }
}

/// One scene of a file.
pub struct Item {
    /// The scene.
    pub scene: Scene,
    /// What it is called in results.
    pub name: String,
    /// What its reader changed or left out: code and sentence.
    pub notes: Vec<formats::Warning>,
}

impl Inputs {
    /// The files, in the order given, those of a folder or pattern by name.
    ///
    /// # Errors
    /// Exit 3 when a folder or pattern has none.
    pub fn sources(&self) -> Result<Vec<Source>, Failure> {
        sources(&self.scenes)
    }

    /// Workers.
    pub fn workers(&self) -> usize {
        self.jobs.map_or_else(super::parallel::cores, usize::from)
    }
}

/// As [`Inputs::sources`].
///
/// # Errors
/// Exit 3 when a folder or pattern has none.
pub fn sources(inputs: &[PathBuf]) -> Result<Vec<Source>, Failure> {
    let mut paths = Vec::new();
    for input in inputs {
        match as_pattern(input) {
            _ if input.is_dir() => paths.extend(of_folder(input)?),
            Some(pattern) => paths.extend(of_pattern(pattern)?),
            None => paths.push(input.clone()),
        }
        if paths.len() > MOST_FILES {
            return Err(Failure::input(format!("more than {MOST_FILES} files")));
        }
    }
    let mut known = Known::default();
    let named = |path: PathBuf| Source { label: known.name(label(&path)), path };
    Ok(paths.into_iter().map(named).collect())
}

/// The files of patterns among the inputs, and all else as it is: for commands that look into folders themselves.
///
/// # Errors
/// Exit 3 when a pattern has none.
pub fn patterns(inputs: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
    let mut paths = Vec::new();
    for input in inputs {
        match as_pattern(input) {
            Some(pattern) => paths.extend(of_pattern(pattern)?),
            None => paths.push(input.clone()),
        }
    }
    Ok(paths)
}

/// The text of a pattern that is no file's name.
fn as_pattern(input: &Path) -> Option<&str> {
    input.to_str().filter(|text| text.contains(['*', '?', '[']) && !input.exists())
}

fn of_folder(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let unreadable = |error| Failure::input(format!("{}: {error}", folder.display()));
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file() && is_scene(path))
        .collect();
    files.sort();
    if files.is_empty() {
        return Err(Failure::input(format!(
            "{}: no file in this folder has the name of a scene",
            folder.display()
        )));
    }
    Ok(files)
}

/// Whether a file of a folder is taken, by its name alone.
fn is_scene(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    if name.starts_with('.') || name.ends_with(".tmp") {
        return false;
    }
    let mut readable = FORMATS.iter().map(|format| format.info()).filter(|info| info.import);
    // Shards have a number behind the ending.
    name.contains("tfrecord") || readable.any(|info| info.extensions.iter().any(|end| has_end(&name, end)))
}

fn has_end(name: &str, end: &str) -> bool {
    name.strip_suffix(end).is_some_and(|stem| stem.ends_with('.') || end.starts_with('.'))
}

fn of_pattern(pattern: &str) -> Result<Vec<PathBuf>, Failure> {
    let wrong = |error: glob::PatternError| Failure::usage(format!("{pattern}: {error}"));
    let found = glob::glob(pattern).map_err(wrong)?;
    let mut files: Vec<PathBuf> =
        found.filter_map(Result::ok).filter(|path| path.is_file()).take(MOST_FILES).collect();
    files.sort();
    if files.is_empty() {
        return Err(Failure::input(format!("{pattern}: no file matches")));
    }
    Ok(files)
}

/// The file's name without what its endings say.
fn label(path: &Path) -> String {
    if path == Path::new("-") {
        return "stdin".into();
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut stem: &str = &name;
    while let Some(shorter) = ENDS.iter().find_map(|end| stem.strip_suffix(end)).filter(|s| !s.is_empty()) {
        stem = shorter;
    }
    stem.to_owned()
}

impl Source {
    /// The file as messages name it.
    pub fn shown(&self) -> String {
        self.path.display().to_string()
    }

    /// The file's format is one that has many scenes in a file.
    fn holds_many(bytes: &[u8], reading: &Reading, name: &str) -> bool {
        let format = match &reading.from {
            Some(id) => registry::by_id(transfer::known(id)),
            None => registry::sniff(bytes, name),
        };
        format.is_none_or(|format| format.info().many)
    }

    /// Reads scene after scene and hands each to `take`; gives their number. What is no scene is told and passed
    /// over.
    ///
    /// # Errors
    /// Exit 3, and what `take` reports.
    pub fn each(
        &self,
        reading: &Reading,
        take: &mut dyn FnMut(Item) -> Result<(), Failure>,
    ) -> Result<usize, Failure> {
        let bytes = output::read(&self.path)?;
        let name = self.path.file_name().unwrap_or_default().to_string_lossy();
        let many = Self::holds_many(&bytes, reading, &name);
        let wanted = reading.index.clone().unwrap_or(0..usize::MAX);
        let (mut at, mut count) = (wanted.start, 0);
        let mut known = Known::default();
        while at < wanted.end {
            let most = AT_A_TIME.min(wanted.end - at);
            let read = transfer::read(&bytes, reading.from.as_deref(), &name, at, most, reading.net.clone());
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
                let name =
                    if many { known.name(self.name_of(&imported.scene, index)) } else { self.label.clone() };
                take(Item { scene: imported.scene, name, notes: imported.warnings })?;
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

    /// A scene of a file with many is called by its id in the source, else by its place.
    fn name_of(&self, scene: &Scene, index: usize) -> String {
        let clean = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        let id = scene.meta.source_id.as_deref().unwrap_or_default();
        let id: String = id.chars().map(clean).take(60).collect();
        if id.is_empty() { format!("{}-{index:06}", self.label) } else { id }
    }

    /// The first scene that is wanted.
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

/// Refuses ids that stand behind a flag which takes them behind `=` alone: they would be files that are not there.
///
/// # Errors
/// Exit 2.
pub fn no_ids(sources: &[Source], flag: &str) -> Result<(), Failure> {
    let is_id = |c: char| c.is_ascii_alphanumeric() || ",_:-".contains(c);
    let stray = sources.iter().find(|source| {
        let text = source.path.to_string_lossy();
        text != "-" && text.chars().all(is_id) && !source.path.exists()
    });
    match stray {
        Some(source) if sources.len() > 1 => {
            let text = source.shown();
            Err(Failure::usage(format!(
                "{text}: no such file; road users stand behind =, as in {flag}={text}"
            )))
        }
        _ => Ok(()),
    }
}

/// Problems of files as failures of the command.
pub fn refused(path: &Path, problem: &Problem) -> Failure {
    let mut message = format!("{}: {}", path.display(), problem.detail);
    for error in problem.members.errors.iter().flatten().skip(1) {
        message.push_str(&format!("\n  {error}"));
    }
    Failure::input(message)
}

/// Says what readers changed or left out.
pub fn tell_notes(source: &Source, notes: &[formats::Warning]) -> Vec<String> {
    notes.iter().map(|note| format!("{}: {}: {}", source.shown(), note.code, note.detail)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_and_patterns_give_scenes_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let names =
            ["b.json", "a.json", "notes.md", ".hidden.json", "x.tfrecord-00001-of-01000", "manifest.csv"];
        for name in names {
            std::fs::write(folder.path().join(name), "{}").unwrap();
        }
        std::fs::create_dir(folder.path().join("deep")).unwrap();
        std::fs::write(folder.path().join("deep/a.json"), "{}").unwrap();
        let labels = |inputs: &[PathBuf]| -> Vec<String> {
            sources(inputs).unwrap().into_iter().map(|source| source.label).collect()
        };
        assert_eq!(labels(&[folder.path().into()]), ["a", "b", "x.tfrecord-00001-of-01000"]);
        assert_eq!(labels(&[folder.path().join("**/*.json")]), [".hidden", "a", "b", "a-2"]);
        assert_eq!(labels(&[folder.path().join("gone.tfrecord.gz")]), ["gone"]);
        assert!(sources(&[folder.path().join("*.nothing")]).is_err());
        std::fs::create_dir(folder.path().join("empty")).unwrap();
        assert!(sources(&[folder.path().join("empty")]).is_err());
    }
}
