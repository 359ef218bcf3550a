//! One moment of a scene as input of planning: the agents present at the start, and the lane graph.

use super::stop_line::StopLine;
use crate::tuning::{self, Tuning};
use scene::geometry::obb::OrientedBox;
use scene::motion::{MotionModel, Target};
use scene::routes::speed::{LaneSignal, Obstacle};
use scene::routes::{LaneGraph, Pose};
use scene::score::Drivable;
use scene::{Agent, AgentType, Conditions, Goal, HORIZON_STEPS, Scene, Size, State, Vec2, Via};
use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;

/// How the futures of a road user are planned. An evaluation switches parts off to measure their effect;
/// users get all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Planning {
    /// Anchors follow lanes; otherwise every road user is planned as if no lane were near.
    pub routes: bool,
    /// Projects motions onto the goal. Otherwise only the limits are enforced, and the goal is only an input
    /// of the networks.
    pub projection: bool,
}

impl Default for Planning {
    fn default() -> Self {
        Self { routes: true, projection: true }
    }
}

/// A road user at the start of a window.
#[derive(Clone, Debug)]
pub struct AgentAtStart {
    /// Index into the scene's agents.
    pub index: usize,
    /// Type that selects the expert (a condition may override the agent's own).
    pub agent_type: AgentType,
    /// Box, with conditions applied.
    pub size: Size,
    /// Pose and velocity at the start, with conditions applied.
    pub start: State,
}

/// A via point as a window sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waypoint {
    /// As the user fixed it, with its time counted from the window's start. The time is free if it lies
    /// beyond the window.
    pub via: Via,
    /// Step of the window at which it is passed, if that is fixed: 1 ..= [`HORIZON_STEPS`].
    pub step: Option<usize>,
}

/// A scene that is borrowed or shared.
#[derive(Clone, Debug)]
pub enum SceneHandle<'a> {
    /// Borrowed.
    Borrowed(&'a Scene),
    /// Shared.
    Shared(Arc<Scene>),
}

impl Deref for SceneHandle<'_> {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        match self {
            Self::Borrowed(scene) => scene,
            Self::Shared(scene) => scene,
        }
    }
}

impl<'a> From<&'a Scene> for SceneHandle<'a> {
    fn from(scene: &'a Scene) -> Self {
        Self::Borrowed(scene)
    }
}

impl<'a> From<&'a Arc<Scene>> for SceneHandle<'a> {
    fn from(scene: &'a Arc<Scene>) -> Self {
        Self::Borrowed(scene)
    }
}

impl From<Arc<Scene>> for SceneHandle<'_> {
    fn from(scene: Arc<Scene>) -> Self {
        Self::Shared(scene)
    }
}

/// A scene at one step. It contains nothing later than this step, except the user's conditions and later
/// signal states. The networks do not see those signal states; they only make agents wait at red signals.
pub struct World<'a> {
    /// The scene.
    pub scene: SceneHandle<'a>,
    /// Its map's lanes with their links.
    pub graph: Arc<LaneGraph>,
    /// Start of the window, scene step.
    pub step: usize,
    /// Road users present at the start, by id.
    pub present: Vec<AgentAtStart>,
    /// The conditions in this window, one per agent of the scene. They may differ from the scene's, for
    /// example by a subgoal.
    pub conditions: Vec<Conditions>,
    /// Signals of lanes in the graph.
    pub signals: Vec<LaneSignal>,
    /// Seconds each signal has been in its state.
    pub signal_ages_s: Vec<f64>,
    /// Stop lines of all lane signals, with their states in this window.
    pub stop_lines: Vec<StopLine>,
    /// How futures are planned.
    pub planning: Planning,
    /// The tuned numbers of planning.
    pub tuning: &'a Tuning,
}

impl<'a> World<'a> {
    /// The scene at `step` with the conditions' start fields applied.
    pub fn new(scene: impl Into<SceneHandle<'a>>, graph: Arc<LaneGraph>, step: usize) -> Self {
        let scene = scene.into();
        let conditions = scene.agents.iter().map(|a| a.conditions.clone()).collect();
        Self::with_conditions(scene, graph, step, conditions)
    }

