//! `/v1/generate`: conditions to futures.

use super::feedback::FeedbackDoc;
use super::openapi::one_scene;
use super::scene_ref::{AboutScene, SceneRef, Subject};
use super::score;
use crate::app::App;
use crate::base::id::is_id;
use crate::base::limits::{self, Limits};
use crate::base::problem::{Code, Problem};
use crate::generation::compact::FuturesForm;
use crate::generation::events::GeneratedHead;
use crate::generation::stream::{self, Pace};
use crate::generation::{self, Task};
use crate::http::accept::Form;
use crate::http::body::Json;
use crate::http::extract::Connection;
use crate::http::line;
use crate::http::net::Carrier;
use crate::scenes::bytes_of;
use crate::work::Caller;
use axum::Extension;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::ws::rejection::WebSocketUpgradeRejection;
use axum::extract::{FromRequest, Request, State};
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::Response;
use experts::React;
use experts::request::{DEFAULTS, ShownLast};
use formats::native::{AgentDoc, ConditionsDoc, Context, MAX_SAFE_INTEGER, Members, SceneDoc, Window};
use formats::{FieldProblem, ReadError, pointer_token};
use scene::score::Thresholds;
use scene::{MAX_HORIZON_STEPS, STEP_S, Scene, Vec2, licence};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

/// Half seconds of a planning window.
const MOST_SHOWN: usize = 18;
/// Intervals of re-planning, seconds: the paper's.
const REPLAN_S: [f64; 3] = [3.0, 6.0, 9.0];

/// `"all"` or a list of ids.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Who {
    /// `"all"`.
    All(All),
    /// These.
    Ids(Vec<String>),
}

/// The word `all`.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum All {
    /// Everyone.
    All,
}

/// Who else answers: true for everyone near, or ids.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Reacting {
    /// Everyone, or nobody.
    Whether(bool),
    /// These.
    Ids(Vec<String>),
}

/// What drafts carry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StreamModes {
    /// The chosen future of each road user.
    #[default]
    Chosen,
    /// All alternatives.
    All,
}

/// What becomes of the futures that the scene has from earlier calls, of those who are not part of this one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum KeptFutures {
    /// They are planned around and answered beside the new ones: the samples are the whole scene's.
    #[default]
    Answered,
    /// They are planned around and not answered, for a client that has them itself.
    Omitted,
    /// They are dropped: who has one goes back to its log before anything is planned.
    Forgotten,
}

