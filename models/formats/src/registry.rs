//! One table of formats, for the server, the command line and the documentation.

use crate::limits::MAX_SCENES;
use crate::loss::{Loss, code as loss_code};
use crate::problem::{FieldProblem, Imported, ReadError, code};
use crate::sumo::formats::{SumoFcd, SumoNet};
use crate::{native, womd};
use scene::Scene;
use serde::Serialize;
use std::io;

/// What people and programs need to know about a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[schemars(rename = "FormatInfo")]
pub struct Info {
    /// Word for `--from`, `--to` and `?format=`.
    pub id: &'static str,
    /// For people.
    pub name: &'static str,
    /// Media type of an exported file.
    pub media_type: &'static str,
    /// Ends of file names, the first one for exports.
    pub extensions: &'static [&'static str],
    /// Can be read.
    pub import: bool,
    /// Can be written.
    pub export: bool,
    /// Holds many scenes in one file.
    pub many: bool,
    /// May come with the network it belongs to ([`ImportOptions::net`]).
    pub takes_net: bool,
}

/// How to read a file of any format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImportOptions {
    /// Scenes to pass over.
    pub skip: usize,
    /// Most scenes to give.
    pub max_scenes: usize,
    /// Licence of the scenes in place of the format's own.
    pub licence: Option<String>,
    /// Check the checksums that the format has.
    pub verify: bool,
    /// The network that a recording belongs to, for formats whose info has `takes_net`: a SUMO `net.xml`,
    /// plain or gzip. Faults in it are reported under [`NET_POINTER`].
    pub net: Option<Vec<u8>>,
}

/// Pointer of faults in [`ImportOptions::net`].
pub const NET_POINTER: &str = "/net";

impl Default for ImportOptions {
    fn default() -> Self {
        Self { skip: 0, max_scenes: MAX_SCENES, licence: None, verify: true, net: None }
    }
}

/// How to write a file of any format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExportOptions {
    /// Which motion, where the format has room for one only.
    pub mode: womd::Mode,
    /// Compress, where the format knows gzip.
    pub gzip: bool,
}

/// An exported file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// The file.
    pub bytes: Vec<u8>,
    /// What it does not carry.
    pub losses: Vec<Loss>,
}

/// A reader and writer of one format.
pub trait Format: Sync {
    /// The table's row.
    fn info(&self) -> Info;

    /// How sure it is that a file is its own: 0 not at all, 1 by name, 2 by content.
    fn sniff(&self, head: &[u8], name: &str) -> u8;

    /// Reads all scenes of a file; one that is broken does not stop the others. Never empty.
    fn import(&self, bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>>;

    /// Writes scenes.
    ///
    /// # Errors
    /// `InvalidInput` when the format cannot hold that many scenes in one file.
    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported>;
}

struct Native;

impl Format for Native {
    fn info(&self) -> Info {
        Info {
            id: "dragtraffic",
            name: "DragTraffic scene",
            media_type: native::MEDIA_TYPE,
            extensions: &["scene.json", "json"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let head = head.get(..4_096).unwrap_or(head);
        let object = head.iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'{');
        let format = native::FORMAT.as_bytes();
        if object && head.windows(format.len()).any(|w| w == format) {
            return 2;
        }
        u8::from(object && name.to_ascii_lowercase().ends_with(".json"))
    }

    fn import(&self, bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>> {
        let result = native::read(bytes).map(|mut scene| {
            if let Some(licence) = &options.licence {
                scene.meta.licence = Some(licence.clone());
            }
            (scene, Vec::new())
        });
        vec![result]
    }

    fn export(&self, scenes: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        match scenes {
            [scene] => Ok(Exported { bytes: native::write(scene), losses: Vec::new() }),
            _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "one scene a file")),
        }
    }
}

struct Womd;

impl Format for Womd {
    fn info(&self) -> Info {
        Info {
            id: "womd",
            name: "Waymo Open Motion Scenario (TFRecord)",
            media_type: "application/octet-stream",
            extensions: &["tfrecord", "tfrecord.gz"],
            import: true,
            export: true,
            many: true,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if womd::looks_like(head) {
            return 2;
        }
        u8::from(name.to_ascii_lowercase().contains("tfrecord"))
    }

    fn import(&self, bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>> {
        let options = womd::Options {
            skip: options.skip,
            max_scenes: options.max_scenes,
            licence: options.licence.clone(),
            verify_crc: options.verify,
            ..womd::Options::default()
        };
        womd::read_all(bytes, &options)
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut bytes = Vec::new();
        let losses = womd::write(scenes, &mut bytes, options.gzip, options.mode)?;
        Ok(Exported { bytes, losses })
    }
}

/// All formats, the native one first.
pub static FORMATS: [&dyn Format; 4] = [&Native, &Womd, &SumoNet, &SumoFcd];

/// The format with this id.
pub fn by_id(id: &str) -> Option<&'static dyn Format> {
    FORMATS.iter().copied().find(|format| format.info().id == id)
}

/// The format that a file most likely has. `name` is a label only; it is never opened.
pub fn sniff(bytes: &[u8], name: &str) -> Option<&'static dyn Format> {
    let scored = FORMATS.iter().map(|format| (format.sniff(bytes, name), *format));
    scored.filter(|(score, _)| *score > 0).max_by_key(|(score, _)| *score).map(|(_, format)| format)
}

/// Reads a file of the given format (`auto` looks at its content and name).
///
/// # Errors
/// `format-unknown`; faults of single scenes are in the list.
pub fn import(
    bytes: &[u8],
    name: &str,
    format: &str,
    options: &ImportOptions,
) -> Result<Vec<Result<Imported, ReadError>>, ReadError> {
    let found = if format == "auto" { sniff(bytes, name) } else { by_id(format) };
    let Some(found) = found else {
        let known: Vec<&str> = FORMATS.iter().map(|f| f.info().id).collect();
        let detail = format!("not a file of a known format ({})", known.join(", "));
        return Err(FieldProblem::new("", code::FORMAT_UNKNOWN, detail).into());
    };
    Ok(found.import(bytes, options))
}

/// Loss codes as the header `Dragtraffic-Loss` lists them.
pub fn loss_header(losses: &[Loss]) -> String {
    let mut codes: Vec<&str> = losses.iter().map(|loss| loss.code).collect();
    codes.dedup();
    codes.join(", ")
}

/// Every loss code that a writer here can give.
pub const LOSS_CODES: [&str; 11] = [
    loss_code::NO_CONDITIONS,
    loss_code::NO_MODES,
    loss_code::NO_SUBTYPE,
    loss_code::NO_ROLES,
    loss_code::NO_LICENCE,
    loss_code::NO_NOTES,
    loss_code::NO_DRIVABLE,
    loss_code::NO_LANE_WIDTH,
    loss_code::NO_LANE_TYPE,
    loss_code::IDS_RENUMBERED,
    loss_code::LONG_RECORD,
];
