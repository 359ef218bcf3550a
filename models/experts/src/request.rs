//! Requests to the generator, and its events.

use crate::net::schedule;
use crate::planning::world::Planning;
use crate::tuning::fixed::rounds::ROUND_DIVERSITY;
use scene::message::Message;
use scene::motion::Limiting;
use scene::preference::{Feedback, Round};
use scene::score::Thresholds;
use scene::{AgentId, AgentType, Sample, Scene, State, Vec2};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Agents that may react to the regenerated ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum React {
    /// None: all others keep their log or chosen future.
    #[default]
    Nobody,
    /// All agents whose motion comes near a regenerated one.
    Everyone,
    /// Only these.
    Only(BTreeSet<AgentId>),
}

/// Fewest and most samples of a round's draw.
const ROUND_SAMPLES: (usize, usize) = (12, 32);
/// Road users over all samples of a round above which it draws fewer samples, so that a round takes a few
/// seconds.
const ROUND_AGENTS: usize = 2_000;

/// One call of the generator. The scene's agents carry the conditions that hold for this call.
#[derive(Clone, Debug)]
pub struct Request {
    /// Map, signals, road users with their conditions, and futures that kept road users follow.
    pub scene: Arc<Scene>,
    /// Road users to regenerate; `None` means all that can be regenerated.
    pub agents: Option<BTreeSet<AgentId>>,
    /// Agents that may react.
    pub react: React,
    /// Scene step at which the window starts.
    pub start_step: usize,
    /// Steps to generate, 1..=[`scene::MAX_HORIZON_STEPS`]; fewer than 90 cut a window short.
    pub horizon_steps: usize,
    /// Number of steps (1..=90) after which the call replans from the reached states; `None` replans after
    /// 90.
    pub replan_steps: Option<usize>,
    /// Equal seeds give equal answers.
    pub seed: u64,
    /// Independent joint scenes, 1..=32.
    pub samples: usize,
    /// Alternatives kept per road user, 1..=6.
    pub modes: usize,
    /// Scale of the draw's noise, 0..=2; 0 uses the initializer's modes unchanged. Some noise makes seeds
    /// differ, at a centimetre or two of error.
    pub diversity: f64,
    /// Denoising steps, 0..=100; 0 returns the initializer's modes.
    pub steps: usize,
    /// Drafts carry all modes; otherwise, in answers with many agents, only the likeliest.
    pub stream_all: bool,
    /// Futures that the user picked, which are kept. The motion itself is given, because an index into the
    /// last answer's modes may have become invalid.
    pub pinned: BTreeMap<AgentId, Vec<State>>,
    /// The futures shown last, while the user drags. The first sample keeps one unless another is better by
    /// `switching`.
    pub shown: BTreeMap<AgentId, ShownLast>,
    /// The motions in `shown` are being driven. Each is a candidate, and leaving it costs less than while the
    /// user drags.
    pub under_way: bool,
    /// Verdicts on earlier cards. The answer is then the next round of `modes` cards from a wide draw, and
    /// `samples` is ignored. [`Request::round`] sets it.
    pub feedback: Option<Feedback>,
    /// Thresholds of the reported faults. They change no motion.
    pub thresholds: Thresholds,
    /// Stages that run; all of them except in an evaluation.
    pub stages: Stages,
}

/// The future of a road user that the user saw last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShownLast {
    /// Its [`scene::Future::anchor`].
    pub anchor: Option<u32>,
    /// Box centres at every half second after the start, from the first on, as far as known.
    pub places: Vec<Vec2>,
}

/// Which stages of a call run. An evaluation switches some off to measure their effect; users get all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stages {
    /// Which future of each road user is shown.
    pub shown: Shown,
    /// Conflicting futures are pushed apart and offered to the choice.
    pub guidance: bool,
    /// Agents that keep their motion count as obstacles. An evaluation that withholds their motion turns this
    /// off, because an extrapolated motion would be an obstacle that does not exist.
    pub background_in_the_way: bool,
    /// Of two coinciding futures one is changed; otherwise both stay as the initializer made them.
    pub parted: bool,
    /// Report the faults of each future.
    pub judged: bool,
    /// How each road user's futures are planned. The choice knows the whole map either way.
    pub planning: Planning,
    /// How refinement runs.
    pub refining: Refining,
}

/// How refinement runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refining {
    /// Noise level, of 100, at which refinement begins; with more steps than that, as many levels as steps.
    pub start: usize,
    /// The networks see the descent direction of the scene's energy and apply their learned share of it.
    pub repulsion: bool,
    /// The networks attend to the drafts of the agents that each draft meets.
    pub attention: bool,
    /// After the last step, drawn futures that still conflict are moved down the energy gradient without the
    /// networks. A chosen first sample is left out.
    pub resolve_overlaps: bool,
}

