//! The motion that an agent has without this call.

use crate::planning::world::{AgentAtStart, World};
use crate::tuning::fixed::kept_motion::SAME_M;
use scene::{Agent, Conditions, Future, HORIZON_STEPS, STANDING_MPS, STEP_S, Scene, Start, State};

/// The chosen future of an agent, else its recording. An agent whose future has ended, or that has only one
/// known state, continues straight on.
pub(in crate::generator) struct KeptMotion<'a> {
    agent: &'a Agent,
    future: Option<&'a Future>,
    start_step: usize,
    /// Step and state, if only one state is known.
    single: Option<(usize, State)>,
}

impl<'a> KeptMotion<'a> {
    /// The kept motion of an agent in a window that starts at a scene step.
    pub(in crate::generator) fn of(scene: &'a Scene, agent: &'a Agent, start_step: usize) -> Self {
        let future = scene.generated.as_ref().and_then(|generated| generated.chosen_future(&agent.id));
        let mut known = agent.track.valid_steps();
        let single = match (known.next(), known.next()) {
            (Some(first), None) => agent.state_at(first).map(|state| (first, state)),
            _ => None,
        };
        Self { agent, future, start_step, single }
    }

    /// State at a step of the window; 0 is the start.
    pub(in crate::generator) fn at(&self, step: usize) -> Option<State> {
        let at = self.start_step + step;
        if let Some(future) = self.future
            && let Some(i) = at.checked_sub(future.first_step)
            && let Some(last) = future.states.last()
        {
            let since = (i + 1).saturating_sub(future.states.len());
            return Some(future.states.get(i).copied().unwrap_or_else(|| straight_on(last, since)));
        }
        if let Some(state) = self.agent.state_at(at) {
            return Some(state);
        }
        let (first, state) = self.single?;
        Some(straight_on(&state, at.saturating_sub(first)))
    }

    /// Whether only one state is known, so that the motion after it is a guess.
    pub(in crate::generator) fn is_guessed(&self) -> bool {
        self.future.is_none() && self.single.is_some()
    }

    /// Whether the motion continues from where an agent with these conditions starts.
    pub(in crate::generator) fn begins_at(&self, start: &State, conditions: &Conditions) -> bool {
        conditions.start == Start::default()
            || self.at(1).is_some_and(|next| {
                let expected = start.position() + start.velocity() * STEP_S;
                (next.position() - expected).norm() < SAME_M
            })
    }

    /// States of an agent that is present at the start, one per step from the step after the start to the
    /// first gap.
    pub(in crate::generator) fn states(world: &World<'_>, present: &AgentAtStart) -> Vec<State> {
        let kept = KeptMotion::of(&world.scene, world.agent(present), world.step);
        (1..=HORIZON_STEPS).map_while(|step| kept.at(step)).collect()
    }
}

/// The state `steps` later at constant velocity; an agent that stands stays.
fn straight_on(state: &State, steps: usize) -> State {
    if state.speed_mps() < STANDING_MPS {
        return State { vx_mps: 0.0, vy_mps: 0.0, ..*state };
    }
    let moved = state.position() + state.velocity() * (steps as f64 * STEP_S);
    State { x_m: moved.x, y_m: moved.y, ..*state }
}
