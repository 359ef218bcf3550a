//! `doubling`: core time of every operation on a map, for towns of doubling size. `cargo xtask doubling`
//! builds and runs it.
//!
//! Each operation must be nearly linear in the points of the map: over the last two doublings, its time rises by
//! a factor below [`MOST_RISE`] on average. Each request has its own map, since the server caches maps. Core time is measured, so that a busy machine does not change the result.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to people")]

use anyhow::{Context, ensure};
use dragtraffic_tests::random::Random;
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::process::ExitCode;

/// Raised time limits: a busy machine would exceed the usual ones.
const PATIENCE: [&str; 4] = ["--limit", "generate_s=900", "--limit", "stream_s=1800"];
/// Towns for most operations.
const TOWNS: Towns = Towns { lanes: [500, 1_000, 2_000, 4_000], piece_m: 5.0 };
/// Towns for files with bounds on lanes and kilometres.
const SMALL_TOWNS: Towns = Towns { lanes: [60, 120, 240, 480], piece_m: 1.0 };
/// Formats of such files.
const OF_BOUNDED_SIZE: [&str; 2] = ["opendrive", "openscenario"];
/// Towns for files whose lanes are read as many pieces, lines and borders.
const MIDDLE_TOWNS: Towns = Towns { lanes: [125, 250, 500, 1_000], piece_m: 5.0 };
/// Formats of such files.
const OF_MANY_PIECES: [&str; 2] = ["sumo", "commonroad"];
/// Greatest mean rise of the time with a doubling: linear is 2, and sorting adds a little.
const MOST_RISE: f64 = 2.6;
/// Shorter times are within the resolution of the clock, seconds.
const LEAST_S: f64 = 0.1;
/// Measurements of each operation; the shortest counts.
const REPEATS: u64 = 4;

/// Formats that are written and not read.
const WRITTEN: [&str; 2] = ["geojson", "mcap"];
/// Formats that are written, and read again if they can be.
const FORMATS: &[&str] = &[
    "dragtraffic",
    "womd",
    "opendrive",
    "openscenario",
    "sumo",
    "commonroad",
    "geojson",
    "gpudrive",
    "scenarionet",
    "mcap",
    "csv",
];

/// Towns, each twice as large as the one before.
#[derive(Clone, Copy)]
struct Towns {
    /// Lanes, each of 41 points.
    lanes: [usize; 4],
    /// Length of the straight pieces of a lane.
    piece_m: f64,
}

/// Streets of 40 pieces with a bend after each, in square blocks with a side of 20 pieces, four streets to a
/// block. Each seed gives other streets.
fn town(lanes: usize, piece_m: f64, seed: u64) -> Value {
    let mut random = Random::new(seed);
    let mut part = || random.below(1 << 20) as f64 / f64::from(1 << 20);
    let side = (lanes as f64 / 4.0).sqrt().ceil() as usize;
    let mut lane = |i: usize| {
        let (block, mut way) = (i / 4, part() * std::f64::consts::TAU);
        let centre = side as f64 / 2.0;
        let at = |row: usize| (row as f64 - centre) * 20.0 * piece_m;
        let (mut x, mut y) = (at(block % side), at(block / side));
        let mut points = vec![[x, y]];
        for _ in 0..40 {
            way += (part() - 0.5) * 0.6;
            (x, y) = (x + piece_m * way.cos(), y + piece_m * way.sin());
            points.push([x, y]);
        }
        json!({"id": format!("s{i}"), "type": "surface_street", "points_m": points})
    };
    let mut scene = street(2, 20);
    let streets: Vec<Value> = (0..lanes).map(&mut lane).collect();
    if let Some(all) = scene["map"]["lanes"].as_array_mut() {
        all.extend(streets);
    }
    scene
}

/// Makes the measured request from a scene; it may call the server first.
type RequestMaker = Box<dyn Fn(&Server, &Value) -> anyhow::Result<Request>>;

/// One operation on a scene.
struct Operation {
    name: String,
    towns: Towns,
    ask: RequestMaker,
}

impl Operation {
    fn of(name: &str, ask: impl Fn(&Value) -> Request + 'static) -> Self {
        Self { name: name.to_owned(), towns: TOWNS, ask: Box::new(move |_, scene| Ok(ask(scene))) }
    }
}

