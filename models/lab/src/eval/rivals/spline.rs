//! Cubic Hermite spline: what an animation tool would draw between two key frames.

use super::state;
use scene::geometry::direction;
use scene::{Goal, HORIZON_STEPS, STEP_S, State, Vec2};

/// Below this speed the curve's direction says nothing about the heading, m/s.
const STANDING_MPS: f64 = 0.2;

/// States at steps 1 ..= 90 on the cubic in position from `start` to `goal`, met at `goal_step`.
///
/// The velocity at the end follows the goal's speed and heading where they are fixed; a free end has no
/// acceleration, and its direction alone is taken where only the speed is fixed. Without a position the way
/// is straight with even acceleration to the speed. Beyond the goal it goes on unchanged.
pub fn hermite(start: &State, goal: &Goal, goal_step: usize) -> Vec<State> {
    let seconds = goal_step.max(1) as f64 * STEP_S;
    let (p0, v0) = (start.position(), start.velocity());
    let (p1, v1) = ending(start, goal, seconds);
    let mut heading_rad = start.heading_rad;
    let mut out = Vec::with_capacity(HORIZON_STEPS);
    for step in 1..=HORIZON_STEPS {
        let t = step as f64 * STEP_S;
        let s = t.min(seconds) / seconds;
        let (s2, s3) = (s * s, s * s * s);
        let along = p0 * (2.0 * s3 - 3.0 * s2 + 1.0)
            + v0 * (seconds * (s3 - 2.0 * s2 + s))
            + p1 * (3.0 * s2 - 2.0 * s3)
            + v1 * (seconds * (s3 - s2));
        let velocity = p0 * (6.0 * (s2 - s) / seconds)
            + v0 * (3.0 * s2 - 4.0 * s + 1.0)
            + p1 * (6.0 * (s - s2) / seconds)
            + v1 * (3.0 * s2 - 2.0 * s);
        if velocity.norm() > STANDING_MPS {
            heading_rad = velocity.y.atan2(velocity.x);
        }
        out.push(state(along + velocity * (t - seconds).max(0.0), heading_rad, velocity));
    }
    out
}

/// Place and velocity at the goal.
fn ending(start: &State, goal: &Goal, seconds: f64) -> (Vec2, Vec2) {
    let (p0, v0) = (start.position(), start.velocity());
    let Some(p1) = goal.position else {
        let ahead = if v0.norm() > STANDING_MPS { v0.normalize() } else { direction(start.heading_rad) };
        let v1 = ahead * goal.speed_mps.unwrap_or_else(|| v0.norm());
        return (p0 + (v0 + v1) * (0.5 * seconds), v1);
    };
    // No acceleration at the end.
    let natural = (p1 - p0) * (1.5 / seconds) - v0 * 0.5;
    let v1 = match (goal.heading_rad, goal.speed_mps) {
        (Some(heading), speed) => direction(heading) * speed.unwrap_or_else(|| natural.norm()),
        (None, Some(speed)) => natural * (speed / natural.norm().max(0.1)),
        (None, None) => natural,
    };
    (p1, v1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start() -> State {
        state(Vec2::new(1.0, 2.0), 0.0, Vec2::new(6.0, 0.0))
    }

    #[test]
    fn meets_place_heading_and_speed() {
        let goal = Goal {
            position: Some(Vec2::new(40.0, 20.0)),
            heading_rad: Some(1.0),
            speed_mps: Some(4.0),
            time_s: None,
        };
        for step in [60, 90] {
            let end = hermite(&start(), &goal, step)[step - 1];
            assert!((end.position() - Vec2::new(40.0, 20.0)).norm() < 1e-9);
            assert!((end.heading_rad - 1.0).abs() < 1e-9 && (end.speed_mps() - 4.0).abs() < 1e-9);
        }
    }

    #[test]
    fn straight_even_motion_is_its_own_spline() {
        let goal = Goal { position: Some(Vec2::new(55.0, 2.0)), ..Goal::default() };
        for (i, s) in hermite(&start(), &goal, 90).iter().enumerate() {
            assert!((s.x_m - 1.0 - 0.6 * (i + 1) as f64).abs() < 1e-9 && (s.speed_mps() - 6.0).abs() < 1e-9);
        }
    }

    #[test]
    fn speed_alone_is_even_acceleration_straight_on() {
        let goal = Goal { speed_mps: Some(0.0), ..Goal::default() };
        let states = hermite(&start(), &goal, 90);
        // Half of 6 m/s for 9 s.
        assert!((states[89].x_m - 28.0).abs() < 1e-9 && states[89].speed_mps() < 1e-9);
        assert!((states[44].speed_mps() - 3.0).abs() < 1e-9);
    }

    #[test]
    fn goes_on_beyond_an_early_goal() {
        let goal = Goal { position: Some(Vec2::new(31.0, 2.0)), ..Goal::default() };
        let states = hermite(&start(), &goal, 50);
        assert!((states[89].x_m - 55.0).abs() < 1e-9);
    }
}
