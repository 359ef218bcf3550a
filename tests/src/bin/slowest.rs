//! `slowest [--tries N] [--seed S]`: searches for the slowest valid request within the limits, and measures
//! drags at the same time. `cargo xtask slowest` builds and runs it.
//!
//! Each kind of request is first tried at its limits. Then the slowest ones are changed at random, and a
//! change that takes longer is kept. The measure of a request is the core time that the server spends on it,
//! so that other work on the machine does not matter. The measure of a drag is the elapsed time.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to people")]

use anyhow::bail;
use dragtraffic_tests::random::Random;
use dragtraffic_tests::scenes::{car, street};
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Greatest core time of a request, seconds.
const MOST_S: f64 = 10.0;
/// Greatest time of 19 of 20 concurrent drags, milliseconds, on a quiet machine.
const DRAG_MS: f64 = 100.0;
/// Time between two drags, as by hand.
const PAUSE: Duration = Duration::from_millis(16);

/// Greatest core time of a search: it ends by the clock, and yields to smaller calls after each try.
const SEARCH_S: f64 = 60.0;

/// Numbers that make a request, each with its range.
struct Kind {
    name: &'static str,
    path: &'static str,
    /// Least and most of each number.
    ranges: &'static [(u64, u64)],
    body: fn(&[u64]) -> Value,
}

const KINDS: &[Kind] = &[
    Kind {
        name: "lanes that cross",
        path: "/v1/generate",
        ranges: &[(1, 60), (2, 4_096), (30, 3_000)],
        body: tangle,
    },
    Kind {
        name: "crowd beside combs",
        path: "/v1/generate",
        ranges: &[(2, 400), (2, 4_096), (20, 300), (1, 128)],
        body: combs,
    },
    Kind { name: "lanes on one place", path: "/v1/generate", ranges: &[(1, 19_990), (2, 20)], body: pile },
    Kind {
        name: "lanes on one place, filled",
        path: "/v1/place",
        ranges: &[(1, 19_990), (2, 20)],
        body: filled_pile,
    },
    Kind {
        name: "areas on one place",
        path: "/v1/generate",
        ranges: &[(1, 97), (3, 4_096), (2, 40)],
        body: areas,
    },
    Kind { name: "linked lanes", path: "/v1/generate", ranges: &[(2, 3_000), (1, 64), (1, 40)], body: graph },
    Kind {
        name: "all, many samples",
        path: "/v1/generate",
        ranges: &[(1, 128), (1, 32), (1, 1), (5, 100)],
        body: crowd,
    },
    Kind {
        name: "goals far off with vias",
        path: "/v1/generate",
        ranges: &[(1, 128), (0, 4), (20, 300)],
        body: goals,
    },
    Kind { name: "score of a crowd", path: "/v1/score", ranges: &[(1, 256), (2, 600), (0, 30)], body: score },
    Kind {
        name: "export to CommonRoad",
        path: "/v1/export?format=commonroad",
        ranges: &[(2, 3_000), (1, 64)],
        body: file,
    },
    Kind {
        name: "export to OpenDRIVE",
        path: "/v1/export?format=opendrive",
        ranges: &[(2, 3_000), (1, 64)],
        body: file,
    },
    Kind {
        name: "export to SUMO",
        path: "/v1/export?format=sumo",
        ranges: &[(2, 3_000), (1, 64)],
        body: file,
    },
    Kind {
        name: "export of a recording",
        path: "/v1/export?format=mcap",
        ranges: &[(1, 256), (2, 600)],
        body: long,
    },
    Kind { name: SEARCH, path: "/v1/search", ranges: &[(2, 128), (1, 1_000), (3, 20)], body: search },
    Kind { name: "begin of a run", path: "/v1/runs", ranges: &[(2, 128), (3, 600)], body: begin },
    Kind {
        name: "import of a recording",
        path: "/v1/import?dry_run=true",
        ranges: &[(1, 256), (2, 600)],
        body: long,
    },
    Kind { name: "save of winding areas", path: "/v1/scenes", ranges: &[(1, 97), (3, 4_096)], body: winding },
    Kind { name: PICTURE, path: "/v1/scenes", ranges: &[(1, 97), (3, 4_096)], body: winding },
];

/// Name of the kind whose request follows a save: a small picture of the saved scene.
const PICTURE: &str = "picture of winding areas";

/// Name of the kind with its own bound.
const SEARCH: &str = "tries of a search";

fn with_lanes(agents: usize, lanes: Vec<Value>) -> Value {
    let mut scene = street(agents, 20);
    if let Some(all) = scene["map"]["lanes"].as_array_mut() {
        all.extend(lanes);
    }
    scene
}

