//! The document of a pattern: the road that it needs, the road users on it, and its varied numbers.

use super::number::PatternNumber;
use crate::fault::{self, PlanFault};
use crate::names::{hint, is_name};
use scene::relation::MAX_RELATED_IN_A_ROW;
use scene::{AgentType, Subtype};
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// Most road users of a pattern.
pub const MOST_USERS: usize = 8;
/// Longest path before and after a place, metres.
pub const MOST_WAY_M: f64 = 400.0;
/// Longest id of a road user, in characters.
const MOST_ID: usize = 30;

/// A situation on any map: requirements on the road, and the road users there.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "DragTraffic pattern")]
pub struct RoadPattern {
    /// Short name: letters, digits, - and _.
    pub name: String,
    /// One sentence.
    pub title: String,
    /// Source of the parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    /// The road.
    pub road: RoadNeeds,
    /// Numbers that may be varied, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, PatternParameter>,
    /// Road users. The first one is the subject: its goal may stay free.
    pub users: Vec<PatternUser>,
}

/// A number that may be varied.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternParameter {
    /// Standard value.
    pub value: f64,
    /// Least and greatest value.
    pub range: (f64, f64),
    /// Description.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// Requirements on the road.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoadNeeds {
    /// Feature at the place.
    pub feature: RoadFeature,
    /// Way of the subject before the place, metres. Most: 400.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 400.0))]
    pub before_m: f64,
    /// Way of the subject after the place, metres. Most: 400.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 400.0))]
    pub after_m: f64,
    /// Turn of the subject's way: from 25 m before the place to 5 m after it; for the feature `lane` over the
    /// whole way.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<RoadTurn>,
    /// Direction from which the other way comes, as seen by the subject.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<OtherSide>,
    /// A lane beside the place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbor: Option<LaneSide>,
    /// The way of the subject bends within 60 m before the place, or stays straight there. Default: either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend: Option<bool>,
    /// A signal controls the way of the subject, or none does. Default: either.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signal: Option<bool>,
    /// Least and greatest speed limit of the lane, km/h. Default: any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit_kmh: Option<(f64, f64)>,
}

/// Feature at the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RoadFeature {
    /// A lane for motor vehicles outside of junctions.
    Lane,
    /// A crosswalk across the way of the subject.
    Crosswalk,
    /// The way of the subject crosses another lane for motor vehicles.
    Crossing,
    /// The way of the subject joins another lane.
    Merge,
    /// The way of the subject joins a roundabout.
    RoundaboutEntry,
}

/// Turn of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RoadTurn {
    /// By less than 20 degrees.
    Straight,
    /// To the left by more than 35 degrees.
    Left,
    /// To the right by more than 35 degrees.
    Right,
}

/// Direction from which another way comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OtherSide {
    /// From the left.
    Left,
    /// From the right.
    Right,
    /// Towards the subject, before it turns.
    Oncoming,
}

/// A lane beside another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LaneSide {
    /// In the same direction, to the left.
    Left,
    /// In the same direction, to the right.
    Right,
    /// In the opposite direction.
    Oncoming,
}

/// A way at the place, along which road users are placed. All ways have the place at 0 m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PatternWay {
    /// The way of the subject.
    #[default]
    Own,
    /// The way of the subject, in the opposite direction.
    Against,
    /// The lane that is crossed or joined.
    Other,
    /// The lane to the left, in the same direction.
    Left,
    /// The lane to the right, in the same direction.
    Right,
    /// The lane in the opposite direction.
    Oncoming,
    /// Across the way of the subject, from the left; along the crosswalk if there is one.
    FromLeft,
    /// Across the way of the subject, from the right; along the crosswalk if there is one.
    FromRight,
}

/// A road user of a pattern.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternUser {
    /// Letters, digits, - and _.
    pub id: String,
    /// Type.
    #[serde(rename = "type")]
    pub agent_type: AgentType,
    /// Finer type, such as `child` or `truck`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<String>")]
    pub subtype: Option<Subtype>,
    /// Length of its box, metres. Default: that of the type.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_m: Option<PatternNumber>,
    /// Width of its box, metres. Default: that of the type.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<PatternNumber>,
    /// The way on which it starts.
    #[serde(default)]
    pub way: PatternWay,
    /// Start along the way, metres from the place; negative is before it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_m: Option<PatternNumber>,
    /// Start along the way, seconds from the place at its speed; negative is before it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_s: Option<PatternNumber>,
    /// Id of an earlier road user of the list ahead of which this one starts, with `gap_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead_of: Option<String>,
    /// Gap along the way between the two boxes, metres, with `ahead_of`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_m: Option<PatternNumber>,
    /// Metres to the left of the way.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_m: Option<PatternNumber>,
    /// Speed at the start, km/h.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_kmh: Option<PatternNumber>,
    /// Exact goal. Default: free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<PatternGoal>,
    /// Via points on its way, metres from the place, at any time; at most 4.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub via_m: Vec<PatternNumber>,
}

