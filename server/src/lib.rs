//! DragTraffic: the editor, its HTTP API and the same operations on the command line, in one program.
//!
//! The program calls [`run`]; so does the Python package, whose wheel includes the command.

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
