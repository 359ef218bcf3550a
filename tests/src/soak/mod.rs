//! Trials without an end of their own: the real program under load, kills and failing disks, held against what it
//! answered. Each runs for as long as it is told; the tests run a little of each.

pub mod clients;
pub mod faults;
mod fit;
pub mod kills;
pub mod schedule;

/// Where a trial says how far it is.
pub type Tell<'a> = &'a (dyn Fn(&str) + Sync);
