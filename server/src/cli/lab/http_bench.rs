//! `dragtraffic bench --http`: calls over a real socket, with the engine's own time beside them.

use super::failed;
use crate::cli::{Common, Failure};
use formats::native::{MapForm, SceneDoc, write_doc};
use lab_eval::cost::Percentiles;
use scene::{AgentType, Scene};
use serde::Serialize;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

/// Calls of each kind on each scene; two more come first and are not counted.
const CALLS: usize = 30;
/// Time to wait for a server to be ready, tries of a tenth of a second.
const TRIES: usize = 300;

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

const JSON: &str = "application/json";
const NDJSON: &str = "application/x-ndjson";

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
fn longest_way(scene: &Scene) -> Option<&str> {
    let vehicles =
        scene.agents.iter().filter(|a| a.agent_type == AgentType::Vehicle && a.state_at(0).is_some());
    vehicles.max_by(|a, b| a.track.extent_m().total_cmp(&b.track.extent_m())).map(|a| a.id.as_str())
}

/// This program as a server, with an empty store.
struct Served {
    child: Child,
    port: u16,
    folder: PathBuf,
}

impl Served {
    fn start(common: &Common) -> Result<Self, Failure> {
        let folder = std::env::temp_dir().join(format!("dragtraffic-bench-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let mut command = Command::new(std::env::current_exe()?);
        command.args(["serve", "--quiet", "--port", "0", "--db"]).arg(folder.join("scenes.sqlite"));
        if let Some(weights) = &common.weights {
            command.arg("--weights").arg(weights);
        }
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
        let mut served = Self { child, port: 0, folder };
        let mut line = String::new();
        BufReader::new(served.child.stdout.take().ok_or_else(|| failed(Silent))?).read_line(&mut line)?;
        let port = line.trim().trim_end_matches('/').rsplit(':').next().and_then(|port| port.parse().ok());
        served.port = port.ok_or_else(|| failed(Silent))?;
        for _ in 0..TRIES {
            let ready = Connection::open(served.port)?.send("GET", "/readyz", JSON, b"")?;
            if ready.status == 200 {
                return Ok(served);
            }
            std::thread::sleep(std::time::Duration::from_millis(100));
        }
        Err(failed(Silent))
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        // What is left of it is in the system's folder for such files.
        let _ = self.child.kill().and_then(|()| self.child.wait());
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

#[derive(Debug, thiserror::Error)]
#[error("the server that was to be measured did not start")]
struct Silent;

#[derive(Debug, thiserror::Error)]
#[error("{path} answered {status}: {text}")]
struct Unexpected {
    path: String,
    status: u16,
    text: String,
}

/// One reply.
struct Timed {
    status: u16,
    body: Vec<u8>,
    ms: f64,
    /// To the first line with futures.
    first_ms: Option<f64>,
    /// The server ends the connection with it.
    closes: bool,
}

/// One connection to the server.
struct Connection(BufReader<TcpStream>);

impl Connection {
    fn open(port: u16) -> Result<Self, Failure> {
        let stream = TcpStream::connect(("127.0.0.1", port))?;
        stream.set_nodelay(true)?;
        Ok(Self(BufReader::new(stream)))
    }

    /// Posts JSON; anything but success is a failure.
    fn post(&mut self, path: &str, accept: &str, body: &[u8]) -> Result<Timed, Failure> {
        let reply = self.send("POST", path, accept, body)?;
        if reply.status < 300 {
            return Ok(reply);
        }
        let text = String::from_utf8_lossy(&reply.body).chars().take(300).collect();
        Err(failed(Unexpected { path: path.into(), status: reply.status, text }))
    }

    fn send(&mut self, method: &str, path: &str, accept: &str, body: &[u8]) -> Result<Timed, Failure> {
        let began = Instant::now();
        let port = self.0.get_ref().peer_addr()?.port();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nhost: 127.0.0.1:{port}\r\naccept: {accept}\r\n\
             content-type: application/json\r\ncontent-length: {}\r\n\r\n",
            body.len()
        );
        self.0.get_mut().write_all(&[head.as_bytes(), body].concat())?;
        let status = self.line()?.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
        let (mut length, mut chunked, mut closes) = (0, false, false);
        loop {
            let line = self.line()?.to_ascii_lowercase();
            match line.split_once(':').map(|(name, value)| (name, value.trim())) {
                Some(("content-length", value)) => length = value.parse().unwrap_or(0),
                Some(("transfer-encoding", _)) => chunked = true,
                Some(("connection", "close")) => closes = true,
                Some(_) => {}
                None => break,
            }
        }
        let (mut body, mut first_ms) = (Vec::new(), None);
        loop {
            if chunked {
                length = usize::from_str_radix(&self.line()?, 16).unwrap_or(0);
            }
            let from = body.len();
            body.resize(from + length, 0);
            self.0.read_exact(body.get_mut(from..).unwrap_or_default())?;
            if first_ms.is_none()
                && body.get(from..).is_some_and(|b| b.starts_with(b"{\"event\":\"initial\""))
            {
                first_ms = Some(began.elapsed().as_secs_f64() * 1e3);
            }
            if !chunked {
                break;
            }
            self.line()?;
            if length == 0 {
                break;
            }
        }
        Ok(Timed { status, body, ms: began.elapsed().as_secs_f64() * 1e3, first_ms, closes })
    }

    fn line(&mut self) -> Result<String, Failure> {
        let mut line = String::new();
        self.0.read_line(&mut line)?;
        Ok(line.trim_end().to_owned())
    }
}
