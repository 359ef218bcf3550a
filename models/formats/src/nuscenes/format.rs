//! nuScenes as an import format.

use super::recording::NuScenes;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, only_read};
use crate::source::Source;
use scene::Scene;
use std::io;

/// Names in a zip of tables that only this data set has.
const TABLES: [&str; 4] =
    ["calibrated_sensor.json", "ego_pose.json", "sample_annotation.json", "sample_data.json"];

/// Tables of nuScenes with map expansions, in one zip.
pub(crate) struct NuScenesTables;

impl Format for NuScenesTables {
    fn info(&self) -> Info {
        Info {
            id: "nuscenes",
            name: "nuScenes tables with map expansion (zip)",
            media_type: "application/zip",
            extensions: &["nuscenes.zip"],
            import: true,
            export: false,
            many: true,
            takes_net: false,
            notes: "The tables of a version, such as `v1.0-mini/*.json`, and `maps/expansion/*.json` in one \
                 zip. Each scene has its annotated road users, the ego, and nearby lanes with links, \
                 crossings, dividers and ground; no signals. Keyframes at 2 Hz are resampled. Written \
                 after the published schema, not tested on files of the data set.",
            loses: &[],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let holds = |name: &str| head.windows(name.len()).any(|part| part == name.as_bytes());
        if head.starts_with(b"PK\x03\x04") {
            return if TABLES.iter().any(|table| holds(table)) { 2 } else { 0 };
        }
        u8::from(name.to_ascii_lowercase().ends_with(".nuscenes.zip"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        match NuScenes::read(file, options) {
            Ok(tables) => Box::new(tables.scenes().skip(options.skip).take(options.max_scenes)),
            Err(error) => one(Err(error)),
        }
    }

    fn export(&self, _: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        Err(only_read(&self.info()))
    }
}
