//! Knots from positions: least squares on a recorded track, or on a path with a speed profile.
//!
//! Two linear problems give an initial guess (arc length to acceleration, heading to curvature); three
//! Gauss-Newton steps on the positions follow. A straight initial guess would leave 10 to 20 % of turning
//! cars unfitted.

use super::drive::{rollout, sensitivities};
use super::walk::position_row;
use super::{CONTROLS, Gear, Knots, MotionKind, MotionModel};
use crate::{KNOT_S, KNOT_STEPS, KNOTS, STEP_S, Vec2, wrap_angle};
use nalgebra::{SMatrix, SVector};

/// One wanted state of the box centre, scene frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampled {
    /// 1 ..= [`crate::HORIZON_STEPS`], ascending within a list.
    pub step: usize,
    /// Metres.
    pub position: Vec2,
    /// Radians; for a path its tangent.
    pub heading_rad: f64,
}

/// How much smoother than its samples a fitted motion may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothing(f64);

impl Smoothing {
    /// For wanted samples, such as a path with a speed profile, and for sensor data.
    pub const WISHED: Self = Self(1.0);
    /// For samples of a motion that was rolled out from knots: there is nothing to smooth.
    pub const DRIVEN: Self = Self(0.01);
}

/// Weight of the knots' second differences, which keeps knots smooth where samples are few.
const ROUGHNESS: [f64; 2] = [0.02, 2.0];
/// Weight of the knots themselves.
const SIZE: [f64; 2] = [1e-3, 2e-2];
const GAUSS_NEWTON_STEPS: usize = 3;

type Square<const N: usize> = SMatrix<f64, N, N>;

/// Knots whose rollout is as close to the samples as the limits allow. One sample per 0.5 s is enough. An
/// empty list gives the coasting knots.
pub fn fit(model: &MotionModel, samples: &[Sampled], smoothing: Smoothing) -> Knots {
    if samples.is_empty() {
        return model.coasting();
    }
    match model.kind {
        MotionKind::Drive => fit_drive(model, samples, smoothing),
        MotionKind::Walk => fit_walk(model, samples, smoothing),
    }
}

/// The same motion up to a step, then past the samples after it. A motion that was changed to meet a goal at
/// that step leaves it with another place, speed and heading than the later knots assume.
pub fn refit_after(
    model: &MotionModel,
    knots: &Knots,
    step: usize,
    samples: &[Sampled],
    smoothing: Smoothing,
) -> Knots {
    // The motion before that step depends on the knots before this one.
    let free = step.div_ceil(KNOT_STEPS) + 1;
    let after = samples.partition_point(|s| s.step <= step);
    if model.kind != MotionKind::Drive || free >= KNOTS || after == samples.len() {
        return *knots;
    }
    refine_positions(model, &samples[after..], *knots, free, smoothing)
}

/// `weight` times the integral of the squared second derivative over time, by second differences, plus `size` times
/// that of the squared values.
fn smoothness(weight: f64, size: f64) -> Square<KNOTS> {
    let weight = weight / KNOT_S.powi(3);
    let mut out = Square::<KNOTS>::identity() * (size * KNOT_S);
    for i in 1..KNOTS - 1 {
        for (a, ca) in [(i - 1, 1.0), (i, -2.0), (i + 1, 1.0)] {
            for (b, cb) in [(i - 1, 1.0), (i, -2.0), (i + 1, 1.0)] {
                out[(a, b)] += weight * ca * cb;
            }
        }
    }
    out
}

/// Ridge least squares of `rows u = wanted`.
fn ridge(rows: &[[f64; KNOTS]], wanted: &[f64], penalty: &Square<KNOTS>) -> [f64; KNOTS] {
    let mut normal = *penalty;
    let mut right = SVector::<f64, KNOTS>::zeros();
    for (row, w) in rows.iter().zip(wanted) {
        for i in 0..KNOTS {
            right[i] += row[i] * w;
            for j in 0..KNOTS {
                normal[(i, j)] += row[i] * row[j];
            }
        }
    }
    normal.cholesky().map_or([0.0; KNOTS], |c| c.solve(&right).into())
}

fn fit_drive(model: &MotionModel, samples: &[Sampled], smoothing: Smoothing) -> Knots {
    let first = fit_progress(model, samples, smoothing);
    let mut knots = model.legal(&Knots { first, second: [0.0; KNOTS] });
    knots.second = fit_headings(model, samples, &knots, smoothing);
    knots = model.legal(&knots);
    refine_positions(model, samples, knots, 0, smoothing)
}

/// Acceleration knots from the distance travelled.
fn fit_progress(model: &MotionModel, samples: &[Sampled], smoothing: Smoothing) -> [f64; KNOTS] {
    let v0 = model.start_speed_mps();
    let (mut rows, mut wanted) = (Vec::with_capacity(samples.len()), Vec::with_capacity(samples.len()));
    let (mut last, mut travelled) = (model.start.position(), 0.0);
    let mut speed_row = [0.0; KNOTS];
    let mut distance_row = [0.0; KNOTS];
    let mut step = 0;
    for sample in samples {
        travelled += (sample.position - last).norm();
        last = sample.position;
        while step < sample.step {
            let (j, w0, w1) = Knots::mid_weights(step);
            let before = speed_row;
            speed_row[j] += w0 * STEP_S;
            speed_row[j + 1] += w1 * STEP_S;
            for c in 0..KNOTS {
                distance_row[c] += 0.5 * (before[c] + speed_row[c]) * STEP_S;
            }
            step += 1;
        }
        rows.push(distance_row);
        wanted.push(travelled - v0 * step as f64 * STEP_S);
    }
    ridge(&rows, &wanted, &(smoothness(ROUGHNESS[0], SIZE[0]) * smoothing.0))
}

