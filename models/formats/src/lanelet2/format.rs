//! Lanelet2 as an import format.

use super::import;
use crate::map_file::MapFile;

/// A Lanelet2 map (`.osm`), plain or compressed with gzip: a scene with a map and signals, without road
/// users. Positions come from `local_x` and `local_y`, otherwise from the degrees in a transverse Mercator
/// projection about the map.
///
/// An extract of OpenStreetMap has the same beginning.
pub(crate) static LANELET2: MapFile = MapFile {
    id: "lanelet2",
    name: "Lanelet2 map",
    extensions: &["osm", "osm.gz"],
    root: "osm",
    source: "lanelet2",
    notes: "Lanelets with their links, paint, road edges, crosswalks and stop signs, in `local_x` and \
         `local_y` or degrees. Signals get fixed times; no road users. Plain or gzip.",
    loses: &[],
    read: import::read,
    write: None,
};
