//! Failure to yield: a vehicle that would have to wait at a junction passes without stopping. It passes a red
//! signal or a stop sign, or crosses shortly before or after a vehicle with priority.

use super::figure::{FigureDraw, TemplateFigure};
use super::stage::{BEHIND_M, Driver, Stage};
use super::{Pairing, Plan, on_step};
use crate::{STEP_S, SignalState, Vec2};

/// Nearest stop line, metres from the road user's centre.
const NEAREST_M: f64 = 4.0;
/// Greatest distance of a stop line or crossing: seconds at the present speed, and metres in addition.
const FARTHEST_S: f64 = 5.0;
const FARTHEST_MORE_M: f64 = 12.0;
/// Greatest lateral distance of a line that belongs to the path, metres.
const BESIDE_M: f64 = 1.5;
/// Paths cross if they differ by at least this, radians.
const CROSSING_RAD: f64 = 0.5;
/// Another vehicle is on the path if its centre is nearer than this, metres.
const ON_THE_WAY_M: f64 = 1.0;
/// Distance of the goal beyond the place, metres.
const PAST_M: f64 = 8.0;
/// Time between the two at the crossing, seconds.
const APART_S: TemplateFigure = TemplateFigure { name: "apart_s", drawn: (0.5, 1.8), allowed: (0.0, 9.0) };
/// Drawn figures.
pub(super) const FIGURES: [TemplateFigure; 1] = [APART_S];
/// Lowest and highest speed at the place, m/s.
const SPEED_MPS: (f64, f64) = (5.0, 20.0);
/// Mean speed on the way: factors of its present speed, and an addition, m/s.
const PACE: (f64, f64) = (0.6, 1.5);
const PACE_MORE_MPS: f64 = 4.0;
/// Steps of the other motions that are searched for a crossing.
const LOOK_STEPS: usize = 80;

/// Vehicles that would have to wait at a line or for another vehicle.
pub(super) fn roles(stage: &Stage<'_>) -> Vec<Pairing> {
    let mut roles = Vec::new();
    for (actor, driver) in stage.drivers.iter().enumerate() {
        let reach_m = FARTHEST_S * driver.speed_mps() + FARTHEST_MORE_M;
        let line_m = must_stop_m(stage, driver).filter(|m| (NEAREST_M..=reach_m).contains(m));
        let before = roles.len();
        for (other, crosser) in stage.drivers.iter().enumerate().filter(|(i, _)| *i != actor) {
            let Some((at_m, at_s)) = crossing(stage, driver, crosser) else { continue };
            let own_s = at_m / driver.speed_mps().max(0.5);
            // Without a line the vehicle that arrives later waits.
            let waits = line_m.map_or(own_s > at_s, |line_m| at_m > line_m);
            if waits && at_m >= NEAREST_M && at_m <= reach_m + 25.0 {
                let misfit = (own_s - at_s).abs() + if line_m.is_some() { 0.0 } else { 4.0 };
                roles.push(Pairing { actor, other: Some(other), misfit, at_m, at_s });
            }
        }
        if let (true, Some(at_m)) = (roles.len() == before, line_m) {
            roles.push(Pairing { actor, other: None, misfit: 10.0 + 0.1 * at_m, at_m, at_s: 0.0 });
        }
    }
    roles
}

