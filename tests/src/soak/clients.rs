//! Clients of all kinds in parallel, for a given time. Every reply must follow the document and be one that
//! this client may get, and memory must not grow.

use super::{Tell, fit};
use crate::http::{Reply, Request};
use crate::program::Server;
use crate::random::Random;
use crate::scenes::{generate, street};
use crate::writers::{self, Writer};
use anyhow::{Context, bail, ensure};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt;
use std::io::Write;
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two readings of the memory.
const EVERY: Duration = Duration::from_secs(5);
/// In the second half, memory may rise by this share...
const RISE_SHARE: f64 = 0.05;
/// ...and by this many bytes, for pages that the allocator retains.
const RISE_BYTES: f64 = 8e6;
/// Ratio of successive latency bounds.
const STEP: f64 = 1.2;

/// Counts of the clients.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Duration, seconds.
    pub seconds: f64,
    /// Replies by client, status and code.
    pub replies: BTreeMap<(&'static str, u16, String), u64>,
    /// Successful replies by client and time: the k-th count is of those up to 0.1 ms x `STEP`^k.
    times: BTreeMap<&'static str, Vec<u64>>,
    /// Memory of the server, one reading every five seconds, bytes.
    pub memory: Vec<f64>,
}

/// State that the clients share.
pub(super) struct Common {
    address: SocketAddr,
    over: AtomicBool,
    revisions: AtomicU64,
    report: Mutex<Report>,
}

