//! Formats whose file is one map: a scene with its signals and without road users.

use crate::around::{Around, MapPart};
use crate::cut::cut;
use crate::format::{
    ExportOptions, Exported, Format, ImportOptions, Info, MAP_TIMING, Scenes, one_scene, only, only_read,
};
use crate::problem::{ImportWarning, Imported, ReadError, code};
use crate::refusals::{self, what};
use crate::repairs::{self, checked};
use crate::source::Source;
use crate::{unpack, xml};
use scene::map::LaneMap;
use scene::message::Message;
use scene::{MAX_COORDINATE_M, Meta, Origin, Scene, Shared, Signal, Vec2};
use std::collections::BTreeMap;
use std::io;

/// Suffix of a bidirectional lane's id for the copy in the opposite direction.
pub(crate) const AGAINST: &str = ".back";

/// A format of maps in XML, plain or gzip.
pub(crate) struct MapFile {
    /// Word for `--from` and `?format=`.
    pub id: &'static str,
    /// Display name.
    pub name: &'static str,
    /// File name endings.
    pub extensions: &'static [&'static str],
    /// Root element of the files.
    pub root: &'static str,
    /// `meta.source` of the scenes.
    pub source: &'static str,
    /// Description of the content of a file.
    pub notes: &'static str,
    /// Codes of the losses that a written file may have.
    pub loses: &'static [&'static str],
    /// The reader.
    pub read: fn(&dyn Source, Option<Around>) -> Result<MapRead, ReadError>,
    /// The writer, if there is one.
    pub write: Option<fn(&Scene, &ExportOptions) -> io::Result<Exported>>,
}

/// Content of a map file.
pub(crate) struct MapRead {
    /// Name of the scene.
    pub name: String,
    /// Map about the origin.
    pub map: Shared<LaneMap>,
    /// Signals over [`MAP_TIMING`].
    pub signals: Vec<Signal>,
    /// Origin in the file's frame.
    pub origin: Origin,
    pub warnings: Vec<ImportWarning>,
    /// The circle to which the map is to be cut.
    pub part: Option<MapPart>,
}

impl MapRead {
    /// A scene with only the map. `source` becomes its `meta.source`.
    ///
    /// # Errors
    /// The bounds of a scene.
    pub fn scene(self, source: &str, licence: Option<String>) -> Result<Imported, ReadError> {
        let Self { name, mut map, mut signals, origin, mut warnings, part } = self;
        if let Some(part) = part {
            warnings.push(cut(&mut map, &mut signals, &part));
            if map.lanes.is_empty() {
                return Err(ReadError::other_content(refusals::file_has_no(what::LANE)));
            }
        }
        warnings.extend(repairs::drop_far_links(&mut map));
        let scene = Scene {
            id: None,
            name,
            meta: Meta { source: source.into(), licence, origin, ..Meta::default() },
            time: MAP_TIMING,
            signals,
            map,
            agents: Vec::new(),
            generated: None,
            extra: BTreeMap::new(),
        };
        checked(scene, warnings)
    }
}

impl Format for MapFile {
    fn info(&self) -> Info {
        Info {
            id: self.id,
            name: self.name,
            media_type: "application/xml",
            extensions: self.extensions,
            import: true,
            export: self.write.is_some(),
            many: false,
            takes_net: false,
            notes: self.notes,
            loses: self.loses,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if xml::root_of(&unpack::head(head)).is_some_and(|root| root == self.root) {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        let ends = |end: &&'static str| name.strip_suffix(*end).is_some_and(|stem| stem.ends_with('.'));
        u8::from(self.extensions.iter().any(ends))
    }

    fn takes_around(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        only(options, || {
            let read = (self.read)(file, options.around);
            let scene = read.and_then(|read| read.scene(self.source, options.licence.clone()));
            scene.map_err(|error| with_advice(error, options.around))
        })
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        match self.write {
            None => Err(only_read(&self.info())),
            Some(write) => one_scene(scenes).and_then(|scene| write(scene, options)),
        }
    }
}

/// Adds to the refusal of a map that is too large how to read a part of it.
pub(crate) fn with_advice(mut error: ReadError, around: Option<Around>) -> ReadError {
    let large = [code::MAP_TOO_LARGE, code::DECODED_TOO_LARGE].contains(&error.code());
    if let (true, None, Some(first)) = (large, around, error.problems.first_mut())
        && first.pointer.is_empty()
    {
        first.detail = format!("{}. {}", first.detail, refusals::near_a_place());
    }
    error
}

/// Whether a map of this half size exceeds the range of a scene, with a margin for what is drawn beside
/// lanes.
pub(crate) fn is_too_wide(half: Vec2) -> bool {
    half.amax() > MAX_COORDINATE_M - 100.0
}

/// Size of the map and the limit, for a refusal.
pub(crate) fn extent(half: Vec2) -> Message {
    refusals::map_too_wide(2.0 * half.x, 2.0 * half.y, MAX_COORDINATE_M)
}