/// The goal of a road user. Its position follows from `at_m`, from `relation`, or from the mean of both
/// speeds over the time.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PatternGoal {
    /// Way of the goal. Default: that of the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub way: Option<PatternWay>,
    /// Seconds after the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<PatternNumber>,
    /// Constant braking from the speed of the start to that of the goal, in place of a time, m/s2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub braking_mps2: Option<PatternNumber>,
    /// Metres along the way from the place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<PatternNumber>,
    /// Metres to the left of the way. Default: as at the start on the same way, else 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_m: Option<PatternNumber>,
    /// Speed, km/h. Default: that of the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_kmh: Option<PatternNumber>,
    /// Position relative to another road user and its motion in the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relation: Option<PatternRelation>,
}

/// A goal relative to another road user: exactly one of `ahead_m`, `behind_m` and `behind_s`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternRelation {
    /// Its id.
    pub to: String,
    /// Gap from the front of the other one to the rear of this road user, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ahead_m: Option<PatternNumber>,
    /// Gap from the front of this road user to the rear of the other one, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_m: Option<PatternNumber>,
    /// The same gap in seconds at the speed of the goal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub behind_s: Option<PatternNumber>,
    /// Number of lanes to the left of the other one's lane; negative is to the right.
    #[serde(default)]
    pub lanes_left: i32,
}

impl RoadPattern {
    /// Reads a pattern from TOML.
    ///
    /// # Errors
    /// Its faults, each with its path; an unknown member has a suggestion.
    pub fn parse(text: &str) -> Result<Self, Vec<PlanFault>> {
        let pattern: Self = fault::document(text)?;
        let mut faults = Vec::new();
        pattern.check("", &mut faults);
        if faults.is_empty() { Ok(pattern) } else { Err(faults) }
    }

    /// The default values of its parameters.
    pub fn standard(&self) -> BTreeMap<String, f64> {
        self.parameters.iter().map(|(name, of)| (name.clone(), of.value)).collect()
    }

    /// Checks the pattern; the paths of faults begin with `under`.
    pub(crate) fn check(&self, under: &str, faults: &mut Vec<PlanFault>) {
        let place = |member: &str| {
            if under.is_empty() { member.to_owned() } else { format!("{under}.{member}") }
        };
        let mut fault = |member: &str, detail: String| faults.push(PlanFault::new(place(member), detail));
        if !is_name(&self.name, MOST_ID) {
            fault("name", format!("1 to {MOST_ID} letters, digits, - and _ expected"));
        }
        for (member, metres) in [("road.before_m", self.road.before_m), ("road.after_m", self.road.after_m)] {
            if !(0.0..=MOST_WAY_M).contains(&metres) {
                fault(member, format!("{metres} is outside 0 to {MOST_WAY_M}"));
            }
        }
        if self.road.from.is_some() && self.road.feature == RoadFeature::Lane {
            fault("road.from", "a lane has no other way".into());
        }
        for (name, PatternParameter { value, range: (least, most), .. }) in &self.parameters {
            let member = format!("parameters.{name}");
            if !is_name(name, MOST_ID) {
                fault(&member, format!("1 to {MOST_ID} letters, digits, - and _ expected"));
            }
            if !(least <= value && value <= most) {
                fault(&member, format!("{value} is outside its range, {least} to {most}"));
            }
        }
        if !(1..=MOST_USERS).contains(&self.users.len()) {
            fault("users", format!("1 to {MOST_USERS} expected"));
        }
        let mut known: BTreeSet<&str> = BTreeSet::new();
        let all: Vec<&str> = self.users.iter().map(|user| user.id.as_str()).collect();
        let mut related = 0;
        for (i, user) in self.users.iter().enumerate().take(MOST_USERS) {
            let mut fault = |member: &str, detail: String| fault(&format!("users[{i}]{member}"), detail);
            if !is_name(&user.id, MOST_ID) || known.contains(user.id.as_str()) {
                fault(".id", format!("1 to {MOST_ID} letters, digits, - and _ of its own expected"));
            }
            if user.agent_type == AgentType::Other {
                fault(".type", "vehicle, pedestrian or cyclist expected".into());
            }
            let starts = [user.at_m.is_some(), user.at_s.is_some(), user.ahead_of.is_some()];
            if starts.iter().filter(|given| **given).count() != 1 {
                fault("", "exactly one of at_m, at_s and ahead_of expected".into());
            }
            if user.ahead_of.is_some() != user.gap_m.is_some() {
                fault(".gap_m", "ahead_of and gap_m are given together".into());
            }
            if let Some(of) = user.ahead_of.as_deref().filter(|of| !known.contains(of)) {
                fault(
                    ".ahead_of",
                    format!("no earlier road user is {of}{}", hint(of, known.iter().copied())),
                );
            }
            if user.via_m.len() > scene::MAX_VIAS {
                fault(".via_m", format!("{} places at most", scene::MAX_VIAS));
            }
            if let Some(goal) = &user.goal {
                related += usize::from(goal.relation.is_some());
                for (member, detail) in goal.faults(&user.id, &all) {
                    fault(&format!(".goal{member}"), detail);
                }
            }
            for (member, number) in user.numbers() {
                if let Some(name) = number.name().filter(|name| !self.parameters.contains_key(*name)) {
                    let names = self.parameters.keys().map(String::as_str);
                    fault(&format!(".{member}"), format!("no parameter is {name}{}", hint(name, names)));
                }
            }
            known.insert(&user.id);
        }
        if related > MAX_RELATED_IN_A_ROW {
            fault("users", format!("{MAX_RELATED_IN_A_ROW} goals with a relation at most"));
        }
    }
}

