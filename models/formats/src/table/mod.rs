//! Motion as one long table, with a row for each road user, future and step, for notebooks and spreadsheets:
//! CSV and Parquet with the same columns, for import and export. Positions are those of the scene's source:
//! its origin is added back.

mod columns;
mod companions;
mod format;
mod gathered;
mod groups;
mod import;
mod names;
mod notes;
mod recordings;
mod rows;
mod write;

pub use columns::{PRESETS, preset};
pub use format::TableFormat;
pub use groups::{beside, firsts, followers, is_map};
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
/// Accepted instead of two velocities; never written.
const SPEED: &str = "speed_mps";
/// Accepted instead of `x_m` and `y_m`, degrees; never written.
const LATITUDE: &str = "lat_deg";
const LONGITUDE: &str = "lon_deg";
/// Accepted instead of `time_s`: frame numbers, and frames per second.
const FRAME: &str = "frame";
const FRAME_RATE: &str = "frame_rate_hz";
/// Origin of a recording in its UTM zone, metres, and a position that identifies the zone, degrees.
const ORIGIN_X: &str = "origin_x_m";
const ORIGIN_Y: &str = "origin_y_m";
const PLACE_LATITUDE: &str = "place_lat_deg";
const PLACE_LONGITUDE: &str = "place_lon_deg";
/// Speed limit of the lanes without their own.
const SPEED_LIMIT: &str = "speed_limit_mps";
/// The two words of `source`.
const LOG: &str = "log";
const GENERATED: &str = "generated";
