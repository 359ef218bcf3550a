//! One future an actor, once the drafts are refined.

use super::candidates::{Candidate, Origin, own, shown};
use super::choice::{Choice, Choosable};
use super::costs::{Yardstick, options};
use super::guidance::guided;
use super::repulsion::{ABSENT, Outline, poses_of_states};
use super::trajectory::Motion;
use super::window::Window;
use crate::planning::INSTANTS;
use crate::request::Shown;
use scene::HORIZON_STEPS;
use scene::judge::Judge;

/// What a window decided for one actor.
pub(super) struct Decided {
    /// Index into the scene's agents.
    pub(super) agent: usize,
    /// Index into [`Window::actors`].
    pub(super) actor: usize,
    /// Index into `alternatives`.
    pub(super) chosen: usize,
    /// At most as many as were asked for; never empty.
    pub(super) alternatives: Vec<Candidate>,
}

impl Decided {
    /// The candidate that is shown.
    pub(super) fn shown(&self) -> &Candidate {
        &self.alternatives[self.chosen]
    }

    /// The motion that is shown.
    pub(super) fn motion(&self) -> &Motion {
        &self.shown().motion
    }

    /// The road user stays where it is.
    pub(super) fn rests(&self) -> bool {
        self.shown().origin == Origin::Rest
    }
}

impl Window<'_> {
    /// Chooses one candidate an actor. An actor that goes on with what it was given is left out.
    pub(super) fn decide(&self) -> Vec<Decided> {
        let mut candidates: Vec<Vec<Candidate>> =
            self.workers().map(&self.indices(), |&i| self.material(i).candidates());
        let mut choice =
            Choice { agents: Vec::new(), fixed: &self.background.boxes, tuning: &self.tuning().choice };
        let (scene, step) = (&self.world.scene, self.world.step);
        let steps = step..step + HORIZON_STEPS + 1;
        let judge = Judge::new(&scene.map, &scene.signals, &self.map.drivable, steps);
        choice.agents = self.workers().map(&self.indices(), |&i| self.options(&judge, i, &candidates[i]));
        let mut chosen = match self.request.stages.shown {
            Shown::Chosen => choice.solve(),
            Shown::Likeliest | Shown::Drawn => {
                let each = self.actors.iter().zip(&self.drafts).zip(&candidates);
                each.map(|((actor, drafts), all)| own(actor, drafts.leading, all)).collect()
            }
        };
        if self.request.stages.guidance {
            self.guide(&judge, &mut choice, &mut candidates, &mut chosen);
        }
        let count = self.request.modes.max(1);
        let each = self.actors.iter().zip(candidates).zip(chosen).enumerate();
        each.filter_map(|(i, ((actor, candidates), chosen))| {
            let (chosen, alternatives) = shown(candidates, chosen, count)?;
            Some(Decided { agent: actor.plan.present.index, actor: i, chosen, alternatives })
        })
        .collect()
    }

    /// Where the chosen scene still has conflicts, drafts guided out of them become further candidates; the choice
    /// takes them only where that costs less.
    fn guide(
        &self,
        judge: &Judge<'_>,
        choice: &mut Choice<'_>,
        candidates: &mut [Vec<Candidate>],
        chosen: &mut Vec<usize>,
    ) {
        let conflict = choice.in_conflict(chosen);
        if !conflict.contains(&true) {
            return;
        }
        let outlines: Vec<Outline> = (0..self.actors.len())
            .map(|i| {
                let shown = &candidates[i][chosen[i]];
                // A pinned future repels nobody; the choice alone keeps the others off it.
                let pinned = shown.origin == Origin::Pinned;
                let poses = if pinned { [ABSENT; INSTANTS] } else { poses_of_states(&shown.motion.states) };
                Outline::new(poses, &self.actors[i].plan.present, self.energy().tuning)
            })
            .collect();
        let concerned: Vec<usize> =
            self.indices().into_iter().filter(|i| conflict[*i] && !self.actors[*i].keeps_still()).collect();
        let found = self.workers().map(&concerned, |&i| {
            let others = outlines.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
            let others: Vec<&Outline> = others.chain(&self.background.outlines).collect();
            let tuning = &self.tuning().guidance;
            guided(&self.energy(), tuning, &self.actors[i], &self.drafts[i].modes, &candidates[i], &others)
        });
        for (i, found) in concerned.into_iter().zip(found) {
            candidates[i].extend(found);
            choice.agents[i] = self.options(judge, i, &candidates[i]);
        }
        *chosen = choice.solve();
    }

    fn options(&self, judge: &Judge<'_>, i: usize, candidates: &[Candidate]) -> Vec<Choosable> {
        let actor = &self.actors[i];
        let first = self.sample == 0 && self.world.step == self.request.start_step;
        let yardstick = Yardstick {
            around: self.material(i).around(self.sample),
            shown: self.request.shown.get(&actor.id).filter(|_| first),
            map: &self.map,
            judge,
            agent: self.world.agent(&actor.plan.present),
            start_step: self.world.step,
            tuning: &self.tuning().choice,
        };
        options(actor, candidates, &yardstick)
    }
}
