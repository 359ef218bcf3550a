//! What a traffic engineer says of a motion.

mod about;
mod manoeuvre;
mod relations;

pub use about::{About, Fault, FaultKind, Manoeuvre, Reaction, ReactionKind, Relation, RelationKind};
pub use manoeuvre::manoeuvre;
pub use relations::{Trace, relations};
