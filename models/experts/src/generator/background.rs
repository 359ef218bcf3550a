//! Background motion: what road users do that get no new futures.

use super::reacting::Answerers;
use super::repulsion::Outline;
use crate::planning::world::{AgentAtStart, World};
use crate::tuning::OverlapTuning;
use scene::score::SweptBoxes;
use scene::{Agent, Future, HORIZON_STEPS, STANDING_MPS, STEP_S, Scene, State};

/// Everybody in the background of a window, as obstacles.
pub(super) struct Background {
    /// Of refinement and guidance.
    pub(super) outlines: Vec<Outline>,
    /// Of the choice.
    pub(super) boxes: Vec<SweptBoxes>,
}

impl Background {
    /// Nobody.
    pub(super) fn none() -> Self {
        Self { outlines: Vec::new(), boxes: Vec::new() }
    }

    /// Everybody but the actors. Those that may answer repel like the others; what the choice weighs against them is
    /// what their answers cost.
    pub(super) fn of(answerers: &Answerers<'_>, tuning: &OverlapTuning) -> Self {
        let outlines = answerers.movings().map(|moving| Outline::of_boxes(&moving.boxes, tuning)).collect();
        let boxes = answerers.fixed.iter().map(|f| f.moving.swept.clone()).collect();
        Self { outlines, boxes }
    }
}

/// What a road user in the background does: its chosen future, else its log; one whose future has ended, or that was
/// only drawn, goes straight on.
pub(super) struct Known<'a> {
    agent: &'a Agent,
    future: Option<&'a Future>,
    start_step: usize,
    /// All that is known of one that was only drawn.
    drawn: Option<(usize, State)>,
}

impl<'a> Known<'a> {
    pub(super) fn of(scene: &'a Scene, agent: &'a Agent, start_step: usize) -> Self {
        let future = scene.generated.as_ref().and_then(|generated| generated.chosen_future(&agent.id));
        let mut known = agent.track.valid_steps();
        let drawn = match (known.next(), known.next()) {
            (Some(first), None) => agent.state_at(first).map(|state| (first, state)),
            _ => None,
        };
        Self { agent, future, start_step, drawn }
    }

    /// Where it is at a step of the window; 0 is the start.
    pub(super) fn at(&self, step: usize) -> Option<State> {
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
        let (first, state) = self.drawn?;
        Some(straight_on(&state, at.saturating_sub(first)))
    }
}

/// So many steps on; what stands stays.
fn straight_on(state: &State, steps: usize) -> State {
    if state.speed_mps() < STANDING_MPS {
        return State { vx_mps: 0.0, vy_mps: 0.0, ..*state };
    }
    let moved = state.position() + state.velocity() * (steps as f64 * STEP_S);
    State { x_m: moved.x, y_m: moved.y, ..*state }
}

/// Its states over the window, one a step from the first after the start, as far as known.
pub(super) fn background_states(world: &World<'_>, who: &AgentAtStart) -> Vec<State> {
    let known = Known::of(&world.scene, world.agent(who), world.step);
    (1..=HORIZON_STEPS).map_while(|step| known.at(step)).collect()
}
