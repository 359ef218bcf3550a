//! Checks events against the positions of a recording. Velocities and boxes of recordings have outliers,
//! mostly of standing road users.

use scene::score::pairs::Measures;
use scene::score::report::{RedLight, Stretch};
use scene::score::{Actor, ScoreInput};
use scene::{STEP_S, SignalState, State};

/// Greatest plausible braking or steering, m/s2.
const HARDEST_MPS2: f64 = 10.0;
/// Steps over which speeds are measured from positions.
const WINDOW: usize = 5;
/// Lowest speed of a road user that brakes or steers, m/s.
const DRIVES_MPS: f64 = 3.0;
/// Smallest loss of speed in braking, m/s.
const LOSES_MPS: f64 = 2.0;

/// Lowest closing speed before a collision, m/s, which excludes boxes that were drawn over each other.
const CLOSES_MPS: f64 = 1.0;
/// Shortest distance of a runner in a second, metres.
const RUNS_M: f64 = 2.0;
/// Delay of recorded signals, seconds: whole queues set off this long before their signal turns green.
const LIGHT_LAGS_S: f64 = 5.0;
/// Stretches of one road user with a shorter pause are one event, seconds.
const SAME_EVENT_S: f64 = 2.0;

/// Whether braking could still avoid the collision of a near miss. If not, a recorded box was wrong.
pub(super) fn is_avoidable(measures: &Measures) -> bool {
    measures.drac_mps2.is_none_or(|drac_mps2| drac_mps2 <= HARDEST_MPS2)
}

/// Whether the positions confirm the braking: from at least 3 m/s, and by at least 2 m/s.
pub(super) fn brakes(actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let (first, last) = (step(stretch.time_s), step(stretch.until_s));
    let before = first.checked_sub(WINDOW).and_then(|from| speed_mps(actor, from));
    let (Some(before), Some(after)) = (before, speed_mps(actor, last)) else { return false };
    is_possible(stretch) && before >= DRIVES_MPS && before - after >= LOSES_MPS
}

/// Whether the positions confirm that it moves while it steers.
pub(super) fn steers(actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let drives = speed_mps(actor, step(stretch.time_s)).is_some_and(|speed| speed >= DRIVES_MPS);
    is_possible(stretch) && drives
}

/// Whether the positions show that the two came nearer over the half second before.
pub(super) fn close_in(a: &Actor<'_>, b: &Actor<'_>, time_s: f64) -> bool {
    let apart_m = |step| Some((a.state(step)?.position() - b.state(step)?.position()).norm());
    let now = step(time_s);
    let before = now.checked_sub(WINDOW).and_then(apart_m);
    let closed_m = before.zip(apart_m(now)).map(|(before_m, now_m)| before_m - now_m);
    closed_m.is_some_and(|closed_m| closed_m >= CLOSES_MPS * WINDOW as f64 * STEP_S)
}

/// Whether the positions confirm that it runs.
pub(super) fn runs(actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let place = |step| actor.state(step).map(State::position);
    (step(stretch.time_s)..=step(stretch.until_s)).any(|from| {
        let ends = place(from).zip(place(from + 2 * WINDOW));
        ends.is_some_and(|(from, to)| (to - from).norm() >= RUNS_M)
    })
}

/// Whether the recorded signal does not turn green soon after.
pub(super) fn stays_red(input: &ScoreInput<'_>, red: &RedLight) -> bool {
    let first = step(red.time_s);
    let last = (first + step(LIGHT_LAGS_S)).min(input.steps.end);
    let goes = |state| matches!(state, SignalState::Go | SignalState::ArrowGo);
    let of_lane = input.signals.iter().filter(|signal| signal.lane == red.lane);
    of_lane.flat_map(|signal| (first..last).map(|step| signal.at(step))).all(|state| !goes(state))
}

/// Joins stretches of one road user with short pauses; the result is as bad as the worst of them.
pub(super) fn joined<'a>(stretches: impl Iterator<Item = &'a Stretch>) -> Vec<Stretch> {
    let mut all: Vec<Stretch> = Vec::new();
    for stretch in stretches {
        let follows = |earlier: &&mut Stretch| {
            earlier.agent == stretch.agent && stretch.time_s - earlier.until_s < SAME_EVENT_S
        };
        if let Some(earlier) = all.iter_mut().find(follows) {
            earlier.until_s = earlier.until_s.max(stretch.until_s);
            if stretch.worst > earlier.worst {
                earlier.worst = stretch.worst;
            }
        } else {
            all.push(stretch.clone());
        }
    }
    all
}

fn is_possible(stretch: &Stretch) -> bool {
    stretch.worst.is_some_and(|worst| worst <= HARDEST_MPS2)
}

fn step(time_s: f64) -> usize {
    // Times of a score are not negative.
    (time_s / STEP_S).round() as usize
}

/// Mean speed from the positions, from a step on.
fn speed_mps(actor: &Actor<'_>, from: usize) -> Option<f64> {
    let place = |step| actor.state(step).map(State::position);
    Some((place(from + WINDOW)? - place(from)?).norm() / (WINDOW as f64 * STEP_S))
}
