//! The scenes that windows are planned from: who is where, and what each is asked.

use super::Generation;
use crate::generator::actor::{Guessed, carried};
use crate::generator::halfway::{as_goal, on_the_way};
use crate::planning::world::{Present, World};
use crate::request::{GenerateError, Intermediate, Request};
use scene::geometry::direction;
use scene::{AgentId, AgentType, Goal, HORIZON_STEPS, Meta, STEP_S, Scene, Start, State, Track, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

/// A start within this of the regenerated ones may react at all, metres.
const REACT_WITHIN_M: f64 = 120.0;

impl Generation<'_> {
    /// The scene as it stands where a later window starts: each road user's track is what it has reached
    /// (or, kept, what it does in the window), and what was fixed about starts is behind.
    pub(super) fn reached(&self, number: usize) -> Scene {
        let from = self.spans[number].start;
        let step = self.request.start_step + from;
        let agents = self.base.agents.iter().enumerate().map(|(i, agent)| {
            let mut states: Vec<Option<State>> = match self.progress.get(&i) {
                Some(progress) => vec![progress.executed.last().copied()],
                None => (step..=step + HORIZON_STEPS).map(|at| agent.track.at(at).copied()).collect(),
            };
            // A recorded velocity is left as it is: its sideways part is noise.
            let made = self.progress.contains_key(&i) || self.continuing.contains(&i);
            let on_foot = agent.kind() == AgentType::Pedestrian;
            if let Some(Some(first)) = states.first_mut()
                && made
                && !on_foot
            {
                *first = rolling(first);
            }
            let mut conditions = agent.conditions.clone();
            conditions.start = Start::default();
            scene::Agent {
                id: agent.id.clone(),
                role: None,
                track: Track { first_step: step, states, z_m: None },
                conditions,
                ..*agent
            }
        });
        bare(&self.base, agents.collect())
    }

    /// Turns goals into what this window can be asked: those that are past are dropped, those due after
    /// its end become the state on the way.
    pub(super) fn aim(&mut self, number: usize, scene: &mut Arc<Scene>) {
        self.sent.clear();
        let from = self.spans[number].start;
        let step = self.request.start_step + from;
        let mut goals: Vec<(usize, Goal)> = Vec::new();
        {
            let shared = scene.clone();
            let world = World::new(&shared, self.map.graph.clone(), step);
            for (i, agent) in self.request.scene.agents.iter().enumerate() {
                let goal = &agent.conditions.goal;
                let left = self.due(i) - from as isize;
                if goal.is_free() {
                    continue;
                }
                if left <= 0 {
                    goals.push((i, Goal::default()));
                } else if left as usize <= HORIZON_STEPS {
                    let time_s = Some((step as isize + left) as f64 * STEP_S);
                    // As it was fixed where nothing has to be said, so that no copy is made.
                    if goal.step_in_window(step as f64 * STEP_S) != left as usize {
                        goals.push((i, Goal { time_s, ..*goal }));
                    }
                } else if let Some(who) = world.present.iter().find(|p| p.index == i) {
                    let state = on_the_way(&world, who, goal, left as usize);
                    let time_s = (step + HORIZON_STEPS) as f64 * STEP_S;
                    let kind = world.model(who).kind;
                    let on_the_way = as_goal(&state, kind, goal, left as usize, time_s);
                    if !on_the_way.is_free() {
                        self.sent.insert(i, Intermediate { window: number, time_s, state, reached: false });
                    }
                    goals.push((i, on_the_way));
                }
            }
        }
        if goals.is_empty() {
            return;
        }
        if Arc::strong_count(scene) > 1 {
            let own = bare(scene, scene.agents.clone());
            *scene = Arc::new(Scene { generated: scene.generated.clone(), ..own });
        }
        if let Some(own) = Arc::get_mut(scene) {
            for (i, goal) in goals {
                own.agents[i].conditions.goal = goal;
            }
        }
    }
}

/// A scene of these road users, with what planning needs of the rest.
fn bare(scene: &Scene, agents: Vec<scene::Agent>) -> Scene {
    Scene {
        id: None,
        name: String::new(),
        meta: Meta::default(),
        time: scene.time,
        map: scene.map.clone(),
        signals: scene.signals.clone(),
        agents,
        generated: None,
        extra: BTreeMap::new(),
    }
}

/// The call's scene with the motion of those that keep theirs known to the end of the last window, and
/// from where on that is a guess.
pub(super) fn known_to_the_end(
    request: &Request,
    regenerated: &BTreeSet<usize>,
    spans: &[Range<usize>],
) -> (Arc<Scene>, BTreeMap<usize, Guessed>) {
    let scene = &request.scene;
    let start = request.start_step;
    let last = start + spans.last().map_or(0, |s| s.start) + HORIZON_STEPS;
    let mut guessed = BTreeMap::new();
    let agents = scene.agents.iter().enumerate().map(|(i, agent)| {
        let pinned = request.pinned.get(&agent.id).map(Vec::as_slice);
        if regenerated.contains(&i) && pinned.is_none() {
            return agent.clone();
        }
        let (track, since) = carried(scene, agent, pinned, start, last);
        guessed.extend(since.map(|since| (i, since)));
        scene::Agent { track, ..agent.clone() }
    });
    (Arc::new(bare(scene, agents.collect())), guessed)
}

/// A reached state as the start of the next window. The box centre of what drives swings out in a bend;
/// its wheels' own speed, which goes on unbroken, is the part along the heading.
fn rolling(state: &State) -> State {
    let ahead = direction(state.heading_rad);
    let velocity = ahead * state.velocity().dot(&ahead);
    State { vx_mps: velocity.x, vy_mps: velocity.y, ..*state }
}

/// Indices of agents by id; all must be able to move.
pub(super) fn find(
    scene: &Scene,
    movable: &BTreeSet<usize>,
    ids: &BTreeSet<AgentId>,
) -> Result<BTreeSet<usize>, GenerateError> {
    ids.iter()
        .map(|id| {
            let index = scene.agents.iter().position(|a| a.id == *id);
            let index = index.ok_or_else(|| GenerateError::UnknownAgent(id.clone()))?;
            let missing = GenerateError::StartMissing { agent: id.clone(), field: "position" };
            movable.contains(&index).then_some(index).ok_or(missing)
        })
        .collect()
}

pub(super) fn within_reach(
    world: &World<'_>,
    movable: &BTreeSet<usize>,
    regenerated: &BTreeSet<usize>,
) -> BTreeSet<usize> {
    let starts: Vec<Vec2> =
        world.present.iter().filter(|p| regenerated.contains(&p.index)).map(|p| p.start.position()).collect();
    let near = |p: &&Present| starts.iter().any(|s| (s - p.start.position()).norm() < REACT_WITHIN_M);
    world
        .present
        .iter()
        .filter(|p| movable.contains(&p.index) && !regenerated.contains(&p.index))
        .filter(near)
        .map(|p| p.index)
        .collect()
}
