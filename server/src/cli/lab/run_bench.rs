//! `dragtraffic lab bench --steps`: the time of one step of a run with few and with many road users.

use super::failed;
use crate::cli::{Common, Failure};
use experts::placement::{Amount, PlaceRequest};
use experts::{Cancel, EgoState, Engine, Run, RunSettings};
use lab_eval::cost::Percentiles;
use scene::{AgentType, Scene, State};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

/// Numbers of road users beside the ego.
const OTHERS: [usize; 3] = [8, 32, 128];
/// Number of steps of 0.1 s.
const STEPS: usize = 200;

/// Latency of the steps of one run.
#[derive(Debug, Serialize)]
pub struct RunLatency {
    scene: String,
    threads: usize,
    /// Road users beside the ego at the start; fewer than requested if the map has no room.
    others: usize,
    /// Time of the first plans of all, milliseconds.
    begin_ms: f64,
    /// Time of a step, milliseconds.
    step: Percentiles,
    /// Time of a peek with the next nine seconds of the ego, milliseconds.
    peek: Percentiles,
    /// Bytes of the last snapshot.
    snapshot_bytes: usize,
    /// Time of a snapshot, at every tenth step, milliseconds.
    save: Percentiles,
    /// Time of restoring that snapshot, milliseconds.
    restore: Percentiles,
    collisions: usize,
}

/// Runs of 20 s on the map of a scene with placed road users, and one ego that follows the plan made for it.
///
/// # Errors
/// Those of the engine.
pub fn step_times(scene: &Scene, common: &Common) -> Result<Vec<RunLatency>, Failure> {
    let mut rows = Vec::new();
    for threads in [1, 2] {
        let engine = common.engine()?;
        let engine = Engine { generator: engine.generator.with_threads(threads), ..engine };
        engine.generator.warm_up();
        for others in OTHERS {
            rows.push(measured(&filled(scene, others + 1, &engine)?, threads, &engine)?);
        }
    }
    Ok(rows)
}

/// The scene's map with placed road users instead of its own.
fn filled(scene: &Scene, count: usize, engine: &Engine) -> Result<Scene, Failure> {
    let shared = Arc::new(scene.clone());
    let (amount, keep) = (Amount::Count(count), Some(BTreeSet::new()));
    let request = PlaceRequest { amount, keep, seed: 1, ..PlaceRequest::new(shared) };
    let placed = engine.placer.place(&request, &Cancel::default()).map_err(failed)?;
    Ok(Scene { agents: placed.agents, generated: None, ..scene.clone() })
}

fn measured(scene: &Scene, threads: usize, engine: &Engine) -> Result<RunLatency, Failure> {
    let (scene, none) = (Arc::new(scene.clone()), Cancel::default());
    let settings = RunSettings { seed: 1, ..RunSettings::default() };
    let began = |egos: &[String]| Run::new(Arc::clone(&scene), egos, settings, &engine.generator, &none);
    let alone = began(&[]).map_err(failed)?;
    let free = alone.peek(&engine.generator, &BTreeMap::new(), &none).map_err(failed)?;
    let moves = |id: &&scene::AgentId| scene.agent(id).is_some_and(|a| a.kind() == AgentType::Vehicle);
    let way = |id: &scene::AgentId| -> f64 {
        let states = &free.futures[id];
        states.last().zip(states.first()).map_or(0.0, |(a, b)| (a.position() - b.position()).norm())
    };
    let ego = free.futures.keys().filter(moves).max_by(|a, b| way(a).total_cmp(&way(b))).cloned();
    let egos: Vec<String> = ego.into_iter().collect();
    let start = Instant::now();
    let mut run = began(&egos).map_err(failed)?;
    let begin_ms = 1e3 * start.elapsed().as_secs_f64();
    let (mut steps, mut peeks, mut collisions) = (Vec::new(), Vec::new(), 0);
    let (mut saves, mut restores) = (Vec::new(), Vec::new());
    for i in 0..STEPS {
        let states = egos.iter().filter_map(|id| Some((id, free.futures.get(id)?)));
        let at = |states: &[State]| states.get(i).or(states.last()).copied().unwrap_or_default();
        let told: Vec<EgoState> = states.map(|(id, states)| EgoState::new(id, at(states))).collect();
        let start = Instant::now();
        let step = run.step(&engine.generator, &told, &none).map_err(failed)?;
        steps.push(1e3 * start.elapsed().as_secs_f64());
        collisions += step.faults.iter().filter(|f| f.fault.with.is_some()).count();
        if i % 10 == 0 {
            let start = Instant::now();
            run.peek(&engine.generator, &BTreeMap::new(), &none).map_err(failed)?;
            peeks.push(1e3 * start.elapsed().as_secs_f64());
            let start = Instant::now();
            let saved = run.snapshot();
            saves.push(1e3 * start.elapsed().as_secs_f64());
            let start = Instant::now();
            Run::restore(Arc::clone(&scene), &saved).map_err(failed)?;
            restores.push(1e3 * start.elapsed().as_secs_f64());
        }
    }
    Ok(RunLatency {
        scene: scene.name.clone(),
        threads,
        others: scene.agents.len() - egos.len(),
        begin_ms,
        step: Percentiles::of(steps),
        peek: Percentiles::of(peeks),
        snapshot_bytes: run.snapshot().len(),
        save: Percentiles::of(saves),
        restore: Percentiles::of(restores),
        collisions,
    })
}
