//! Trained rivals: [`Baseline`]s with the same requests as the experts.

use super::least_effort;
use crate::together::{Motions, asked, generated, joint_goal};
use crate::{Case, Site, Subset};
use anyhow::Result;
use experts::planning::world::World;
use lab_train::baselines::Baseline;
use scene::random::Key;
use scene::{Future, Goal, HORIZON_STEPS, STEP_S, State, Track};

/// Futures of a case, the most probable first; none under a condition or for a type that the baseline does
/// not know.
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

/// Whole scene from the most probable future of each road user, replanned after this many steps (1..=90) from
/// the reached states, as the product is. A goal is dropped once its time has passed. Road users of a type
/// that the baseline does not know follow the path of least effort.
///
/// # Errors
/// When the tensor library fails.
pub fn replanned(baseline: &Baseline, site: &Site<'_>, goals: bool, every: usize) -> Result<Motions> {
    let whom = generated(site);
    let mut scene = asked(site, goals);
    let mut out: Motions = vec![None; scene.agents.len()];
    for from in (0..HORIZON_STEPS).step_by(every.clamp(1, HORIZON_STEPS)) {
        let steps = every.clamp(1, HORIZON_STEPS - from);
        let now_s = from as f64 * STEP_S;
        for agent in &mut scene.agents {
            let goal = &mut agent.conditions.goal;
            if from > 0 && goal.time_s.is_some_and(|due_s| due_s < now_s + 0.5 * STEP_S) {
                *goal = Goal::default();
            }
        }
        let world = World::new(&scene, site.graph.clone(), from);
        let found = baseline.futures(&world, site.polylines(), &whom)?;
        for (&i, modes) in whom.iter().zip(found) {
            let Some(start) = scene.agents[i].state_at(from) else { continue };
            let goal = scene.agents[i].conditions.goal;
            let states = match modes.into_iter().next() {
                Some(mode) => mode.states,
                None => least_effort(&scene.agents[i], &start, &goal, goal.step_in_window(now_s)),
            };
            out[i].get_or_insert_default().extend(states.into_iter().take(steps));
        }
        // Road users that are not generated stay where they were seen.
        for (agent, own) in scene.agents.iter_mut().zip(&out) {
            let reached = own.as_ref().and_then(|own| own.last().copied()).or(agent.state_at(from));
            agent.track = Track {
                first_step: from + steps,
                states: reached.map(Some).into_iter().collect(),
                z_m: None,
            }
            .into();
        }
    }
    Ok(out)
}

/// Futures of all road users in a whole scene.
pub struct Together<'a> {
    site: &'a Site<'a>,
    futures: Vec<(usize, Vec<Future>)>,
}

impl<'a> Together<'a> {
    /// Generates them, with or without the log's goals. Road users of a type that the baseline does not know
    /// follow the path of least effort.
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

    /// The most probable future of each road user.
    pub fn likeliest(&self) -> Motions {
        self.motions(|_, modes| modes.first())
    }

    /// A future of each road user, drawn independently by its probability.
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

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::baselines::BaselineKind;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn rivals_are_planned_anew_from_the_states_reached() {
        let scene = scene(vec![log("a", 8.0, 91), shifted(log("b", 6.0, 91), 30.0, 3.5)]);
        let site = Site::new(0, &scene);
        let baseline = Baseline::random("asked", BaselineKind::Paper).unwrap();
        let of = |every| replanned(&baseline, &site, true, every).unwrap();
        let (once, often) = (of(90), of(30));
        // A single plan for nine seconds equals the plan of the start.
        assert_eq!(once, Together::new(&baseline, &site, true).unwrap().likeliest());
        for i in 0..2 {
            let (once, often) = (once[i].as_ref().unwrap(), often[i].as_ref().unwrap());
            assert_eq!((once.len(), often.len()), (90, 90));
            assert_eq!(once[..30], often[..30]);
            assert!(once[30..] != often[30..], "{i}");
            // Motion continues from the reached state.
            assert!((often[30].position() - often[29].position()).norm() < 5.0);
        }
        assert_eq!(often, of(30));
        assert_ne!(often, of(60));
    }
}