fn post(path: &str, body: &Value) -> Request {
    Request::new("POST", path).json(body)
}

fn answered(server: &Server, request: &Request) -> anyhow::Result<Reply> {
    let reply = server.send(request)?;
    ensure!(reply.status < 300, "{} {}", reply.status, reply.text());
    Ok(reply)
}

fn operations() -> Vec<Operation> {
    let mut all = vec![
        Operation::of("generate", |scene| post("/v1/generate", &json!({"scene": scene, "agents": ["0"]}))),
        Operation::of("place", |scene| post("/v1/place", &json!({"scene": scene, "density": {"count": 20}}))),
        Operation::of("score", |scene| post("/v1/score", &json!({"scene": scene}))),
        Operation::of("run", |scene| post("/v1/runs", &json!({"scene": scene, "egos": ["0"]}))),
        Operation::of("save", |scene| post("/v1/scenes", scene)),
        Operation {
            name: "preview".to_owned(),
            towns: TOWNS,
            ask: Box::new(|server, scene| {
                let made = answered(server, &post("/v1/scenes", scene))?.json();
                let id = made["id"].as_str().context("no id")?;
                Ok(Request::new("GET", &format!("/v1/scenes/{id}/preview")))
            }),
        },
    ];
    for format in FORMATS {
        all.push(Operation::of(&format!("export {format}"), move |scene| {
            post(&format!("/v1/export?format={format}"), scene)
        }));
        if WRITTEN.contains(format) {
            continue;
        }
        all.push(Operation {
            name: format!("import {format}"),
            towns: match format {
                _ if OF_BOUNDED_SIZE.contains(format) => SMALL_TOWNS,
                _ if OF_MANY_PIECES.contains(format) => MIDDLE_TOWNS,
                _ => TOWNS,
            },
            ask: Box::new(move |server, scene| {
                let file = answered(server, &post(&format!("/v1/export?format={format}"), scene))?;
                let request = Request::new("POST", "/v1/import?dry_run=true");
                Ok(request.header("content-type", "application/octet-stream").body(file.body))
            }),
        });
    }
    all
}

/// Core time of an operation on a town, seconds; otherwise the reason why there is none.
fn measure(operation: &Operation, lanes: usize, server: &Server, seed: &mut u64) -> anyhow::Result<f64> {
    let mut shortest = f64::INFINITY;
    for _ in 0..REPEATS {
        *seed += 1;
        let request = (operation.ask)(server, &town(lanes, operation.towns.piece_m, *seed))?;
        let before = server.core_s()?;
        answered(server, &request)?;
        shortest = shortest.min(server.core_s()? - before);
    }
    Ok(shortest)
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::from(2)
        }
    }
}

/// Whether every operation is answered, and no time rises too much.
fn run() -> anyhow::Result<bool> {
    let server = Server::start(&PATIENCE)?;
    server.wait_ready()?;
    let (mut seed, mut is_linear) = (0, true);
    println!("{:<20} {} rise", "core s of lanes", TOWNS.lanes.map(|lanes| format!("{lanes:>7}")).concat());
    for operation in operations() {
        let mut times = Vec::new();
        let measured: anyhow::Result<()> = operation.towns.lanes.iter().try_for_each(|lanes| {
            times.push(measure(&operation, *lanes, &server, &mut seed)?);
            Ok(())
        });
        let cells: String = times.iter().map(|time| format!("{time:>7.2}")).collect();
        let told = match (measured, times.as_slice()) {
            (Ok(()), [.., quarter, _, whole]) => {
                let rise = (whole.max(LEAST_S) / quarter.max(LEAST_S)).sqrt();
                is_linear &= rise < MOST_RISE;
                format!("{rise:.2}{}", if rise < MOST_RISE { "" } else { " TOO MUCH" })
            }
            (Err(why), _) => {
                is_linear = false;
                let why: String = format!("{why:#}").chars().take(200).collect();
                format!(" {why}")
            }
            _ => String::new(),
        };
        let smaller = TOWNS.lanes[0] / operation.towns.lanes[0];
        let of = if smaller > 1 { format!(" / {smaller}") } else { String::new() };
        println!("{:<20} {cells} {told}", operation.name + &of);
    }
    Ok(is_linear)
}
