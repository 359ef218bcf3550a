//! nuPlan: a log as a database of SQLite, and the map of its city as a GeoPackage.
//!
//! Written after the published schema of the logs and the names that the map's public API uses; no file of the data
//! set itself was at hand.

mod database;
pub(crate) mod format;
mod geometry;
mod log;
mod map;
mod recording;
