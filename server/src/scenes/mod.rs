//! Scenes and maps, wherever they are.

pub mod catalog;
pub mod library;
pub mod store;
pub mod transfer;
