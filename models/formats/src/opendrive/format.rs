//! OpenDRIVE as an import format.

use super::{export, import};
use crate::loss::code;
use crate::map_file::MapFile;

/// A map (`.xodr`, OpenDRIVE 1.4 to 1.9), plain or compressed with gzip: a scene with a map and signals,
/// without road users. The frame is that of the map, moved by whole metres so that its middle is the origin.
pub(crate) static OPENDRIVE: MapFile = MapFile {
    id: "opendrive",
    name: "ASAM OpenDRIVE map",
    extensions: &["xodr", "xodr.gz"],
    root: "OpenDRIVE",
    source: "opendrive",
    notes: "1.4 to 1.9 are read, 1.7 is written. Read: lanes with their links, paint, road edges and \
         medians, crosswalks, stop signs, left-hand traffic. Signals get fixed times, as the format has \
         none; cross slopes are flat; no road users. In a written map each lane is a road of its own, \
         within 0.02 m, with crosswalks, signal heads and signs. Plain or gzip.",
    loses: &[
        code::NO_ROAD_USERS,
        code::NO_SIGNALS,
        code::NO_DRIVABLE,
        code::NO_LINES,
        code::NO_AREAS,
        code::NO_NEIGHBORS,
        code::GEOMETRY_APPROXIMATED,
    ],
    read: import::read,
    write: Some(export::write),
};
