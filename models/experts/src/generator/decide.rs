//! One future an actor, once the drafts are refined.

use super::actor::Actor;
use super::candidates::{Candidate, Origin, own, shown};
use super::choice::{Choice, Choosable, swept};
use super::costs::{Yardstick, drives_against, options};
use super::evading::{Field, short_of, way_round};
use super::guidance::guided;
use super::reacting::{Answered, Changed, Moving, caused, reaction_of};
use super::repulsion::{Outline, poses_of_states};
use super::trajectory::{Motion, PER_INSTANT};
use super::window::Window;
use crate::features::agent::BEYOND_M;
use crate::request::{React, Shown};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::judge::{Judge, Reaction};
use scene::motion::MotionState;
use scene::score::overlap;
use scene::{AgentId, HORIZON_STEPS, STEP_S, State};

/// Motions of one road user that are led round what is in their way.
const MOST_TRIED: usize = 2;
/// How often that is done: who evades one may meet another.
const MOST_ROUNDS: usize = 2;

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
    /// Before whom it halts and misses its goal.
    pub(super) blocked_by: Option<AgentId>,
    /// What the others answer if one of `alternatives` is taken in place of the shown one, one entry each: `None`
    /// where that makes no difference. Empty where it is not looked at.
    pub(super) answers: Vec<Option<Vec<Answered>>>,
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

/// A choice without uncaused reactions, and what follows from it.
struct Settled {
    /// Index of the candidate of each actor.
    chosen: Vec<usize>,
    /// The agent that causes the change of each reacting actor.
    causes: Vec<Option<AgentId>>,
    /// The actors' motions, as the others see them.
    changed: Vec<Changed>,
    answered: Vec<Answered>,
}

