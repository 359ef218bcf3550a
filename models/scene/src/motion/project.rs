//! Projects motions onto goals exactly: the smallest change of the knots whose rollout ends at the goal,
//! within the limits.
//!
//! Gauss-Newton on the rollout with its analytic Jacobian, in the metric of [`super::whiten`], with an active
//! set at the bounds. Hard cases are tried from several initial guesses.

use super::drive::{curvature_cut, sensitivities};
use super::fit::{Sampled, Smoothing, fit};
use super::walk::{position_row, velocity_row};
use super::whiten::Whitening;
use super::{CONTROLS, Knots, MotionKind, MotionModel, MotionState, Trajectory};
use crate::geometry::direction;
use crate::{HORIZON_STEPS, KNOT_S, KNOT_STEPS, KNOTS, MAX_VIAS, STANDING_MPS, STEP_S, Vec2, wrap_angle};
use nalgebra::{SMatrix, SVector};
use schemars::JsonSchema;
use serde::Serialize;

/// What must hold at one step; `None` leaves a field free. Scene frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// 1 ..= [`HORIZON_STEPS`].
    pub step: usize,
    /// Box centre, metres.
    pub position: Option<Vec2>,
    /// Radians.
    pub heading_rad: Option<f64>,
    /// m/s, not negative.
    pub speed_mps: Option<f64>,
}

impl Target {
    /// Whether all fields are free.
    pub fn is_free(&self) -> bool {
        self.position.is_none() && self.heading_rad.is_none() && self.speed_mps.is_none()
    }

    /// The fixed velocity at the end, m/s. A free speed or direction is taken from `natural`. `None` if both
    /// are free.
    pub fn end_velocity(&self, natural: Vec2) -> Option<Vec2> {
        match (self.heading_rad, self.speed_mps) {
            (Some(heading), speed) => Some(direction(heading) * speed.unwrap_or_else(|| natural.norm())),
            (None, Some(speed)) => Some(natural * (speed / natural.norm().max(0.1))),
            (None, None) => None,
        }
    }
}

/// Deviation of a state from a target; zero for free fields.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TargetError {
    /// Metres.
    pub position_m: f64,
    /// Radians, not negative.
    pub heading_rad: f64,
    /// m/s, not negative.
    pub speed_mps: f64,
}

impl TargetError {
    /// Deviation of a state from a target.
    pub fn of(state: &MotionState, target: &Target) -> Self {
        Self {
            position_m: target.position.map_or(0.0, |p| (p - state.position).norm()),
            heading_rad: target.heading_rad.map_or(0.0, |h| wrap_angle(h - state.heading_rad).abs()),
            speed_mps: target.speed_mps.map_or(0.0, |v| (v - state.speed_mps()).abs()),
        }
    }

    /// Whether the deviation is within 5 cm, 0.015 rad and 5 cm/s, which is invisible.
    pub fn is_met(&self) -> bool {
        self.position_m < 0.05 && self.heading_rad < 0.015 && self.speed_mps < 0.05
    }

    fn norm(&self) -> f64 {
        self.position_m.hypot(HEADING_SCALE * self.heading_rad).hypot(self.speed_mps)
    }
}

/// Reason why a goal is unreachable: a motion limit, traffic, or a relation that does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Limiting {
    /// Acceleration, m/s2.
    Acceleration,
    /// Deceleration, m/s2.
    Braking,
    /// Top speed, m/s.
    Speed,
    /// Sideways acceleration, m/s2.
    Lateral,
    /// Curvature, 1/m.
    Curvature,
    /// Another road user blocks the path permanently.
    Traffic,
    /// The goal is relative to a road user or a lane that does not exist there.
    Relation,
}

/// Whether the target was met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// All fixed fields hold.
    Reached(TargetError),
    /// No motion within the limits that meets it was found.
    Unreachable {
        /// The nearest state at the target's step.
        nearest: MotionState,
        /// Remaining deviation.
        residuals: TargetError,
        /// The limit that binds.
        limiting: Limiting,
        /// The amount that the target would need, in that limit's unit, if a formula gives it.
        needs: Option<f64>,
    },
}

