//! DragTraffic: the editor, its HTTP API and the same work on the command line, in one program.
//!
//! The program calls [`run`]; so does the Python package, which has the command in its wheel.

mod app;
mod cli;
mod generation;
mod grpc;
mod http;
mod picture;
mod routes;
mod runs;
mod scenes;

pub use base::folder::{beside, recordings};
pub use base::netconvert::companions;
pub use cli::run;
