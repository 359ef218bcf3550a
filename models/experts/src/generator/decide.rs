//! One future an actor, once the drafts are refined.

use super::candidates::{Candidate, Origin, own, shown};
use super::choice::{Choice, Choosable};
use super::costs::{Yardstick, options};
use super::guidance::guided;
use super::reacting::{Answered, Changed, Moving, caused, reaction_of};
use super::repulsion::{Outline, poses_of_states};
use super::trajectory::Motion;
use super::window::Window;
use crate::request::Shown;
use scene::judge::{Judge, Reaction};
use scene::{AgentId, HORIZON_STEPS, STEP_S};

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
    /// Why it gave up what it did before, where it had something.
    pub(super) reaction: Option<Reaction>,
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

/// What a window decided.
pub(super) struct Decisions {
    /// Of actors. One that goes on with what it was given is left out.
    pub(super) actors: Vec<Decided>,
    /// Of those who give up what they do for the actors. Who keeps it is left out.
    pub(super) answered: Vec<Answered>,
}

impl Window<'_> {
    /// Chooses one candidate an actor, and what the others answer.
    pub(super) fn decide(&self) -> Decisions {
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
        let causes = self.put_back(&choice, &mut chosen);
        let changed: Vec<Changed> = self
            .indices()
            .into_iter()
            .map(|i| {
                let shown = &candidates[i][chosen[i]];
                let moving = Moving::of_rollout(&shown.motion.states, &self.actors[i].plan.present.size);
                Changed { id: self.actors[i].id.clone(), moving, kept: shown.origin == Origin::Kept }
            })
            .collect();
        let answered = self.answerers.answers(&changed);
        let count = self.request.modes.max(1);
        let each = self.actors.iter().zip(candidates).zip(chosen).enumerate();
        let actors = each.filter_map(|(i, ((actor, candidates), chosen))| {
            let (chosen, alternatives) = shown(candidates, chosen, count)?;
            let reaction = causes[i].as_ref().and_then(|cause| {
                let motion = &alternatives[chosen].motion.states;
                let from_s = self.world.step as f64 * STEP_S;
                Some(reaction_of(actor.kept.as_ref()?, motion, cause.clone(), from_s))
            });
            Some(Decided { agent: actor.plan.present.index, actor: i, chosen, alternatives, reaction })
        });
        Decisions { actors: actors.collect(), answered }
    }

    /// Reacting actors that left what they do without a cause go back to it. Says what caused the others, one entry
    /// an actor.
    fn put_back(&self, choice: &Choice<'_>, chosen: &mut [usize]) -> Vec<Option<AgentId>> {
        let moving = |i: usize, option: usize| &choice.agents[i][option].boxes;
        let has_own = |i: usize| choice.agents[i].first().is_some_and(|o| o.kept);
        let (reacting, asked): (Vec<usize>, Vec<usize>) =
            self.indices().into_iter().partition(|i| has_own(*i));
        let sources = asked.iter().map(|i| (&self.actors[*i].id, moving(*i, chosen[*i])));
        let kept: Vec<_> = reacting.iter().map(|i| moving(*i, 0)).collect();
        let changes: Vec<_> = reacting
            .iter()
            .map(|i| (chosen[*i] != 0).then(|| (&self.actors[*i].id, moving(*i, chosen[*i]))))
            .collect();
        let mut causes = vec![None; self.actors.len()];
        for (i, cause) in reacting.iter().zip(caused(sources.collect(), &kept, &changes)) {
            if cause.is_none() {
                chosen[*i] = 0;
            }
            causes[*i] = cause;
        }
        causes
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
        let mut conflict = choice.in_conflict(chosen);
        for (i, conflict) in conflict.iter_mut().enumerate() {
            *conflict |= self.burden(i, &candidates[i][chosen[i]]) >= self.tuning().choice.close;
        }
        if !conflict.contains(&true) {
            return;
        }
        let outlines: Vec<Outline> = (0..self.actors.len())
            .map(|i| {
                let shown = &candidates[i][chosen[i]];
                let poses = poses_of_states(&shown.motion.states);
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
        let yardstick = Yardstick {
            around: self.material(i).around(self.sample),
            shown: self.shown_last(actor),
            map: &self.map,
            judge,
            others: &self.traces,
            agent: self.world.agent(&actor.plan.present),
            start_step: self.world.step,
            tuning: &self.tuning().choice,
        };
        let mut options = options(actor, candidates, &yardstick);
        let all: Vec<usize> = (0..candidates.len()).collect();
        let burdens = self.workers().map(&all, |&o| {
            if self.answerers.are_met_by(&options[o].boxes) { self.burden(i, &candidates[o]) } else { 0.0 }
        });
        for (option, burden) in options.iter_mut().zip(burdens) {
            option.cost += burden;
        }
        options
    }

    /// What it costs the others that an actor does this.
    fn burden(&self, i: usize, candidate: &Candidate) -> f64 {
        if candidate.origin == Origin::Kept {
            return 0.0;
        }
        let size = &self.actors[i].plan.present.size;
        self.answerers.burden(&Moving::of_rollout(&candidate.motion.states, size))
    }
}