impl Default for Refining {
    fn default() -> Self {
        Self { start: schedule::START, repulsion: true, attention: true, resolve_overlaps: true }
    }
}

impl Default for Stages {
    fn default() -> Self {
        Self {
            shown: Shown::Chosen,
            guidance: true,
            background_in_the_way: true,
            parted: true,
            judged: true,
            planning: Planning::default(),
            refining: Refining::default(),
        }
    }
}

/// How the shown future of each road user is picked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// One future per road user so that the scene is coherent.
    #[default]
    Chosen,
    /// The most probable one, regardless of the others.
    Likeliest,
    /// One drawn by its probability, regardless of the others.
    Drawn,
}

/// Defaults of a request, shared by the API, the command line and clients.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Defaults {
    /// Refinement steps.
    pub steps: usize,
    /// Alternatives kept per road user.
    pub modes: usize,
    /// Independent joint scenes.
    pub samples: usize,
    /// Scale of the draw's noise.
    pub diversity: f64,
    /// Time to generate, seconds.
    pub horizon_s: f64,
    /// Seed of the random draws; equal seeds give equal answers.
    pub seed: u64,
}

/// The defaults in force.
pub const DEFAULTS: Defaults = Defaults {
    steps: schedule::STEPS,
    modes: crate::planning::MODES,
    samples: 1,
    diversity: 0.5,
    horizon_s: scene::HORIZON_STEPS as f64 * scene::STEP_S,
    seed: 0,
};

impl Request {
    /// The defaults of `POST /v1/generate` for a scene.
    pub fn new(scene: Arc<Scene>) -> Self {
        Self {
            scene,
            agents: None,
            react: React::Nobody,
            start_step: 0,
            horizon_steps: scene::HORIZON_STEPS,
            replan_steps: None,
            seed: DEFAULTS.seed,
            samples: DEFAULTS.samples,
            modes: DEFAULTS.modes,
            diversity: DEFAULTS.diversity,
            steps: DEFAULTS.steps,
            stream_all: false,
            pinned: BTreeMap::new(),
            shown: BTreeMap::new(),
            under_way: false,
            feedback: None,
            thresholds: Thresholds::default(),
            stages: Stages::default(),
        }
    }

    /// Whether a road user is driving a motion that the call knows.
    pub(crate) fn drives(&self, agent: &str) -> bool {
        self.under_way && self.shown.contains_key(agent)
    }

    /// The next round of cards from a wide draw, given verdicts on earlier cards. Each verdict changes the
    /// seed of the draw, so that new futures appear. More regenerated road users mean fewer drawn samples.
    #[must_use]
    pub fn round(self, feedback: Feedback) -> Self {
        let asked = self.agents.as_ref().map_or(self.scene.agents.len(), BTreeSet::len);
        let samples = (ROUND_AGENTS / asked.max(1)).clamp(ROUND_SAMPLES.0, ROUND_SAMPLES.1);
        let diversity = self.diversity.max(ROUND_DIVERSITY);
        let seed = self.seed.wrapping_add(feedback.answers.len() as u64);
        Self { samples, diversity, seed, feedback: Some(feedback), ..self }
    }
}

/// Source of the value of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// Fixed by the user.
    User,
    /// From the recording.
    Log,
    /// The kind's default.
    Default,
    /// Chosen by the generator.
    Model,
    /// From the motion of the road user that the goal is relative to.
    Relation,
}

/// A value and its source.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Field {
    /// Value, in the unit of the field's name.
    pub value: f64,
    /// Origin.
    pub from: Source,
}

/// Whether a goal is met. `unreachable` has the nearest state and what the goal would require.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Reach")]
#[serde(tag = "status", rename_all = "snake_case")]
pub enum ReachReport {
    /// No goal, or all fixed fields are met.
    Reached {
        /// Distance to the goal position, metres.
        position_m: f64,
        /// Radians.
        heading_rad: f64,
        /// m/s.
        speed_mps: f64,
    },
    /// No future within the limits meets it.
    Unreachable {
        /// Nearest state that can be reached at the goal time.
        nearest: NearestState,
        /// Limit that prevents it.
        limiting: Limiting,
        /// Amount that the goal would require, in the unit of the limit, where a formula gives it.
        needs: Option<f64>,
        /// The reason in English.
        words: String,
        /// The reason as data.
        message: Message,
        /// The road user in the way, if there is one.
        #[serde(skip_serializing_if = "Option::is_none")]
        with: Option<AgentId>,
    },
}

