//! Cut-in: a vehicle in a neighbouring lane moves close ahead of another.

use super::figure::{FigureDraw, TemplateFigure};
use super::stage::Stage;
use super::{Pairing, Plan, on_step};

/// Lowest speed of both, m/s.
const LEAST_SPEED_MPS: f64 = 3.0;
/// Lateral distance between neighbouring lanes, metres.
const ACROSS_M: (f64, f64) = (2.2, 5.5);
/// Greatest difference of their headings, radians.
const ALIKE_RAD: f64 = 0.35;
/// Range of its initial position relative to the other, metres ahead.
const ALONG_M: (f64, f64) = (-15.0, 35.0);
/// Gap behind it at the end, metres.
const GAP_M: TemplateFigure = TemplateFigure { name: "gap_m", drawn: (1.5, 6.0), allowed: (0.1, 50.0) };
/// Duration of the manoeuvre, seconds.
const TAKES_S: TemplateFigure = TemplateFigure { name: "takes_s", drawn: (2.0, 4.5), allowed: (0.5, 9.0) };
/// Its final speed as a share of the other's.
const SPEED_SHARE: TemplateFigure =
    TemplateFigure { name: "speed_share", drawn: (0.7, 1.0), allowed: (0.0, 1.5) };
/// Drawn figures.
pub(super) const FIGURES: [TemplateFigure; 3] = [TAKES_S, GAP_M, SPEED_SHARE];
/// Its mean speed on the way: factors of its present speed, and an addition, m/s.
const PACE: (f64, f64) = (0.5, 1.4);
const PACE_MORE_MPS: f64 = 2.0;

/// Pairs side by side, with no road edge between them and room ahead of the second.
pub(super) fn roles(stage: &Stage<'_>) -> Vec<Pairing> {
    let drivers = &stage.drivers;
    let mut roles = Vec::new();
    for (other, before) in drivers.iter().enumerate().filter(|(_, d)| d.speed_mps() >= LEAST_SPEED_MPS) {
        let room_m = stage.leader(other).map_or(f64::INFINITY, |(_, gap_m)| gap_m);
        for (actor, driver) in drivers.iter().enumerate() {
            let place = before.place_of(driver.state.position(), driver.state.heading_rad);
            let across = (ACROSS_M.0..=ACROSS_M.1).contains(&place.left_m.abs());
            let along = (ALONG_M.0..=ALONG_M.1).contains(&place.ahead_m);
            let fits = actor != other
                && across
                && along
                && place.turn_rad.abs() < ALIKE_RAD
                && driver.speed_mps() >= LEAST_SPEED_MPS
                && room_m > driver.length_m() + 2.0 * GAP_M.drawn.1;
            let Some(beside) = before.pose_ahead(place.ahead_m).filter(|_| fits) else { continue };
            if !stage.graph.ground().crosses_an_edge(driver.state.position(), beside.position) {
                // The best pair needs neither catching up nor waiting.
                let ideal_m = before.length_m() + 4.0 + 3.0 * (before.speed_mps() - driver.speed_mps());
                let misfit = (place.ahead_m - ideal_m).abs();
                roles.push(Pairing { actor, other: Some(other), misfit, at_m: place.ahead_m, at_s: 0.0 });
            }
        }
    }
    roles
}

/// The place in the other's lane, ahead of the other's position at that time by the gap.
pub(super) fn plan(stage: &Stage<'_>, role: &Pairing, draw: &mut FigureDraw<'_>) -> Option<Plan> {
    let (driver, before) = (&stage.drivers[role.actor], &stage.drivers[role.other?]);
    let after_s = on_step(draw.value(&TAKES_S));
    let gap_m = draw.value(&GAP_M);
    let share = draw.value(&SPEED_SHARE);
    let other_m = before.advance_m(stage.start_step, after_s);
    let goal_m = other_m + 0.5 * (driver.length_m() + before.length_m()) + gap_m;
    let pace = (goal_m - role.at_m) / after_s;
    let speed = driver.speed_mps();
    let can = pace >= PACE.0 * speed && pace <= PACE.1 * speed + PACE_MORE_MPS;
    let speed_mps = share * before.speed_mps();
    let words = format!(
        "{} leaves its lane and is {gap_m:.1} m ahead of {} after {after_s:.1} s, at {speed_mps:.1} m/s; {} drives at {:.1} m/s",
        driver.agent.id,
        before.agent.id,
        before.agent.id,
        before.speed_mps(),
    );
    let pose = before.pose_ahead(goal_m).filter(|_| can)?;
    Some(Plan { pose, speed_mps, after_s, words })
}
