//! Extracts of OpenStreetMap, as its website exports them. They contain roads, but little about lanes and
//! junctions. SUMO's netconvert makes a network of them, which is read like any other.

mod driving_side;
pub(crate) mod extract;
pub(crate) mod format;
mod pavements;
