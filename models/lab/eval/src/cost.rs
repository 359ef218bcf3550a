//! Table 6: latency and its growth, scenes per hour, and memory.

use super::sheet::{Cell, Form, Sheet};
use super::table::{Made, TableSpec, Trial};
use super::{Judged, Subset, cases};
use anyhow::Result;
use experts::{Cancel, Event, Generator, Request};
use rayon::prelude::*;
use scene::{AgentId, AgentType, LaneMap, Scene};
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

/// Repetitions of the request for each whole scene.
const ROUNDS: usize = 3;
/// Groups of scenes by the size of their maps.
const MAP_SIZES: usize = 3;

/// Median and 95th percentile, milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Percentiles {
    pub calls: usize,
    pub p50_ms: f64,
    pub p95_ms: f64,
    pub p99_ms: f64,
}

impl Percentiles {
    /// Percentiles of readings in any order, milliseconds.
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values.get(((values.len() as f64 - 1.0) * share).round() as usize).copied();
        let [p50_ms, p95_ms, p99_ms] = [0.5, 0.95, 0.99].map(|share| at(share).unwrap_or(0.0));
        Self { calls: values.len(), p50_ms, p95_ms, p99_ms }
    }
}

/// One line of the table.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Latency {
    pub what: String,
    pub threads: usize,
    pub first_event: Percentiles,
    pub settled: Percentiles,
}

/// One call: milliseconds to its first event and to its end.
#[derive(Clone, Copy)]
struct Call {
    first_ms: f64,
    settled_ms: f64,
}

/// Measures calls over scenes: one dragged road user (with a goal at its log's end) on a new and on a known
/// map, and 8, 32 and 128 road users at once.
///
/// # Errors
/// When the generator fails.
pub fn latency(generator: &Generator, threads: usize, scenes: &[Scene]) -> Result<Vec<Latency>> {
    let mut cold = Vec::new();
    // Drags by scene, with the size of the scene's map.
    let mut drags: Vec<(usize, Vec<Call>)> = Vec::new();
    for scene in scenes {
        generator.maps().forget();
        let mut calls = Vec::new();
        for (i, case) in cases(scene).into_iter().step_by(3).enumerate() {
            let mut changed = scene.clone();
            changed.agents[case.agent].conditions.goal = case.goal(scene, Subset::Pos);
            let scene = Arc::new(changed);
            let ids = BTreeSet::from([scene.agents[case.agent].id.clone()]);
            let first = timed(generator, &scene, &ids)?;
            if i == 0 {
                cold.push(first);
            }
            calls.push(timed(generator, &scene, &ids)?);
        }
        drags.push((points(&scene.map), calls));
    }
    let all = |drags: &[(usize, Vec<Call>)]| drags.iter().flat_map(|d| d.1.clone()).collect();
    let mut rows = vec![row("one drag", threads, all(&drags)), row("one drag, map new", threads, cold)];
    drags.sort_by_key(|d| d.0);
    for part in drags.chunks(drags.len().div_ceil(MAP_SIZES).max(1)) {
        let (least, most) = (part[0].0, part[part.len() - 1].0);
        rows.push(row(&format!("one drag, maps of {least} to {most} points"), threads, all(part)));
    }
    for count in [8, 32, 128] {
        let mut calls = Vec::new();
        for scene in scenes {
            let ids = movable(scene, count);
            if ids.len() < count {
                continue;
            }
            let scene = Arc::new(scene.clone());
            timed(generator, &scene, &ids)?;
            for _ in 0..ROUNDS {
                calls.push(timed(generator, &scene, &ids)?);
            }
        }
        rows.push(row(&format!("whole scene, {count} road users"), threads, calls));
    }
    Ok(rows)
}

fn row(what: &str, threads: usize, calls: Vec<Call>) -> Latency {
    let spread = |of: fn(&Call) -> f64| Percentiles::of(calls.iter().map(of).collect());
    let (first_event, settled) = (spread(|call| call.first_ms), spread(|call| call.settled_ms));
    Latency { what: what.into(), threads, first_event, settled }
}

