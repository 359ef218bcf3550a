//! The planning prior: what is known about a road user's futures before any network runs.
//!
//! [`world`] is the scene at one step and [`anchors`] are the paths from there, legal ones first.
//! [`crossing`] covers how walkers cross lanes, and [`profile`] the pace along paths. [`coordinates`] defines
//! a future relative to its anchor, and [`pullback`] converts gradients in the plane to its numbers.

pub mod anchors;
mod around;
pub mod coordinates;
pub mod crossing;
#[cfg(test)]
mod crossing_tests;
mod legal;
pub mod lights;
pub mod profile;
pub mod pullback;
#[cfg(test)]
mod road_tests;
pub mod smooth;
pub mod stop_line;
#[cfg(test)]
mod tests;
mod through;
mod to_goal;
mod way;
pub mod world;

pub use coordinates::{
    ACROSS_SCALE, ALONG_SCALE, Basis, INSTANT_S, INSTANTS, MODES, Modes, PER_INSTANT, RESIDUAL, Residual,
    STAYS_WITHIN_M, hat, integrated_hat, mode_at, twice_integrated_hat,
};
