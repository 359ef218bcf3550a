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
    /// The cause of its change, where it had a motion before.
    pub(super) reaction: Option<Reaction>,
    /// The agent before which it stops and misses its goal.
    pub(super) blocked_by: Option<AgentId>,
    /// The reactions of the others if one of `alternatives` is taken in place of the shown one, one entry each: `None`
    /// where they stay the same. Empty where the window does not look.
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

    /// The actor stays where it is.
    pub(super) fn rests(&self) -> bool {
        self.shown().origin == CandidateOrigin::Rest
    }
}

/// The decisions of a window.
pub(super) struct Decisions {
    /// Of the actors. An actor that goes on with a given motion is left out.
    pub(super) actors: Vec<Decided>,
    /// Of the agents that change their motion because of the actors. An agent that keeps it is left out.
    pub(super) reacted: Vec<Reacted>,
}
