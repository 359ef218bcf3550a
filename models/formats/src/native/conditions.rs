//! Conditions of one road user, as a document.

use super::value::words;
use scene::{AgentType, GoalRelation, RelativePlace};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use serde_json::json;

/// Frame of a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GoalFrame {
    /// `x_m`, `y_m`, `heading_rad`.
    #[default]
    Scene,
    /// `ahead_m`, `left_m`, `turn_rad` from the start pose.
    Agent,
}

fn frames(_: &mut SchemaGenerator) -> Schema {
    words(&["scene", "agent"])
}

fn expert_types(_: &mut SchemaGenerator) -> Schema {
    schemars::json_schema!({"enum": ["vehicle", "pedestrian", "cyclist", null]})
}

/// Schema of "both or neither": a number in one member needs a number in the other.
fn together(schema: &mut Schema, pairs: &[(&str, &str)]) {
    let needs = |has: &str, lacks: &str| {
        json!({
            "if": {"properties": {has: {"type": "number"}}, "required": [has]},
            "then": {"properties": {lacks: {"type": "number"}}, "required": [lacks]}
        })
    };
    let rules: Vec<_> = pairs.iter().flat_map(|(a, b)| [needs(a, b), needs(b, a)]).collect();
    schema.insert("allOf".into(), rules.into());
}

/// Schema of "not both a speed and a velocity".
fn one_speed(schema: &mut Schema) {
    let both = json!({
        "properties": {"speed_mps": {"type": "number"}, "velocity": {"type": "object"}},
        "required": ["speed_mps", "velocity"]
    });
    schema.insert("not".into(), both);
}

fn start_rules(schema: &mut Schema) {
    together(schema, &[("x_m", "y_m")]);
    one_speed(schema);
}

fn goal_rules(schema: &mut Schema) {
    together(schema, &[("x_m", "y_m"), ("ahead_m", "left_m")]);
    one_speed(schema);
}

/// Members of a [`GoalRelationDoc`] of which it has exactly one.
pub(super) const PLACES: [&str; 4] = ["ahead_m", "behind_m", "behind_s", "after_s"];

/// Schema of "exactly one place".
fn one_place(schema: &mut Schema) {
    let has = |name: &&str| json!({"properties": {*name: {"type": "number"}}, "required": [name]});
    let one: Vec<_> = PLACES.iter().map(has).collect();
    schema.insert("oneOf".into(), one.into());
}

fn velocity_rules(schema: &mut Schema) {
    together(schema, &[("x_mps", "y_mps"), ("ahead_mps", "left_mps")]);
    schema.insert("minProperties".into(), 2.into());
}

/// A velocity in place of a speed: `x_mps` and `y_mps`, or, in a goal of frame `agent`,
/// `ahead_mps` and `left_mps`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = velocity_rules)]
pub struct VelocityDoc {
    /// m/s east.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -60.0, max = 60.0))]
    pub x_mps: Option<f64>,
    /// m/s north.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -60.0, max = 60.0))]
    pub y_mps: Option<f64>,
    /// m/s along the start's heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -60.0, max = 60.0))]
    pub ahead_mps: Option<f64>,
    /// m/s to the left of the start's heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -60.0, max = 60.0))]
    pub left_mps: Option<f64>,
}

/// Start of a road user; absent or null is free.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = start_rules)]
pub struct StartDoc {
    /// Box centre, metres; with `y_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub x_m: Option<f64>,
    /// Box centre, metres; with `x_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub y_m: Option<f64>,
    /// Heading, radians, wrapped when read; a request may have at most a full turn either way, 6.2832.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub heading_rad: Option<f64>,
    /// m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 60.0))]
    pub speed_mps: Option<f64>,
    /// Velocity in place of `speed_mps`; it also fixes a free heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<VelocityDoc>,
}

