//! What the end-to-end tests share: the real program, a plain HTTP client, small scenes.

pub mod contract;
pub mod http;
pub mod mutation;
pub mod program;
pub mod requests;
pub mod rooms;
pub mod scenes;

pub use http::{Reply, Request};
pub use program::Server;
