//! nuScenes: tables of annotations, and its map expansion, as one zip.
//!
//! Implements the published schema of the tables and of the map expansion; it has not been tested with a file of
//! the data set itself.

mod arcs;
pub(crate) mod format;
mod map;
mod recording;
mod tables;
