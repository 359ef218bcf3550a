//! ScenarioNet as a format among others.

use super::{export, import};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, one_scene};
use crate::source::Source;
use crate::unpack;
use scene::Scene;
use std::io;

/// Protocols of pickles that say which one they are.
const PROTOCOLS: std::ops::RangeInclusive<u8> = 2..=5;

/// ScenarioNet scenarios (`sd_*.pkl`). Pickles are read by a machine that calls nothing.
pub(crate) struct ScenarioNet;

impl Format for ScenarioNet {
    fn info(&self) -> Info {
        Info {
            id: "scenarionet",
            name: "ScenarioNet scenario (pickle)",
            media_type: "application/octet-stream",
            extensions: &["pkl"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let head = unpack::head(head);
        if let [0x80, protocol, ..] = head.as_slice()
            && PROTOCOLS.contains(protocol)
        {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(name.ends_with(".pkl") || name.ends_with(".pickle"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        if options.skip > 0 || options.max_scenes == 0 {
            return Box::new(std::iter::empty());
        }
        one(import::read(file, options))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).map(|scene| export::write(scene, options))
    }
}
