//! A run: traffic that is stepped, beside road users that somebody else drives.
//!
//! The caller prescribes some road users, the *egos*: it says at each step where they are, and may announce where they
//! go. The run drives all others. They know what has happened and what egos announce, and nothing else. Each holds a
//! plan of nine seconds, drives it, and plans anew at an interval. In between it answers at once, by another pace on
//! its own path, when a changed motion of another would meet its own.
//!
//! A run is a value: it has no thread, clock or file. Its state is a [snapshot](Run::snapshot) of bytes.
//!
//! ```
//! use experts::{Cancel, EgoState, Engine, Run, RunSettings};
//! use scene::map::{Lane, LaneMap};
//! use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};
//!
//! // Two cars on a straight lane; the front one is the caller's.
//! let lane = Lane::street("east", vec![Vec2::new(0.0, 0.0), Vec2::new(400.0, 0.0)]);
//! let at = |x_m: f64| State { x_m, vx_mps: 10.0, ..State::default() };
//! let car = |id: &str, x_m: f64| Agent::bare(id, AgentType::Vehicle, Subtype::Car, vec![Some(at(x_m))]);
//! let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
//! let scene = Scene::bare("two cars", map, vec![car("mine", 60.0), car("theirs", 30.0)]);
//!
//! let engine = Engine::built_in()?.generator;
//! let egos = ["mine".to_owned()];
//! let mut run = Run::new(scene.into(), &egos, RunSettings::default(), &engine, &Cancel::default())?;
//! // Mine brakes by 4 m/s2 and says nothing.
//! for i in 1..=20 {
//!     let t = 0.1 * f64::from(i);
//!     let mine = State { x_m: 60.0 + 10.0 * t - 2.0 * t * t, vx_mps: 10.0 - 4.0 * t, ..State::default() };
//!     let step = run.step(&engine, &[EgoState::new("mine", mine)], &Cancel::default())?;
//!     assert!(step.faults.is_empty());
//! }
//! assert!(run.state("theirs").unwrap().speed_mps() < 9.0, "it brakes too");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agents;
mod borders;
mod contacts;
mod moment;
mod settings;
mod snapshot;
mod stepping;

pub use borders::DepartureReason;
pub use contacts::RunFault;
pub use settings::{
    EgoState, MOST_ANNOUNCED, MOST_RUN_MS, PLAN_INTERVAL_MS, RUN_STEP_MS, RunError, RunSettings,
};
pub use snapshot::{SnapshotError, VERSION_AT};

use crate::cancel::Cancel;
use crate::generator::Generator;
use crate::planning::world::AgentAtStart;
use agents::{DrivenPlan, EgoMotion, Presence, RunAgent};
use moment::RunMoment;
use scene::judge::Reaction;
use scene::{AgentId, AgentType, ContentHash, HORIZON_STEPS, STEP_S, Scene, State};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A run at one moment. A clone is a branch: it goes its own way from there.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scene, with the times of goals that have none.
    scene: Arc<Scene>,
    /// Of the scene as it was given.
    identity: ContentHash,
    settings: RunSettings,
    /// Steps that were made.
    number: u64,
    /// Milliseconds since the start.
    elapsed_ms: u64,
    /// One entry a road user of the scene.
    agents: Vec<RunAgent>,
}

/// A road user that changed its plan because of another.
#[derive(Clone, Debug, PartialEq)]
pub struct RunChange {
    /// The road user.
    pub agent: AgentId,
    /// What it does, and because of whom.
    pub reaction: Reaction,
}

/// A road user that has left.
#[derive(Clone, Debug, PartialEq)]
pub struct RunDeparture {
    /// The road user.
    pub agent: AgentId,
    /// Why.
    pub reason: DepartureReason,
}

/// What one step came to.
#[derive(Clone, Debug, PartialEq)]
pub struct RunStep {
    /// The step, from 1 on; 0 for the start.
    pub number: u64,
    /// Scene time at its end, seconds.
    pub time_s: f64,
    /// Everybody who is there, egos too, in the order of the scene.
    pub states: Vec<(AgentId, State)>,
    /// Who answers to whom, by id.
    pub changes: Vec<RunChange>,
    /// What goes wrong in this step and did not before.
    pub faults: Vec<RunFault>,
    /// Who has come in, in the order of the scene.
    pub entered: Vec<AgentId>,
    /// Who has left, in the order of the scene.
    pub left: Vec<RunDeparture>,
}

/// What the others would do if egos drove these plans.
#[derive(Clone, Debug, PartialEq)]
pub struct RunPeek {
    /// The states of the others from 0.1 s after the present on, 0.1 s apart, to nine seconds.
    pub futures: BTreeMap<AgentId, Vec<State>>,
    /// Who would answer, by id.
    pub changes: Vec<RunChange>,
    /// The first collision of each ego with each other.
    pub faults: Vec<RunFault>,
}

impl Run {
    /// Begins a run: every road user that is there plans for the first time.
    ///
    /// # Errors
    /// Settings out of range, egos that are unknown, absent at the start or named twice, and the generator's.
    pub fn new(
        scene: Arc<Scene>,
        egos: &[AgentId],
        settings: RunSettings,
        generator: &Generator,
        cancel: &Cancel,
    ) -> Result<Self, RunError> {
        settings.check()?;
        let identity = identity(&scene);
        let agents = (0..scene.agents.len())
            .map(|i| RunAgent { presence: present_at(&scene, i, settings.start_step), vias_passed: 0 });
        let agents = agents.collect();
        let scene = with_goal_times(scene, settings.start_step);
        let mut run = Self { scene, identity, settings, number: 0, elapsed_ms: 0, agents };
        for id in egos {
            let at = run.index(id)?;
            run.agents[at].presence = match &run.agents[at].presence {
                Presence::Driven(plan) => {
                    Presence::Ego(EgoMotion { state: plan.at(0), plan: Vec::new(), brakes_mps2: 0.0 })
                }
                Presence::Ego(_) => return Err(RunError::EgoTwice(id.clone())),
                Presence::Coming | Presence::Gone => return Err(RunError::EgoAbsent(id.clone())),
            };
        }
        run.plan_all(generator, cancel)?;
        Ok(run)
    }

