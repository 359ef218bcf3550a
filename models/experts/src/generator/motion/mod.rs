//! Motions as values: a motion at each step of a window, and what is known of kept motions.

mod kept_motion;
mod sweep;

pub(super) use kept_motion::KeptMotion;
pub(super) use sweep::{Places, Sweep};
