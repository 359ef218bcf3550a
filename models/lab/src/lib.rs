//! How experts are made and judged: synthetic traffic, training records, training, evaluation.

pub mod eval;
pub mod prepare;
pub mod statistics;
pub mod synthesize;
pub mod train;