/// A goal beyond the place, reached about when the other vehicle is there.
pub(super) fn plan(stage: &Stage<'_>, role: &Pairing, draw: &mut FigureDraw<'_>) -> Option<Plan> {
    let driver = &stage.drivers[role.actor];
    let speed = driver.speed_mps();
    let apart_s = draw.value(&APART_S) * if draw.stream.chance(0.5) { 1.0 } else { -1.0 };
    let there_s = match role.other {
        Some(_) => role.at_s + apart_s,
        None => role.at_m / speed.clamp(SPEED_MPS.0 + 2.0, SPEED_MPS.1) * draw.stream.between(0.85, 1.15),
    };
    if there_s < 0.5 {
        return None;
    }
    let pace = role.at_m / there_s;
    let can = pace >= PACE.0 * speed && pace <= PACE.1 * speed + PACE_MORE_MPS;
    let speed_mps = (1.3 * pace - 0.3 * speed).clamp(SPEED_MPS.0, SPEED_MPS.1);
    let after_s = on_step(there_s + PAST_M / (0.5 * (pace + speed_mps)));
    let id = &driver.agent.id;
    let words = match role.other {
        Some(other) => format!(
            "{id} goes through without stopping, {:.1} s {} {}, {:.0} m on after {there_s:.1} s",
            apart_s.abs(),
            if apart_s > 0.0 { "after" } else { "before" },
            stage.drivers[other].agent.id,
            role.at_m,
        ),
        None => format!(
            "{id} goes past the stop line {:.0} m on after {there_s:.1} s without stopping",
            role.at_m
        ),
    };
    let pose = driver.pose_ahead(role.at_m + PAST_M).filter(|_| can)?;
    Some(Plan { pose, speed_mps, after_s, words })
}

/// Metres to the first line on its path at which it would have to stop.
fn must_stop_m(stage: &Stage<'_>, driver: &Driver<'_>) -> Option<f64> {
    let signals = stage.scene.signals.iter().filter_map(|signal| {
        let lane = stage.graph.lane_index(&signal.lane)?;
        let line = signal.stop.unwrap_or(stage.graph.lanes()[lane].path.first().position);
        let at_m = line_ahead_m(stage, driver, lane, line)?;
        let arrives = stage.start_step + (at_m / driver.speed_mps().max(1.0) / STEP_S) as usize;
        let closed = |state: SignalState| state.is_stop() || state.is_caution();
        closed(signal.last_known(arrives).0).then_some(at_m)
    });
    let signs = (0..stage.graph.lanes().len()).filter_map(|lane| {
        let path = &stage.graph.lanes()[lane].path;
        let at_s = stage.graph.lanes()[lane].stop_sign_m?;
        line_ahead_m(stage, driver, lane, path.position_at(at_s))
    });
    signals.chain(signs).min_by(f64::total_cmp)
}

/// Metres to a line of a lane, if the lane is on the driver's path.
fn line_ahead_m(stage: &Stage<'_>, driver: &Driver<'_>, lane: usize, line: Vec2) -> Option<f64> {
    let path = &stage.graph.lanes()[lane].path;
    // Lanes overlap where they fork; a point farther on shows which one is taken.
    let inside = path.sample((path.project(line).s_m + 0.5 * path.length_m()).min(path.length_m()));
    let taken = driver.place_of(inside.position, inside.heading_rad);
    let place = driver.place_of(line, inside.heading_rad);
    let on_way = place.left_m.abs() < BESIDE_M && taken.left_m.abs() < BESIDE_M && taken.same_way();
    (on_way && place.ahead_m > 0.0 && taken.ahead_m < driver.way.length_m() - BEHIND_M)
        .then_some(place.ahead_m)
}

/// Place and time at which another motion first crosses the driver's path.
fn crossing(stage: &Stage<'_>, driver: &Driver<'_>, crosser: &Driver<'_>) -> Option<(f64, f64)> {
    let steps = stage.start_step + 1..stage.start_step + LOOK_STEPS;
    steps.filter_map(|step| Some((step, crosser.shown.track.at(step)?))).find_map(|(step, state)| {
        let foot = driver.way.project(state.position());
        let place = driver.place_of(state.position(), state.heading_rad);
        let crosses = foot.distance_m < ON_THE_WAY_M
            && place.turn_rad.abs() > CROSSING_RAD
            && state.speed_mps() > crate::STANDING_MPS
            && place.ahead_m > 0.0;
        crosses.then(|| (place.ahead_m, (step - stage.start_step) as f64 * STEP_S))
    })
}
