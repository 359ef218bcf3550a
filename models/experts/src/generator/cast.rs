//! The agents that act in a window.

use scene::State;
use std::collections::{BTreeMap, BTreeSet};

/// Most agents that get new futures in one call.
pub(super) const MOST_ACTORS: usize = 128;

/// The parts of a window, by index into the scene's agents.
pub(super) struct WindowCast {
    /// Agents that get new futures in any case.
    pub(super) acting: BTreeSet<usize>,
    /// Agents that may react to them.
    pub(super) may_react: BTreeSet<usize>,
    /// Acting agents that were parked when the call began and stay parked.
    pub(super) parked: BTreeSet<usize>,
    /// Motions, from the window's start on, of other agents that reacted in an earlier window.
    pub(super) resumed: BTreeMap<usize, Vec<State>>,
}
