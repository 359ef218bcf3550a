//! Attacks that each took the server down once, run beside all kinds of clients with bounded memory. They are
//! maps of crossing lanes, unread pings, links between all lanes, held scenes with useless members, refused
//! connections that stay open, forms of many parts, full lines, and the longest allowed work.

use super::Tell;
use super::clients::{ClientTask, Common, Report, all_sorts};
use crate::http::{Reply, Request, connect_from};
use crate::program::{Server, program};
use crate::random::Random;
use crate::scenes::{generate, street};
use anyhow::{Context, ensure};
use serde_json::{Value, json};
use std::io::{BufReader, Read, Write};
use std::net::TcpStream;
use std::process::Command;
use std::time::{Duration, Instant};

/// Memory that the server may use (`--memory`).
const MEMORY: &str = "1g";
/// Address space of the server (`ulimit -v`), kB: its memory, and the space reserved for stacks.
const ADDRESS_SPACE_KB: u64 = 1_600_000;
/// Last number of the first attacker's address: each attacker is its own party.
const FIRST_ADDRESS: u8 = 10;

type Attack = fn(&Attacker<'_>, &mut Random) -> anyhow::Result<()>;

/// All attacks, each from its own address.
const ATTACKS: &[(&str, Attack)] = &[
    ("crossing", crossing),
    ("pings", pings),
    ("links", links),
    ("holds", holds),
    ("places", places),
    ("parts", parts),
    ("full line", full_line),
    ("long work", long_work),
];

/// An attacker with its address.
struct Attacker<'a> {
    name: &'static str,
    address: u8,
    common: &'a Common,
}

