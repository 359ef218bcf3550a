//! What every room stands on.

pub mod clock;
pub mod limits;
pub mod metrics;
pub mod problem;
