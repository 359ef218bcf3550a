//! The parked row of table 1: does what stands stay where it stands?

use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::{Judged, Site};
use anyhow::Result;
use experts::{Generator, Request};
use rayon::prelude::*;
use scene::{Agent, AgentType, STANDING_MPS};
use std::sync::Arc;

/// Most road users of one call.
const MOST: usize = 128;
/// Less than this is standing still, metres.
const MOVED_M: f64 = 1e-6;

/// Vehicles that keep their place in the log: seen for 8 s, within 0.3 m, standing at the start.
fn is_parked(agent: &Agent) -> bool {
    agent.agent_type == AgentType::Vehicle
        && agent.track.valid_steps().count() >= 80
        && agent.track.extent_m() < 0.3
        && agent.state_at(0).is_some_and(|s| s.speed_mps() < STANDING_MPS)
}

/// Greatest distance of each parked vehicle from its place when it is generated without a goal, metres.
fn drifts(generator: &Generator, site: &Site<'_>, seed: u64) -> Result<Vec<f64>> {
    let parked: Vec<&Agent> = site.scene.agents.iter().filter(|a| is_parked(a)).take(MOST).collect();
    if parked.is_empty() {
        return Ok(Vec::new());
    }
    let mut request = Request::new(Arc::new(site.blind.clone()));
    request.agents = Some(parked.iter().map(|a| a.id.clone()).collect());
    request.seed = seed;
    let answer = generator.answer(request)?;
    let Some(sample) = answer.samples.first() else { return Ok(Vec::new()) };
    let drift = |agent: &&Agent| {
        let (start, futures) = (agent.state_at(0)?, sample.agents.get(&agent.id)?);
        let states = &futures.modes[futures.chosen].states;
        Some(states.iter().map(|s| (s.position() - start.position()).norm()).fold(0.0, f64::max))
    };
    Ok(parked.iter().filter_map(drift).collect())
}

/// The row for all weights.
///
/// # Errors
/// When a generator fails.
pub(super) fn parked(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Sheet> {
    let mut sheet = Sheet::new(
        "1f Parked vehicles",
        &["Vehicles that stand for the whole log, generated together without goals. Drift is the greatest \
           distance from the place, metres."],
        &["ours"],
        &["moved", "mean drift", "greatest drift"],
    );
    for own in judged {
        let all: Result<Vec<Vec<f64>>> =
            sites.par_iter().map(|site| drifts(&own.generator, site, seed)).collect();
        let all = all?;
        let values =
            || all.iter().zip(sites).flat_map(|(drifts, site)| drifts.iter().map(|d| (site.index, *d)));
        sheet.push(
            [own.name.as_str()],
            vec![
                Cell::of(boot.estimate(values().map(|(s, d)| Value::flag(s, d > MOVED_M))), Form::Percent),
                Cell::of(boot.estimate(values().map(|(s, d)| Value::new(s, d))), Form::Fine),
                Cell::Number { value: values().map(|v| v.1).fold(0.0, f64::max), form: Form::Plain },
            ],
        );
    }
    Ok(sheet)
}