fn one(scene: Value) -> Value {
    json!({"scene": scene, "agents": ["0"]})
}

fn lane(id: String, points: Vec<[f64; 2]>) -> Value {
    json!({"id": id, "type": "surface_street", "points_m": points})
}

/// Lanes with points anywhere on a square of this side.
fn tangle(n: &[u64]) -> Value {
    let [lanes, points, side_m] = [n[0], n[1], n[2]];
    let mut random = Random::new(7);
    let mut at = || side_m as f64 * (random.below(10_000) as f64 / 10_000.0 - 0.5);
    let lanes = (0..lanes).map(|i| lane(format!("t{i}"), (0..points).map(|_| [at(), at()]).collect()));
    one(with_lanes(2, lanes.collect()))
}

/// Lanes back and forth across a square of this side, alternately at right angles, so that each piece of one
/// crosses all pieces of its neighbours. Cars are on and beside them.
fn combs(n: &[u64]) -> Value {
    let (lanes, points, side_m, agents) = (n[0], n[1], n[2] as f64, n[3] as usize);
    let at = |i: u64, k: u64| {
        let along = side_m * (k as f64 / (points - 1) as f64 - 0.5) + i as f64 * 1e-3;
        let across = side_m * if k.is_multiple_of(2) { -0.5 } else { 0.5 };
        if i.is_multiple_of(2) { [across, along] } else { [along, across] }
    };
    let comb = |i: u64| lane(format!("c{i}"), (0..points).map(|k| at(i, k)).collect());
    json!({"scene": with_lanes(agents, (0..lanes).map(comb).collect()), "agents": "all"})
}

fn piled(n: &[u64]) -> Value {
    let points = |i: u64| (0..n[1]).map(|k| [k as f64 * 5.0, i as f64 * 1e-4]).collect();
    with_lanes(2, (0..n[0]).map(|i| lane(format!("p{i}"), points(i))).collect())
}

fn pile(n: &[u64]) -> Value {
    one(piled(n))
}

fn filled_pile(n: &[u64]) -> Value {
    json!({"scene": piled(n), "density": {"count": 100}})
}

/// Stars with the given number of corners at one place, under the given number of cars.
fn areas(n: &[u64]) -> Value {
    let mut scene = street(n[2] as usize, 91);
    let star = |_| {
        let corner = |k: u64| {
            let (angle, r_m) = (
                k as f64 / n[1] as f64 * std::f64::consts::TAU,
                if k.is_multiple_of(2) { 30.0 } else { 20.0 },
            );
            [r_m * angle.cos(), r_m * angle.sin()]
        };
        json!((0..n[1]).map(corner).collect::<Vec<_>>())
    };
    let area = |i: u64| json!({"id": format!("a{i}"), "polygon_m": star(i)});
    scene["map"]["drivable"] = json!((0..n[0]).map(area).collect::<Vec<_>>());
    json!({"scene": scene, "agents": "all"})
}

fn linked(lanes: u64, links: u64, agents: usize) -> Value {
    let ids =
        |i: u64| (1..=links.min(lanes - 1)).map(|k| format!("g{}", (i + k) % lanes)).collect::<Vec<_>>();
    let lane = |i: u64| {
        let (x, y) = ((i % 30) as f64 * 30.0 - 100.0, (i / 30) as f64 * 4.0);
        json!({"id": format!("g{i}"), "type": "surface_street", "points_m": [[x, y], [x + 30.0, y]], "successors": ids(i)})
    };
    with_lanes(agents, (0..lanes).map(lane).collect())
}

fn graph(n: &[u64]) -> Value {
    json!({"scene": linked(n[0], n[1], n[2] as usize), "agents": "all"})
}

fn file(n: &[u64]) -> Value {
    linked(n[0], n[1], 2)
}

fn crowd(n: &[u64]) -> Value {
    // Keeps the reply below its greatest size. More modes leave room for fewer samples.
    let steps = n[3].min(400_000 / (n[0] * n[1] * n[2])).max(1);
    json!({"scene": street(n[0] as usize, 11), "agents": "all", "samples": n[1], "modes": n[2], "steps": steps})
}

fn goals(n: &[u64]) -> Value {
    let far = |part: f64| json!({"x_m": part * n[2] as f64, "y_m": 10.0 * part});
    let vias: Vec<Value> = (0..n[1]).map(|k| far((k + 1) as f64 / (n[1] + 1) as f64)).collect();
    let condition = json!({"goal": far(1.0), "via": vias});
    let conditions: serde_json::Map<_, _> = (0..n[0]).map(|i| (i.to_string(), condition.clone())).collect();
    json!({"scene": street(n[0] as usize, 11), "agents": "all", "conditions": conditions})
}

