//! The planning prior: what can be said of a road user's futures before any network speaks.
//!
//! [`world`] is the scene at one step, [`anchors`] are the ways on from there (legal ones first), [`crossing`] how walkers
//! cross lanes, [`profile`] the pace along them, [`coordinates`] how a future is written relative to its anchor, and
//! [`pullback`] takes gradients in the plane back to those numbers.

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
