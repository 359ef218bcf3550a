//! HTTP for every operation: connections, access rules, bodies, headers and formats of replies.

pub mod accept;
pub mod access;
pub mod audit;
pub mod below;
pub mod body;
pub mod coding;
pub mod embed;
pub mod events;
pub mod extract;
mod frames;
pub mod guard;
pub mod idempotency;
pub mod line;
pub mod long_replies;
pub mod net;
pub mod observe;
mod owner;
pub mod packed;
mod pause;
pub mod proxies;
mod sign_in;
pub mod stream;
pub mod tokens;
pub mod upload;
mod wire;