/// A pose and speed, scene frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct NearestState {
    pub x_m: f64,
    pub y_m: f64,
    pub heading_rad: f64,
    pub speed_mps: f64,
}

impl NearestState {
    /// Position.
    pub fn position(&self) -> Vec2 {
        Vec2::new(self.x_m, self.y_m)
    }
}

/// The target of a planning window for a road user whose goal is due after the window's end. It lies on the
/// way to the goal at constant acceleration, along the lanes where they lead to it, else straight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Intermediate {
    /// Planning window, from 0.
    pub window: usize,
    /// Scene time of the target, seconds: the end of the window's plan.
    pub time_s: f64,
    /// The state.
    #[serde(flatten)]
    pub state: NearestState,
    /// Whether the plan reaches it.
    pub reached: bool,
}

/// The start of a road user as it was used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ResolvedStart {
    pub x_m: Field,
    pub y_m: Field,
    pub heading_rad: Field,
    pub speed_mps: Field,
}

/// The goal of a road user as it was used, in the scene frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ResolvedGoal {
    pub x_m: Field,
    pub y_m: Field,
    pub heading_rad: Field,
    pub speed_mps: Field,
    /// Scene time at which it is due.
    pub time_s: Field,
}

/// A position on a lane that can be reached instead of the goal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ByRoad {
    /// Position on the centre line of the lane, metres.
    pub x_m: f64,
    /// Position on the centre line of the lane, metres.
    pub y_m: f64,
    /// Heading of the lane, radians.
    pub heading_rad: f64,
    /// Distance from the goal, metres.
    pub distance_m: f64,
}

/// How a future passes a via point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ResolvedVia {
    /// Its position, metres.
    pub x_m: f64,
    /// Its position, metres.
    pub y_m: f64,
    /// Tolerance of the condition, metres.
    pub tolerance_m: f64,
    /// Whether it is passed within its tolerance, and at its time if that is fixed.
    pub passed: bool,
    /// Least distance of the future from it, metres.
    pub distance_m: f64,
    /// Scene time at the least distance, seconds.
    pub time_s: f64,
}

/// All condition fields of one road user as they were used.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Resolved {
    /// Type whose expert was used.
    #[serde(rename = "type")]
    pub agent_type: AgentType,
    /// Length, metres.
    pub length_m: Field,
    /// Width, metres.
    pub width_m: Field,
    /// Its start.
    pub start: ResolvedStart,
    /// Its goal.
    pub goal: ResolvedGoal,
    /// Whether the goal is met.
    pub reach: ReachReport,
    /// How its shown future passes each via point, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub via: Vec<ResolvedVia>,
    /// If its shown future leaves the road or drives against the traffic: the place nearest to the goal that can be
    /// reached along the road in the same time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_road: Option<ByRoad>,
    /// Targets of the windows whose plan ends before the goal is due.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub intermediate: Vec<Intermediate>,
}

/// Kind of a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WarningCode {
    /// No future within the limits meets the goal.
    GoalUnreachable,
    /// No lane is near the goal.
    GoalOffRoad,
    /// No lane is near the start.
    StartOffRoad,
    /// The start overlaps another road user.
    StartOverlaps,
    /// A recording was extrapolated beyond its end.
    Extrapolated,
    /// The shown future misses a via point.
    ViaMissed,
    /// No road user was requested, and none has to continue beyond its known motion.
    NothingGenerated,
}

impl WarningCode {
    /// The word on the wire.
    pub fn name(self) -> &'static str {
        match self {
            Self::GoalUnreachable => "goal-unreachable",
            Self::GoalOffRoad => "goal-off-road",
            Self::StartOffRoad => "start-off-road",
            Self::StartOverlaps => "start-overlaps",
            Self::Extrapolated => "extrapolated",
            Self::ViaMissed => "via-missed",
            Self::NothingGenerated => "nothing-generated",
        }
    }
}

impl std::fmt::Display for WarningCode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// A warning: an unlikely request that was carried out.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Warning {
    /// Code for programs.
    pub code: WarningCode,
    /// The road user concerned.
    pub agent: Option<AgentId>,
    /// The warning in English.
    pub detail: String,
    /// The warning as data.
    pub message: Message,
}

impl Warning {
    /// A warning about an agent.
    pub fn of(code: WarningCode, agent: &AgentId, message: Message) -> Self {
        Self { agent: Some(agent.clone()), ..Self::of_scene(code, message) }
    }

