//! Files to and from scenes.
//!
//! [`native`] is the program's own JSON; [`womd`] is the Waymo Open Motion Dataset's Scenario
//! record; [`sumo`] reads what the traffic simulator writes: networks and recordings; [`table`]
//! writes motion for notebooks. No format knows another. Readers are
//! bounded in time and memory, never follow references, never panic, and say where a fault lies.

pub mod checks;
pub mod files;
pub mod format;
pub mod identities;
pub mod limits;
pub mod loss;
pub mod native;
pub mod problem;
pub mod registry;
pub mod sumo;
pub mod table;
pub mod womd;

pub use format::{ExportOptions, Exported, ExportedMotion, Format, ImportOptions, NET_POINTER};
pub use loss::Loss;
pub use problem::{FieldProblem, Imported, Kind, ReadError, Warning, never_null, pointer_token};
