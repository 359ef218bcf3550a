//! The rows of table 1 about standing vehicles: whether they stay, and whether they move off as in the log.

use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::together::{generated, motions_of};
use super::{Judged, Site};
use anyhow::Result;
use experts::{Generator, Request};
use rayon::prelude::*;
use scene::routes::LaneHit;
use scene::{Agent, AgentType, STANDING_MPS, State, wrap_angle};
use std::sync::Arc;

/// Most road users of one call.
const MOST: usize = 128;
/// A shorter distance counts as standing, metres.
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
        let d = states.iter().map(|s| (s.position() - start.position()).norm()).fold(0.0, f64::max);
        Some(d)
    };
    Ok(parked.iter().filter_map(drift).collect())
}

/// A vehicle that stands on a lane at the start, with the behaviour of its log.
struct StandingStart {
    site: usize,
    /// Whether the log gets farther than [`OFF_M`] from its start; otherwise it stays within 0.5 m.
    log_moves: bool,
    moves: bool,
}

/// A log that gets farther than this from its start moves off, metres.
const OFF_M: f64 = 5.0;
/// Greatest distance of a vehicle on a lane from the centre line, metres, and greatest angle to it, radians.
const ON_LANE: (f64, f64) = (1.5, 0.5);

/// Vehicles that stand on a lane at the start, from a whole scene that is generated without goals.
fn standing_starts(generator: &Generator, site: &Site<'_>, seed: u64) -> Result<Vec<StandingStart>> {
    // The signals are those of the recording: they belong to the scene, not to the motion of its agents.
    let mut blind = site.blind.clone();
    blind.signals.clone_from(&site.scene.signals);
    let mut request = Request::new(Arc::new(blind));
    request.agents = Some(generated(site).into_iter().map(|i| site.scene.agents[i].id.clone()).collect());
    request.seed = seed;
    let answer = generator.answer(request)?;
    let Some(sample) = answer.samples.first() else { return Ok(Vec::new()) };
    let motions = motions_of(site, sample);
    let start = |agent: &Agent, states: &Vec<State>| {
        let from = agent.state_at(0).filter(|s| s.speed_mps() < 0.3)?;
        let on_lane = |hit: &LaneHit| {
            hit.distance_m < ON_LANE.0 && wrap_angle(hit.heading_rad - from.heading_rad).abs() < ON_LANE.1
        };
        let near = site.graph.nearest_for(from.position(), ON_LANE.0, agent.agent_type);
        let known = agent.agent_type == AgentType::Vehicle && agent.track.valid_steps().count() >= 80;
        if !known || !near.iter().any(on_lane) {
            return None;
        }
        let away = |s: &State| (s.position() - from.position()).norm();
        let farthest =
            agent.track.valid_steps().filter_map(|i| agent.state_at(i)).map(|s| away(&s)).fold(0.0, f64::max);
        let log_moves = farthest > OFF_M;
        let moves = states.iter().map(away).fold(0.0, f64::max) > 1.0;
        (log_moves || farthest < 0.5).then_some(StandingStart { site: site.index, log_moves, moves })
    };
    let each = site.scene.agents.iter().zip(&motions);
    Ok(each.filter_map(|(agent, states)| start(agent, states.as_ref()?)).collect())
}

/// Shares of vehicles that move off as in the log, and that stay as in the log.
///
/// # Errors
/// When a generator fails.
pub(super) fn standing(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Sheet> {
    let mut sheet = Sheet::new(
        "1g Standing starts",
        &[
            "Vehicles that stand on a lane at the start, in whole scenes that are generated without goals: the share \
           that moves by 1 m, of those that the log shows 5 m away and of those that it shows within 0.5 m.",
        ],
        &["ours"],
        &["of those that move off", "of those that stay"],
    );
    for own in judged {
        let all: Result<Vec<Vec<StandingStart>>> =
            sites.par_iter().map(|site| standing_starts(&own.generator, site, seed)).collect();
        let all: Vec<StandingStart> = all?.into_iter().flatten().collect();
        let share = |log_moves: bool| {
            let of = all.iter().filter(move |s| s.log_moves == log_moves);
            Cell::of(boot.estimate(of.map(|s| Value::flag(s.site, s.moves))), Form::Percent)
        };
        sheet.push([own.name.as_str()], vec![share(true), share(false)]);
    }
    Ok(sheet)
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
