//! Motion in control space: the motion of a road user is a set of [`Knots`]. Every rollout of any knots obeys
//! the limits of its kind.
//!
//! Vehicles and cyclists are controlled by acceleration and curvature of a reference point near the rear axle
//! ([`drive`]), pedestrians by their velocity ([`walk`]).

pub mod drive;
pub mod fit;
pub mod project;
pub mod tension;
pub mod walk;
mod whiten;

pub use fit::{Sampled, Smoothing, fit, refit_after};
pub use project::{Limiting, Pass, Projection, Reach, Target, TargetError, project, project_through};
pub use tension::Tension;
pub use whiten::knot_covariance_factor;

use crate::geometry::{direction, rotate};
use crate::limits::Limits;
use crate::{AgentType, KNOT_STEPS, KNOTS, STEP_S, Size, State, Subtype, Vec2, wrap_angle};

/// Number of control values of one future.
pub const CONTROLS: usize = 2 * KNOTS;

/// Two channels of control values, one every [`KNOT_S`](crate::KNOT_S) from 0 to 9 s, piecewise linear between.
///
/// Drive: acceleration (m/s2) and curvature (1/m). Walk: velocity along and left of the start heading (m/s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Knots {
    /// Acceleration, or velocity ahead.
    pub first: [f64; KNOTS],
    /// Curvature, or velocity to the left.
    pub second: [f64; KNOTS],
}

impl Knots {
    /// Value of a channel in the middle of step `i`: left knot, its weight, right weight.
    pub(crate) fn mid_weights(step: usize) -> (usize, f64, f64) {
        let f = ((step % KNOT_STEPS) as f64 + 0.5) / KNOT_STEPS as f64;
        (step / KNOT_STEPS, 1.0 - f, f)
    }

    /// Whether all values are finite.
    pub fn is_finite(&self) -> bool {
        self.first.iter().chain(&self.second).all(|v| v.is_finite())
    }
}

/// Pose and speed at one step of a rollout. The position is the box centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionState {
    /// Metres.
    pub position: Vec2,
    /// Radians, unwrapped along the rollout.
    pub heading_rad: f64,
    /// Velocity of the box centre, m/s.
    pub velocity: Vec2,
}

impl MotionState {
    /// Speed of the box centre, m/s.
    pub fn speed_mps(&self) -> f64 {
        self.velocity.norm()
    }
}

impl From<&MotionState> for State {
    fn from(s: &MotionState) -> Self {
        Self {
            x_m: s.position.x,
            y_m: s.position.y,
            heading_rad: wrap_angle(s.heading_rad),
            vx_mps: s.velocity.x,
            vy_mps: s.velocity.y,
        }
    }
}

/// `HORIZON_STEPS + 1` states, the start first.
pub type Trajectory = Vec<MotionState>;

/// Direction of travel of a vehicle for the whole window; a future never mixes the two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gear {
    /// Forwards.
    #[default]
    Forward,
    /// Backwards, at most 4 m/s.
    Reverse,
}

/// How a road user moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionKind {
    /// Wheels: acceleration and curvature.
    Drive,
    /// Feet: velocity.
    Walk,
}

/// The motion model of one road user from one start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionModel {
    /// Wheels or feet.
    pub kind: MotionKind,
    /// Bounds that no rollout breaks.
    pub limits: Limits,
    /// Start of the box centre, scene frame.
    pub start: State,
    /// Reference point behind the box centre, metres.
    pub offset_m: f64,
    /// Direction of travel on wheels.
    pub gear: Gear,
    /// On foot: step and heading, for a pedestrian that stands at this step and turns.
    pub turn_to: Option<(usize, f64)>,
}

/// Greatest speed in reverse, m/s.
pub const REVERSE_SPEED_MPS: f64 = 4.0;

impl MotionModel {
    /// The model of a road user of this kind and size from this start.
    pub fn new(agent_type: AgentType, subtype: Subtype, size: Size, start: State) -> Self {
        let limits = Limits::of(agent_type, subtype, size.length_m);
        let kind = if agent_type == AgentType::Pedestrian { MotionKind::Walk } else { MotionKind::Drive };
        let offset_m = limits.reference_offset * size.length_m;
        Self { kind, limits, start, offset_m, gear: Gear::Forward, turn_to: None }
    }

    /// The same model in another gear.
    pub fn in_gear(self, gear: Gear) -> Self {
        Self { gear, ..self }
    }

