//! The operations of a run: begin, step, and peek.

use super::agents::{DrivenPlan, EgoMotion, Presence, RunAgent};
use super::error::RunError;
use super::moment::RunMoment;
use super::settings::{EgoState, RunSettings};
use super::state::{Run, RunPeek, RunStep, identity, with_goal_times};
use crate::generator::Generator;
use crate::planning::world::AgentAtStart;
use scene::Cancel;
use scene::{AgentId, AgentType, Scene, State};
use std::collections::BTreeMap;
use std::sync::Arc;

impl Run {
    /// Begins a run: every present road user plans for the first time.
    ///
    /// # Errors
    /// Settings out of range, egos that are unknown, absent at the start or named twice, and the generator's
    /// errors.
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

    /// Makes one step: the egos are at the given states, the others follow their plans and react.
    ///
    /// # Errors
    /// States that are missing, superfluous or invalid, a run that is over, and the generator's errors. The
    /// run is then unchanged.
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

    /// What the others would do if egos drove these plans from their present places. A plan is states 0.1 s
    /// apart, the first 0.1 s after the present. An ego that is left out follows its announced plan. The run
    /// does not change.
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
}

/// Presence of a road user when the run begins, before egos are assigned.
fn present_at(scene: &Scene, agent: usize, start_step: usize) -> Presence {
    let own = &scene.agents[agent];
    match AgentAtStart::at(agent, own, &own.conditions, start_step) {
        Some(there) if own.kind() == AgentType::Other => {
            // A road user that is shown but never planned follows its recording.
            let recorded = (start_step + 1..).map_while(|step| own.track.at(step).copied());
            let states = std::iter::once(there.start).chain(recorded).collect();
            Presence::Driven(DrivenPlan { states, ..DrivenPlan::fresh(0, there.start) })
        }
        Some(there) => Presence::Driven(DrivenPlan::fresh(0, there.start)),
        None if own.track.last_valid_step().is_some_and(|last| last > start_step) => Presence::Coming,
        None => Presence::Gone,
    }
}
