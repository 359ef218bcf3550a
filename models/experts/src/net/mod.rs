//! The networks: arrays of `features` in, residuals and probabilities out.

mod error;

pub use error::NetError;
