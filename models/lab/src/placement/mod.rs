//! Placement: learned from recorded traffic, and judged against it.

mod distance;
mod eval;
mod fit;
mod table;

pub use eval::{Options as EvalOptions, Report, eval};
pub use fit::{Options, Summary, run};
pub use table::markdown;
