//! Events that the places of a recording confirm. Velocities and boxes of recordings have outliers, above all of road users
//! that stand.

use scene::score::Actor;
use scene::score::pairs::Measures;
use scene::score::report::Stretch;
use scene::{STEP_S, State};

/// No road user brakes or steers harder, m/s2.
const HARDEST_MPS2: f64 = 10.0;
/// Speeds are measured by the places over this time, steps.
const WINDOW: usize = 5;
/// One that brakes or steers drives at least so fast, m/s.
const DRIVES_MPS: f64 = 3.0;
/// Braking takes at least this from the speed, m/s.
const LOSES_MPS: f64 = 2.0;

/// Could braking still avoid the collision of a near miss? Else a box was not where the recording has it.
pub(super) fn is_avoidable(measures: &Measures) -> bool {
    measures.drac_mps2.is_none_or(|drac_mps2| drac_mps2 <= HARDEST_MPS2)
}

/// The places show the braking: from at least 3 m/s, and by at least 2 m/s.
pub(super) fn brakes(actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let (first, last) = (step(stretch.time_s), step(stretch.until_s));
    let before = first.checked_sub(WINDOW).and_then(|from| speed_mps(actor, from));
    let (Some(before), Some(after)) = (before, speed_mps(actor, last)) else { return false };
    is_possible(stretch) && before >= DRIVES_MPS && before - after >= LOSES_MPS
}

/// The places show that it drives while it steers.
pub(super) fn steers(actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let drives = speed_mps(actor, step(stretch.time_s)).is_some_and(|speed| speed >= DRIVES_MPS);
    is_possible(stretch) && drives
}

fn is_possible(stretch: &Stretch) -> bool {
    stretch.worst.is_some_and(|worst| worst <= HARDEST_MPS2)
}

fn step(time_s: f64) -> usize {
    // Times of a score are not negative.
    (time_s / STEP_S).round() as usize
}

/// Mean speed of the places from a step on.
fn speed_mps(actor: &Actor<'_>, from: usize) -> Option<f64> {
    let place = |step| actor.state(step).map(State::position);
    Some((place(from + WINDOW)? - place(from)?).norm() / (WINDOW as f64 * STEP_S))
}
