//! A situation of a plan or a search, and its conditions on road users.

use super::ranges::{GoalRanges, GoalRelationRanges, OtherKinds, StartRanges, is_default};
use crate::distribution::Distribution;
use crate::pattern::choice::PatternChoice;
use crate::pattern::document::RoadPattern;
use crate::recorded::RecordedMotion;
use crate::who::{self, AgentSelector};
use formats::native::{ConditionsDoc, GoalDoc, GoalFrame};
use scene::scenarios::Template;
use scene::{AgentType, Scene};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a situation without name is called where nobody is asked for anything.
const FREE: &str = "free";
/// Conditions that can be drawn.
pub const MOST_CONDITIONS: usize = 28;

/// One situation.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BatchSituation {
    /// Name in the results: letters, digits, - and _. Default: that of the template or the pattern, or `free`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Test situation that the scene is searched for. The actor is picked from the scene; the seed decides which.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "templates")]
    pub template: Option<String>,
    /// Pattern of the road that the maps of the scenes are searched for: a name of `dragtraffic match --list`, a file, or
    /// the pattern itself. Its road users are placed where it fits, and those of the scene are removed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pattern: Option<PatternChoice>,
    /// By name: figures of the template, of which absent ones are drawn by the seed; or parameters of the pattern, of
    /// which absent ones have their standard values.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, Distribution>,
    /// Road users that get the conditions: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`.
    /// Each is generated in separate units.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub agents: Vec<String>,
    /// Goal.
    #[serde(skip_serializing_if = "is_default")]
    pub goal: GoalRanges,
    /// Start.
    #[serde(skip_serializing_if = "is_default")]
    pub start: StartRanges,
    /// Length of the road user, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<Distribution>,
    /// Width of the road user, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_m: Option<Distribution>,
    /// Type of the road user, in place of its own.
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub agent_type: Option<AgentType>,
    /// Types and sizes of the other road users.
    #[serde(skip_serializing_if = "is_default")]
    pub others: OtherKinds,
    /// Id of the other road user of the figures under `pair.`. Default: the one that a template or a pattern
    /// affects, else the one with which a collision comes nearest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
}

fn templates(_: &mut SchemaGenerator) -> Schema {
    let names: Vec<&str> = Template::ALL.iter().map(|template| template.name()).collect();
    json_schema!({"type": ["string", "null"], "enum": names})
}

/// A number of a situation that is drawn.
pub struct Dimension<'a> {
    /// Path in the situation, such as `goal.speed_mps`.
    pub path: String,
    /// Where its values come from.
    pub distribution: &'a Distribution,
}

impl BatchSituation {
    /// What it is called in the results.
    pub fn name(&self) -> &str {
        let pattern = || self.pattern().map(|pattern| pattern.name.as_str());
        self.name.as_deref().or(self.template.as_deref()).or_else(pattern).unwrap_or(FREE)
    }

    /// Its pattern.
    pub fn pattern(&self) -> Option<&RoadPattern> {
        self.pattern.as_ref().and_then(|choice| choice.pattern().ok())
    }

    /// Its template.
    pub fn template(&self) -> Option<Template> {
        Template::ALL.into_iter().find(|template| self.template.as_deref() == Some(template.name()))
    }