    /// The scene at `step` with other conditions than its own, one per agent.
    pub fn with_conditions(
        scene: impl Into<SceneHandle<'a>>,
        graph: Arc<LaneGraph>,
        step: usize,
        conditions: Vec<Conditions>,
    ) -> Self {
        let scene = scene.into();
        let agents = scene.agents.iter().zip(&conditions).enumerate();
        let mut present: Vec<AgentAtStart> =
            agents.filter_map(|(index, (agent, c))| AgentAtStart::at(index, agent, c, step)).collect();
        // Sums over road users run in this order, so that the scene's own order changes no byte.
        present.sort_by(|a, b| scene.agents[a.index].id.cmp(&scene.agents[b.index].id));
        let mut signals = Vec::new();
        let mut signal_ages_s = Vec::new();
        for signal in &scene.signals {
            if let Some(lane) = graph.lane_index(&signal.lane) {
                let (state, age) = signal.last_known(step);
                signals.push(LaneSignal { lane, state, stop: signal.stop });
                signal_ages_s.push(age as f64 * scene::STEP_S);
            }
        }
        let stop_lines = scene.signals.iter().filter_map(|s| StopLine::of(s, &graph, step)).collect();
        let planning = Planning::default();
        let tuning = &tuning::SHIPPED;
        Self { scene, graph, step, present, conditions, signals, signal_ages_s, stop_lines, planning, tuning }
    }

    /// The scene's agent behind a present road user.
    pub fn agent(&self, present: &AgentAtStart) -> &Agent {
        &self.scene.agents[present.index]
    }

    /// Motion model of a present road user.
    pub fn model(&self, present: &AgentAtStart) -> MotionModel {
        let subtype = self.agent(present).subtype;
        MotionModel::new(present.agent_type, subtype, present.size, present.start)
    }

    /// Replaces a road user's goal in this window. Nothing computed so far depends on goals.
    pub fn aim(&mut self, agent: usize, goal: Goal) {
        self.conditions[agent].goal = goal;
    }

    /// Replaces a road user's via points in this window.
    pub fn lead(&mut self, agent: usize, via: Vec<Via>) {
        self.conditions[agent].via = via;
    }

    /// The via points that a present road user is to pass in this window.
    pub fn waypoints(&self, present: &AgentAtStart) -> Vec<Waypoint> {
        let asked = &self.conditions[present.index];
        let steps = |time_s: f64| (time_s / scene::STEP_S).round() as isize - self.step as isize;
        let last = if asked.goal.position.is_some() { self.target(present).step } else { HORIZON_STEPS + 1 };
        let waypoint = |via: &Via| {
            let step = via.time_s.map(steps).filter(|step| (1..last as isize).contains(step));
            let step = step.map(|step| step as usize);
            Waypoint { via: Via { time_s: step.map(|step| step as f64 * scene::STEP_S), ..*via }, step }
        };
        asked.via.iter().map(waypoint).collect()
    }

    /// The fixed fields of an agent's goal, as a target of the window.
    pub fn target(&self, present: &AgentAtStart) -> Target {
        let goal = &self.conditions[present.index].goal;
        let step = goal.step_in_window(self.step as f64 * scene::STEP_S);
        Target {
            step: step.min(HORIZON_STEPS),
            position: goal.position,
            heading_rad: goal.heading_rad,
            speed_mps: goal.speed_mps,
        }
    }

    /// Where a present road user may drive: the map's ground, with the edges that it may cross.
    pub fn ground(&self, present: &AgentAtStart) -> Arc<Drivable> {
        match self.graph.ground().allowing(&self.conditions[present.index].may_cross) {
            Cow::Borrowed(_) => self.graph.ground().clone(),
            Cow::Owned(ground) => Arc::new(ground),
        }
    }

    /// All road users but this one as obstacles of a route.
    pub fn obstacles(&self, but: usize) -> Vec<Obstacle> {
        self.present.iter().filter(|p| p.index != but).map(AgentAtStart::obstacle).collect()
    }
}

impl AgentAtStart {
    /// The road user at `step` with its conditions applied; `None` if its place is unknown.
    pub fn at(index: usize, agent: &Agent, conditions: &Conditions, step: usize) -> Option<Self> {
        let logged = agent.state_at(step);
        let fixed = &conditions.start;
        let position = fixed.position.or(logged.map(|s| s.position()))?;
        let heading_rad = fixed.heading_rad.or(logged.map(|s| s.heading_rad)).unwrap_or(0.0);
        let velocity = match (fixed.speed_mps, logged) {
            (Some(speed), _) => scene::geometry::direction(heading_rad) * speed,
            // The velocity turns with the fixed heading.
            (None, Some(s)) if fixed.heading_rad.is_some() => {
                scene::geometry::direction(heading_rad) * s.speed_mps()
            }
            (None, Some(s)) => s.velocity(),
            (None, None) => Vec2::zeros(),
        };
        let size = conditions.size_of(agent.size);
        let start =
            State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y };
        Some(Self { index, agent_type: conditions.kind_of(agent), size, start })
    }

    /// Pose at the start.
    pub fn pose(&self) -> Pose {
        Pose::new(self.start.position(), self.start.heading_rad)
    }

    /// Its box and speed, as others see them.
    pub fn obstacle(&self) -> Obstacle {
        Obstacle {
            outline: OrientedBox::of_state(&self.start, &self.size),
            speed_mps: self.start.speed_mps(),
        }
    }
}
