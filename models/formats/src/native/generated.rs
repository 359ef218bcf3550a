//! The generator's part of a scene document.

use super::any::AnyDoc;
use super::value::{Members, check_integer, round_m, round_rad};
use crate::limits::MAX_WORD;
use crate::lists::bounded;
use crate::problem::Problems;
use crate::refusals::{index_beyond, unequal_columns};
use scene::judge::{About, Fault, Manoeuvre, Reaction, Relation};
use scene::{AgentFutures, Future, Generated, MAX_COORDINATE_M, Sample, State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Greatest speed of a future along x and along y, as for a track.
const MAX_SPEED_MPS: f64 = 150.0;

/// One possible motion as columns, one value per step from `first_step`, without gaps. Rounded to 0.001 m,
/// 0.0001 rad and 0.001 m/s.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FutureDoc {
    /// Probability among the road user's futures.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub probability: f64,
    /// Index of the generator's anchor that it follows. While a goal is dragged, an equal index means the
    /// same plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor: Option<u32>,
    /// Scene step of the first value: one after the start.
    pub first_step: u64,
    /// Box centre, metres.
    pub x_m: Vec<f64>,
    /// Box centre, metres.
    pub y_m: Vec<f64>,
    /// Radians.
    pub heading_rad: Vec<f64>,
    /// m/s.
    pub vx_mps: Vec<f64>,
    /// m/s.
    pub vy_mps: Vec<f64>,
    /// Faults, the worst first.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, 64>")]
    pub faults: Vec<Fault>,
    /// Relations to other road users.
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, 64>")]
    pub relations: Vec<Relation>,
    /// Manoeuvre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manoeuvre: Option<Manoeuvre>,
}

/// The futures of one road user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgentFuturesDoc {
    /// Index into `modes` of the future that is shown and exported.
    pub chosen: u64,
    /// In order of decreasing probability.
    #[serde(deserialize_with = "bounded::<_, _, 64>")]
    pub modes: Vec<FutureDoc>,
    /// Why it left its previous motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reaction: Option<Reaction>,
}

/// Most values of the score of a sample.
pub const MAX_SCORE_VALUES: usize = 20_000;

/// One coherent answer for all regenerated road users.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SampleDoc {
    /// Futures by id of the road user.
    pub agents: Members<AgentFuturesDoc>,
    /// Score as the API gave it.
    #[serde(default)]
    pub score: AnyDoc<MAX_SCORE_VALUES>,
}

/// Futures that the generator added to a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GeneratedDoc {
    /// Hash of the user's part of the scene, from which the futures were generated.
    pub input_sha256: String,
    /// Whether the user's part has changed since.
    #[serde(default)]
    pub stale: bool,
    /// Hash of the weights by expert.
    #[serde(default)]
    pub weights: Members<String>,
    /// Seed that repeats the answer, 0 to 2^53 - 1.
    #[serde(default)]
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
    /// The request's options as sent.
    #[serde(default)]
    pub request: AnyDoc,
    /// Licence of the answer if it is stricter than that of the scene: the licence of the weights.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub licence: Option<String>,
    /// RFC 3339 time; absent where equal calls must give equal files.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub created_at: String,
    /// Index into `samples`.
    #[serde(default)]
    pub chosen_sample: u64,
    /// Independent answers.
    #[serde(deserialize_with = "bounded::<_, _, 256>")]
    pub samples: Vec<SampleDoc>,
}

impl FutureDoc {
    /// The document of a future, rounded.
    pub fn from_future(future: &Future) -> Self {
        let column = |f: fn(&State) -> f64| future.states.iter().map(f).collect();
        Self {
            probability: future.probability,
            anchor: future.anchor,
            first_step: future.first_step as u64,
            x_m: column(|s| round_m(s.x_m)),
            y_m: column(|s| round_m(s.y_m)),
            heading_rad: column(|s| round_rad(s.heading_rad)),
            vx_mps: column(|s| round_m(s.vx_mps)),
            vy_mps: column(|s| round_m(s.vy_mps)),
            faults: future.about.faults.clone(),
            relations: future.about.relations.clone(),
            manoeuvre: future.about.manoeuvre,
        }
    }

