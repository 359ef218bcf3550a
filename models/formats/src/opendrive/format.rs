//! OpenDRIVE as users import it.

use super::{export, import};
use crate::map_file::MapFile;

/// A map (`.xodr`, OpenDRIVE 1.4 to 1.9), plain or gzip: a scene with a map and signals, without road users. The
/// frame is the map's, moved by whole metres so that its middle is the origin.
pub(crate) static OPENDRIVE: MapFile = MapFile {
    id: "opendrive",
    name: "ASAM OpenDRIVE map",
    extensions: &["xodr", "xodr.gz"],
    root: "OpenDRIVE",
    source: "opendrive",
    read: import::read,
    write: Some(export::write),
};
