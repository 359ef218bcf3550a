//! Are goals met exactly, limits kept, and parked road users left alone?

use super::{Subset, answer, cases};
use anyhow::Result;
use experts::{Generator, ReachReport, Request};
use scene::motion::{MotionModel, MotionState, limit_excess};
use scene::{AgentType, Future, Scene, State, wrap_angle};
use serde::Serialize;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A goal that was not met.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Missed {
    pub scene: String,
    pub agent: String,
    pub position_m: f64,
    pub heading_deg: f64,
    pub speed_mps: f64,
    /// The generator said so.
    pub reported: bool,
    pub words: String,
}

/// Goals dragged to the log's end, one road user at a time, and whole scenes without goals.
#[derive(Clone, Debug, Default, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ReachTable {
    pub scenes: usize,
    /// Moving road users whose goal was dragged to the log's end, all fields fixed.
    pub dragged: usize,
    /// Within 0.1 m, 1 degree and 0.1 m/s.
    pub reached: usize,
    /// Not reached and reported unreachable.
    pub reported: usize,
    /// Futures looked at (all modes).
    pub futures: usize,
    pub outside_limits: usize,
    /// Vehicles that keep their place in the log.
    pub parked: usize,
    /// Of those, moved when whole scenes are generated without goals.
    pub parked_moved: usize,
    pub missed: Vec<Missed>,
}

/// Judges scenes.
///
/// # Errors
/// When the generator fails.
pub fn reach(generator: &Generator, scenes: &[Scene]) -> Result<ReachTable> {
    let mut table = ReachTable { scenes: scenes.len(), ..ReachTable::default() };
    for scene in scenes {
        drags(generator, scene, &mut table)?;
        parked(generator, scene, &mut table)?;
    }
    Ok(table)
}

fn drags(generator: &Generator, scene: &Scene, table: &mut ReachTable) -> Result<()> {
    let map = scene.map.clone();
    for case in cases(scene) {
        let mut changed = scene.clone();
        changed.map = map.clone();
        let goal = case.goal(scene, Subset::PosSpeedHeading);
        changed.agents[case.agent].conditions.goal = goal;
        let agent = &scene.agents[case.agent];
        let mut request = Request::new(Arc::new(changed));
        request.agents = Some(BTreeSet::from([agent.id.clone()]));
        let answer = answer(generator, request)?;
        let Some(futures) = answer.samples.first().and_then(|s| s.agents.get(&agent.id)) else { continue };
        let Some(start) = agent.state_at(0) else { continue };
        let model = MotionModel::new(agent.agent_type, agent.subtype, agent.size, start);
        table.futures += futures.modes.len();
        table.outside_limits += futures.modes.iter().filter(|f| is_outside(&model, &start, f)).count();
        table.dragged += 1;
        let end = futures.modes[futures.chosen].states[case.goal_step - 1];
        let position_m = goal.position.map_or(0.0, |p| (p - end.position()).norm());
        let heading_deg =
            goal.heading_rad.map_or(0.0, |h| wrap_angle(h - end.heading_rad).abs()).to_degrees();
        let speed_mps = goal.speed_mps.map_or(0.0, |v| (v - end.speed_mps()).abs());
        let met = position_m < 0.1 && heading_deg < 1.0 && speed_mps < 0.1;
        table.reached += usize::from(met);
        if !met {
            let words = match answer.resolved.get(&agent.id).map(|r| &r.reach) {
                Some(ReachReport::Unreachable { words, .. }) => Some(words.clone()),
                _ => None,
            };
            table.reported += usize::from(words.is_some());
            table.missed.push(Missed {
                scene: scene.name.clone(),
                agent: agent.id.clone(),
                position_m,
                heading_deg,
                speed_mps,
                reported: words.is_some(),
                words: words.unwrap_or_default(),
            });
        }
    }
    Ok(())
}

/// Whether a future breaks a limit of its road user.
fn is_outside(model: &MotionModel, start: &State, future: &Future) -> bool {
    let states = std::iter::once(start).chain(&future.states);
    let trajectory: Vec<MotionState> = states
        .map(|s| MotionState { position: s.position(), heading_rad: s.heading_rad, velocity: s.velocity() })
        .collect();
    limit_excess(model, &trajectory) > 0.0
}

fn parked(generator: &Generator, scene: &Scene, table: &mut ReachTable) -> Result<()> {
    let stands = |a: &&scene::Agent| {
        a.agent_type == AgentType::Vehicle
            && a.track.valid_steps().count() >= 80
            && a.track.extent_m() < 0.3
            && a.state_at(0).is_some_and(|s| s.speed_mps() < 0.3)
    };
    let parked: Vec<&scene::Agent> = scene.agents.iter().filter(stands).take(128).collect();
    if parked.is_empty() {
        return Ok(());
    }
    let mut request = Request::new(Arc::new(scene.clone()));
    request.agents = Some(parked.iter().map(|a| a.id.clone()).collect());
    let answer = answer(generator, request)?;
    let Some(sample) = answer.samples.first() else { return Ok(()) };
    for agent in parked {
        let (Some(start), Some(futures)) = (agent.state_at(0), sample.agents.get(&agent.id)) else {
            continue;
        };
        let future = &futures.modes[futures.chosen];
        table.parked += 1;
        let moved = future.states.iter().any(|s| (s.position() - start.position()).norm() > 1e-6);
        table.parked_moved += usize::from(moved);
    }
    Ok(())
}
