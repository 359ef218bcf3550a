//! Judging the experts on scenes: ten tables of figures with intervals, and pictures.
//!
//! [`run`] makes everything that `dragtraffic lab eval` writes. A table is a module; they share the cases, the
//! metrics ([`measure`]), the rivals of the experts ([`rivals`]) and the bootstrap ([`stats`]). The same scenes,
//! weights and seed give the same bytes, except for the times of tables 6 and 8, which are in separate files.
//!
//! ```
//! use lab_eval::stats::{Bootstrap, Value};
//!
//! // Errors of three road users in two scenes, metres: the interval comes from resampled scenes.
//! let errors = [(0, 1.0), (0, 3.0), (1, 5.0)].map(|(scene, metres)| Value::new(scene, metres));
//! let mean = Bootstrap::new(2, 0).estimate(errors).unwrap();
//! assert_eq!((mean.mean, mean.samples, mean.scenes), (3.0, 3, 2));
//! assert!(mean.low <= mean.mean && mean.mean <= mean.high);
//! ```

mod ablation;
mod cases;
mod coherence;
mod control;
pub mod cost;
mod feedback;
pub mod filled;
mod goal_ways;
pub mod measure;
mod parked;
pub mod picture;
pub mod placement;
pub mod quality;
mod realism;
mod refining;
mod report;
pub mod rivals;
mod roads;
mod run;
pub mod sheet;
pub mod stats;
mod table;
mod tables;
pub mod together;
mod trust;
mod variety;

pub use cases::{Case, Site, Subset, cases};
pub use quality::type_name;
pub use report::{CropReport, EvalReport, TABLES_FILE};
pub use run::{EvalOptions, run};
pub use table::TableSpec;
pub use tables::TABLES;

use experts::Generator;
use lab_train::baselines::Baseline;

/// Weights to evaluate.
pub struct Judged {
    /// Name in tables.
    pub name: String,
    /// The experts.
    pub generator: Generator,
}

/// The experts and the trained baselines.
#[derive(Clone, Copy)]
pub struct Entrants<'a> {
    /// The experts.
    pub judged: &'a [Judged],
    /// Their learned rivals.
    pub baselines: &'a [Baseline],
}
