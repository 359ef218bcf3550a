//! The plan of a generation: a request that was checked against its scene.

use super::concerned;
use super::request::{GenerateRequest, KeptFutures, StreamModes};
use crate::code::Code;
use crate::compact::FuturesForm;
use crate::english;
use crate::events::GeneratedHead;
use crate::limits::CallLimits;
use crate::opened::Standings;
use crate::problem::{Problem, refuse, shortened};
use experts::{Generator, MapCost, Request};
use formats::{FieldProblem, pointer_token};
use scene::score::Thresholds;
use scene::{Agent, Conditions, ContentHash, Scene, Start, licence};
use serde_json::json;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

/// Work per via point, window and sample if the point lies far off every path; milliseconds of a core.
const VIA_MS: f64 = 22.0;

/// A generation that is ready to start.
#[derive(Clone)]
pub struct GenerationPlan {
    /// The generator's request. Its scene has this call's road users and conditions.
    pub request: Request,
    /// Whether the caller reads drafts, not only the final answer.
    pub drafts: bool,
    /// Scores of the unchanged scene, if that scene stays open.
    pub standings: Option<Arc<Standings>>,
    /// Cost of work on the map.
    map_cost: MapCost,
    /// Drafts contain all alternatives, not only the chosen ones.
    pub(super) all_modes: bool,
    /// Drafts that are ready sooner than this after the start of the work are skipped, until one is sent.
    pub(super) draft_delay: Duration,
    /// Drafts of steps that come sooner than this after the last sent draft are skipped.
    pub(super) draft_interval: Duration,
    /// Form of the futures.
    pub(super) form: FuturesForm,
    /// Whether each sample is scored.
    pub(super) score: bool,
    /// Whether samples include the futures of road users outside the call.
    pub(super) with_kept: bool,
    /// The other members of `generated`.
    pub(super) head: GeneratedHead,
}

impl GenerateRequest {
    /// Checks a request against a scene.
    ///
    /// # Errors
    /// Every fault of the options, conditions and ids.
    pub fn plan(
        &self,
        scene: &Scene,
        limits: &CallLimits,
        generator: &Generator,
    ) -> Result<GenerationPlan, Problem> {
        self.check_ranges()?;
        let applied = Arc::new(self.apply(scene.clone())?);
        let request = self.engine_request(&applied, limits)?;
        self.refuse_not_asked(scene, &applied, &request)?;
        let mut head =
            GeneratedHead::new(applied.input_hash().hex(), generator.hashes(), self.seed, self.options());
        head.stale = self.keeps_stale(scene, &applied, &request);
        let stricter = |weights: &String| !licence::is_open(weights);
        head.licence = generator.licence().filter(stricter);
        let plan = GenerationPlan {
            request,
            drafts: true,
            standings: None,
            map_cost: generator.maps().cost(&scene.map),
            all_modes: self.stream_modes == StreamModes::All,
            draft_delay: Duration::from_millis(self.draft_delay_ms),
            draft_interval: Duration::from_millis(self.draft_interval_ms),
            form: self.futures,
            score: self.score,
            with_kept: self.kept_futures == KeptFutures::Answered,
            head,
        };
        let (work_s, most) = (plan.work_ms() * 1e-3, limits.work_s);
        if work_s > most as f64 {
            let message = english::too_much_work(work_s.ceil() as usize, most as usize);
            return Err(Problem::of(Code::TooMuchWork, message).at("/samples").limit(most));
        }
        Ok(plan)
    }

    /// Refuses conditions that would change no motion: those of road users that are not generated and keep no
    /// future. A road user that may react keeps its motion unless another is in the way, so its goal would be
    /// ignored too.
    fn refuse_not_asked(&self, scene: &Scene, applied: &Scene, request: &Request) -> Result<(), Problem> {
        let asked = |id: &String| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
        let keeps = |id: &String| applied.generated.as_ref().is_some_and(|g| g.chosen_future(id).is_some());
        let of =
            |scene: &Scene, id| scene.agent(id).map(|agent| agent.conditions.clone()).unwrap_or_default();
        let ids = self.conditions.0.keys().filter(|id| !asked(id) && !keeps(id));
        refuse(ids.flat_map(|id| not_asked(id, &of(applied, id), &of(scene, id))).collect())
    }

    /// Whether a kept future was generated for other conditions than those of the scene with this call's
    /// changes.
    fn keeps_stale(&self, scene: &Scene, applied: &Scene, request: &Request) -> bool {
        let (Some(before), Some(generated)) = (&scene.generated, &applied.generated) else { return false };
        let asked = |id: &String| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
        let ids = generated.samples.get(generated.chosen_sample).into_iter().flat_map(|s| s.agents.keys());
        let mut kept = ids.filter(|id| !asked(id)).peekable();
        let changed = before.stale || before.input_sha256 != scene.input_hash().hex();
        kept.peek().is_some() && (changed || kept.any(|id| self.conditions.0.contains_key(id)))
    }