    fn into_future(self, pointer: &str, problems: &mut Problems) -> Future {
        let steps = self.x_m.len();
        let columns = [
            ("y_m", self.y_m.len()),
            ("heading_rad", self.heading_rad.len()),
            ("vx_mps", self.vx_mps.len()),
            ("vy_mps", self.vy_mps.len()),
        ];
        for (name, length) in columns.into_iter().filter(|c| c.1 != steps) {
            problems.invalid(format!("{pointer}/{name}"), unequal_columns(length, steps, "x_m"));
        }
        problems.range(&format!("{pointer}/probability"), (0.0, 1.0), self.probability);
        // A future may go beyond the limit for tracks.
        let far_m = 2.0 * MAX_COORDINATE_M;
        for (name, column, most) in [
            ("x_m", &self.x_m, far_m),
            ("y_m", &self.y_m, far_m),
            ("vx_mps", &self.vx_mps, MAX_SPEED_MPS),
            ("vy_mps", &self.vy_mps, MAX_SPEED_MPS),
        ] {
            if let Some((i, value)) = column.iter().enumerate().find(|(_, value)| value.abs() > most) {
                problems.range(&format!("{pointer}/{name}/{i}"), (-most, most), *value);
            }
        }
        let last_step = 100_000;
        problems.range(&format!("{pointer}/first_step"), (0.0, f64::from(last_step)), self.first_step as f64);
        let values =
            self.x_m.iter().zip(&self.y_m).zip(&self.heading_rad).zip(&self.vx_mps).zip(&self.vy_mps);
        let states = values
            .map(|((((x_m, y_m), heading_rad), vx_mps), vy_mps)| State {
                x_m: *x_m,
                y_m: *y_m,
                heading_rad: *heading_rad,
                vx_mps: *vx_mps,
                vy_mps: *vy_mps,
            })
            .collect();
        Future {
            probability: self.probability,
            anchor: self.anchor,
            first_step: self.first_step as usize,
            states,
            about: About { faults: self.faults, relations: self.relations, manoeuvre: self.manoeuvre },
        }
    }
}

impl AgentFuturesDoc {
    /// The document of one road user's futures.
    pub fn from_futures(futures: &AgentFutures) -> Self {
        Self {
            chosen: futures.chosen as u64,
            modes: futures.modes.iter().map(FutureDoc::from_future).collect(),
            reaction: futures.reaction.clone(),
        }
    }
}

impl SampleDoc {
    /// The document of one sample.
    pub fn from_sample(sample: &Sample) -> Self {
        let agents =
            sample.agents.iter().map(|(id, f)| (id.clone(), AgentFuturesDoc::from_futures(f))).collect();
        Self { agents: Members(agents), score: AnyDoc(sample.score.clone()) }
    }
}

impl GeneratedDoc {
    /// The document of what the generator added.
    pub fn from_generated(generated: &Generated) -> Self {
        Self {
            input_sha256: generated.input_sha256.clone(),
            stale: generated.stale,
            weights: Members(generated.weights.clone()),
            seed: generated.seed,
            request: AnyDoc(generated.request.clone()),
            licence: generated.licence.clone(),
            created_at: generated.created_at.clone(),
            chosen_sample: generated.chosen_sample as u64,
            samples: generated.samples.iter().map(SampleDoc::from_sample).collect(),
        }
    }

    pub(crate) fn into_generated(self, pointer: &str, problems: &mut Problems) -> Generated {
        if let Err(problem) = check_integer(&format!("{pointer}/seed"), self.seed) {
            problems.push(problem);
        }
        let texts = [("input_sha256", Some(&self.input_sha256)), ("created_at", Some(&self.created_at))];
        let texts = texts.into_iter().chain([("licence", self.licence.as_ref())]);
        for (name, text) in texts.chain(self.weights.0.values().map(|hash| ("weights", Some(hash)))) {
            problems.length(&format!("{pointer}/{name}"), MAX_WORD, text);
        }
        if self.chosen_sample >= self.samples.len() as u64 {
            let message = index_beyond(self.chosen_sample, self.samples.len());
            problems.invalid(format!("{pointer}/chosen_sample"), message);
        }
        let mut samples = Vec::new();
        for (s, sample) in self.samples.into_iter().enumerate() {
            let mut agents = BTreeMap::new();
            for (id, futures) in sample.agents.0 {
                let at = format!("{pointer}/samples/{s}/agents/{}", crate::problem::pointer_token(&id));
                if futures.chosen >= futures.modes.len() as u64 {
                    let message = index_beyond(futures.chosen, futures.modes.len());
                    problems.invalid(format!("{at}/chosen"), message);
                }
                let mut modes = Vec::new();
                for (m, mode) in futures.modes.into_iter().enumerate() {
                    modes.push(mode.into_future(&format!("{at}/modes/{m}"), problems));
                }
                agents.insert(
                    id,
                    AgentFutures { chosen: futures.chosen as usize, modes, reaction: futures.reaction },
                );
            }
            samples.push(Sample { agents, score: sample.score.0 });
        }
        Generated {
            input_sha256: self.input_sha256,
            stale: self.stale,
            weights: self.weights.0,
            seed: self.seed,
            request: self.request.0,
            licence: self.licence,
            created_at: self.created_at,
            chosen_sample: self.chosen_sample as usize,
            samples,
        }
    }
}
