//! The request of a generation, with its defaults.

use crate::compact::FuturesForm;
use crate::english;
use crate::feedback::FeedbackDoc;
use crate::home::{AboutScene, SceneRef, one_scene};
use experts::request::DEFAULTS;
use formats::native::{AgentDoc, ConditionsDoc, GoalDoc, Members, SceneDoc};
use scene::STEP_S;
use scene::message::Message;
use scene::score::Thresholds;
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Largest absolute angle of a condition in a request: a full turn, radians. A document may contain up to
/// 1000 rad, which is wrapped.
pub const MOST_ANGLE_RAD: f64 = std::f64::consts::TAU;

/// `"all"` or a list of ids.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "\"all\" or a list of ids of road users is expected")]
#[schemars(rename = "Who")]
pub enum AgentChoice {
    /// `"all"`.
    All(AllWord),
    /// The road users with these ids.
    Ids(Vec<String>),
}

/// The value `all`.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "All")]
pub enum AllWord {
    /// All road users.
    All,
}

/// Road users that may react: true for all nearby, or ids.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "true, false or a list of ids of road users is expected")]
#[schemars(rename = "Reacting")]
pub enum ReactChoice {
    /// All, or none.
    Whether(bool),
    /// The road users with these ids.
    Ids(Vec<String>),
}

/// Futures in drafts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StreamModes {
    /// The chosen future of each road user.
    #[default]
    Chosen,
    /// All alternatives.
    All,
}

/// Use of the futures of earlier calls, for road users that are not generated in this one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum KeptFutures {
    /// The plans take them into account, and the answer contains them beside the new ones: its samples are of
    /// the whole scene.
    #[default]
    Answered,
    /// The plans take them into account, and the answer leaves them out, for a client that has them.
    Omitted,
    /// They are removed before planning: their road users follow the recording again.
    Forgotten,
}

/// Body of a generation. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = one_scene, transform = absent_agents)]
pub struct GenerateRequest {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the call is refused if the scene has changed.
    pub etag: Option<String>,
    /// With `scene`: the server holds it in memory. Later calls use the name in the reply's header `Dragtraffic-Scene`
    /// as their `scene_id`. The server drops scenes that were not used for a long time (`not-found`).
    pub hold: bool,
    /// Conditions that replace all those of the scene for these road users. Type and size always apply. A start, goal
    /// or via point is refused (`not-asked`) where it would change no motion: the road user is not in `agents`, the
    /// scene keeps no future of it, and its own conditions are others.
    pub conditions: Members<ConditionsDoc>,
    /// Road users added for this call.
    pub add_agents: Vec<AgentDoc>,
    /// Road users removed for this call.
    pub remove_agents: Vec<String>,
    /// The client's id of the job, which can cancel it.
    pub job: Option<String>,
    /// With `revision`: a newer revision of this client replaces the running one.
    pub client: Option<String>,
    /// Increases with each request of `client`.
    #[schemars(range(max = 9007199254740991u64))]
    pub revision: Option<u64>,
    /// A background call: calls without this flag go first, in the queue and on the cores.
    pub background: bool,
    /// Road users to regenerate. When absent: those whose `conditions` have a goal or via points, or all when no road
    /// user has any. An empty list needs `react` and regenerates no road user: those of `react` keep their known
    /// motion, and where it ends before the last window (`horizon_s` above 9, or `replan_interval_s`), they plan on
    /// from there. Without such a road user the answer has no futures, and the warning `nothing-generated`.
    #[schemars(with = "AgentChoice")]
    pub agents: Option<AgentChoice>,
    /// Road users that may react to them.
    pub react: ReactChoice,
    /// Road users that continue with the chosen future that the scene keeps for them: it counts as requested, and
    /// other road users react to it.
    pub pinned: Vec<String>,
    /// Scene time of the start, seconds.
    #[schemars(range(min = 0.0, max = 59.9))]
    pub start_s: f64,
    /// Time to generate, seconds. Beyond 9 s it is planned window by window.
    #[schemars(range(min = 0.5, max = 20.0))]
    pub horizon_s: f64,
    /// Replan interval, seconds: 3, 6 or 9; null is 9. Each plan starts from the states reached.
    pub replan_interval_s: Option<f64>,
    /// Seed of the random draws; equal seeds give equal answers.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
    /// Joint samples.
    #[schemars(range(min = 1, max = 32))]
    pub samples: u64,
    /// Futures kept per road user.
    #[schemars(range(min = 1, max = 6))]
    pub modes: u64,
    /// Scale of the noise, which makes seeds differ; 0 gives the most probable answer for every seed.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub diversity: f64,
    /// Refinement steps; 0 returns the first draft.
    #[schemars(range(max = 100))]
    pub steps: u64,
    /// The futures shown last for these road users during a drag: each is kept unless another is better by the cost of
    /// `switching`.
    pub shown: Members<ShownDoc>,
    /// Requests a round of cards, chosen by the verdicts on earlier cards; `{}` requests the first round. For one road
    /// user without reactions each future is a card, else each sample. `modes` is the number of cards; `samples` has
    /// no effect.
    pub feedback: Option<FeedbackDoc>,
    /// Futures in drafts.
    pub stream_modes: StreamModes,
    /// Time from the start of the work before which drafts are left out, `initial` included, milliseconds; 0
    /// leaves out none. `accepted` waits as long for the first draft or the answer: an early answer comes together
    /// with it.
    #[schemars(range(max = 1000))]
    pub draft_delay_ms: u64,
    /// Minimum time between two drafts, milliseconds: an earlier `step` event is left out; 0 sends all. A page at
    /// 60 frames per second shows at most one draft in 16 ms.
    #[schemars(range(max = 1000))]
    pub draft_interval_ms: u64,
    /// Form of the futures, in drafts and in `final`.
    pub futures: FuturesForm,
    /// Use of the futures of earlier calls, for road users that are not generated in this one.
    pub kept_futures: KeptFutures,
    /// Whether `final` has scores.
    pub score: bool,
    /// Thresholds of near misses, harsh braking and the like, in `faults` and `scores`; absent ones have their
    /// defaults. They change no motion.
    pub thresholds: Thresholds,
}

