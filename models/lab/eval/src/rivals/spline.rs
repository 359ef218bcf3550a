//! Cubic Hermite spline, as an animation tool draws it between two key frames.

use super::hermite::Hermite;
use super::state;
use scene::geometry::direction;
use scene::motion::Target;
use scene::{Goal, HORIZON_STEPS, STEP_S, State};

/// Below this speed the curve's direction gives no heading, m/s. A spline has no noise, so the value is lower
/// than for recorded road users.
const DIRECTION_MPS: f64 = 0.2;

/// States at steps 1 ..= 90 on the cubic in position from `start` to `goal`, reached at `goal_step`.
///
/// Without a position, the path is straight with constant acceleration to the speed. After the goal, the
/// motion continues unchanged.
pub fn hermite(start: &State, goal: &Goal, goal_step: usize) -> Vec<State> {
    let from = (start.position(), start.velocity());
    let Goal { position, heading_rad, speed_mps, .. } = *goal;
    let target = Target { step: goal_step, position, heading_rad, speed_mps };
    let curve = Hermite::to_target(from, &target).unwrap_or_else(|| straight(start, speed_mps, goal_step));
    let mut heading_rad = start.heading_rad;
    let state_at = |step: usize| {
        let (position, velocity) = curve.at(step as f64 * STEP_S);
        if velocity.norm() > DIRECTION_MPS {
            heading_rad = velocity.y.atan2(velocity.x);
        }
        state(position, heading_rad, velocity)
    };
    (1..=HORIZON_STEPS).map(state_at).collect()
}

/// Straight motion, to the given speed if there is one.
fn straight(start: &State, speed_mps: Option<f64>, goal_step: usize) -> Hermite {
    let (p0, v0) = (start.position(), start.velocity());
    let seconds = goal_step.max(1) as f64 * STEP_S;
    let ahead = if v0.norm() > DIRECTION_MPS { v0.normalize() } else { direction(start.heading_rad) };
    let v1 = ahead * speed_mps.unwrap_or_else(|| v0.norm());
    Hermite::new((p0, v0), (p0 + (v0 + v1) * (0.5 * seconds), v1), seconds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;

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
