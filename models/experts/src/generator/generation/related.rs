//! Resolves goals that are relative to another agent before a call plans anything: each becomes an ordinary
//! goal.
//!
//! If the other agent keeps its motion, the goal follows that motion. If the call regenerates the other
//! agent, a call of its own plans that agent first, with the goals that depend on it left free. The agent
//! then keeps the future that this first call shows.

use crate::generator::extrapolation::extrapolated;
use crate::maps::KnownMap;
use crate::planning::world::AgentAtStart;
use crate::request::{Answer, GenerateError, React, Request, Resolved};
use scene::message::Message;
use scene::relation::{OtherMotion, RelativeGoal, place};
use scene::{AgentFutures, AgentId, AgentType, Goal, STEP_S, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What a call needs to know about relative goals.
#[derive(Default)]
pub(super) struct Related {
    /// Why the goal of an agent could not be resolved, by index into the scene's agents.
    pub(super) unrelated: BTreeMap<usize, Message>,
    /// The agents that were planned first: their futures and their reports.
    first: BTreeMap<AgentId, (AgentFutures, Option<Resolved>)>,
}

impl Related {
    /// The call with ordinary goals, and what it needs to know about the relations. `plan` runs a call
    /// without relations.
    ///
    /// # Errors
    /// Those of the calls that plan the reference agents first.
    pub(super) fn of(
        map: &KnownMap,
        request: Request,
        plan: impl Fn(Request) -> Result<Answer, GenerateError>,
    ) -> Result<(Request, Self), GenerateError> {
        let mut related = Self::default();
        if request.scene.agents.iter().all(|agent| agent.conditions.relation.is_none()) {
            return Ok((request, related));
        }
        let mut request = with_dependent(request);
        let mut open: BTreeSet<usize> = (0..request.scene.agents.len())
            .filter(|i| request.scene.agents[*i].conditions.relation.is_some() && takes_part(&request, *i))
            .collect();
        while !open.is_empty() {
            let known: Vec<usize> = open.iter().copied().filter(|i| has_known_leader(&request, *i)).collect();
            if known.is_empty() {
                let first = plan(first_call(&request, &open))?;
                let leaders = leaders(&request, &open);
                let Some(mut futures) = first.samples.into_iter().next().map(|sample| sample.agents) else {
                    break;
                };
                for id in leaders {
                    let Some(future) = futures.remove(&id) else { continue };
                    let states = future.modes.get(future.chosen).map(|mode| mode.states.clone());
                    request.pinned.insert(id.clone(), states.unwrap_or_default());
                    related.first.insert(id.clone(), (future, first.resolved.get(&id).cloned()));
                }
                if open.iter().all(|i| !has_known_leader(&request, *i)) {
                    break;
                }
            }
            let goals: Vec<(usize, Result<Goal, Message>)> =
                known.iter().filter_map(|i| Some((*i, goal_of(map, &request, *i)?))).collect();
            let mut scene = Scene::clone(&request.scene);
            for (i, goal) in goals {
                scene.agents[i].conditions.goal = goal.unwrap_or_else(|message| {
                    related.unrelated.insert(i, message);
                    Goal::default()
                });
            }
            request.scene = Arc::new(scene);
            open.retain(|i| !known.contains(i));
        }
        Ok((request, related))
    }

    /// Puts the futures of the agents that were planned first into the answer, which otherwise omits kept
    /// futures.
    pub(super) fn restore(&self, futures: &mut BTreeMap<AgentId, AgentFutures>) {
        futures.extend(self.first.iter().map(|(id, (first, _))| (id.clone(), first.clone())));
    }

    /// Reports on the agents that were planned first.
    pub(super) fn reports(&self) -> impl Iterator<Item = (&AgentId, &Resolved)> {
        self.first.iter().filter_map(|(id, (_, resolved))| Some((id, resolved.as_ref()?)))
    }
}

fn is_asked(request: &Request, id: &AgentId) -> bool {
    request.agents.as_ref().is_none_or(|asked| asked.contains(id))
}

fn may_react(request: &Request, id: &AgentId) -> bool {
    match &request.react {
        React::Nobody => false,
        React::Everyone => true,
        React::Only(ids) => ids.contains(id),
    }
}

fn takes_part(request: &Request, agent: usize) -> bool {
    let id = &request.scene.agents[agent].id;
    is_asked(request, id) || may_react(request, id)
}

fn leader(request: &Request, agent: usize) -> Option<&AgentId> {
    request.scene.agents[agent].conditions.relation.as_ref().map(|relation| &relation.to)
}

/// Adds to the call the agents that may react and whose goal is relative to a regenerated one: they keep the
/// relation.
fn with_dependent(mut request: Request) -> Request {
    loop {
        let agents = 0..request.scene.agents.len();
        let dependent = agents.filter(|i| leader(&request, *i).is_some_and(|to| is_asked(&request, to)));
        let id = |i: usize| request.scene.agents[i].id.clone();
        let more: Vec<AgentId> =
            dependent.map(id).filter(|id| !is_asked(&request, id) && may_react(&request, id)).collect();
        match &mut request.agents {
            Some(asked) if !more.is_empty() => asked.extend(more),
            _ => return request,
        }
    }
}

/// Whether the call regenerates this agent. An agent that enters later, or cannot move, keeps its motion.
fn is_planned(request: &Request, id: &AgentId) -> bool {
    let agents = &request.scene.agents;
    let there = agents.iter().position(|agent| agent.id == *id).is_some_and(|i| {
        let agent = &agents[i];
        let start = AgentAtStart::at(i, agent, &agent.conditions, request.start_step);
        start.is_some() && agent.kind() != AgentType::Other
    });
    there && is_asked(request, id) && !request.pinned.contains_key(id)
}

/// Whether the motion of the agent's reference does not depend on this call.
fn has_known_leader(request: &Request, agent: usize) -> bool {
    leader(request, agent).is_none_or(|to| !is_planned(request, to))
}

/// The agents to plan first: goals of other agents are relative to them, and their own goals are not relative to an
/// agent in `open`.
fn leaders(request: &Request, open: &BTreeSet<usize>) -> BTreeSet<AgentId> {
    let is_open = |id: &AgentId| open.iter().any(|i| request.scene.agents[*i].id == *id);
    open.iter().filter_map(|i| leader(request, *i)).filter(|to| !is_open(to)).cloned().collect()
}

/// The call with the open goals free, and without relations.
fn first_call(request: &Request, open: &BTreeSet<usize>) -> Request {
    let mut scene = Scene::clone(&request.scene);
    for (i, agent) in scene.agents.iter_mut().enumerate() {
        agent.conditions.relation = None;
        if open.contains(&i) {
            agent.conditions.goal = Goal::default();
        }
    }
    Request { scene: Arc::new(scene), samples: 1, feedback: None, ..request.clone() }
}

/// The ordinary goal of an agent, or why there is none.
fn goal_of(map: &KnownMap, request: &Request, agent: usize) -> Option<Result<Goal, Message>> {
    let own = &request.scene.agents[agent];
    let relation = own.conditions.relation.as_ref()?;
    let other = request.scene.agent(&relation.to)?;
    let (start_step, goal) = (request.start_step, own.conditions.goal);
    let end_step = start_step + request.horizon_steps;
    let due_step = goal.time_s.map_or(end_step, |time_s| (time_s / STEP_S).round() as usize);
    let last = end_step.max(due_step);
    let pinned = request.pinned.get(&other.id).map(Vec::as_slice);
    let (track, _) = extrapolated(&request.scene, other, pinned, start_step, last);
    let motion = OtherMotion {
        agent_type: other.kind(),
        size: other.conditions.size_of(other.size),
        at: &|step| track.at(step).copied(),
    };
    let asked = RelativeGoal {
        relation,
        goal,
        agent_type: own.kind(),
        length_m: own.conditions.size_of(own.size).length_m,
        start_step,
        due_step,
        end_step,
    };
    Some(place(&map.graph, &asked, &motion))
}
