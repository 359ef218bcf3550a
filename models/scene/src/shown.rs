//! A road user as it is shown: with decided data in place of recorded data. Scores, pictures and writers of
//! other formats all use this.

use crate::geometry::direction;
use crate::{Agent, AgentType, Future, Scene, Size, State, Track};
use std::borrow::Cow;

/// A start fixed farther than this from the log does not continue the log, metres: its history belongs to another
/// motion.
const SAME_PLACE_M: f64 = 0.5;

/// Type, box and motion of a road user as they are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown<'a> {
    /// The type that the user set, else its own.
    pub agent_type: AgentType,
    /// Size, with the length and width that the user set.
    pub size: Size,
    /// Motion by scene step.
    pub track: Cow<'a, Track>,
}

impl Agent {
    /// The size with the length and width that the user set.
    pub fn shown_size(&self) -> Size {
        self.conditions.size_of(self.size)
    }

    /// The road user with one of its futures after its history, or with its log for `None`. A fixed start
    /// applies from the step before the future on: without a future, the log does not continue from it.
    pub fn shown(&self, future: Option<&Future>) -> Shown<'_> {
        let track = match future {
            Some(future) => Cow::Owned(joined(self, future)),
            None => Cow::Borrowed(&*self.track),
        };
        Shown { agent_type: self.kind(), size: self.shown_size(), track }
    }
}

impl Scene {
    /// A road user of this scene with its chosen future, if it has one.
    pub fn shown<'a>(&self, agent: &'a Agent) -> Shown<'a> {
        agent.shown(self.generated.as_ref().and_then(|generated| generated.chosen_future(&agent.id)))
    }
}

/// The log up to the step before the future, that step with the fixed start, then the future.
fn joined(agent: &Agent, future: &Future) -> Track {
    let start_step = future.first_step.saturating_sub(1);
    let logged = agent.track.at(start_step).copied();
    let start = start_state(agent, logged);
    let moved = match (logged, start) {
        (Some(logged), Some(start)) => (logged.position() - start.position()).norm() > SAME_PLACE_M,
        _ => agent.conditions.start.position.is_some(),
    };
    let first_step = if moved { start_step } else { agent.track.first_step.min(start_step) };
    let mut states: Vec<Option<State>> =
        (first_step..future.first_step).map(|step| agent.track.at(step).copied()).collect();
    if let Some(slot) = states.last_mut() {
        *slot = start;
    }
    states.extend(future.states.iter().copied().map(Some));
    Track { first_step, states, z_m: None }
}

/// Recorded state with the fixed start fields applied; `None` if neither gives a position.
fn start_state(agent: &Agent, logged: Option<State>) -> Option<State> {
    let start = &agent.conditions.start;
    let mut state = match (logged, start.position) {
        (Some(state), _) => state,
        (None, Some(_)) => State::default(),
        (None, None) => return None,
    };
    if let Some(p) = start.position {
        (state.x_m, state.y_m) = (p.x, p.y);
    }
    if start.heading_rad.is_some() || start.speed_mps.is_some() {
        let speed = start.speed_mps.unwrap_or(state.speed_mps());
        state.heading_rad = start.heading_rad.unwrap_or(state.heading_rad);
        let velocity = direction(state.heading_rad) * speed;
        (state.vx_mps, state.vy_mps) = (velocity.x, velocity.y);
    }
    Some(state)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Conditions, Start, Subtype, Vec2};

    fn driver(start: Start) -> Agent {
        let at = |i: usize| Some(State { x_m: i as f64, vx_mps: 10.0, ..State::default() });
        let mut agent = Agent::bare("a", AgentType::Vehicle, Subtype::Car, (0..91).map(at).collect());
        agent.conditions = Conditions { start, length_m: Some(12.0), ..Conditions::default() };
        agent
    }

    fn future() -> Future {
        let at = |i: usize| State { x_m: -30.0 + 0.5 * i as f64, vx_mps: 5.0, ..State::default() };
        Future::bare(1.0, 11, (1..=90).map(at).collect())
    }

    #[test]
    fn a_start_far_from_the_log_has_no_history() {
        let position = Some(Vec2::new(-30.0, 2.0));
        let agent = driver(Start { position, speed_mps: Some(5.0), ..Start::default() });
        let future = future();
        let shown = agent.shown(Some(&future));
        assert_eq!(shown.size.length_m, 12.0);
        assert_eq!((shown.track.first_step, shown.track.states.len()), (10, 91));
        let start = shown.track.at(10).unwrap();
        assert_eq!((start.x_m, start.y_m, start.vx_mps), (-30.0, 2.0, 5.0));
        // Without a future the start has no continuation: the log stays, but the size is applied.
        let kept = agent.shown(None);
        assert_eq!((kept.size.length_m, &*kept.track), (12.0, &*agent.track));
    }

    #[test]
    fn a_start_on_the_log_keeps_its_history() {
        let agent = driver(Start { speed_mps: Some(3.0), ..Start::default() });
        let future = future();
        let track = agent.shown(Some(&future)).track;
        assert_eq!((track.first_step, track.states.len()), (0, 101));
        assert_eq!((track.at(9).unwrap().vx_mps, track.at(10).unwrap().vx_mps), (10.0, 3.0));
    }
}