    /// The options as sent, for `generated.request`.
    fn options(&self) -> serde_json::Value {
        let mut options = json!({
            "agents": self.chosen_agents(), "react": self.react, "start_s": self.start_s, "horizon_s": self.horizon_s,
            "replan_interval_s": self.replan_interval_s, "samples": self.samples, "modes": self.modes,
            "diversity": self.diversity, "steps": self.steps,
        });
        if self.kept_futures != KeptFutures::default() {
            options["kept_futures"] = json!(self.kept_futures);
        }
        if let Some(feedback) = &self.feedback {
            options["feedback"] = json!(feedback);
        }
        if !self.pinned.is_empty() {
            options["pinned"] = json!(self.pinned);
        }
        if self.thresholds != Thresholds::default() {
            options["thresholds"] = json!(self.thresholds);
        }
        options
    }
}

/// The fields of a condition that would be ignored: those that differ from the scene's own.
fn not_asked(id: &str, given: &Conditions, own: &Conditions) -> Vec<FieldProblem> {
    let relative = given.relation != own.relation && given.relation.is_some();
    let parts = [
        ("start", given.start != own.start && given.start != Start::default()),
        ("goal", given.goal != own.goal && !given.goal.is_free() || relative),
        ("via", given.via != own.via && !given.via.is_empty()),
    ];
    let fault = |(part, _)| {
        let pointer = format!("/conditions/{}/{part}", pointer_token(id));
        FieldProblem::new(pointer, Code::NotAsked.name(), english::not_asked(&shortened(id)))
    };
    parts.into_iter().filter(|(_, lost)| *lost).map(fault).collect()
}

impl GenerationPlan {
    /// Six characters that identify the inputs of the answer: the scene with its conditions and kept futures,
    /// the options, the seed, and the engine.
    pub fn code(&self) -> String {
        let Self { request, head, .. } = self;
        let generated = request.scene.generated.as_ref();
        let sample = generated.and_then(|generated| generated.samples.get(generated.chosen_sample));
        let asked = |id: &String| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
        let stays = |id: &String| !asked(id) || request.pinned.contains_key(id);
        let futures = sample.into_iter().flat_map(|sample| &sample.agents).filter(|(id, _)| stays(id));
        let kept: Vec<_> =
            futures.map(|(id, f)| (id, f.modes.get(f.chosen).map(|m| (m.first_step, &m.states)))).collect();
        let shown: Vec<_> =
            request.shown.iter().map(|(id, shown)| (id, shown.anchor, &shown.places)).collect();
        let version = env!("CARGO_PKG_VERSION");
        let of = (version, &head.input_sha256, &head.weights, head.seed, &head.request, kept, shown);
        ContentHash::of(&of).short()
    }

    /// Approximate duration on one thread, including the preparation of a map that is not cached.
    pub fn cost(&self) -> Duration {
        self.map_cost.preparation + Duration::from_secs_f64(1e-3 * self.work_ms())
    }

    /// The same without the map. Measured on two cores of 2.6 GHz with scores: 4 ms for each road user,
    /// window and sample, 0.1 ms for each denoising step, and [`VIA_MS`] for each via point. Searches on a
    /// dense map take longer.
    fn work_ms(&self) -> f64 {
        let Request { agents, samples, steps, horizon_steps, replan_steps, .. } = &self.request;
        let windows = horizon_steps.div_ceil(replan_steps.unwrap_or(scene::HORIZON_STEPS).max(1));
        let concerned = concerned(&self.request);
        let asked = agents.as_ref().map_or(concerned, BTreeSet::len);
        let each_ms = 4.0 + 0.1 * *steps as f64;
        let others_ms = 0.3 * concerned.saturating_sub(asked) as f64;
        let is_asked = |agent: &&Agent| agents.as_ref().is_none_or(|asked| asked.contains(&agent.id));
        let asked_agents = self.request.scene.agents.iter().filter(is_asked);
        let vias: usize = asked_agents.map(|agent| agent.conditions.via.len()).sum();
        let sample_ms = each_ms * asked as f64 + others_ms + VIA_MS * vias as f64;
        (windows * samples) as f64 * sample_ms * self.map_cost.crowded
    }

    /// The longest wait for a first draft.
    pub fn draft_delay(&self) -> Duration {
        self.draft_delay
    }
}
