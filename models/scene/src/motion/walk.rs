//! Walking: velocity knots in the start's frame. The first knot is the start velocity; changes from knot to
//! knot stay within the acceleration limit, speeds within the top speed.
//!
//! The heading follows the motion above 0.3 m/s and is held below. A pedestrian that ends standing turns on
//! the spot to a fixed goal heading.

use super::{Knots, MotionModel, MotionState, Trajectory};
use crate::geometry::rotate;
use crate::{HORIZON_STEPS, KNOT_S, KNOT_STEPS, KNOTS, STANDING_MPS, STEP_S, Vec2, wrap_angle};

/// Fastest turning of the body, radians per step.
const TURN_PER_STEP_RAD: f64 = 0.35;
/// Steps over which a standing person turns to a goal heading.
const TURN_STEPS: usize = 12;

/// Velocity at the start in the start's frame.
fn start_velocity(model: &MotionModel) -> Vec2 {
    rotate(model.start.velocity(), -model.start.heading_rad)
}

/// Knots within reach of the start velocity and the limits, clamped one after the other.
pub(crate) fn legal(model: &MotionModel, knots: &Knots) -> Knots {
    let mut out = Knots::default();
    let mut last = start_velocity(model);
    let top = model.limits.speed_mps.max(last.norm());
    (out.first[0], out.second[0]) = (last.x, last.y);
    for i in 1..KNOTS {
        let mut v = Vec2::new(knots.first[i], knots.second[i]);
        if v.norm() > top {
            v *= top / v.norm();
        }
        let change = v - last;
        let most = model.limits.accel_mps2 * KNOT_S;
        if change.norm() > most {
            v = last + change * (most / change.norm());
        }
        (out.first[i], out.second[i]) = (v.x, v.y);
        last = v;
    }
    out
}

/// The knot before a step's end, and the share of the way to the next knot, 0 to 1.
fn end_weight(step: usize) -> (usize, f64) {
    let j = (step / KNOT_STEPS).min(KNOTS - 2);
    (j, (step - j * KNOT_STEPS) as f64 / KNOT_STEPS as f64)
}

/// Velocity at a step's end.
fn velocity_at(knots: &Knots, step: usize) -> Vec2 {
    let (j, f) = end_weight(step);
    Vec2::new(
        (1.0 - f) * knots.first[j] + f * knots.first[j + 1],
        (1.0 - f) * knots.second[j] + f * knots.second[j + 1],
    )
}

/// Rollout in the start's frame.
pub(crate) fn rollout(model: &MotionModel, knots: &Knots) -> Trajectory {
    let knots = legal(model, knots);
    let mut states = Vec::with_capacity(HORIZON_STEPS + 1);
    let mut state = MotionState { velocity: start_velocity(model), ..MotionState::default() };
    states.push(state);
    for i in 0..HORIZON_STEPS {
        let (j, w0, w1) = Knots::mid_weights(i);
        let mean = Vec2::new(
            w0 * knots.first[j] + w1 * knots.first[j + 1],
            w0 * knots.second[j] + w1 * knots.second[j + 1],
        );
        state.position += mean * STEP_S;
        state.velocity = velocity_at(&knots, i + 1);
        if state.velocity.norm() > STANDING_MPS {
            let wanted = state.velocity.y.atan2(state.velocity.x);
            let turn = wrap_angle(wanted - state.heading_rad);
            state.heading_rad += turn.clamp(-TURN_PER_STEP_RAD, TURN_PER_STEP_RAD);
        }
        states.push(state);
    }
    if let Some((step, heading)) = model.turn_to {
        turn_on_the_spot(&mut states, step, wrap_angle(heading - model.start.heading_rad));
    }
    states
}

/// Turns a pedestrian that stands at `step` to `heading` over the last steps before it.
fn turn_on_the_spot(states: &mut Trajectory, step: usize, heading: f64) {
    let step = step.min(HORIZON_STEPS);
    if states[step].velocity.norm() > STANDING_MPS + 0.02 {
        return;
    }
    let first = step.saturating_sub(TURN_STEPS);
    let base = states[first].heading_rad;
    let turn = wrap_angle(heading - base);
    for i in first..=step {
        let f = (i - first) as f64 / (step - first).max(1) as f64;
        states[i].heading_rad = base + turn * f * f * (3.0 - 2.0 * f);
    }
    for i in step + 1..states.len() {
        if states[i].velocity.norm() <= STANDING_MPS {
            states[i].heading_rad = states[i - 1].heading_rad;
        }
    }
}

/// Rows of the linear map from velocity knots to the position at the end of `step`.
pub(crate) fn position_row(step: usize) -> [f64; KNOTS] {
    let mut row = [0.0; KNOTS];
    for i in 0..step {
        let (j, w0, w1) = Knots::mid_weights(i);
        row[j] += w0 * STEP_S;
        row[j + 1] += w1 * STEP_S;
    }
    row
}

/// Row of the linear map from velocity knots to the velocity at the end of `step`.
pub(crate) fn velocity_row(step: usize) -> [f64; KNOTS] {
    let (j, f) = end_weight(step);
    let mut row = [0.0; KNOTS];
    row[j] = 1.0 - f;
    row[j + 1] = f;
    row
}
