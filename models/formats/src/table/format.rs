//! Tables as import and export formats.

use super::{recordings, write};
use crate::columnar::{self, is_parquet, names_in};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, MapFiles, Scenes};
use crate::problem::ReadError;
use crate::refusals::{file_needs, what};
use crate::source::Source;
use crate::table::notes::{KEY, Notes};
use crate::unpack::{self, ZIP};
use crate::written::BoundedFile;
use flate2::Compression;
use flate2::write::GzEncoder;
use scene::Scene;
use std::collections::BTreeSet;
use std::io;

/// Columns by which a table of this program is recognised.
const OURS: [&str; 3] = ["agent_id", "x_m", "y_m"];

/// File name endings in zips of tables, and in those of other formats, which may also contain tables.
const TABLE_ENDS: [&[u8]; 2] = [b".csv", b".csv.gz"];
const OTHER_ENDS: [&[u8]; 3] = [b".xosc", b".sumocfg", b".rou.xml"];

/// Whether a zip with this beginning and end contains tables, and none of the files of other formats. Its
/// list contains names as plain text.
fn is_zip_of_tables(head: &[u8]) -> bool {
    let holds = |end: &[u8]| head.windows(end.len()).any(|part| part.eq_ignore_ascii_case(end));
    TABLE_ENDS.into_iter().any(holds) && !OTHER_ENDS.into_iter().any(holds)
}

/// Tables of motion.
pub enum TableFormat {
    /// Comma-separated values, plain or gzip.
    Csv,
    /// The same columns with their types, compressed with zstd, and with frame, licence and time as metadata.
    Parquet,
}

impl Format for TableFormat {
    fn info(&self) -> Info {
        match self {
            Self::Csv => Info {
                id: "csv",
                name: "Table of motion (CSV)",
                media_type: "text/csv",
                extensions: &["csv", "csv.gz", "csv.zip"],
                import: true,
                export: true,
                many: true,
                takes_net: true,
                notes: "A row for each road user, future and step, with units in the column names, in the \
                     source's frame. `--columns` reads other tables, `--net` adds the map of their place. \
                     Plain or gzip. Recordings of several tables, with their maps, are read from a folder \
                     or a zip.",
                loses: write::LOSES,
            },
            Self::Parquet => Info {
                id: "parquet",
                name: "Table of motion (Parquet)",
                media_type: "application/vnd.apache.parquet",
                extensions: &["parquet"],
                import: true,
                export: true,
                many: true,
                takes_net: true,
                notes: "A row for each road user, future and step, with units in the column names, in the \
                     source's frame. `--columns` reads other tables, `--net` adds the map of their place. \
                     Attributes of the scene are in the file.",
                loses: write::LOSES,
            },
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        match self {
            Self::Csv => sniff_csv(head, name, self.info().extensions),
            // Other formats are Parquet too; their readers know their columns.
            Self::Parquet => {
                if names_in(head, &OURS) {
                    2
                } else {
                    u8::from(is_parquet(head))
                }
            }
        }
    }

    fn takes_columns(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        recordings::scenes(file, options, matches!(self, Self::Parquet))
    }

    fn maps<'a>(&self, file: &'a dyn Source, options: &'a ImportOptions) -> Result<MapFiles<'a>, ReadError> {
        recordings::maps(file, options)
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let named = write::named(scenes, options);
        let typed = matches!(self, Self::Parquet);
        let bytes = if typed { to_parquet(scenes, &named, options)? } else { to_csv(&named, options)? };
        let lost = scenes.iter().flat_map(|scene| write::lost(scene, options.motion, typed));
        let losses: BTreeSet<_> = lost.collect();
        Ok(Exported { bytes, losses: losses.into_iter().collect() })
    }
}

/// Confidence that a file with this beginning, and a name with one of these endings, is a table in CSV.
fn sniff_csv(head: &[u8], name: &str, extensions: &[&str]) -> u8 {
    if head.starts_with(ZIP) {
        return if is_zip_of_tables(head) { 2 } else { 0 };
    }
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
    u8::from(extensions.iter().any(|end| name.ends_with(&format!(".{end}"))))
}

fn to_csv(named: &[(&Scene, String)], options: &ExportOptions) -> io::Result<Vec<u8>> {
    let mut file = BoundedFile::new(options.bounds());
    if options.gzip {
        let mut encoder = GzEncoder::new(&mut file, Compression::default());
        write::csv(named, options, &mut encoder)?;
        encoder.finish()?;
    } else {
        write::csv(named, options, &mut file)?;
    }
    file.whole()
}

fn to_parquet(scenes: &[&Scene], named: &[(&Scene, String)], options: &ExportOptions) -> io::Result<Vec<u8>> {
    if scenes.is_empty() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, file_needs("Parquet", what::SCENE)));
    }
    let notes = serde_json::to_string(&Notes::of(named)).map_err(io::Error::other)?;
    let groups = named.iter().map(|scene| write::columns(scene, options));
    let mut notes = vec![(KEY.to_owned(), notes)];
    let licences: Vec<String> = scenes.iter().filter_map(|scene| scene.licence()).collect();
    let licence = scene::licence::strictest(licences.iter().map(String::as_str));
    notes.extend(licence.map(|licence| ("licence".to_owned(), licence)));
    columnar::write(groups, notes)
}
