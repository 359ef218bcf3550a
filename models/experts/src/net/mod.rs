//! The networks: arrays of `features` in, residuals and probabilities out.
//!
//! ```text
//! AgentFeatures -> ContextEncoder -> Context -> Initializer -> six first futures
//!                                                       -> Refiner, five steps -> six better ones
//! ```
//!
//! Each call runs on the calling thread. The environment variables `CANDLE_NUM_THREADS` and
//! `RAYON_NUM_THREADS` should be 1, and callers split the work over threads.

mod architecture;
mod encoder;
mod error;
mod expert;
mod initializer;
pub mod inputs;
pub mod layers;
pub mod ops;
mod params;
mod refiner;
pub mod schedule;
pub mod smooth;

pub use architecture::{Architecture, TOKENS};
pub use encoder::{Context, ContextEncoder, Gating};
pub use error::NetError;
pub use expert::{Card, Expert, InitialOutput, on_cpu};
pub use initializer::{Initial, Initializer};
pub use params::{Init, Params};
pub use refiner::{DraftInputs, Prepared, Refiner};

#[cfg(test)]
mod tests;