/// Body of a generation. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = one_scene)]
pub struct GenerateRequest {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    #[serde(default)]
    scene: Option<SceneDoc>,
    /// A scene of this server.
    #[serde(default)]
    scene_id: Option<String>,
    /// With `scene_id`: refuse when the scene has changed.
    #[serde(default)]
    etag: Option<String>,
    /// With `scene`: it is held in memory for the calls that follow, which name it as their `scene_id` by what the
    /// reply's header `Dragtraffic-Scene` says. One that was not asked for in a long time is forgotten (`not-found`).
    #[serde(default)]
    hold: bool,
    /// Replace the scene's own conditions of these road users, whole.
    #[serde(default)]
    conditions: Members<ConditionsDoc>,
    /// Road users put in for this call.
    #[serde(default)]
    add_agents: Vec<AgentDoc>,
    /// Road users taken out for this call.
    #[serde(default)]
    remove_agents: Vec<String>,
    /// Own id for the job, so that it can be cancelled.
    #[serde(default)]
    job: Option<String>,
    /// With `revision`: a newer revision of this client takes over.
    #[serde(default)]
    client: Option<String>,
    /// Rises with each request of `client`.
    #[serde(default)]
    #[schemars(range(max = 9007199254740991u64))]
    revision: Option<u64>,
    /// Nobody waits for the answer: calls that somebody waits for go first, on the cores of the machine too.
    #[serde(default)]
    background: bool,
    /// Road users to regenerate. With none, those of `react` go on as they do, past the end of what is known of them,
    /// and give way to each other there.
    #[serde(default = "everyone")]
    agents: Who,
    /// Who else answers to them.
    #[serde(default = "nobody")]
    react: Reacting,
    /// Road users that go on with the chosen future that the scene keeps for them: it is as good as asked for, and
    /// the others answer it.
    #[serde(default)]
    pinned: Vec<String>,
    /// Scene time of the start, seconds.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 59.9))]
    start_s: f64,
    /// Seconds to generate. More than 9 is planned window after window.
    #[serde(default = "usual_horizon")]
    #[schemars(range(min = 0.5, max = 20.0))]
    horizon_s: f64,
    /// Plan anew, from the states reached, after so many seconds: 3, 6 or 9; null is 9.
    #[serde(default)]
    replan_interval_s: Option<f64>,
    /// The same seed gives the same answer.
    #[serde(default = "usual_seed")]
    #[schemars(range(max = 9007199254740991u64))]
    seed: u64,
    /// Independent joint scenes.
    #[serde(default = "usual_samples")]
    #[schemars(range(min = 1, max = 32))]
    samples: u64,
    /// Alternatives kept per road user.
    #[serde(default = "usual_modes")]
    #[schemars(range(min = 1, max = 6))]
    modes: u64,
    /// Scale of the noise, which makes seeds differ; 0 is the best guess, the same for every seed.
    #[serde(default = "usual_diversity")]
    #[schemars(range(min = 0.0, max = 2.0))]
    diversity: f64,
    /// Denoising steps; 0 returns the first guess.
    #[serde(default = "usual_steps")]
    #[schemars(range(max = 100))]
    steps: u64,
    /// What a person has seen last of these road users, while dragging: the answer leaves it only for a gain worth
    /// the jump.
    #[serde(default)]
    shown: Members<ShownDoc>,
    /// Asks for a round of cards in place of the best guess, by what was said of earlier cards; `{}` is the first
    /// round. Of one road user whom nobody answers each of its futures is a card, else each sample; `modes` says how
    /// many. `samples` does not count.
    #[serde(default)]
    feedback: Option<FeedbackDoc>,
    /// What drafts carry.
    #[serde(default)]
    stream_modes: StreamModes,
    /// Drafts that stand sooner than this after the work began are left out, `initial` too, in milliseconds; 0
    /// leaves out none. An answer that is there as soon as that needs no drafts before it, and comes together with
    /// `accepted`, which waits for it so long.
    #[serde(default)]
    #[schemars(range(max = 1000))]
    draft_delay_ms: u64,
    /// `step` events that come sooner than this after the draft sent before are left out, in milliseconds; 0 sends
    /// all. A page that draws sixty pictures a second has no use for more than one in 16 ms.
    #[serde(default)]
    #[schemars(range(max = 1000))]
    draft_interval_ms: u64,
    /// How futures are written, in drafts and in `final`.
    #[serde(default)]
    futures: FuturesForm,
    /// What becomes of the futures that the scene has, of those who are not part of this call.
    #[serde(default)]
    kept_futures: KeptFutures,
    /// Put scores into `final`.
    #[serde(default = "yes")]
    score: bool,
    /// Numbers that decide what counts as a near miss, harsh braking and the like, in `faults` and `scores`; those
    /// absent have their defaults. They change no motion.
    #[serde(default)]
    thresholds: Thresholds,
}

/// The future that was shown last.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShownDoc {
    /// Its `anchor`.
    #[serde(default)]
    anchor: Option<u32>,
    /// Box centres at every half second after the start, metres; at most 18 count.
    x_m: Vec<f64>,
    /// As many as `x_m`.
    y_m: Vec<f64>,
}

impl ShownDoc {
    fn places(&self, pointer: &str) -> Result<Vec<Vec2>, FieldProblem> {
        if self.x_m.len() != self.y_m.len() {
            let detail = format!("{} values, as many as x_m ({}) expected", self.y_m.len(), self.x_m.len());
            return Err(FieldProblem::new(format!("{pointer}/y_m"), "invalid-field", detail));
        }
        let places = self.x_m.iter().zip(&self.y_m).take(MOST_SHOWN);
        Ok(places.map(|(x, y)| Vec2::new(*x, *y)).collect())
    }
}

fn everyone() -> Who {
    Who::All(All::All)
}
fn nobody() -> Reacting {
    Reacting::Whether(false)
}
fn usual_horizon() -> f64 {
    DEFAULTS.horizon_s
}
fn usual_seed() -> u64 {
    DEFAULTS.seed
}
fn usual_samples() -> u64 {
    DEFAULTS.samples as u64
}
fn usual_modes() -> u64 {
    DEFAULTS.modes as u64
}
fn usual_diversity() -> f64 {
    DEFAULTS.diversity
}
fn usual_steps() -> u64 {
    DEFAULTS.steps as u64
}
fn yes() -> bool {
    true
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

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK,
    NotAcceptable, Exists, Superseded, StaleRevision, ReplyTooLarge, NonFiniteOutput);

