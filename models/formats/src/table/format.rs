//! Tables as users import and export them.

use super::{import, write};
use crate::columnar::{self, is_parquet, names_in};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one};
use crate::refusals::{file_needs, what};
use crate::source::Source;
use crate::table::notes::{KEY, Notes};
use crate::unpack;
use crate::written::BoundedFile;
use flate2::Compression;
use flate2::write::GzEncoder;
use scene::Scene;
use std::collections::BTreeSet;
use std::io;

/// Columns by which a table of ours is known.
const OURS: [&str; 3] = ["agent_id", "x_m", "y_m"];

/// Comma-separated values, plain or gzip.
pub struct Csv;

/// Parquet: the same columns with their types, zstd, and frame, licence and time beside them.
pub struct Parquet;

fn scenes<'a>(file: &'a dyn Source, options: &'a ImportOptions, parquet: bool) -> Scenes<'a> {
    match import::Scenarios::open(file, options, parquet) {
        Ok(scenes) => Box::new(scenes.skip(options.skip).take(options.max_scenes)),
        Err(error) => one(Err(error)),
    }
}

impl Format for Csv {
    fn info(&self) -> Info {
        Info {
            id: "csv",
            name: "Table of motion (CSV)",
            media_type: "text/csv",
            extensions: &["csv", "csv.gz"],
            import: true,
            export: true,
            many: true,
            takes_net: true,
            notes: "A row for each road user, future and step, units in the columns' names, in the source's \
                 frame; tables of others by `--columns`, the map of their place by `--net`. Plain or gzip.",
            loses: write::LOSES,
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        let head = unpack::head(head);
        let first = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let has = |column: &&str| first.windows(column.len()).any(|window| window == column.as_bytes());
        if !is_parquet(&head)
            && OURS.iter().all(has)
            && std::str::from_utf8(first).is_ok()
            && !first.contains(&b'{')
        {
            return 2;
        }
        let name = name.to_ascii_lowercase();
        u8::from(self.info().extensions.iter().any(|end| name.ends_with(&format!(".{end}"))))
    }

    fn takes_columns(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        scenes(file, options, false)
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut file = BoundedFile::new(options.most());
        let named = write::named(scenes, options);
        if options.gzip {
            let mut encoder = GzEncoder::new(&mut file, Compression::default());
            write::csv(&named, options, &mut encoder)?;
            encoder.finish()?;
        } else {
            write::csv(&named, options, &mut file)?;
        }
        let losses: BTreeSet<_> =
            scenes.iter().flat_map(|scene| write::lost(scene, options.motion, false)).collect();
        Ok(Exported { bytes: file.bytes, losses: losses.into_iter().collect() })
    }
}

impl Format for Parquet {
    fn info(&self) -> Info {
        Info {
            id: "parquet",
            name: "Table of motion (Parquet)",
            media_type: "application/vnd.apache.parquet",
            extensions: &["parquet"],
            import: true,
            export: true,
            many: true,
            takes_net: true,
            notes: "A row for each road user, future and step, units in the columns' names, in the source's \
                 frame; tables of others by `--columns`, the map of their place by `--net`. What is said of the scene is in the file.",
            loses: write::LOSES,
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        // Other formats are tables of this sort too; they know their columns.
        if names_in(head, &OURS) { 2 } else { u8::from(is_parquet(head)) }
    }

    fn takes_columns(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        scenes(file, options, true)
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        if scenes.is_empty() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, file_needs("Parquet", what::SCENE)));
        }
        let named = write::named(scenes, options);
        let notes = serde_json::to_string(&Notes::of(&named)).map_err(io::Error::other)?;
        let groups = named.iter().map(|scene| write::columns(scene, options));
        let mut notes = vec![(KEY.to_owned(), notes)];
        let licences: Vec<String> = scenes.iter().filter_map(|scene| scene.licence()).collect();
        let licence = scene::licence::strictest(licences.iter().map(String::as_str));
        notes.extend(licence.map(|licence| ("licence".to_owned(), licence)));
        let bytes = columnar::write(groups, notes)?;
        let losses: BTreeSet<_> =
            scenes.iter().flat_map(|scene| write::lost(scene, options.motion, true)).collect();
        Ok(Exported { bytes, losses: losses.into_iter().collect() })
    }
}
