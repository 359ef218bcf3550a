//! The road users that are evaluated, and their conditions.

use lab_train::polylines::Polylines;
use lab_train::scenes::blind;
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{Agent, AgentType, Goal, HORIZON_STEPS, STEP_S, Scene, State};
use std::sync::{Arc, OnceLock};

/// Fixed goal fields of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Subset {
    /// Nothing.
    None,
    /// Position.
    Pos,
    /// Position and speed.
    PosSpeed,
    /// Position, speed and heading: the paper's "with condition".
    PosSpeedHeading,
    /// Speed.
    Speed,
}

impl Subset {
    /// All subsets, in the order of the tables.
    pub const ALL: [Self; 5] = [Self::None, Self::Pos, Self::PosSpeed, Self::PosSpeedHeading, Self::Speed];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Pos => "pos",
            Self::PosSpeed => "pos+speed",
            Self::PosSpeedHeading => "pos+speed+heading",
            Self::Speed => "speed",
        }
    }

    /// Whether the goal's position is fixed.
    pub fn has_position(self) -> bool {
        matches!(self, Self::Pos | Self::PosSpeed | Self::PosSpeedHeading)
    }
}

/// A moving road user that is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Index into the scene's agents.
    pub agent: usize,
    /// Its type.
    pub agent_type: AgentType,
    /// Scene step of the goal: 90, or the last valid one before it.
    pub goal_step: usize,
    /// State at the first step.
    pub start: State,
}

impl Case {
    /// The goal from the log, with some fields left free.
    pub fn goal(&self, scene: &Scene, subset: Subset) -> Goal {
        let Some(state) = scene.agents[self.agent].state_at(self.goal_step) else { return Goal::default() };
        let position = subset.has_position();
        let speed = matches!(subset, Subset::Speed | Subset::PosSpeed | Subset::PosSpeedHeading);
        Goal {
            position: position.then(|| state.position()),
            heading_rad: (subset == Subset::PosSpeedHeading).then_some(state.heading_rad),
            speed_mps: speed.then(|| state.speed_mps()),
            time_s: (subset != Subset::None).then_some(self.goal_step as f64 * STEP_S),
        }
    }
}

/// Moving road users. They are present at the first step, have at least 30 valid steps after it, and get
/// farther than 2 m from the start within the window.
pub fn cases(scene: &Scene) -> Vec<Case> {
    scene.agents.iter().enumerate().filter_map(|(i, agent)| case(i, agent)).collect()
}

fn case(index: usize, agent: &Agent) -> Option<Case> {
    let start = agent.state_at(0)?;
    let steps: Vec<usize> = agent.track.valid_steps().filter(|s| (1..=HORIZON_STEPS).contains(s)).collect();
    let moved =
        |s: &usize| agent.state_at(*s).is_some_and(|q| (q.position() - start.position()).norm() > 2.0);
    let judged = agent.agent_type != AgentType::Other && steps.len() >= 30 && steps.iter().any(moved);
    judged.then(|| Case {
        agent: index,
        agent_type: agent.agent_type,
        goal_step: steps[steps.len() - 1],
        start,
    })
}

/// A scene prepared for the evaluation.
pub struct Site<'a> {
    /// Index in the list of scenes, by which figures are resampled.
    pub index: usize,
    /// The recorded scene.
    pub scene: &'a Scene,
    /// The scene without what the experts must not see: [`blind`].
    pub blind: Scene,
    /// Lanes of its map with their links.
    pub graph: Arc<LaneGraph>,
    polylines: OnceLock<Polylines>,
    /// Drivable area of its map.
    pub drivable: Drivable,
    /// Moving road users.
    pub cases: Vec<Case>,
}

impl<'a> Site<'a> {
    /// Computes what all tables need of a scene.
    pub fn new(index: usize, scene: &'a Scene) -> Self {
        Self {
            index,
            scene,
            blind: blind(scene),
            graph: Arc::new(LaneGraph::new(&scene.map)),
            polylines: OnceLock::new(),
            drivable: Drivable::new(&scene.map),
            cases: cases(scene),
        }
    }

    /// Name for files and seeds: the id in the source if there is one.
    pub fn name(&self) -> &str {
        self.scene.meta.source_id.as_deref().unwrap_or(&self.scene.name)
    }

    /// Polylines of its map for the rivals that use them, computed on first use.
    pub fn polylines(&self) -> &Polylines {
        self.polylines.get_or_init(|| Polylines::new(&self.scene.map))
    }

    /// Log of a case.
    pub fn log(&self, case: &Case) -> &'a Agent {
        &self.scene.agents[case.agent]
    }

    /// The blind scene with one road user's goal fixed, to generate only that road user.
    pub fn asked(&self, case: &Case, subset: Subset) -> Scene {
        let mut scene = self.blind.clone();
        scene.agents[case.agent].conditions.goal = case.goal(self.scene, subset);
        scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{log, scene};

    #[test]
    fn cases_move_and_are_seen() {
        let mut short = log("short", 8.0, 91);
        short.track.states.truncate(25);
        let cases = cases(&scene(vec![log("stands", 0.0, 91), log("moves", 1.0, 91), short]));
        assert_eq!(cases.iter().map(|c| (c.agent, c.goal_step)).collect::<Vec<_>>(), [(1, 90)]);
    }
}
