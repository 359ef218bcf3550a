//! One future for each actor, once the drafts are refined.

mod conflicts;

use crate::features::agent::AgentPlan;
use crate::generator::candidates::{CandidateOrigin, Material, MotionCandidate, own, shown};
use crate::generator::choice::{Choice, FixedMotion, JointOption};
use crate::generator::costs::{Yardstick, options};
use crate::generator::decisions::{Decided, Decisions};
use crate::generator::guidance::guided;
use crate::generator::joint_drafts::JointDrafts;
use crate::generator::motion::Sweep;
use crate::generator::others::{ChangedMotion, Following, Reacted, caused, reaction_of};
use crate::generator::replan::{ReplanField, stop_before, swerve};
use crate::generator::repulsion::{Outline, outlines};
use crate::generator::road_rules::{is_against_traffic, leaves_the_road};
use crate::generator::trajectory::{Rollout, short_along};
use crate::generator::verdict::{ChangedAgent, JudgedMotion, window_judge};
use crate::planning::PER_INSTANT;
use crate::request::{React, Shown};
use crate::tuning::fixed::following::BRAKES;
use crate::tuning::fixed::shown_last;
use scene::judge::{Fault, FaultKind, Judge};
use scene::motion::{MotionKind, Smoothing};
use scene::score::{dangerous_moments, overlap};
use scene::{AgentId, Future, STEP_S, State};
use std::borrow::Cow;
use std::sync::Arc;

/// Limit of motions of one actor that are replanned in a round.
const MOST_TRIED: usize = 2;
/// Limits of futures that are judged to replace one with a fault: those that reach the goal, and those that miss it.
const MOST_JUDGED: usize = 10;
const MOST_STOPS: usize = 4;
/// Limit of replanning rounds: an agent that swerves around one agent may meet another.
const MOST_ROUNDS: usize = 2;

/// Chooses one candidate for each actor, and the reactions of the others.
pub(super) fn decide(of: JointDrafts<'_>) -> Decisions {
    let setting = of.setting;
    let judge = window_judge(setting);
    let fixed: Vec<FixedMotion<'_>> = of.others.kept().collect();
    let choice = Choice::new(Vec::new(), &fixed, &setting.tuning().choice);
    let mut table = OptionTable { of, judge, choice, candidates: Vec::new() };
    let made = setting.workers().map(&of.indices(), |&i| table.options_of(i, of.first_material(i).0));
    let (candidates, options) = made.into_iter().unzip();
    table.candidates = candidates;
    table.choice = Choice::new(options, &fixed, &setting.tuning().choice);
    let mut chosen = match setting.request.stages.shown {
        Shown::Chosen => table.solved(),
        Shown::Likeliest | Shown::Drawn => {
            let each = of.actors.iter().zip(of.drafts).zip(&table.candidates);
            each.map(|((actor, drafts), all)| own(actor, drafts.leading, all)).collect()
        }
    };
    if setting.request.stages.guidance {
        table.guide(&mut chosen);
    }
    let mut blockers: Vec<Option<AgentId>> = vec![None; of.actors.len()];
    let rounds = if setting.request.stages.guidance { MOST_ROUNDS } else { 0 };
    let first = table.settled(chosen);
    let replan = |table: &mut OptionTable<'_>, settled: &Settled| {
        table.replan(settled, &mut blockers).then(|| {
            let mut chosen = table.choice.solve();
            table.restore_uncaused(&mut chosen);
            chosen
        })
    };
    let settled = replan_rounds(rounds, &mut table, first, replan, OptionTable::settled);
    let settled = if rounds > 0 { table.resolve(settled) } else { settled };
    let settled = table.without_fault(settled);
    table.decisions(settled, &blockers)
}

/// Replans at most `most` times, until the choice no longer changes. `replan` returns the next choice without its
/// uncaused reactions, or `None` if it finds no new candidate.
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

/// A choice without uncaused reactions, and the reactions of the others to it.
struct Settled {
    /// Index of the candidate of each actor.
    chosen: Vec<usize>,
    /// The agent that causes the change of each reacting actor.
    causes: Vec<Option<AgentId>>,
    /// The motions of the actors, as the other agents see them.
    changed: Vec<ChangedMotion>,
    reacted: Vec<Reacted>,
}

