//! A placed road user, before and after its speed is known.

use super::cells::CellKind;
use super::pose::Pose;
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::{Agent, AgentId, AgentType, Conditions, Size, Start, State, Subtype, Track};
use std::ops::Range;

/// A placed agent before its speed is known.
pub(super) struct PlacedAgent {
    pub(super) agent_type: AgentType,
    pub(super) subtype: Subtype,
    pub(super) size: Size,
    pub(super) pose: Pose,
    /// Kind of the cell it was placed in.
    pub(super) kind: CellKind,
    /// Graph lane, for an agent that drives.
    pub(super) lane: Option<usize>,
    /// Speed in free traffic, m/s, if it is fixed and not drawn.
    pub(super) free_mps: Option<f64>,
    /// It is part of the street and stands for the whole scene.
    pub(super) parked: bool,
}

/// Rounds positions, headings and speeds to their written form, so that the checks see what is sent.
pub(super) fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

impl PlacedAgent {
    /// The box on the ground.
    pub(super) fn outline(&self) -> OrientedBox {
        let (half_length, half_width) = (0.5 * self.size.length_m, 0.5 * self.size.width_m);
        OrientedBox::new(self.pose.position, half_length, half_width, self.pose.heading_rad)
    }

    /// The road user in the form of a scene: one state, and the same start as a condition. A parked one has
    /// no condition and stands at all of `steps`.
    pub(super) fn agent(&self, id: AgentId, speed_mps: f64, steps: Range<usize>) -> Agent {
        let velocity = direction(self.pose.heading_rad) * speed_mps;
        let state = State {
            x_m: self.pose.position.x,
            y_m: self.pose.position.y,
            heading_rad: self.pose.heading_rad,
            vx_mps: rounded(velocity.x, 1e3),
            vy_mps: rounded(velocity.y, 1e3),
        };
        let start = Start {
            position: Some(self.pose.position),
            heading_rad: Some(self.pose.heading_rad),
            speed_mps: Some(speed_mps),
        };
        let (seen, start) = if self.parked { (steps.len().max(1), Start::default()) } else { (1, start) };
        Agent {
            id,
            agent_type: self.agent_type,
            subtype: self.subtype,
            role: None,
            size: self.size,
            track: Track { first_step: steps.start, states: vec![Some(state); seen], z_m: None }.into(),
            conditions: Conditions { start, ..Conditions::default() },
        }
    }
}