/// Runs all kinds of clients and all attacks for a given time.
///
/// # Errors
/// If a client gets a reply that it must not get, or the server ends.
pub fn attacks(time: Duration, seed: u64, tell: Tell<'_>) -> anyhow::Result<Report> {
    let folder = tempfile::tempdir()?;
    let mut command = Command::new("sh");
    command.args(["-c", &format!("ulimit -v {ADDRESS_SPACE_KB}; exec \"$0\" \"$@\"")]).arg(program());
    command.args(["serve", "--port", "0", "--memory", MEMORY, "--db"]).arg(folder.path().join("s.sqlite"));
    command.env("DRAGTRAFFIC_LOG", "error");
    let mut server = Server::launch(command)?;
    server.wait_ready()?;
    let mut tasks = all_sorts(seed);
    for (number, (name, attack)) in ATTACKS.iter().enumerate() {
        let mut random = Random::of_part(seed, 1_000 + number as u64);
        let address = FIRST_ADDRESS + number as u8;
        tasks.push(Box::new(move |common: &Common| {
            let attacker = Attacker { name, address, common };
            while !common.is_over() {
                attack(&attacker, &mut random).with_context(|| format!("attack by {name}"))?;
                attacker.pause(random.below(400));
            }
            Ok(())
        }) as ClientTask<'_>);
    }
    let done = Common::of(server.address).work(&server, time, tell, tasks);
    let state = if server.is_up() { "is up" } else { "has ended" };
    done.with_context(|| format!("the server {state}"))
}

impl Attacker<'_> {
    fn pause(&self, ms: u64) {
        let until = Instant::now() + Duration::from_millis(ms);
        while Instant::now() < until && !self.common.is_over() {
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    fn connect(&self) -> anyhow::Result<TcpStream> {
        let stream = connect_from(self.address, self.common.address())?;
        stream.set_read_timeout(Some(Duration::from_secs(120)))?;
        stream.set_write_timeout(Some(Duration::from_secs(1)))?;
        Ok(stream)
    }

    /// Sends a request; a refusal must have one of these codes. The server may close the connection after it.
    fn ask(&self, request: &Request, allowed: &[&str]) -> anyhow::Result<()> {
        let mut stream = self.connect()?;
        let _ = stream.write_all(&request.bytes(self.common.address()));
        let Ok(reply) = Reply::read(&mut BufReader::new(stream), false) else {
            self.common.note(self.name, 0, "closed");
            return Ok(());
        };
        let code = reply.code();
        self.common.note(self.name, reply.status, &code);
        let known = reply.status < 300 || code == "busy" || allowed.contains(&code.as_str());
        ensure!(known, "{} {}", reply.status, reply.text());
        Ok(())
    }

    /// Opens a line (a WebSocket).
    fn line(&self) -> anyhow::Result<Option<TcpStream>> {
        let mut stream = self.connect()?;
        let request = Request::new("GET", "/v1/generate").keep().header("connection", "Upgrade");
        let request = request.header("upgrade", "websocket").header("sec-websocket-version", "13");
        let request = request.header("sec-websocket-key", "dGhlIHNhbXBsZSBub25jZQ==");
        stream.write_all(&request.bytes(self.common.address()))?;
        let mut status = [0; 12];
        let is_open = stream.read_exact(&mut status).is_ok() && &status == b"HTTP/1.1 101";
        self.common.note(self.name, if is_open { 101 } else { 0 }, "line");
        Ok(is_open.then_some(stream))
    }
}

/// A frame of a client, with a mask of zeros.
fn frame(kind: u8, content: &[u8]) -> Vec<u8> {
    let mut frame = vec![0x80 | kind];
    match content.len() {
        length @ 0..126 => frame.push(0x80 | length as u8),
        length => {
            frame.push(0x80 | 126);
            frame.extend((length as u16).to_be_bytes());
        }
    }
    frame.extend([0; 4]);
    frame.extend(content);
    frame
}

const TEXT: u8 = 1;
const CLOSE: u8 = 8;
const PING: u8 = 9;

/// Lanes with points anywhere on a square, new each time.
fn crossing(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let (lanes, side_m) = (2 + random.below(4), 40.0 + random.below(40) as f64);
    let mut at = || side_m * (random.below(10_000) as f64 / 10_000.0 - 0.5);
    let lane = |i: u64| {
        let points: Vec<[f64; 2]> = (0..4_000).map(|_| [at(), at()]).collect();
        json!({"id": format!("t{i}"), "type": "surface_street", "points_m": points})
    };
    let mut body = generate(2);
    let tangle: Vec<Value> = (0..lanes).map(lane).collect();
    body["scene"]["map"]["lanes"].as_array_mut().context("lanes")?.extend(tangle);
    attacker.ask(&Request::new("POST", "/v1/generate").json(&body), &["map-too-complex", "generate-timeout"])
}

/// Sends pings as fast as possible, and reads nothing.
fn pings(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let Some(mut line) = attacker.line()? else { return Ok(()) };
    let (ping, began) = (frame(PING, &[b'x'; 125]).repeat(64), Instant::now());
    let a_while = Duration::from_millis(500 + random.below(2_000));
    while began.elapsed() < a_while && line.write_all(&ping).is_ok() {}
    Ok(())
}

/// A file with a map whose lanes have as many links as are allowed, or more.
fn links(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let (lanes, links) = (300 + random.below(1_700), 20 + random.below(60));
    let lane = |i: u64| {
        let next: Vec<String> = (1..=links).map(|k| format!("k{}", (i + k) % lanes)).collect();
        let y = i as f64 * 4.0;
        json!({"id": format!("k{i}"), "type": "surface_street", "points_m": [[0.0, y], [1.0, y]], "successors": next})
    };
    let mut scene = street(1, 20);
    scene["map"]["lanes"] = json!((0..lanes).map(lane).collect::<Vec<_>>());
    let format = ["opendrive", "sumo", "commonroad", "openscenario"][random.index(4)];
    let export = Request::new("POST", &format!("/v1/export?format={format}")).json(&scene);
    attacker.ask(&export, &["map-too-complex", "reply-too-large", "generate-timeout"])
}

/// Held scenes, each with members that no reply depends on.
fn holds(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let mut body = generate(2);
    (body["hold"], body["steps"], body["seed"]) = (json!(true), json!(1), json!(random.below(1 << 30)));
    body["scene"]["x_big"] = json!(vec!["some letters of no use"; 40_000]);
    attacker.ask(&Request::new("POST", "/v1/generate").json(&body), &[])
}

/// Refused connections that stay open.
fn places(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let ask = json!({"scene_id": "demo-crossing", "agents": ["5"], "score": false, "futures": "compact"});
    let request = Request::new("POST", "/v1/generate").keep().json(&ask);
    let request = request.bytes(attacker.common.address()).repeat(20);
    let open = |_| {
        let mut stream = attacker.connect().ok()?;
        let _ = stream.write_all(&request);
        Some(stream)
    };
    let held: Vec<TcpStream> = (0..100 + random.below(200)).filter_map(open).collect();
    attacker.common.note(attacker.name, 0, "connections");
    attacker.pause(500);
    drop(held);
    Ok(())
}

/// A form with many empty parts before its file.
fn parts(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let name = if random.below(2) == 0 { "" } else { "file" };
    let part = format!("--b\r\ncontent-disposition: form-data; name=\"{name}\"; filename=\"f\"\r\n\r\n\r\n");
    let form = Request::new("POST", "/v1/import?dry_run=true");
    let form = form.header("content-type", "multipart/form-data; boundary=b");
    attacker.ask(&form.body(format!("{}--b--\r\n", part.repeat(50_000))), &["invalid-field"])
}

/// A line with more questions than may be open, abandoned or closed before any reply is read.
fn full_line(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let Some(mut line) = attacker.line()? else { return Ok(()) };
    let mut body = generate(12);
    (body["agents"], body["samples"], body["stream_modes"]) = (json!("all"), json!(8), json!("all"));
    let ask = |number: u64| frame(TEXT, json!({"ask": number, "body": body}).to_string().as_bytes());
    let asked: Vec<u8> = (1..=12).flat_map(ask).collect();
    let _ = line.write_all(&asked);
    attacker.pause(random.below(300));
    let end: Vec<u8> = if random.below(2) == 0 {
        (1..=12).flat_map(|number| frame(TEXT, format!("{{\"end\": {number}}}").as_bytes())).collect()
    } else {
        frame(CLOSE, &1000_u16.to_be_bytes())
    };
    let _ = line.write_all(&end);
    attacker.pause(random.below(300));
    Ok(())
}

/// Many generations of all of many road users.
fn long_work(attacker: &Attacker<'_>, random: &mut Random) -> anyhow::Result<()> {
    let mut body = generate(16 + random.below(40) as usize);
    (body["agents"], body["samples"], body["score"]) =
        (json!("all"), json!(1 + random.below(16)), json!(false));
    attacker.ask(
        &Request::new("POST", "/v1/generate").json(&body),
        &["too-much-work", "generate-timeout", "reply-too-large", "invalid-field"],
    )
}
