//! What happens in the scenes of a plan: a template with parameters, or conditions of single road users.

use crate::distribution::Distribution;
use crate::fault::PlanFault;
use crate::names::{hint, is_name};
use crate::pattern::choice::PatternChoice;
use crate::pattern::document::RoadPattern;
use crate::recorded::{MOST_SHIFT_S, MOST_TIMES, RecordedMotion};
use crate::who::{self, AgentSelector};
use formats::native::{ConditionsDoc, GoalDoc, GoalFrame, GoalRelationDoc, StartDoc};
use scene::scenarios::Template;
use scene::{AgentType, Scene};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// What a situation without name is called where nobody is asked for anything.
const FREE: &str = "free";
/// Conditions that can be drawn.
pub const MOST_CONDITIONS: usize = 28;
/// Longest name, in characters.
const MOST_NAME: usize = 60;

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
    /// the pattern itself. Its road users are put at each place where it fits; those of the scene are left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pattern: Option<PatternChoice>,
    /// Figures of the template by name, those absent are drawn by the seed; or parameters of the pattern, those absent
    /// have their standard values.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, Distribution>,
    /// Road users that get the conditions: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`.
    /// Each is generated in units of its own.
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
    /// Type that the road user has in place of its own.
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub agent_type: Option<AgentType>,
    /// What the road users beside it are.
    #[serde(skip_serializing_if = "is_default")]
    pub others: OtherKinds,
    /// Id of the road user that the figures under `pair.` are about. Default: the one that a template or a pattern
    /// affects, else the one with whom it comes nearest to a collision.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
}

/// Kind and size of the road users that are there beside the one with the conditions.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OtherKinds {
    /// Who: ids, `@all`, `@moving`, `@vehicles`, `@pedestrians`, `@cyclists`, `@ego`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub agents: Vec<String>,
    /// Type in place of their own.
    #[serde(rename = "type", skip_serializing_if = "Option::is_none")]
    pub agent_type: Option<AgentType>,
    /// Length of each, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<Distribution>,
    /// Width of each, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_m: Option<Distribution>,
}

/// Fields of a goal; those absent are free.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GoalRanges {
    /// The goal is where the recording has the road user at `time_s`, with its heading and speed there; `ahead_m`,
    /// `left_m` and `turn_rad` are from there, in place of the start. Default: false.
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
    /// What the goal is relative to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relation: Option<GoalRelationRanges>,
}

/// A goal relative to another road user: exactly one of `ahead_m`, `behind_m`, `behind_s` and `after_s`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalRelationRanges {
    /// Id of the other road user.
    pub to: String,
    /// Gap from the front of the other one to the own rear, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead_m: Option<Distribution>,
    /// Gap from the own front to the rear of the other one, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_m: Option<Distribution>,
    /// The same gap in seconds at the speed of the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_s: Option<Distribution>,
    /// The goal's own place is reached so many seconds after the other one was nearest to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after_s: Option<Distribution>,
    /// How much slower than the other one, m/s; negative is faster.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slower_mps: Option<Distribution>,
    /// Lanes to the left of the other one's, in whole numbers; negative is to the right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lanes_left: Option<Distribution>,
}

