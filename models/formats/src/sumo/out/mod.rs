//! Writes scenes as files of SUMO: a network, a recording, and a folder of both with the trips of its road
//! users.

pub(super) mod folder;
pub(super) mod net;
mod network;
pub(super) mod recording;
mod trips;
mod words;
mod yields;