impl Reach {
    /// Whether the target is reached.
    pub fn is_reached(&self) -> bool {
        matches!(self, Self::Reached(_))
    }

    /// Whether the goal is missed because another agent is in the way.
    pub fn is_for_traffic(&self) -> bool {
        matches!(self, Self::Unreachable { limiting: Limiting::Traffic, .. })
    }
}

/// Projected knots and their motion.
#[derive(Clone, Debug)]
pub struct Projection {
    /// Within the limits.
    pub knots: Knots,
    /// Rollout of `knots`.
    pub trajectory: Trajectory,
    /// Verdict.
    pub reach: Reach,
}

/// Metres that one radian of heading counts as.
const HEADING_SCALE: f64 = 5.0;
const ITERATIONS: usize = 10;
/// The last iterations go to the nearest root instead of towards the wanted knots.
const FREE_ITERATIONS: usize = 4;
/// Scaled residual at which iteration stops.
const TOLERANCE: f64 = 2e-4;

/// Rows of a target: x, y, heading, speed.
const TARGET_ROWS: usize = 4;
/// Rows of a target and of the greatest number of via points.
const THROUGH_ROWS: usize = TARGET_ROWS + 2 * MAX_VIAS;
type Controls = SVector<f64, CONTROLS>;

/// Projects `near` onto the motions that meet `target`. `warm` (an answer to a slightly different
/// target) is tried as the first guess, so that a dragged goal moves its answer smoothly.
///
/// With a free target this only applies the limits. Cost: about 10 us an iteration, 2 to 6 iterations
/// for a reachable goal near the knots.
pub fn project(model: &MotionModel, near: &Knots, target: &Target, warm: Option<&Knots>) -> Projection {
    let near = model.legal(near);
    if target.is_free() {
        let trajectory = model.rollout(&near);
        return Projection { knots: near, trajectory, reach: Reach::Reached(TargetError::default()) };
    }
    let target = Target { step: target.step.clamp(1, HORIZON_STEPS), ..*target };
    let mut best: Option<(f64, MotionModel, Knots, Trajectory)> = None;
    for (variant, first_guess) in attempts(model, &near, &target, warm) {
        let guess = first_guess(&variant, &near, &target, warm);
        let knots = solve::<TARGET_ROWS>(&variant, &near, guess, &target, &[]);
        let knots = calm_after(&variant, knots, &near, &target);
        let trajectory = variant.rollout(&knots);
        let residuals = TargetError::of(&trajectory[target.step], &target);
        let norm = residuals.norm();
        if best.as_ref().is_none_or(|b| norm < b.0) {
            best = Some((norm, variant, knots, trajectory));
        }
        if residuals.is_met() {
            break;
        }
    }
    let (_, variant, knots, trajectory) =
        best.unwrap_or_else(|| (f64::MAX, *model, near, model.rollout(&near)));
    judged(&variant, knots, trajectory, &target)
}

/// A place that a motion passes at a step on its way to a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// 1 ..= [`HORIZON_STEPS`].
    pub step: usize,
    /// Box centre, metres, scene frame.
    pub position: Vec2,
    /// If set, only the deviation across this heading counts, radians: the motion may pass earlier or later.
    pub across_rad: Option<f64>,
}

/// The motion near `near` that passes these places, at most [`MAX_VIAS`], on its way to the target, as
/// closely as the limits allow. `guess` is the initial guess of the search.
pub fn project_through(
    model: &MotionModel,
    near: &Knots,
    guess: &Knots,
    target: &Target,
    passes: &[Pass],
) -> Projection {
    let near = model.legal(near);
    let target = Target { step: target.step.clamp(1, HORIZON_STEPS), ..*target };
    // A pedestrian that stands at its goal turns there.
    let turns = model.kind == MotionKind::Walk && target.speed_mps.is_some_and(|v| v < STANDING_MPS);
    let turn_to = target.heading_rad.filter(|_| turns).map(|heading_rad| (target.step, heading_rad));
    let model = MotionModel { turn_to, ..*model };
    let knots = solve::<THROUGH_ROWS>(&model, &near, *guess, &target, &passes[..passes.len().min(MAX_VIAS)]);
    let knots = if target.is_free() { knots } else { calm_after(&model, knots, &near, &target) };
    let trajectory = model.rollout(&knots);
    judged(&model, knots, trajectory, &target)
}

