//! Shared parts of the end-to-end tests: the real program, a plain HTTP client, small scenes.

pub mod contract;
#[cfg(target_os = "linux")]
pub mod faults;
pub mod http;
pub mod markdown;
pub mod mutation;
#[cfg(target_os = "linux")]
pub mod power;
pub mod program;
pub mod random;
pub mod requests;
pub mod rooms;
pub mod scenes;
#[cfg(target_os = "linux")]
pub mod soak;
pub mod untuned;
pub mod writers;

pub use http::{Reply, Request};
pub use program::Server;
