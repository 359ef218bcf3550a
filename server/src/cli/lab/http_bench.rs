//! `dragtraffic bench --http`: calls over a real socket, with the engine's own time beside them.

use super::failed;
use super::served::{Connection, JSON, NDJSON, Served};
use crate::cli::{Common, Failure};
use formats::native::{MapForm, SceneDoc, write_doc};
use lab_eval::cost::Percentiles;
use scene::{AgentType, Scene};
use serde::Serialize;
use serde_json::{Value, json};

/// Calls of each kind on each scene; two more come first and are not counted.
const CALLS: usize = 30;

/// What calls of one kind took on one scene, milliseconds.
#[derive(Debug, Serialize)]
pub struct HttpLatency {
    scene: String,
    road_users: usize,
    map_points: usize,
    what: &'static str,
    /// From the first byte sent to the last one read.
    http: Percentiles,
    /// What the engine did meanwhile, as the reply tells it.
    engine: Percentiles,
    /// To the first futures, of calls that stream.
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<Percentiles>,
    /// Of the last reply.
    bytes: usize,
}

/// Saves each scene on a server of its own and asks for one road user's futures there, again and again.
pub fn latency(scenes: &[Scene], common: &Common) -> Result<Vec<HttpLatency>, Failure> {
    let server = Served::start(common)?;
    let mut kept = Connection::open(server.port)?;
    let mut rows = Vec::new();
    for scene in scenes {
        let Some(asked) = longest_way(scene) else { continue };
        let doc = write_doc(&SceneDoc::from_scene(scene, MapForm::Inline));
        let saved: Value =
            serde_json::from_slice(&kept.post("/v1/scenes", "*/*", &doc)?.body).map_err(failed)?;
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
            rows.push(timed(&mut kept, server.port, scene, what, (accept, &body))?);
        }
    }
    Ok(rows)
}

fn timed(
    kept: &mut Connection,
    port: u16,
    scene: &Scene,
    what: &'static str,
    (accept, body): (&str, &[u8]),
) -> Result<HttpLatency, Failure> {
    let (mut http, mut engine, mut first, mut bytes) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for call in 0..CALLS + 2 {
        let reply = kept.post("/v1/generate", accept, body)?;
        if reply.closes {
            *kept = Connection::open(port)?;
        }
        let line = reply.body.trim_ascii_end().rsplit(|byte| *byte == b'\n').next().unwrap_or_default();
        let last: Value = serde_json::from_slice(line).map_err(failed)?;
        let ms = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let timing = &last["timing"];
        let steps: f64 = timing["step_ms"].as_array().into_iter().flatten().map(ms).sum();
        let own = ms(&timing["encode_ms"]) + ms(&timing["initial_ms"]) + steps + ms(&timing["choice_ms"]);
        if call >= 2 {
            http.push(reply.ms);
            engine.push(own);
            first.extend(reply.first_ms);
            bytes = reply.body.len();
        }
    }
    Ok(HttpLatency {
        scene: scene.name.clone(),
        road_users: scene.agents.len(),
        map_points: crate::scenes::record::size(&scene.map).1,
        what,
        http: Percentiles::of(http),
        engine: Percentiles::of(engine),
        first: (!first.is_empty()).then(|| Percentiles::of(first)),
        bytes,
    })
}

/// The vehicle that goes farthest, of those that are there at the first step.
pub(super) fn longest_way(scene: &Scene) -> Option<&str> {
    let vehicles =
        scene.agents.iter().filter(|a| a.agent_type == AgentType::Vehicle && a.state_at(0).is_some());
    vehicles.max_by(|a, b| a.track.extent_m().total_cmp(&b.track.extent_m())).map(|a| a.id.as_str())
}
