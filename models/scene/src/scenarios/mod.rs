//! Test situations: the road user of a scene that can play one, and its goal. The same scene and seed give
//! the same choice; another seed takes another road user, or other figures.

mod brake;
mod cut_in;
mod figure;
mod late;
mod stage;
#[cfg(test)]
mod tests;

use crate::random::Key;
use crate::routes::{LaneGraph, Pose};
use crate::{AgentId, Conditions, Goal, STEP_S, Scene};
use figure::FigureDraw;
pub use figure::TemplateFigure;
use stage::Stage;
use std::collections::BTreeMap;

/// A situation by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Template {
    /// A vehicle with a follower brakes to a stop.
    Brake,
    /// A vehicle of a neighbouring lane cuts in closely ahead of another.
    CutIn,
    /// A vehicle that should yield drives through a junction without stopping.
    Late,
}

/// The road user that plays a situation, and its goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Casting {
    /// The road user that acts.
    pub actor: AgentId,
    /// The road user it affects, if any.
    pub other: Option<AgentId>,
    /// The goal for the actor, beside what the scene has fixed about it.
    pub conditions: Conditions,
    /// One sentence.
    pub words: String,
}

/// Goal of the actor: pose, speed and time.
struct Plan {
    pose: Pose,
    speed_mps: f64,
    /// After the start, seconds.
    after_s: f64,
    words: String,
}

/// Draws of figures for one road user before the next one is tried.
const DRAWS: usize = 6;
/// Most pairs among which seeds choose, the most fitting first.
const MOST_ROLES: usize = 8;
/// Least time of a goal after the start, seconds.
const SOONEST_S: f64 = 0.5;

/// An actor, the agent that it concerns, and how badly the two fit (less is better).
#[derive(Clone, Copy, Debug)]
struct Pairing {
    actor: usize,
    other: Option<usize>,
    misfit: f64,
    /// Metres along the actor's way to where it happens; what that is, the template knows.
    at_m: f64,
    /// Seconds until the other one is there.
    at_s: f64,
}

impl Template {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Brake, Self::CutIn, Self::Late];

    /// The figures that it draws, and that a caller may fix.
    pub fn figures(self) -> &'static [TemplateFigure] {
        match self {
            Self::Brake => &brake::FIGURES,
            Self::CutIn => &cut_in::FIGURES,
            Self::Late => &late::FIGURES,
        }
    }

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brake => "brake",
            Self::CutIn => "cut-in",
            Self::Late => "late",
        }
    }

    /// Casts the situation from a step of a scene on; `None` where no road user fits. `graph` is that of the
    /// scene's map. `fixed` has the figures that are not drawn, by name; the others are the same numbers with and
    /// without them.
    pub fn cast(
        self,
        scene: &Scene,
        graph: &LaneGraph,
        start_step: usize,
        horizon_s: f64,
        seed: u64,
        fixed: &BTreeMap<String, f64>,
    ) -> Option<Casting> {
        let stage = Stage::new(scene, graph, start_step);
        let (roles, plan): (Vec<Pairing>, Planner) = match self {
            Self::Brake => (brake::roles(&stage), brake::plan),
            Self::CutIn => (cut_in::roles(&stage), cut_in::plan),
            Self::Late => (late::roles(&stage), late::plan),
        };
        let roles = fitting(roles);
        // Another seed begins with another road user. A road user without feasible figures is skipped.
        (0..roles.len()).find_map(|turn| {
            let role = &roles[(seed as usize % roles.len() + turn) % roles.len()];
            let driver = &stage.drivers[role.actor];
            let stream = Key::default().words(&[self.name(), &driver.agent.id]).number(seed).stream();
            let mut draw = FigureDraw { stream, fixed };
            let planned =
                (0..DRAWS).find_map(|_| plan(&stage, role, &mut draw).filter(|p| p.fits(horizon_s)));
            let planned = planned?;
            let start_s = start_step as f64 * STEP_S;
            let goal = Goal {
                position: Some(planned.pose.position),
                heading_rad: Some(crate::wrap_angle(planned.pose.heading_rad)),
                speed_mps: Some(planned.speed_mps),
                time_s: Some(start_s + planned.after_s),
            };
            Some(Casting {
                actor: driver.agent.id.clone(),
                other: role.other.map(|other| stage.drivers[other].agent.id.clone()),
                conditions: Conditions { goal, ..driver.agent.conditions.clone() },
                words: planned.words,
            })
        })
    }
}

type Planner = fn(&Stage<'_>, &Pairing, &mut FigureDraw<'_>) -> Option<Plan>;

impl Plan {
    fn fits(&self, horizon_s: f64) -> bool {
        self.after_s >= SOONEST_S && self.after_s <= horizon_s
    }
}

/// The most fitting pairs, one for each actor.
fn fitting(mut roles: Vec<Pairing>) -> Vec<Pairing> {
    roles.sort_by(|a, b| a.misfit.total_cmp(&b.misfit).then(a.actor.cmp(&b.actor)));
    let mut kept: Vec<Pairing> = Vec::new();
    for role in roles {
        if kept.len() < MOST_ROLES && kept.iter().all(|known| known.actor != role.actor) {
            kept.push(role);
        }
    }
    kept
}

/// A time on a step, seconds.
fn on_step(time_s: f64) -> f64 {
    (time_s / STEP_S).round() / (1.0 / STEP_S).round()
}
