//! The generator: three experts behind a gate, and calls that yield events.

mod actor;
mod calibration;
mod candidates;
mod cast;
mod choice;
mod costs;
mod decide;
mod decisions;
mod diversity;
mod draft_relations;
mod draft_traces;
mod drafting;
mod drafts;
mod duplicate_modes;
mod extrapolation;
mod generation;
mod guidance;
mod joint_drafts;
mod kerb;
mod motion;
mod moving_off;
mod noise;
mod others;
mod overlaps;
mod replan;
mod report;
mod repulsion;
mod resources;
mod road_rules;
mod rounds;
#[cfg(test)]
mod samples;
mod sampling;
mod slot;
mod stepping_out;
mod subgoal;
mod trajectory;
mod variations;
mod verdict;
mod via_steering;
mod window_setting;
mod workers;

pub use generation::Generation;
pub use others::WAITS_STEPS;
pub(crate) use others::{extend_along_road, state_between};

use crate::clock::{self, Clock};
use crate::maps::Maps;
use crate::net::Expert;
use crate::request::{Answer, GenerateError, Request};
use crate::tuning::{self, Tuning};
use crate::weights::{EXPERTS, Files, WeightsError, WeightsInfo};
use resources::Resources;
use scene::Cancel;
use scene::map::Lane;
use scene::{Agent, LaneMap, Scene, State, Subtype, Vec2};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;
use workers::WorkerPool;

/// The three experts with the cache of maps. Cheap to share; calls may run at the same time.
pub struct Generator {
    resources: Resources,
    info: BTreeMap<String, WeightsInfo>,
    maps: Arc<Maps>,
    /// Hash of the tuning; it is part of every answer.
    tuning_hash: String,
}

impl Generator {
    /// Builds the generator from the bytes of weights files, in the order of [`EXPERTS`].
    ///
    /// # Errors
    /// When a file is damaged or of another architecture.
    pub fn new(files: &[Cow<'static, [u8]>; EXPERTS.len()], maps: Arc<Maps>) -> Result<Self, WeightsError> {
        let (mut experts, mut info) = (BTreeMap::new(), BTreeMap::new());
        for ((agent_type, name), bytes) in EXPERTS.into_iter().zip(files) {
            let expert = Expert::load(bytes)
                .map_err(|e| WeightsError { path: format!("{name}.safetensors"), reason: e.to_string() })?;
            let card = &expert.card;
            if card.expert != name && !card.untrained {
                let reason =
                    format!("weights of the expert \"{}\", where \"{name}\" is expected", card.expert);
                return Err(WeightsError { path: format!("{name}.safetensors"), reason });
            }
            info.insert(name.to_owned(), WeightsInfo::of(name, bytes, &expert));
            experts.insert(agent_type, expert);
        }
        Ok(Self {
            resources: Resources {
                experts: Arc::new(experts),
                workers: WorkerPool::of_machine(),
                clock: clock::standing,
                tuning: tuning::SHIPPED,
            },
            info,
            maps,
            tuning_hash: tuning::SHIPPED.hash().hex(),
        })
    }

    /// A generator with random weights, for tests of everything but quality.
    ///
    /// # Errors
    /// When memory for them cannot be allocated.
    pub fn random(seed: u64) -> Result<Self, WeightsError> {
        Self::new(&Files::random(seed)?.experts, Arc::default())
    }

    /// Splits whole scenes over this many threads; the answer does not depend on the number.
    #[must_use]
    pub fn with_threads(self, threads: usize) -> Self {
        let workers = WorkerPool::new(threads);
        Self { resources: Resources { workers, ..self.resources }, ..self }
    }

    /// The same experts and maps with separate threads: calls of one never wait for calls of the other.
    #[must_use]
    pub fn beside(&self, threads: usize) -> Self {
        Self {
            resources: Resources {
                experts: Arc::clone(&self.resources.experts),
                workers: WorkerPool::new(threads),
                ..self.resources
            },
            info: self.info.clone(),
            maps: Arc::clone(&self.maps),
            tuning_hash: self.tuning_hash.clone(),
        }
    }

    /// Measures an answer's timings with a clock; without a clock they are zero.
    #[must_use]
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { resources: Resources { clock, ..self.resources }, ..self }
    }

    /// Replaces the shipped tuned numbers.
    #[must_use]
    pub fn with_tuning(self, tuning: Tuning) -> Self {
        let tuning_hash = tuning.hash().hex();
        Self { tuning_hash, resources: Resources { tuning, ..self.resources }, ..self }
    }

    /// The tuned numbers.
    pub fn tuning(&self) -> &Tuning {
        &self.resources.tuning
    }

    /// Runs each expert once on a small scene, so that the first user does not pay for it. This fills the
    /// heap and the caches of the tensor library.
    pub fn warm_up(&self) {
        let points: Vec<Vec2> = (0..40).map(|i| Vec2::new(5.0 * f64::from(i), 0.0)).collect();
        let agent = |i: usize| {
            let agent_type = EXPERTS[i % EXPERTS.len()].0;
            let state = State { x_m: 6.0 * i as f64, vx_mps: 1.0, ..State::default() };
            Agent::bare(i.to_string(), agent_type, Subtype::Unknown, vec![Some(state)])
        };
        let map = LaneMap { lanes: vec![Lane::street("1", points)], ..LaneMap::default() };
        let scene = Scene::bare("", map, (0..24).map(agent).collect());
        if let Ok(call) = self.start(Request::new(Arc::new(scene)), Cancel::default()) {
            call.for_each(drop);
        }
    }

    /// Expert name to facts.
    pub fn weights(&self) -> &BTreeMap<String, WeightsInfo> {
        &self.info
    }

    /// Hashes of everything that its answers depend on: the experts' weights by name, and `tuning`.
    pub fn hashes(&self) -> BTreeMap<String, String> {
        let weights = self.info.iter().map(|(name, info)| (name.clone(), info.sha256.clone()));
        weights.chain([("tuning".to_owned(), self.tuning_hash.clone())]).collect()
    }

    /// Licence of its answers as far as the weights determine it: the strictest of theirs.
    pub fn licence(&self) -> Option<String> {
        scene::licence::strictest(self.info.values().map(|info| info.licence.as_str()))
    }

    /// The cache of maps.
    pub fn maps(&self) -> &Maps {
        &self.maps
    }

    /// Begins a call. The iterator does the work, one event at a time; dropping it stops the call.
    ///
    /// # Errors
    /// Errors that are known before any work: unknown ids, missing starts, too many road users.
    pub fn start(&self, request: Request, cancel: Cancel) -> Result<Generation<'_>, GenerateError> {
        Generation::new(&self.resources, &self.maps, request, cancel)
    }

    /// Runs a call to its end, without its drafts.
    ///
    /// # Errors
    /// The errors of the call.
    pub fn answer(&self, request: Request) -> Result<Answer, GenerateError> {
        self.answer_unless(request, Cancel::default())
    }

    /// As [`Self::answer`], but ends early once `cancel` is set.
    ///
    /// # Errors
    /// The errors of the call.
    pub fn answer_unless(&self, request: Request, cancel: Cancel) -> Result<Answer, GenerateError> {
        self.start(request, cancel)?.finished()
    }
}
