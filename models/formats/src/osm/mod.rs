//! Extracts of OpenStreetMap, as they are saved from its website. They hold roads, but little about lanes and
//! junctions; SUMO's netconvert makes a network of them, which is read as any other.

mod driving_side;
pub(crate) mod extract;
pub(crate) mod format;
mod pavements;