/// Cars that drive through each other, with this distance between them.
fn score(n: &[u64]) -> Value {
    let mut scene = street(0, n[1] as usize);
    let near = |i: u64| {
        let mut car = car(0, n[1] as usize);
        car["id"] = i.to_string().into();
        let moved = |value: &Value| value.as_f64().unwrap_or(0.0) + i as f64 * n[2] as f64 / 10.0;
        let x: Vec<f64> = car["track"]["x_m"].as_array().into_iter().flatten().map(moved).collect();
        car["track"]["x_m"] = json!(x);
        car
    };
    scene["agents"] = json!((0..n[0]).map(near).collect::<Vec<_>>());
    json!({"scene": scene})
}

fn long(n: &[u64]) -> Value {
    street(n[0] as usize, n[1] as usize)
}

/// An area with that many holes of that many corners, whose zigzags a simplification cuts one by one.
fn winding(n: &[u64]) -> Value {
    let hole = |i: u64| -> Value {
        let corner = |k: u64| {
            let height_m = 8.0 - 7.0 * k as f64 / n[1] as f64;
            let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            [k as f64 * 0.2 - 400.0, i as f64 * 40.0 - 1_200.0 + side * height_m]
        };
        json!((0..n[1]).map(corner).collect::<Vec<_>>())
    };
    let mut scene = street(1, 20);
    let corners = [[-9e3, -9e3], [9e3, -9e3], [9e3, 9e3], [-9e3, 9e3]];
    let holes: Vec<Value> = (0..n[0]).map(hole).collect();
    scene["map"]["drivable"] = json!([{"id": "a", "polygon_m": corners, "holes_m": holes}]);
    scene
}

/// A search with the given numbers of tries, road users and seconds, for an event that never happens.
fn search(n: &[u64]) -> Value {
    let situation = json!({"template": "cut-in", "parameters": {"gap_m": {"uniform": [2, 8]}}});
    json!({"scene": street(n[0] as usize, 20), "where": "collisions > 1000000", "tries": n[1],
        "situation": situation, "generate": {"react": true, "horizon_s": n[2]}})
}

fn begin(n: &[u64]) -> Value {
    json!({"scene": street(n[0] as usize, n[1] as usize), "egos": ["0"]})
}

/// Measurements of a request.
struct Tried {
    kind: usize,
    numbers: Vec<u64>,
    core_s: f64,
    seconds: f64,
    status: u16,
    code: String,
    kilobytes: usize,
    drags_ms: Vec<f64>,
}

