//! Placeholder.

pub mod synthesize;
