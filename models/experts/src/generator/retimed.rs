//! Anchors of a reacting road user: the path it has anyway, at other paces.

use crate::planning::MODES;
use crate::planning::anchors::{Anchor, PathKind};
use crate::planning::profile::Progress;
use crate::planning::world::AgentAtStart;
use scene::geometry::direction;
use scene::routes::Polyline;
use scene::{HORIZON_STEPS, STEP_S, State};

/// Shares of the speed it has that a reacting road user may fall back to.
const PACES: [f64; MODES] = [1.0, 0.75, 0.5, 0.25, 0.0, 1.2];
/// A shorter motion has no path to speak of, metres.
const SHORTEST_M: f64 = 2.0;
/// How far the path goes on straight after the motion's end, metres.
const TAIL_M: f64 = 40.0;
/// No speed limit that counts, m/s.
const NO_CAP_MPS: f64 = 60.0;
/// How fast it takes up another pace: braking and speeding up, m/s2.
const BRAKE_MPS2: f64 = 3.5;
const ACCELERATE_MPS2: f64 = 1.5;

/// Anchors along a motion at other paces; `None` for one that hardly moves.
pub(super) fn retimed_anchors(who: &AgentAtStart, states: &[State]) -> Option<Vec<Anchor>> {
    let mut points = vec![who.start.position()];
    points.extend(states.iter().map(State::position));
    let path = Polyline::new(points);
    if path.length_m() < SHORTEST_M {
        return None;
    }
    let last = states.last()?;
    let tail = last.position() + direction(last.heading_rad) * TAIL_M;
    let mut points = path.points().to_vec();
    points.push(tail);
    let path = Polyline::new(points).resample(1.0);
    let speeds: Vec<f64> =
        (0..HORIZON_STEPS).map(|i| states.get(i).map_or(last.speed_mps(), State::speed_mps)).collect();
    let anchors = PACES.iter().enumerate().map(|(timing, pace)| Anchor {
        base: at_pace(who.start.speed_mps(), &speeds, *pace),
        caps_mps: vec![NO_CAP_MPS; path.points().len()],
        path: path.clone(),
        kind: PathKind::LeastEffort,
        route: None,
        identity: 100 + timing as u64,
        timing: (timing, MODES),
    });
    Some(anchors.collect())
}

/// Progress at a share of these speeds.
fn at_pace(v0: f64, speeds: &[f64], pace: f64) -> Progress {
    let mut out = [0.0; HORIZON_STEPS + 1];
    let mut speed = v0;
    for i in 0..HORIZON_STEPS {
        let wanted = if pace == 1.0 { speeds[i] } else { (pace * speeds[i]).max(0.0) };
        let next = if pace == 1.0 {
            wanted
        } else {
            wanted.clamp(speed - BRAKE_MPS2 * STEP_S, speed + ACCELERATE_MPS2 * STEP_S).max(0.0)
        };
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_own_pace_is_exact_and_others_are_taken_up_gently() {
        let own = at_pace(10.0, &[10.0; HORIZON_STEPS], 1.0);
        assert!((own[HORIZON_STEPS] - 90.0).abs() < 1e-9);
        let halted = at_pace(10.0, &[10.0; HORIZON_STEPS], 0.0);
        // v^2 / 2a, and the last step ends a little above zero.
        assert!(
            (halted[HORIZON_STEPS] - 100.0 / (2.0 * BRAKE_MPS2)).abs() < 0.1,
            "{}",
            halted[HORIZON_STEPS]
        );
        let faster = at_pace(10.0, &[10.0; HORIZON_STEPS], 1.2);
        assert!(faster[10] - 10.0 < 0.76 && faster[HORIZON_STEPS] > 104.0);
    }
}