/// A motion with the verdict on its target.
fn judged(model: &MotionModel, knots: Knots, trajectory: Trajectory, target: &Target) -> Projection {
    let residuals = TargetError::of(&trajectory[target.step], target);
    let reach = if residuals.is_met() {
        Reach::Reached(residuals)
    } else {
        let nearest = trajectory[target.step];
        let (limiting, needs) = explain(model, &knots, target);
        Reach::Unreachable { nearest, residuals, limiting, needs }
    };
    Projection { knots, trajectory, reach }
}

/// Limits the goal's effect to the time before it: later knots return to the wanted ones, so that time
/// pressure ends at the goal. On foot they keep the velocity at the goal.
fn calm_after(model: &MotionModel, mut knots: Knots, near: &Knots, target: &Target) -> Knots {
    // The motion before the goal depends on the knots up to this one.
    let last = target.step.div_ceil(KNOT_STEPS);
    for i in last + 1..KNOTS {
        (knots.first[i], knots.second[i]) = match model.kind {
            MotionKind::Drive => (near.first[i], near.second[i]),
            MotionKind::Walk => (knots.first[last], knots.second[last]),
        };
    }
    model.legal(&knots)
}

type FirstGuess = fn(&MotionModel, &Knots, &Target, Option<&Knots>) -> Knots;

/// Models and initial guesses, in the order in which they are tried.
fn attempts(
    model: &MotionModel,
    near: &Knots,
    target: &Target,
    warm: Option<&Knots>,
) -> Vec<(MotionModel, FirstGuess)> {
    let from_near: FirstGuess = |_, near, _, _| *near;
    let from_warm: FirstGuess = |_, near, _, warm| warm.copied().unwrap_or(*near);
    let from_arc: FirstGuess = |m, _, target, _| arc_guess(m, target);
    let from_zero: FirstGuess = |m, _, _, _| m.coasting();
    let from_curve: FirstGuess = |m, _, target, _| curve_guess(m, target, 1.0);
    let from_wide_curve: FirstGuess = |m, _, target, _| curve_guess(m, target, 1.8);
    let mut out: Vec<(MotionModel, FirstGuess)> = Vec::with_capacity(6);
    match model.kind {
        MotionKind::Walk => {
            let standing = MotionModel { turn_to: target.heading_rad.map(|h| (target.step, h)), ..*model };
            let may_stand = target.heading_rad.is_some() && target.speed_mps.is_none_or(|v| v < STANDING_MPS);
            let must_stand =
                target.heading_rad.is_some() && target.speed_mps.is_some_and(|v| v < STANDING_MPS);
            if warm.is_some() {
                out.push((*model, from_warm));
            }
            if !must_stand {
                out.extend([(*model, from_near), (*model, from_zero)]);
            }
            if may_stand {
                out.extend([(standing, from_near), (standing, from_zero)]);
            }
        }
        MotionKind::Drive => {
            if warm.is_some() {
                out.push((*model, from_warm));
            }
            // Knots that were not made for this goal are a bad initial guess; an arc through the goal is
            // better.
            let idle = near.first.iter().chain(&near.second).all(|v| v.abs() < 1e-6);
            if idle && target.position.is_some() {
                out.extend([(*model, from_arc), (*model, from_near)]);
            } else {
                out.extend([(*model, from_near), (*model, from_arc)]);
            }
            out.extend([(*model, from_curve), (*model, from_wide_curve), (*model, from_zero)]);
        }
    }
    out
}

/// Target minus value, and the value's derivatives; rows of free fields are zero and inactive.
struct Linearized<const ROWS: usize> {
    residual: SVector<f64, ROWS>,
    jacobian: SMatrix<f64, ROWS, CONTROLS>,
    active: [bool; ROWS],
}

impl<const ROWS: usize> Linearized<ROWS> {
    fn none() -> Self {
        Self { residual: SVector::zeros(), jacobian: SMatrix::zeros(), active: [false; ROWS] }
    }

