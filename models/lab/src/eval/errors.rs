//! Distance of the futures from the log: best of six and the one shown.

use super::{Subset, answer, cases};
use anyhow::Result;
use experts::{Generator, Request};
use scene::{Agent, AgentType, Future, Scene};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Mean errors of one type under one condition.
#[derive(Clone, Debug, Default, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ErrorRow {
    pub cases: usize,
    pub min_ade_m: f64,
    pub first_ade_m: f64,
    pub min_fde_m: f64,
    /// Share of cases whose best future is the most probable one; one sixth says nothing.
    pub best_is_likeliest: f64,
}

/// Rows by type, then condition.
pub type ErrorTable = BTreeMap<AgentType, BTreeMap<Subset, ErrorRow>>;

/// Errors of one road user at a time, the others as logged.
///
/// # Errors
/// When the generator fails.
pub fn errors(generator: &Generator, scenes: &[Scene], subsets: &[Subset]) -> Result<ErrorTable> {
    let mut table = ErrorTable::new();
    for scene in scenes {
        for case in cases(scene) {
            let agent = &scene.agents[case.agent];
            for &subset in subsets {
                let mut changed = scene.clone();
                changed.agents[case.agent].conditions.goal = case.goal(scene, subset);
                let mut request = Request::new(Arc::new(changed));
                request.agents = Some(BTreeSet::from([agent.id.clone()]));
                let answer = answer(generator, request)?;
                let Some(futures) = answer.samples.first().and_then(|s| s.agents.get(&agent.id)) else {
                    continue;
                };
                let ades: Vec<f64> = futures.modes.iter().map(|f| displacement(agent, f).0).collect();
                let best = (0..ades.len()).min_by(|a, b| ades[*a].total_cmp(&ades[*b])).unwrap_or(0);
                let likeliest = futures
                    .modes
                    .iter()
                    .enumerate()
                    .max_by(|a, b| a.1.probability.total_cmp(&b.1.probability).then(b.0.cmp(&a.0)))
                    .map_or(0, |m| m.0);
                let row = table.entry(case.agent_type).or_default().entry(subset).or_default();
                row.cases += 1;
                row.min_ade_m += ades[best];
                row.first_ade_m += ades[futures.chosen];
                row.min_fde_m += displacement(agent, &futures.modes[best]).1;
                row.best_is_likeliest += f64::from(u8::from(best == likeliest));
            }
        }
    }
    for row in table.values_mut().flat_map(BTreeMap::values_mut) {
        let n = row.cases.max(1) as f64;
        row.min_ade_m /= n;
        row.first_ade_m /= n;
        row.min_fde_m /= n;
        row.best_is_likeliest /= n;
    }
    Ok(table)
}

/// Mean and final distance from the log over the steps that the log has.
fn displacement(agent: &Agent, future: &Future) -> (f64, f64) {
    let (mut sum, mut n, mut last) = (0.0, 0.0, 0.0);
    for (i, state) in future.states.iter().enumerate() {
        let Some(logged) = agent.state_at(future.first_step + i) else { continue };
        last = (logged.position() - state.position()).norm();
        sum += last;
        n += 1.0;
    }
    if n > 0.0 { (sum / n, last) } else { (0.0, 0.0) }
}
