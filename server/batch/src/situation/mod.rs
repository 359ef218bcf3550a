//! What happens in the scenes of a plan: a template with parameters, or conditions of single road users.

mod check;
mod document;
mod ranges;

pub use document::{BatchSituation, Dimension, MOST_CONDITIONS};
pub(crate) use ranges::schema_range;
