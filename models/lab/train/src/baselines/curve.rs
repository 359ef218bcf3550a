//! Eighteen points to states at 10 Hz.

use experts::planning::{INSTANT_S, INSTANTS};
use scene::geometry::rotate;
use scene::{HORIZON_STEPS, STANDING_MPS, STEP_S, State, Vec2};

use super::sight::Points;

/// Below this speed the curve's direction does not determine the heading, m/s.
const SLOW_MPS: f64 = 0.5;
const KEPT_M: f64 = 1.0;

/// States at steps 1 ..= 90 on a smooth curve from the start through the points (in the start's frame). The
/// velocity is the curve's, the heading that of the motion, held while it is slow.
pub(super) fn states(start: &State, points: &Points) -> Vec<State> {
    let local = |i: usize| match i.checked_sub(1) {
        None => Vec2::zeros(),
        Some(i) => Vec2::new(f64::from(points[i][0]), f64::from(points[i][1])),
    };
    let farthest = (1..=INSTANTS).map(|i| local(i).norm()).fold(0.0, f64::max);
    if start.speed_mps() < STANDING_MPS && farthest < KEPT_M {
        return vec![State { vx_mps: 0.0, vy_mps: 0.0, ..*start }; HORIZON_STEPS];
    }
    let velocity = |i: usize| match i {
        0 => rotate(start.velocity(), -start.heading_rad),
        INSTANTS => (local(i) - local(i - 1)) / INSTANT_S,
        _ => (local(i + 1) - local(i - 1)) / (2.0 * INSTANT_S),
    };
    let mut heading_rad = start.heading_rad;
    let state = |step: usize| {
        let seconds = step as f64 * STEP_S;
        let piece = ((seconds / INSTANT_S - 1e-9) as usize).min(INSTANTS - 1);
        let s = seconds / INSTANT_S - piece as f64;
        let (p0, p1) = (local(piece), local(piece + 1));
        let (v0, v1) = (velocity(piece) * INSTANT_S, velocity(piece + 1) * INSTANT_S);
        let (s2, s3) = (s * s, s * s * s);
        let place = p0 * (2.0 * s3 - 3.0 * s2 + 1.0)
            + v0 * (s3 - 2.0 * s2 + s)
            + p1 * (3.0 * s2 - 2.0 * s3)
            + v1 * (s3 - s2);
        let slope = p0 * (6.0 * (s2 - s))
            + v0 * (3.0 * s2 - 4.0 * s + 1.0)
            + p1 * (6.0 * (s - s2))
            + v1 * (3.0 * s2 - 2.0 * s);
        let place = start.position() + rotate(place, start.heading_rad);
        let moved = rotate(slope / INSTANT_S, start.heading_rad);
        if moved.norm() > SLOW_MPS {
            heading_rad = moved.y.atan2(moved.x);
        }
        State { x_m: place.x, y_m: place.y, heading_rad, vx_mps: moved.x, vy_mps: moved.y }
    };
    (1..=HORIZON_STEPS).map(state).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_motion_stays_even() {
        let start = State {
            x_m: 3.0,
            y_m: 1.0,
            heading_rad: 1.0,
            vx_mps: 6.0 * 1f64.cos(),
            vy_mps: 6.0 * 1f64.sin(),
        };
        let points = std::array::from_fn(|i| [3.0 * (i + 1) as f32, 0.0]);
        for (i, state) in states(&start, &points).iter().enumerate() {
            let on = start.position() + start.velocity() * (0.1 * (i + 1) as f64);
            assert!((state.position() - on).norm() < 1e-5, "{i}");
            assert!((state.speed_mps() - 6.0).abs() < 1e-5 && (state.heading_rad - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn points_are_met_and_who_stands_keeps_its_place() {
        let start = State { heading_rad: 0.5, ..State::default() };
        let points: Points = std::array::from_fn(|i| [0.2 * (i * i) as f32, 0.1 * i as f32]);
        let found = states(&start, &points);
        for (i, [x, y]) in points.iter().enumerate() {
            let on = rotate(Vec2::new(f64::from(*x), f64::from(*y)), 0.5);
            assert!((found[5 * i + 4].position() - on).norm() < 1e-5);
        }
        let shaky: Points = std::array::from_fn(|i| [0.3, if i % 2 == 0 { 0.2 } else { -0.2 }]);
        let still = states(&start, &shaky);
        assert!(still.len() == 90 && still.iter().all(|s| *s == start));
    }
}
