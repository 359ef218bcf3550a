//! The operations of DragTraffic as plain functions over an engine and values: open, import, place, map,
//! generate, feedback, score, export, info.
//!
//! This crate has the typed requests, replies, events and problems, with their JSON form, ranges, limits and
//! defaults. It has no HTTP, store, thread, clock or file. A transport (HTTP, WebSocket, the command line)
//! parses a request, passes the source of its scenes ([`home::Home`]) and a clock, and sends the reply. A
//! transport adds no defaults of its own.
//!
//! The weights are built into the program:
//!
//! ```
//! use api::{GenerateRequest, Operations, Subject};
//! use experts::Engine;
//! use scene::{LaneMap, Scene};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let operations = Operations::new(Engine::built_in()?);
//! let subject = Subject::passing(Scene::bare("empty", LaneMap::default(), Vec::new()));
//! let answer = operations.generate(&GenerateRequest::default(), &subject, Default::default());
//! let answered = answer.and_then(|generation| generation.answer()).map_err(|problem| problem.detail)?;
//! assert_eq!(answered.samples.len(), 1);
//! # Ok(())
//! # }
//! ```

pub mod code;
pub mod compact;
pub mod domain;
pub mod english;
pub mod events;
pub mod export;
pub mod feedback;
pub mod generate;
pub mod home;
pub mod import;
pub mod info;
pub mod limits;
pub mod map;
pub mod messages;
mod opened;
mod operations;
pub mod place;
pub mod problem;
pub mod runs;
pub mod score;

pub use code::Code;
pub use generate::GenerateRequest;
pub use home::{AboutScene, Home, SceneRef, Subject};
pub use opened::{Opened, Standings};
pub use operations::Operations;
pub use problem::Problem;
