//! Via points between a draft and its motion. The draft is steered to them. After the fit to ten knots and
//! the limits, the motion is projected through them.

use super::slot::Slot;
use crate::features::agent::AgentPlan;
use crate::planning::{INSTANTS, PER_INSTANT};
use crate::tuning::fixed::via_steering::{GOAL_MISSED_M, KEEPS, NARROWS, PAST_M, SURE};
use scene::motion::{Knots, MotionModel, Pass, Projection, Target, TargetError, project, project_through};
use scene::via::passings;
use scene::{HORIZON_STEPS, STEP_S, State, Vec2, Via};

/// Most projections onto the via points. Each one moves the passing places, so they are searched again.
const ROUNDS: usize = 4;

/// Progress and offset at the instants, steered to the via points. At a fixed time the progress is that of
/// the place. Near each via point the offset stays within its tolerance.
pub(super) fn steer_to_vias(
    plan: &AgentPlan,
    slot: Slot,
    mut coordinates: [(f64, f64); INSTANTS],
) -> [(f64, f64); INSTANTS] {
    let anchor = &plan.anchors[slot.index()];
    if anchor.passes_m.is_empty() {
        return coordinates;
    }
    in_time(plan, &anchor.passes_m, &mut coordinates);
    if let (None, Some(last_m)) = (plan.target.position, anchor.passes_m.last()) {
        // Adds a share of the base so that the progress ends beyond the last via point.
        let end_m = anchor.base[HORIZON_STEPS];
        let short_m = (last_m + PAST_M).min(end_m) - coordinates[INSTANTS - 1].0;
        if short_m > 0.0 && end_m > 0.0 {
            for (i, place) in coordinates.iter_mut().enumerate() {
                place.0 += short_m / end_m * anchor.base_at((i + 1) * PER_INSTANT);
            }
        }
    }
    for (along, across) in &mut coordinates {
        for (waypoint, at_m) in plan.vias.iter().zip(&anchor.passes_m) {
            let most_m = KEEPS * waypoint.via.tolerance_m + NARROWS * (*along - at_m).abs();
            *across = across.clamp(-most_m, most_m);
        }
    }
    coordinates
}

/// Shifts a progress so that it is at each timed via point at its time; between them the shift changes
/// linearly.
fn in_time(plan: &AgentPlan, passes_m: &[f64], coordinates: &mut [(f64, f64); INSTANTS]) {
    let wanted = coordinates.map(|place| place.0);
    let along_at = |step: usize| {
        let (i, part) = (step / PER_INSTANT, (step % PER_INSTANT) as f64 / PER_INSTANT as f64);
        let at = |i: usize| if i == 0 { 0.0 } else { wanted[i.min(INSTANTS) - 1] };
        at(i) + part * (at(i + 1) - at(i))
    };
    let mut shifts = vec![(0, 0.0)];
    for (waypoint, at_m) in plan.vias.iter().zip(passes_m) {
        shifts.extend(waypoint.step.map(|step| (step, at_m - along_at(step))));
    }
    let Some(&(last, shift)) = shifts.last().filter(|_| shifts.len() > 1) else { return };
    shifts.push(match plan.target.position {
        Some(_) => (plan.target.step.max(last + 1), 0.0),
        None => (HORIZON_STEPS.max(last + 1), shift),
    });
    let mut least_m = 0.0_f64;
    for (i, place) in coordinates.iter_mut().enumerate() {
        let step = (i + 1) * PER_INSTANT;
        let shift = match shifts.windows(2).find(|w| step <= w[1].0) {
            Some(w) => w[0].1 + (w[1].1 - w[0].1) * (step - w[0].0) as f64 / (w[1].0 - w[0].0) as f64,
            None => shifts.last().map_or(0.0, |s| s.1),
        };
        place.0 = (place.0 + shift).max(least_m);
        least_m = place.0;
    }
}

/// Via points of the plan that a motion misses.
pub(super) fn vias_missed(plan: &AgentPlan, states: &[scene::motion::MotionState]) -> usize {
    if plan.vias.is_empty() {
        return 0;
    }
    let states: Vec<State> = states.iter().map(State::from).collect();
    let vias: Vec<Via> = plan.vias.iter().map(|w| w.via).collect();
    let passed = passings(&vias, 0.0, &states);
    vias.iter().zip(&passed).filter(|(via, passing)| !via.is_passed(passing)).count()
}

/// The motion nearest to these knots that meets the target and passes the plan's via points, as far as the
/// limits allow.
pub(super) fn projected(plan: &AgentPlan, model: &MotionModel, knots: &Knots, target: &Target) -> Projection {
    let first = project(model, knots, target, None);
    if plan.vias.is_empty() || !plan.projected {
        return first;
    }
    let mut now = Tried::of(plan, first, target);
    let mut best: Option<Tried> = None;
    for _ in 0..ROUNDS {
        if now.sure {
            return now.motion;
        }
        let next = project_through(model, knots, &now.motion.knots, target, &now.passes);
        let next = Tried::of(plan, next, target);
        let before = std::mem::replace(&mut now, next);
        if best.as_ref().is_none_or(|best| before.cost < best.cost) {
            best = Some(before);
        }
    }
    match best {
        Some(best) if best.cost <= now.cost => best.motion,
        _ => now.motion,
    }
}

/// A motion, how it passes the via points, and the constraints of the next projection.
struct Tried {
    motion: Projection,
    /// All via points are passed well within their tolerance.
    sure: bool,
    /// Distances to missed via points, metres, with a penalty for each of them and a larger one for a missed goal.
    cost: f64,
    passes: Vec<Pass>,
}

impl Tried {
    fn of(plan: &AgentPlan, motion: Projection, target: &Target) -> Self {
        let states: Vec<State> = motion.trajectory.iter().map(State::from).collect();
        let vias: Vec<Via> = plan.vias.iter().map(|w| w.via).collect();
        let last = if target.position.is_some() { target.step.saturating_sub(1) } else { HORIZON_STEPS };
        let (mut sure, mut passes) = (true, Vec::with_capacity(vias.len()));
        let off = TargetError::of(&motion.trajectory[target.step], target);
        let mut cost = if off.is_met() { 0.0 } else { GOAL_MISSED_M + off.position_m };
        for (waypoint, passing) in plan.vias.iter().zip(passings(&vias, 0.0, &states)) {
            let via = &waypoint.via;
            let passed = via.is_passed(&passing);
            if !passed {
                cost += 1.0 + passing.distance_m;
            }
            sure &= passed && passing.distance_m <= SURE * via.tolerance_m;
            let nearest = (passing.time_s / STEP_S).round() as usize;
            let step = waypoint.step.unwrap_or(nearest).clamp(1, last.max(1));
            let state = &motion.trajectory[step];
            let ahead = Vec2::new(state.heading_rad.cos(), state.heading_rad.sin());
            // A motion that reaches the via point may pass it at any time; any other motion is moved there.
            let comes = (via.position - passing.place).dot(&ahead).abs() < KEEPS * via.tolerance_m;
            let free = waypoint.step.is_none() && comes;
            let here = if free { passing.place } else { state.position };
            let off = here - via.position;
            let kept = (KEEPS * via.tolerance_m / off.norm().max(1e-9)).min(1.0);
            passes.push(Pass {
                step,
                position: via.position + off * kept,
                across_rad: free.then_some(state.heading_rad),
            });
        }
        Self { motion, sure, cost, passes }
    }
}
