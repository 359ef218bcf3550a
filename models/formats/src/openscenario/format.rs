//! OpenSCENARIO as users export it.

use super::scenario;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one};
use crate::loss::{Loss, code};
use crate::opendrive;
use crate::problem::{self, FieldProblem};
use crate::source::Source;
use scene::Scene;
use std::collections::BTreeSet;
use std::io::{self, Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// A scenario (OpenSCENARIO 1.2) and its map (OpenDRIVE 1.7), both in one zip.
pub(crate) struct OpenScenario;

/// Name of the files, where a scene has none that a file can have.
const NAME: &str = "scene";
/// Longest name of the files.
const NAME_CHARS: usize = 60;

/// What files of a scene are called: letters, digits and dashes of its name.
fn file_name(scene: &Scene) -> String {
    let word = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let plain: String = scene.name.chars().map(word).collect();
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    let name: String = words.join("-").chars().take(NAME_CHARS).collect();
    if name.is_empty() { NAME.into() } else { name }
}

fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let name = file_name(scene);
    let mut losses = BTreeSet::new();
    let map = match scene.map.lanes.is_empty() {
        true => None,
        false => Some(opendrive::export::write(scene, options)?),
    };
    let road_file = map.as_ref().map(|_| format!("{name}.xodr"));
    let scenario = scenario::write(scene, options, road_file.as_deref(), &mut losses);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // The same scene is the same bytes, whenever it is written.
    let how = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    zip.start_file(format!("{name}.xosc"), how)?;
    zip.write_all(&scenario)?;
    if let (Some(map), Some(file)) = (map, road_file) {
        zip.start_file(file, how)?;
        zip.write_all(&map.bytes)?;
        let elsewhere = [code::NO_SIGNALS, code::NO_ROAD_USERS];
        losses.extend(map.losses.into_iter().filter(|loss| !elsewhere.contains(&loss.code)));
    }
    let losses: Vec<Loss> = losses.into_iter().collect();
    Ok(Exported { bytes: zip.finish()?.into_inner(), losses })
}

impl Format for OpenScenario {
    fn info(&self) -> Info {
        Info {
            id: "openscenario",
            name: "ASAM OpenSCENARIO XML with OpenDRIVE (zip)",
            media_type: "application/zip",
            extensions: &["xosc.zip"],
            import: false,
            export: true,
            many: false,
            takes_net: false,
        }
    }

    fn sniff(&self, _: &[u8], _: &str) -> u8 {
        0
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        let detail = "OpenSCENARIO is written, not read";
        one(Err(FieldProblem::new("", problem::code::FORMAT_UNKNOWN, detail).into()))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        match scenes {
            [scene] => write(scene, options),
            _ => Err(io::Error::new(io::ErrorKind::InvalidInput, "one scene a file")),
        }
    }
}
