//! The request of a search in one scene, and the report on its tries.

use crate::engine::UnitEnd;
use crate::plan::{BatchOptions, BatchSeeds};
use crate::row::UnitOutcome;
use crate::sampling::SamplingMethod;
use crate::situation::BatchSituation;
use api::home::{AboutScene, SceneRef, one_scene};
use formats::native::{ConditionsDoc, SceneDoc};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Most tries of a search.
pub const MOST_TRIES: u64 = 1_000;

/// Body of a search. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = one_scene)]
pub struct SearchBody {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the call is refused if the scene has changed.
    pub etag: Option<String>,
    /// The varied situation: a template with ranges of its figures, or conditions with ranges. A condition for
    /// several road users is searched for each of them.
    pub situation: BatchSituation,
    /// Condition on the figures of the score, such as `actor.min_ttc_s < 1.5 && collisions == 0`.
    #[serde(rename = "where")]
    #[schemars(required)]
    pub condition: String,
    /// Number of tries per road user and seed; at most 1000 in total.
    #[schemars(range(min = 1, max = 1000))]
    pub tries: u64,
    /// Number of tries that satisfy the condition at which the search ends. Default: all tries are made.
    #[schemars(range(min = 1, max = 1000))]
    pub found: Option<u64>,
    /// How the numbers of the next tries are chosen.
    pub method: SamplingMethod,
    /// Seed of these choices.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
    /// Seeds of the generations: a count from 0 on, or a list.
    pub seeds: BatchSeeds,
    /// Options of every generation.
    pub generate: BatchOptions,
    /// The client's id of the job, which can cancel it.
    pub job: Option<String>,
}

impl Default for SearchBody {
    fn default() -> Self {
        Self {
            scene: None,
            scene_id: None,
            etag: None,
            situation: BatchSituation::default(),
            condition: String::new(),
            tries: 100,
            found: None,
            method: SamplingMethod::Search,
            seed: 0,
            seeds: BatchSeeds::default(),
            generate: BatchOptions::default(),
            job: None,
        }
    }
}

impl AboutScene for SearchBody {
    fn take_scene(&mut self) -> SceneRef {
        SceneRef {
            scene: self.scene.take(),
            scene_id: self.scene_id.take(),
            etag: self.etag.take(),
            hold: false,
        }
    }
}

/// One try.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct SearchTry {
    /// Number of the try, from 0.
    pub number: u64,
    /// Its outcome.
    pub outcome: UnitOutcome,
    /// Drawn numbers by path, such as `goal.speed_mps`.
    pub drawn: BTreeMap<String, f64>,
    /// Distance from the condition, 0 if it holds; absent without a result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub miss: Option<f64>,
    /// Result code, six characters.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<String>,
    /// Whether the goal of the actor is met: met, missed, none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goal: Option<String>,
    /// Behaviour of the actor of a template, in one sentence.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub what: Option<String>,
    /// The road user that the situation affects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other: Option<String>,
    /// Code of the problem, if there is no result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub problem: Option<String>,
    /// Figures of the score by name.
    pub figures: BTreeMap<String, f64>,
    /// The body of a `POST /v1/generate` that gives the same result, without its scene; absent without a result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub request: Option<TryRequest>,
}

/// A generation that reproduces the result of a try.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(transform = formats::never_null)]
pub struct TryRequest {
    /// Road users to generate; absent for all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agents: Option<Vec<String>>,
    /// Conditions by road user.
    pub conditions: BTreeMap<String, ConditionsDoc>,
    /// Seed of the random draws.
    pub seed: u64,
    /// Options.
    #[serde(flatten)]
    pub options: BatchOptions,
}

impl SearchTry {
    /// The report on a completed unit.
    pub fn new(number: u64, end: UnitEnd, options: &BatchOptions) -> Self {
        let UnitEnd { row, conditions, .. } = end;
        let react = options.react && row.actor.is_some();
        let request = row.code.is_some().then(|| TryRequest {
            agents: row.actor.map(|actor| vec![actor]),
            conditions,
            seed: row.seed,
            options: BatchOptions { react, ..options.clone() },
        });
        Self {
            number,
            outcome: row.outcome,
            drawn: row.drawn,
            miss: row.miss,
            code: row.code,
            goal: row.goal,
            what: row.what,
            other: row.other,
            problem: row.problem.map(|problem| problem.code),
            figures: row.figures,
            request,
        }
    }
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SearchEnd {
    /// The requested number of tries satisfies the condition.
    Found,
    /// All tries are made.
    Tries,
    /// The time limit of a call is reached; the reply has the tries so far.
    Time,
}
