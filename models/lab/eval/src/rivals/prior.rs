//! Least effort: the scene's own projection of constant motion onto the goal, and random variations of it.

use nalgebra::SMatrix;
use scene::motion::{Knots, MotionKind, MotionModel, Target, project};
use scene::random::Key;
use scene::{Agent, Goal, KNOTS, State};

/// Number of random variations beside the prior itself.
pub const VARIATIONS: usize = 5;
/// Correlation time of the knots, seconds.
const CORRELATION_S: f64 = 1.5;
/// Spread of the acceleration knots, m/s2.
const ACCELERATION_SD: f64 = 1.0;
/// Spread of the velocity knots on foot, m/s.
const VELOCITY_SD: f64 = 0.5;

/// States at steps 1 ..= 90 of the least effort that meets the goal at `goal_step`.
pub fn least_effort(agent: &Agent, start: &State, goal: &Goal, goal_step: usize) -> Vec<State> {
    let model = MotionModel::new(agent.agent_type, agent.subtype, agent.size, *start);
    projected(&model, &model.coasting(), goal, goal_step)
}

/// The prior, then `count` random variations: smooth noise on its knots, projected again. The stream of noise
/// depends only on the seed, the scene's name and the road user.
pub fn varied(
    agent: &Agent,
    start: &State,
    goal: &Goal,
    goal_step: usize,
    (seed, scene): (u64, &str),
    count: usize,
) -> Vec<Vec<State>> {
    let model = MotionModel::new(agent.agent_type, agent.subtype, agent.size, *start);
    let base = model.coasting();
    let mut draw = Key::default().number(seed).words(&["prior", scene, &agent.id]).stream();
    let goal_mps = goal.position.map_or(0.0, |p| (p - start.position()).norm() / (0.1 * goal_step as f64));
    let spread = spread(&model, start.speed_mps().max(goal_mps));
    let factor = factor();
    let mut out = vec![projected(&model, &base, goal, goal_step)];
    for _ in 0..count {
        let mut knots = base;
        for (channel, sd) in [&mut knots.first, &mut knots.second].into_iter().zip(spread) {
            let white = SMatrix::<f64, KNOTS, 1>::from_fn(|_, _| draw.normal());
            for (value, noise) in channel.iter_mut().zip((factor * white).iter()) {
                *value += sd * noise;
            }
        }
        out.push(projected(&model, &knots, goal, goal_step));
    }
    out
}

fn projected(model: &MotionModel, knots: &Knots, goal: &Goal, goal_step: usize) -> Vec<State> {
    let target = Target {
        step: goal_step,
        position: goal.position,
        heading_rad: goal.heading_rad,
        speed_mps: goal.speed_mps,
    };
    project(model, knots, &target, None).trajectory.iter().skip(1).map(State::from).collect()
}

/// Standard deviations of both channels; curvature varies less at higher speeds.
fn spread(model: &MotionModel, speed_mps: f64) -> [f64; 2] {
    match model.kind {
        MotionKind::Drive => {
            let slow = if model.limits.curvature_per_m > 0.5 { 0.15 } else { 0.08 };
            [ACCELERATION_SD, (1.2 / (speed_mps * speed_mps + 0.5)).min(slow)]
        }
        MotionKind::Walk => [VELOCITY_SD; 2],
    }
}

/// Lower Cholesky factor of the knots' correlation.
fn factor() -> SMatrix<f64, KNOTS, KNOTS> {
    let covariance = SMatrix::<f64, KNOTS, KNOTS>::from_fn(|i, j| {
        let d = (i as f64 - j as f64) / CORRELATION_S;
        (-0.5 * d * d).exp() + if i == j { 1e-4 } else { 0.0 }
    });
    covariance.cholesky().map_or_else(SMatrix::identity, |c| c.l())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{east, log};
    use scene::Vec2;

    #[test]
    fn all_variations_meet_the_goal_and_differ() {
        let goal = Goal { position: Some(Vec2::new(60.0, 6.0)), ..Goal::default() };
        let (agent, start) = (log("a", 8.0, 91), east(0.0, 0.0, 8.0));
        let all = varied(&agent, &start, &goal, 90, (1, "s"), VARIATIONS);
        assert_eq!(all.len(), 1 + VARIATIONS);
        assert_eq!(all[0], least_effort(&agent, &start, &goal, 90));
        for states in &all {
            assert!((states[89].position() - Vec2::new(60.0, 6.0)).norm() < 0.05);
        }
        assert!((all[1][44].position() - all[2][44].position()).norm() > 0.1);
        assert_eq!(all, varied(&agent, &start, &goal, 90, (1, "s"), VARIATIONS));
        assert_ne!(all, varied(&agent, &start, &goal, 90, (2, "s"), VARIATIONS));
    }

    #[test]
    fn without_a_goal_it_goes_on_as_it_is() {
        let states = least_effort(&log("a", 8.0, 91), &east(0.0, 0.0, 8.0), &Goal::default(), 90);
        assert!((states[89].position() - Vec2::new(72.0, 0.0)).norm() < 1e-6);
    }
}
