//! nuPlan as an import format.

use super::database::{Database, MAGIC};
use super::log::SWEEPS;
use super::map::{CityMap, PATHS};
use super::recording::{LICENCE, NuPlan};
use crate::around::{Around, Chosen};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one, only, only_read};
use crate::map_file::{self, MapRead};
use crate::problem::{FieldProblem, Imported, ReadError, code};
use crate::refusals::what;
use crate::source::Source;
use scene::{Origin, Scene, Vec2};
use std::io;

/// A log with or without the map of its city; a map alone gives a scene without road users.
pub(crate) struct NuPlanLog;

impl Format for NuPlanLog {
    fn info(&self) -> Info {
        Info {
            id: "nuplan",
            name: "nuPlan log (SQLite) with its map (GeoPackage)",
            media_type: "application/vnd.sqlite3",
            extensions: &["nuplan.db", "db", "gpkg"],
            import: true,
            export: false,
            many: true,
            takes_net: true,
            notes: "Each scene of a log: road users as the lidar saw them, the ego, and signals by \
                 connector. `--net map.gpkg` adds lanes with links and limits, crossings, boundaries, \
                 stop signs and ground within 100 m. Parts of a map are read alone. 20 Hz is resampled; \
                 situation types are tags. Written after the published schema, not tested on files of the \
                 data set.",
            loses: &[],
        }
    }

    fn sniff(&self, head: &[u8], _: &str) -> u8 {
        let holds = |name: &str| head.windows(name.len()).any(|part| part == name.as_bytes());
        if head.starts_with(MAGIC) && (holds(SWEEPS) || holds(PATHS)) { 2 } else { 0 }
    }

    fn takes_around(&self) -> bool {
        true
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        let database = match Database::open(file) {
            Ok(database) => database,
            Err(error) => return one(Err(error)),
        };
        if database.has(PATHS) && !database.has(SWEEPS) {
            return only(options, move || {
                let read = place(&database, options);
                read.map_err(|error| map_file::with_advice(error, options.around))
            });
        }
        match NuPlan::read(&database, options) {
            Ok(log) => Box::new(log.scenes().skip(options.skip).take(options.max_scenes)),
            Err(error) => one(Err(error)),
        }
    }

    fn export(&self, _: &[&Scene], _: &ExportOptions) -> io::Result<Exported> {
        Err(only_read(&self.info()))
    }
}

/// Reads a map without a log.
fn place(database: &Database, options: &ImportOptions) -> Result<Imported, ReadError> {
    let city = CityMap::read(database, None)?;
    let around = options.around.map(|around| {
        // Degrees are not a position in metres of a zone.
        let degrees = around.x.abs() <= 180.0 && around.y.abs() <= 90.0;
        let at = if degrees { city.zone.metres(around.y, around.x) } else { Vec2::new(around.x, around.y) };
        Around { x: at.x, y: at.y, ..around }
    });
    let chosen = Chosen::of(around);
    let (middle, size) = city.extent().map(|all| (all.middle(), all.size())).unwrap_or_default();
    let half = size / 2.0;
    if !chosen.is_part() && map_file::is_too_wide(half) {
        return Err(ReadError::map_too_large(map_file::extent(half)));
    }
    let origin = chosen.origin().unwrap_or_else(|| middle.map(f64::round));
    let part = city.part(origin, chosen);
    if let (true, Some(message)) = (part.map.lanes.is_empty(), part.chosen.nothing()) {
        return Err(FieldProblem::new("", code::CANNOT_REPRESENT, message).into());
    }
    let licence = options.licence.clone().unwrap_or_else(|| LICENCE.to_owned());
    let origin_said =
        Origin { x_m: origin.x, y_m: origin.y, crs: Some(city.zone.name()), ..Origin::default() };
    MapRead {
        name: String::new(),
        map: part.map.into(),
        signals: Vec::new(),
        origin: origin_said,
        warnings: part.warnings,
        part: part.chosen.part(origin, what::LANES),
    }
    .scene("nuplan", Some(licence))
}
