//! Verdicts on a future: faults, relations to others, manoeuvre, reaction. These are the members of the API's
//! modes.

use crate::AgentId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Kind of a fault, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// Its box meets another's; `extent` is the closing speed, m/s.
    Collision,
    /// A stop line is crossed at red; `extent` is the speed, m/s.
    RedLight,
    /// Against the direction of every lane there; `extent` is how far, metres.
    WrongWay,
    /// Over what divides two roads; `extent` is how far past the edge, metres.
    OverMedian,
    /// Over a kerb or away from the road; `extent` is how far past the edge, metres.
    OffRoad,
    /// Where the roads of the map have ended; `extent` is how far from the lanes, metres.
    OffMap,
    /// On foot along a lane, or across lanes beside a crosswalk; `extent` is how far, metres.
    OnCarriageway,
    /// Above the speed limit; `extent` is by how much, m/s.
    Speeding,
    /// Braking; `extent` in m/s2.
    HarshBraking,
    /// Turning; `extent` is the acceleration sideways, m/s2.
    HarshSteering,
    /// A pedestrian runs; `extent` is the speed, m/s.
    Running,
    /// Ends at an angle to its lane; `extent` in radians.
    Askew,
    /// A pedestrian waits at a crosswalk that this one drives over; `extent` is the pedestrian's delay, seconds.
    FailsToYield,
    /// Another has to brake hard; `extent` is that braking, m/s2.
    ForcesBraking,
    /// Another is met all but; `extent` is the gap, metres.
    NearMiss,
    /// A via point is passed too far away, or not at its time; `extent` is how far it is at the nearest, metres.
    ViaMissed,
    /// The goal is not met; `extent` is what is left, metres.
    GoalMissed,
}

/// One thing that is wrong with a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// Scene time at which it begins, seconds.
    pub time_s: f64,
    /// Scene time at which it ends, seconds.
    pub until_s: f64,
    /// Box centre where it is worst, metres.
    pub x_m: f64,
    /// Box centre where it is worst, metres.
    pub y_m: f64,
    /// How bad, in the unit of its kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<f64>,
    /// The other road user.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<AgentId>,
    /// The road edge that is driven over, by its id in the map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge: Option<String>,
}

/// Relation of a motion to another's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RelationKind {
    /// Their paths cross, and this one is there first.
    Before,
    /// Their paths cross, and this one is there second.
    After,
    /// Behind the other on the same way.
    Follows,
    /// Slows down or waits where their paths cross, so that the other goes first.
    GivesWayTo,
}

/// A motion and another's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Relation {
    /// Which.
    pub kind: RelationKind,
    /// The other road user.
    pub with: AgentId,
    /// Scene time at which this one is there, seconds.
    pub time_s: f64,
    /// Where, metres.
    pub x_m: f64,
    /// Where, metres.
    pub y_m: f64,
    /// Time between the two at that place, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_s: Option<f64>,
}

/// Manoeuvre of a motion, by its shape and its lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Manoeuvre {
    Straight,
    Left,
    Right,
    TurnRound,
    LaneLeft,
    LaneRight,
    Stays,
    Reverse,
}

/// Verdicts on one future.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct About {
    /// Faults, the worst first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<Fault>,
    /// Relations to others, the nearest in time first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relations: Vec<Relation>,
    /// Manoeuvre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manoeuvre: Option<Manoeuvre>,
}

/// How a road user reacts to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ReactionKind {
    /// Comes to rest.
    Waits,
    /// Is slower.
    Slows,
    /// Is faster.
    SpeedsUp,
    /// Takes another line.
    KeepsClear,
    /// Comes in later than the others, and does not come in: its place is taken then.
    StaysOut,
}

/// Why a road user gave up the motion that it had.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reaction {
    /// Kind of the reaction.
    pub kind: ReactionKind,
    /// The road user that its own motion would have met.
    pub cause: AgentId,
    /// Delay against its own motion, seconds; negative for earlier.
    pub delay_s: f64,
    /// Scene time at which it waits or is slowest, seconds.
    pub time_s: f64,
    /// Where then, metres.
    pub x_m: f64,
    /// Where then, metres.
    pub y_m: f64,
    /// Speed then, m/s.
    pub speed_mps: f64,
}

impl Reaction {
    /// The reaction with its numbers rounded to a thousandth, as they are written.
    #[must_use]
    pub fn rounded(self) -> Self {
        let [delay_s, time_s, x_m, y_m, speed_mps] =
            [self.delay_s, self.time_s, self.x_m, self.y_m, self.speed_mps].map(super::rounded);
        Self { delay_s, time_s, x_m, y_m, speed_mps, ..self }
    }
}
