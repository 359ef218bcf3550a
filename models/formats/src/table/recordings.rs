//! The recordings of a table, of a zip of tables, and of tables beside it; their scenes in order.

use super::companions::{NamedTable, RecordingFiles};
use super::groups::{self, TableGroup, is_map, is_table};
use super::import::Scenarios;
use super::rows::TableFile;
use crate::format::{ImportOptions, MapFiles, Scenes, one};
use crate::limits::{MAX_DECODED_BYTES, memory_for};
use crate::problem::{ImportWarning, Imported, ReadError, code};
use crate::refusals::{self, what};
use crate::sentences;
use crate::source::{Source, begins_with};
use crate::unpack::{self, ZIP};
use std::collections::BTreeMap;

/// Most bytes of the decompressed files of a zip, or of a folder: they are read in turn, and never all in
/// memory.
const MOST_BYTES: u64 = 4 * MAX_DECODED_BYTES;
/// Most maps of a zip or folder, and memory per byte of their texts.
const MOST_MAPS: usize = 64;
const MAP_MEMORY: u64 = 8;
/// Most names in a message about files beside a table.
const MOST_TOLD: usize = 8;

/// The tables and maps that come with a file, each with its name.
struct FileSet<'a> {
    files: Vec<NamedTable<'a>>,
    /// Whether all are in one zip; otherwise the first one is the file itself, and the others are in its
    /// folder.
    in_zip: bool,
}

impl<'a> FileSet<'a> {
    fn of(file: &'a dyn Source, options: &'a ImportOptions) -> Result<Self, ReadError> {
        let in_zip = begins_with(file, ZIP);
        let files: Vec<NamedTable<'a>> = if in_zip {
            let wanted = |name: &str| is_table(name) || is_map(name);
            let entries = unpack::entries(file, MAX_DECODED_BYTES, wanted)?;
            // macOS adds metadata copies of files to a zip under this prefix.
            let files: BTreeMap<_, _> =
                entries.into_iter().filter(|(name, _)| !name.starts_with("__MACOSX")).collect();
            files.into_iter().map(|(name, entry)| (name, TableFile::Packed(entry))).collect()
        } else {
            let (name, others) = options
                .folder
                .as_ref()
                .map_or(("", [].as_slice()), |folder| (folder.name.as_str(), folder.others.as_slice()));
            let own = (name.to_owned(), TableFile::Given(file));
            let others = others.iter().map(|(name, other)| (name.clone(), TableFile::Given(other.as_ref())));
            std::iter::once(own).chain(others).collect()
        };
        let sizes = files.iter().map(|(_, file)| file.unpacked_len());
        if sizes.fold(0, u64::saturating_add) > MOST_BYTES {
            let message = refusals::more_than(MOST_BYTES, what::DECODED_BYTES);
            return Err(ReadError::too_large(code::DECODED_TOO_LARGE, MOST_BYTES, message));
        }
        Ok(Self { files, in_zip })
    }

    /// The recordings: all of a zip, otherwise the one whose tracks the file contains.
    fn recordings(&self, columns: Option<&dyn Source>) -> Vec<TableGroup> {
        let is_one = |name: &str| !self.in_zip || is_table(name);
        let tables = self.files.iter().map(|(name, _)| name.as_str());
        // A map is not a table, but indices count all files, so it keeps an empty name.
        let names: Vec<&str> = tables.map(|name| if is_one(name) { name } else { "" }).collect();
        let mut found = groups::groups(&names, columns);
        if !self.in_zip {
            found.retain(|group| group.tracks.contains(&0));
            return if found.is_empty() { vec![TableGroup::alone(0, String::new())] } else { found };
        }
        if found.is_empty() { groups::each_alone(&names) } else { found }
    }

    /// The message about files in the folder that are read with the table of a recording.
    fn told(&self, group: &TableGroup, options: &ImportOptions) -> Option<ImportWarning> {
        if self.in_zip {
            return None;
        }
        let is_read = |(at, name): &(usize, &str)| {
            *at > 0 && (group.all().any(|own| own == *at) || options.net.is_none() && is_map(name))
        };
        let all = self.files.iter().map(|(name, _)| name.as_str()).enumerate();
        let names: Vec<&str> = all.filter(is_read).map(|(_, name)| name).collect();
        let shown = names.iter().take(MOST_TOLD).copied().collect::<Vec<_>>().join(", ");
        let message = sentences::files_beside(names.len(), &shown);
        (!names.is_empty()).then(|| ImportWarning::new("files-beside", message))
    }
}

/// Maps that come with a table: those of its zip or folder. Those beyond the limits are left out, and a warning
/// names the first of them.
///
/// # Errors
/// A broken zip.
pub(super) fn maps<'a>(file: &'a dyn Source, options: &'a ImportOptions) -> Result<MapFiles<'a>, ReadError> {
    let mut maps = MapFiles::default();
    let all = FileSet::of(file, options)?.files;
    // All maps stay in memory until the last scene is read.
    let most = memory_for(file.encoded_len()) / MAP_MEMORY;
    let mut size = 0u64;
    for (name, map) in all.into_iter().filter(|(name, _)| is_map(name)) {
        size = size.saturating_add(map.unpacked_len());
        let bounds = [(maps.files.len() + 1, MOST_MAPS, what::MAPS)];
        let why = match refusals::exceeded(&bounds) {
            Some((most, what)) => Some(refusals::more_than(most, what)),
            None => (size > most).then(|| refusals::more_than(most, what::MAP_BYTES)),
        };
        if let Some(why) = why {
            let message = sentences::map_unread(&name, &why.to_string());
            maps.warnings.push(ImportWarning::new("map-unread", message));
            break;
        }
        maps.files.push((name, Box::new(map)));
    }
    Ok(maps)
}

/// The recordings of a file, each with the message about its files.
fn recordings<'a>(
    file: &'a dyn Source,
    options: &'a ImportOptions,
) -> Result<Vec<RecordingFiles<'a>>, ReadError> {
    let set = FileSet::of(file, options)?;
    let of = |places: &[usize]| places.iter().filter_map(|at| set.files.get(*at).cloned()).collect();
    let recording = |group: TableGroup| RecordingFiles {
        tracks: of(&group.tracks),
        agents: of(&group.agents),
        recording: of(&group.recording),
        told: set.told(&group, options),
        name: group.name,
    };
    let found: Vec<RecordingFiles<'a>> =
        set.recordings(options.columns.as_deref()).into_iter().map(recording).collect();
    if found.is_empty() {
        return Err(ReadError::other_content(refusals::zip_without(".csv", ".csv.gz")));
    }
    Ok(found)
}

/// Scenes of a file, each with the best matching map of the options. An unreadable recording does not stop the
/// others.
pub(super) fn scenes<'a>(file: &'a dyn Source, options: &'a ImportOptions, parquet: bool) -> Scenes<'a> {
    let recordings = match recordings(file, options) {
        Ok(recordings) => recordings,
        Err(error) => return one(Err(error)),
    };
    let read = move |files: RecordingFiles<'a>| -> Scenes<'a> {
        match Scenarios::open(files, options, parquet) {
            Ok(scenes) => Box::new(scenes),
            Err(error) => one(Err(error)),
        }
    };
    let scenes = recordings.into_iter().flat_map(read);
    Box::new(scenes.skip(options.skip).take(options.max_scenes))
        as Box<dyn Iterator<Item = Result<Imported, ReadError>>>
}
