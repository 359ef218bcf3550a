//! The agents that do not act in a window, and what they do about the agents that do.
//!
//! The motion that such an agent has is its first option. It keeps that motion unless it would meet a changed one: that
//! of an agent that the call regenerates, or of one that changed because of it. An agent whose kept motion meets none of
//! them stays as it is to the last byte. The others drive their own path at another pace ([`giving_way`]), one after
//! the other ([`chain`]).

mod blocks;
mod chain;
mod giving_way;
mod other;
mod path_progress;
mod reaction;
mod replanned;
mod yielding;

pub(super) use chain::{ChangedMotion, Reacted, caused};
pub(super) use other::Others;
pub(super) use path_progress::extend_along_road;
pub(super) use reaction::reaction_of;
pub(super) use replanned::replanned;
