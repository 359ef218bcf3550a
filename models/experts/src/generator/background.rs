//! Background motion: what road users do that get no new futures.

use super::reacting::Answerers;
use super::repulsion::Outline;
use crate::planning::world::{AgentAtStart, World};
use crate::tuning::OverlapTuning;
use scene::score::SweptBoxes;
use scene::{Agent, HORIZON_STEPS, STANDING_MPS, STEP_S, Scene, State};

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

/// Where a road user in the background is at a step of the window (0 is the start): by its chosen future, else its
/// log; one whose future has ended, or that was only drawn, goes straight on.
pub(super) fn background_state(
    scene: &Scene,
    agent: &Agent,
    start_step: usize,
    step: usize,
) -> Option<State> {
    let at = start_step + step;
    if let Some(generated) = scene.generated.as_ref()
        && let Some(future) = generated.chosen_future(&agent.id)
        && let Some(i) = at.checked_sub(future.first_step)
        && let Some(last) = future.states.last()
    {
        let since = (i + 1).saturating_sub(future.states.len());
        return Some(future.states.get(i).copied().unwrap_or(straight_on(last, since)));
    }
    if let Some(state) = agent.state_at(at) {
        return Some(state);
    }
    let mut known = agent.track.valid_steps();
    let (Some(first), None) = (known.next(), known.next()) else { return None };
    Some(straight_on(&agent.state_at(first)?, at.saturating_sub(first)))
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
    let at = |step| background_state(&world.scene, world.agent(who), world.step, step);
    (1..=HORIZON_STEPS).map_while(at).collect()
}
