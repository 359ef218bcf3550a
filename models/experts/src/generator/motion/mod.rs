//! Motions as values: what a motion is at each step of a window, and what is known of motions that are kept.

mod kept_motion;
mod sweep;

pub(super) use kept_motion::KeptMotion;
pub(super) use sweep::{Places, Sweep};
