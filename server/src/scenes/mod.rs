//! Scenes and maps: saved by the user, shipped as demos, in the data folder, in files.

mod catalog;
pub mod demos;
mod folder;
mod item;
pub mod length;
mod library;
mod preview;
pub mod record;
pub mod store;
pub mod weight;

pub use catalog::Catalog;
pub use item::{Counts, Facts, SceneItem, tags_of};
pub use library::Library;
pub use preview::preview;
