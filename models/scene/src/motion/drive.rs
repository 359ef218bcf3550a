//! Wheeled motion: a reference point behind the box centre moves with acceleration a and curvature k.
//!
//! Each step of 0.1 s uses both values at its middle and follows the circular arc they give, which is exact
//! for constant curvature. Speed stays between zero and the top speed. Curvature stays within the steering
//! limit and within lateral grip at the present speed.

use super::{CONTROLS, Gear, Knots, MotionModel, MotionState, REVERSE_SPEED_MPS, Trajectory};
use crate::{HORIZON_STEPS, KNOTS, STEP_S, Vec2};

/// Values of one step that the rollout and its sensitivities share.
struct Step {
    speed_next: f64,
    /// The speed was not clamped.
    speed_free: bool,
    /// Signed distance along the heading.
    ds: f64,
    curvature: f64,
    bound: CurvatureBound,
}

/// What determined the curvature of a step.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CurvatureBound {
    Free,
    Wheels,
    Grip,
}

/// Upper bound of the speed for this start: a start above the top speed may only slow down.
fn top_speed(model: &MotionModel, v0: f64) -> f64 {
    match model.gear {
        Gear::Forward => model.limits.speed_mps.max(v0),
        Gear::Reverse => REVERSE_SPEED_MPS.max(v0),
    }
}

pub(crate) fn legal(model: &MotionModel, knots: &Knots) -> Knots {
    let l = &model.limits;
    Knots {
        first: knots.first.map(|a| a.clamp(-l.brake_mps2, l.accel_mps2)),
        second: knots.second.map(|k| k.clamp(-l.curvature_per_m, l.curvature_per_m)),
    }
}

fn step(model: &MotionModel, knots: &Knots, i: usize, speed: f64, top: f64) -> Step {
    let (j, w0, w1) = Knots::mid_weights(i);
    let accel = w0 * knots.first[j] + w1 * knots.first[j + 1];
    let wanted = w0 * knots.second[j] + w1 * knots.second[j + 1];
    let open = speed + accel * STEP_S;
    let speed_next = open.clamp(0.0, top);
    let mean = 0.5 * (speed + speed_next);
    let grip = model.limits.lateral_mps2 / (mean * mean).max(1e-6);
    let (curvature, bound) = if wanted.abs() <= model.limits.curvature_per_m.min(grip) {
        (wanted, CurvatureBound::Free)
    } else if grip < model.limits.curvature_per_m {
        (grip.copysign(wanted), CurvatureBound::Grip)
    } else {
        (model.limits.curvature_per_m.copysign(wanted), CurvatureBound::Wheels)
    };
    let sign = if model.gear == Gear::Reverse { -1.0 } else { 1.0 };
    Step { speed_next, speed_free: open > 0.0 && open < top, ds: sign * mean * STEP_S, curvature, bound }
}

/// Chord over arc of a step that turns by `turn`.
fn chord_ratio(turn: f64) -> f64 {
    1.0 - turn * turn / 24.0
}

/// Rollout in the start's frame.
pub(crate) fn rollout(model: &MotionModel, knots: &Knots) -> Trajectory {
    let knots = legal(model, knots);
    let v0 = model.start_speed_mps();
    let top = top_speed(model, v0);
    let offset = model.offset_m;
    let sign = if model.gear == Gear::Reverse { -1.0 } else { 1.0 };
    let mut states = Vec::with_capacity(HORIZON_STEPS + 1);
    states.push(MotionState { velocity: Vec2::new(sign * v0, 0.0), ..MotionState::default() });
    let (mut x, mut y, mut heading, mut speed) = (-offset, 0.0, 0.0_f64, v0);
    for i in 0..HORIZON_STEPS {
        let s = step(model, &knots, i, speed, top);
        let turn = s.curvature * s.ds;
        let (sin, cos) = (heading + 0.5 * turn).sin_cos();
        let chord = s.ds * chord_ratio(turn);
        x += chord * cos;
        y += chord * sin;
        heading += turn;
        speed = s.speed_next;
        let (sin, cos) = heading.sin_cos();
        let swing = offset * s.curvature * speed;
        states.push(MotionState {
            position: Vec2::new(x + offset * cos, y + offset * sin),
            heading_rad: heading,
            velocity: sign * Vec2::new(speed * cos - swing * sin, speed * sin + swing * cos),
        });
    }
    states
}

/// A rollout's state at one step with its derivatives by the knots, start's frame.
#[derive(Clone, Debug)]
pub(crate) struct Sensitivity {
    /// Box centre x, y, heading, speed of the box centre.
    pub(crate) value: [f64; 4],
    /// Rows x, y, heading, speed; columns acceleration knots then curvature knots.
    pub(crate) jacobian: [[f64; CONTROLS]; 4],
}

