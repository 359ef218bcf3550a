//! ScenarioNet as an import and export format.

use super::{export, import};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one_scene, only};
use crate::loss;
use crate::source::Source;
use crate::unpack;
use scene::Scene;
use std::io;

/// Protocols of pickles that state their number.
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
            notes: "Road users, lanes and signals, in single precision; one file per scene, without the \
                 lists of a data set. The reader executes no calls: a pickle that asks for more than \
                 arrays is refused (`pickle-refused`).",
            loses: &[
                loss::code::NO_CONDITIONS,
                loss::code::NO_GENERATED,
                loss::code::NO_MODES,
                loss::code::NO_SUBTYPE,
                loss::code::NO_ROLES,
                loss::code::NO_NOTES,
                loss::code::NO_LANE_TYPE,
                loss::code::NO_Z,
                loss::code::NO_DRIVABLE,
                loss::code::LONG_RECORD,
                loss::code::GEOMETRY_APPROXIMATED,
                loss::code::IDS_RENUMBERED,
            ],
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
        only(options, || import::read(file, options))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).map(|scene| export::write(scene, options))
    }
}