    /// One step: the egos are where this says, the others go on, and answer to what they see then.
    ///
    /// # Errors
    /// States that are missing, not asked for or no states, a run that is over, and the generator's. The run stays as
    /// it was then.
    pub fn step(
        &mut self,
        generator: &Generator,
        egos: &[EgoState],
        cancel: &Cancel,
    ) -> Result<RunStep, RunError> {
        let egos = self.checked(egos)?;
        let mut next = self.clone();
        let step = next.advance(generator, egos, cancel)?;
        *self = next;
        Ok(step)
    }

    /// What the others would do if egos drove these plans from where they are: states 0.1 s apart, the first 0.1 s after
    /// the present. An ego that is left out does what it has announced. The run does not change.
    ///
    /// # Errors
    /// As [`Run::step`].
    pub fn peek(
        &self,
        generator: &Generator,
        plans: &BTreeMap<AgentId, Vec<State>>,
        cancel: &Cancel,
    ) -> Result<RunPeek, RunError> {
        let mut branch = self.clone();
        let graph = generator.maps().graph(&self.scene.map);
        branch.carry_on(&graph);
        let mut announced = BTreeMap::new();
        for (id, plan) in plans {
            let at = self.index(id)?;
            let Presence::Ego(motion) = &self.agents[at].presence else {
                return Err(RunError::NotAnEgo(id.clone()));
            };
            let told = EgoState { id: id.clone(), state: motion.state, plan: plan.clone() };
            told.check()?;
            let motion = EgoMotion { plan: told.plan, ..motion.clone() };
            announced.insert(at, motion.expected(&graph, self.scene.agents[at].kind()).split_off(1));
        }
        let request = RunMoment::of(&branch, &graph, &announced).request(&branch, &[]);
        let changes = branch.answer(generator, request, &[], cancel)?;
        let mut futures = BTreeMap::new();
        for (own, agent) in branch.agents.iter().zip(&self.scene.agents) {
            if let Presence::Driven(plan) = &own.presence {
                futures.insert(agent.id.clone(), plan.ahead(self.elapsed_ms).split_off(1));
            }
        }
        let faults = self.peeked_faults(&graph, &announced, &futures);
        Ok(RunPeek { futures, changes, faults })
    }

    /// The present as a step: who is there. Nobody has changed, entered or left.
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

    /// The state of a road user that is there.
    pub fn state(&self, id: &str) -> Option<State> {
        let at = self.index(id).ok()?;
        self.agents[at].presence.state(self.elapsed_ms)
    }

    /// The ids of the egos, in the order of the scene.
    pub fn egos(&self) -> Vec<&AgentId> {
        let all = self.agents.iter().zip(&self.scene.agents);
        all.filter(|(own, _)| matches!(own.presence, Presence::Ego(_))).map(|(_, agent)| &agent.id).collect()
    }

    /// Steps that were made.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Scene time, seconds.
    pub fn time_s(&self) -> f64 {
        self.settings.start_step as f64 * STEP_S + self.elapsed_ms as f64 / 1e3
    }

    /// How it goes.
    pub fn settings(&self) -> &RunSettings {
        &self.settings
    }

    /// The scene that it runs in.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// About how many bytes of memory it takes beside its scene.
    pub fn bytes(&self) -> usize {
        let states = |own: &RunAgent| match &own.presence {
            Presence::Driven(plan) => plan.states.len(),
            Presence::Ego(motion) => motion.plan.len(),
            Presence::Coming | Presence::Gone => 0,
        };
        let all: usize = self.agents.iter().map(states).sum();
        size_of::<Self>() + self.agents.len() * size_of::<RunAgent>() + all * size_of::<State>()
    }

    /// The step of the scene at present, a half one cut off.
    fn scene_step(&self) -> usize {
        self.settings.start_step + (self.elapsed_ms / agents::PLAN_STEP_MS) as usize
    }

    fn index(&self, id: &str) -> Result<usize, RunError> {
        let at = self.scene.agents.iter().position(|agent| agent.id == id);
        at.ok_or_else(|| RunError::UnknownAgent(id.to_owned()))
    }
}

/// Names what a run depends on in its scene: the map, the signals and the road users.
fn identity(scene: &Scene) -> ContentHash {
    ContentHash::of(&(scene.map.hash(), &scene.signals, &scene.agents))
}

/// Goals without a time are due after nine seconds, as in a call.
fn with_goal_times(scene: Arc<Scene>, start_step: usize) -> Arc<Scene> {
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

/// Whether a road user is there when the run begins.
fn present_at(scene: &Scene, agent: usize, start_step: usize) -> Presence {
    let own = &scene.agents[agent];
    match AgentAtStart::at(agent, own, &own.conditions, start_step) {
        Some(there) if own.kind() == AgentType::Other => {
            // What is shown and never planned does what is recorded.
            let recorded = (start_step + 1..).map_while(|step| own.track.at(step).copied());
            let states = std::iter::once(there.start).chain(recorded).collect();
            Presence::Driven(DrivenPlan { states, ..DrivenPlan::fresh(0, there.start) })
        }
        Some(there) => Presence::Driven(DrivenPlan::fresh(0, there.start)),
        None if own.track.last_valid_step().is_some_and(|last| last > start_step) => Presence::Coming,
        None => Presence::Gone,
    }
}
