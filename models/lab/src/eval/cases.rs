//! Which road users are judged, and under which conditions (`evaluation.md`).

use scene::{Agent, AgentType, Goal, HORIZON_STEPS, STEP_S, Scene};

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
    /// All of them, in the tables' order.
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
}

/// A moving road user that is judged.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Index into the scene's agents.
    pub agent: usize,
    /// Its type.
    pub agent_type: AgentType,
    /// Scene step of the goal: 90, or the last valid one before.
    pub goal_step: usize,
}

impl Case {
    /// The goal that the log gives, some fields left free.
    pub fn goal(&self, scene: &Scene, subset: Subset) -> Goal {
        let Some(state) = scene.agents[self.agent].state_at(self.goal_step) else { return Goal::default() };
        let position = matches!(subset, Subset::Pos | Subset::PosSpeed | Subset::PosSpeedHeading);
        let speed = matches!(subset, Subset::Speed | Subset::PosSpeed | Subset::PosSpeedHeading);
        Goal {
            position: position.then(|| state.position()),
            heading_rad: (subset == Subset::PosSpeedHeading).then_some(state.heading_rad),
            speed_mps: speed.then(|| state.speed_mps()),
            time_s: (subset != Subset::None).then_some(self.goal_step as f64 * STEP_S),
        }
    }
}

/// Moving road users: there at the first step, at least 30 valid steps after it, farther than 2 m from
/// the start at some time in the window.
pub fn cases(scene: &Scene) -> Vec<Case> {
    scene.agents.iter().enumerate().filter_map(|(i, agent)| case(i, agent)).collect()
}

fn case(index: usize, agent: &Agent) -> Option<Case> {
    let start = agent.state_at(0)?;
    let steps: Vec<usize> = agent.track.valid_steps().filter(|s| (1..=HORIZON_STEPS).contains(s)).collect();
    let moved =
        |s: &usize| agent.state_at(*s).is_some_and(|q| (q.position() - start.position()).norm() > 2.0);
    let judged = agent.agent_type != AgentType::Other && steps.len() >= 30 && steps.iter().any(moved);
    judged.then(|| Case { agent: index, agent_type: agent.agent_type, goal_step: steps[steps.len() - 1] })
}
