//! The decisions of a window.

use super::candidates::{CandidateOrigin, MotionCandidate};
use super::others::Reacted;
use super::trajectory::Rollout;
use scene::AgentId;
use scene::judge::Reaction;

/// The decision of a window for one actor.
pub(super) struct Decided {
    /// Index into the scene's agents.
    pub(super) agent: usize,
    /// Index into the window's actors.
    pub(super) actor: usize,
    /// Index into `alternatives`.
    pub(super) chosen: usize,
    /// At most as many as the request asks for; never empty.
    pub(super) alternatives: Vec<MotionCandidate>,
    /// Why it changed its motion, if it had one before.
    pub(super) reaction: Option<Reaction>,
    /// The agent in front of which it stops, so that it misses its goal.
    pub(super) blocked_by: Option<AgentId>,
    /// Reactions of the others to each of `alternatives` if it replaced the shown one; `None` where they do
    /// not differ. Empty if the window does not compute them.
    pub(super) reactions: Vec<Option<Vec<Reacted>>>,
}

impl Decided {
    /// The candidate that is shown.
    pub(super) fn shown(&self) -> &MotionCandidate {
        &self.alternatives[self.chosen]
    }

    /// The motion that is shown.
    pub(super) fn motion(&self) -> &Rollout {
        &self.shown().motion
    }

    /// Whether the actor stays where it is.
    pub(super) fn rests(&self) -> bool {
        self.shown().origin == CandidateOrigin::Rest
    }
}

/// The decisions of a window.
pub(super) struct Decisions {
    /// Decisions of the actors; an actor that keeps a given motion is left out.
    pub(super) actors: Vec<Decided>,
    /// Agents that change their motion because of the actors; an agent that keeps its motion is left out.
    pub(super) reacted: Vec<Reacted>,
}