/// Position and state that a road user should have at `time_s`; absent or null is free.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = goal_rules)]
pub struct GoalDoc {
    /// Box centre, metres; with `y_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub x_m: Option<f64>,
    /// Box centre, metres; with `x_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub y_m: Option<f64>,
    /// Heading, radians, wrapped when read; a request may have at most a full turn either way, 6.2832.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub heading_rad: Option<f64>,
    /// Frame `agent`: metres along the start's heading; with `left_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1500.0, max = 1500.0))]
    pub ahead_m: Option<f64>,
    /// Frame `agent`: metres to the left of the start's heading; with `ahead_m` or not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1500.0, max = 1500.0))]
    pub left_m: Option<f64>,
    /// Frame `agent`: radians from the start's heading, wrapped when read; a request may have at most a full
    /// turn either way, 6.2832.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub turn_rad: Option<f64>,
    /// m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 60.0))]
    pub speed_mps: Option<f64>,
    /// Velocity in place of `speed_mps`; it also fixes a free heading.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<VelocityDoc>,
    /// Scene time, seconds; the end of the window when free. Snapped to 0.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.45, max = 80.05))]
    pub time_s: Option<f64>,
    /// Ids of road edges of the map, such as those of a median, that the road user may drive over, without a fault
    /// and without a detour.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 32))]
    pub may_cross: Vec<String>,
    /// Road user that the goal is relative to. The relation replaces position, heading and, where none is fixed,
    /// speed; with `after_s` it replaces the time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relation: Option<GoalRelationDoc>,
}

/// A goal relative to another road user: exactly one of `ahead_m`, `behind_m`, `behind_s` and `after_s`. It follows the
/// motion of the other one: its future of the same call if it is generated too, else the motion that it keeps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = one_place)]
pub struct GoalRelationDoc {
    /// Id of the other road user. Relations form no cycle, and no chain of more than four.
    pub to: String,
    /// Gap from the front of the other one to the rear of this road user, along the lanes, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 500.0))]
    pub ahead_m: Option<f64>,
    /// Gap from the front of this road user to the rear of the other one, along the lanes, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 500.0))]
    pub behind_m: Option<f64>,
    /// The same gap in seconds at the speed of the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 20.0))]
    pub behind_s: Option<f64>,
    /// Seconds from the moment when the other one is nearest to the goal's position until the goal is
    /// reached; negative is before.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -30.0, max = 30.0))]
    pub after_s: Option<f64>,
    /// Speed difference to the other one, m/s: positive is slower, negative is faster. Not with `after_s`; 0
    /// when free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -60.0, max = 60.0))]
    pub slower_mps: Option<f64>,
    /// Number of lanes to the left of the other one's lane, in its direction; negative is to the right. Not with
    /// `after_s`; 0 when free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -4, max = 4))]
    pub lanes_left: Option<i32>,
}

impl GoalRelationDoc {
    /// Its members named in [`PLACES`], in that order.
    pub(super) fn places(&self) -> [Option<f64>; PLACES.len()] {
        [self.ahead_m, self.behind_m, self.behind_s, self.after_s]
    }
}

impl From<&GoalRelation> for GoalRelationDoc {
    fn from(relation: &GoalRelation) -> Self {
        let GoalRelation { to, place, slower_mps, lanes_left } = relation;
        let mut doc = Self {
            slower_mps: Some(*slower_mps).filter(|v| *v != 0.0),
            lanes_left: Some(*lanes_left).filter(|v| *v != 0),
            ..Self { to: to.clone(), ..Self::default() }
        };
        let (member, value) = match place {
            RelativePlace::Ahead(m) => (&mut doc.ahead_m, m),
            RelativePlace::Behind(m) => (&mut doc.behind_m, m),
            RelativePlace::BehindBy(s) => (&mut doc.behind_s, s),
            RelativePlace::After(s) => (&mut doc.after_s, s),
        };
        *member = Some(*value);
        doc
    }
}

/// A via point of a road user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViaDoc {
    /// Box centre, metres, scene frame.
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub x_m: f64,
    /// Box centre, metres, scene frame.
    #[schemars(range(min = -10000.0, max = 10000.0))]
    pub y_m: f64,
    /// Greatest distance at which it counts as passed, metres; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.5, max = 5.0))]
    pub tolerance_m: Option<f64>,
    /// Scene time at which it is passed, seconds, with a tolerance of half a second; any time if free. Later than
    /// those before it and no later than the goal. Snapped to 0.1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.45, max = 80.05))]
    pub time_s: Option<f64>,
}

/// Conditions of one road user. A number fixes a field; null or absence leaves it free.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConditionsDoc {
    /// Type whose expert is used in place of the expert of the road user's own type.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "expert_types")]
    pub agent_type: Option<AgentType>,
    /// Length, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.2, max = 25.0))]
    pub length_m: Option<f64>,
    /// Width, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.2, max = 4.0))]
    pub width_m: Option<f64>,
    /// Start fields.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartDoc>,
    /// Goal fields.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<GoalDoc>,
    /// Via points in the order in which they are passed, always in the frame `scene`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 4))]
    pub via: Vec<ViaDoc>,
    /// Frame of the goal; replies are always in `scene`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "frames")]
    pub frame: Option<GoalFrame>,
}
