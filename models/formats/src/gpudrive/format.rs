//! GPUDrive and Nocturne as formats.

use super::{export, import};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one_scene, only};
use crate::loss::code;
use crate::source::Source;
use crate::unpack;
use scene::Scene;
use std::io;

/// Scenarios of one of the two engines. Files of both are read under either; a file is written for its own
/// engine.
pub(crate) struct EngineFormat {
    id: &'static str,
    name: &'static str,
    flavour: Flavour,
    notes: &'static str,
}

/// The engine that reads a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flavour {
    /// With heights, ids and kinds of map elements, headings in radians.
    GpuDrive,
    /// In the plane, headings in degrees.
    Nocturne,
}

/// GPUDrive.
pub(crate) static GPUDRIVE: EngineFormat = EngineFormat {
    id: "gpudrive",
    name: "GPUDrive scenario (JSON)",
    flavour: Flavour::GpuDrive,
    notes: "Road users and signals; lanes are lines without a graph, and those that end where others begin \
         are joined. Moving road users decide whether headings are read as degrees; written in radians, \
         with heights and ids.",
};
/// Nocturne.
pub(crate) static NOCTURNE: EngineFormat = EngineFormat {
    id: "nocturne",
    name: "Nocturne scenario (JSON)",
    flavour: Flavour::Nocturne,
    notes: "Road users and signals; lanes are lines without a graph, and those that end where others begin \
         are joined. Moving road users decide whether headings are read as degrees; written in degrees, \
         in the plane.",
};

/// Flavour of a file, by its beginning.
fn flavour(head: &[u8]) -> Option<Flavour> {
    let object = head.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{');
    let has = |name: &str| head.windows(name.len()).any(|part| part == name.as_bytes());
    // The head of a long recording contains only the positions of the first object.
    let places = has("\"position\"") && has("\"x\"") && !has("\"dragtraffic.scene\"");
    let known = has("\"goalPosition\"") || (has("\"roads\"") && has("\"geometry\"")) || places;
    if !object || !has("\"objects\"") || !known {
        return None;
    }
    Some(if has("\"z\"") || has("\"scenario_id\"") { Flavour::GpuDrive } else { Flavour::Nocturne })
}

impl Format for EngineFormat {
    fn info(&self) -> Info {
        Info {
            id: self.id,
            name: self.name,
            media_type: "application/json",
            extensions: &["json"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
            notes: self.notes,
            loses: &[
                code::NO_CONDITIONS,
                code::NO_GENERATED,
                code::NO_MODES,
                code::NO_SUBTYPE,
                code::NO_ROLES,
                code::NO_LICENCE,
                code::NO_NOTES,
                code::NO_SIGNALS,
                code::NO_SIZES,
                code::NO_TIMING,
                code::NO_LANE_GRAPH,
                code::NO_Z,
                code::NO_DRIVABLE,
                code::NO_LANE_WIDTH,
                code::NO_LANE_TYPE,
                code::LONG_RECORD,
                code::NO_IDS,
                code::NO_SPEED_LIMITS,
                code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        if flavour(&unpack::head(head)) == Some(self.flavour) { 2 } else { 0 }
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        only(options, || import::read(file, options, self.id))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| export::write(scene, options, self.flavour))
    }
}

#[cfg(test)]
mod tests {
    use super::{Flavour, flavour};

    #[test]
    fn long_recordings_are_known_by_their_first_places() {
        let head =
            |place: &str| format!("{{\"name\":\"a\",\"objects\":[{{\"position\":[{{{place}}},{{{place}}}");
        assert!(matches!(flavour(head("\"x\":1.0,\"y\":2.0").as_bytes()), Some(Flavour::Nocturne)));
        assert!(matches!(flavour(head("\"x\":1.0,\"y\":2.0,\"z\":0.0").as_bytes()), Some(Flavour::GpuDrive)));
        let scene = br#"{"format":"dragtraffic.scene","x_a":{"objects":[],"position":{"x":1}}"#;
        assert!(flavour(scene).is_none());
    }
}
