//! The state of a run, and the result of a step.

use super::agents::{PLAN_STEP_MS, Presence, RunAgent};
use super::borders::DepartureReason;
use super::contacts::RunFault;
use super::error::RunError;
use super::settings::{MOST_RUN_MS, RunSettings};
use scene::judge::Reaction;
use scene::{AgentId, ContentHash, HORIZON_STEPS, STEP_S, Scene, State};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A run at one moment. A clone is a branch that continues independently.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scene; goals without a time have got one.
    pub(super) scene: Arc<Scene>,
    /// Hash of the scene as it was given.
    pub(super) identity: ContentHash,
    pub(super) settings: RunSettings,
    /// Number of steps made.
    pub(super) number: u64,
    /// Milliseconds since the start.
    pub(super) elapsed_ms: u64,
    /// One entry per road user of the scene.
    pub(super) agents: Vec<RunAgent>,
}

/// A road user that changed its plan because of another.
#[derive(Clone, Debug, PartialEq)]
pub struct RunChange {
    /// The road user.
    pub agent: AgentId,
    /// What it does, and its cause.
    pub reaction: Reaction,
}

/// A road user that has left.
#[derive(Clone, Debug, PartialEq)]
pub struct RunDeparture {
    /// The road user.
    pub agent: AgentId,
    /// Why it left.
    pub reason: DepartureReason,
}

/// Result of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct RunStep {
    /// The step, from 1 on; 0 for the start.
    pub number: u64,
    /// Scene time at its end, seconds.
    pub time_s: f64,
    /// All present road users, egos included, in the order of the scene.
    pub states: Vec<(AgentId, State)>,
    /// Road users that changed their plan, by id.
    pub changes: Vec<RunChange>,
    /// Faults that begin in this step.
    pub faults: Vec<RunFault>,
    /// Road users that entered, in the order of the scene.
    pub entered: Vec<AgentId>,
    /// Road users that left, in the order of the scene.
    pub left: Vec<RunDeparture>,
}

/// What the others would do if egos drove these plans.
#[derive(Clone, Debug, PartialEq)]
pub struct RunPeek {
    /// The states of the others from 0.1 s after the present on, 0.1 s apart, to nine seconds.
    pub futures: BTreeMap<AgentId, Vec<State>>,
    /// Road users that would react, by id.
    pub changes: Vec<RunChange>,
    /// The first collision of each ego with each other.
    pub faults: Vec<RunFault>,
}

impl Run {
    /// The present as a step, with the states only: no change, entry or departure.
    pub fn present(&self) -> RunStep {
        let at = |(own, agent): (&RunAgent, &scene::Agent)| {
            Some((agent.id.clone(), own.presence.state(self.elapsed_ms)?))
        };
        RunStep {
            number: self.number,
            time_s: self.time_s(),
            states: self.agents.iter().zip(&self.scene.agents).filter_map(at).collect(),
            changes: Vec::new(),
            faults: Vec::new(),
            entered: Vec::new(),
            left: Vec::new(),
        }
    }

    /// The state of a present road user.
    pub fn state(&self, id: &str) -> Option<State> {
        let at = self.index(id).ok()?;
        self.agents[at].presence.state(self.elapsed_ms)
    }

    /// The ids of the egos, in the order of the scene.
    pub fn egos(&self) -> Vec<&AgentId> {
        let all = self.agents.iter().zip(&self.scene.agents);
        all.filter(|(own, _)| matches!(own.presence, Presence::Ego(_))).map(|(_, agent)| &agent.id).collect()
    }

    /// Number of steps made.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Scene time, seconds.
    pub fn time_s(&self) -> f64 {
        self.settings.start_step as f64 * STEP_S + self.elapsed_ms as f64 / 1e3
    }

    /// Number of remaining steps.
    pub fn steps_left(&self) -> u64 {
        MOST_RUN_MS.saturating_sub(self.elapsed_ms) / u64::from(self.settings.step_ms)
    }

    /// The settings of the run.
    pub fn settings(&self) -> &RunSettings {
        &self.settings
    }

    /// The scene of the run.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Approximate bytes of memory, without the scene.
    pub fn bytes(&self) -> usize {
        let states = |own: &RunAgent| match &own.presence {
            Presence::Driven(plan) => plan.states.len(),
            Presence::Ego(motion) => motion.plan.len(),
            Presence::Coming | Presence::Gone => 0,
        };
        let all: usize = self.agents.iter().map(states).sum();
        size_of::<Self>() + self.agents.len() * size_of::<RunAgent>() + all * size_of::<State>()
    }

    /// The present step of the scene, rounded down.
    pub(super) fn scene_step(&self) -> usize {
        self.settings.start_step + (self.elapsed_ms / PLAN_STEP_MS) as usize
    }

    pub(super) fn index(&self, id: &str) -> Result<usize, RunError> {
        let at = self.scene.agents.iter().position(|agent| agent.id == id);
        at.ok_or_else(|| RunError::UnknownAgent(id.to_owned()))
    }
}

/// Hash of the parts of a scene that a run depends on: the map, the signals and the road users.
pub(super) fn identity(scene: &Scene) -> ContentHash {
    ContentHash::of(&(scene.map.hash(), &scene.signals, &scene.agents))
}

/// Sets a time of nine seconds for goals without one, as in a call.
pub(super) fn with_goal_times(scene: Arc<Scene>, start_step: usize) -> Arc<Scene> {
    let lacks = |agent: &scene::Agent| {
        let goal = &agent.conditions.goal;
        !goal.is_free() && goal.time_s.is_none()
    };
    if !scene.agents.iter().any(lacks) {
        return scene;
    }
    let mut scene = Scene::clone(&scene);
    for agent in scene.agents.iter_mut().filter(|agent| lacks(agent)) {
        agent.conditions.goal.time_s = Some((start_step + HORIZON_STEPS) as f64 * STEP_S);
    }
    Arc::new(scene)
}
