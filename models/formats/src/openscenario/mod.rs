//! ASAM OpenSCENARIO XML: what simulators for automated driving play.
//!
//! Road users follow their motion to the tenth of a second; nothing is guessed of manoeuvres. The map goes beside it
//! as OpenDRIVE.

pub(crate) mod format;
mod read;
mod scenario;
mod signals;