/// Generates futures. The reply is a stream of events (NDJSON or SSE) or the last event alone (JSON),
/// by Accept. Stores nothing.
#[utoipa::path(post, path = "/v1/generate", operation_id = "generate", tag = "generate",
    request_body(content = ref("#/components/schemas/GenerateRequest"), content_type = "application/json",
        example = json!({
            "scene_id": "demo-crossing", "agents": ["5"], "seed": 7,
            "conditions": {"5": {"goal": {"x_m": 14.0, "y_m": 0.4, "speed_mps": 6.0}}},
        })),
    responses((status = 200, description = "the answer", content(
        (ref("#/components/schemas/FinalEvent") = "application/json"),
        (ref("#/components/schemas/Event") = "application/x-ndjson", extensions(("x-stream-item" = json!(true)))),
        (ref("#/components/schemas/Event") = "text/event-stream", extensions(("x-stream-item" = json!(true)))))),
        Refused))]
pub async fn generate(
    State(app): State<App>,
    connection: Connection,
    request: Request,
) -> Result<Response, Problem> {
    let form = Form::negotiate(request.headers())?;
    let Json(mut body) = Json::<GenerateRequest>::from_request(request, &app).await?;
    let caller = Caller { connection: Some(connection.number), ..body.caller()? };
    // Opening and preparing a scene costs more than a refusal may.
    app.pool.expects(caller.client.as_ref().map(|client| client.0.as_str()))?;
    let Subject { scene, standings, held } = body.take_scene().open(&app).await?;
    let streams = form != Form::Json;
    let (shared, bytes) = (app.clone(), bytes_of(&scene));
    let prepare = move || {
        let task = body.task(&scene, &shared.limits, &shared.generator)?;
        Ok(Task { streams, standings, ..task })
    };
    let task = app.pool.document(bytes, prepare).await?;
    let pace =
        Pace { heartbeat: Duration::from_secs(app.limits.heartbeat_s.max(1)), together: task.draft_delay };
    let reader = generation::submit(&app.pool, app.experts(), &app.limits, caller, task)?;
    let mut reply = stream::reply(reader, form, pace).await;
    if let Some(name) = held.and_then(|name| HeaderValue::from_str(&name).ok()) {
        reply.headers_mut().insert("dragtraffic-scene", name);
    }
    Ok(reply)
}

refusals!(NoLine: CHANGES, UpgradeRequired);

/// A WebSocket for many generations, one after the other or at the same time, at a third of what requests of their
/// own cost a browser. Each text message asks, `{"ask": 1, "body": {..}}` with the body of a `POST` and a number of
/// the client's choice, or gives up: `{"end": 1}`. What is told of a question is a line `{"ask": 1, "status": 200}`,
/// in the first message with `retry_after_s` and `scene` (the header `Dragtraffic-Scene`) where the reply would have
/// them, in the last one with `"last": true`; after it come lines as a `POST` streams them as NDJSON, or the problem.
/// A question that is given up ends with `{"ask": 1, "last": true}` too, and then its number is free. One whose answer
/// breaks off ends with a second `status` and its problem. Questions beyond `line_questions` wait until another one
/// ends; while 64 wait, or 1 MB (`line_bytes`), a further one is refused with 503 `busy`.
#[utoipa::path(get, path = "/v1/generate", operation_id = "openLine", tag = "generate",
    responses((status = 101, description = "the connection is a WebSocket now"), NoLine))]
pub async fn line(
    upgrade: Result<WebSocketUpgrade, WebSocketUpgradeRejection>,
    carrier: Option<Extension<Carrier>>,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let (Ok(upgrade), Some(Extension(carrier))) = (upgrade, carrier) else {
        let upgrade = (header::UPGRADE, HeaderValue::from_static("websocket"));
        let mut problem =
            Problem::new(Code::UpgradeRequired, "A generation is asked for by POST, or over a WebSocket.");
        problem.headers.push(upgrade);
        return Err(problem);
    };
    Ok(line::open(upgrade, carrier, "/v1/generate", &headers))
}

