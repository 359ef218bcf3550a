//! The operations of DragTraffic as plain functions over an engine and values: open, import, place, map, generate,
//! feedback, score, export, info.
//!
//! Here are the typed requests, replies, events and problems with their JSON form, their ranges, limits and defaults.
//! There is no HTTP here, no store, thread, clock or file: a carrier (HTTP, an open line, the command line) parses a
//! request, hands in where its scenes are ([`home::Home`]) and what the time is, and sends the reply. A carrier adds no
//! default of its own.
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
