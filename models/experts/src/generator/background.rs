//! Background motion: what road users do that get no new futures.

use super::actor::Actor;
use super::choice::swept_background;
use super::repulsion::{ABSENT, Outline, pose_of};
use super::trajectory::PER_INSTANT;
use crate::planning::world::{AgentAtStart, World};
use crate::tuning::OverlapTuning;
use scene::score::SweptBoxes;
use scene::{Agent, HORIZON_STEPS, STEP_S, Scene, State};
use std::collections::BTreeSet;

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

    /// All who are there and do not act.
    pub(super) fn of(world: &World<'_>, actors: &[Actor], tuning: &OverlapTuning) -> Self {
        let acting: BTreeSet<usize> = actors.iter().map(|a| a.plan.present.index).collect();
        let mut found = Self::none();
        for who in world.present.iter().filter(|p| !acting.contains(&p.index)) {
            let at = |step| background_state(&world.scene, world.agent(who), world.step, step);
            let pose = |i: usize| {
                let state = at((i + 1) * PER_INSTANT);
                state.map_or(ABSENT, |s| pose_of(s.position(), s.heading_rad))
            };
            found.outlines.push(Outline::new(std::array::from_fn(pose), who, tuning));
            found.boxes.push(swept_background(at, &who.size));
        }
        found
    }
}

/// Where a road user in the background is at a step of the window (0 is the start): by its chosen future, else its
/// log; one that was only drawn goes straight on.
pub(super) fn background_state(
    scene: &Scene,
    agent: &Agent,
    start_step: usize,
    step: usize,
) -> Option<State> {
    let at = start_step + step;
    if let Some(generated) = scene.generated.as_ref()
        && let Some(future) = generated.chosen_future(&agent.id)
        && let Some(state) = at.checked_sub(future.first_step).and_then(|i| future.states.get(i))
    {
        return Some(*state);
    }
    if let Some(state) = agent.state_at(at) {
        return Some(state);
    }
    let mut known = agent.track.valid_steps();
    let (Some(first), None) = (known.next(), known.next()) else { return None };
    let state = agent.state_at(first)?;
    let moved = state.position() + state.velocity() * (at.saturating_sub(first) as f64 * STEP_S);
    Some(State { x_m: moved.x, y_m: moved.y, ..state })
}

/// Its states over the window, one a step from the first after the start, as far as known.
pub(super) fn background_states(world: &World<'_>, who: &AgentAtStart) -> Vec<State> {
    let at = |step| background_state(&world.scene, world.agent(who), world.step, step);
    (1..=HORIZON_STEPS).map_while(at).collect()
}