type Client = (&'static str, fn(&Common, &mut Random) -> anyhow::Result<()>);

/// All clients, each with its own thread.
const CLIENTS: &[Client] = &[
    ("drag", drag),
    ("drag", drag),
    ("drag", drag),
    ("leave", leave),
    ("react", react),
    ("place", place),
    ("score", score),
    ("import", import),
    ("export", export),
    ("slow", slow),
    ("broken", broken),
    ("half", half),
];

/// Runs all clients for a given time.
///
/// # Errors
/// If a client gets a reply that it must not get, or the server ends.
pub fn clients(time: Duration, seed: u64, tell: Tell<'_>) -> anyhow::Result<Report> {
    let server = Server::with_demos()?;
    server.wait_ready()?;
    let mut crowd = Writer::crowd(2, seed);
    let mut tasks = all_sorts(seed);
    let writing = &mut crowd;
    tasks.push(Box::new(move |common: &Common| common.write(writing)));
    let mut report = Common::of(server.address).work(&server, time, tell, tasks)?;
    writers::compare(&mut crowd, &server)?;
    let written = writers::tally(&crowd);
    report.replies.insert(("write", 200, String::new()), written.kept);
    Ok(report)
}

/// The work of all clients that only read.
pub(super) fn all_sorts<'a>(seed: u64) -> Vec<ClientTask<'a>> {
    let task = |(number, (name, client)): (usize, &'static Client)| -> ClientTask<'a> {
        let random = Random::of_part(seed, number as u64);
        Box::new(move |common: &Common| common.lead(name, *client, random))
    };
    CLIENTS.iter().enumerate().map(task).collect()
}

/// Work of one client until the trial is over.
pub(super) type ClientTask<'a> = Box<dyn FnOnce(&Common) -> anyhow::Result<()> + Send + 'a>;

impl Common {
    /// The common state of clients of one server.
    pub(super) fn of(address: SocketAddr) -> Self {
        Self { address, over: AtomicBool::new(false), revisions: AtomicU64::new(0), report: Mutex::default() }
    }

    /// Whether the trial is over.
    pub(super) fn is_over(&self) -> bool {
        self.over.load(Ordering::Relaxed)
    }

    /// Runs clients for a given time, each in its own thread, and reads the memory of the server. The first
    /// failure stops all of them.
    pub(super) fn work(
        self,
        server: &Server,
        time: Duration,
        tell: Tell<'_>,
        tasks: Vec<ClientTask<'_>>,
    ) -> anyhow::Result<Report> {
        let began = Instant::now();
        let mut memory = Vec::new();
        std::thread::scope(|scope| -> anyhow::Result<()> {
            let common = &self;
            let task = |task: ClientTask<'_>| {
                let done = task(common);
                if done.is_err() {
                    common.over.store(true, Ordering::Relaxed);
                }
                done
            };
            let threads: Vec<_> = tasks.into_iter().map(|own| scope.spawn(move || task(own))).collect();
            while began.elapsed() < time && !common.is_over() {
                std::thread::sleep(EVERY.min(time.saturating_sub(began.elapsed())));
                memory.push(server.memory()? as f64);
                if memory.len() % 12 == 0 {
                    tell(&common.line(memory.len() / 12, memory.last().copied().unwrap_or_default()));
                }
            }
            common.over.store(true, Ordering::Relaxed);
            for thread in threads {
                thread.join().map_err(|_| anyhow::anyhow!("a reply breaks the contract"))??;
            }
            Ok(())
        })?;
        let mut report = self.report.into_inner().unwrap_or_else(PoisonError::into_inner);
        report.seconds = began.elapsed().as_secs_f64();
        report.memory = memory;
        Ok(report)
    }

    /// Runs one client until all stop.
    fn lead(
        &self,
        name: &'static str,
        client: fn(&Self, &mut Random) -> anyhow::Result<()>,
        mut random: Random,
    ) -> anyhow::Result<()> {
        while !self.over.load(Ordering::Relaxed) {
            client(self, &mut random).with_context(|| format!("client {name}"))?;
            std::thread::sleep(Duration::from_millis(random.below(60)));
        }
        Ok(())
    }

    fn write(&self, crowd: &mut [Writer]) -> anyhow::Result<()> {
        let done = writers::work(crowd, self.address, &self.over, is_busy);
        self.over.store(true, Ordering::Relaxed);
        ensure!(writers::tally(crowd).lost == 0, "a writer got no answer");
        done
    }

    /// Address of the server.
    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }

    /// Counts the result of a request that another client has sent.
    pub(super) fn note(&self, name: &'static str, status: u16, code: &str) {
        let mut report = self.report.lock().unwrap_or_else(PoisonError::into_inner);
        *report.replies.entry((name, status, code.to_owned())).or_default() += 1;
    }

    /// Sends a request and counts its result; returns the reply if it succeeded.
    pub(super) fn ask(
        &self,
        name: &'static str,
        request: &Request,
        allowed: &[&str],
    ) -> anyhow::Result<Option<Reply>> {
        let began = Instant::now();
        let sent = request.send(self.address);
        let reply = sent.with_context(|| format!("no reply after {:.1} s", began.elapsed().as_secs_f64()))?;
        let (status, code) = (reply.status, reply.code());
        let is_success = (200..300).contains(&status);
        let mut report = self.report.lock().unwrap_or_else(PoisonError::into_inner);
        *report.replies.entry((name, status, code.clone())).or_default() += 1;
        if is_success {
            let at = (began.elapsed().as_secs_f64() / 1e-4).max(1.0).log(STEP).ceil() as usize;
            let counts = report.times.entry(name).or_default();
            counts.resize(counts.len().max(at + 1), 0);
            counts[at] += 1;
            return Ok(Some(reply));
        }
        drop(report);
        if is_busy(status, &code) {
            ensure!(!reply.header("retry-after").is_empty(), "busy, but until when is not said");
            let wait_ms = reply.json()["retry_after_ms"].as_u64().unwrap_or_default();
            std::thread::sleep(Duration::from_millis(wait_ms));
            return Ok(None);
        }
        ensure!(allowed.contains(&code.as_str()), "{status} {}", reply.text());
        Ok(None)
    }

    fn line(&self, minute: usize, memory: f64) -> String {
        let report = self.report.lock().unwrap_or_else(PoisonError::into_inner);
        let all: u64 = report.replies.values().sum();
        format!("minute {minute}: {all} replies, memory {:.1} MB", memory / 1e6)
    }
}

fn is_busy(status: u16, code: &str) -> bool {
    (status, code) == (503, "busy")
}

