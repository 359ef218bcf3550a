//! Extracts of OpenStreetMap, as they are saved from its website. They say where roads run and little of lanes
//! and junctions; SUMO's netconvert knows how to make a network of them, and that is read as any other.

mod driving_side;
pub(crate) mod extract;
pub(crate) mod format;