/// Replans at most `most` times, until the choice stays. `replan` gives the next choice without its uncaused reactions,
/// or `None` where it finds no new candidate.
fn replan_rounds<T>(
    most: usize,
    table: &mut T,
    mut settled: Settled,
    mut replan: impl FnMut(&mut T, &Settled) -> Option<Vec<usize>>,
    settle: impl Fn(&T, Vec<usize>) -> Settled,
) -> Settled {
    for _ in 0..most {
        match replan(table, &settled) {
            Some(chosen) if chosen != settled.chosen => settled = settle(table, chosen),
            _ => break,
        }
    }
    settled
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
        let mut blockers: Vec<Option<AgentId>> = vec![None; self.actors.len()];
        let rounds = if self.request.stages.guidance { MOST_ROUNDS } else { 0 };
        let mut table = (choice, candidates);
        let settle = |(choice, candidates): &(Choice<'_>, Vec<Vec<Candidate>>), mut chosen: Vec<usize>| {
            let causes = self.put_back(choice, &mut chosen);
            let changed = self.changed(candidates, &chosen);
            let answered = self.answers(&changed);
            Settled { chosen, causes, changed, answered }
        };
        let first = settle(&table, chosen);
        let Settled { chosen, causes, changed, answered } = replan_rounds(
            rounds,
            &mut table,
            first,
            |(choice, candidates), settled| {
                self.evade(&judge, choice, candidates, settled, &mut blockers).then(|| {
                    let mut chosen = choice.solve();
                    self.put_back(choice, &mut chosen);
                    chosen
                })
            },
            settle,
        );
        let (choice, candidates) = table;
        let (count, unlawful) = (self.request.modes.max(1), self.tuning().probability.unlawful);
        let each = self.actors.iter().zip(candidates).zip(chosen).enumerate();
        let actors = each.filter_map(|(i, ((actor, candidates), chosen))| {
            let lawful: Vec<f64> = choice.agents[i].iter().map(|o| (-unlawful * o.broken).exp()).collect();
            let (chosen, alternatives) = shown(candidates, &lawful, chosen, count)?;
            let reaction = causes[i].as_ref().and_then(|cause| {
                let motion = &alternatives[chosen].motion.states;
                let from_s = self.world.step as f64 * STEP_S;
                Some(reaction_of(actor.kept.as_ref()?, motion, cause.clone(), from_s))
            });
            let halts = alternatives[chosen].motion.reach.is_for_traffic();
            let blocked_by = blockers[i].clone().filter(|_| halts);
            let agent = actor.plan.present.index;
            let answers = self.answers_to_each(i, chosen, &alternatives, &changed);
            Some(Decided { agent, actor: i, chosen, alternatives, reaction, blocked_by, answers })
        });
        Decisions { actors: actors.collect(), answered }
    }

    /// What the actors do, as the others see it.
    fn changed(&self, candidates: &[Vec<Candidate>], chosen: &[usize]) -> Vec<Changed> {
        self.indices().into_iter().map(|i| self.change(i, &candidates[i][chosen[i]])).collect()
    }

    fn change(&self, i: usize, taken: &Candidate) -> Changed {
        let moving = Moving::of_rollout(&taken.motion.states, &self.actors[i].plan.present.size);
        Changed { id: self.actors[i].id.clone(), moving, kept: taken.origin == Origin::Kept }
    }

    fn answers(&self, changed: &[Changed]) -> Vec<Answered> {
        self.answerers.answers(&changed.iter().collect::<Vec<_>>())
    }

    /// What the others answer to each of an actor's alternatives, all other actors doing what is shown: for the verdicts
    /// on them alone. Only whoever was asked for has futures to take.
    fn answers_to_each(
        &self,
        i: usize,
        chosen: usize,
        alternatives: &[Candidate],
        changed: &[Changed],
    ) -> Vec<Option<Vec<Answered>>> {
        if !self.request.stages.judged
            || self.request.react == React::Nobody
            || self.actors[i].kept.is_some()
            || self.world.step > self.request.start_step
        {
            return Vec::new();
        }
        let shown_is_met = self.answerers.are_met_by(&changed[i].moving.swept);
        let each: Vec<usize> = (0..alternatives.len()).collect();
        self.workers().map(&each, |&k| {
            let other = (k != chosen).then(|| self.change(i, &alternatives[k]))?;
            if !shown_is_met && !self.answerers.are_met_by(&other.moving.swept) {
                return None;
            }
            let seen: Vec<&Changed> =
                changed.iter().enumerate().map(|(j, c)| if j == i { &other } else { c }).collect();
            Some(self.answerers.answers(&seen))
        })
    }

    /// Where somebody who was asked for still meets others, whatever they answer, leaves the road for a goal on it,
    /// or breaks its rules with no goal at all, ways round become further candidates. False where there are none.
    fn evade(
        &self,
        judge: &Judge<'_>,
        choice: &mut Choice<'_>,
        candidates: &mut [Vec<Candidate>],
        Settled { chosen, changed, answered, .. }: &Settled,
        blockers: &mut [Option<AgentId>],
    ) -> bool {
        let answering = self.answerers.movings_with(answered);
        let may_answer = self.request.react != React::Nobody;
        let found = self.workers().map(&self.indices(), |&i| {
            let actor = &self.actors[i];
            let shown = &candidates[i][chosen[i]];
            if actor.kept.is_some() || actor.keeps_still() || shown.origin == Origin::Rest {
                return (Vec::new(), None);
            }
            let actors = changed.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, c)| &c.moving);
            let others: Vec<&Moving> =
                answering.iter().map(|(_, moving)| moving.as_ref()).chain(actors).collect();
            let own = &changed[i].moving;
            let is_met = |o: &Moving| own.starts_apart(o) && own.meets(o);
            let met = answering.iter().find(|(_, moving)| is_met(moving));
            let meets = met.is_some() || others.iter().any(|o| is_met(o));
            // Nothing was asked that would be missed by waiting behind whoever is in the lawful way.
            let free = actor.plan.target.position.is_none();
            let leaves = leaves_the_road(actor, &shown.motion);
            let breaks = free && (leaves || is_against_traffic(actor, &shown.motion));
            if !meets && !leaves && !breaks {
                return (Vec::new(), None);
            }
            // Who only replays its log would answer if it might: to halt before it says nothing of the goal.
            let halts = breaks
                || meets
                    && (may_answer || met.is_some_and(|(_, moving)| moving.stands()))
                    && !is_asked_to_meet(actor, &shown.motion, &others);
            let costs = &choice.agents[i];
            let mut order: Vec<usize> = (0..candidates[i].len()).collect();
            order.sort_by(|a, b| costs[*a].cost.total_cmp(&costs[*b].cost));
            order.retain(|o| *o != chosen[i]);
            order.insert(0, chosen[i]);
            let tried = order.into_iter().filter_map(|o| Some((o, candidates[i][o].origin.slot()?)));
            let off_lanes_m = self.tuning().choice.off_lanes_m;
            let weights = &self.tuning().replan;
            let field = Field { graph: &self.map.graph, off_lanes_m, weights, others: &others };
            let size = &actor.plan.present.size;
            let is_clear = |c: &Candidate| {
                let boxes = swept(&c.motion.states, size);
                !others.iter().any(|o| own.starts_apart(o) && overlap(&boxes, &o.swept).overlaps)
            };
            let mut found: Vec<Candidate> = Vec::new();
            // What no way reaches is missed for its own reason, whoever is in the way.
            let missed_for = |motion: Motion, o: usize| motion.for_want_of(candidates[i][o].motion.reach);
            let before = self.material(i).shown_halting().filter(|c| halts && is_clear(c));
            found.extend(before.map(|c| Candidate { motion: missed_for(c.motion, chosen[i]), ..c }));
            for (o, slot) in tried.take(MOST_TRIED) {
                let plan = &actor.plan;
                let states = &candidates[i][o].motion.states;
                let mut add = |origin, motion: Option<Motion>| {
                    found.extend(motion.map(|motion| Candidate { probability: 0.0, origin, motion }));
                };
                add(Origin::Evading(slot), way_round(plan, field, slot, states));
                if halts {
                    let halting = short_of(plan, field, states);
                    add(Origin::Halting(slot), halting.map(|motion| missed_for(motion, o)));
                }
            }
            (found, met.map(|(id, _)| (*id).clone()))
        });
        let mut changes = false;
        for (i, (found, met)) in found.into_iter().enumerate().filter(|(_, (found, _))| !found.is_empty()) {
            blockers[i] = blockers[i].take().or(met);
            candidates[i].extend(found);
            choice.agents[i] = self.options(judge, i, &candidates[i]);
            changes = true;
        }
        changes
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
        let meets = |&o: &usize| self.answerers.are_met_by(&options[o].boxes);
        let met: Vec<usize> = (0..candidates.len()).filter(meets).collect();
        let burdens = self.workers().map(&met, |&o| self.burden(i, &candidates[o]));
        for (o, burden) in met.into_iter().zip(burdens) {
            options[o].cost += burden;
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

/// A vehicle on the road is led off it although its goal, if it has one, lies on it.
fn leaves_the_road(actor: &Actor, motion: &Motion) -> bool {
    let Some(ground) = &actor.plan.ground else { return false };
    let is_off = |state: &MotionState| {
        let outline = OrientedBox::of_state(&State::from(state), &actor.plan.present.size);
        ground.box_outside_m(&outline).is_some_and(|m| m > BEYOND_M)
    };
    let goal = actor.plan.target.position.and_then(|_| motion.states.get(actor.plan.target.step));
    !goal.is_some_and(is_off) && motion.states.iter().step_by(PER_INSTANT).any(is_off)
}

/// A vehicle on the road is led against the traffic.
fn is_against_traffic(actor: &Actor, motion: &Motion) -> bool {
    let ground = actor.plan.ground.as_deref();
    ground.is_some_and(|ground| {
        motion.states.iter().step_by(PER_INSTANT).any(|state| drives_against(ground, state))
    })
}

/// The goal lies where somebody is when it is due: to meet them there is what was asked.
fn is_asked_to_meet(actor: &Actor, motion: &Motion, others: &[&Moving]) -> bool {
    let target = &actor.plan.target;
    let there = motion.states.get(target.step).filter(|_| target.position.is_some());
    there.is_some_and(|state| {
        let outline = OrientedBox::of_state(&State::from(state), &actor.plan.present.size);
        let places = others.iter().filter_map(|other| other.boxes.get(target.step)?.as_ref());
        places.into_iter().any(|place| overlaps(&outline, place, 0.0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(chosen: Vec<usize>) -> Settled {
        Settled { chosen, causes: Vec::new(), changed: Vec::new(), answered: Vec::new() }
    }

    /// Rounds that are run, and the choice after them, where each of them ends in one of these choices.
    fn rounds(choices: &[Option<&[usize]>]) -> (usize, Vec<usize>) {
        let mut count = 0;
        let next = |count: &mut usize, _: &Settled| {
            *count += 1;
            choices[*count - 1].map(<[usize]>::to_vec)
        };
        let last = replan_rounds(choices.len(), &mut count, settled(vec![2, 0]), next, |_, c| settled(c));
        (count, last.chosen)
    }

    #[test]
    fn a_reaction_without_a_cause_starts_no_further_round() {
        // The new candidates let the second actor react; without a cause it has its kept motion again.
        assert_eq!(rounds(&[Some(&[2, 0]), Some(&[2, 0])]), (1, vec![2, 0]));
    }

    #[test]
    fn rounds_go_on_while_the_choice_changes_and_end_where_nothing_is_found() {
        assert_eq!(rounds(&[Some(&[3, 0]), Some(&[3, 1])]), (2, vec![3, 1]));
        assert_eq!(rounds(&[None, Some(&[3, 1])]), (1, vec![2, 0]));
    }
}
