//! The interface of a format, implemented by every reader and writer.

use crate::around::Around;
use crate::limits::MAX_SCENES;
use crate::loss::Loss;
use crate::netconvert::Netconvert;
use crate::problem::{self, FieldProblem, ImportWarning, Imported, ReadError};
use crate::refusals;
use crate::source::Source;
use crate::written::FileBounds;
use scene::{Agent, Cancel, Scene, Shown, Timing};
use serde::Serialize;
use std::borrow::Cow;
use std::io;
use std::sync::Arc;

/// Description of a format for clients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[schemars(rename = "FormatInfo")]
pub struct Info {
    /// Id for `--from`, `--to` and `?format=`.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// Media type of an exported file.
    pub media_type: &'static str,
    /// File extensions, the first one for exports.
    pub extensions: &'static [&'static str],
    /// Whether it can be read.
    pub import: bool,
    /// Whether it can be written.
    pub export: bool,
    /// Whether one file holds many scenes.
    pub many: bool,
    /// Whether it may come with its road network ([`ImportOptions::net`]).
    pub takes_net: bool,
    /// Description of the content of a file, and of reading and writing it.
    pub notes: &'static str,
    /// Codes of the losses that a written file may have ([`crate::loss::code`]). Each export reports its
    /// losses.
    pub loses: &'static [&'static str],
}

/// Options for reading a file of any format.
#[derive(Clone, Debug)]
pub struct ImportOptions {
    /// Number of scenes to skip.
    pub skip: usize,
    /// Greatest number of scenes to read.
    pub max_scenes: usize,
    /// Licence of the scenes instead of that of the format.
    pub licence: Option<String>,
    /// Whether to verify the checksums of the format.
    pub verify: bool,
    /// Whether to join the tracks of a road user that a recording has under two ids.
    pub join_identities: bool,
    /// The network of a recording, for formats whose info has `takes_net`: a SUMO `net.xml`, plain or gzip,
    /// or the map of an Argoverse scenario. Faults in it are reported under [`NET_POINTER`].
    pub net: Option<Arc<dyn Source>>,
    /// For extracts of OpenStreetMap.
    pub netconvert: Option<Arc<dyn Netconvert>>,
    /// The column file, for formats that accept one ([`Format::takes_columns`]): a JSON object from this
    /// program's column names to the table's. Faults in it are reported under [`COLUMNS_POINTER`].
    pub columns: Option<Arc<dyn Source>>,
    /// The folder of the file, for tables ([`crate::table::beside`]).
    pub folder: Option<FolderFiles>,
    /// Maps that may lie under the road users of the file ([`crate::registry::grounded`]).
    pub ground: Arc<GroundMaps>,
    /// The part of a map to read, for formats of maps ([`Format::takes_around`]); the whole map if absent.
    pub around: Option<Around>,
}

/// Pointer of faults in [`ImportOptions::net`].
pub const NET_POINTER: &str = "/net";
/// Pointer of faults in [`ImportOptions::columns`].
pub const COLUMNS_POINTER: &str = "/columns";

impl Default for ImportOptions {
    fn default() -> Self {
        Self {
            skip: 0,
            max_scenes: MAX_SCENES,
            licence: None,
            verify: true,
            join_identities: true,
            net: None,
            netconvert: None,
            columns: None,
            folder: None,
            ground: Arc::default(),
            around: None,
        }
    }
}

/// Which motion of a road user is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExportedMotion {
    /// The recorded tracks.
    Log,
    /// The chosen future if there is one, after the log up to its first step.
    #[default]
    Chosen,
}

impl ExportedMotion {
    /// The motion of a road user that is written: as it is shown, or as it was recorded.
    pub(crate) fn of<'a>(self, scene: &Scene, agent: &'a Agent) -> Shown<'a> {
        match self {
            Self::Chosen => scene.shown(agent),
            Self::Log => {
                Shown { agent_type: agent.agent_type, size: agent.size, track: Cow::Borrowed(&agent.track) }
            }
        }
    }

    /// The motion of all road users, and the steps until the last of them ends: generated motion may go on
    /// after the end of the scene.
    pub(crate) fn all(self, scene: &Scene) -> (Vec<Shown<'_>>, usize) {
        let shown: Vec<Shown<'_>> = scene.agents.iter().map(|agent| self.of(scene, agent)).collect();
        let ends = shown.iter().map(|shown| shown.track.first_step + shown.track.states.len());
        let steps = ends.fold(scene.time.steps, usize::max);
        (shown, steps)
    }
}

/// Options for writing a file of any format.
#[derive(Clone, Debug, Default)]
pub struct ExportOptions {
    /// The motion to write, if the format has room for one only.
    pub motion: ExportedMotion,
    /// Whether to compress, if the format supports gzip.
    pub gzip: bool,
    /// The single sample to write, if the format has room for several.
    pub sample: Option<usize>,
    /// Name of the scene in a table of several scenes; its own name when absent.
    pub label: Option<String>,
    /// Whether the file already has scenes, so that no heading is written.
    pub continued: bool,
    /// Most bytes of the file; unbounded when absent.
    pub most_bytes: Option<u64>,
    /// Stops the writing when nobody waits for the file any more.
    pub cancel: Cancel,
}

