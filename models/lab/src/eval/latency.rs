//! How long answers take: one drag, and whole scenes.

use super::{Subset, cases};
use anyhow::Result;
use experts::{Cancel, Event, Generator, Request};
use scene::{AgentId, AgentType, Scene};
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

/// Median and 95th percentile, milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Spread {
    pub calls: usize,
    pub p50_ms: f64,
    pub p95_ms: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values.get(((values.len() as f64 - 1.0) * share).round() as usize).copied();
        Self { calls: values.len(), p50_ms: at(0.5).unwrap_or(0.0), p95_ms: at(0.95).unwrap_or(0.0) }
    }
}

/// One line of the table.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Row {
    pub what: String,
    pub threads: usize,
    pub first_event: Spread,
    pub settled: Spread,
}

/// Times calls over scenes: one dragged road user (a goal at its log's end), and 8, 32 and 128 at once.
///
/// # Errors
/// When the generator fails.
pub fn latency(generator: &Generator, threads: usize, scenes: &[Scene], rounds: usize) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    let (mut first, mut settled) = (Vec::new(), Vec::new());
    for scene in scenes {
        for case in cases(scene).into_iter().step_by(3) {
            let mut changed = scene.clone();
            changed.agents[case.agent].conditions.goal = case.goal(scene, Subset::Pos);
            let scene = Arc::new(changed);
            let ids = BTreeSet::from([scene.agents[case.agent].id.clone()]);
            // The first call of a scene encodes its map; a drag comes after it.
            timed(generator, &scene, &ids)?;
            let (a, b) = timed(generator, &scene, &ids)?;
            first.push(a);
            settled.push(b);
        }
    }
    rows.push(row("one drag", threads, first, settled));
    for count in [8, 32, 128] {
        let (mut first, mut settled) = (Vec::new(), Vec::new());
        for scene in scenes {
            let ids = movable(scene, count);
            if ids.len() < count {
                continue;
            }
            let scene = Arc::new(scene.clone());
            timed(generator, &scene, &ids)?;
            for _ in 0..rounds {
                let (a, b) = timed(generator, &scene, &ids)?;
                first.push(a);
                settled.push(b);
            }
        }
        rows.push(row(&format!("whole scene, {count} road users"), threads, first, settled));
    }
    Ok(rows)
}

fn row(what: &str, threads: usize, first: Vec<f64>, settled: Vec<f64>) -> Row {
    Row { what: what.into(), threads, first_event: Spread::of(first), settled: Spread::of(settled) }
}

/// Road users that are there at the first step, moving ones first.
fn movable(scene: &Scene, most: usize) -> BTreeSet<AgentId> {
    let mut all: Vec<&scene::Agent> =
        scene.agents.iter().filter(|a| a.agent_type != AgentType::Other && a.state_at(0).is_some()).collect();
    all.sort_by(|a, b| b.track.extent_m().total_cmp(&a.track.extent_m()));
    all.into_iter().take(most).map(|a| a.id.clone()).collect()
}

fn timed(generator: &Generator, scene: &Arc<Scene>, ids: &BTreeSet<AgentId>) -> Result<(f64, f64)> {
    let mut request = Request::new(scene.clone());
    request.agents = Some(ids.clone());
    let started = Instant::now();
    let mut first = None;
    for event in generator.start(request, Cancel::default())? {
        if let Event::Draft(draft) = event?
            && draft.step == 0
        {
            first = Some(started.elapsed().as_secs_f64() * 1e3);
        }
    }
    let settled = started.elapsed().as_secs_f64() * 1e3;
    Ok((first.unwrap_or(settled), settled))
}
