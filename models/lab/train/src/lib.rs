//! How experts are made and judged: synthetic traffic, training records, training, placement,
//! evaluation.

pub mod baselines;
pub mod crop;
pub mod eval;
pub mod mirror;
pub mod placement;
pub mod polylines;
pub mod prepare;
pub mod statistics;
pub mod synthesize;
pub mod train;