    fn norm(&self) -> f64 {
        self.residual.norm()
    }

    /// Sets the two rows of a pass. `here` is the present place of the motion, `change` its derivative by the
    /// knots, both in the start's frame.
    fn pass(
        &mut self,
        model: &MotionModel,
        k: usize,
        pass: &Pass,
        here: [f64; 2],
        change: [[f64; CONTROLS]; 2],
    ) {
        let wanted = model.to_local(pass.position);
        let off = [wanted.x - here[0], wanted.y - here[1]];
        let axes = match pass.across_rad {
            Some(heading_rad) => {
                let (sin, cos) = (heading_rad - model.start.heading_rad).sin_cos();
                [Some([-sin, cos]), None]
            }
            None => [Some([1.0, 0.0]), Some([0.0, 1.0])],
        };
        for (i, axis) in axes.into_iter().flatten().enumerate() {
            let row = TARGET_ROWS + 2 * k + i;
            self.active[row] = true;
            self.residual[row] = axis[0] * off[0] + axis[1] * off[1];
            for c in 0..CONTROLS {
                self.jacobian[(row, c)] = axis[0] * change[0][c] + axis[1] * change[1][c];
            }
        }
    }
}

fn linearise<const ROWS: usize>(
    model: &MotionModel,
    knots: &Knots,
    target: &Target,
    passes: &[Pass],
) -> Linearized<ROWS> {
    match model.kind {
        MotionKind::Drive => linearise_drive(model, knots, target, passes),
        MotionKind::Walk => linearise_walk(model, knots, target, passes),
    }
}

fn linearise_drive<const ROWS: usize>(
    model: &MotionModel,
    knots: &Knots,
    target: &Target,
    passes: &[Pass],
) -> Linearized<ROWS> {
    let mut out = Linearized::none();
    let mut steps: Vec<usize> = passes.iter().map(|pass| pass.step).chain([target.step]).collect();
    steps.sort_unstable();
    steps.dedup();
    let found = sensitivities(model, knots, &steps);
    let at = |step: usize| steps.iter().position(|s| *s == step).and_then(|i| found.get(i));
    for (k, pass) in passes.iter().enumerate() {
        if let Some(s) = at(pass.step) {
            out.pass(model, k, pass, [s.value[0], s.value[1]], [s.jacobian[0], s.jacobian[1]]);
        }
    }
    let Some(s) = at(target.step) else { return out };
    let heading_goal = target.heading_rad.map(|h| wrap_angle(h - model.start.heading_rad));
    let local = target.position.map(|p| model.to_local(p));
    let goals = [local.map(|p| p.x), local.map(|p| p.y), heading_goal, target.speed_mps];
    for (row, goal) in goals.into_iter().enumerate() {
        let Some(goal) = goal else { continue };
        let scale = if row == 2 { HEADING_SCALE } else { 1.0 };
        let difference = goal - s.value[row];
        out.active[row] = true;
        out.residual[row] = scale * if row == 2 { wrap_angle(difference) } else { difference };
        for c in 0..CONTROLS {
            out.jacobian[(row, c)] = scale * s.jacobian[row][c];
        }
    }
    out
}