/// The candidates of all actors, and the options of the joint choice: one per candidate.
struct OptionTable<'a> {
    of: JointDrafts<'a>,
    judge: Judge<'a>,
    choice: Choice<'a>,
    candidates: Vec<Vec<MotionCandidate>>,
}

impl OptionTable<'_> {
    /// A choice with its uncaused reactions undone, and the reactions of the others to it.
    fn settled(&self, mut chosen: Vec<usize>) -> Settled {
        let causes = self.restore_uncaused(&mut chosen);
        let changed: Vec<ChangedMotion> = chosen
            .iter()
            .enumerate()
            .map(|(i, option)| {
                let sweep = Arc::clone(&self.choice.agents[i][*option].sweep);
                self.change(i, &self.candidates[i][*option], sweep)
            })
            .collect();
        let reacted = self.of.others.reactions(&changed.iter().collect::<Vec<_>>());
        Settled { chosen, causes, changed, reacted }
    }

    /// Replaces the future of the only regenerated agent, if it has a goal and the future has a fault. The first future
    /// without a fault is taken, those that reach the goal and cost less first. If all have faults, the mildest one is
    /// taken.
    fn without_fault(&self, settled: Settled) -> Settled {
        let stages = &self.of.setting.request.stages;
        let free = |i: &usize| self.of.actors[*i].kept.is_none() && !self.of.actors[*i].keeps_still();
        let asked: Vec<usize> = self.of.indices().into_iter().filter(free).collect();
        let &[i] = &asked[..] else { return settled };
        let goes = self.of.actors[i].plan.target.position.is_some();
        if !goes || !stages.judged || stages.shown != Shown::Chosen {
            return settled;
        }
        let (settled, worst) = self.as_shown_last(i, settled);
        let Some(worst) = worst else { return settled };
        let chosen = settled.chosen[i];
        let goes_on = self.candidates[i][chosen].origin.is_shown();
        let misses = |o: usize| !self.candidates[i][o].motion.reach.is_reached();
        let costs = &self.choice.agents[i];
        let another = |o: usize| !self.candidates[i][o].origin.is_shown();
        let mut order: Vec<usize> = (0..costs.len()).filter(|o| *o != chosen).collect();
        order.sort_by(|a, b| another(*a).cmp(&another(*b)).then(costs[*a].cost.total_cmp(&costs[*b].cost)));
        let (missing, reaching): (Vec<usize>, Vec<usize>) = order.into_iter().partition(|o| misses(*o));
        let mut best = (worst, settled);
        for (options, most) in [(reaching, MOST_JUDGED), (missing, MOST_STOPS)] {
            for o in options.into_iter().take(most) {
                // A future that misses the goal is only accepted to avoid a collision.
                if misses(o) && best.0 != FaultKind::Collision {
                    break;
                }
                let alone = self.judged(i, o).alone(&self.judge);
                // Other agents can only add faults.
                let is_no_better = |fault| fault <= best.0 || goes_on && best.0 != FaultKind::Collision;
                if worst_kind(alone.iter()).is_some_and(is_no_better) {
                    continue;
                }
                let next = self.with_option(i, o, &best.1);
                let among = self.faults_among(i, &next);
                let Some(worst) = worst_kind(alone.iter().chain(&among)) else { return next };
                // The last shown motion is only left for another faulty one to avoid a collision.
                if worst > best.0 && (!goes_on || best.0 == FaultKind::Collision) {
                    best = (worst, next);
                }
            }
        }
        best.1
    }

    /// The choice with the last shown motion, if that reaches the goal and has no worse fault. Also returns the worst
    /// fault of the result. Slight faults of the last shown motion are ignored.
    fn as_shown_last(&self, i: usize, settled: Settled) -> (Settled, Option<FaultKind>) {
        let stays = |o: usize| {
            let candidate = &self.candidates[i][o];
            candidate.origin.is_shown() && candidate.motion.reach.is_reached()
        };
        let Some(shown) = (0..self.candidates[i].len()).find(|o| stays(*o)) else {
            let worst = self.worst_fault(i, &settled);
            return (settled, worst);
        };
        let grave = |of: &Settled| worst_kind(self.faults(i, of).iter().filter(|fault| !is_slight(fault)));
        if settled.chosen[i] == shown {
            let fault = grave(&settled);
            return (settled, fault);
        }
        let kept = self.with_option(i, shown, &settled);
        let fault = grave(&kept);
        let worst = self.worst_fault(i, &settled);
        // Kinds of faults are ordered from worst to mildest.
        let no_worse = fault.is_none_or(|fault| worst.is_some_and(|worst| fault >= worst));
        if no_worse { (kept, fault) } else { (settled, worst) }
    }

    /// The choice with one actor on another candidate.
    fn with_option(&self, i: usize, option: usize, settled: &Settled) -> Settled {
        let mut chosen = settled.chosen.clone();
        chosen[i] = option;
        self.settled(chosen)
    }

    /// The worst fault of the chosen motion of an actor.
    fn worst_fault(&self, i: usize, settled: &Settled) -> Option<FaultKind> {
        worst_kind(self.faults(i, settled).iter())
    }

    /// All faults of the chosen motion of an actor.
    fn faults(&self, i: usize, settled: &Settled) -> Vec<Fault> {
        let mut faults = self.judged(i, settled.chosen[i]).alone(&self.judge);
        faults.extend(self.faults_among(i, settled));
        faults
    }

    /// The motion of an option, in the form for the judge.
    fn judged(&self, i: usize, option: usize) -> JudgedMotion<'_> {
        let agent = self.of.actors[i].plan.present.index;
        JudgedMotion::new(self.of.setting, agent, &self.candidates[i][option].motion.states)
    }

    /// The faults of the chosen motion of an actor that involve other agents.
    fn faults_among(&self, i: usize, settled: &Settled) -> Vec<Fault> {
        let setting = self.of.setting;
        let first_step = setting.world.step + 1;
        let id = &self.of.actors[i].id;
        let acting = |(j, option): (usize, &usize)| {
            let (actor, motion) = (&self.of.actors[j], &self.candidates[j][*option]);
            let changes = motion.origin != CandidateOrigin::Kept;
            (changes && j != i).then(|| ChangedAgent {
                agent: actor.plan.present.index,
                future: Future::bare(1.0, first_step, setting.cut(&motion.motion.states)),
                is_caused: settled.causes[j].as_ref() == Some(id),
            })
        };
        let reacted = settled.reacted.iter().map(|reacted| ChangedAgent {
            agent: reacted.index,
            future: reacted.future(setting),
            is_caused: reacted.reaction.as_ref().is_some_and(|r| r.cause == *id),
        });
        let changed: Vec<_> = settled.chosen.iter().enumerate().filter_map(acting).chain(reacted).collect();
        self.judged(i, settled.chosen[i]).among(&self.judge, &changed)
    }

    fn change(&self, i: usize, taken: &MotionCandidate, sweep: Arc<Sweep>) -> ChangedMotion {
        ChangedMotion { id: self.of.actors[i].id.clone(), sweep, kept: taken.origin == CandidateOrigin::Kept }
    }

    fn sweep(&self, i: usize, candidate: &MotionCandidate) -> Sweep {
        Sweep::of_rollout(&candidate.motion.states, &self.of.actors[i].plan.present.size)
    }

    /// The futures of each actor, and which of them is shown.
    fn decisions(self, settled: Settled, blockers: &[Option<AgentId>]) -> Decisions {
        let setting = self.of.setting;
        let (count, unlawful) = (setting.request.modes.max(1), setting.tuning().probability.unlawful);
        let each = self.of.actors.iter().zip(&self.candidates).zip(&settled.chosen).enumerate();
        let actors = each.filter_map(|(i, ((actor, candidates), chosen))| {
            let lawful: Vec<f64> =
                self.choice.agents[i].iter().map(|o| (-unlawful * o.rule_cost).exp()).collect();
            let (chosen, alternatives) = shown(candidates.clone(), &lawful, *chosen, count)?;
            let reaction = settled.causes[i].as_ref().and_then(|cause| {
                let motion = &alternatives[chosen].motion.states;
                let from_s = setting.world.step as f64 * STEP_S;
                Some(reaction_of(actor.kept.as_ref()?, motion, cause.clone(), from_s))
            });
            let halts = alternatives[chosen].motion.reach.is_for_traffic();
            let blocked_by = blockers[i].clone().filter(|_| halts);
            let agent = actor.plan.present.index;
            let reactions = self.reactions_to_each(i, chosen, &alternatives, &settled.changed);
            Some(Decided { agent, actor: i, chosen, alternatives, reaction, blocked_by, reactions })
        });
        Decisions { actors: actors.collect(), reacted: settled.reacted }
    }

    /// The reactions to each alternative of an actor, with the shown motions of all other actors. Only the
    /// verdicts need them, and only those of the agents that the call regenerates.
    fn reactions_to_each(
        &self,
        i: usize,
        chosen: usize,
        alternatives: &[MotionCandidate],
        changed: &[ChangedMotion],
    ) -> Vec<Option<Vec<Reacted>>> {
        let JointDrafts { setting, others, .. } = self.of;
        if !setting.request.stages.judged
            || setting.request.react == React::Nobody
            || self.of.actors[i].kept.is_some()
            || setting.world.step > setting.request.start_step
        {
            return Vec::new();
        }
        let shown_matters = others.would_react_to(&changed[i].sweep);
        let each: Vec<usize> = (0..alternatives.len()).collect();
        setting.workers().map(&each, |&k| {
            let taken = alternatives.get(k).filter(|_| k != chosen)?;
            let other = self.change(i, taken, Arc::new(self.sweep(i, taken)));
            if !shown_matters && !others.would_react_to(&other.sweep) {
                return None;
            }
            let seen: Vec<&ChangedMotion> =
                changed.iter().enumerate().map(|(j, c)| if j == i { &other } else { c }).collect();
            Some(others.reactions(&seen))
        })
    }

    /// Adds replanned motions of actors that still meet another agent, leave the road for a goal on it, or break rules
    /// without a goal. Returns whether it added any. Sets the agents that are met in `blockers`.
    fn replan(&mut self, settled: &Settled, blockers: &mut [Option<AgentId>]) -> bool {
        let others = self.of.others.with(&settled.reacted);
        let found =
            self.of.setting.workers().map(&self.of.indices(), |&i| self.replanned(i, settled, &others));
        let mut changes = false;
        for (i, (found, met)) in found.into_iter().enumerate().filter(|(_, (found, _))| !found.is_empty()) {
            blockers[i] = blockers[i].take().or(met);
            let known = self.candidates[i].len();
            changes |= self.add(i, found).into_iter().any(|option| option >= known);
        }
        changes
    }

    /// Adds candidates of an actor and their options, and returns the option index of each. Known candidates are not
    /// added twice.
    fn add(&mut self, i: usize, found: Vec<MotionCandidate>) -> Vec<usize> {
        let candidates = &mut self.candidates[i];
        let known = candidates.len();
        let place = |new: MotionCandidate| {
            let is_same = |c: &MotionCandidate| c.origin == new.origin && c.motion == new.motion;
            candidates.iter().position(is_same).unwrap_or_else(|| {
                candidates.push(new);
                candidates.len() - 1
            })
        };
        let added: Vec<usize> = found.into_iter().map(place).collect();
        if self.candidates[i].len() > known {
            let options = self.options(i, &self.candidates[i], &self.choice.agents[i]);
            self.choice.set_options(i, options);
        }
        added
    }

    /// Replanned motions of one actor, and the agent that its chosen motion meets.
    fn replanned(
        &self,
        i: usize,
        settled: &Settled,
        others: &[(&AgentId, Cow<'_, Sweep>)],
    ) -> (Vec<MotionCandidate>, Option<AgentId>) {
        let setting = self.of.setting;
        let (actor, candidates, chosen) = (&self.of.actors[i], &self.candidates[i], settled.chosen[i]);
        let shown = &candidates[chosen];
        if actor.kept.is_some() || actor.keeps_still() || shown.origin == CandidateOrigin::Rest {
            return (Vec::new(), None);
        }
        let actors = settled.changed.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, c)| &*c.sweep);
        let all: Vec<&Sweep> = others.iter().map(|(_, sweep)| sweep.as_ref()).chain(actors).collect();
        let own = &settled.changed[i].sweep;
        let is_met = |o: &Sweep| own.starts_apart(o) && own.meets(o);
        let met = others.iter().find(|(_, sweep)| is_met(sweep));
        let endangers =
            |o: &&Sweep| own.starts_apart(o) && dangerous_moments(own.swept(), o.swept()).next().is_some();
        let collides = met.is_some() || all.iter().any(|o| is_met(o));
        let meets = collides || all.iter().any(endangers);
        // Without a goal, waiting behind another agent misses nothing and breaks no rule.
        let free = actor.plan.target.position.is_none();
        let leaves = leaves_the_road(actor, &shown.motion);
        let breaks = free && (leaves || is_against_traffic(actor, &shown.motion));
        if !meets && !leaves && !breaks {
            return (self.behind_others(i, settled, &all), None);
        }
        // With reactions off a replaying agent does not yield, so stopping for it would hide that the goal is reachable.
        let may_react = setting.request.react != React::Nobody;
        let stops = breaks || collides && (may_react || met.is_some_and(|(_, sweep)| sweep.stands()));
        let size = &actor.plan.present.size;
        let is_clear = |c: &MotionCandidate| {
            let sweep = Sweep::of_rollout(&c.motion.states, size);
            !all.iter().any(|o| own.starts_apart(o) && overlap(sweep.swept(), o.swept()).overlaps)
        };
        // If the original motion misses the goal too, its reason applies instead of the agent in the way.
        let missed = |motion: Rollout, o: usize| motion.with_reason_of(candidates[o].motion.reach);
        let mut found: Vec<MotionCandidate> = Vec::new();
        let before = self.of.material(i).shown_stopping().filter(|c| stops && is_clear(c));
        found.extend(before.map(|c| MotionCandidate { motion: missed(c.motion, chosen), ..c }));
        let off_lanes_m = setting.tuning().choice.off_lanes_m;
        let weights = &setting.tuning().replan;
        let field = ReplanField { graph: &setting.map.graph, off_lanes_m, weights, others: &all };
        let costs = &self.choice.agents[i];
        let mut order: Vec<usize> = (0..candidates.len()).collect();
        order.sort_by(|a, b| costs[*a].cost.total_cmp(&costs[*b].cost));
        order.retain(|o| *o != chosen);
        order.insert(0, chosen);
        let tried = order.into_iter().filter_map(|o| Some((o, candidates[o].origin.slot()?)));
        for (o, slot) in tried.take(MOST_TRIED) {
            let states = &candidates[o].motion.states;
            found.extend(self.follows(i, o, &all));
            let mut add = |origin, motion: Option<Rollout>| {
                found.extend(motion.map(|motion| MotionCandidate { probability: 0.0, origin, motion }));
            };
            add(CandidateOrigin::Swerving(slot), swerve(&actor.plan, field, slot, states));
            if stops {
                let stopping = stop_before(&actor.plan, field, states);
                add(CandidateOrigin::Stopping(slot), stopping.map(|motion| missed(motion, o)));
            }
        }
        (found, met.map(|(id, _)| (*id).clone()))
    }

    /// The option of an actor that costs least by itself.
    fn cheapest(&self, i: usize) -> Option<usize> {
        let options = &self.choice.agents[i];
        (0..options.len()).min_by(|a, b| options[*a].cost.total_cmp(&options[*b].cost))
    }

    /// The cheapest option by itself, driven behind the agents that it meets, if the choice left it and the actor has
    /// no goal.
    fn behind_others(&self, i: usize, settled: &Settled, all: &[&Sweep]) -> Vec<MotionCandidate> {
        let free = self.of.actors[i].plan.target.position.is_none();
        let meant = self.cheapest(i).filter(|o| *o != settled.chosen[i] && free);
        meant.and_then(|meant| self.follows(i, meant, all)).into_iter().collect()
    }

    /// The motion of an option, driven behind the agents that it meets, with the least braking that avoids all dangers.
    fn follows(&self, i: usize, option: usize, all: &[&Sweep]) -> Option<MotionCandidate> {
        let size = &self.of.actors[i].plan.present.size;
        let is_met =
            |sweep: &Sweep| all.iter().any(|o| sweep.starts_apart(o) && sweep.first_danger(o).is_some());
        self.behind(i, option, all).find(|c| !is_met(&Sweep::of_rollout(&c.motion.states, size)))
    }

    /// The motions of an option behind the agents that it meets, from easy to hard braking.
    fn behind(
        &self,
        i: usize,
        option: usize,
        all: &[&Sweep],
    ) -> impl Iterator<Item = MotionCandidate> + use<'_> {
        let (plan, candidate) = (&self.of.actors[i].plan, &self.candidates[i][option]);
        let own = &self.choice.agents[i][option].sweep;
        let is_met = |o: &&Sweep| own.starts_apart(o) && own.first_danger(o).is_some();
        let slot = candidate.origin.slot().filter(|_| plan.model.kind == MotionKind::Drive);
        let slot = slot.filter(|_| all.iter().any(is_met));
        let following = slot.and_then(|slot| Some((slot, Following::of(own, all)?)));
        following.into_iter().flat_map(move |(slot, following)| {
            let origin = CandidateOrigin::Following(slot);
            BRAKES.iter().filter_map(move |share| {
                let states = following.braking(share * plan.model.limits.brake_mps2)?;
                let motion = driven(plan, &states).with_reason_of(candidate.motion.reach);
                Some(MotionCandidate { probability: 0.0, origin, motion })
            })
        })
    }

    /// Restores the kept motion of reacting actors that changed without a cause. Returns the cause of each other
    /// change, one entry per actor.
    fn restore_uncaused(&self, chosen: &mut [usize]) -> Vec<Option<AgentId>> {
        let option = |i: usize, option: usize| &*self.choice.agents[i][option].sweep;
        let has_own = |i: usize| self.choice.agents[i].first().is_some_and(|o| o.kept);
        let (reacting, asked): (Vec<usize>, Vec<usize>) =
            self.of.indices().into_iter().partition(|i| has_own(*i));
        let actors = self.of.actors;
        let sources = asked.iter().map(|i| (&actors[*i].id, option(*i, chosen[*i])));
        let kept: Vec<_> = reacting.iter().map(|i| option(*i, 0)).collect();
        let changes: Vec<_> = reacting
            .iter()
            .map(|i| (chosen[*i] != 0).then(|| (&actors[*i].id, option(*i, chosen[*i]))))
            .collect();
        let mut causes = vec![None; actors.len()];
        for (i, cause) in reacting.iter().zip(caused(sources.collect(), &kept, &changes)) {
            if cause.is_none() {
                chosen[*i] = 0;
            }
            causes[*i] = cause;
        }
        causes
    }

    /// The joint choice. An actor of a run whose first candidates are insufficient gets all candidates.
    fn solved(&mut self) -> Vec<usize> {
        let chosen = self.choice.solve();
        let of = self.of;
        let conflict = self.choice.in_conflict(&chosen);
        let short = |i: &usize| {
            let (option, candidate) = (&self.choice.agents[*i][chosen[*i]], &self.candidates[*i][chosen[*i]]);
            let misses = !candidate.origin.is_given() && !candidate.motion.reach.is_reached();
            of.first_material(*i).1
                && (conflict[*i] || misses || option.rule_cost > 0.0 || option.burden > 0.0)
        };
        let short: Vec<usize> = of.indices().into_iter().filter(short).collect();
        if short.is_empty() {
            return chosen;
        }
        let all = of.setting.workers().map(&short, |&i| self.options_of(i, of.material(i)));
        for (i, (candidates, options)) in short.into_iter().zip(all) {
            self.candidates[i] = candidates;
            self.choice.set_options(i, options);
        }
        self.choice.solve()
    }

    /// Adds drafts that are guided out of the remaining conflicts of the chosen scene. The choice takes them only if
    /// they cost less.
    fn guide(&mut self, chosen: &mut Vec<usize>) {
        let JointDrafts { setting, actors, drafts, others, .. } = self.of;
        let mut conflict = self.choice.in_conflict(chosen);
        for (i, conflict) in conflict.iter_mut().enumerate() {
            *conflict |= self.burden(i, chosen[i]) >= setting.tuning().choice.close;
        }
        if !conflict.contains(&true) {
            return;
        }
        let energy = self.of.energy();
        let of_actors: Vec<Outline> = (0..actors.len())
            .map(|i| {
                let places = self.candidates[i][chosen[i]].motion.places();
                Outline::new(&places, &actors[i].plan.present.size, energy.tuning)
            })
            .collect();
        let background = outlines(others.sweeps(), energy.tuning);
        let concerned: Vec<usize> =
            self.of.indices().into_iter().filter(|i| conflict[*i] && !actors[*i].keeps_still()).collect();
        let found = setting.workers().map(&concerned, |&i| {
            let near = of_actors.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
            let near: Vec<&Outline> = near.chain(&background).collect();
            let tuning = &setting.tuning().guidance;
            guided(&energy, tuning, &actors[i], &drafts[i].modes, &self.candidates[i], &near)
        });
        for (i, found) in concerned.into_iter().zip(found) {
            self.add(i, found);
        }
        *chosen = self.choice.solve();
    }

    /// The candidates of an actor's material, and their options.
    fn options_of(&self, i: usize, material: Material<'_>) -> (Vec<MotionCandidate>, Vec<JointOption>) {
        let candidates = material.candidates();
        let options = self.options(i, &candidates, &[]);
        (candidates, options)
    }

    /// Options of the candidates of an actor. `known` holds those of the first candidates, which do not change.
    fn options(&self, i: usize, candidates: &[MotionCandidate], known: &[JointOption]) -> Vec<JointOption> {
        let JointDrafts { setting, others, sample, .. } = self.of;
        let actor = &self.of.actors[i];
        let yardstick = Yardstick {
            around: self.of.material(i).around(sample),
            shown: self.of.shown_last(actor),
            under_way: setting.request.under_way,
            map: &setting.map,
            judge: &self.judge,
            others,
            agent: setting.world.agent(&actor.plan.present),
            start_step: setting.world.step,
            tuning: &setting.tuning().choice,
        };
        let mut options = options(actor, candidates, known, &yardstick);
        let matters = |&o: &usize| others.would_react_to(&options[o].sweep);
        let met: Vec<usize> = (known.len()..candidates.len()).filter(matters).collect();
        let cost = |&o: &usize| {
            if candidates[o].origin == CandidateOrigin::Kept { 0.0 } else { others.burden(&options[o].sweep) }
        };
        let burdens = setting.workers().map(&met, cost);
        for (option, known) in options.iter_mut().zip(known) {
            option.burden = known.burden;
        }
        for (o, burden) in met.into_iter().zip(burdens) {
            options[o].burden = burden;
        }
        options.iter_mut().for_each(|option| option.cost += option.burden);
        options
    }

    /// Cost of an actor's option to the others.
    fn burden(&self, i: usize, option: usize) -> f64 {
        let option = &self.choice.agents[i][option];
        if option.kept { 0.0 } else { self.of.others.burden(&option.sweep) }
    }
}

