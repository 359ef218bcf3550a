//! ASAM OpenSCENARIO XML, the format of simulators for automated driving.
//!
//! Road users follow their motion exactly, at each tenth of a second; no manoeuvres are guessed. The map is a
//! separate OpenDRIVE file.

pub(crate) mod format;
mod read;
mod scenario;
mod signals;
