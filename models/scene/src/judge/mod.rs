//! What a traffic engineer says of a motion.

mod about;

pub use about::{About, Fault, FaultKind, Manoeuvre, Reaction, ReactionKind, Relation, RelationKind};
