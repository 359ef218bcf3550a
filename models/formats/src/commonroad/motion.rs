//! Reads obstacles as road users, with a state each 0.1 s.

use super::document::{Obstacle, ObstacleState};
use super::shapes::Shape;
use super::words::road_user;
use crate::limits::MAX_STEPS;
use scene::geometry::rotate;
use scene::{Agent, STEP_S, Size, State, Track, Vec2, wrap_angle};

/// Least and greatest side of a box, metres.
const SIZE_M: (f64, f64) = (0.05, 60.0);

/// Changes made at import, counted in road users.
#[derive(Debug, Default)]
pub(super) struct Changed {
    pub uncertain: usize,
    pub shapes: usize,
    pub sets: usize,
    pub dropped: usize,
    pub cut: usize,
}

/// Time of the file in relation to the time of the scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    /// Length of a step of the file, seconds.
    pub step_s: f64,
    /// Its first step.
    pub first: i64,
    /// Steps of the scene.
    pub steps: usize,
}

impl Clock {
    /// Seconds since the first step.
    pub fn seconds(self, step: f64) -> f64 {
        (step - self.first as f64) * self.step_s
    }

    /// The step of the scene at or before a step of the file.
    pub fn step(self, step: i64) -> usize {
        (self.seconds(step as f64) / STEP_S + 1e-6).floor().clamp(0.0, MAX_STEPS as f64) as usize
    }

    /// Whether the steps of both have the same length.
    pub fn is_even(self) -> bool {
        (self.step_s - STEP_S).abs() < 1e-9
    }
}

/// A road user; nothing if it has no position, no size or an impossible size.
pub(super) fn agent(obstacle: &Obstacle, clock: Clock, changed: &mut Changed) -> Option<Agent> {
    let (agent_type, subtype) = road_user(&obstacle.word);
    changed.sets += usize::from(obstacle.sets);
    let Some(shape) = obstacle.shape.filter(|shape| shape.length_m.max(shape.width_m) <= SIZE_M.1) else {
        changed.dropped += 1;
        return None;
    };
    let states = states(&obstacle.states, shape);
    let Some(first) = states.first().copied() else {
        changed.dropped += 1;
        return None;
    };
    changed.shapes += usize::from(shape.approximated);
    changed.uncertain += usize::from(obstacle.states.iter().any(|state| state.uncertain));
    let (first_step, states) = if obstacle.fixed {
        let rest = State { vx_mps: 0.0, vy_mps: 0.0, ..first.1 };
        (0, vec![Some(rest); clock.steps])
    } else {
        let (begin, states) = resampled(&states, clock);
        changed.cut += usize::from(states.is_empty());
        (begin, states)
    };
    let mut agent = Agent::bare(obstacle.id.to_string(), agent_type, subtype, Vec::new());
    let side = |side_m: f64| side_m.max(SIZE_M.0);
    agent.size = Size { length_m: side(shape.length_m), width_m: side(shape.width_m), height_m: None };
    agent.track = Track { first_step, states, z_m: None }.into();
    Some(agent)
}

/// States of the centre of the box, by rising step of the file. Missing values are derived from the
/// positions.
fn states(timed: &[ObstacleState], shape: Shape) -> Vec<(i64, State)> {
    let mut sorted: Vec<ObstacleState> = timed.to_vec();
    sorted.sort_by_key(|state| state.step);
    sorted.dedup_by_key(|state| state.step);
    let way = |i: usize| -> Vec2 {
        let (from, to) = (&sorted[i.saturating_sub(1)], &sorted[(i + 1).min(sorted.len() - 1)]);
        to.at - from.at
    };
    let state = |(i, timed): (usize, &ObstacleState)| {
        let along = || Some(way(i)).filter(|way| way.norm() > 0.1).map_or(0.0, |way| way.y.atan2(way.x));
        let heading = timed.heading_rad.unwrap_or_else(along);
        let at = timed.at + rotate(shape.centre, heading);
        let v = timed.velocity.unwrap_or_default();
        let heading_rad = wrap_angle(heading + shape.heading_rad);
        (timed.step, State { x_m: at.x, y_m: at.y, heading_rad, vx_mps: v.x, vy_mps: v.y })
    };
    sorted.iter().enumerate().map(state).collect()
}

/// A state each 0.1 s, interpolated linearly between those of the file, and the step of the first one.
fn resampled(states: &[(i64, State)], clock: Clock) -> (usize, Vec<Option<State>>) {
    let (Some((first, _)), Some((last, _))) = (states.first(), states.last()) else { return (0, Vec::new()) };
    let begin = (clock.seconds(*first as f64) / STEP_S - 1e-6).ceil().max(0.0) as usize;
    let end = clock.step(*last).min(clock.steps.saturating_sub(1));
    let mut at = 0;
    let state = |step: usize| {
        let time = clock.first as f64 + step as f64 * STEP_S / clock.step_s;
        while states.get(at + 1).is_some_and(|(next, _)| *next as f64 <= time + 1e-6) {
            at += 1;
        }
        let (step, from) = states.get(at)?;
        let share = time - *step as f64;
        if share < 1e-6 {
            return Some(*from);
        }
        // Only between two consecutive steps of the file; a longer gap stays a gap.
        let (next, to) = states.get(at + 1)?;
        (next - step == 1).then(|| between(from, to, share))
    };
    let states: Vec<_> = (begin..=end).map(state).collect();
    if begin > end { (0, Vec::new()) } else { (begin, states) }
}

fn between(from: &State, to: &State, share: f64) -> State {
    let mix = |a: f64, b: f64| a + (b - a) * share;
    State {
        x_m: mix(from.x_m, to.x_m),
        y_m: mix(from.y_m, to.y_m),
        heading_rad: wrap_angle(from.heading_rad + wrap_angle(to.heading_rad - from.heading_rad) * share),
        vx_mps: mix(from.vx_mps, to.vx_mps),
        vy_mps: mix(from.vy_mps, to.vy_mps),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn driven(steps: &[i64]) -> Vec<(i64, State)> {
        steps
            .iter()
            .map(|step| (*step, State { x_m: *step as f64, vx_mps: 5.0, ..State::default() }))
            .collect()
    }

    #[test]
    fn steps_of_other_lengths_become_tenths() {
        let clock = |step_s| Clock { step_s, first: 0, steps: 600 };
        let xs = |states: &[i64], step_s| {
            let (begin, states) = resampled(&driven(states), clock(step_s));
            (begin, states.iter().map(|s| s.map(|s| (s.x_m * 1e9).round() / 1e9)).collect::<Vec<_>>())
        };
        assert_eq!(xs(&[1, 2, 4], 0.1), (1, vec![Some(1.0), Some(2.0), None, Some(4.0)]));
        assert_eq!(xs(&[0, 1, 2], 0.2), (0, vec![Some(0.0), Some(0.5), Some(1.0), Some(1.5), Some(2.0)]));
        assert_eq!(xs(&[1, 2, 3, 4, 5, 6], 0.04).1.len(), 2);
        assert_eq!(xs(&[3], 0.04), (0, vec![]));
        assert_eq!(xs(&[], 0.1), (0, vec![]));
    }
}
