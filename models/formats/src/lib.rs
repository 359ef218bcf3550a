//! Placeholder.
pub mod sumo;
