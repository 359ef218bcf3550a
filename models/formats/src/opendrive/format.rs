//! OpenDRIVE as users import it.

use super::import;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, only_read};
use crate::source::Source;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// A map (`.xodr`, OpenDRIVE 1.4 to 1.9), plain or gzip: a scene with a map and signals, without road users. The
/// frame is the map's, moved by whole metres so that its middle is the origin.
pub struct OpenDrive;

impl Format for OpenDrive {
    fn info(&self) -> Info {
        Info {
            id: "opendrive",
            name: "ASAM OpenDRIVE map",
            media_type: "application/xml",
            extensions: &["xodr", "xodr.gz"],
            import: true,
            export: false,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if xml::root_of(&unpack::head(head)).is_some_and(|root| root == "OpenDRIVE") {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(name.ends_with(".xodr") || name.ends_with(".xodr.gz"))
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
