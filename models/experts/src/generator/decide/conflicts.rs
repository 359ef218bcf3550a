//! Resolves conflicts of drivers without goals that remain after the joint choice, earliest first: one of the two road
//! users drives behind the other.

use super::{OptionTable, Settled};
use crate::generator::candidates::MotionCandidate;
use crate::generator::choice::price;
use crate::generator::motion::Sweep;
use crate::tuning::fixed::giving_way::PASSED_ON;
use scene::motion::MotionKind;
use std::sync::Arc;

/// Limit of decisions of one driver.
const MOST_DECISIONS: usize = 3;
/// Limit of other options that are tried for a driver that is in danger or breaks a rule.
const MOST_ALTERNATIVES: usize = 4;
/// Limits of decisions that follow such a try, and of those that follow all tries of a scene: they take the most time
/// of a crowded scene.
const MOST_ANSWERS: usize = 8;
const MOST_ANSWERS_IN_ALL: usize = 24;

/// The present choice, with the dangers that remain.
#[derive(Clone)]
struct Decision<'a> {
    /// Index of the candidate of each actor.
    chosen: Vec<usize>,
    sweeps: Vec<Arc<Sweep>>,
    /// The motions of the agents that do not act.
    fixed: Vec<&'a Sweep>,
    /// The first dangerous step of each actor with each other actor, then with each fixed motion.
    dangers: Vec<Vec<Option<usize>>>,
    /// Whether each actor is a driver without a goal.
    may_yield: Vec<bool>,
    /// Number of decisions that each actor may still make; `None` before its first turn.
    left: Vec<Option<usize>>,
    /// Number of decisions that all actors together may still make.
    budget: usize,
}

impl Decision<'_> {
    /// All motions except that of actor `but`.
    fn others(&self, but: usize) -> Vec<&Sweep> {
        let actors = self.sweeps.iter().enumerate().filter(|(j, _)| *j != but).map(|(_, sweep)| &**sweep);
        self.fixed.iter().copied().chain(actors).collect()
    }

    /// The motions that endanger an actor.
    fn endangering(&self, i: usize) -> Vec<&Sweep> {
        let all = self.sweeps.iter().map(|sweep| &**sweep).chain(self.fixed.iter().copied());
        all.zip(&self.dangers[i]).filter(|(_, danger)| danger.is_some()).map(|(sweep, _)| sweep).collect()
    }

    /// The same choice, before a try of another option that so many decisions may follow.
    fn without_turns(&self, budget: usize) -> Self {
        Self { left: vec![None; self.left.len()], budget, ..self.clone() }
    }

    /// Whether an actor may decide now.
    fn has_turn(&self, i: usize) -> bool {
        self.left.get(i).is_some_and(|left| left.is_some_and(|left| left > 0))
    }

    /// Whether an actor may decide, now or once it is endangered.
    fn can_decide(&self, i: usize) -> bool {
        self.has_turn(i) || self.may_yield[i] && self.left[i].is_none()
    }

    /// Lets a driver without a goal decide, if it has had no turn.
    fn give_turn(&mut self, i: usize) {
        if self.may_yield[i] {
            self.left[i].get_or_insert(MOST_DECISIONS);
        }
    }

    /// Puts an actor on another option. Those whom it endangers now may decide.
    fn take(&mut self, i: usize, option: usize, sweep: &Arc<Sweep>) {
        self.chosen[i] = option;
        self.sweeps[i] = Arc::clone(sweep);
        let before = self.dangers[i].clone();
        self.update(i);
        for j in 0..self.sweeps.len() {
            if self.dangers[i][j].is_some() && self.dangers[i][j] != before[j] {
                self.give_turn(j);
            }
        }
    }

    /// The actors that have another option than in `other`.
    fn changed_from(&self, other: &Self) -> Vec<usize> {
        (0..self.chosen.len()).filter(|i| self.chosen[*i] != other.chosen[*i]).collect()
    }

    /// Recomputes the dangers of one actor.
    fn update(&mut self, i: usize) {
        let own = &self.sweeps[i];
        let with = |other: &Sweep| own.first_danger(other);
        let actors = self.sweeps.iter().enumerate().map(|(j, other)| if j == i { None } else { with(other) });
        self.dangers[i] = actors.chain(self.fixed.iter().map(|other| with(other))).collect();
        for j in (0..self.sweeps.len()).filter(|j| *j != i) {
            self.dangers[j][i] = self.dangers[i][j];
        }
    }

    /// The pair with the earliest danger of an actor that may still decide. The second index may be that of a fixed
    /// motion.
    fn earliest(&self) -> Option<(usize, usize)> {
        let of = |i: usize| {
            self.dangers[i].iter().enumerate().filter_map(move |(j, step)| Some((*step.as_ref()?, i, j)))
        };
        let deciding = (0..self.sweeps.len()).filter(|i| self.has_turn(*i));
        deciding.flat_map(of).min().map(|(_, i, j)| (i, j))
    }
}

