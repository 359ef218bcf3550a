//! Samples of road users at the source's times, and their states at a scene's steps.

use scene::geometry::direction;
use scene::{STEP_S, State, Track, Vec2, wrap_angle};

/// Longest time between two samples that is interpolated, seconds: SUMO's default step is 1 s.
pub(super) const MAX_FILLED_S: f64 = 2.0;
/// Times nearer than this are equal, seconds; SUMO writes two digits.
pub(super) const SAME_S: f64 = 1e-4;

/// Recorded state at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FcdState {
    /// Index of the source's time step.
    pub step: u64,
    pub time_s: f64,
    /// Centre of the box, metres, network frame.
    pub centre: Vec2,
    pub heading_rad: f64,
    pub speed_mps: f64,
}

impl FcdState {
    fn state(&self, origin: Vec2) -> State {
        let (at, v) = (self.centre - origin, direction(self.heading_rad) * self.speed_mps);
        State { x_m: at.x, y_m: at.y, heading_rad: self.heading_rad, vx_mps: v.x, vy_mps: v.y }
    }
}

/// Motion between two samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Between {
    /// Motion.
    Motion,
    /// The road user was away, or the samples are too far apart in time.
    Gap,
    /// The road user was moved elsewhere.
    Jump,
}

/// Classifies the motion between two consecutive samples.
pub(super) fn between(a: &FcdState, b: &FcdState) -> Between {
    let time_s = b.time_s - a.time_s;
    if b.step != a.step + 1 || time_s > MAX_FILLED_S + SAME_S {
        return Between::Gap;
    }
    // A lane change may be a jump of one lane width; a larger displacement is not driving.
    let farthest_m = 1.5 * a.speed_mps.max(b.speed_mps) * time_s + 5.0;
    if (b.centre - a.centre).norm() > farthest_m { Between::Jump } else { Between::Motion }
}

/// The state at a time between two samples: a cubic with the recorded directions and speeds, limited so that
/// the motion is never backwards (Fritsch and Carlson 1980, the square of side 3).
fn filled(a: &FcdState, b: &FcdState, time_s: f64, origin: Vec2) -> State {
    let whole_s = b.time_s - a.time_s;
    let u = ((time_s - a.time_s) / whole_s).clamp(0.0, 1.0);
    let way = b.centre - a.centre;
    let tangent = |s: &FcdState| direction(s.heading_rad) * (s.speed_mps * whole_s).min(3.0 * way.norm());
    let (u2, u3) = (u * u, u * u * u);
    let centre =
        a.centre + way * (3.0 * u2 - 2.0 * u3) + tangent(a) * (u3 - 2.0 * u2 + u) + tangent(b) * (u3 - u2);
    let turn = wrap_angle(b.heading_rad - a.heading_rad);
    let heading_rad = wrap_angle(a.heading_rad + turn * u);
    let speed_mps = a.speed_mps + (b.speed_mps - a.speed_mps) * u;
    FcdState { step: a.step, time_s, centre, heading_rad, speed_mps }.state(origin)
}

/// States at `steps` steps from `start_s`; `None` while the road user was not seen. Steps at times of the
/// source keep its values.
pub(super) fn track(samples: &[FcdState], start_s: f64, steps: usize, origin: Vec2) -> Track {
    let at = |step: usize| {
        let time_s = start_s + step as f64 * STEP_S;
        let next = samples.partition_point(|s| s.time_s < time_s - SAME_S);
        let b = samples.get(next)?;
        if b.time_s <= time_s + SAME_S {
            return Some(b.state(origin));
        }
        let a = samples.get(next.checked_sub(1)?)?;
        (between(a, b) == Between::Motion).then(|| filled(a, b, time_s, origin))
    };
    let mut states: Vec<Option<State>> = (0..steps).map(at).collect();
    let first_step = states.iter().position(Option::is_some).unwrap_or(steps);
    let end = states.iter().rposition(Option::is_some).map_or(first_step, |last| last + 1);
    states.truncate(end);
    Track { first_step, states: states.split_off(first_step.min(end)), z_m: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(step: u64, x: f64, speed_mps: f64) -> FcdState {
        let centre = Vec2::new(x, 0.0);
        FcdState { step, time_s: step as f64, centre, heading_rad: 0.0, speed_mps }
    }

    #[test]
    fn steady_motion_is_filled_exactly() {
        let track = track(&[sample(0, 0.0, 10.0), sample(1, 10.0, 10.0)], 0.0, 91, Vec2::new(1.0, 0.0));
        assert_eq!((track.first_step, track.states.len()), (0, 11));
        for (i, state) in track.states.iter().enumerate() {
            let state = state.unwrap();
            assert!((state.x_m - (i as f64 - 1.0)).abs() < 1e-9 && (state.vx_mps - 10.0).abs() < 1e-9);
        }
    }

    #[test]
    fn hard_braking_does_not_go_backwards() {
        let track = track(&[sample(0, 0.0, 10.0), sample(1, 1.0, 1.0)], 0.0, 11, Vec2::zeros());
        let x: Vec<f64> = track.states.iter().map(|s| s.unwrap().x_m).collect();
        assert!(x.windows(2).all(|w| w[1] >= w[0]), "{x:?}");
    }

    #[test]
    fn gaps_and_jumps_stay_open() {
        let far = [sample(0, 0.0, 1.0), sample(1, 1.0, 1.0), sample(3, 3.0, 1.0), sample(4, 80.0, 1.0)];
        let track = track(&far, 0.5, 40, Vec2::zeros());
        let seen: Vec<usize> = track.valid_steps().collect();
        assert_eq!(seen, [0, 1, 2, 3, 4, 5, 25, 35]);
        assert_eq!(between(&far[2], &far[3]), Between::Jump);
    }

    #[test]
    fn headings_turn_the_short_way() {
        let mut b = sample(1, 0.0, 0.0);
        b.heading_rad = -3.0;
        let a = FcdState { heading_rad: 3.0, ..sample(0, 0.0, 0.0) };
        let middle = track(&[a, b], 0.0, 11, Vec2::zeros()).states[5].unwrap();
        assert!(middle.heading_rad.abs() > 3.1);
    }
}
