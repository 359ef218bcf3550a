//! Test situations: casts a road user of a scene, and sets its goal. Equal scenes and seeds give equal
//! choices; another seed casts another road user, or draws other figures.

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
    /// The goal of the actor, in addition to its conditions in the scene.
    pub conditions: Conditions,
    /// A one-sentence description.
    pub words: String,
}

/// Goal of the actor: pose, speed and time.
struct Plan {
    pose: Pose,
    speed_mps: f64,
    /// Time after the start, seconds.
    after_s: f64,
    words: String,
}

/// Draws of figures for one road user before the next one is tried.
const DRAWS: usize = 6;
/// Number of best-fitting pairs among which seeds choose.
const MOST_ROLES: usize = 8;
/// Shortest time from the start to a goal, seconds.
const SOONEST_S: f64 = 0.5;

/// An actor, the other road user, and how badly the two fit (less is better).
#[derive(Clone, Copy, Debug)]
struct Pairing {
    actor: usize,
    other: Option<usize>,
    misfit: f64,
    /// Metres along the actor's path to the place of the event, which depends on the template.
    at_m: f64,
    /// Seconds until the other is there.
    at_s: f64,
}

impl Template {
    /// All templates.
    pub const ALL: [Self; 3] = [Self::Brake, Self::CutIn, Self::Late];

    /// The figures that it draws and that a caller may fix.
    pub fn figures(self) -> &'static [TemplateFigure] {
        match self {
            Self::Brake => &brake::FIGURES,
            Self::CutIn => &cut_in::FIGURES,
            Self::Late => &late::FIGURES,
        }
    }

    /// Name of the template.
    pub fn name(self) -> &'static str {
        match self {
            Self::Brake => "brake",
            Self::CutIn => "cut-in",
            Self::Late => "late",
        }
    }

    /// Casts the situation from a step of a scene on; `None` if no road user fits. `graph` belongs to the
    /// scene's map. `fixed` holds fixed figures by name; they do not change the draws of the others.
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

/// The best-fitting pair of each actor.
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

/// A time rounded to a step, seconds.
fn on_step(time_s: f64) -> f64 {
    (time_s / STEP_S).round() / (1.0 / STEP_S).round()
}
