//! Training of one expert: records, losses of the three stages, optimiser, checkpoints.
//!
//! ```text
//! Records -> Split -> batch of a step -> shards on threads -> gradients -> AdamW -> weights, checkpoint
//! ```
//!
//! A run is a function of its records, options and seed. Every draw comes from a stream keyed by seed and
//! step, and sums are taken in a fixed order. On a graphics card the same holds except for the last bits.

mod checkpoint;
pub mod dataset;
mod error;
mod fit;
mod log;
mod loss;
mod metrics;
mod obstacles;
mod optim;
mod processor;
mod route;
mod run;
mod sample;
mod stages;
mod trainee;
mod workers;

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) mod toy;

pub use dataset::{AnchorPath, BOXES, LoggedBox, PATH_POINTS, Record, RecordWriter, Records};
pub use error::TrainError;
pub use fit::FitError;
pub use metrics::Metrics;
pub use processor::Processor;
pub use run::{EVERYBODY, TrainOptions, TrainProgress, best_path, checkpoint_path, run, steps_of};
pub use sample::{is_for_tests, is_held_out};
pub use stages::Stage;

pub(crate) use loss::{index, least, softmax};
pub(crate) use route::DraftPoses;
pub(crate) use run::run_of;
pub(crate) use sample::Shard;
pub(crate) use stages::{Tools, seeded};
pub(crate) use trainee::Trainee;
