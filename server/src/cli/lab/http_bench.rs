//! `dragtraffic lab bench --http`: calls over a real socket, and the same requests answered in this process.

use super::failed;
use super::served::{Connection, JSON, NDJSON, Served};
use crate::cli::{Common, Failure};
use api::generate::{GenerationEvent, GenerationPlan};
use api::limits::CallLimits;
use api::{GenerateRequest, Standings};
use base::clock;
use experts::{Cancel, Generator};
use formats::native::{MapForm, SceneDoc, write_doc};
use lab_eval::cost::Percentiles;
use scene::{AgentType, Scene};
use serde::Serialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Instant;

/// Calls of each kind on each scene; two warm-up calls are not counted.
const CALLS: usize = 30;

/// Latency of one kind of call on one scene, milliseconds.
#[derive(Debug, Serialize)]
pub struct HttpLatency {
    scene: String,
    road_users: usize,
    map_points: usize,
    what: &'static str,
    /// From the first byte sent to the last byte read.
    http: Percentiles,
    /// The same request in this process, from its start to the answer with its requested scores.
    engine: Percentiles,
    /// Time to the first futures, for streamed calls.
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<Percentiles>,
    /// Time to the first futures in this process, for the same calls.
    #[serde(skip_serializing_if = "Option::is_none")]
    engine_first: Option<Percentiles>,
    /// Bytes of the last reply.
    bytes: usize,
}

/// Saves each scene on a separate server, requests one road user's futures there repeatedly, and then in this
/// process. The call at the end of a drag lets the others react and is scored.
pub fn latency(scenes: &[Scene], common: &Common) -> Result<Vec<HttpLatency>, Failure> {
    let server = Served::start(common)?;
    let generator = common.generator()?;
    generator.warm_up();
    let mut kept = Connection::open(server.port)?;
    let mut rows = Vec::new();
    for scene in scenes {
        let Some(asked) = longest_way(scene) else { continue };
        let doc = write_doc(&SceneDoc::from_scene(scene, MapForm::Inline));
        let saved: Value =
            serde_json::from_slice(&kept.post("/v1/scenes", "*/*", &doc)?.body).map_err(failed)?;
        let open = Arc::new(scene.clone());
        let standings = Arc::new(Standings::new(Arc::clone(&open)));
        let lean = json!({"scene_id": saved["id"], "agents": [asked], "futures": "compact"});
        let with = |more: &[(&str, Value)]| {
            let mut body = lean.clone();
            more.iter().for_each(|(name, value)| body[*name] = value.clone());
            body.to_string().into_bytes()
        };
        let (off, all) = (("score", json!(false)), ("stream_modes", json!("all")));
        let kinds = [
            ("one road user, not scored", JSON, with(std::slice::from_ref(&off))),
            ("one road user, scored", JSON, with(&[])),
            ("others react, scored", JSON, with(&[("react", json!(true))])),
            ("drag, streamed", NDJSON, with(&[off, all.clone()])),
            ("release, streamed", NDJSON, with(&[("react", json!(true)), all])),
        ];
        for (what, accept, body) in kinds {
            let request: GenerateRequest = serde_json::from_slice(&body).map_err(failed)?;
            let plan = request.plan(&open, &CallLimits::default(), &generator);
            let mut plan = plan.map_err(refused)?;
            plan.standings = Some(Arc::clone(&standings));
            let engine = Alone { generator: &generator, plan };
            rows.push(timed(&mut kept, server.port, scene, what, (accept, &body), &engine)?);
        }
    }
    Ok(rows)
}

fn refused(problem: api::Problem) -> Failure {
    failed(std::io::Error::other(format!("the request is refused: {}", problem.detail)))
}

/// A request answered in this process, without socket, queue or serialization.
struct Alone<'a> {
    generator: &'a Generator,
    plan: GenerationPlan,
}

impl Alone<'_> {
    /// Milliseconds to the first futures and to the answer.
    fn call(&self) -> Result<(f64, f64), Failure> {
        let began = Instant::now();
        let ms = || began.elapsed().as_secs_f64() * 1e3;
        let (mut first, mut whole) = (f64::NAN, f64::NAN);
        let call = self.plan.clone().start(self.generator, Cancel::default(), clock::monotonic);
        for event in call.map_err(refused)? {
            match event.map_err(refused)? {
                GenerationEvent::Draft(draft) if draft.is_first() => {
                    std::hint::black_box(draft);
                    first = ms();
                }
                GenerationEvent::Accepted(_) | GenerationEvent::Draft(_) => {}
                GenerationEvent::Final(answered) => {
                    std::hint::black_box(answered.body());
                    whole = ms();
                }
            }
        }
        Ok((first, whole))
    }
}

/// Alternates calls over the socket and in this process, so that other load on the machine affects both.
fn timed(
    kept: &mut Connection,
    port: u16,
    scene: &Scene,
    what: &'static str,
    (accept, body): (&str, &[u8]),
    alone: &Alone<'_>,
) -> Result<HttpLatency, Failure> {
    let (mut http, mut engine, mut bytes) = (Vec::new(), Vec::new(), 0);
    let (mut first, mut engine_first) = (Vec::new(), Vec::new());
    for call in 0..CALLS + 2 {
        let reply = kept.post("/v1/generate", accept, body)?;
        if reply.closes {
            *kept = Connection::open(port)?;
        }
        let (own_first, own) = alone.call()?;
        if call >= 2 {
            http.push(reply.ms);
            engine.push(own);
            first.extend(reply.first_ms);
            engine_first.extend(reply.first_ms.map(|_| own_first));
            bytes = reply.body.len();
        }
    }
    let some = |values: Vec<f64>| (!values.is_empty()).then(|| Percentiles::of(values));
    Ok(HttpLatency {
        scene: scene.name.clone(),
        road_users: scene.agents.len(),
        map_points: crate::scenes::record::size(&scene.map).1,
        what,
        http: Percentiles::of(http),
        engine: Percentiles::of(engine),
        first: some(first),
        engine_first: some(engine_first),
        bytes,
    })
}

/// The vehicle with the longest path among those present at the first step.
pub(super) fn longest_way(scene: &Scene) -> Option<&str> {
    let vehicles =
        scene.agents.iter().filter(|a| a.agent_type == AgentType::Vehicle && a.state_at(0).is_some());
    vehicles.max_by(|a, b| a.track.extent_m().total_cmp(&b.track.extent_m())).map(|a| a.id.as_str())
}
