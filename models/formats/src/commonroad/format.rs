//! CommonRoad as a format among others.

use super::document::ROOT;
use super::{export, import};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, one_scene};
use crate::source::Source;
use crate::{unpack, xml};
use scene::Scene;
use std::io;

/// CommonRoad scenarios: 2018b and 2020a are read, plain or gzip; 2020a is written.
pub(crate) struct CommonRoad;

impl Format for CommonRoad {
    fn info(&self) -> Info {
        Info {
            id: "commonroad",
            name: "CommonRoad scenario",
            media_type: "application/xml",
            extensions: &["xml"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        if xml::root_of(&unpack::head(head)).is_some_and(|root| root == ROOT) { 2 } else { 0 }
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        if options.skip > 0 || options.max_scenes == 0 {
            return Box::new(std::iter::empty());
        }
        one(import::read(file, options))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| export::write(scene, options))
    }
}