fn linearise_walk<const ROWS: usize>(
    model: &MotionModel,
    knots: &Knots,
    target: &Target,
    passes: &[Pass],
) -> Linearized<ROWS> {
    let mut out = Linearized::none();
    let apply = |row: &[f64; KNOTS], channel: &[f64; KNOTS]| -> f64 {
        row.iter().zip(channel).map(|(r, u)| r * u).sum()
    };
    for (k, pass) in passes.iter().enumerate() {
        let row = position_row(pass.step);
        let mut change = [[0.0; CONTROLS]; 2];
        change[0][..KNOTS].copy_from_slice(&row);
        change[1][KNOTS..].copy_from_slice(&row);
        out.pass(model, k, pass, [apply(&row, &knots.first), apply(&row, &knots.second)], change);
    }
    let position = position_row(target.step);
    let velocity = velocity_row(target.step);
    if let Some(goal) = target.position {
        let goal = model.to_local(goal);
        let here = [apply(&position, &knots.first), apply(&position, &knots.second)];
        for (row, goal) in [goal.x, goal.y].into_iter().enumerate() {
            out.active[row] = true;
            out.residual[row] = goal - here[row];
            for c in 0..KNOTS {
                out.jacobian[(row, row * KNOTS + c)] = position[c];
            }
        }
    }
    if target.heading_rad.is_none() && target.speed_mps.is_none() {
        return out;
    }
    let v = Vec2::new(apply(&velocity, &knots.first), apply(&velocity, &knots.second));
    let standing = model.turn_to.is_some();
    let heading = match target.heading_rad {
        Some(h) if !standing => wrap_angle(h - model.start.heading_rad),
        _ if v.norm() > 0.2 => v.y.atan2(v.x),
        _ => target.position.map_or(0.0, |p| {
            let p = model.to_local(p);
            p.y.atan2(p.x)
        }),
    };
    let along = v.dot(&direction(heading));
    let wanted = match target.speed_mps {
        Some(speed) => Some(speed),
        None if standing => Some(0.0),
        // With a fixed heading and a free speed, the end must move along the heading, so that the body
        // follows it.
        None if along < 0.4 => Some(0.5),
        None => None,
    };
    let (sin, cos) = heading.sin_cos();
    out.active[2] = true;
    out.residual[2] = -(-sin * v.x + cos * v.y);
    for c in 0..KNOTS {
        out.jacobian[(2, c)] = -sin * velocity[c];
        out.jacobian[(2, KNOTS + c)] = cos * velocity[c];
    }
    if let Some(wanted) = wanted {
        out.active[3] = true;
        out.residual[3] = wanted - along;
        for c in 0..KNOTS {
            out.jacobian[(3, c)] = cos * velocity[c];
            out.jacobian[(3, KNOTS + c)] = sin * velocity[c];
        }
    }
    out
}

/// Smallest whitened change from `wanted` that meets the linearised target.
fn gauss_newton_step<const ROWS: usize>(
    linear: &Linearized<ROWS>,
    residual: &SVector<f64, ROWS>,
    to_wanted: &Controls,
    free: &[bool; CONTROLS],
    whitening: &Whitening,
) -> Controls {
    let mut jacobian = linear.jacobian;
    let mut pull = *to_wanted;
    for c in 0..CONTROLS {
        if !free[c] {
            jacobian.column_mut(c).fill(0.0);
            pull[c] = 0.0;
        }
    }
    let white = whitening.whitened(&jacobian);
    let mut normal = white * white.transpose();
    let damping = 1e-6 * normal.trace() / ROWS as f64 + 1e-6;
    for row in 0..ROWS {
        normal[(row, row)] += damping + if linear.active[row] { 0.0 } else { 1.0 };
    }
    let wanted = residual - jacobian * pull;
    let Some(multipliers) = normal.cholesky().map(|c| c.solve(&wanted)) else { return pull };
    pull + whitening.colour(&(white.transpose() * multipliers))
}

fn pack(knots: &Knots) -> Controls {
    Controls::from_fn(|i, _| if i < KNOTS { knots.first[i] } else { knots.second[i - KNOTS] })
}

fn unpack(controls: &Controls) -> Knots {
    let mut knots = Knots::default();
    for i in 0..KNOTS {
        knots.first[i] = controls[i];
        knots.second[i] = controls[KNOTS + i];
    }
    knots
}

/// Knots that the limits moved back are fixed in the second half of a step.
fn inside(wanted: &Controls, legal: &Controls) -> [bool; CONTROLS] {
    std::array::from_fn(|i| (wanted[i] - legal[i]).abs() < 1e-12)
}

