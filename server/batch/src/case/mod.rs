//! What happens in a result: the facts that coverage counts, and its motion for a picture.

pub mod facts;
pub mod layout;
pub mod likeness;
pub mod motion;