/// A client that drags: one revision after another, each abandoning the one before, some cancelled.
fn drag(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let client = format!("hand-{}", common.revisions.fetch_add(1, Ordering::Relaxed));
    let mut left: Option<TcpStream> = None;
    for revision in 1..=20 {
        let job = format!("{client}-{revision}");
        let mut body = generate(4 + 2 * random.below(4) as usize);
        body["conditions"]["0"]["goal"]["x_m"] = json!(20.0 + revision as f64);
        (body["client"], body["revision"], body["job"]) = (json!(client), json!(revision), json!(job));
        let request =
            Request::new("POST", "/v1/generate").header("accept", "application/x-ndjson").json(&body);
        match random.below(5) {
            // The next revision is sent before this one has its reply.
            0 => left = Some(request.open(common.address)?),
            1 => {
                left = Some(request.open(common.address)?);
                let cancel = Request::new("DELETE", &format!("/v1/jobs/{job}"));
                common.ask("cancel", &cancel, &[])?;
            }
            _ => {
                // An older revision that is read late finds this one before it.
                common.ask("drag", &request, &["superseded", "stale-revision"])?;
            }
        }
        if common.over.load(Ordering::Relaxed) {
            break;
        }
        std::thread::sleep(Duration::from_millis(random.below(30)));
    }
    drop(left);
    Ok(())
}

/// A client that requests a long generation and disconnects.
fn leave(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let mut body = generate(10);
    (body["agents"], body["steps"]) = (json!("all"), json!(30));
    let stream = Request::new("POST", "/v1/generate").json(&body).open(common.address)?;
    std::thread::sleep(Duration::from_millis(random.below(80)));
    if random.below(2) == 0 {
        // The server may have closed its end in order already.
        let _ = stream.shutdown(Shutdown::Both);
    }
    Ok(())
}

fn react(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let mut body = json!({
        "scene_id": "demo-crossing", "agents": ["5"], "react": true, "seed": random.below(1_000),
        "conditions": {"5": {"goal": {"x_m": 14.0, "y_m": 0.4, "speed_mps": 6.0}}},
    });
    if random.below(3) == 0 {
        body["samples"] = json!(4);
    }
    common.ask("react", &Request::new("POST", "/v1/generate").json(&body), &[]).map(drop)
}

fn place(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let body = json!({"scene": street(2, 20), "density": {"count": 1 + random.below(12)}, "seed": random.any() >> 12});
    common.ask("place", &Request::new("POST", "/v1/place").json(&body), &[]).map(drop)
}

fn score(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let body = match random.below(2) {
        0 => json!({"scene_id": "demo-crossing"}),
        _ => json!({"scene": street(1 + random.below(12) as usize, 60)}),
    };
    common.ask("score", &Request::new("POST", "/v1/score").json(&body), &[]).map(drop)
}

/// A file is imported, read and deleted.
fn import(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let file = street(1 + random.below(10) as usize, 30).to_string();
    let request = Request::new("POST", "/v1/import?format=dragtraffic")
        .header("content-type", "application/octet-stream")
        .body(file);
    let Some(reply) = common.ask("import", &request, &[])? else { return Ok(()) };
    let made: Value = reply.json()["scenes"][0].clone();
    let (Some(id), Some(etag)) = (made["id"].as_str(), made["etag"].as_str()) else {
        bail!("{}", reply.text())
    };
    let path = format!("/v1/scenes/{id}");
    common.ask("read", &Request::new("GET", &path), &[])?;
    common.ask("list", &Request::new("GET", "/v1/scenes?limit=20"), &[])?;
    // Refusals are rare, so the scenes that they leave behind do not accumulate.
    common.ask("delete", &Request::new("DELETE", &path).header("if-match", etag), &[])?;
    Ok(())
}

fn export(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let format = ["womd", "dragtraffic", "csv"][random.below(3) as usize];
    let request = match random.below(2) {
        0 => Request::new("GET", &format!("/v1/scenes/demo-crossing/export?format={format}")),
        _ => Request::new("POST", &format!("/v1/export?format={format}")).json(&street(3, 91)),
    };
    common.ask("export", &request, &["cannot-represent"]).map(drop)
}

