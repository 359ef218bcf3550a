//! A network and a recording on it in one zip, as users of SUMO keep them together.

use super::formats::{SOURCE, of_net};
use super::import_fcd::{FcdContext, Windows};
use super::import_net;
use super::out::folder::{self, CONFIGURATION, NET, RECORDING, TRIPS};
use super::rows::FcdRows;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, one_scene};
use crate::limits::{MAX_DECODED_BYTES, memory_for};
use crate::loss;
use crate::problem::ReadError;
use crate::refusals;
use crate::source::Source;
use crate::unpack;
use scene::Scene;
use std::io::{self, Cursor};

/// Memory per byte of the zip until it is a scene, bytes.
const FOLDER_MEMORY: u64 = 4;
/// Position of the first file's name in a zip: its length, and its beginning.
const NAME_LENGTH: std::ops::Range<usize> = 26..28;
const NAME_FROM: usize = 30;

/// A network, a recording on it, the trips of its road users and a configuration of SUMO in one zip. Only the
/// first two are read.
pub(crate) struct SumoFolder;

/// Files of a zip archive that are read.
#[derive(Default)]
struct ZipContents {
    net: Option<Vec<u8>>,
    recording: Option<Vec<u8>>,
}

impl ZipContents {
    fn read(file: &dyn Source) -> Result<Self, ReadError> {
        let most = MAX_DECODED_BYTES.min(memory_for(file.encoded_len()) / FOLDER_MEMORY);
        let mut folder = Self::default();
        for (name, bytes) in
            unpack::zipped(file, most, |name| name.ends_with(NET) || name.ends_with(RECORDING))?
        {
            let part = if name.ends_with(NET) { &mut folder.net } else { &mut folder.recording };
            part.get_or_insert(bytes);
        }
        Ok(folder)
    }
}

impl Format for SumoFolder {
    fn info(&self) -> Info {
        Info {
            id: "sumo",
            name: "SUMO network, trips and floating-car data (zip)",
            media_type: "application/zip",
            extensions: &["sumo.zip"],
            import: true,
            export: true,
            many: true,
            takes_net: false,
            notes: "Network, trips and recording with their configuration: `sumo -c` drives the trips, and \
                 the recording has the motion itself. Network and recording are read.",
            loses: &[
                loss::code::NO_CONDITIONS,
                loss::code::NO_GENERATED,
                loss::code::NO_MODES,
                loss::code::NO_SUBTYPE,
                loss::code::NO_ROLES,
                loss::code::NO_LICENCE,
                loss::code::NO_NOTES,
                loss::code::NO_MAP,
                loss::code::NO_SIGNALS,
                loss::code::NO_SIZES,
                loss::code::NO_TIMING,
                loss::code::NO_LANE_GRAPH,
                loss::code::NO_Z,
                loss::code::NO_UNSEEN,
                loss::code::NO_DRIVABLE,
                loss::code::NO_LANE_WIDTH,
                loss::code::NO_LANE_TYPE,
                loss::code::NO_LINES,
                loss::code::NO_AREAS,
                loss::code::NO_NEIGHBORS,
                loss::code::NO_SIGNAL_STATES,
                loss::code::GEOMETRY_APPROXIMATED,
                loss::code::NO_IDS,
                loss::code::NO_SPEED_LIMITS,
                loss::code::NO_VELOCITY,
                loss::code::NO_TRIPS,
                loss::code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if head.starts_with(b"PK\x03\x04") {
            let length =
                head.get(NAME_LENGTH).and_then(|bytes| bytes.try_into().ok()).map(u16::from_le_bytes);
            let first = head.get(NAME_FROM..NAME_FROM + usize::from(length.unwrap_or_default()));
            let first = String::from_utf8_lossy(first.unwrap_or_default()).to_ascii_lowercase();
            let ours = [CONFIGURATION, NET, TRIPS, RECORDING].iter().any(|end| first.ends_with(end));
            return if ours { 2 } else { 0 };
        }
        u8::from(name.to_ascii_lowercase().ends_with(".sumo.zip"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        let ZipContents { net, recording } = match ZipContents::read(file) {
            Ok(folder) => folder,
            Err(error) => return one(Err(error)),
        };
        let net = match net.map(|net| import_net::read(&net, None)).transpose() {
            Ok(net) => net,
            Err(error) => return one(Err(error)),
        };
        let licence = options.licence.clone();
        match (net, recording) {
            (net, Some(recording)) => {
                let head = unpack::head(&recording[..]);
                match FcdRows::of(&head, Box::new(Cursor::new(recording))) {
                    Ok(rows) => {
                        let windows = Windows::new(rows, FcdContext { net, licence });
                        Box::new(windows.skip(options.skip).take(options.max_scenes))
                    }
                    Err(error) => one(Err(error)),
                }
            }
            (Some(_), None) if options.skip > 0 || options.max_scenes == 0 => Box::new(std::iter::empty()),
            (Some(net), None) => one(of_net(net).scene(SOURCE, licence)),
            (None, None) => one(Err(ReadError::other_content(refusals::zip_without(NET, RECORDING)))),
        }
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| folder::write(scene, options))
    }
}