    /// The same model with the limits of a hurried driver, below those of an emergency. On foot nothing
    /// changes.
    pub fn hurried(self) -> Self {
        match self.kind {
            MotionKind::Drive => Self { limits: self.limits.within(self.limits.hurried), ..self },
            MotionKind::Walk => self,
        }
    }

    /// Speed at the start in the direction of travel, m/s, not negative.
    pub fn start_speed_mps(&self) -> f64 {
        let along = self.start.velocity().dot(&direction(self.start.heading_rad));
        match (self.kind, self.gear) {
            (MotionKind::Walk, _) => self.start.speed_mps(),
            // A recorded velocity has a lateral part from turning, so the norm is the better speed.
            (MotionKind::Drive, Gear::Forward) if along > 0.0 => self.start.speed_mps(),
            (MotionKind::Drive, Gear::Forward) => 0.0,
            (MotionKind::Drive, Gear::Reverse) => (-along).max(0.0),
        }
    }

    /// A point of the scene in the start's frame (x ahead, y left).
    pub fn to_local(&self, point: Vec2) -> Vec2 {
        rotate(point - self.start.position(), -self.start.heading_rad)
    }

    /// A point of the start's frame in the scene.
    pub fn to_scene(&self, point: Vec2) -> Vec2 {
        self.start.position() + rotate(point, self.start.heading_rad)
    }

    /// The knots without acceleration or turning: the road user stands or continues at constant velocity.
    pub fn coasting(&self) -> Knots {
        match self.kind {
            MotionKind::Drive => Knots::default(),
            MotionKind::Walk => {
                let v = rotate(self.start.velocity(), -self.start.heading_rad);
                Knots { first: [v.x; KNOTS], second: [v.y; KNOTS] }
            }
        }
    }

    /// The nearest knots within the limits.
    pub fn legal(&self, knots: &Knots) -> Knots {
        match self.kind {
            MotionKind::Drive => drive::legal(self, knots),
            MotionKind::Walk => walk::legal(self, knots),
        }
    }

    /// Motion of these knots from the start, scene frame. It never exceeds a limit, whatever the knots.
    pub fn rollout(&self, knots: &Knots) -> Trajectory {
        let mut local = match self.kind {
            MotionKind::Drive => drive::rollout(self, knots),
            MotionKind::Walk => walk::rollout(self, knots),
        };
        for state in &mut local {
            state.position = self.to_scene(state.position);
            state.velocity = rotate(state.velocity, self.start.heading_rad);
            state.heading_rad += self.start.heading_rad;
        }
        local
    }
}

/// How far a rollout exceeds its model's limits: the largest excess over any of them, in the limit's own
/// unit; at most zero if all hold. Allows for rounding.
pub fn limit_excess(model: &MotionModel, states: &[MotionState]) -> f64 {
    let l = &model.limits;
    let top = l.speed_mps.max(model.start.speed_mps());
    let reference = |s: &MotionState| s.position - direction(s.heading_rad) * model.offset_m;
    let mut worst = f64::NEG_INFINITY;
    for w in states.windows(2) {
        let moved = match model.kind {
            MotionKind::Drive => (reference(&w[1]) - reference(&w[0])).norm(),
            MotionKind::Walk => (w[1].position - w[0].position).norm(),
        };
        let speed = moved / STEP_S;
        worst = worst.max(speed - top - 1e-6);
        match model.kind {
            MotionKind::Drive => {
                let turn = wrap_angle(w[1].heading_rad - w[0].heading_rad).abs();
                if speed > 0.05 {
                    worst = worst.max(turn / moved - l.curvature_per_m - 1e-3);
                }
                worst = worst.max(speed * turn / STEP_S - l.lateral_mps2 - 1e-2);
            }
            MotionKind::Walk => {
                let change = (w[1].velocity - w[0].velocity).norm() / STEP_S;
                worst = worst.max(change - l.accel_mps2 - 1e-6);
            }
        }
    }
    if model.kind == MotionKind::Drive {
        // Acceleration and braking from the distances of neighbouring steps.
        for w in states.windows(3) {
            let first = (reference(&w[1]) - reference(&w[0])).norm();
            let second = (reference(&w[2]) - reference(&w[1])).norm();
            let rate = (second - first) / (STEP_S * STEP_S);
            worst = worst.max(rate - l.accel_mps2 - 0.05).max(-rate - l.brake_mps2 - 0.05);
        }
    }
    worst
}

#[cfg(test)]
mod tests;
