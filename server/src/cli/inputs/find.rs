//! Resolves the inputs of a command: files of folders and patterns, and their names in results.

use super::Source;
use crate::cli::Failure;
use formats::registry::{self, FORMATS};
use formats::table;
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

/// Most files of one call.
const MOST_FILES: usize = 1_000_000;

/// Names in use.
#[derive(Default)]
pub struct Known(HashMap<String, usize>);

impl Known {
    /// The name, with a number appended if it is in use.
    pub fn name(&mut self, name: String) -> String {
        let count = self.0.entry(name.clone()).and_modify(|count| *count += 1).or_insert(1);
        if *count > 1 { format!("{name}-{count}") } else { name }
    }
}

/// The files in the given order; those of a folder or pattern are sorted by name. For recordings in a folder,
/// these are the tables of tracks, by the names in a column file or of the public data sets.
///
/// # Errors
/// Exit 3 when a folder or pattern has none.
pub fn sources(inputs: &[PathBuf], columns: Option<&dyn formats::Source>) -> Result<Vec<Source>, Failure> {
    let mut paths = Vec::new();
    for input in inputs {
        match as_pattern(input) {
            _ if input.is_dir() => paths.extend(of_folder(input, columns)?),
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

/// Replaces patterns by their files and leaves other inputs unchanged, for commands that read folders
/// themselves.
///
/// # Errors
/// Exit 3 when a pattern has none.
#[cfg(feature = "lab")]
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

/// The text of an input that is a pattern and not an existing file.
fn as_pattern(input: &Path) -> Option<&str> {
    input.to_str().filter(|text| text.contains(['*', '?', '[']) && !input.exists())
}

fn of_folder(folder: &Path, columns: Option<&dyn formats::Source>) -> Result<Vec<PathBuf>, Failure> {
    let unreadable = |error| Failure::input(format!("{}: {error}", folder.display()));
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let mut files: Vec<PathBuf> =
        entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file()).collect();
    files.sort();
    let name =
        |path: &PathBuf| path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
    let names: Vec<String> = files.iter().map(name).collect();
    let list: Vec<&str> = names.iter().map(String::as_str).collect();
    let tracks: BTreeSet<usize> = table::firsts(&list, columns).into_iter().collect();
    // The maps of recordings lie in subfolders.
    let is_input = |at: usize, path: &Path, name: &str| {
        tracks.contains(&at) || is_scene(path) && (tracks.is_empty() || !table::is_map(name))
    };
    let mut at = 0..;
    files.retain(|path| {
        at.next().is_some_and(|at| names.get(at).is_some_and(|name| is_input(at, path, name)))
    });
    if files.is_empty() {
        return Err(Failure::input(format!(
            "{}: no file in this folder has the name of a scene",
            folder.display()
        )));
    }
    Ok(files)
}

/// Whether the name of a file in a folder makes it an input.
fn is_scene(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    if name.starts_with('.') || name.ends_with(".tmp") {
        return false;
    }
    // Tables that commands write, such as manifest.csv, are no inputs.
    let mut readable =
        FORMATS.iter().map(|format| format.info()).filter(|info| info.import && info.id != "csv");
    // Names of shards have a number after the extension.
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

/// The file's name without its extensions.
fn label(path: &Path) -> String {
    if path == Path::new("-") {
        return "stdin".into();
    }
    registry::stem(&path.file_name().unwrap_or_default().to_string_lossy()).to_owned()
}

/// Refuses ids after a flag that takes them only with `=`: they would be read as names of missing files.
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
            sources(inputs, None).unwrap().into_iter().map(|source| source.label).collect()
        };
        assert_eq!(labels(&[folder.path().into()]), ["a", "b", "x.tfrecord-00001-of-01000"]);
        assert_eq!(labels(&[folder.path().join("**/*.json")]), [".hidden", "a", "b", "a-2"]);
        for (file, name) in [
            ("gone.tfrecord.gz", "gone"),
            ("e6mini.xodr", "e6mini"),
            ("e6mini.xodr.scene.json", "e6mini"),
            ("town.NET.XML", "town"),
            ("drive.av2.parquet", "drive"),
            ("run.v2.scene.json", "run.v2"),
            (".json", ".json"),
        ] {
            assert_eq!(labels(&[folder.path().join(file)]), [name], "{file}");
        }
        assert!(sources(&[folder.path().join("*.nothing")], None).is_err());
        std::fs::create_dir(folder.path().join("empty")).unwrap();
        assert!(sources(&[folder.path().join("empty")], None).is_err());
    }

    #[test]
    fn the_recordings_of_a_folder_are_their_tracks() {
        let folder = tempfile::tempdir().unwrap();
        let names = [
            "a.json",
            "00_tracks.csv",
            "00_tracksMeta.csv",
            "00_recordingMeta.csv",
            "01_tracks.csv.gz",
            "here.osm",
            "there.xodr",
            "pedestrian_tracks_003.csv",
            "vehicle_tracks_003.csv",
            "manifest.csv",
        ];
        for name in names {
            std::fs::write(folder.path().join(name), "{}").unwrap();
        }
        let labels = |columns: Option<&dyn formats::Source>| -> Vec<String> {
            let sources = sources(&[folder.path().into()], columns).unwrap();
            sources.into_iter().map(|source| source.label).collect()
        };
        assert_eq!(labels(None), ["00_tracks", "01_tracks", "a", "vehicle_tracks_003"]);
        assert_eq!(labels(Some(&"ind".as_bytes())), ["00_tracks", "01_tracks", "a"]);
        // The columns of other tables are unknown, so their maps are separate scenes.
        assert_eq!(labels(Some(&"sind".as_bytes())), ["a", "here", "there"]);
    }
}
