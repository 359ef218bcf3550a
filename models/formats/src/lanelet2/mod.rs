//! Lanelet2 maps: sections of lane between two lines, in the XML of OpenStreetMap.

pub(crate) mod format;
mod import;
mod lanelets;
mod osm;
