//! Events of generations, and the reply made of them.

pub mod events;
pub mod scoring;
pub mod stream;
