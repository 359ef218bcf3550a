//! Hard braking: a vehicle with a follower brakes to a stop.

use super::figure::{FigureDraw, TemplateFigure};
use super::stage::Stage;
use super::{Pairing, Plan, on_step};

/// Lowest speed of both, m/s.
const LEAST_SPEED_MPS: f64 = 4.0;
/// Greatest distance of the follower, metres.
const FARTHEST_M: f64 = 50.0;
/// Greatest time headway of the follower, seconds.
const FARTHEST_S: f64 = 4.0;
/// Range of the drawn braking, m/s2: from firm to what a car can do on a dry road.
const BRAKING_MPS2: TemplateFigure =
    TemplateFigure { name: "braking_mps2", drawn: (3.5, 7.5), allowed: (0.5, 9.0) };
/// Time until the braking begins, seconds.
const BEGINS_S: TemplateFigure = TemplateFigure { name: "begins_s", drawn: (0.2, 1.5), allowed: (0.0, 8.0) };
/// Drawn figures.
pub(super) const FIGURES: [TemplateFigure; 2] = [BRAKING_MPS2, BEGINS_S];

/// Each leader with its follower, if the time gap is small enough.
pub(super) fn roles(stage: &Stage<'_>) -> Vec<Pairing> {
    let drivers = &stage.drivers;
    let role = |follower: usize| {
        let speed = drivers[follower].speed_mps();
        let (leader, gap_m) = stage.leader(follower)?;
        let fast = speed.min(drivers[leader].speed_mps()) >= LEAST_SPEED_MPS;
        let gap_s = gap_m / speed.max(0.1);
        let close = gap_m > 0.0 && gap_m <= FARTHEST_M && gap_s <= FARTHEST_S;
        (fast && close).then_some(Pairing {
            actor: leader,
            other: Some(follower),
            misfit: gap_s,
            at_m: gap_m,
            at_s: 0.0,
        })
    };
    (0..drivers.len()).filter_map(role).collect()
}

/// The place where it stands after constant braking.
pub(super) fn plan(stage: &Stage<'_>, role: &Pairing, draw: &mut FigureDraw<'_>) -> Option<Plan> {
    let driver = &stage.drivers[role.actor];
    let follower = &stage.drivers[role.other?];
    let braking = draw.value(&BRAKING_MPS2);
    let begins_s = draw.value(&BEGINS_S);
    let speed = driver.speed_mps();
    let after_s = on_step(begins_s + speed / braking);
    // The time is rounded to a step, so the distance is computed from the rounded time.
    let distance_m = speed * begins_s + 0.5 * speed * (after_s - begins_s);
    let words = format!(
        "{} drives at {speed:.1} m/s and brakes at {braking:.1} m/s2 to a stand after {after_s:.1} s and \
         {distance_m:.0} m; {} is {:.0} m behind at {:.1} m/s",
        driver.agent.id,
        follower.agent.id,
        role.at_m,
        follower.speed_mps(),
    );
    Some(Plan { pose: driver.pose_ahead(distance_m)?, speed_mps: 0.0, after_s, words })
}
