//! HTTP for every operation: connections, access rules, bodies, headers, the form of replies.

pub mod accept;
pub mod body;
pub mod coding;
pub mod embed;
pub mod extract;
mod frames;
pub mod guard;
pub mod line;
pub mod net;
pub mod observe;
mod owner;
pub mod packed;
mod pause;
mod sign_in;
pub mod upload;
mod wire;