impl Tried {
    /// The time of 19 of 20 concurrent drags; `None` with fewer drags.
    fn p95_ms(&self) -> Option<f64> {
        let mut sorted = self.drags_ms.clone();
        sorted.sort_by(f64::total_cmp);
        (sorted.len() >= 20).then(|| sorted.get(sorted.len() * 19 / 20).copied()).flatten()
    }
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

/// Whether all requests stay within their time.
fn run() -> anyhow::Result<bool> {
    let (mut tries, mut seed) = (24, 1);
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    for pair in arguments.chunks(2) {
        match pair {
            [flag, number] if flag == "--tries" => tries = number.parse()?,
            [flag, number] if flag == "--seed" => seed = number.parse()?,
            _ => bail!("usage: slowest [--tries N] [--seed S]"),
        }
    }
    let server = Server::start(&[])?;
    server.wait_ready()?;
    let mut all = Vec::new();
    for (kind, of_kind) in KINDS.iter().enumerate() {
        // At the limits; if all limits together are refused, each number is lowered in turn.
        let mut numbers: Vec<u64> = of_kind.ranges.iter().map(|(_, most)| *most).collect();
        for round in 0..8 * numbers.len() {
            let tried = attempt(&server, kind, &numbers)?;
            let fits = tried.status < 400 || tried.status >= 500;
            all.push(tried);
            if fits {
                break;
            }
            let at = round % numbers.len();
            numbers[at] = (numbers[at] / 2).max(of_kind.ranges[at].0);
        }
    }
    let mut random = Random::new(seed);
    for _ in 0..tries {
        all.sort_by(|a, b| b.core_s.total_cmp(&a.core_s));
        // One of the slowest requests, with one number changed.
        let Some(parent) = all.iter().filter(|tried| tried.status < 300).nth(random.index(4)) else { break };
        let (kind, mut numbers) = (parent.kind, parent.numbers.clone());
        let at = random.index(numbers.len());
        let (least, most) = KINDS[kind].ranges[at];
        let changed = numbers[at] as f64 * (0.5 + random.below(1_500) as f64 / 1_000.0);
        numbers[at] = (changed as u64).clamp(least, most);
        all.push(attempt(&server, kind, &numbers)?);
    }
    all.sort_by(|a, b| b.core_s.total_cmp(&a.core_s));
    Ok(report(&all))
}

/// Sends a request, and drags at the same time.
fn attempt(server: &Server, kind: usize, numbers: &[u64]) -> anyhow::Result<Tried> {
    let of_kind = &KINDS[kind];
    let body = serde_json::to_vec(&(of_kind.body)(numbers))?;
    let kilobytes = body.len() / 1_000;
    let mut request =
        Request::new("POST", of_kind.path).header("content-type", "application/json").body(body);
    if of_kind.name == PICTURE {
        let saved = server.send(&request)?;
        if saved.status == 201 {
            let id = saved.json()["id"].as_str().unwrap_or_default().to_owned();
            request = Request::new("GET", &format!("/v1/scenes/{id}/preview"));
        }
    }
    let drag = Request::new("POST", "/v1/generate")
        .json(&json!({"scene_id": "demo-crossing", "agents": ["5"], "score": false, "futures": "compact"}));
    let (address, before, began) = (server.address, server.core_s()?, Instant::now());
    let asked = std::thread::spawn(move || request.send(address));
    let (mut drags_ms, mut of_drags) = (Vec::new(), 0);
    while !asked.is_finished() {
        let began = Instant::now();
        let reply = server.send(&drag)?;
        if reply.status == 200 && !asked.is_finished() {
            drags_ms.push(began.elapsed().as_secs_f64() * 1e3);
        }
        of_drags += 1;
        std::thread::sleep(PAUSE);
    }
    let seconds = began.elapsed().as_secs_f64();
    let reply = asked.join().map_err(|_| anyhow::anyhow!("the request broke off"))??;
    let busy_s = server.core_s()? - before;
    // The drags take core time too: subtract the time of as many drags alone.
    let before = server.core_s()?;
    let alone = of_drags.min(20);
    (0..alone).try_for_each(|_| server.send(&drag).map(drop))?;
    let each_s = (server.core_s()? - before) / f64::from(alone.max(1));
    let core_s = (busy_s - each_s * f64::from(of_drags)).max(0.0);
    let code = if reply.status < 300 { String::new() } else { reply.code() };
    let tried = Tried {
        kind,
        numbers: numbers.to_vec(),
        core_s,
        seconds,
        status: reply.status,
        code,
        kilobytes,
        drags_ms,
    };
    eprintln!("{}", line(&tried));
    Ok(tried)
}

fn line(tried: &Tried) -> String {
    let drag = tried.p95_ms().map_or("-".to_owned(), |ms| format!("{ms:.0}"));
    let Tried { core_s, seconds, status, code, kilobytes, .. } = tried;
    let name = KINDS.get(tried.kind).map_or("", |kind| kind.name);
    format!("{core_s:7.2} {seconds:7.2} {drag:>7} {kilobytes:7} {status:4} {name} {:?} {code}", tried.numbers)
}

/// Prints the table; returns whether the bounds hold.
fn report(all: &[Tried]) -> bool {
    println!(" core s  wall s drag ms      kB");
    all.iter()
        .filter(|tried| tried.status < 400 || tried.status >= 500)
        .take(12)
        .for_each(|t| println!("{}", line(t)));
    let is_search = |tried: &&Tried| KINDS.get(tried.kind).is_some_and(|kind| kind.name == SEARCH);
    let slowest = all.iter().filter(|tried| !is_search(tried)).map(|tried| tried.core_s).fold(0.0, f64::max);
    let longest = all.iter().filter(is_search).map(|tried| tried.core_s).fold(0.0, f64::max);
    let drag = all.iter().filter_map(Tried::p95_ms).fold(0.0, f64::max);
    let failed = all.iter().any(|tried| tried.status >= 500);
    println!(
        "slowest {slowest:.2} s of a core (at most {MOST_S}), a search {longest:.2} s (at most {SEARCH_S}); p95 of a drag beside them at worst {drag:.0} ms (at most {DRAG_MS})"
    );
    slowest <= MOST_S && longest <= SEARCH_S && drag <= DRAG_MS && !failed
}