/// The kind of the worst of these faults, without missed goals and via points.
fn worst_kind<'f>(faults: impl Iterator<Item = &'f Fault>) -> Option<FaultKind> {
    faults.map(|fault| fault.kind).filter(|kind| *kind <= FaultKind::NearMiss).min()
}

/// Whether a fault is too slight to replace the last shown future.
fn is_slight(fault: &Fault) -> bool {
    let extent = fault.extent.unwrap_or(f64::INFINITY);
    let most = match fault.kind {
        FaultKind::OffRoad | FaultKind::OverMedian => shown_last::PAST_EDGE_M,
        // A fault of zero length is at the end of the motion and not slight.
        FaultKind::WrongWay if extent > 0.0 => shown_last::WRONG_WAY_M,
        FaultKind::HarshBraking | FaultKind::HarshSteering => shown_last::HARSH_MPS2,
        FaultKind::ForcesBraking => shown_last::FORCED_MPS2,
        FaultKind::Askew => shown_last::ASKEW_RAD,
        _ => return false,
    };
    extent <= most
}

/// Fits states, one per step, to the motion limits of the agent and projects them onto its goal.
fn driven(plan: &AgentPlan, states: &[State]) -> Rollout {
    let last = states.len().saturating_sub(1);
    let centre = |i: usize| states[((i + 1) * PER_INSTANT).min(last)].position();
    short_along(plan, &std::array::from_fn(centre), Smoothing::WISHED, true)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(chosen: Vec<usize>) -> Settled {
        Settled { chosen, causes: Vec::new(), changed: Vec::new(), reacted: Vec::new() }
    }

    /// Number of rounds that run, and the final choice, if successive rounds return these choices.
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
        // The new candidates let the second actor react; without a cause its kept motion is restored.
        assert_eq!(rounds(&[Some(&[2, 0]), Some(&[2, 0])]), (1, vec![2, 0]));
    }

    #[test]
    fn rounds_go_on_while_the_choice_changes_and_end_where_nothing_is_found() {
        assert_eq!(rounds(&[Some(&[3, 0]), Some(&[3, 1])]), (2, vec![3, 1]));
        assert_eq!(rounds(&[None, Some(&[3, 1])]), (1, vec![2, 0]));
    }
}
