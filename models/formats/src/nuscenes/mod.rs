//! nuScenes: tables of annotations, and its map expansion, as one zip.
//!
//! Written after the published schema of the tables and of the map expansion; no file of the data set itself was at
//! hand.

mod arcs;
pub(crate) mod format;
mod map;
mod recording;
mod tables;