fn solve<const ROWS: usize>(
    model: &MotionModel,
    near: &Knots,
    first_guess: Knots,
    target: &Target,
    passes: &[Pass],
) -> Knots {
    let near = pack(near);
    let mut knots = model.legal(&first_guess);
    let whitening = Whitening::new(model, typical_speed(model, target));
    let everything = [true; CONTROLS];
    let mut linear: Linearized<ROWS> = linearise(model, &knots, target, passes);
    for iteration in 0..ITERATIONS {
        let norm = linear.norm();
        if norm < TOLERANCE {
            break;
        }
        let u = pack(&knots);
        let pull = if iteration + FREE_ITERATIONS < ITERATIONS { 1.0 } else { 0.0 };
        let to_wanted = (near - u) * pull;
        let wanted = u + gauss_newton_step(&linear, &linear.residual, &to_wanted, &everything, &whitening);
        let cut = pack(&model.legal(&unpack(&wanted)));
        let full = if (cut - wanted).amax() < 1e-9 {
            wanted
        } else {
            // Fix the knots that the limits cut, and let the others compensate.
            let free = inside(&wanted, &cut);
            let held = Controls::from_fn(|i, _| if free[i] { u[i] } else { cut[i] });
            let residual = linear.residual - linear.jacobian * (held - u);
            held + gauss_newton_step(&linear, &residual, &((near - held) * pull), &free, &whitening)
        };
        let mut best: Option<(Knots, Linearized<ROWS>)> = None;
        for length in [1.0, 0.4, 0.1] {
            let trial = model.legal(&unpack(&(u + (full - u) * length)));
            let trial_linear = linearise(model, &trial, target, passes);
            let trial_norm = trial_linear.norm();
            if trial_norm < best.as_ref().map_or(norm, |b| b.1.norm()) {
                best = Some((trial, trial_linear));
            }
            if trial_norm < 0.8 * norm || trial_norm < 2e-2 {
                break;
            }
        }
        match best {
            Some(better) => (knots, linear) = better,
            None if pull == 0.0 => break,
            None => {}
        }
    }
    knots
}

/// Speed that sets how much a curvature change counts, m/s.
fn typical_speed(model: &MotionModel, target: &Target) -> f64 {
    let v0 = model.start_speed_mps();
    let seconds = target.step as f64 * STEP_S;
    let mean = target.position.map_or(v0, |p| (p - model.start.position()).norm() / seconds);
    0.5 * (v0 + mean)
}

/// Length and curvature of the arc from the start through a local point, metres and 1/m.
fn arc_through(local: Vec2) -> (f64, f64) {
    let distance = local.norm();
    let bearing = local.y.atan2(local.x).clamp(-2.2, 2.2);
    if distance < 0.5 || bearing.abs() < 1e-3 {
        return (distance, 0.0);
    }
    (distance * bearing / bearing.sin(), 2.0 * bearing.sin() / distance.max(1.0))
}

/// Constant curvature through the goal with the acceleration that gets there in time.
fn arc_guess(model: &MotionModel, target: &Target) -> Knots {
    let Some(goal) = target.position else { return model.coasting() };
    let seconds = target.step as f64 * STEP_S;
    let (length, curvature) = arc_through(model.to_local(goal));
    let v0 = model.start_speed_mps();
    let mut knots = Knots { second: [if length > 1.5 { curvature } else { 0.0 }; KNOTS], ..Knots::default() };
    for (i, a) in knots.first.iter_mut().enumerate() {
        let t = i as f64 * KNOT_S;
        *a = match target.speed_mps {
            Some(v) => {
                let slope = ((v - v0) * seconds / 2.0 - (length - v0 * seconds)) * 12.0 / seconds.powi(3);
                (v - v0 - slope * seconds * seconds / 2.0) / seconds + slope * t
            }
            None => {
                let constant = 2.0 * (length - v0 * seconds) / (seconds * seconds);
                // Stopping short: brake to rest at the goal rather than roll back from beyond it.
                if v0 + constant * seconds < 0.0 { -v0 * v0 / (2.0 * length).max(0.3) } else { constant }
            }
        };
    }
    model.legal(&knots)
}

