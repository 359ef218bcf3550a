//! Motion as one long table, a row for each road user, future and step, as notebooks and spreadsheets take it: CSV
//! and Parquet with the same columns, both ways. Positions are those of the scene's source: its origin is added back.

mod columns;
mod format;
mod import;
mod notes;
mod rows;
mod write;

pub use columns::{PRESETS, preset};
pub use format::{Csv, Parquet};
pub use write::cell;

/// Columns of a row, in order; units are in their names. `sample`, `mode` and `probability` are set only for
/// futures. `source` is `log` or `generated`, `valid` is false if the road user was not seen, and `chosen` is
/// true for the shown motion.
pub const COLUMNS: [&str; 21] = [
    "scenario_id",
    "agent_id",
    "type",
    "subtype",
    "sample",
    "mode",
    "probability",
    "step",
    "time_s",
    "x_m",
    "y_m",
    "z_m",
    "heading_rad",
    "vx_mps",
    "vy_mps",
    "length_m",
    "width_m",
    "valid",
    "source",
    "height_m",
    "chosen",
];
/// Read where a table has it, in place of two velocities; never written.
const SPEED: &str = "speed_mps";
/// Read in place of `x_m` and `y_m`, degrees; never written.
const LATITUDE: &str = "lat_deg";
const LONGITUDE: &str = "lon_deg";
/// The two words of `source`.
const LOG: &str = "log";
const GENERATED: &str = "generated";
