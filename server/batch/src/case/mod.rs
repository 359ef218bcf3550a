//! Facts of a result for coverage, and its motion for a picture.

pub mod facts;
pub mod layout;
pub mod likeness;
pub mod motion;