    /// The numbers that are drawn, in a fixed order.
    pub fn dimensions(&self) -> Vec<Dimension<'_>> {
        let parameters = self
            .parameters
            .iter()
            .map(|(name, distribution)| Dimension { path: format!("parameters.{name}"), distribution });
        let conditions = self.conditions().into_iter().filter_map(|(path, distribution)| {
            Some(Dimension { path: path.to_owned(), distribution: distribution.as_ref()? })
        });
        parameters.chain(conditions).collect()
    }

    pub(super) fn conditions(&self) -> [(&'static str, &Option<Distribution>); MOST_CONDITIONS] {
        let Self { goal, start, length_m, width_m, others, .. } = self;
        let relation =
            |of: fn(&GoalRelationRanges) -> &Option<Distribution>| goal.relation.as_ref().map_or(&None, of);
        [
            ("goal.x_m", &goal.x_m),
            ("goal.y_m", &goal.y_m),
            ("goal.heading_rad", &goal.heading_rad),
            ("goal.ahead_m", &goal.ahead_m),
            ("goal.left_m", &goal.left_m),
            ("goal.turn_rad", &goal.turn_rad),
            ("goal.speed_mps", &goal.speed_mps),
            ("goal.time_s", &goal.time_s),
            ("start.x_m", &start.x_m),
            ("start.y_m", &start.y_m),
            ("start.heading_rad", &start.heading_rad),
            ("start.speed_mps", &start.speed_mps),
            ("length_m", length_m),
            ("width_m", width_m),
            ("goal.relation.ahead_m", relation(|r| &r.ahead_m)),
            ("goal.relation.behind_m", relation(|r| &r.behind_m)),
            ("goal.relation.behind_s", relation(|r| &r.behind_s)),
            ("goal.relation.after_s", relation(|r| &r.after_s)),
            ("goal.relation.slower_mps", relation(|r| &r.slower_mps)),
            ("goal.relation.lanes_left", relation(|r| &r.lanes_left)),
            ("goal.speed_times", &goal.speed_times),
            ("goal.later_s", &goal.later_s),
            ("start.ahead_m", &start.ahead_m),
            ("start.left_m", &start.left_m),
            ("start.turn_rad", &start.turn_rad),
            ("start.speed_times", &start.speed_times),
            ("others.length_m", &others.length_m),
            ("others.width_m", &others.width_m),
        ]
    }

    /// What a plan says about its conditions beside the drawn numbers; `None` where it says nothing.
    pub(crate) fn fixed(&self) -> Option<impl Serialize + '_> {
        let relative_to = self.goal.relation.as_ref().map(|relation| relation.to.as_str());
        let OtherKinds { agents, agent_type, .. } = &self.others;
        let is_plain = relative_to.is_none() && !self.goal.recorded && self.agent_type.is_none();
        let fixed = (relative_to, self.goal.recorded, self.agent_type, agents, agent_type);
        (!is_plain || !agents.is_empty()).then_some(fixed)
    }

    /// The conditions of a road user: `own` with the drawn numbers in place of its values; `None` if its recording lacks
    /// the state to which they are relative.
    pub fn applied(
        &self,
        own: ConditionsDoc,
        drawn: &BTreeMap<String, f64>,
        recording: Option<&RecordedMotion<'_>>,
    ) -> Option<ConditionsDoc> {
        let of = |path: &str| drawn.get(path).copied();
        let mut conditions = own;
        if self.goal.recorded {
            conditions.frame = None;
            conditions.goal = Some(recording?.goal(&of)?);
        } else if self.goal != GoalRanges::default() {
            let goal = GoalDoc {
                x_m: of("goal.x_m"),
                y_m: of("goal.y_m"),
                heading_rad: of("goal.heading_rad"),
                ahead_m: of("goal.ahead_m"),
                // Straight ahead by default.
                left_m: of("goal.left_m").or(of("goal.ahead_m").map(|_| 0.0)),
                turn_rad: of("goal.turn_rad"),
                speed_mps: of("goal.speed_mps"),
                time_s: of("goal.time_s"),
                relation: self.goal.relation.as_ref().map(|relation| relation.drawn(&of)),
                ..GoalDoc::default()
            };
            conditions.frame = self.goal.is_relative().then_some(GoalFrame::Agent);
            conditions.goal = Some(goal);
        }
        if self.start != StartRanges::default() {
            conditions.start = Some(recording?.start(&of)?);
        }
        conditions.agent_type = self.agent_type.or(conditions.agent_type);
        conditions.length_m = of("length_m").or(conditions.length_m);
        conditions.width_m = of("width_m").or(conditions.width_m);
        Some(conditions)
    }

    /// The road users of a scene whose kind or size it sets.
    pub fn beside(&self, scene: &Scene, start_step: usize) -> Vec<String> {
        let who: Vec<AgentSelector> =
            self.others.agents.iter().filter_map(|text| text.parse().ok()).collect();
        who::actors(&who, scene, start_step)
    }

    /// The conditions of a road user beside the one with the goal.
    pub fn applied_beside(&self, own: ConditionsDoc, drawn: &BTreeMap<String, f64>) -> ConditionsDoc {
        let of = |path: &str| drawn.get(path).copied();
        ConditionsDoc {
            agent_type: self.others.agent_type.or(own.agent_type),
            length_m: of("others.length_m").or(own.length_m),
            width_m: of("others.width_m").or(own.width_m),
            ..own
        }
    }

    /// The drawn parameters of the template, by their names there.
    pub fn parameters_of(&self, drawn: &BTreeMap<String, f64>) -> BTreeMap<String, f64> {
        let named =
            |(path, value): (&String, &f64)| Some((path.strip_prefix("parameters.")?.to_owned(), *value));
        drawn.iter().filter_map(named).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::BatchSituation;
    use formats::native::ConditionsDoc;
    use std::collections::BTreeMap;

    #[test]
    fn a_relation_has_drawn_numbers() {
        let text = r#"{"agents":["6"],"goal":{"time_s":5,"relation":{"to":"4","ahead_m":{"uniform":[5,15]},"lanes_left":1}}}"#;
        let situation: BatchSituation = serde_json::from_str(text).unwrap();
        let mut faults = Vec::new();
        situation.check("situations[0]", &mut faults);
        assert!(faults.is_empty(), "{faults:?}");
        let drawn = [("goal.time_s", 5.0), ("goal.relation.ahead_m", 7.5), ("goal.relation.lanes_left", 1.0)];
        let drawn = drawn.map(|(path, value)| (path.to_owned(), value)).into();
        let applied =
            serde_json::to_value(situation.applied(ConditionsDoc::default(), &drawn, None)).unwrap();
        let relation = serde_json::json!({"to": "4", "ahead_m": 7.5, "lanes_left": 1});
        assert_eq!(applied, serde_json::json!({"goal": {"time_s": 5.0, "relation": relation}}));
        let two = r#"{"agents":["6"],"goal":{"relation":{"to":"4","ahead_m":5,"after_s":1}}}"#;
        serde_json::from_str::<BatchSituation>(two).unwrap().check("situations[0]", &mut faults);
        assert_eq!(faults.len(), 1);
    }

    #[test]
    fn types_and_kinds_of_others_are_conditions() {
        let text = r#"{"agents":["6"],"type":"cyclist","others":{"agents":["@vehicles"],"length_m":12}}"#;
        let situation: BatchSituation = serde_json::from_str(text).unwrap();
        let drawn = BTreeMap::from([("others.length_m".to_owned(), 12.0)]);
        let own = situation.applied(ConditionsDoc::default(), &drawn, None);
        assert_eq!(serde_json::to_value(own).unwrap(), serde_json::json!({"type": "cyclist"}));
        let beside = situation.applied_beside(ConditionsDoc::default(), &drawn);
        assert_eq!(serde_json::to_value(beside).unwrap(), serde_json::json!({"length_m": 12.0}));
        assert!(situation.fixed().is_some());
    }

    #[test]
    fn drawn_numbers_replace_the_parts_that_are_varied() {
        let situation: BatchSituation =
            serde_json::from_str(r#"{"agents":["6"],"goal":{"ahead_m":40},"width_m":2}"#).unwrap();
        let own: ConditionsDoc = serde_json::from_str(r#"{"start":{"speed_mps":3},"width_m":1.8}"#).unwrap();
        let drawn = BTreeMap::from([("goal.ahead_m".to_owned(), 40.0), ("width_m".to_owned(), 2.0)]);
        let applied = serde_json::to_value(situation.applied(own, &drawn, None)).unwrap();
        let expected = serde_json::json!({
            "start": {"speed_mps": 3.0}, "width_m": 2.0, "frame": "agent", "goal": {"ahead_m": 40.0, "left_m": 0.0}
        });
        assert_eq!(applied, expected);
    }
}
