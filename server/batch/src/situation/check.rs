//! What is wrong with a situation.

use super::document::BatchSituation;
use super::ranges::{GoalRanges, GoalRelationRanges, OtherKinds, StartRanges, range};
use crate::fault::PlanFault;
use crate::names::{hint, is_name};
use crate::who::AgentSelector;
use scene::AgentType;
use scene::scenarios::Template;

/// Longest name, in characters.
const MOST_NAME: usize = 60;

impl BatchSituation {
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

/// The message about an unknown name.
fn unknown(name: &str, known: &[&str]) -> String {
    format!("\"{name}\" is unknown{}; there are {}", hint(name, known.iter().copied()), known.join(", "))
}

#[cfg(test)]
mod tests {
    use super::BatchSituation;
    use formats::native::ConditionsDoc;
    use std::collections::BTreeMap;

    /// The faults of a situation.
    fn faults(text: &str) -> Vec<String> {
        let mut faults = Vec::new();
        serde_json::from_str::<BatchSituation>(text).unwrap().check("s", &mut faults);
        faults.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn types_and_kinds_of_others_are_those_of_road_users() {
        let text = r#"{"agents":["6"],"type":"cyclist","others":{"agents":["@vehicles"],"length_m":12}}"#;
        assert_eq!(faults(text), Vec::<String>::new());
        let wrong = faults(r#"{"agents":["6"],"type":"other","others":{"agents":["@vehicles"]}}"#);
        assert_eq!(wrong.len(), 2, "{wrong:?}");
    }

    #[test]
    fn the_other_of_a_pair_belongs_to_conditions() {
        assert_eq!(faults(r#"{"agents":["6"],"with":"4"}"#), [""; 0]);
        assert_eq!(faults(r#"{"template":"brake","with":"4"}"#).len(), 1);
        assert_eq!(faults(r#"{"with":"4"}"#).len(), 1);
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
}
