//! What a generation tells, as JSON objects: the same in all three representations.

use crate::base::problem::Problem;
use experts::{Accepted, Answer, Draft, Field, Resolved, Warning};
use formats::native::{AgentFuturesDoc, FutureDoc, SampleDoc};
use scene::AgentFutures;
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// What every event carries.
#[derive(Clone, Debug, Serialize)]
pub struct Envelope<'a, T> {
    /// `accepted`, `initial`, `step`, `final`, `error` or `superseded`.
    pub event: &'static str,
    /// Rises by one an event; a gap shows events that were dropped for a slow reader.
    pub seq: u64,
    /// Id of the job.
    pub job: &'a str,
    /// Revision of the request, when it had one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub revision: Option<u64>,
    /// Since the request was read, milliseconds.
    pub elapsed_ms: f64,
    /// What this event alone carries.
    #[serde(flatten)]
    pub body: T,
}

/// `accepted`: what will be done.
#[derive(Debug, Serialize)]
pub struct AcceptedBody<'a> {
    #[serde(flatten)]
    accepted: &'a Accepted,
    queue_position: usize,
}

impl<'a> AcceptedBody<'a> {
    /// With the place in the queue that the call was given.
    pub fn new(accepted: &'a Accepted, queue_position: usize) -> Self {
        Self { accepted, queue_position }
    }
}

/// `initial` and `step`: futures that are not settled yet.
#[derive(Debug, Serialize)]
pub struct DraftBody {
    window: usize,
    sample: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<usize>,
    steps: usize,
    agents: BTreeMap<String, AgentFuturesDoc>,
}

impl DraftBody {
    /// Of a draft; with `all_modes`, all alternatives and not the chosen ones alone.
    pub fn new(draft: &Draft, all_modes: bool) -> Self {
        let agents = draft.futures.agents.iter();
        let agents = agents.map(|(id, futures)| (id.clone(), futures_doc(futures, all_modes))).collect();
        let step = (draft.step > 0).then_some(draft.step);
        Self { window: draft.window, sample: draft.sample, step, steps: draft.steps, agents }
    }

    /// Name of the event.
    pub fn event(&self) -> &'static str {
        if self.step.is_some() { "step" } else { "initial" }
    }
}

fn futures_doc(futures: &AgentFutures, all_modes: bool) -> AgentFuturesDoc {
    if all_modes {
        return AgentFuturesDoc::from_futures(futures);
    }
    let chosen = futures.modes.get(futures.chosen).map(FutureDoc::from_future);
    AgentFuturesDoc { chosen: 0, modes: chosen.into_iter().collect() }
}

/// Time spent, milliseconds.
#[derive(Clone, Debug, Default, Serialize)]
pub struct TimingBody {
    /// Waiting for a worker.
    pub queue_ms: f64,
    /// Map and road users.
    pub encode_ms: f64,
    /// First guess.
    pub initial_ms: f64,
    /// Each denoising step.
    pub step_ms: Vec<f64>,
    /// Joint choice of modes.
    pub choice_ms: f64,
    /// Scores.
    pub score_ms: f64,
}

/// `final`: the answer.
#[derive(Debug, Serialize)]
pub struct FinalBody {
    /// Planning windows that were run, one after the other.
    pub windows: usize,
    /// Joint scenes.
    pub samples: Vec<SampleDoc>,
    /// Every condition field as it was used.
    pub resolved: BTreeMap<String, Value>,
    /// One report a sample, or null when none was asked for.
    pub scores: Option<Vec<Value>>,
    /// Unlikely things that were done anyway.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub timing: TimingBody,
    /// Members of a scene's `generated` part, all but `samples`.
    pub generated: Value,
}

/// The members of `generated` that do not come from the generator.
#[derive(Clone, Debug)]
pub struct GeneratedHead {
    /// Hash of the user's part.
    pub input_sha256: String,
    /// Expert to weights.
    pub weights: BTreeMap<String, String>,
    /// Seed.
    pub seed: u64,
    /// The request's options as sent, without scene and conditions.
    pub request: Value,
}

impl GeneratedHead {
    /// The object that a client completes with `samples` and stores in the scene.
    pub fn to_json(&self) -> Value {
        json!({
            "input_sha256": self.input_sha256, "stale": false, "weights": self.weights, "seed": self.seed,
            "request": self.request, "created_at": crate::base::clock::now(), "chosen_sample": 0,
        })
    }
}

/// Resolved fields as nested objects: `start.x_m` becomes `{"start":{"x_m":{"value":..,"from":..}}}`.
pub fn resolved(answer: &Answer) -> BTreeMap<String, Value> {
    answer.resolved.iter().map(|(id, resolved)| (id.clone(), resolved_doc(resolved))).collect()
}

fn resolved_doc(resolved: &Resolved) -> Value {
    let mut object = Map::new();
    object.insert("type".into(), json!(resolved.agent_type));
    for (name, field) in &resolved.fields {
        let Field { value, from } = field;
        let entry = json!({"value": value, "from": from});
        match name.split_once('.') {
            None => {
                object.insert(name.clone(), entry);
            }
            Some((group, name)) => {
                let slot = object.entry(group).or_insert_with(|| Value::Object(Map::new()));
                if let Value::Object(members) = slot {
                    members.insert(name.to_owned(), entry);
                }
            }
        }
    }
    object.insert("reach".into(), json!(resolved.reach));
    if !resolved.intermediate.is_empty() {
        object.insert("intermediate".into(), json!(resolved.intermediate));
    }
    Value::Object(object)
}

/// `error`: the problem object.
#[derive(Debug, Serialize)]
pub struct ErrorBody {
    problem: Value,
}

impl ErrorBody {
    /// Of a problem.
    pub fn new(problem: &Problem) -> Self {
        Self { problem: problem.body(Some("/v1/generate"), None) }
    }
}

/// `superseded`: a newer revision took over.
#[derive(Debug, Serialize)]
pub struct SupersededBody {
    /// The newer one.
    pub by_revision: u64,
}
