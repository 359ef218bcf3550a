//! Converts flags and a scene to the equivalent request.

use super::GenerateArgs;
use crate::cli::values::For;
use crate::cli::{Failure, output};
use api::GenerateRequest;
use api::generate::request::{AgentChoice, AllWord, ReactChoice};
use batch::who::{self, AgentSelector};
use formats::native::{ConditionsDoc, GoalDoc, Members};
use scene::scenarios::Casting;
use scene::{Agent, Conditions, STEP_S, Scene};
use std::collections::BTreeMap;

/// The request for one scene and seed; with a casting, only for its actor. `scored`: the reply needs scores.
///
/// # Errors
/// Exit 2 for ids that the scene does not have, 3 for a file of conditions that cannot be read.
pub fn request(
    args: &GenerateArgs,
    scene: &Scene,
    casting: Option<&Casting>,
    seed: u64,
    scored: bool,
) -> Result<GenerateRequest, Failure> {
    let step = args.start_step();
    let agents = match casting {
        Some(casting) => Some(AgentChoice::Ids(vec![casting.actor.clone()])),
        // Road users with a goal from the flags, else all: the request's own default.
        None if args.agents.is_empty() => None,
        None => {
            let ids = ids(&args.agents, scene, step, "--agents")?;
            Some(ids.map_or(AgentChoice::All(AllWord::All), AgentChoice::Ids))
        }
    };
    let react = match (args.react.as_slice(), casting) {
        ([], None) => ReactChoice::Whether(false),
        ([], Some(_)) => ReactChoice::Whether(true),
        (asked, _) => {
            ids(asked, scene, step, "--react")?.map_or(ReactChoice::Whether(true), ReactChoice::Ids)
        }
    };
    Ok(GenerateRequest {
        conditions: Members(conditions(args, scene, casting)?),
        agents,
        react,
        start_s: args.start_time,
        horizon_s: args.horizon,
        replan_interval_s: args.replan_interval,
        seed,
        samples: args.samples,
        modes: args.modes,
        diversity: args.diversity,
        steps: args.steps,
        score: scored,
        kept_futures: args.kept_futures,
        ..GenerateRequest::default()
    })
}

/// Conditions of the road users that a flag names; all others keep the scene's.
fn conditions(
    args: &GenerateArgs,
    scene: &Scene,
    casting: Option<&Casting>,
) -> Result<BTreeMap<String, ConditionsDoc>, Failure> {
    known(scene, "--goal", &args.goal)?;
    known(scene, "--via", &args.via)?;
    known(scene, "--start", &args.start)?;
    known(scene, "--size", &args.size)?;
    known(scene, "--type", &args.agent_type)?;
    known(scene, "--condition", &args.condition)?;
    let mut docs: BTreeMap<String, ConditionsDoc> = BTreeMap::new();
    for given in &args.condition {
        let bytes = output::read(&given.value)?;
        let wrong = |error: serde_json::Error| Failure::input(format!("{}: {error}", given.value.display()));
        docs.insert(given.id.clone(), serde_json::from_slice(&bytes).map_err(wrong)?);
    }
    if let Some(Casting { actor, conditions, .. }) = casting {
        docs.insert(actor.clone(), ConditionsDoc::from_conditions(conditions));
    }
    let mut change = |id: &str, set: &dyn Fn(&mut ConditionsDoc)| {
        let own = || scene.agent(id).map_or_else(Conditions::default, |agent| agent.conditions.clone());
        set(docs.entry(id.to_owned()).or_insert_with(|| ConditionsDoc::from_conditions(&own())));
    };
    for id in logged(args, scene)? {
        let Some(agent) = scene.agent(&id) else { continue };
        let Some(goal) = goal_of_log(args, agent) else {
            // A selector matches several road users, an id one.
            if args.goal_from_log.contains(&AgentSelector::Id(id.clone())) {
                let message =
                    format!("--goal-from-log {id}: no state is recorded 0.5 s or more after the start");
                return Err(Failure::usage(message));
            }
            continue;
        };
        change(&id, &|doc| (doc.goal, doc.frame) = (Some(goal.clone()), None));
    }
    for given in &args.goal {
        let asked = &given.value;
        change(&given.id, &|doc| (doc.goal, doc.frame) = (Some(asked.goal.clone()), Some(asked.frame)));
    }
    // Conditions of the flag replace those of the scene.
    for given in &args.via {
        change(&given.id, &|doc| doc.via.clear());
    }
    for given in &args.via {
        change(&given.id, &|doc| doc.via.push(given.value.clone()));
    }
    for given in &args.start {
        change(&given.id, &|doc| doc.start = Some(given.value.clone()));
    }
    for given in &args.size {
        change(&given.id, &|doc| (doc.length_m, doc.width_m) = (Some(given.value.0), Some(given.value.1)));
    }
    for given in &args.agent_type {
        change(&given.id, &|doc| doc.agent_type = Some(given.value));
    }
    Ok(docs)
}

/// The ids that a flag's selectors match; `None` for all.
fn ids(
    who: &[AgentSelector],
    scene: &Scene,
    start_step: usize,
    flag: &str,
) -> Result<Option<Vec<String>>, Failure> {
    who::ids(who, scene, start_step).map_err(|reason| Failure::usage(format!("{flag}: {reason}")))
}

/// Refuses conditions of a road user that the scene does not have.
fn known<T>(scene: &Scene, flag: &str, values: &[For<T>]) -> Result<(), Failure> {
    match values.iter().find(|given| scene.agent(&given.id).is_none()) {
        Some(given) => Err(Failure::usage(format!("{flag} {}: the scene has no such road user", given.id))),
        None => Ok(()),
    }
}

/// Ids of the road users whose goals come from the recording.
fn logged(args: &GenerateArgs, scene: &Scene) -> Result<Vec<String>, Failure> {
    if args.goal_from_log.is_empty() {
        return Ok(Vec::new());
    }
    let ids = ids(&args.goal_from_log, scene, args.start_step(), "--goal-from-log")?;
    let ids = ids.unwrap_or_else(|| scene.agents.iter().map(|agent| agent.id.clone()).collect());
    match ids.iter().find(|id| scene.agent(id).is_none()) {
        Some(unknown) => {
            Err(Failure::usage(format!("--goal-from-log {unknown}: the scene has no such road user")))
        }
        None => Ok(ids),
    }
}

/// The last recorded state within the horizon.
fn goal_of_log(args: &GenerateArgs, agent: &Agent) -> Option<GoalDoc> {
    let first = args.start_step();
    let last = first + (args.horizon / STEP_S).round() as usize;
    agent.track.at(first)?;
    let step = agent.track.valid_steps().rev().find(|step| *step <= last)?;
    let state = agent.track.at(step).filter(|_| step >= first + 5)?;
    Some(GoalDoc {
        x_m: Some(state.x_m),
        y_m: Some(state.y_m),
        heading_rad: Some(scene::wrap_angle(state.heading_rad)),
        speed_mps: Some(state.speed_mps()),
        time_s: Some(step as f64 * STEP_S),
        ..GoalDoc::default()
    })
}
