//! Goodput of clients that obey a refusal, compared with clients that retry at once.

use super::Tell;
use crate::http::{Reply, Request, connect_from};
use crate::program::Server;
use crate::scenes::{generate, street};
use anyhow::ensure;
use serde_json::json;
use std::fmt;
use std::io::{BufReader, Write};
use std::net::SocketAddr;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Least goodput of obedient clients, as a share of that of the others.
const LEAST: f64 = 0.9;
/// Rounds of a kind. Each has all manners in turn, so that other work on the machine favours none.
const ROUNDS: usize = 3;

/// Behaviour of a client after a refusal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Manner {
    /// Retries at once.
    Restless,
    /// Waits for `retry_after_ms`.
    Exact,
    /// Waits for the whole seconds of `Retry-After`.
    Seconds,
}

const MANNERS: [Manner; 3] = [Manner::Restless, Manner::Exact, Manner::Seconds];

/// Clients of one kind; each has its own address.
struct CrowdKind {
    name: &'static str,
    clients: u8,
    request: fn() -> Request,
}

const KINDS: [CrowdKind; 3] = [
    CrowdKind { name: "drags", clients: 60, request: drag },
    CrowdKind { name: "long calls", clients: 40, request: long },
    CrowdKind { name: "files", clients: 12, request: file },
];

fn drag() -> Request {
    let body = json!({"scene_id": "demo-crossing", "agents": ["5"], "score": false, "futures": "compact"});
    Request::new("POST", "/v1/generate").json(&body)
}

fn long() -> Request {
    let mut body = generate(12);
    (body["agents"], body["samples"], body["score"]) = (json!("all"), json!(4), json!(false));
    Request::new("POST", "/v1/generate").json(&body)
}

fn file() -> Request {
    Request::new("POST", "/v1/import?dry_run=true&format=dragtraffic")
        .header("content-type", "application/octet-stream")
        .body(street(40, 91).to_string())
}

/// Answers and refusals of one kind and manner.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    seconds: f64,
    answered: u64,
    refused: u64,
}

impl Tally {
    fn goodput(&self) -> f64 {
        self.answered as f64 / self.seconds.max(1e-9)
    }
}

/// Replies per second by kind, for each manner.
#[derive(Debug, Default)]
pub struct GoodputReport(Vec<(&'static str, [Tally; MANNERS.len()])>);

impl GoodputReport {
    /// Compares clients that wait exactly as told with those that do not wait.
    ///
    /// # Errors
    /// When they have less than nine tenths of the goodput.
    pub fn fair(&self) -> anyhow::Result<()> {
        for (name, [restless, exact, _]) in &self.0 {
            let part = exact.goodput() / restless.goodput();
            ensure!(part >= LEAST, "{name}: those who obey have {:.0} % of the goodput", 100.0 * part);
        }
        Ok(())
    }
}

impl fmt::Display for GoodputReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, tallies) in &self.0 {
            for (manner, tally) in MANNERS.iter().zip(tallies) {
                let refused = tally.refused as f64 / tally.seconds;
                let part = 100.0 * tally.goodput() / tallies[0].goodput();
                writeln!(
                    f,
                    "{name:<10} {:<8} {:>7.1} answered, {refused:>7.1} refused a second, {part:>4.0} %",
                    format!("{manner:?}"),
                    tally.goodput()
                )?;
            }
        }
        Ok(())
    }
}

/// Runs the clients of each kind for this time in each manner.
///
/// # Errors
/// When the server fails.
pub fn goodput(time: Duration, tell: Tell<'_>) -> anyhow::Result<GoodputReport> {
    let server = Server::with_demos()?;
    server.wait_ready()?;
    let each = time / (KINDS.len() * MANNERS.len() * ROUNDS) as u32;
    let mut report = GoodputReport::default();
    for kind in &KINDS {
        let mut tallies = [Tally::default(); MANNERS.len()];
        for _ in 0..ROUNDS {
            for (manner, tally) in MANNERS.iter().zip(&mut tallies) {
                let one = ask_for(server.address, kind, *manner, each);
                tally.seconds += one.seconds;
                tally.answered += one.answered;
                tally.refused += one.refused;
            }
        }
        tell(&format!("{}: {tallies:?}", kind.name));
        report.0.push((kind.name, tallies));
    }
    Ok(report)
}

fn ask_for(server: SocketAddr, kind: &CrowdKind, manner: Manner, time: Duration) -> Tally {
    let (over, began) = (AtomicBool::new(false), Instant::now());
    let (answered, refused) = (AtomicU64::new(0), AtomicU64::new(0));
    std::thread::scope(|scope| {
        for number in 0..kind.clients {
            let (over, answered, refused) = (&over, &answered, &refused);
            scope.spawn(move || {
                let request = (kind.request)().keep().bytes(server);
                while !over.load(Ordering::Relaxed) {
                    let _ = converse(server, (number + 2, &request), manner, (over, answered, refused));
                }
            });
        }
        std::thread::sleep(time);
        over.store(true, Ordering::Relaxed);
    });
    let seconds = began.elapsed().as_secs_f64();
    Tally { seconds, answered: answered.into_inner(), refused: refused.into_inner() }
}

/// Sends a request repeatedly on one connection until the server closes it.
fn converse(
    server: SocketAddr,
    (from, request): (u8, &[u8]),
    manner: Manner,
    (over, answered, refused): (&AtomicBool, &AtomicU64, &AtomicU64),
) -> anyhow::Result<()> {
    let mut stream = connect_from(from, server)?;
    let mut reader = BufReader::new(stream.try_clone()?);
    while !over.load(Ordering::Relaxed) {
        // A file may be refused before it is read.
        let _ = stream.write_all(request);
        let reply = Reply::read(&mut reader, false)?;
        if reply.status == 200 {
            answered.fetch_add(1, Ordering::Relaxed);
        } else {
            refused.fetch_add(1, Ordering::Relaxed);
            let wait_ms = match manner {
                Manner::Restless => 0,
                Manner::Exact => reply.json()["retry_after_ms"].as_u64().unwrap_or_default(),
                Manner::Seconds => 1_000 * reply.header("retry-after").parse().unwrap_or(0),
            };
            let until = Instant::now() + Duration::from_millis(wait_ms);
            while Instant::now() < until && !over.load(Ordering::Relaxed) {
                std::thread::sleep(
                    until.saturating_duration_since(Instant::now()).min(Duration::from_millis(50)),
                );
            }
        }
        if reply.header("connection") == "close" {
            break;
        }
    }
    Ok(())
}
