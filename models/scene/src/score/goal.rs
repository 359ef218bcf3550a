//! Error of a road user at its goal: fixed fields only, at the goal's time.

use super::input::{Actor, Thresholds};
use super::report::mean;
use crate::{STEP_S, wrap_angle};
use schemars::JsonSchema;
use serde::Serialize;

/// Error at the goal time; a member is null where its field was free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct GoalError {
    /// Distance from the goal, metres.
    pub position_m: Option<f64>,
    /// Absolute turn from the goal heading, radians.
    pub heading_rad: Option<f64>,
    /// Absolute difference from the goal speed, m/s.
    pub speed_mps: Option<f64>,
}

impl GoalError {
    /// Whether all fixed fields are met within the thresholds.
    pub fn is_reached(&self, limits: &Thresholds) -> bool {
        self.position_m.is_none_or(|e| e <= limits.goal_position_m)
            && self.heading_rad.is_none_or(|e| e <= limits.goal_heading_rad)
            && self.speed_mps.is_none_or(|e| e <= limits.goal_speed_mps)
    }

    /// Mean of each field over the errors that have it; `None` without errors.
    pub fn mean<'a>(errors: impl Iterator<Item = &'a Self> + Clone) -> Option<Self> {
        errors.clone().next()?;
        Some(Self {
            position_m: mean(errors.clone().map(|e| e.position_m)),
            heading_rad: mean(errors.clone().map(|e| e.heading_rad)),
            speed_mps: mean(errors.map(|e| e.speed_mps)),
        })
    }
}

/// Error of a generated motion at its goal time (at the end of the motion if the time is free or later).
/// `None` for recorded motion and free goals.
pub fn goal_error(actor: &Actor<'_>) -> Option<GoalError> {
    let goal = &actor.goal;
    if !actor.generated || goal.is_free() {
        return None;
    }
    let last = actor.track.last_valid_step()?;
    let first = actor.track.valid_steps().next()?;
    let due = goal.time_s.map_or(last, |t| (t / STEP_S).round().max(0.0) as usize);
    let state = actor.state(due.clamp(first, last))?;
    Some(GoalError {
        position_m: goal.position.map(|p| (state.position() - p).norm()),
        heading_rad: goal.heading_rad.map(|h| wrap_angle(state.heading_rad - h).abs()),
        speed_mps: goal.speed_mps.map(|v| (state.speed_mps() - v).abs()),
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::straight;
    use super::*;
    use crate::{AgentType, Goal, Vec2};

    #[test]
    fn fixed_fields_only_at_the_goal_time() {
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        assert_eq!(goal_error(&actor), None);
        actor.goal = Goal { position: Some(Vec2::new(43.0, 4.0)), time_s: Some(4.0), ..Goal::default() };
        let error = goal_error(&actor).unwrap();
        assert!((error.position_m.unwrap() - 5.0).abs() < 1e-9);
        assert_eq!((error.heading_rad, error.speed_mps), (None, None));
        actor.goal = Goal { speed_mps: Some(12.0), heading_rad: Some(6.2), ..Goal::default() };
        let error = goal_error(&actor).unwrap();
        assert_eq!(error.speed_mps, Some(2.0));
        assert!((error.heading_rad.unwrap() - (std::f64::consts::TAU - 6.2)).abs() < 1e-9);
        assert!(!error.is_reached(&Thresholds::default()));
        actor.goal = Goal { speed_mps: Some(10.01), ..Goal::default() };
        assert!(goal_error(&actor).unwrap().is_reached(&Thresholds::default()));
        actor.generated = false;
        assert_eq!(goal_error(&actor), None);
    }
}