impl PatternUser {
    /// Its numbers, with the names of their members.
    fn numbers(&self) -> impl Iterator<Item = (&'static str, &PatternNumber)> {
        let goal = |of: fn(&PatternGoal) -> &Option<PatternNumber>| {
            self.goal.as_ref().and_then(|goal| of(goal).as_ref())
        };
        let relation = |of: fn(&PatternRelation) -> &Option<PatternNumber>| {
            self.goal
                .as_ref()
                .and_then(|goal| goal.relation.as_ref())
                .and_then(|relation| of(relation).as_ref())
        };
        let own = [
            ("length_m", self.length_m.as_ref()),
            ("width_m", self.width_m.as_ref()),
            ("at_m", self.at_m.as_ref()),
            ("at_s", self.at_s.as_ref()),
            ("gap_m", self.gap_m.as_ref()),
            ("left_m", self.left_m.as_ref()),
            ("speed_kmh", self.speed_kmh.as_ref()),
            ("goal.time_s", goal(|g| &g.time_s)),
            ("goal.braking_mps2", goal(|g| &g.braking_mps2)),
            ("goal.at_m", goal(|g| &g.at_m)),
            ("goal.left_m", goal(|g| &g.left_m)),
            ("goal.speed_kmh", goal(|g| &g.speed_kmh)),
            ("goal.relation.ahead_m", relation(|r| &r.ahead_m)),
            ("goal.relation.behind_m", relation(|r| &r.behind_m)),
            ("goal.relation.behind_s", relation(|r| &r.behind_s)),
        ];
        let own = own.into_iter().filter_map(|(member, number)| Some((member, number?)));
        own.chain(self.via_m.iter().map(|number| ("via_m", number)))
    }
}

impl PatternGoal {
    fn faults(&self, own: &str, all: &[&str]) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if self.time_s.is_some() == self.braking_mps2.is_some() {
            faults.push(("", "exactly one of time_s and braking_mps2 expected".into()));
        }
        if let Some(relation) = &self.relation {
            if self.at_m.is_some() || self.way.is_some() {
                faults.push((".relation", "a relation says the place; at_m and way exclude it".into()));
            }
            if relation.to == own || !all.contains(&relation.to.as_str()) {
                let names = all.iter().copied().filter(|id| *id != own);
                let slip = hint(&relation.to, names);
                faults.push((".relation.to", format!("no other road user is {}{slip}", relation.to)));
            }
            let PatternRelation { ahead_m, behind_m, behind_s, .. } = relation;
            if [ahead_m, behind_m, behind_s].into_iter().flatten().count() != 1 {
                faults.push((".relation", "exactly one of ahead_m, behind_m and behind_s expected".into()));
            }
        }
        faults
    }
}

/// JSON Schema (2020-12) of a pattern.
pub fn schema() -> Schema {
    schemars::generate::SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<RoadPattern>()
}
