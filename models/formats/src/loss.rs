//! Losses: contents of a scene that a writer cannot store.

use scene::message::Message;
use schemars::JsonSchema;
use serde::Serialize;
use std::cmp::Ordering;

/// One kind of loss in an exported file. Programs switch on `code`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Loss {
    /// Such as `no-conditions`; see the constants of [`code`].
    pub code: &'static str,
    /// The loss in English.
    pub detail: String,
    /// The loss as data, where it has numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<Message>,
}

impl Loss {
    /// A loss without numbers.
    pub fn new(code: &'static str, detail: impl Into<String>) -> Self {
        Self { code, detail: detail.into(), message: None }
    }

    /// A loss with numbers.
    pub fn counted(code: &'static str, message: Message) -> Self {
        Self { code, detail: message.to_string(), message: Some(message) }
    }

    fn key(&self) -> (&'static str, &str) {
        (self.code, &self.detail)
    }
}

impl Eq for Loss {}

impl PartialOrd for Loss {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Loss {
    /// By code, then by sentence.
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

/// Codes of losses; they are stable.
pub mod code {
    /// Conditions fixed by the user.
    pub const NO_CONDITIONS: &str = "no-conditions";
    /// Which motion was generated: after reading the file again, all of it counts as recorded.
    pub const NO_GENERATED: &str = "no-generated";
    /// Futures other than the exported one.
    pub const NO_MODES: &str = "no-modes";
    /// Finer kinds of road user.
    pub const NO_SUBTYPE: &str = "no-subtype";
    /// Roles other than the ego.
    pub const NO_ROLES: &str = "no-roles";
    /// Licence.
    pub const NO_LICENCE: &str = "no-licence";
    /// Name, tags, notes and the like.
    pub const NO_NOTES: &str = "no-notes";
    /// Road users, in a file that holds only a map.
    pub const NO_ROAD_USERS: &str = "no-road-users";
    /// Lanes, lines, edges and areas.
    pub const NO_MAP: &str = "no-map";
    /// Traffic signals.
    pub const NO_SIGNALS: &str = "no-signals";
    /// Boxes of road users.
    pub const NO_SIZES: &str = "no-sizes";
    /// Judgements of futures: probabilities, faults, relations, reactions.
    pub const NO_JUDGEMENTS: &str = "no-judgements";
    /// The present step, steps after the last states of road users, and the source's times.
    pub const NO_TIMING: &str = "no-timing";
    /// Which lanes follow each other, lie side by side, and end at which lines.
    pub const NO_LANE_GRAPH: &str = "no-lane-graph";
    /// Heights.
    pub const NO_Z: &str = "no-z";
    /// Road users without any recorded state.
    pub const NO_UNSEEN: &str = "no-unseen";
    /// Drivable areas.
    pub const NO_DRIVABLE: &str = "no-drivable";
    /// Widths of lanes.
    pub const NO_LANE_WIDTH: &str = "no-lane-width";
    /// Types of lanes or edges that the format has no word for.
    pub const NO_LANE_TYPE: &str = "no-lane-type";
    /// More steps than the scene, because a future is longer: readers for recordings may not accept it.
    pub const LONG_RECORD: &str = "long-record";
    /// Painted lines and road edges as separate lines.
    pub const NO_LINES: &str = "no-lines";
    /// Areas of the map that the format has no word for.
    pub const NO_AREAS: &str = "no-areas";
    /// Lanes beside each other over a part of their length.
    pub const NO_NEIGHBORS: &str = "no-neighbors";
    /// Gaps within a track, in which the road user was not seen.
    pub const NO_VALIDITY_GAPS: &str = "no-validity-gaps";
    /// Only one road user has a goal, and only the goal is kept.
    pub const SINGLE_EGO: &str = "single-ego";
    /// Signal states other than red, yellow and green.
    pub const NO_SIGNAL_STATES: &str = "no-signal-states";
    /// Road users that appear after the first step, which the format's readers accept and its schema does
    /// not.
    pub const LATE_ROAD_USERS: &str = "late-road-users";
    /// Displaced lines or visibly rounded numbers, with the greatest deviation.
    pub const GEOMETRY_APPROXIMATED: &str = "geometry-approximated";
    /// Ids: they are numbered when the file is read again.
    pub const NO_IDS: &str = "no-ids";
    /// Speed limits.
    pub const NO_SPEED_LIMITS: &str = "no-speed-limits";
    /// Speeds other than the first one, if readers derive them from positions and times.
    pub const NO_VELOCITY: &str = "no-velocity";
    /// Routes of road users that are on no lane of the network.
    pub const NO_TRIPS: &str = "no-trips";
    /// Rollouts that the format requires and for which the scene has no samples.
    pub const NO_ROLLOUTS: &str = "no-rollouts";
    /// Ids that the format cannot hold.
    pub const IDS_RENUMBERED: &str = "ids-renumbered";
}
