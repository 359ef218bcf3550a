//! One moment of a run as a call of the generator: the known motion of each road user, and which of them replan.

use super::agents::{NEVER_PLANNED, PLAN_STEP_MS, Presence};
use super::state::Run;
use crate::planning::{INSTANTS, PER_INSTANT};
use crate::request::{React, Request, ShownLast, Stages};
use scene::geometry::direction;
use scene::routes::LaneGraph;
use scene::{
    Agent, AgentFutures, AgentId, AgentType, Conditions, Future, Generated, Meta, Sample, Scene, Start,
    State, Track,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A scene of the road users at present, each with its motion if nothing changes.
pub(super) struct RunMoment {
    scene: Arc<Scene>,
    /// Ids of the road users that may react.
    others: BTreeSet<AgentId>,
}

impl RunMoment {
    /// The present moment of a run whose plans all cover a window. `announced` motions of egos replace the
    /// expected ones.
    pub(super) fn of(run: &Run, graph: &LaneGraph, announced: &BTreeMap<usize, Vec<State>>) -> Self {
        let step = run.scene_step();
        let (mut agents, mut others) = (Vec::new(), BTreeSet::new());
        let mut egos = Sample::default();
        for (i, own) in run.agents.iter().enumerate() {
            let agent = &run.scene.agents[i];
            let states: Vec<Option<State>> = match &own.presence {
                Presence::Coming | Presence::Gone => continue,
                Presence::Driven(plan) => {
                    let mut ahead = plan.ahead(run.elapsed_ms);
                    if plan.planned_ms != NEVER_PLANNED && agent.kind() != AgentType::Pedestrian {
                        ahead[0] = rolling(&ahead[0]);
                    }
                    if agent.kind() != AgentType::Other {
                        others.insert(agent.id.clone());
                    }
                    ahead.into_iter().map(Some).collect()
                }
                Presence::Ego(motion) => {
                    let expected = || motion.expected(graph, agent.kind()).split_off(1);
                    let states = announced.get(&i).cloned().unwrap_or_else(expected);
                    let future = Future::bare(1.0, step + 1, states);
                    egos.agents.insert(agent.id.clone(), AgentFutures::of(0, vec![future]));
                    vec![Some(motion.state)]
                }
            };
            let track = Track { first_step: step, states, z_m: None };
            let conditions = conditions(agent, own.vias_passed);
            agents.push(Agent { role: None, track: track.into(), conditions, ..agent.clone() });
        }
        let generated = Generated { samples: vec![egos], ..Generated::default() };
        let Scene { time, map, signals, .. } = &*run.scene;
        let scene = Scene {
            id: None,
            name: String::new(),
            meta: Meta::default(),
            time: *time,
            map: map.clone(),
            signals: signals.clone(),
            agents,
            generated: Some(generated),
            extra: BTreeMap::new(),
        };
        Self { scene: Arc::new(scene), others }
    }

    /// The call in which these road users replan, and all others react to them and to the egos.
    pub(super) fn request(self, run: &Run, acting: &[usize]) -> Request {
        let ids: BTreeSet<AgentId> = acting.iter().map(|i| run.scene.agents[*i].id.clone()).collect();
        let others = self.others.difference(&ids).cloned().collect();
        let driven = acting.iter().filter_map(|i| Some((run.scene.agents[*i].id.clone(), run.driven(*i)?)));
        Request {
            agents: Some(ids),
            react: React::Only(others),
            start_step: run.scene_step(),
            seed: run.settings.seed,
            modes: 1,
            steps: run.settings.refinement,
            shown: driven.collect(),
            under_way: true,
            stages: Stages { judged: false, ..Stages::default() },
            ..Request::new(self.scene)
        }
    }
}

impl Run {
    /// The earlier plan of a road user, in the form in which the generator continues it.
    fn driven(&self, agent: usize) -> Option<ShownLast> {
        let Presence::Driven(plan) = &self.agents[agent].presence else { return None };
        if plan.planned_ms == NEVER_PLANNED {
            return None;
        }
        let at = |i: usize| plan.at(self.elapsed_ms + (i * PER_INSTANT) as u64 * PLAN_STEP_MS).position();
        Some(ShownLast { anchor: None, places: (1..=INSTANTS).map(at).collect() })
    }
}

/// The conditions of a road user that still apply once it drives.
fn conditions(agent: &Agent, vias_passed: usize) -> Conditions {
    let asked = &agent.conditions;
    let via = asked.via.get(vias_passed..).unwrap_or_default().to_vec();
    Conditions { start: Start::default(), via, ..asked.clone() }
}

/// In a bend the box centre swings out, so a plan begins with the velocity component along the heading.
fn rolling(state: &State) -> State {
    let ahead = direction(state.heading_rad);
    let velocity = ahead * state.velocity().dot(&ahead);
    State { vx_mps: velocity.x, vy_mps: velocity.y, ..*state }
}
