//! Motion as one long table, a row for each road user, future and step, as notebooks and spreadsheets take it: CSV
//! and Parquet with the same columns, both ways. Positions are those of the scene's source: its origin is added back.

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
/// Read where a table has it, in place of two velocities; never written.
const SPEED: &str = "speed_mps";
/// Read in place of `x_m` and `y_m`, degrees; never written.
const LATITUDE: &str = "lat_deg";
const LONGITUDE: &str = "lon_deg";
/// Read in place of `time_s`: numbers of pictures, and how many there are in a second.
const FRAME: &str = "frame";
const FRAME_RATE: &str = "frame_rate_hz";
/// Where the zero of a recording lies in its zone of UTM, metres, and a place of it that tells the zone, degrees.
const ORIGIN_X: &str = "origin_x_m";
const ORIGIN_Y: &str = "origin_y_m";
const PLACE_LATITUDE: &str = "place_lat_deg";
const PLACE_LONGITUDE: &str = "place_lon_deg";
/// Of the lanes that say none themselves.
const SPEED_LIMIT: &str = "speed_limit_mps";
/// The two words of `source`.
const LOG: &str = "log";
const GENERATED: &str = "generated";
