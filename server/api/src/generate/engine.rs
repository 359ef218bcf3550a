//! Converts a request and its scene to the generator's request.

use super::concerned;
use super::request::{AgentChoice, GenerateRequest, ReactChoice, StreamModes};
use crate::code::Code;
use crate::english;
use crate::feedback::FeedbackDoc;
use crate::limits::CallLimits;
use crate::problem::{Problem, refuse, unknown_agent};
use experts::React;
use experts::request::ShownLast;
use formats::{FieldProblem, ReadError, pointer_token};
use scene::{STEP_S, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

impl GenerateRequest {
    /// The generator's request.
    pub(super) fn engine_request(
        &self,
        scene: &Arc<Scene>,
        limits: &CallLimits,
    ) -> Result<experts::Request, Problem> {
        let pinned = self.pinned(scene)?;
        let agents = match self.chosen_agents() {
            AgentChoice::All(_) => None,
            AgentChoice::Ids(ids) => {
                let mut ids = self.known(scene, "/agents", &ids)?;
                ids.extend(pinned.keys().cloned());
                Some(ids)
            }
        };
        let react = match &self.react {
            ReactChoice::Whether(false) => React::Nobody,
            ReactChoice::Whether(true) => React::Everyone,
            ReactChoice::Ids(ids) => React::Only(self.known(scene, "/react", ids)?),
        };
        if agents.as_ref().is_some_and(BTreeSet::is_empty) && react == React::Nobody {
            return Err(Problem::of(Code::InvalidField, english::no_agents_named()).at("/agents"));
        }
        let named = agents.as_ref().map_or(0, BTreeSet::len);
        let most = limits.regenerated_agents;
        if named as u64 > most {
            let message = english::too_many_regenerated(named, most as usize);
            let problem = Problem::of(Code::TooManyAgents, message);
            return Err(problem.at("/agents").limit(most));
        }
        let horizon_steps = self.horizon_steps();
        let shown = self.shown(scene)?;
        let feedback = self.feedback.as_ref().map(FeedbackDoc::resolve).transpose();
        let feedback = feedback.map_err(|faults| Problem::from(ReadError::invalid(faults)))?;
        let replan_steps = self.replan_interval_s.map(|s| (s / STEP_S).round() as usize);
        let request = experts::Request {
            agents,
            react,
            shown,
            start_step: self.start_step(),
            horizon_steps,
            replan_steps,
            pinned,
            seed: self.seed,
            samples: self.samples as usize,
            modes: self.modes as usize,
            diversity: self.diversity,
            steps: self.steps as usize,
            stream_all: self.stream_modes == StreamModes::All,
            thresholds: self.thresholds,
            ..experts::Request::new(Arc::clone(scene))
        };
        let request = match feedback {
            Some(feedback) => request.round(feedback),
            None => request,
        };
        let answered = if self.feedback.is_some() { self.modes } else { self.samples };
        let count = (concerned(&request) as u64).min(most);
        let points = answered * self.modes * count * horizon_steps as u64;
        let most = limits.reply_points;
        if points > most {
            let message = english::too_many_points(points as usize, most as usize);
            let problem = Problem::of(Code::ReplyTooLarge, message);
            return Err(problem.at("/samples").limit(most));
        }
        Ok(request)
    }

    /// The pinned futures, from the start on.
    fn pinned(&self, scene: &Scene) -> Result<BTreeMap<String, Vec<scene::State>>, Problem> {
        self.known(scene, "/pinned", &self.pinned)?;
        let mut out = BTreeMap::new();
        let mut faults = Vec::new();
        for (i, id) in self.pinned.iter().enumerate() {
            let future = scene.generated.as_ref().and_then(|g| g.chosen_future(id));
            let passed = future.and_then(|f| (self.start_step() + 1).checked_sub(f.first_step));
            let states = future.zip(passed).and_then(|(f, passed)| f.states.get(passed..));
            match states.filter(|s| !s.is_empty()) {
                Some(states) => {
                    out.insert(id.clone(), states.to_vec());
                }
                None => faults.push(FieldProblem::new(
                    format!("/pinned/{i}"),
                    "invalid-field",
                    english::no_future_kept(),
                )),
            }
        }
        refuse(faults)?;
        Ok(out)
    }

    fn shown(&self, scene: &Scene) -> Result<BTreeMap<String, ShownLast>, Problem> {
        let (mut shown, mut faults) = (BTreeMap::new(), Vec::new());
        for (id, doc) in &self.shown.0 {
            let pointer = format!("/shown/{}", pointer_token(id));
            if scene.agent(id).is_none() {
                faults.push(unknown_agent(pointer, id));
                continue;
            }
            match doc.places(&pointer) {
                Ok(places) => drop(shown.insert(id.clone(), ShownLast { anchor: doc.anchor, places })),
                Err(fault) => faults.push(fault),
            }
        }
        refuse(faults)?;
        Ok(shown)
    }

    fn known(&self, scene: &Scene, pointer: &str, ids: &[String]) -> Result<BTreeSet<String>, Problem> {
        let missing = ids.iter().enumerate().filter(|(_, id)| scene.agent(id).is_none());
        refuse(missing.map(|(i, id)| unknown_agent(format!("{pointer}/{i}"), id)).collect())?;
        Ok(ids.iter().cloned().collect())
    }
}