/// The default of `agents` depends on the conditions, so the schema has none.
fn absent_agents(schema: &mut Schema) {
    if let Some(agents) = schema.pointer_mut("/properties/agents").and_then(Value::as_object_mut) {
        agents.remove("default");
    }
}

impl Default for GenerateRequest {
    /// The defaults of a request.
    fn default() -> Self {
        Self {
            scene: None,
            scene_id: None,
            etag: None,
            hold: false,
            conditions: Members::default(),
            add_agents: Vec::new(),
            remove_agents: Vec::new(),
            job: None,
            client: None,
            revision: None,
            background: false,
            agents: None,
            react: ReactChoice::Whether(false),
            pinned: Vec::new(),
            start_s: 0.0,
            horizon_s: DEFAULTS.horizon_s,
            replan_interval_s: None,
            seed: DEFAULTS.seed,
            samples: DEFAULTS.samples as u64,
            modes: DEFAULTS.modes as u64,
            diversity: DEFAULTS.diversity,
            steps: DEFAULTS.steps as u64,
            shown: Members::default(),
            feedback: None,
            stream_modes: StreamModes::default(),
            draft_delay_ms: 0,
            draft_interval_ms: 0,
            futures: FuturesForm::default(),
            kept_futures: KeptFutures::default(),
            score: true,
            thresholds: Thresholds::default(),
        }
    }
}

/// The future that was shown last.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShownDoc {
    /// Its `anchor`.
    #[serde(default)]
    pub anchor: Option<u32>,
    /// Box centres at every half second after the start, metres; at most 18 are used.
    pub x_m: Vec<f64>,
    /// Box centres, metres; as many as `x_m`.
    pub y_m: Vec<f64>,
}

impl AboutScene for GenerateRequest {
    fn take_scene(&mut self) -> SceneRef {
        SceneRef {
            scene: self.scene.take(),
            scene_id: self.scene_id.take(),
            etag: self.etag.take(),
            hold: self.hold,
        }
    }
}

impl GenerateRequest {
    /// The road users to regenerate: the named ones, else those with a goal, else all.
    pub fn chosen_agents(&self) -> AgentChoice {
        let going = |doc: &ConditionsDoc| {
            !doc.via.is_empty() || doc.goal.as_ref().is_some_and(|goal| *goal != GoalDoc::default())
        };
        let named = || {
            let ids = self.conditions.0.iter().filter(|(_, doc)| going(doc)).map(|(id, _)| id.clone());
            let ids: Vec<String> = ids.collect();
            if ids.is_empty() { AgentChoice::All(AllWord::All) } else { AgentChoice::Ids(ids) }
        };
        self.agents.clone().unwrap_or_else(named)
    }

    /// Scene step of the start.
    pub fn start_step(&self) -> usize {
        (self.start_s / STEP_S).round() as usize
    }

    /// Steps to generate.
    pub(super) fn horizon_steps(&self) -> usize {
        (self.horizon_s / STEP_S).round().max(1.0) as usize
    }
}

/// The message for an angle beyond [`MOST_ANGLE_RAD`], which is usually meant in degrees.
pub fn more_than_a_turn(got: f64) -> Message {
    let radians = format!("{:.4}", got.to_radians());
    let got = if got.abs() < 1e15 { got.to_string() } else { format!("{got:e}") };
    english::more_than_a_turn(&got, &radians)
}