impl ExportOptions {
    /// Bounds of the file.
    pub(crate) fn bounds(&self) -> FileBounds {
        FileBounds::new(self.most_bytes.unwrap_or(u64::MAX), self.cancel.clone())
    }
}

/// An exported file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// The file.
    pub bytes: Vec<u8>,
    /// Losses of the export.
    pub losses: Vec<Loss>,
}

/// Name of a file in a folder, and the other files of the folder that are read with it.
#[derive(Clone, Debug)]
pub struct FolderFiles {
    /// The name of the file itself.
    pub name: String,
    /// The others, each with its name.
    pub others: Vec<(String, Arc<dyn Source>)>,
}

/// Files with their names.
pub type NamedSources<'a> = Vec<(String, Box<dyn Source + 'a>)>;

/// Maps that come with a file.
#[derive(Debug, Default)]
pub struct MapFiles<'a> {
    /// The files.
    pub files: NamedSources<'a>,
    /// Warnings about maps that are left out.
    pub warnings: Vec<ImportWarning>,
}

/// Maps that may lie under the road users of a file.
#[derive(Debug, Default)]
pub struct GroundMaps {
    /// Scenes with the maps.
    pub maps: Vec<Scene>,
    /// Warnings of their readers.
    pub warnings: Vec<ImportWarning>,
}

/// Scenes of a file, read one at a time on demand; a broken scene does not end the iteration.
pub type Scenes<'a> = Box<dyn Iterator<Item = Result<Imported, ReadError>> + 'a>;

/// The scenes of a file that holds one, or an error.
pub(crate) fn one<'a>(scene: Result<Imported, ReadError>) -> Scenes<'a> {
    Box::new(std::iter::once(scene))
}

/// The scene of a file that holds one, read on demand.
pub(crate) fn only<'a>(
    options: &ImportOptions,
    read: impl FnOnce() -> Result<Imported, ReadError>,
) -> Scenes<'a> {
    if options.skip > 0 || options.max_scenes == 0 { Box::new(std::iter::empty()) } else { one(read()) }
}

/// Role of the ego: the vehicle that recorded a scene or whose motion is predicted.
pub(crate) const EGO: &str = "ego";

/// Steps of a window of a longer recording: 9.1 s, as in the recordings of other sources.
pub(crate) const RECORDED_STEPS: usize = 91;
/// The present step of a window, as in the recordings of other sources.
pub(crate) const NOW_STEP: usize = 10;
/// Time of a scene imported from a map without recording: one past second and eight future ones.
pub(crate) const MAP_TIMING: Timing = Timing { steps: RECORDED_STEPS, now_step: NOW_STEP };

/// Refusal of an export: the format can only be read.
pub(crate) fn only_read(info: &Info) -> io::Error {
    io::Error::new(io::ErrorKind::Unsupported, refusals::only_read(info.name))
}

/// Refusal of an import: the format can only be written.
pub(crate) fn written_only<'a>(info: &Info) -> Scenes<'a> {
    let message = refusals::only_written(info.name);
    one(Err(FieldProblem::new("", problem::code::FORMAT_UNKNOWN, message).into()))
}

/// The scene of a file that has room for one.
///
/// # Errors
/// `InvalidInput` for several scenes, or none.
pub(crate) fn one_scene<'a>(scenes: &[&'a Scene]) -> io::Result<&'a Scene> {
    match scenes {
        [scene] => Ok(scene),
        _ => Err(io::Error::new(io::ErrorKind::InvalidInput, refusals::one_scene_a_file())),
    }
}

/// A reader and writer of one format.
pub trait Format: Sync {
    /// Its row in the table of formats.
    fn info(&self) -> Info;

    /// Confidence that a file with this beginning has this format: 0 none, 1 by name, 2 by content.
    /// Files of a format that is only written are not recognized.
    fn sniff(&self, _head: &[u8], _name: &str) -> u8 {
        0
    }

    /// Whether it may come with names of columns ([`ImportOptions::columns`]).
    fn takes_columns(&self) -> bool {
        false
    }

    /// Whether a part of its map can be read ([`ImportOptions::around`]).
    fn takes_around(&self) -> bool {
        false
    }

    /// Reads the scenes of a file. Each recording of a table gets the map of the options on which most of its
    /// vehicles are.
    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a>;

    /// Maps that come with a file of road users, with their names.
    ///
    /// # Errors
    /// A broken file that should contain them.
    fn maps<'a>(
        &self,
        _file: &'a dyn Source,
        _options: &'a ImportOptions,
    ) -> Result<MapFiles<'a>, ReadError> {
        Ok(MapFiles::default())
    }

    /// Reads all scenes of a file in memory.
    fn import(&self, bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>> {
        self.scenes(&bytes, options).collect()
    }

    /// Writes scenes.
    ///
    /// # Errors
    /// `InvalidInput` when the format cannot hold that many scenes in one file, `FileTooLarge` beyond
    /// [`ExportOptions::most_bytes`], as far as the format can tell before all is written, and any once
    /// [`ExportOptions::cancel`] is set.
    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported>;
}
