//! The events of a generation as JSON objects, the same for every transport.

use crate::compact::{FuturesDoc, FuturesForm};
use experts::{Draft, Resolved, Warning};
use scene::preference::{Learned, RoundCard};
use scene::score::Score;
use scene::{Generated, Sample};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// A draft. `initial`: before refinement. `step`: after a refinement step. The futures of a later window
/// start with that window.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Draft")]
pub struct DraftBody {
    /// Planning window, from 0.
    window: usize,
    /// Joint scene, from 0.
    sample: usize,
    /// Refinement step, from 1; not in `initial`.
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<usize>,
    /// Refinement steps per window.
    steps: usize,
    /// Futures by road user: only the chosen ones or all, according to `stream_modes`.
    agents: BTreeMap<String, FuturesDoc>,
}

impl DraftBody {
    /// Whether this is the first draft.
    pub fn is_first(&self) -> bool {
        self.step.is_none()
    }

    /// The body of a draft; with `all_modes` it has all alternatives, not only the chosen ones.
    pub fn new(draft: &Draft, futures: &Sample, all_modes: bool, form: FuturesForm) -> Self {
        let agents = futures.agents.iter();
        let agents =
            agents.map(|(id, futures)| (id.clone(), FuturesDoc::new(futures, all_modes, form))).collect();
        let step = (draft.step > 0).then_some(draft.step);
        Self { window: draft.window, sample: draft.sample, step, steps: draft.steps, agents }
    }
}

/// Durations of the stages, milliseconds.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
#[schemars(rename = "Timing")]
pub struct TimingBody {
    /// Wait for a worker.
    pub queue_ms: f64,
    /// Encoding of the map and the road users.
    pub encode_ms: f64,
    /// Initial draft.
    pub initial_ms: f64,
    /// Each refinement step.
    pub step_ms: Vec<f64>,
    /// Joint choice of modes.
    pub choice_ms: f64,
    /// Scores.
    pub score_ms: f64,
}

/// One joint scene of the answer. Its score is in `scores`.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "AnswerSample")]
pub struct SampleBody {
    /// Futures by id of the road user.
    pub agents: BTreeMap<String, FuturesDoc>,
    /// Empty in the reply; holds the score in a saved scene.
    pub score: Value,
}

impl SampleBody {
    /// The body of a sample.
    pub fn new(sample: &Sample, form: FuturesForm) -> Self {
        let agents = sample.agents.iter().map(|(id, f)| (id.clone(), FuturesDoc::new(f, true, form)));
        Self { agents: agents.collect(), score: sample.score.clone() }
    }
}

/// Whether the probabilities of futures are calibrated. Calibrated means a log loss 0.15 below that of six
/// equal probabilities, with and without goals, and a reliability within 0.05.
pub const CALIBRATED: bool = false;

/// `final`: the answer.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(rename = "Final")]
pub struct FinalBody {
    /// Number of planning windows. A chosen future covers all of them; its alternatives are those of the
    /// first window and end with the plan of that window.
    pub windows: usize,
    /// Joint scenes. They include road users outside the call with the future that the scene keeps, unless
    /// `kept_futures` excludes them.
    pub samples: Vec<SampleBody>,
    /// Whether the probabilities of the futures are calibrated. If not, they are relative weights, of which only
    /// the order counts. docs/results.md has their log loss.
    pub calibrated: bool,
    /// All condition fields as they were used.
    pub resolved: BTreeMap<String, Resolved>,
    /// One report per sample, or null without `score`.
    pub scores: Option<Vec<Score>>,
    /// Warnings: unlikely requests that were carried out.
    pub warnings: Vec<Warning>,
    /// Of a round: the features of its cards, and the learned wishes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub feedback: Option<RoundBody>,
    /// Durations of the stages.
    pub timing: TimingBody,
    /// Result code, six characters. It identifies the inputs of the answer: the scene with its conditions and the
    /// futures it keeps, options, seed, weights and version. Identical calls have identical codes.
    pub code: String,
    /// The scene's `generated` member without `samples`. To save the answer, insert `samples` (those in
    /// compact form as columns).
    pub generated: GeneratedHead,
}

/// A round of cards.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Round")]
pub struct RoundBody {
    /// One per future of the requested road user, or one per sample, the most preferred first.
    pub cards: Vec<RoundCard>,
    /// Wishes on which the answers agree, with the most certain first.
    pub wishes: Vec<Learned>,
}

/// The members of `generated` that do not come from the generator.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct GeneratedHead {
    /// Hash of the user's part of the scene, from which the futures were generated.
    pub input_sha256: String,
    /// Whether the user's part has changed since.
    pub stale: bool,
    /// Hash of the weights by expert.
    pub weights: BTreeMap<String, String>,
    /// Seed that repeats the answer.
    pub seed: u64,
    /// The request's options as sent, without scene and conditions.
    pub request: Value,
    /// Licence of the answer if it is stricter than that of the scene: the licence of the weights.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub licence: Option<String>,
    /// RFC 3339 time.
    pub created_at: String,
    /// Index into `samples`.
    pub chosen_sample: usize,
}

impl GeneratedHead {
    /// The head of an answer that does not exist yet.
    pub fn new(input_sha256: String, weights: BTreeMap<String, String>, seed: u64, request: Value) -> Self {
        let created_at = String::new();
        let (stale, licence, chosen_sample) = (false, None, 0);
        Self { input_sha256, stale, weights, seed, request, licence, created_at, chosen_sample }
    }

    /// The scene's `generated` member with these samples, of which the first is chosen.
    pub fn generated(self, created_at: String, samples: Vec<Sample>) -> Generated {
        let Self { input_sha256, stale, weights, seed, request, licence, .. } = self;
        let chosen_sample = 0;
        Generated { input_sha256, stale, weights, seed, request, licence, created_at, chosen_sample, samples }
    }
}