impl GenerateRequest {
    /// What the generator is to do with a scene.
    ///
    /// # Errors
    /// Every fault of the options, conditions and ids.
    pub fn task(
        &self,
        scene: &Scene,
        limits: &Limits,
        generator: &experts::Generator,
    ) -> Result<Task, Problem> {
        self.check_ranges()?;
        let applied = Arc::new(self.apply(scene.clone())?);
        let request = self.request(&applied, limits.regenerated_agents, limits.reply_points)?;
        let mut head =
            GeneratedHead::new(applied.input_hash().hex(), generator.hashes(), self.seed, self.options());
        head.stale = self.keeps_stale(scene, &applied, &request);
        let stricter = |weights: &String| !licence::is_open(weights);
        head.licence = generator.licence().filter(stricter);
        let all_modes = self.stream_modes == StreamModes::All;
        let (form, score) = (self.futures, self.score);
        let with_kept = self.kept_futures == KeptFutures::Answered;
        let draft_delay = Duration::from_millis(self.draft_delay_ms);
        let draft_interval = Duration::from_millis(self.draft_interval_ms);
        Ok(Task {
            request,
            all_modes,
            draft_delay,
            draft_interval,
            form,
            score,
            with_kept,
            head,
            streams: true,
            standings: None,
        })
    }

    /// A future that is kept answers something else than what the scene says with this call's conditions.
    fn keeps_stale(&self, scene: &Scene, applied: &Scene, request: &experts::Request) -> bool {
        let (Some(before), Some(generated)) = (&scene.generated, &applied.generated) else { return false };
        let asked = |id: &String| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
        let ids = generated.samples.get(generated.chosen_sample).into_iter().flat_map(|s| s.agents.keys());
        let mut kept = ids.filter(|id| !asked(id)).peekable();
        let changed = before.stale || before.input_sha256 != scene.input_hash().hex();
        kept.peek().is_some() && (changed || kept.any(|id| self.conditions.0.contains_key(id)))
    }

    fn caller(&self) -> Result<Caller, Problem> {
        for (pointer, id) in [("/job", &self.job), ("/client", &self.client)] {
            if id.as_ref().is_some_and(|id| !is_id(id)) {
                return Err(Problem::field(
                    pointer,
                    Code::InvalidField,
                    "1 to 64 of A-Z a-z 0-9 _ and - expected",
                ));
            }
        }
        let client = match (&self.client, self.revision) {
            (Some(client), Some(revision)) => Some((client.clone(), revision)),
            (None, None) => None,
            _ => {
                let detail = "client and revision are given together";
                return Err(Problem::field("/revision", Code::InvalidField, detail));
            }
        };
        Ok(Caller { job: self.job.clone(), client, connection: None, background: self.background })
    }

    /// Numbers that do not depend on the scene.
    fn check_ranges(&self) -> Result<(), Problem> {
        let safe = MAX_SAFE_INTEGER as f64;
        let numbers = [
            ("/seed", 0.0, safe, self.seed as f64),
            ("/revision", 0.0, safe, self.revision.unwrap_or(0) as f64),
            ("/horizon_s", 0.5, MAX_HORIZON_STEPS as f64 * STEP_S, self.horizon_s),
            ("/samples", 1.0, limits::SAMPLES as f64, self.samples as f64),
            ("/modes", 1.0, limits::MODES as f64, self.modes as f64),
            ("/diversity", 0.0, 2.0, self.diversity),
            ("/steps", 0.0, 100.0, self.steps as f64),
            ("/draft_delay_ms", 0.0, 1000.0, self.draft_delay_ms as f64),
            ("/draft_interval_ms", 0.0, 1000.0, self.draft_interval_ms as f64),
        ];
        let outside = numbers.into_iter().filter(|(_, min, max, got)| !(got >= min && got <= max));
        let mut faults: Vec<_> =
            outside.map(|(pointer, min, max, got)| FieldProblem::range(pointer, min, max, got)).collect();
        if let Some(got) = self.replan_interval_s.filter(|s| !REPLAN_S.contains(s)) {
            let detail = format!("{got} s; null, 3, 6 or 9 expected");
            faults.push(FieldProblem::new("/replan_interval_s", "invalid-field", detail));
        }
        faults.extend(score::beyond(&self.thresholds));
        refuse(faults)
    }