/// Fields of a start; those absent are the scene's: of the conditions there, else of the recording.
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
    /// Radians from the heading there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_rad: Option<Distribution>,
    /// Metres per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_mps: Option<Distribution>,
    /// Multiple of the speed in the scene, in place of `speed_mps`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_times: Option<Distribution>,
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
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

    fn conditions(&self) -> [(&'static str, &Option<Distribution>); MOST_CONDITIONS] {
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

    /// The conditions of a road user, `own` with the drawn numbers in place of its own; `None` where its recording lacks
    /// what they begin at.
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

    /// Every fault of it; `path` is its place in the plan.
    pub(crate) fn check(&self, path: &str, faults: &mut Vec<PlanFault>) {
        self.check_name(path, faults);
        self.check_template(path, faults);
        self.check_pattern(path, faults);
        for (i, text) in self.agents.iter().enumerate() {
            if let Err(reason) = text.parse::<AgentSelector>() {
                faults.push(PlanFault::new(format!("{path}.agents[{i}]"), reason));
            }
        }
        let under = |member: &str| format!("{path}.{member}");
        let mut fault = |member: &str, detail: &str| faults.push(PlanFault::new(under(member), detail));
        let asks = self.goal.recorded
            || self.agent_type.is_some()
            || self.others != OtherKinds::default()
            || self.conditions().iter().any(|(_, distribution)| distribution.is_some());
        if self.template.is_some() && (asks || !self.agents.is_empty()) {
            fault(
                "template",
                "a template picks the road user and its goal; agents and conditions exclude it",
            );
        } else if self.pattern.is_some() && (asks || !self.agents.is_empty() || self.template.is_some()) {
            fault("pattern", "a pattern has its own road users; agents, conditions and template exclude it");
        } else if self.with.is_some() && self.agents.is_empty() {
            fault("with", "it needs agents; a template or a pattern has its own other road user");
        } else if asks && self.agents.is_empty() {
            fault(
                "agents",
                "who gets the conditions? ids, @all, @moving, @vehicles, @pedestrians, @cyclists or @ego",
            );
        }
        self.check_kinds(&mut fault);
        self.check_recorded(&mut fault);
        let GoalRanges { recorded, x_m, y_m, heading_rad, ahead_m, left_m, .. } = &self.goal;
        if x_m.is_some() != y_m.is_some() {
            fault("goal", "x_m and y_m are fixed together or not at all");
        }
        if left_m.is_some() && ahead_m.is_none() && !recorded {
            fault("goal.left_m", "left_m needs ahead_m beside it");
        }
        if self.goal.is_relative() && !recorded && (x_m.is_some() || heading_rad.is_some()) {
            fault(
                "goal",
                "ahead_m, left_m and turn_rad are from the start, x_m, y_m and heading_rad of the scene",
            );
        }
        if let Some(GoalRelationRanges { ahead_m, behind_m, behind_s, after_s, .. }) = &self.goal.relation
            && [ahead_m, behind_m, behind_s, after_s].into_iter().flatten().count() != 1
        {
            fault("goal.relation", "exactly one of ahead_m, behind_m, behind_s and after_s expected");
        }
        if self.start.x_m.is_some() != self.start.y_m.is_some() {
            fault("start", "x_m and y_m are fixed together or not at all");
        }
        for (member, distribution) in self.conditions() {
            if let Some(distribution) = distribution {
                distribution.check(&under(member), range(member), faults);
            }
        }
    }

    fn check_kinds(&self, fault: &mut dyn FnMut(&str, &str)) {
        for (member, kind) in [("type", self.agent_type), ("others.type", self.others.agent_type)] {
            if kind == Some(AgentType::Other) {
                fault(member, "vehicle, pedestrian or cyclist expected");
            }
        }
        let OtherKinds { agents, agent_type, length_m, width_m } = &self.others;
        for text in agents {
            if let Err(reason) = text.parse::<AgentSelector>() {
                fault("others.agents", &reason);
            }
        }
        let says = agent_type.is_some() || length_m.is_some() || width_m.is_some();
        if agents.is_empty() == says {
            fault("others", "agents and at least one of type, length_m and width_m expected");
        }
    }

    fn check_recorded(&self, fault: &mut dyn FnMut(&str, &str)) {
        let GoalRanges { recorded, x_m, heading_rad, speed_mps, speed_times, later_s, relation, .. } =
            &self.goal;
        if !recorded && (speed_times.is_some() || later_s.is_some()) {
            fault("goal", "speed_times and later_s need recorded = true");
        }
        if *recorded && (x_m.is_some() || heading_rad.is_some() || relation.is_some()) {
            fault(
                "goal.recorded",
                "a recorded goal has its place and heading; ahead_m, left_m and turn_rad push it",
            );
        }
        if speed_mps.is_some() && speed_times.is_some() {
            fault("goal.speed_times", "speed_mps excludes it");
        }
        let StartRanges { x_m, heading_rad, speed_mps, speed_times, ahead_m, left_m, turn_rad, .. } =
            &self.start;
        let moves = ahead_m.is_some() || left_m.is_some();
        if moves && x_m.is_some() || turn_rad.is_some() && heading_rad.is_some() {
            fault(
                "start",
                "ahead_m, left_m and turn_rad are from the start, x_m, y_m and heading_rad of the scene",
            );
        }
        if speed_mps.is_some() && speed_times.is_some() {
            fault("start.speed_times", "speed_mps excludes it");
        }
    }

    fn check_name(&self, path: &str, faults: &mut Vec<PlanFault>) {
        if self.name.as_ref().is_some_and(|name| !is_name(name, MOST_NAME)) {
            let detail = format!("1 to {MOST_NAME} letters, digits, - and _ expected");
            faults.push(PlanFault::new(format!("{path}.name"), detail));
        }
    }

    fn check_pattern(&self, path: &str, faults: &mut Vec<PlanFault>) {
        let Some(choice) = &self.pattern else { return };
        let under = format!("{path}.pattern");
        let pattern = match choice.pattern() {
            Ok(pattern) => pattern,
            Err(reason) => {
                faults.push(PlanFault::new(under, reason));
                return;
            }
        };
        pattern.check(&under, faults);
        for (name, distribution) in &self.parameters {
            let path = format!("{path}.parameters.{name}");
            match pattern.parameters.get(name) {
                Some(parameter) => distribution.check(&path, parameter.range, faults),
                None => {
                    let known: Vec<&str> = pattern.parameters.keys().map(String::as_str).collect();
                    faults.push(PlanFault::new(path, unknown(name, &known)));
                }
            }
        }
    }

    fn check_template(&self, path: &str, faults: &mut Vec<PlanFault>) {
        let template = self.template();
        if let (Some(name), None) = (&self.template, template) {
            let known: Vec<&str> = Template::ALL.iter().map(|template| template.name()).collect();
            faults.push(PlanFault::new(format!("{path}.template"), unknown(name, &known)));
            return;
        }
        if self.pattern.is_some() {
            return;
        }
        let figures = template.map_or(&[][..], Template::figures);
        for (name, distribution) in &self.parameters {
            let path = format!("{path}.parameters.{name}");
            match figures.iter().find(|figure| figure.name == name) {
                Some(figure) => distribution.check(&path, figure.allowed, faults),
                None if template.is_none() => {
                    faults.push(PlanFault::new(path, "parameters belong to a template or a pattern"));
                }
                None => {
                    let known: Vec<&str> = figures.iter().map(|figure| figure.name).collect();
                    faults.push(PlanFault::new(path, unknown(name, &known)));
                }
            }
        }
    }
}

/// What is said about a name that is none of the known ones.
fn unknown(name: &str, known: &[&str]) -> String {
    format!("\"{name}\" is unknown{}; there are {}", hint(name, known.iter().copied()), known.join(", "))
}

impl GoalRelationRanges {
    /// The relation with drawn numbers, by their paths in the situation.
    fn drawn(&self, of: &dyn Fn(&str) -> Option<f64>) -> GoalRelationDoc {
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
    fn is_relative(&self) -> bool {
        self.ahead_m.is_some() || self.left_m.is_some() || self.turn_rad.is_some()
    }
}

/// The range of a condition, as its document has it.
fn range(member: &str) -> (f64, f64) {
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
    use super::{BatchSituation, range};
    use formats::native::ConditionsDoc;
    use std::collections::BTreeMap;

    #[test]
    fn ranges_are_those_of_the_documents() {
        assert_eq!(range("goal.speed_mps"), (0.0, 60.0));
        assert_eq!(range("length_m"), (0.2, 25.0));
        assert_eq!(range("start.x_m"), (-10_000.0, 10_000.0));
        assert_eq!(range("goal.relation.behind_s"), (0.0, 20.0));
    }

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

    /// The faults of a situation.
    fn faults(text: &str) -> Vec<String> {
        let mut faults = Vec::new();
        serde_json::from_str::<BatchSituation>(text).unwrap().check("s", &mut faults);
        faults.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn types_and_kinds_of_others_are_conditions() {
        let text = r#"{"agents":["6"],"type":"cyclist","others":{"agents":["@vehicles"],"length_m":12}}"#;
        let situation: BatchSituation = serde_json::from_str(text).unwrap();
        assert_eq!(faults(text), Vec::<String>::new());
        let drawn = BTreeMap::from([("others.length_m".to_owned(), 12.0)]);
        let own = situation.applied(ConditionsDoc::default(), &drawn, None);
        assert_eq!(serde_json::to_value(own).unwrap(), serde_json::json!({"type": "cyclist"}));
        let beside = situation.applied_beside(ConditionsDoc::default(), &drawn);
        assert_eq!(serde_json::to_value(beside).unwrap(), serde_json::json!({"length_m": 12.0}));
        assert!(situation.fixed().is_some());
        let wrong = faults(r#"{"agents":["6"],"type":"other","others":{"agents":["@vehicles"]}}"#);
        assert_eq!(wrong.len(), 2, "{wrong:?}");
    }

    #[test]
    fn recorded_goals_exclude_places_of_the_scene() {
        let at = |goal: &str| faults(&format!(r#"{{"agents":["6"],"goal":{goal}}}"#));
        assert_eq!(
            at(r#"{"recorded":true,"left_m":{"uniform":[-2,2]},"later_s":-1,"speed_times":0.5}"#),
            [""; 0]
        );
        assert_eq!(at(r#"{"later_s":1}"#), ["s.goal: speed_times and later_s need recorded = true"]);
        assert_eq!(at(r#"{"recorded":true,"speed_mps":1,"speed_times":1}"#).len(), 1);
        assert_eq!(at(r#"{"recorded":true,"heading_rad":1}"#).len(), 1);
        assert_eq!(at(r#"{"recorded":true,"later_s":30}"#), ["s.goal.later_s: 30 is outside -20 to 20"]);
        let moved = r#"{"agents":["6"],"start":{"ahead_m":2,"x_m":1,"y_m":1}}"#;
        assert_eq!(faults(moved).len(), 1);
        // A recording is asked for.
        let situation: BatchSituation =
            serde_json::from_str(r#"{"agents":["6"],"goal":{"recorded":true}}"#).unwrap();
        assert!(situation.applied(ConditionsDoc::default(), &BTreeMap::new(), None).is_none());
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
