//! Native scene JSON as an import and export format.

use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, one_scene};
use crate::source::Source;
use scene::Scene;
use std::io;

/// Native scene JSON.
pub struct NativeJson;

impl Format for NativeJson {
    fn info(&self) -> Info {
        Info {
            id: "dragtraffic",
            name: "DragTraffic scene",
            media_type: super::MEDIA_TYPE,
            extensions: &["scene.json", "json"],
            import: true,
            export: true,
            many: false,
            takes_net: false,
            notes: "Everything that a scene has; `assets/schema/scene.v1.schema.json`.",
            loses: &[],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let head = head.get(..4_096).unwrap_or(head);
        let object = head.iter().find(|b| !b.is_ascii_whitespace()) == Some(&b'{');
        let format = super::FORMAT.as_bytes();
        if object && head.windows(format.len()).any(|w| w == format) {
            return 2;
        }
        u8::from(object && name.to_ascii_lowercase().ends_with(".json"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        one(super::read_from(file).map(|mut scene| {
            if let Some(licence) = &options.licence {
                scene.meta.licence = Some(licence.clone());
            }
            (scene, Vec::new())
        }))
    }

    fn export(&self, scenes: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        one_scene(scenes).map(|scene| Exported { bytes: super::write(scene), losses: Vec::new() })
    }
}