/// A body that is sent a byte at a time, and then stops.
fn slow(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let path = ["/v1/generate", "/v1/import", "/v1/scenes"][random.below(3) as usize];
    let request =
        Request::new("POST", path).header("content-type", "application/json").body("{").length("1000");
    let mut stream = request.open(common.address)?;
    for _ in 0..random.below(20) {
        // The server may end it at any time.
        if stream.write_all(b" ").is_err() || common.over.load(Ordering::Relaxed) {
            break;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(())
}

/// Requests that no correct client sends.
fn broken(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let post = |path: &str| Request::new("POST", path).header("content-type", "application/json");
    let (request, code) = match random.below(6) {
        0 => (post("/v1/generate").body("{\"scene\":"), "malformed-json"),
        1 => (post("/v1/score").body("[]"), "invalid-field"),
        2 => (post("/v1/place").json(&json!({"scene_id": "nobody"})), "not-found"),
        3 => (Request::new("PUT", "/v1/scenes/x").json(&street(1, 5)), "precondition-required"),
        4 => (Request::new("GET", "/v1/info").header("host", "elsewhere.example"), "host-not-allowed"),
        _ => (Request::new("DELETE", "/v1/scenes/none").header("if-match", "\"1\""), "not-found"),
    };
    common.ask("broken", &request, &[code]).map(drop)
}

/// Bytes that are no request, or half of one.
fn half(common: &Common, random: &mut Random) -> anyhow::Result<()> {
    let mut stream = TcpStream::connect(common.address)?;
    let bytes: Vec<u8> = match random.below(3) {
        0 => (0..200).map(|_| random.any() as u8).collect(),
        1 => b"GET /v1/info HTTP/1.1\r\nhost:".to_vec(),
        _ => b"POST /v1/generate HTTP/1.1\r\nhost: localhost\r\ncontent-length: 99999999999\r\n\r\n".to_vec(),
    };
    // The server may refuse before the whole request is written.
    let _ = stream.write_all(&bytes);
    std::thread::sleep(Duration::from_millis(random.below(200)));
    Ok(())
}

impl Report {
    /// Checks that memory stays flat in the second half of the run.
    ///
    /// # Errors
    /// When memory rises by more than the tolerance.
    pub fn flat(&self) -> anyhow::Result<()> {
        let half = &self.memory[self.memory.len() / 2..];
        let (rise, allowed) = (fit::rise(half), allowed_rise(half));
        ensure!(
            rise <= allowed,
            "memory rises by {:.1} MB in the second half, {:.1} MB allowed",
            rise / 1e6,
            allowed / 1e6
        );
        Ok(())
    }

    /// The time within which this share of a client's replies came, seconds.
    fn within(&self, name: &str, share: f64) -> f64 {
        let Some(counts) = self.times.get(name) else { return f64::NAN };
        let wanted = (counts.iter().sum::<u64>() as f64 * share).ceil() as u64;
        let mut seen = 0;
        let at = counts.iter().position(|count| {
            seen += count;
            seen >= wanted
        });
        1e-4 * STEP.powi(at.unwrap_or_default() as i32)
    }
}

fn allowed_rise(half: &[f64]) -> f64 {
    RISE_BYTES + RISE_SHARE * half.iter().sum::<f64>() / half.len().max(1) as f64
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_good = |key: &(&str, u16, String)| (200..300).contains(&key.1);
        let good: u64 = self.replies.iter().filter(|(key, _)| is_good(key)).map(|(_, count)| count).sum();
        writeln!(
            f,
            "{:.0} s, {good} answered with success, {:.1} a second",
            self.seconds,
            good as f64 / self.seconds
        )?;
        for ((name, status, code), count) in &self.replies {
            write!(f, "  {name:<8} {status} {code:<24} {count:>8}")?;
            if *status < 300 && self.times.contains_key(name) {
                let ms = |share| 1e3 * self.within(name, share);
                write!(f, "   p50 {:.1} ms, p95 {:.1} ms, p99 {:.1} ms", ms(0.5), ms(0.95), ms(0.99))?;
            }
            writeln!(f)?;
        }
        let minutes: Vec<String> =
            self.memory.chunks(12).filter_map(|m| m.last()).map(|m| format!("{:.0}", m / 1e6)).collect();
        writeln!(f, "  memory by minute, MB: {}", minutes.join(" "))?;
        let half = &self.memory[self.memory.len() / 2..];
        let (rise, allowed) = (fit::rise(half) / 1e6, allowed_rise(half) / 1e6);
        write!(f, "  rise in the second half {rise:.1} MB, {allowed:.1} MB allowed")
    }
}