/// Curvature knots from the headings, along the distances that the acceleration knots give.
fn fit_headings(
    model: &MotionModel,
    samples: &[Sampled],
    knots: &Knots,
    smoothing: Smoothing,
) -> [f64; KNOTS] {
    let straight = rollout(model, knots);
    let sign = if model.gear == Gear::Reverse { -1.0 } else { 1.0 };
    let (mut rows, mut wanted) = (Vec::with_capacity(samples.len()), Vec::with_capacity(samples.len()));
    let mut row = [0.0; KNOTS];
    let (mut heading, mut last, mut step) = (0.0, model.start.heading_rad, 0);
    for sample in samples {
        heading += wrap_angle(sample.heading_rad - last);
        last = sample.heading_rad;
        while step < sample.step {
            let (j, w0, w1) = Knots::mid_weights(step);
            let ds = sign * (straight[step + 1].position - straight[step].position).norm();
            row[j] += w0 * ds;
            row[j + 1] += w1 * ds;
            step += 1;
        }
        rows.push(row);
        wanted.push(heading);
    }
    ridge(&rows, &wanted, &(smoothness(ROUGHNESS[1], SIZE[1]) * smoothing.0))
}

/// Gauss-Newton steps towards knots that pass the samples; knots before `free` stay fixed.
fn refine_positions(
    model: &MotionModel,
    samples: &[Sampled],
    mut knots: Knots,
    free: usize,
    smoothing: Smoothing,
) -> Knots {
    let steps: Vec<usize> = samples.iter().map(|s| s.step).collect();
    let goals: Vec<Vec2> = samples.iter().map(|s| model.to_local(s.position)).collect();
    let mut penalty = Square::<CONTROLS>::zeros();
    for channel in 0..2 {
        let block = smoothness(ROUGHNESS[channel], SIZE[channel]) * smoothing.0;
        penalty.fixed_view_mut::<KNOTS, KNOTS>(channel * KNOTS, channel * KNOTS).copy_from(&block);
    }
    let mut best = (f64::INFINITY, knots);
    for iteration in 0..=GAUSS_NEWTON_STEPS {
        let points = sensitivities(model, &knots, &steps);
        let u = SVector::<f64, CONTROLS>::from_fn(|i, _| {
            if i < KNOTS { knots.first[i] } else { knots.second[i - KNOTS] }
        });
        let rows = points.iter().zip(&goals).flat_map(|(point, goal)| {
            let difference = [goal.x - point.value[0], goal.y - point.value[1]];
            point.jacobian[..2].iter().zip(difference)
        });
        let cost = rows.clone().fold(u.dot(&(penalty * u)), |cost, (_, r)| cost + r * r);
        if cost < best.0 {
            best = (cost, knots);
        }
        if iteration == GAUSS_NEWTON_STEPS {
            break;
        }
        let (mut normal, mut right) = (penalty, -(penalty * u));
        let held = |i: usize| i % KNOTS < free;
        for (row, r) in rows {
            right.iter_mut().zip(row).for_each(|(sum, value)| *sum += value * r);
            add_outer(&mut normal, row);
        }
        for i in (0..CONTROLS).filter(|i| held(*i)) {
            normal.row_mut(i).fill(0.0);
            normal.column_mut(i).fill(0.0);
            (normal[(i, i)], right[i]) = (1.0, 0.0);
        }
        let Some(change) = normal.cholesky().map(|c| c.solve(&right)) else { break };
        let next = u + change;
        for i in 0..KNOTS {
            knots.first[i] = next[i];
            knots.second[i] = next[KNOTS + i];
        }
        knots = model.legal(&knots);
        if change.amax() < 1e-6 {
            break;
        }
    }
    best.1
}

/// Adds the outer product of a row. Only the lower half of the sum is complete, which is all that its
/// factorization reads.
fn add_outer(sum: &mut Square<CONTROLS>, row: &[f64; CONTROLS]) {
    let columns = sum.as_mut_slice().as_chunks_mut::<CONTROLS>().0;
    for j in 0..CONTROLS {
        for i in j..CONTROLS {
            columns[j][i] += row[j] * row[i];
        }
    }
}

fn fit_walk(model: &MotionModel, samples: &[Sampled], smoothing: Smoothing) -> Knots {
    let start = model.coasting();
    let mut rows = Vec::with_capacity(samples.len());
    let (mut ahead, mut left) = (Vec::with_capacity(samples.len()), Vec::with_capacity(samples.len()));
    for sample in samples {
        let mut row = position_row(sample.step);
        let goal = model.to_local(sample.position);
        // The first knot is the start velocity and not free.
        ahead.push(goal.x - row[0] * start.first[0]);
        left.push(goal.y - row[0] * start.second[0]);
        row[0] = 0.0;
        rows.push(row);
    }
    let penalty = smoothness(0.01, 1e-4) * smoothing.0;
    let mut knots = Knots { first: ridge(&rows, &ahead, &penalty), second: ridge(&rows, &left, &penalty) };
    (knots.first[0], knots.second[0]) = (start.first[0], start.second[0]);
    model.legal(&knots)
}
