//! Scenes and maps: saved by the user, shipped as demos, in the data folder, in files.

mod catalog;
mod item;
mod library;
mod opened;
mod preview;
pub mod record;
pub mod store;
pub mod transfer;

pub use catalog::{Catalog, bytes_of, map_bytes, not_found};
pub use item::{Counts, Facts, Item, tags_of};
pub use library::Library;
pub use opened::Standings;
pub use preview::preview;