    /// A warning about the whole scene.
    pub fn of_scene(code: WarningCode, message: Message) -> Self {
        Self { code, agent: None, detail: message.to_string(), message }
    }
}

/// First event: the planned work.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Accepted {
    /// Seed in use.
    pub seed: u64,
    /// Road users that get new futures.
    pub regenerated: Vec<AgentId>,
    /// Road users that may react to them.
    pub reacting: Vec<AgentId>,
    /// Road users that keep their motion.
    pub fixed: Vec<AgentId>,
    /// Refinement steps per window.
    pub steps: usize,
    /// Number of successive planning windows.
    pub windows: usize,
    /// Warnings so far.
    pub warnings: Vec<Warning>,
}

/// A draft event. It carries no futures: [`crate::Generation::drafted`] makes them on request.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// Planning window, from 0. Its futures begin one step after the window's start.
    pub window: usize,
    /// Joint sample, from 0; only the first sample sends drafts.
    pub sample: usize,
    /// 0 for the initializer's modes, then the denoising step.
    pub step: usize,
    /// Denoising steps in all.
    pub steps: usize,
    /// Road users in the draft.
    pub agents: Vec<AgentId>,
}

/// Milliseconds spent.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Timings {
    pub encode_ms: f64,
    pub initial_ms: f64,
    pub step_ms: Vec<f64>,
    pub choice_ms: f64,
}

/// Last event of a call that succeeded.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// One coherent scene per sample. A chosen future runs through all windows to the end of the horizon; its
    /// alternatives belong to the first window and end with that window's plan. A kept future of the scene
    /// that ends before the horizon is extended, and is then part of the answer. In a call for all agents the
    /// same holds for an agent that enters later and whose log ends; its future begins after it has entered.
    pub samples: Vec<Sample>,
    /// Planning windows that were run, one after the other.
    pub windows: usize,
    /// Report by regenerated or reacting road user that was present at the start.
    pub resolved: BTreeMap<AgentId, Resolved>,
    /// Unlikely conditions of the request.
    pub warnings: Vec<Warning>,
    /// Durations of the stages.
    pub timings: Timings,
    /// Traits of the cards and what was learned, if feedback was given. With one road user each future is a
    /// card, with several each sample.
    pub round: Option<Round>,
}

/// The items of [`crate::Generator::start`], in order: accepted, then per window the drafts of the first
/// sample, then one answer.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "few exist at a time")]
pub enum Event {
    /// First.
    Accepted(Accepted),
    /// Initial modes and each refinement step.
    Draft(Draft),
    /// Last.
    Final(Answer),
}

/// Why a call cannot be answered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// No road user has this id.
    #[error("no road user \"{0}\"")]
    UnknownAgent(AgentId),
    /// The map, or the region of it, has no such arm.
    #[error("no arm \"{arm}\"; {known}")]
    UnknownArm {
        /// The requested arm.
        arm: String,
        /// The ids of all arms, as one text.
        known: String,
    },
    /// A start field is free, and neither log nor default provides it.
    #[error("{agent}: start field {field} is free and nothing fills it")]
    StartMissing {
        /// The agent whose field is missing.
        agent: AgentId,
        /// The missing field.
        field: &'static str,
    },
    /// More than 128 road users to regenerate.
    #[error("{found} road users to regenerate; at most {most}")]
    TooManyAgents {
        /// Requested.
        found: usize,
        /// Allowed.
        most: usize,
    },
    /// A network returned a number that is not finite.
    #[error("step {step}: the expert gave a number that is not finite for {agent}")]
    NonFinite {
        /// The refinement step; 0 for the initializer.
        step: usize,
        /// The agent of the future.
        agent: AgentId,
    },
    /// The caller cancelled.
    #[error("cancelled")]
    Cancelled,
    /// A stage of a call ran before its window was planned; a defect of the program.
    #[error("no window is planned")]
    NoWindow,
    /// An error of the tensor library; a defect of the program or its weights.
    #[error("expert failed: {0}")]
    Expert(String),
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::LaneMap;

    #[test]
    fn a_round_of_many_road_users_draws_fewer_samples() {
        let drawn = |asked: usize| {
            let agents = Some((0..asked).map(|i| i.to_string()).collect());
            let scene = Arc::new(Scene::bare("crowd", LaneMap::default(), Vec::new()));
            Request { agents, ..Request::new(scene) }.round(Feedback::default()).samples
        };
        assert_eq!([1, 62, 80, 128].map(drawn), [32, 32, 25, 15]);
    }
}
