//! Road users: type, size, recorded track, conditions.

use crate::{Conditions, Shared, Vec2, wrap_angle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Identifier of a road user, unique in a scene, `[A-Za-z0-9_.:-]{1,64}`.
pub type AgentId = String;

/// Type of a road user; selects the expert and the motion model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum AgentType {
    /// Motor vehicles on lanes: cars, trucks, buses, motorcycles.
    Vehicle,
    /// A person on foot.
    Pedestrian,
    /// A person on a bicycle or kick-scooter.
    Cyclist,
    /// Shown, never regenerated.
    #[cfg_attr(feature = "cli", value(skip))]
    Other,
}

/// Finer kind; sets default size and limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Subtype {
    Car,
    Truck,
    Bus,
    Van,
    Motorcycle,
    Trailer,
    Emergency,
    Adult,
    Child,
    Wheelchair,
    Scooter,
    Bicycle,
    #[default]
    Unknown,
}

/// Box of a road user, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Size {
    /// Along the heading.
    pub length_m: f64,
    /// Across the heading.
    pub width_m: f64,
    /// Upwards; unknown in hand-made scenes.
    pub height_m: Option<f64>,
}

impl Size {
    /// Default size for a type and subtype (medians of recorded road users).
    pub fn default_for(agent_type: AgentType, subtype: Subtype) -> Self {
        let (length_m, width_m, height_m) = match (agent_type, subtype) {
            (_, Subtype::Truck) => (8.5, 2.5, 3.2),
            (_, Subtype::Bus) => (12.0, 2.6, 3.2),
            (_, Subtype::Van) => (5.6, 2.1, 2.4),
            (_, Subtype::Motorcycle) => (2.2, 0.85, 1.4),
            (AgentType::Pedestrian, Subtype::Child) => (0.5, 0.5, 1.2),
            (AgentType::Pedestrian, Subtype::Wheelchair) => (1.1, 0.7, 1.3),
            (AgentType::Pedestrian, _) => (0.85, 0.85, 1.75),
            (AgentType::Cyclist, _) => (1.8, 0.75, 1.75),
            _ => (4.7, 2.0, 1.7),
        };
        Self { length_m, width_m, height_m: Some(height_m) }
    }
}

/// Pose and velocity of a road user at one step. The position is the box centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct State {
    pub x_m: f64,
    pub y_m: f64,
    pub heading_rad: f64,
    pub vx_mps: f64,
    pub vy_mps: f64,
}

impl State {
    /// Box centre.
    pub fn position(&self) -> Vec2 {
        Vec2::new(self.x_m, self.y_m)
    }

    /// Velocity of the box centre.
    pub fn velocity(&self) -> Vec2 {
        Vec2::new(self.vx_mps, self.vy_mps)
    }

    /// Speed, never negative.
    pub fn speed_mps(&self) -> f64 {
        self.velocity().norm()
    }
}

/// States on consecutive steps from `first_step`; `None` at a step at which the road user was not seen.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Track {
    /// Scene step of `states[0]`.
    pub first_step: usize,
    /// One entry per step.
    pub states: Vec<Option<State>>,
    /// Heights, parallel to `states`, if the source has them.
    pub z_m: Option<Vec<f64>>,
}

impl Track {
    /// State at a scene step, if the road user was seen then.
    pub fn at(&self, step: usize) -> Option<&State> {
        self.states.get(step.checked_sub(self.first_step)?)?.as_ref()
    }

    /// Steps at which a state is known, in ascending order.
    pub fn valid_steps(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.states.iter().enumerate().filter(|(_, s)| s.is_some()).map(|(i, _)| i + self.first_step)
    }

    /// Last step at which a state is known.
    pub fn last_valid_step(&self) -> Option<usize> {
        self.valid_steps().next_back()
    }

    /// Greatest distance from the first known position, metres. Zero for fewer than two states.
    pub fn extent_m(&self) -> f64 {
        let mut known = self.states.iter().flatten().map(State::position);
        let Some(first) = known.next() else { return 0.0 };
        known.map(|p| (p - first).norm()).fold(0.0, f64::max)
    }
}

/// One road user.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agent {
    /// Unique in the scene.
    pub id: AgentId,
    /// Selects expert and motion model.
    #[serde(rename = "type")]
    pub agent_type: AgentType,
    /// Sets limits and default size.
    pub subtype: Subtype,
    /// Role in the source, such as `ego`.
    pub role: Option<String>,
    /// Box.
    pub size: Size,
    /// The recording, or only the start for an agent without one.
    pub track: Shared<Track>,
    /// Conditions that the user fixed.
    pub conditions: Conditions,
}

impl Agent {
    /// A road user of the default size, present from the first step on, without conditions.
    pub fn bare(
        id: impl Into<AgentId>,
        agent_type: AgentType,
        subtype: Subtype,
        states: Vec<Option<State>>,
    ) -> Self {
        Self {
            id: id.into(),
            agent_type,
            subtype,
            role: None,
            size: Size::default_for(agent_type, subtype),
            track: Track { first_step: 0, states, z_m: None }.into(),
            conditions: Conditions::default(),
        }
    }

    /// Recorded state at `step`, with its heading wrapped.
    pub fn state_at(&self, step: usize) -> Option<State> {
        self.track.at(step).map(|s| State { heading_rad: wrap_angle(s.heading_rad), ..*s })
    }

    /// The type that the user set, else the recorded one. It selects the expert.
    pub fn kind(&self) -> AgentType {
        self.conditions.kind_of(self)
    }
}
