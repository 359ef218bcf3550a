//! Ranges of the varied numbers of a situation: goal, start, and the other road users.

use crate::distribution::Distribution;
use crate::recorded::{MOST_SHIFT_S, MOST_TIMES};
use formats::native::{ConditionsDoc, GoalDoc, GoalRelationDoc, StartDoc};
use scene::AgentType;
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Type and size of the road users other than the one with the conditions.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OtherKinds {
    /// Road users: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub agents: Vec<String>,
    /// Type, in place of their own.
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub agent_type: Option<AgentType>,
    /// Length of each, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<Distribution>,
    /// Width of each, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_m: Option<Distribution>,
}

/// Fields of a goal; absent ones are free.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GoalRanges {
    /// The goal is the recorded state of the road user at `time_s`; `ahead_m`, `left_m` and `turn_rad` are
    /// relative to it instead of the start. Default: false.
    #[serde(skip_serializing_if = "is_default")]
    pub recorded: bool,
    /// Box centre in the frame of the scene, metres; with `y_m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_m: Option<Distribution>,
    /// Box centre in the frame of the scene, metres; with `x_m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_m: Option<Distribution>,
    /// Heading in the frame of the scene, radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading_rad: Option<Distribution>,
    /// Metres along the heading of the start, or of the recorded goal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ahead_m: Option<Distribution>,
    /// Metres to the left of this heading; 0 with `ahead_m` alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_m: Option<Distribution>,
    /// Radians from this heading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_rad: Option<Distribution>,
    /// Metres per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_mps: Option<Distribution>,
    /// With `recorded`: multiple of the recorded speed, in place of `speed_mps`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_times: Option<Distribution>,
    /// Scene time, seconds; the end of the horizon when free.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<Distribution>,
    /// With `recorded`: seconds after the recorded time; negative is earlier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub later_s: Option<Distribution>,
    /// Road user that the goal is relative to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relation: Option<GoalRelationRanges>,
}

/// A goal relative to another road user: exactly one of `ahead_m`, `behind_m`, `behind_s` and `after_s`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalRelationRanges {
    /// Id of the other road user.
    pub to: String,
    /// Gap from the front of the other one to the rear of this road user, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead_m: Option<Distribution>,
    /// Gap from the front of this road user to the rear of the other one, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_m: Option<Distribution>,
    /// The same gap in seconds at the speed of the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_s: Option<Distribution>,
    /// Seconds from the moment when the other one is nearest to the goal's position until the goal is
    /// reached.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after_s: Option<Distribution>,
    /// Speed difference to the other one, m/s: positive is slower, negative is faster.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slower_mps: Option<Distribution>,
    /// Number of lanes to the left of the other one's lane, a whole number; negative is to the right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lanes_left: Option<Distribution>,
}

/// Fields of a start; absent ones are those of the scene: from its conditions, else from the recording.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StartRanges {
    /// Box centre in the frame of the scene, metres; with `y_m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_m: Option<Distribution>,
    /// Box centre in the frame of the scene, metres; with `x_m`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y_m: Option<Distribution>,
    /// Heading in the frame of the scene, radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heading_rad: Option<Distribution>,
    /// Metres from the start in the scene, along the lane that it is on, else along its heading.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ahead_m: Option<Distribution>,
    /// Metres to the left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_m: Option<Distribution>,
    /// Radians from the heading of that start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_rad: Option<Distribution>,
    /// Metres per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_mps: Option<Distribution>,
    /// Multiple of the speed in the scene, in place of `speed_mps`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_times: Option<Distribution>,
}

pub(super) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl GoalRelationRanges {
    /// The relation with drawn numbers, by their paths in the situation.
    pub(super) fn drawn(&self, of: &dyn Fn(&str) -> Option<f64>) -> GoalRelationDoc {
        GoalRelationDoc {
            to: self.to.clone(),
            ahead_m: of("goal.relation.ahead_m"),
            behind_m: of("goal.relation.behind_m"),
            behind_s: of("goal.relation.behind_s"),
            after_s: of("goal.relation.after_s"),
            slower_mps: of("goal.relation.slower_mps"),
            lanes_left: of("goal.relation.lanes_left").map(|lanes| lanes.round() as i32),
        }
    }
}

impl GoalRanges {
    /// Is it from the start of the road user, in place of the scene?
    pub(super) fn is_relative(&self) -> bool {
        self.ahead_m.is_some() || self.left_m.is_some() || self.turn_rad.is_some()
    }
}

/// The range of a condition, as its document has it.
pub(super) fn range(member: &str) -> (f64, f64) {
    static RELATION: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(GoalRelationDoc));
    static GOAL: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(GoalDoc));
    static START: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(StartDoc));
    static CONDITIONS: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(ConditionsDoc));
    match member {
        "goal.later_s" => return (-MOST_SHIFT_S, MOST_SHIFT_S),
        "goal.speed_times" | "start.speed_times" => return (0.0, MOST_TIMES),
        _ => {}
    }
    let schema: &Schema = match member.split_once('.') {
        Some(("start", "ahead_m" | "left_m")) => &GOAL,
        Some(("others", _)) => &CONDITIONS,
        Some(("goal", rest)) if rest.contains('.') => &RELATION,
        Some(("goal", _)) => &GOAL,
        Some(_) => &START,
        None => &CONDITIONS,
    };
    let name = member.rsplit('.').next().unwrap_or(member);
    if name.ends_with("_rad") {
        let most = api::generate::request::MOST_ANGLE_RAD;
        return (-most, most);
    }
    schema_range(schema, name)
}

/// The range of a number, as a schema has it.
pub(crate) fn schema_range(schema: &Schema, name: &str) -> (f64, f64) {
    let bound =
        |bound: &str| schema.pointer(&format!("/properties/{name}/{bound}")).and_then(|value| value.as_f64());
    (bound("minimum").unwrap_or(f64::MIN), bound("maximum").unwrap_or(f64::MAX))
}

#[cfg(test)]
mod tests {
    use super::range;

    #[test]
    fn ranges_are_those_of_the_documents() {
        assert_eq!(range("goal.speed_mps"), (0.0, 60.0));
        assert_eq!(range("length_m"), (0.2, 25.0));
        assert_eq!(range("start.x_m"), (-10_000.0, 10_000.0));
        assert_eq!(range("goal.relation.behind_s"), (0.0, 20.0));
    }
}
