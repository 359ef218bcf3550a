//! Argoverse 2 motion forecasting: a scenario as Parquet, a row for each track and step, and the map of its place as
//! JSON. Names of columns and members are those of its public API (`av2.datasets.motion_forecasting`,
//! `av2.map.map_api`).

mod export;
mod format;
mod import;
mod map;

pub use format::Argoverse;

/// Licence of the data set.
const LICENCE: &str = "cc-by-nc-sa-4.0";
/// Id of the recording vehicle.
const AV: &str = "AV";
/// Categories of tracks: fragment, unscored, scored, and focal.
const FRAGMENT: i64 = 0;
const UNSCORED: i64 = 1;
const SCORED: i64 = 2;
const FOCAL: i64 = 3;
/// Prefix of the tag that names a scene's city.
const CITY: &str = "city:";
/// Key of the note in our own files.
const NOTE: &str = "dragtraffic";
