//! Verdicts on a future: faults, relations to others, manoeuvre, reaction. These are the members of the API's
//! modes.

use crate::AgentId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Kind of a fault, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// Its box overlaps another's; `extent` is the closing speed, m/s.
    Collision,
    /// A stop line is crossed at red; `extent` is the speed, m/s.
    RedLight,
    /// Against the direction of every lane there; `extent` is the distance driven, metres.
    WrongWay,
    /// Over the median between two directions; `extent` is the distance past the edge, metres.
    OverMedian,
    /// Over a kerb or off the road; `extent` is the distance past the edge, metres.
    OffRoad,
    /// Beyond the end of the map's roads; `extent` is the distance from the lanes, metres.
    OffMap,
    /// On foot along a lane, or across lanes beside a crosswalk; `extent` is the distance walked, metres.
    OnCarriageway,
    /// Above the speed limit; `extent` is the excess, m/s.
    Speeding,
    /// Hard braking; `extent` is the deceleration, m/s2.
    HarshBraking,
    /// Hard steering; `extent` is the sideways acceleration, m/s2.
    HarshSteering,
    /// A pedestrian runs; `extent` is the speed, m/s.
    Running,
    /// Ends at an angle to its lane; `extent` is the angle, radians.
    Askew,
    /// A pedestrian waits at a crosswalk that this one drives over; `extent` is the pedestrian's delay, seconds.
    FailsToYield,
    /// Another road user has to brake hard; `extent` is its deceleration, m/s2.
    ForcesBraking,
    /// Near miss with another road user; `extent` is the gap, metres.
    NearMiss,
    /// A via point is passed too far away, or not at its time; `extent` is the least distance to it, metres.
    ViaMissed,
    /// The goal is not met; `extent` is the remaining distance, metres.
    GoalMissed,
}

/// A fault of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// Kind of the fault.
    pub kind: FaultKind,
    /// Scene time at which it begins, seconds.
    pub time_s: f64,
    /// Scene time at which it ends, seconds.
    pub until_s: f64,
    /// Box centre where it is worst, metres.
    pub x_m: f64,
    /// Box centre where it is worst, metres.
    pub y_m: f64,
    /// Extent, in the unit of its kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<f64>,
    /// The other road user.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<AgentId>,
    /// The road edge that is driven over, by its id in the map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge: Option<String>,
}

/// Kind of a relation between two motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RelationKind {
    /// Their paths cross, and this one passes first.
    Before,
    /// Their paths cross, and this one passes second.
    After,
    /// Behind the other on the same path.
    Follows,
    /// Slows down or waits where their paths cross, so that the other goes first.
    GivesWayTo,
}

/// Relation of a motion to that of another road user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Relation {
    /// Kind of the relation.
    pub kind: RelationKind,
    /// The other road user.
    pub with: AgentId,
    /// Scene time at which this one is at the place, seconds.
    pub time_s: f64,
    /// Position at that time, metres.
    pub x_m: f64,
    /// Position at that time, metres.
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

/// Kind of a reaction to another road user.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ReactionKind {
    /// Comes to rest.
    Waits,
    /// Slows down.
    Slows,
    /// Speeds up.
    SpeedsUp,
    /// Takes another path.
    KeepsClear,
    /// Was due to enter later, and does not enter because its place is occupied.
    StaysOut,
}

/// Why a road user left its previous motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reaction {
    /// Kind of the reaction.
    pub kind: ReactionKind,
    /// The road user with which its previous motion conflicts.
    pub cause: AgentId,
    /// Delay relative to its previous motion, seconds; negative is earlier.
    pub delay_s: f64,
    /// Scene time at which it waits or is slowest, seconds.
    pub time_s: f64,
    /// Position at that time, metres.
    pub x_m: f64,
    /// Position at that time, metres.
    pub y_m: f64,
    /// Speed at that time, m/s.
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
