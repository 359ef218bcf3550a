//! Rules of lanes for one vehicle: the speed limit, the heading at its end, and where the roads of the map end.

use super::input::{Actor, ScoreInput};
use super::report::{Stretch, stretches};
use super::road::{PARKED_M, drives};
use crate::geometry::direction;
use crate::{AgentType, STEP_S};

/// A shorter time above the limit is none, seconds.
pub(super) const SPEEDING_S: f64 = 1.0;
/// A vehicle that has slowed down by this much since the start is not speeding, m/s2: it was too fast already.
const SLOWING_MPS2: f64 = 0.5;
/// Cosine of the angle from which a lane leads elsewhere.
const ELSEWHERE: f64 = 0.5;
/// A lane that turns by more within this before or after the place is a bend, metres: its direction there says little.
const BEND_M: f64 = 4.0;

/// The step at which a motion ends: when its goal is due, else its last.
pub(crate) fn end_step(input: &ScoreInput<'_>, actor: &Actor<'_>) -> Option<usize> {
    let last = input.steps.clone().rev().find(|step| actor.state(*step).is_some())?;
    let due = actor.goal.time_s.filter(|_| actor.generated && actor.goal.position.is_some());
    let due = due.map_or(last, |time_s| (time_s / STEP_S).round().max(0.0) as usize);
    Some(due.clamp(input.steps.start, last))
}

/// The end of a vehicle's motion, where its heading is off the direction of every lane at its place; `worst` in
/// radians. Not where a lane bends or leads through a junction, in driveways, and where the user fixed the heading.
pub(crate) fn ends_askew(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    let asked = actor.generated && actor.goal.heading_rad.is_some();
    if !drives(actor) || asked || actor.travel_m(input.steps.clone()) < PARKED_M {
        return Vec::new();
    }
    let found = end_step(input, actor).and_then(|step| Some((step, actor.state(step)?)));
    let Some((step, state)) = found.filter(|(_, s)| !input.drivable.is_driveway(s.position())) else {
        return Vec::new();
    };
    let forward = direction(state.heading_rad);
    let mut least_rad: Option<f64> = None;
    let reach = [-BEND_M, 0.0, BEND_M].map(|m| state.position() + forward * m);
    for (lane, band) in reach.iter().flat_map(|point| input.drivable.vehicle_lanes(*point)) {
        if band.in_junction {
            return Vec::new();
        }
        let along = (lane.to - lane.from).normalize();
        let turn_rad = along.dot(&forward).abs().min(1.0).acos();
        least_rad = Some(least_rad.map_or(turn_rad, |least| least.min(turn_rad)));
    }
    let on_lane = input.drivable.vehicle_lanes(state.position()).next().is_some();
    let askew = least_rad.filter(|rad| on_lane && *rad > input.thresholds.askew_rad);
    askew.map(|rad| stretches(actor, &[(step, rad)])).unwrap_or_default()
}

/// Stretches of at least [`SPEEDING_S`] above the speed limit of every lane that leads the vehicle's way; `worst` in m/s
/// above the limit.
pub(crate) fn speeding(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if !drives(actor) {
        return Vec::new();
    }
    let (share, extra_mps) = (input.thresholds.speeding_share, input.thresholds.speeding_mps);
    let mut flagged: Vec<(usize, f64)> = Vec::new();
    let mut start: Option<(usize, f64)> = None;
    let mut fast_since_start = true;
    for step in input.steps.clone() {
        let Some(state) = actor.state(step) else { continue };
        let speed = state.speed_mps();
        let &mut (first, first_mps) = start.get_or_insert((step, speed));
        // Cheaper than the lanes, and no limit is lower.
        if speed <= extra_mps {
            fast_since_start = false;
            continue;
        }
        let forward = direction(state.heading_rad);
        let limits = input.drivable.vehicle_lanes(state.position()).filter_map(|(lane, band)| {
            let along = lane.to - lane.from;
            let leads = along.dot(&forward) >= ELSEWHERE * along.norm();
            band.speed_limit_mps.filter(|_| leads)
        });
        let limit = limits.reduce(f64::max);
        let above = limit.filter(|limit| speed > limit * (1.0 + share) + extra_mps);
        fast_since_start &= above.is_some();
        let slowed_to_mps = first_mps - SLOWING_MPS2 * STEP_S * (step - first) as f64;
        let slowing = fast_since_start && speed <= slowed_to_mps + 1e-9;
        if let Some(limit) = above.filter(|_| !slowing) {
            flagged.push((step, speed - limit));
        }
    }
    lasting(stretches(actor, &flagged), SPEEDING_S)
}

/// Stretches on wheels where the roads of the map have ended; `worst` in metres from the lanes.
pub(crate) fn off_map(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    let rides = actor.agent_type == AgentType::Cyclist || drives(actor);
    if !rides || input.drivable.is_unknown() {
        return Vec::new();
    }
    let away = |step| {
        let away_m = input.drivable.off_map_m(actor.state(step)?.position(), input.thresholds.off_map_m)?;
        Some((step, away_m))
    };
    let flagged: Vec<(usize, f64)> = input.steps.clone().filter_map(away).collect();
    stretches(actor, &flagged)
}

/// Those that last so long.
pub(super) fn lasting(mut stretches: Vec<Stretch>, seconds: f64) -> Vec<Stretch> {
    stretches.retain(|s| s.until_s - s.time_s >= seconds - 1e-6);
    stretches
}
