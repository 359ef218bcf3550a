//! Foundations of all server modules: ids, the clock, limits, memory, refusals, counters.

pub mod base_path;
pub mod cache;
pub mod clock;
pub mod descriptors;
pub mod folder;
pub mod id;
pub mod limits;
pub mod machine;
pub mod memory;
pub mod metrics;
pub mod netconvert;
pub mod party;
pub mod places;
pub mod problem;
pub mod process;
pub mod rates;
mod status;
