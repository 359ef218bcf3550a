//! Rivals of the experts: formulas, the baseline without learning, and networks of others ([`learned`]).

mod hermite;
mod lane;
mod learned;
mod prior;
mod spline;

pub use lane::intelligent_driver;
pub use learned::{Together, learned, replanned};
pub use prior::{VARIATIONS, least_effort, varied};
pub use spline::hermite;

use super::{Case, Site, Subset};
use experts::planning::world::World;
use scene::{Agent, AgentType, Future, Goal, HORIZON_STEPS, STEP_S, State, Vec2};
use serde::Serialize;

/// A formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Rival {
    /// The present velocity, unchanged.
    ConstantVelocity,
    /// Cubic Hermite spline from the start state to the goal.
    Spline,
    /// The scene's projection of constant motion onto the goal.
    Prior,
    /// The prior and five random variations of it.
    PriorVaried,
    /// Intelligent driver model along the lane.
    LaneDriver,
}

impl Rival {
    /// All, in the tables' order.
    pub const ALL: [Self; 5] =
        [Self::ConstantVelocity, Self::Spline, Self::Prior, Self::PriorVaried, Self::LaneDriver];

    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::ConstantVelocity => "constant velocity",
            Self::Spline => "cubic spline",
            Self::Prior => "prior",
            Self::PriorVaried => "prior + 5",
            Self::LaneDriver => "IDM along the lane",
        }
    }

    /// Futures of a case, all with the same probability, the first answer first; empty if the formula does
    /// not apply.
    pub fn futures(self, site: &Site<'_>, case: &Case, subset: Subset, seed: u64) -> Vec<Future> {
        let agent = &site.blind.agents[case.agent];
        let goal = case.goal(site.scene, subset);
        let all = match self {
            Self::ConstantVelocity => vec![constant_velocity(&case.start)],
            Self::Spline if subset == Subset::None => Vec::new(),
            Self::Spline => vec![hermite(&case.start, &goal, case.goal_step)],
            Self::Prior => vec![least_effort(agent, &case.start, &goal, case.goal_step)],
            Self::PriorVaried => {
                let seed = (seed, site.name());
                varied(agent, &case.start, &goal, case.goal_step, seed, VARIATIONS)
            }
            Self::LaneDriver if may_follow_lane(agent, &goal) => {
                let world = World::new(&site.blind, site.graph.clone(), 0);
                intelligent_driver(&world, case.agent).into_iter().collect()
            }
            Self::LaneDriver => Vec::new(),
        };
        let probability = 1.0 / all.len().max(1) as f64;
        all.into_iter().map(|states| Future::bare(probability, 1, states)).collect()
    }
}

/// Whether it has wheels and no goal position: the driver model cannot meet a goal.
fn may_follow_lane(agent: &Agent, goal: &Goal) -> bool {
    matches!(agent.agent_type, AgentType::Vehicle | AgentType::Cyclist) && goal.is_free()
}

/// States at steps 1 ..= 90 of unchanged motion.
pub fn constant_velocity(start: &State) -> Vec<State> {
    let at = |step: usize| {
        let moved = start.position() + start.velocity() * (step as f64 * STEP_S);
        State { x_m: moved.x, y_m: moved.y, ..*start }
    };
    (1..=HORIZON_STEPS).map(at).collect()
}

/// A state from a place, a heading and a velocity.
fn state(position: Vec2, heading_rad: f64, velocity: Vec2) -> State {
    State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y }
}
