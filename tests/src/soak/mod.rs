//! Open-ended trials: the real program under load, kills and failing disks, compared with its replies. Each
//! trial runs for a given time; the tests run short ones.

pub mod attacks;
pub mod clients;
pub mod faults;
mod fit;
pub mod goodput;
pub mod kills;
pub mod live;
pub mod power;
pub mod schedule;

/// Callback for progress messages.
pub type Tell<'a> = &'a (dyn Fn(&str) + Sync);