/// Number of points of a map's lanes and edges.
fn points(map: &LaneMap) -> usize {
    let lanes = map.lanes.iter().map(|lane| lane.points.xy.len());
    lanes.chain(map.road_edges.iter().map(|edge| edge.points.xy.len())).sum()
}

/// Road users present at the first step, moving ones first.
fn movable(scene: &Scene, most: usize) -> BTreeSet<AgentId> {
    let mut all: Vec<&scene::Agent> =
        scene.agents.iter().filter(|a| a.agent_type != AgentType::Other && a.state_at(0).is_some()).collect();
    all.sort_by(|a, b| b.track.extent_m().total_cmp(&a.track.extent_m()));
    all.into_iter().take(most).map(|a| a.id.clone()).collect()
}

fn timed(generator: &Generator, scene: &Arc<Scene>, ids: &BTreeSet<AgentId>) -> Result<Call> {
    let mut request = Request::new(scene.clone());
    request.agents = Some(ids.clone());
    let started = Instant::now();
    let elapsed_ms = || started.elapsed().as_secs_f64() * 1e3;
    let mut first = None;
    let mut call = generator.start(request, Cancel::default())?;
    while let Some(event) = call.next() {
        if let Event::Draft(draft) = event?
            && draft.step == 0
        {
            std::hint::black_box(call.drafted()?);
            first = Some(elapsed_ms());
        }
    }
    let settled_ms = elapsed_ms();
    Ok(Call { first_ms: first.unwrap_or(settled_ms), settled_ms })
}

/// Scenes per hour when each is generated as a whole, with at most 128 road users and one scene per thread.
fn scenes_an_hour(generator: &Generator, threads: usize, scenes: &[Scene]) -> Result<f64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let whole = |scene: &Scene| timed(generator, &Arc::new(scene.clone()), &movable(scene, 128)).map(|_| ());
    let started = Instant::now();
    pool.install(|| scenes.par_iter().try_for_each(whole))?;
    Ok(scenes.len() as f64 * 3600.0 / started.elapsed().as_secs_f64())
}

/// Resident memory of this process, MB; `None` if the system does not report it.
fn resident_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(line.split_whitespace().next()?.parse::<f64>().ok()? / 1024.0)
}

/// Table 6.
pub(super) const TABLE: TableSpec = TableSpec { number: 6, name: "cost", make: cost };

/// Two sheets: milliseconds; scenes per hour and memory.
fn cost(trial: &mut Trial<'_>) -> Result<Made> {
    let scenes = trial.scenes;
    let mut times = Sheet::new(
        "6a Cost of a call",
        &["Milliseconds on this machine, whatever else it was doing: median / 95th percentile; maps known \
             unless the line calls them new."],
        &["ours", "what", "threads"],
        &["calls", "first event p50", "p95", "settled p50", "p95"],
    );
    let mut bulk = Sheet::new(
        "6b Many scenes",
        &["Each scene generated whole, one a thread. Memory of this process in MB, which holds all scenes: \
             before and after."],
        &["ours", "threads"],
        &["scenes an hour", "memory before", "after"],
    );
    let plain = |value| Cell::Number { value, form: Form::Plain };
    for Judged { name, mut generator } in std::mem::take(&mut trial.judged) {
        for threads in [1, 2] {
            generator = generator.with_threads(threads);
            generator.warm_up();
            for Latency { what, first_event, settled, .. } in latency(&generator, threads, scenes)? {
                let spreads = [first_event.p50_ms, first_event.p95_ms, settled.p50_ms, settled.p95_ms];
                let mut cells = vec![Cell::Count(settled.calls as u64)];
                cells.extend(spreads.map(plain));
                times.push([name.clone(), what, threads.to_string()], cells);
            }
            generator = generator.with_threads(1);
            let before = resident_mb();
            let an_hour = scenes_an_hour(&generator, threads, scenes)?;
            let memory = [before, resident_mb()].map(|mb| mb.map_or(Cell::Nothing, plain));
            let mut cells = vec![Cell::Count(an_hour.round() as u64)];
            cells.extend(memory);
            bulk.push([name.clone(), threads.to_string()], cells);
        }
        trial.judged.push(Judged { name, generator });
    }
    Ok(Made { times: vec![times, bulk], ..Made::default() })
}
