//! Background motion: what road users do that get no new futures.

use super::actor::Actor;
use super::choice::swept_background;
use super::repulsion::{ABSENT, Outline, pose_of};
use super::trajectory::PER_INSTANT;
use crate::planning::world::{AgentAtStart, World};
use crate::tuning::OverlapTuning;
use scene::score::SweptBoxes;
use scene::{Agent, Future, HORIZON_STEPS, STEP_S, Scene, State};
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
            let known = Known::of(&world.scene, world.agent(who), world.step);
            let at = |step| known.at(step);
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

/// What a road user in the background does: its chosen future, else its log; one that was only drawn goes straight
/// on.
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
        let in_future = |f: &Future| f.states.get(at.checked_sub(f.first_step)?).copied();
        if let Some(state) = self.future.and_then(in_future).or_else(|| self.agent.state_at(at)) {
            return Some(state);
        }
        let (first, state) = self.drawn?;
        let moved = state.position() + state.velocity() * (at.saturating_sub(first) as f64 * STEP_S);
        Some(State { x_m: moved.x, y_m: moved.y, ..state })
    }
}

/// Its states over the window, one a step from the first after the start, as far as known.
pub(super) fn background_states(world: &World<'_>, who: &AgentAtStart) -> Vec<State> {
    let known = Known::of(&world.scene, world.agent(who), world.step);
    (1..=HORIZON_STEPS).map_while(|step| known.at(step)).collect()
}
