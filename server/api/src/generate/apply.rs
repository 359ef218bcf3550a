//! The scene of a request, with the road users and conditions of this call.

use super::request::{GenerateRequest, KeptFutures, MOST_ANGLE_RAD, more_than_a_turn};
use crate::problem::{Problem, refuse, unknown_agent};
use formats::native::{ConditionsDoc, Context, Window};
use formats::{FieldProblem, ReadError, pointer_token};
use scene::sentences::{expected, wanted};
use scene::{STEP_S, Scene, relation};

impl GenerateRequest {
    /// The scene with this call's road users and conditions. The length of the call bounds the times of
    /// goals.
    ///
    /// # Errors
    /// Every fault of the start, the ids and the conditions, and of a scene with the added road users.
    pub fn apply(&self, mut scene: Scene) -> Result<Scene, Problem> {
        let last_s = (scene.time.steps - 1) as f64 * STEP_S;
        if !(self.start_s >= 0.0 && self.start_s <= last_s + 1e-6) {
            return refuse(vec![FieldProblem::range("/start_s", 0.0, last_s, self.start_s)]).map(|()| scene);
        }
        let mut faults = Vec::new();
        for (i, id) in self.remove_agents.iter().enumerate() {
            let before = scene.agents.len();
            scene.agents.retain(|agent| agent.id != *id);
            if scene.agents.len() == before {
                faults.push(unknown_agent(format!("/remove_agents/{i}"), id));
            }
        }
        for (i, doc) in self.add_agents.iter().enumerate() {
            match doc.clone().into_agent(&format!("/add_agents/{i}")) {
                Ok(agent) => scene.agents.push(agent),
                Err(more) => faults.extend(more),
            }
        }
        if self.kept_futures == KeptFutures::Forgotten {
            scene.generated = None;
        }
        let start_step = self.start_step();
        let window = Window { start_s: start_step as f64 * STEP_S, horizon_s: self.horizon_s };
        for (id, doc) in &self.conditions.0 {
            let pointer = format!("/conditions/{}", pointer_token(id));
            let Some(agent) = scene.agents.iter_mut().find(|agent| agent.id == *id) else {
                faults.push(unknown_agent(pointer, id));
                continue;
            };
            faults.extend(angles(&pointer, doc));
            let context = Context { agent_type: agent.agent_type, start: agent.state_at(start_step), window };
            match doc.resolve(&pointer, &context) {
                Ok(conditions) => {
                    for k in conditions.unknown_edges(&scene.map) {
                        let at = format!("{pointer}/goal/may_cross/{k}");
                        faults.push(FieldProblem::new(at, "invalid-field", expected(wanted::ROAD_EDGE)));
                    }
                    agent.conditions = conditions;
                }
                Err(more) => faults.extend(more),
            }
        }
        for (i, message) in relation::faults(&scene.agents) {
            let pointer = format!("/conditions/{}/goal/relation/to", pointer_token(&scene.agents[i].id));
            faults.push(FieldProblem::new(pointer, "invalid-field", message));
        }
        refuse(faults)?;
        if self.add_agents.is_empty() {
            return Ok(scene);
        }
        let check = scene.checked();
        check
            .map_err(|faults| ReadError::invalid(faults.into_iter().map(FieldProblem::from).collect()).into())
    }
}

/// Angles of more than a turn. A scene's own conditions may contain them, because earlier versions accepted
/// them.
fn angles(pointer: &str, doc: &ConditionsDoc) -> Vec<FieldProblem> {
    let start = doc.start.as_ref().map(|start| ("start/heading_rad", start.heading_rad));
    let goal = doc.goal.iter();
    let goal =
        goal.flat_map(|goal| [("goal/heading_rad", goal.heading_rad), ("goal/turn_rad", goal.turn_rad)]);
    let given = start.into_iter().chain(goal).filter_map(|(name, angle)| Some((name, angle?)));
    let beyond = given.filter(|(_, angle)| angle.is_finite() && angle.abs() > MOST_ANGLE_RAD);
    let fault = |(name, angle)| {
        let (pointer, message) = (format!("{pointer}/{name}"), more_than_a_turn(angle));
        FieldProblem::range_of(pointer, -MOST_ANGLE_RAD, MOST_ANGLE_RAD, angle, message)
    };
    beyond.map(fault).collect()
}
