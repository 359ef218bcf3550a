//! OpenSCENARIO as an import and export format.

use super::{read, scenario};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one_scene};
use crate::loss::{Loss, code};
use crate::opendrive;
use crate::pack;
use crate::source::Source;
use scene::Scene;
use std::collections::BTreeSet;
use std::io;

/// A scenario (OpenSCENARIO 1.2) and its map (OpenDRIVE 1.7), both in one zip.
pub(crate) struct OpenScenario;

fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let name = pack::file_name(scene);
    let mut losses = BTreeSet::new();
    let map = match scene.map.lanes.is_empty() {
        true => None,
        false => Some(opendrive::export::document(scene, options)?),
    };
    let road_file = map.as_ref().map(|_| format!("{name}.xodr"));
    let scenario = scenario::write(scene, options, road_file.as_deref(), &mut losses)?;
    let mut files = vec![(format!("{name}.xosc"), scenario)];
    if let (Some((map, lost)), Some(file)) = (map, road_file) {
        files.push((file, map));
        let elsewhere = [code::NO_SIGNALS, code::NO_ROAD_USERS];
        losses.extend(lost.into_iter().filter(|loss| !elsewhere.contains(&loss.code)));
    }
    let losses: Vec<Loss> = losses.into_iter().collect();
    Ok(Exported { bytes: pack::zip(files)?, losses })
}

impl Format for OpenScenario {
    fn info(&self) -> Info {
        Info {
            id: "openscenario",
            name: "ASAM OpenSCENARIO XML with OpenDRIVE (zip)",
            media_type: "application/zip",
            extensions: &["xosc.zip", "xosc"],
            import: true,
            export: true,
            many: false,
            takes_net: true,
            notes: "1.2 is written with its OpenDRIVE map: every road user follows its track at every 0.1 s, \
                 and appears and disappears at its times; signals have their states. 1.0 to 1.3 are read, \
                 alone or in a zip with map and catalogs: initial states, parameters, catalogs, polylines \
                 with times, and phases of signals. Paths of unread manoeuvres are listed.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_GENERATED,
                code::NO_MODES,
                code::NO_SUBTYPE,
                code::NO_NOTES,
                code::NO_SIGNALS,
                code::NO_Z,
                code::NO_DRIVABLE,
                code::NO_LINES,
                code::NO_AREAS,
                code::NO_NEIGHBORS,
                code::NO_VALIDITY_GAPS,
                code::NO_SIGNAL_STATES,
                code::GEOMETRY_APPROXIMATED,
                code::NO_VELOCITY,
            ],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if read::begins(head) {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(name.ends_with(".xosc") || name.ends_with(".xosc.zip"))
    }

    fn takes_around(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        read::scenes(file, options)
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).and_then(|scene| write(scene, options))
    }
}