/// Knots fitted to a cubic curve from the start to the goal pose; `bulge` scales its tangents.
fn curve_guess(model: &MotionModel, target: &Target, bulge: f64) -> Knots {
    let Some(goal) = target.position else { return arc_guess(model, target) };
    let start = model.start.position();
    let (length, curvature) = arc_through(model.to_local(goal));
    let heading0 = model.start.heading_rad;
    let heading1 = target.heading_rad.unwrap_or(heading0 + curvature * length);
    let (m0, m1) = (direction(heading0) * length * bulge, direction(heading1) * length * bulge);
    let mut samples = Vec::with_capacity(18);
    let mut last = start;
    for i in 1..=18 {
        let f = i as f64 / 18.0;
        let (f2, f3) = (f * f, f * f * f);
        let p = start * (2.0 * f3 - 3.0 * f2 + 1.0)
            + m0 * (f3 - 2.0 * f2 + f)
            + goal * (3.0 * f2 - 2.0 * f3)
            + m1 * (f3 - f2);
        let step = ((target.step * i) as f64 / 18.0).round() as usize;
        let chord = p - last;
        last = p;
        if samples.last().is_none_or(|s: &Sampled| s.step < step) && step > 0 {
            samples.push(Sampled { step, position: p, heading_rad: chord.y.atan2(chord.x) });
        }
    }
    fit(model, &samples, Smoothing::WISHED)
}

/// Which limit keeps `target` out of reach, and the value that it would need.
fn explain(model: &MotionModel, knots: &Knots, target: &Target) -> (Limiting, Option<f64>) {
    let seconds = target.step as f64 * STEP_S;
    let v0 = model.start_speed_mps();
    let l = &model.limits;
    if let Some(goal) = target.position {
        let local = model.to_local(goal);
        let distance = match model.kind {
            MotionKind::Drive => arc_through(local).0,
            MotionKind::Walk => local.norm(),
        };
        let to_top = ((l.speed_mps - v0) / l.accel_mps2).clamp(0.0, seconds);
        let farthest =
            v0 * seconds + 0.5 * l.accel_mps2 * to_top * to_top + (seconds - to_top) * l.accel_mps2 * to_top;
        let to_rest = (v0 / l.brake_mps2).min(seconds);
        let shortest = v0 * to_rest - 0.5 * l.brake_mps2 * to_rest * to_rest;
        if distance > farthest {
            let needs = 2.0 * (distance - v0 * seconds) / (seconds * seconds);
            return if distance > l.speed_mps * seconds {
                (Limiting::Speed, Some(distance / seconds))
            } else {
                (Limiting::Acceleration, Some(needs))
            };
        }
        if distance < shortest {
            return (Limiting::Braking, Some(v0 * v0 / (2.0 * distance.max(0.1))));
        }
    }
    if let Some(v) = target.speed_mps {
        let rate = (v - v0) / seconds;
        if v > l.speed_mps.max(v0) {
            return (Limiting::Speed, Some(v));
        }
        if rate > l.accel_mps2 {
            return (Limiting::Acceleration, Some(rate));
        }
        if -rate > l.brake_mps2 {
            return (Limiting::Braking, Some(-rate));
        }
    }
    if model.kind == MotionKind::Walk {
        return (Limiting::Acceleration, None);
    }
    explain_turn(model, knots, target)
}

/// For a target that neither distance nor speed puts out of reach. The turn is the cause, by grip or by
/// steering lock, unless the knots are at an acceleration bound.
fn explain_turn(model: &MotionModel, knots: &Knots, target: &Target) -> (Limiting, Option<f64>) {
    let l = &model.limits;
    let (grip, wheels) = curvature_cut(model, knots, target.step);
    let at = |bound: f64| knots.first.iter().filter(|a| (**a - bound).abs() < 1e-6).count();
    let curvature = target.position.map(|p| arc_through(model.to_local(p)).1.abs());
    if wheels == 0.0 && grip == 0.0 && at(l.accel_mps2) > 2 {
        (Limiting::Acceleration, None)
    } else if wheels == 0.0 && grip == 0.0 && at(-l.brake_mps2) > 1 {
        (Limiting::Braking, None)
    } else if grip > wheels {
        let speed = typical_speed(model, target);
        (Limiting::Lateral, curvature.map(|k| speed * speed * k).filter(|a| *a > l.lateral_mps2))
    } else {
        (Limiting::Curvature, curvature.filter(|k| *k > l.curvature_per_m))
    }
}
