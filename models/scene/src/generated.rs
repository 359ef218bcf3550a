//! Generated futures, as they are stored with a scene.

use crate::judge::{About, Reaction};
use crate::{AgentId, State};
use serde::Serialize;
use std::collections::BTreeMap;

/// One possible motion of one road user.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Future {
    /// Probability among the road user's futures; they sum to one.
    pub probability: f64,
    /// Number of the generator's anchor that it follows. It identifies the same manoeuvre from one answer to
    /// the next.
    pub anchor: Option<u32>,
    /// Scene step of `states[0]`: one after the start.
    pub first_step: usize,
    /// One state per step, without gaps.
    pub states: Vec<State>,
    /// Verdicts on the future; the default if it was not judged.
    #[serde(flatten)]
    pub about: About,
}

impl Future {
    /// A future without verdicts.
    pub fn bare(probability: f64, first_step: usize, states: Vec<State>) -> Self {
        Self { probability, anchor: None, first_step, states, about: About::default() }
    }
}

/// The futures of one road user in one sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AgentFutures {
    /// Index into `modes` of the future that is shown and exported.
    pub chosen: usize,
    /// In order of decreasing probability, never empty.
    pub modes: Vec<Future>,
    /// The reaction that replaced its motion; `None` for an agent that the call regenerated.
    pub reaction: Option<Reaction>,
}

impl AgentFutures {
    /// Futures of an agent that the call regenerated.
    pub fn of(chosen: usize, modes: Vec<Future>) -> Self {
        Self { chosen, modes, reaction: None }
    }
}

/// One coherent answer for all regenerated road users.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Sample {
    /// Futures by road user.
    pub agents: BTreeMap<AgentId, AgentFutures>,
    /// Score of this sample as the API returned it; stored but never interpreted.
    pub score: serde_json::Value,
}

/// Generated futures of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Generated {
    /// Hash of the scene's user part for which these futures were made.
    pub input_sha256: String,
    /// The user part has changed since.
    pub stale: bool,
    /// Hash of the weights, by name of the expert.
    pub weights: BTreeMap<String, String>,
    /// Seed with which the answer can be repeated.
    pub seed: u64,
    /// The request's options as they were sent.
    pub request: serde_json::Value,
    /// Licence of the answer if it is stricter than that of the scene: the licence of the weights.
    pub licence: Option<String>,
    /// RFC 3339 time; empty if no clock was read.
    pub created_at: String,
    /// Index into `samples`.
    pub chosen_sample: usize,
    /// Never empty.
    pub samples: Vec<Sample>,
}

impl Generated {
    /// The future that is shown for `agent`, if it was regenerated.
    pub fn chosen_future(&self, agent: &str) -> Option<&Future> {
        let futures = self.samples.get(self.chosen_sample)?.agents.get(agent)?;
        futures.modes.get(futures.chosen)
    }
}
