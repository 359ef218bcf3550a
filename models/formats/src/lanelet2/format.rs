//! Lanelet2 as users import it.

use super::import;
use crate::map_file::MapFile;

/// A Lanelet2 map (`.osm`), plain or gzip: a scene with a map and signals, without road users. Points lie where
/// `local_x` and `local_y` say, else where their degrees are in a transverse Mercator projection about the map.
///
/// An extract of OpenStreetMap begins alike.
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
