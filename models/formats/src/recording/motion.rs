//! States at the steps of a scene out of samples at any times.

use super::RecordedState;
use crate::frame::{Frame, wrapped};
use scene::{STEP_S, State, Track, Vec2, wrap_angle};

/// Times this far from a step are the step's, seconds.
const SAME_S: f64 = 2e-3;
/// Longest time between two samples that is filled, seconds, however rarely the file has samples.
const MAX_FILLED_S: f64 = 2.0;
/// Two samples are not further apart than this many times the usual spacing where motion is filled in.
const USUAL: f64 = 1.5;
/// Below this speed motion gives no heading, m/s.
const HEADED_MPS: f64 = 0.5;
/// Faster than this is a jump, m/s.
const JUMP_MPS: f64 = 100.0;

/// Values derived because the file lacks them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Derived {
    pub headings: bool,
    pub velocities: bool,
}

/// The spacing that most samples have, seconds; zero where there is none.
pub(super) fn spacing_s<'a>(users: impl Iterator<Item = &'a [RecordedState]>) -> f64 {
    let mut gaps: Vec<f64> = users
        .flat_map(|samples| samples.windows(2).map(|w| w[1].time_s - w[0].time_s))
        .filter(|gap| *gap > 1e-6)
        .take(100_000)
        .collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / 2).copied().unwrap_or(0.0)
}

/// The step that a time is at, if it is at one.
pub(super) fn step_at(time_s: f64, start_s: f64) -> Option<i64> {
    let step = ((time_s - start_s) / STEP_S).round();
    ((time_s - start_s - step * STEP_S).abs() <= SAME_S).then_some(step as i64)
}

/// Fills in headings and velocities that are missing, from the way that was gone. Samples are sorted by time.
pub(super) fn complete(samples: &mut [RecordedState], spacing_s: f64) -> Derived {
    let seen: Vec<usize> = (0..samples.len()).filter(|i| samples[*i].is_seen()).collect();
    let mut derived = Derived::default();
    let near = |a: &RecordedState, b: &RecordedState| b.time_s - a.time_s <= USUAL * spacing_s.max(STEP_S);
    for (k, &i) in seen.iter().enumerate() {
        if samples[i].velocity.iter().all(|v| v.is_finite()) {
            continue;
        }
        derived.velocities = true;
        let before = k.checked_sub(1).map(|k| samples[seen[k]]).filter(|b| near(b, &samples[i]));
        let after = seen.get(k + 1).map(|n| samples[*n]).filter(|a| near(&samples[i], a));
        let (from, to) = (before.unwrap_or(samples[i]), after.unwrap_or(samples[i]));
        let time_s = to.time_s - from.time_s;
        let velocity = if time_s > 0.0 { (to.at - from.at) / time_s } else { Vec2::zeros() };
        samples[i].velocity = if velocity.norm() < JUMP_MPS { velocity } else { Vec2::zeros() };
    }
    let way = |s: &RecordedState| (s.velocity.norm() > HEADED_MPS).then(|| s.velocity.y.atan2(s.velocity.x));
    let mut known: Option<f64> = None;
    for &i in &seen {
        if samples[i].heading_rad.is_nan() {
            derived.headings = true;
            samples[i].heading_rad = way(&samples[i]).or(known).unwrap_or(f64::NAN);
        }
        known = Some(samples[i].heading_rad).filter(|h| h.is_finite()).or(known);
    }
    // A road user that stands at first gets the heading of its later motion; one that never moves, +x.
    let mut next = 0.0;
    for &i in seen.iter().rev() {
        if samples[i].heading_rad.is_nan() {
            samples[i].heading_rad = next;
        }
        next = samples[i].heading_rad;
    }
    derived
}

/// States at the steps of a scene that begins at `start_s`, and whether any of them lies between samples. Heights
/// come with it where all samples have one.
pub(super) fn track(
    samples: &[RecordedState],
    start_s: f64,
    steps: usize,
    spacing_s: f64,
    frame: Frame,
) -> (Track, bool) {
    let end_s = start_s + steps as f64 * STEP_S;
    let first = samples.partition_point(|s| s.time_s < start_s - SAME_S).saturating_sub(1);
    let mut slots: Vec<Option<RecordedState>> = Vec::new();
    let (mut first_step, mut filled) = (None, false);
    let longest_s = (USUAL * spacing_s).min(MAX_FILLED_S);
    let mut put = |step: i64, sample: RecordedState| {
        let Some(step) = usize::try_from(step).ok().filter(|step| *step < steps) else { return };
        let first = *first_step.get_or_insert(step);
        let Some(slot) = step.checked_sub(first) else { return };
        if slots.len() <= slot {
            slots.resize(slot + 1, None);
        }
        slots[slot] = Some(sample);
    };
    let tail = samples.get(first..).unwrap_or_default();
    for (i, a) in tail.iter().enumerate().take_while(|(_, a)| a.time_s < end_s) {
        let at = step_at(a.time_s, start_s);
        if let Some(step) = at {
            put(step, *a);
        }
        let Some(b) = tail.get(i + 1) else { continue };
        let gap_s = b.time_s - a.time_s;
        // An unseen sample ends the motion; so does a pause.
        if !(a.is_seen() && b.is_seen() && gap_s > STEP_S / 50.0 && gap_s <= longest_s.max(STEP_S / 2.0)) {
            continue;
        }
        let mut step = ((a.time_s - start_s + SAME_S) / STEP_S).floor() as i64 + 1;
        while start_s + step as f64 * STEP_S < b.time_s - SAME_S {
            filled = true;
            put(step, between(a, b, start_s + step as f64 * STEP_S));
            step += 1;
        }
    }
    let z_known = slots.iter().flatten().any(|s| s.z_m.is_finite());
    let z_m = z_known.then(|| {
        let height = |s: &Option<RecordedState>| s.map_or(0.0, |s| frame.height_back(finite(s.z_m)));
        slots.iter().map(height).collect()
    });
    let states = slots.iter().map(|s| s.filter(RecordedState::is_seen).map(|s| state(&s, frame))).collect();
    (Track { first_step: first_step.unwrap_or(0), states, z_m }, filled)
}

fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

/// A sample as a state of the scene.
pub(super) fn state(sample: &RecordedState, frame: Frame) -> State {
    let (at, v) = (frame.place_back(sample.at), frame.turn_back(sample.velocity));
    let heading_rad = frame.heading_back(wrapped(sample.heading_rad));
    State { x_m: at.x, y_m: at.y, heading_rad, vx_mps: v.x, vy_mps: v.y }
}

/// A cubic through two samples, with velocities bounded so that the motion never runs backwards (Fritsch and
/// Carlson 1980, the square of side 3).
fn between(a: &RecordedState, b: &RecordedState, time_s: f64) -> RecordedState {
    let whole_s = b.time_s - a.time_s;
    let u = ((time_s - a.time_s) / whole_s).clamp(0.0, 1.0);
    let way = b.at - a.at;
    let tangent = |v: Vec2| {
        let tangent = v * whole_s;
        let most = 3.0 * way.norm();
        if tangent.norm() > most { tangent * (most / tangent.norm()) } else { tangent }
    };
    let (u2, u3) = (u * u, u * u * u);
    let at = a.at
        + way * (3.0 * u2 - 2.0 * u3)
        + tangent(a.velocity) * (u3 - 2.0 * u2 + u)
        + tangent(b.velocity) * (u3 - u2);
    let turn = wrap_angle(b.heading_rad - a.heading_rad);
    RecordedState {
        time_s,
        at,
        heading_rad: wrap_angle(a.heading_rad + turn * u),
        velocity: a.velocity + (b.velocity - a.velocity) * u,
        z_m: a.z_m + (b.z_m - a.z_m) * u,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Origin;

    fn sample(time_s: f64, x: f64, speed: f64) -> RecordedState {
        let (at, velocity) = (Vec2::new(x, 0.0), Vec2::new(speed, 0.0));
        RecordedState { time_s, at, heading_rad: 0.0, velocity, z_m: f64::NAN }
    }

    fn frame() -> Frame {
        Frame::of(&Origin::default())
    }

    #[test]
    fn samples_at_steps_stay_and_gaps_stay_open() {
        let list = [sample(0.0, 0.0, 10.0), sample(0.1, 1.0, 10.0), sample(0.4, 4.0, 10.0)];
        let (track, filled) = track(&list, 0.0, 10, 0.1, frame());
        assert!(!filled);
        assert_eq!(track.valid_steps().collect::<Vec<_>>(), [0, 1, 4]);
        assert_eq!(track.at(4).map(|s| s.x_m), Some(4.0));
    }

    #[test]
    fn steady_motion_at_25_hertz_is_found_at_steps() {
        let list: Vec<RecordedState> =
            (0..=25).map(|i| sample(f64::from(i) * 0.04, f64::from(i) * 0.4, 10.0)).collect();
        let (track, filled) = track(&list, 0.0, 11, 0.04, frame());
        assert!(filled);
        for (i, state) in track.states.iter().enumerate() {
            assert!((state.unwrap().x_m - i as f64).abs() < 1e-9);
        }
        assert_eq!(track.states.len(), 11);
    }

    #[test]
    fn headings_and_velocities_come_from_the_way() {
        let unknown = |t: f64, x: f64, y: f64| RecordedState {
            at: Vec2::new(x, y),
            heading_rad: f64::NAN,
            velocity: Vec2::new(f64::NAN, f64::NAN),
            ..sample(t, 0.0, 0.0)
        };
        let mut list =
            [unknown(0.0, 0.0, 0.0), unknown(0.1, 0.0, 0.0), unknown(0.2, 0.0, 1.0), unknown(0.3, 0.0, 2.0)];
        let derived = complete(&mut list, 0.1);
        assert!(derived.headings && derived.velocities);
        assert!((list[3].velocity.y - 10.0).abs() < 1e-9 && (list[2].velocity.y - 10.0).abs() < 1e-9);
        assert!(list.iter().all(|s| (s.heading_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-9));
    }
}
