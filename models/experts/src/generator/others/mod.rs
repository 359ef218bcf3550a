//! The agents that do not act in a window, and how they react to the agents that do.
//!
//! Such an agent first tries its own motion. It keeps that motion unless it would meet a changed one, or would
//! follow one too closely. Changed are regenerated agents, and agents that changed because of them. An agent
//! whose kept motion is in conflict with neither keeps it bit for bit. The others keep their path and change
//! their timing ([`giving_way`]), one after the other ([`chain`]).

mod blocks;
mod chain;
mod following;
mod giving_way;
mod other;
mod path_progress;
mod reaction;
mod replanned;
mod yielding;

pub(super) use chain::{ChangedMotion, Reacted, caused};
pub(super) use following::Following;
pub(super) use other::Others;
pub(crate) use path_progress::{extend_along_road, state_between};
pub use reaction::WAITS_STEPS;
pub(super) use reaction::reaction_of;
pub(super) use replanned::replanned;
