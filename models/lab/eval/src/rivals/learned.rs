//! Trained rivals: [`Baseline`]s asked as the experts are.

use super::least_effort;
use crate::together::{Motions, asked, generated, joint_goal};
use crate::{Case, Site, Subset};
use anyhow::Result;
use experts::planning::world::World;
use lab_train::baselines::Baseline;
use scene::random::Key;
use scene::{Future, Goal, State};

/// Futures of a case, the most probable first; none under a condition that the baseline does not see, or of a
/// type that it does not know.
///
/// # Errors
/// When the tensor library fails.
pub fn learned(baseline: &Baseline, site: &Site<'_>, case: &Case, subset: Subset) -> Result<Vec<Future>> {
    if subset != Subset::None && !baseline.has_condition() {
        return Ok(Vec::new());
    }
    let asked = site.asked(case, subset);
    let world = World::new(&asked, site.graph.clone(), 0);
    let found = baseline.futures(&world, site.polylines(), &[case.agent])?;
    Ok(found.into_iter().next().unwrap_or_default())
}

/// Everybody's futures in a whole scene.
pub struct Together<'a> {
    site: &'a Site<'a>,
    futures: Vec<(usize, Vec<Future>)>,
}

impl<'a> Together<'a> {
    /// Asks for them, with or without the log's goals. Who is of a type that the baseline does not know goes
    /// the way of least effort.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn new(baseline: &Baseline, site: &'a Site<'a>, goals: bool) -> Result<Self> {
        let whom = generated(site);
        let scene = asked(site, goals);
        let world = World::new(&scene, site.graph.clone(), 0);
        let mut futures = baseline.futures(&world, site.polylines(), &whom)?;
        for (&i, modes) in whom.iter().zip(&mut futures).filter(|(_, modes)| modes.is_empty()) {
            let agent = &site.blind.agents[i];
            let Some(start) = agent.state_at(0) else { continue };
            let goal = if goals { joint_goal(site, i) } else { Goal::default() };
            let states = least_effort(agent, &start, &goal, goal.step_in_window(0.0));
            modes.push(Future::bare(1.0, 1, states));
        }
        Ok(Self { site, futures: whom.into_iter().zip(futures).collect() })
    }

    /// Everybody by its most probable future.
    pub fn likeliest(&self) -> Motions {
        self.motions(|_, modes| modes.first())
    }

    /// Everybody by a future drawn by its probability, each for itself.
    pub fn drawn(&self, seed: u64, rollout: usize) -> Motions {
        self.motions(|i, modes| {
            let id = &self.site.blind.agents[i].id;
            let mut ticket = Key::default()
                .number(seed)
                .words(&["learned", self.site.name(), id, &rollout.to_string()])
                .stream()
                .unit();
            let found = modes.iter().find(|mode| {
                ticket -= mode.probability;
                ticket < 0.0
            });
            found.or(modes.last())
        })
    }

    fn motions(&self, pick: impl Fn(usize, &[Future]) -> Option<&Future>) -> Motions {
        let mut out: Motions = vec![None; self.site.scene.agents.len()];
        for (i, modes) in &self.futures {
            out[*i] = pick(*i, modes).map(|mode| -> Vec<State> { mode.states.clone() });
        }
        out
    }
}