impl OptionTable<'_> {
    /// Lets drivers without goals that are still in conflict drive behind the other road user, if that lowers the cost.
    /// One that remains in danger or breaks a road rule tries its other options, and the others may then drive behind it:
    /// the first of a queue that brakes needs followers that brake too.
    pub(super) fn resolve(&mut self, settled: Settled) -> Settled {
        let of = self.of;
        let yields = |i: &usize| {
            let actor = &of.actors[*i];
            let drives = actor.plan.model.kind == MotionKind::Drive && actor.plan.target.position.is_none();
            drives && actor.kept.is_none() && !actor.keeps_still()
        };
        let may_yield: Vec<bool> = of.indices().iter().map(yields).collect();
        let drivers: Vec<usize> = of.indices().into_iter().filter(|i| may_yield[*i]).collect();
        if drivers.is_empty() {
            return settled;
        }
        let others = of.others.with(&settled.reacted);
        let sweeps: Vec<Arc<Sweep>> =
            settled.changed.iter().map(|changed| Arc::clone(&changed.sweep)).collect();
        let fixed: Vec<&Sweep> = others.iter().map(|(_, sweep)| sweep.as_ref()).collect();
        let dangers = vec![vec![None; sweeps.len() + fixed.len()]; sweeps.len()];
        let left = vec![None; sweeps.len()];
        let chosen = settled.chosen.clone();
        let budget = MOST_DECISIONS * drivers.len();
        let mut best = Decision { chosen, sweeps, fixed, dangers, may_yield, left, budget };
        for i in of.indices() {
            best.update(i);
        }
        let mut next = best.clone();
        drivers.iter().for_each(|i| next.give_turn(*i));
        self.try_decision(next, &mut best);
        let mut budget = MOST_ANSWERS_IN_ALL;
        for &i in &drivers {
            for option in self.alternatives(i, &best) {
                let most = budget.min(MOST_ANSWERS);
                let mut next = best.without_turns(most);
                next.left[i] = Some(0);
                next.take(i, option, &self.choice.agents[i][option].sweep);
                budget -= most - self.try_decision(next, &mut best);
            }
            if budget == 0 {
                break;
            }
        }
        if best.chosen == settled.chosen { settled } else { self.settled(best.chosen) }
    }

    /// Lets the drivers decide, and keeps the result if it has fewer collisions, or as many and costs less. Returns
    /// what is left of its budget.
    fn try_decision<'f>(&mut self, mut next: Decision<'f>, best: &mut Decision<'f>) -> usize {
        self.yield_in_turn(&mut next);
        let left = next.budget;
        let changed = next.changed_from(best);
        let (most, dearest) = self.joint_cost(best, &changed);
        let (overlaps, cost) = self.joint_cost(&next, &changed);
        if overlaps < most || overlaps == most && cost < dearest - 1e-9 {
            *best = next;
        }
        left
    }

    /// Options to try for a driver that is in danger or breaks a rule, the cheapest first: they avoid the danger, or break
    /// fewer rules.
    fn alternatives(&mut self, i: usize, now: &Decision<'_>) -> Vec<usize> {
        let chosen = now.chosen[i];
        let broken = self.choice.agents[i][chosen].rule_cost;
        let own = &now.sweeps[i];
        let met: Vec<&Sweep> = now.endangering(i).into_iter().filter(|o| own.starts_apart(o)).collect();
        if met.is_empty() && broken == 0.0 {
            return Vec::new();
        }
        let all = now.others(i);
        let cheapest = self.cheapest(i).into_iter();
        let behind: Vec<MotionCandidate> = cheapest.flat_map(|option| self.behind(i, option, &all)).collect();
        self.add(i, behind);
        let (_, now_costs) = self.joint_cost(now, &[i]);
        let options = &self.choice.agents[i];
        // Whatever the others do, a dearer option saves nothing.
        let helps = |o: &usize| {
            let option = &options[*o];
            option.cost < now_costs - 1e-9
                && (!met.is_empty() || option.rule_cost < broken)
                && !met.iter().any(|other| option.sweep.first_danger(other).is_some())
        };
        let mut found: Vec<usize> = (0..options.len()).filter(helps).collect();
        found.sort_by(|a, b| options[*a].cost.total_cmp(&options[*b].cost));
        found.truncate(MOST_ALTERNATIVES);
        found
    }

    /// Lets the drivers decide, earliest danger first, until no decision helps.
    fn yield_in_turn(&mut self, now: &mut Decision<'_>) {
        while let Some((i, j)) = now.earliest().filter(|_| now.budget > 0) {
            let pair = [i, j];
            let deciding: Vec<usize> = pair.into_iter().filter(|k| now.has_turn(*k)).collect();
            let mut best: Option<(f64, usize, usize)> = None;
            for &k in &deciding {
                let Some((gain, option)) = self.yielding(k, now) else { continue };
                if best.is_none_or(|(most, ..)| gain > most) {
                    best = Some((gain, k, option));
                }
            }
            // If no option helps, a later change of another actor may.
            for k in best.map_or(deciding, |(_, k, _)| vec![k]) {
                now.left[k] = now.left[k].map(|left| left - 1);
            }
            now.budget -= 1;
            if let Some((_, k, option)) = best {
                now.take(k, option, &self.choice.agents[k][option].sweep);
            }
        }
    }

    /// Number of overlapping pairs with one of these actors, and what they add to the cost of a choice: the cost of
    /// each option by itself, and of all encounters.
    fn joint_cost(&self, of: &Decision<'_>, among: &[usize]) -> (usize, f64) {
        let tuning = self.choice.tuning;
        let (mut overlaps, mut cost) = (0, 0.0);
        for &i in among {
            let own = &of.sweeps[i];
            cost += self.choice.agents[i][of.chosen[i]].cost;
            // A pair of two of these actors counts once.
            let with = (0..of.sweeps.len()).filter(|j| *j != i && (*j > i || !among.contains(j)));
            let with = with.map(|j| &*of.sweeps[j]);
            for other in with.chain(of.fixed.iter().copied()) {
                let met = price(own.swept(), other.swept(), tuning);
                cost += met;
                // The compared boxes are too far apart in time to find every touch.
                overlaps += usize::from(met > 0.0 && own.meets(other));
            }
        }
        (overlaps, cost)
    }

    /// The cost that the best option behind the others saves, and its index; `None` if no such option saves cost.
    fn yielding(&mut self, i: usize, now: &Decision<'_>) -> Option<(f64, usize)> {
        let all = now.others(i);
        let total = |table: &Self, option: usize| {
            let option = &table.choice.agents[i][option];
            let met = |other: &Sweep| price(option.sweep.swept(), other.swept(), table.choice.tuning);
            let fixed: f64 = now.fixed.iter().map(|other| met(other)).sum();
            let actors = now.sweeps.iter().enumerate().filter(|(j, _)| *j != i);
            let actors =
                actors.map(|(j, other)| if now.can_decide(j) { PASSED_ON } else { 1.0 } * met(other));
            option.cost + fixed + actors.sum::<f64>()
        };
        let meant = self.cheapest(i)?;
        let before = total(self, now.chosen[i]);
        let mut bases = vec![now.chosen[i]];
        bases.extend(Some(meant).filter(|meant| *meant != now.chosen[i]));
        let found: Vec<MotionCandidate> =
            bases.into_iter().flat_map(|option| self.behind(i, option, &all)).collect();
        let found = self.add(i, found).into_iter().map(|option| (before - total(self, option), option));
        found.filter(|(gain, _)| *gain > 1e-9).max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
    }
}