    /// The scene with this call's road users and conditions.
    fn apply(&self, mut scene: Scene) -> Result<Scene, Problem> {
        let last_s = (scene.time.steps - 1) as f64 * STEP_S;
        if !(self.start_s >= 0.0 && self.start_s <= last_s + 1e-6) {
            return refuse(vec![FieldProblem::range("/start_s", 0.0, last_s, self.start_s)]).map(|()| scene);
        }
        let mut faults = Vec::new();
        for (i, id) in self.remove_agents.iter().enumerate() {
            let before = scene.agents.len();
            scene.agents.retain(|agent| agent.id != *id);
            if scene.agents.len() == before {
                faults.push(unknown(format!("/remove_agents/{i}"), id));
            }
        }
        for (i, doc) in self.add_agents.iter().enumerate() {
            match doc.clone().into_agent(&format!("/add_agents/{i}")) {
                Ok(agent) => scene.agents.push(agent),
                Err(more) => faults.extend(more),
            }
        }
        if self.kept_futures == KeptFutures::Forgotten {
            scene.generated = None;
        }
        let start_step = self.start_step();
        let window = Window { start_s: start_step as f64 * STEP_S, horizon_s: self.horizon_s };
        for (id, doc) in &self.conditions.0 {
            let pointer = format!("/conditions/{}", pointer_token(id));
            let Some(agent) = scene.agents.iter_mut().find(|agent| agent.id == *id) else {
                faults.push(unknown(pointer, id));
                continue;
            };
            let context = Context { agent_type: agent.agent_type, start: agent.state_at(start_step), window };
            match doc.resolve(&pointer, &context) {
                Ok(conditions) => {
                    for k in conditions.unknown_edges(&scene.map) {
                        let at = format!("{pointer}/goal/may_cross/{k}");
                        let detail = "the id of a road edge of the map expected";
                        faults.push(FieldProblem::new(at, "invalid-field", detail));
                    }
                    agent.conditions = conditions;
                }
                Err(more) => faults.extend(more),
            }
        }
        refuse(faults)?;
        if self.add_agents.is_empty() {
            return Ok(scene);
        }
        let check = scene.checked();
        check
            .map_err(|faults| ReadError::invalid(faults.into_iter().map(FieldProblem::from).collect()).into())
    }

    fn start_step(&self) -> usize {
        (self.start_s / STEP_S).round() as usize
    }

    /// The generator's request.
    fn request(
        &self,
        scene: &Arc<Scene>,
        most_agents: u64,
        most_points: u64,
    ) -> Result<experts::Request, Problem> {
        let pinned = self.pinned(scene)?;
        let agents = match &self.agents {
            Who::All(_) => None,
            Who::Ids(ids) => {
                let mut ids = self.known(scene, "/agents", ids)?;
                ids.extend(pinned.keys().cloned());
                Some(ids)
            }
        };
        let react = match &self.react {
            Reacting::Whether(false) => React::Nobody,
            Reacting::Whether(true) => React::Everyone,
            Reacting::Ids(ids) => React::Only(self.known(scene, "/react", ids)?),
        };
        if agents.as_ref().is_some_and(BTreeSet::is_empty) && react == React::Nobody {
            let detail = "\"all\" or at least one id expected, or somebody who reacts";
            return Err(Problem::field("/agents", Code::InvalidField, detail));
        }
        let named = agents.as_ref().map_or(0, BTreeSet::len);
        if named as u64 > most_agents {
            let detail = format!("{named} road users to regenerate; at most {most_agents}");
            return Err(Problem::field("/agents", Code::TooManyAgents, detail).limit(most_agents));
        }
        let horizon_steps = (self.horizon_s / STEP_S).round().max(1.0) as usize;
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
        let count = (generation::concerned(&request) as u64).min(most_agents);
        let points = answered * self.modes * count * horizon_steps as u64;
        if points > most_points {
            let detail = format!("the reply would have {points} points; at most {most_points}");
            return Err(Problem::field("/samples", Code::ReplyTooLarge, detail).limit(most_points));
        }
        Ok(request)
    }

    /// The futures that are kept as they are, from the start on.
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
                    "the scene keeps no future of this road user from the start on",
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
                faults.push(unknown(pointer, id));
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
        refuse(missing.map(|(i, id)| unknown(format!("{pointer}/{i}"), id)).collect())?;
        Ok(ids.iter().cloned().collect())
    }

    /// The options as sent, for `generated.request`.
    fn options(&self) -> serde_json::Value {
        let mut options = json!({
            "agents": self.agents, "react": self.react, "start_s": self.start_s, "horizon_s": self.horizon_s,
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

fn unknown(pointer: String, id: &str) -> FieldProblem {
    let shown: String = id.chars().take(64).collect();
    FieldProblem::new(
        pointer,
        formats::problem::code::UNKNOWN_AGENT,
        format!("the scene has no road user \"{shown}\""),
    )
}

fn refuse(faults: Vec<FieldProblem>) -> Result<(), Problem> {
    if faults.is_empty() { Ok(()) } else { Err(ReadError::invalid(faults).into()) }
}
