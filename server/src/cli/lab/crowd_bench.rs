//! `dragtraffic lab bench --crowd`: many concurrent clients, and one drag beside the heaviest possible calls.

use super::failed;
use super::http_bench::longest_way;
use super::served::{Connection, JSON, Served};
use crate::cli::{Common, Failure};
use formats::native::{MapForm, SceneDoc, write_doc};
use lab_eval::cost::Percentiles;
use scene::Scene;
use serde::Serialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Number of clients with the heaviest calls.
const HEAVY: usize = 4;
/// Number of drags, with and without the heavy calls.
const DRAGS: usize = 200;
/// Interval of memory measurements.
const MINUTE: Duration = Duration::from_secs(60);

/// Results of one crowd.
#[derive(Debug, Serialize)]
pub struct Crowd {
    clients: usize,
    /// Whether clients wait after a refusal for as long as it asks.
    obedient: bool,
    seconds: f64,
    answered_per_s: f64,
    refused_per_s: f64,
    /// Latency of answered calls, milliseconds.
    answer: Percentiles,
    /// Memory of the server at each full minute and at the end, MB.
    memory_mb: Vec<f64>,
}

/// Latency of a dragging client, milliseconds.
#[derive(Debug, Serialize)]
pub struct DragLatency {
    alone: Percentiles,
    beside_heavy: Percentiles,
}

/// All results of one server.
#[derive(Debug, Serialize)]
pub struct Strain {
    scene: String,
    road_users: usize,
    crowds: Vec<Crowd>,
    drag: DragLatency,
}

/// Crowds of these sizes request one road user's futures repeatedly for the given time each. They first retry
/// at once after a refusal, then after the pause that it asks for. Then one client drags, first alone, then
/// beside four calls for all road users in 32 samples of 100 steps.
pub fn strain(
    scene: &Scene,
    sizes: &[usize],
    seconds: f64,
    common: &Common,
) -> Result<Option<Strain>, Failure> {
    let Some(asked) = longest_way(scene) else { return Ok(None) };
    let server = Served::start(common)?;
    let doc = write_doc(&SceneDoc::from_scene(scene, MapForm::Inline));
    let saved = Connection::open(server.port)?.post("/v1/scenes", JSON, &doc)?;
    let saved: Value = serde_json::from_slice(&saved.body).map_err(failed)?;
    let drag = json!({"scene_id": saved["id"], "agents": [asked], "score": false, "futures": "compact"});
    let drag = drag.to_string().into_bytes();
    let time = Duration::from_secs_f64(seconds);
    let crowds: Result<_, Failure> = sizes
        .iter()
        .flat_map(|size| [false, true].map(|obedient| (*size, obedient)))
        .map(|(size, obedient)| crowd(&server, &drag, size, obedient, time))
        .collect();
    let count = scene.counts()[..3].iter().sum::<usize>().min(128);
    // As many samples as one reply may hold.
    let samples = (500_000 / (90 * count.max(1))).clamp(1, 32);
    let heavy = json!({
        "scene_id": saved["id"], "agents": "all", "samples": samples, "modes": 1, "steps": 100, "score": false,
    });
    let drag = beside(&server, &drag, heavy.to_string().as_bytes())?;
    let (scene, road_users) = (scene.name.clone(), scene.agents.len());
    Ok(Some(Strain { scene, road_users, crowds: crowds?, drag }))
}

/// Times of one client's answers in milliseconds and its number of refusals, until the crowd ends.
fn caller(port: u16, body: &[u8], obedient: bool, over: &AtomicBool) -> Result<(Vec<f64>, usize), Failure> {
    let (mut answers, mut refused) = (Vec::new(), 0);
    let mut kept = Connection::open(port)?;
    while !over.load(Ordering::Relaxed) {
        let reply = kept.send("POST", "/v1/generate", JSON, body)?;
        match reply.status {
            200 => answers.push(reply.ms),
            _ => {
                refused += 1;
                if obedient {
                    let problem: Value = serde_json::from_slice(&reply.body).unwrap_or_default();
                    let wait = problem["retry_after_ms"].as_u64().unwrap_or(0);
                    std::thread::sleep(Duration::from_millis(wait));
                }
            }
        }
        if reply.closes {
            kept = Connection::open(port)?;
        }
    }
    Ok((answers, refused))
}

fn crowd(
    server: &Served,
    body: &[u8],
    clients: usize,
    obedient: bool,
    time: Duration,
) -> Result<Crowd, Failure> {
    let (over, began) = (AtomicBool::new(false), Instant::now());
    let mut memory_mb = Vec::new();
    let (answers, refused) = std::thread::scope(|scope| {
        let callers: Vec<_> =
            (0..clients).map(|_| scope.spawn(|| caller(server.port, body, obedient, &over))).collect();
        while began.elapsed() < time {
            std::thread::sleep(MINUTE.min(time.saturating_sub(began.elapsed())));
            memory_mb.extend(server.memory_mb());
        }
        over.store(true, Ordering::Relaxed);
        let (mut answers, mut refused) = (Vec::new(), 0);
        for caller in callers {
            // A client whose thread failed has reported why already.
            let (of_one, no) = caller.join().unwrap_or_else(|_| Ok((Vec::new(), 0)))?;
            answers.extend(of_one);
            refused += no;
        }
        Ok::<_, Failure>((answers, refused))
    })?;
    let seconds = began.elapsed().as_secs_f64();
    Ok(Crowd {
        clients,
        obedient,
        seconds,
        answered_per_s: answers.len() as f64 / seconds,
        refused_per_s: refused as f64 / seconds,
        answer: Percentiles::of(answers),
        memory_mb,
    })
}

fn drags(server: &Served, body: &[u8]) -> Result<Percentiles, Failure> {
    let mut kept = Connection::open(server.port)?;
    let mut times = Vec::with_capacity(DRAGS);
    for _ in 0..DRAGS {
        let reply = kept.post("/v1/generate", JSON, body)?;
        times.push(reply.ms);
        if reply.closes {
            kept = Connection::open(server.port)?;
        }
    }
    Ok(Percentiles::of(times))
}

fn beside(server: &Served, drag: &[u8], heavy: &[u8]) -> Result<DragLatency, Failure> {
    let alone = drags(server, drag)?;
    let over = Arc::new(AtomicBool::new(false));
    for _ in 0..HEAVY {
        let (port, heavy, over) = (server.port, heavy.to_vec(), Arc::clone(&over));
        // These threads end with the server, in the middle of their calls.
        std::thread::spawn(move || {
            while !over.load(Ordering::Relaxed) {
                let asked =
                    Connection::open(port).and_then(|mut own| own.send("POST", "/v1/generate", JSON, &heavy));
                // A client that is refused or times out asks again.
                if asked.map_or(true, |reply| reply.status != 200) {
                    std::thread::sleep(Duration::from_millis(200));
                }
            }
        });
    }
    std::thread::sleep(Duration::from_secs(2));
    let beside_heavy = drags(server, drag)?;
    over.store(true, Ordering::Relaxed);
    Ok(DragLatency { alone, beside_heavy })
}
