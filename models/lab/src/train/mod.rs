//! Training of one expert: records, losses of the three stages, optimiser, checkpoints.

mod codec;
pub mod dataset;
mod error;
#[cfg(test)]
pub(crate) mod toy;

pub use dataset::{AnchorPath, BOXES, LoggedBox, PATH_POINTS, Record, Records, Writer};
pub use error::TrainError;