/// Values and derivatives at the steps `at` (ascending, 1 ..= [`HORIZON_STEPS`]); one pass forwards.
pub(crate) fn sensitivities(model: &MotionModel, knots: &Knots, at: &[usize]) -> Vec<Sensitivity> {
    let knots = legal(model, knots);
    let v0 = model.start_speed_mps();
    let top = top_speed(model, v0);
    let offset = model.offset_m;
    let gear = if model.gear == Gear::Reverse { -1.0 } else { 1.0 };
    let mut out = Vec::with_capacity(at.len());
    let last = at.last().copied().unwrap_or(0);
    let (mut x, mut y, mut heading, mut speed) = (-offset, 0.0, 0.0_f64, v0);
    // Acceleration knots, then curvature knots. Separate loops of known length take half the time.
    let (mut dx, mut dy, mut dh) = ([[0.0; KNOTS]; 2], [[0.0; KNOTS]; 2], [[0.0; KNOTS]; 2]);
    let mut dv = [0.0; KNOTS];
    let mut next = 0;
    for i in 0..last.min(HORIZON_STEPS) {
        let s = step(model, &knots, i, speed, top);
        let (j, w0, w1) = Knots::mid_weights(i);
        let turn = s.curvature * s.ds;
        let (sin, cos) = (heading + 0.5 * turn).sin_cos();
        let ratio = chord_ratio(turn);
        let (chord, bend) = (s.ds * ratio, -s.ds * turn / 12.0);
        let mean = 0.5 * (speed + s.speed_next);
        let grip_slope =
            if s.bound == CurvatureBound::Grip && mean > 1e-3 { -2.0 * s.curvature / mean } else { 0.0 };
        let mut weights = [0.0; KNOTS];
        (weights[j], weights[j + 1]) = (w0, w1);
        for c in 0..KNOTS {
            let before = dv[c];
            let after = if s.speed_free { before + STEP_S * weights[c] } else { 0.0 };
            dv[c] = after;
            let dmean = 0.5 * (before + after);
            let dds = gear * STEP_S * dmean;
            let dturn = s.curvature * dds + s.ds * grip_slope * dmean;
            let dchord = ratio * dds + bend * dturn;
            let dmid = dh[0][c] + 0.5 * dturn;
            dx[0][c] += cos * dchord - chord * sin * dmid;
            dy[0][c] += sin * dchord + chord * cos * dmid;
            dh[0][c] += dturn;
        }
        let turns_by = if s.bound == CurvatureBound::Free { s.ds } else { 0.0 };
        for c in 0..KNOTS {
            let dturn = turns_by * weights[c];
            let dmid = dh[1][c] + 0.5 * dturn;
            dx[1][c] += cos * bend * dturn - chord * sin * dmid;
            dy[1][c] += sin * bend * dturn + chord * cos * dmid;
            dh[1][c] += dturn;
        }
        x += chord * cos;
        y += chord * sin;
        heading += turn;
        speed = s.speed_next;
        if at[next] == i + 1 {
            out.push(at_centre(offset, [x, y, heading, speed], s.curvature, [&dx, &dy, &dh], &dv));
            next += 1;
            if next == at.len() {
                break;
            }
        }
    }
    out
}

/// Moves a sensitivity from the reference point to the box centre.
fn at_centre(
    offset: f64,
    [x, y, heading, speed]: [f64; 4],
    curvature: f64,
    slopes: [&[[f64; KNOTS]; 2]; 3],
    dv: &[f64; KNOTS],
) -> Sensitivity {
    let (sin, cos) = heading.sin_cos();
    // Speed of the centre over that of the reference point; its own change is a second-order effect.
    let swing = (1.0 + (offset * curvature).powi(2)).sqrt();
    let mut jacobian = [[0.0; CONTROLS]; 4];
    for (row, slopes) in jacobian.iter_mut().zip(slopes) {
        row.copy_from_slice(slopes.as_flattened());
    }
    let dh = jacobian[2];
    for c in 0..CONTROLS {
        jacobian[0][c] -= offset * sin * dh[c];
        jacobian[1][c] += offset * cos * dh[c];
    }
    for c in 0..KNOTS {
        jacobian[3][c] = swing * dv[c];
    }
    Sensitivity { value: [x + offset * cos, y + offset * sin, heading, speed * swing], jacobian }
}

/// Share of steps up to `until` at which grip, and the steering limit, cut the curvature.
pub(crate) fn curvature_cut(model: &MotionModel, knots: &Knots, until: usize) -> (f64, f64) {
    let knots = legal(model, knots);
    let mut speed = model.start_speed_mps();
    let top = top_speed(model, speed);
    let (mut grip, mut wheels) = (0.0, 0.0);
    for i in 0..until.min(HORIZON_STEPS) {
        let s = step(model, &knots, i, speed, top);
        speed = s.speed_next;
        grip += f64::from(u8::from(s.bound == CurvatureBound::Grip));
        let at_limit = s.curvature.abs() > 0.98 * model.limits.curvature_per_m;
        wheels += f64::from(u8::from(s.bound == CurvatureBound::Wheels || at_limit));
    }
    let n = until.max(1) as f64;
    (grip / n, wheels / n)
}
