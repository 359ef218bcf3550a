//! Lanelet2 as users import it.

use super::import;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, only_read};
use crate::source::Source;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// A Lanelet2 map (`.osm`), plain or gzip: a scene with a map and signals, without road users. Points lie where
/// `local_x` and `local_y` say, else where their degrees are in a transverse Mercator projection about the map.
pub struct Lanelet2;

impl Format for Lanelet2 {
    fn info(&self) -> Info {
        Info {
            id: "lanelet2",
            name: "Lanelet2 map",
            media_type: "application/xml",
            extensions: &["osm", "osm.gz"],
            import: true,
            export: false,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        // An extract of OpenStreetMap begins alike; it is refused with what to do with it.
        if xml::root_of(&unpack::head(head)).is_some_and(|root| root == "osm") {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(name.ends_with(".osm") || name.ends_with(".osm.gz"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        if options.skip > 0 || options.max_scenes == 0 {
            return Box::new(std::iter::empty());
        }
        one(import::scene(file, options))
    }

    fn export(&self, _: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        Err(only_read(&self.info()))
    }
}
