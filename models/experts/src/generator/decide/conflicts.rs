//! Resolves conflicts of drivers without goals that remain after the joint choice, earliest first: one of the two road
//! users drives behind the other.

use super::{OptionTable, Settled};
use crate::generator::candidates::MotionCandidate;
use crate::generator::choice::{JointOption, price};
use crate::generator::motion::Sweep;
use crate::tuning::fixed::giving_way::PASSED_ON;
use scene::motion::MotionKind;
use std::sync::Arc;

/// Limit of decisions of one driver.
const MOST_DECISIONS: usize = 3;

/// The present choice, with the dangers that remain.
struct Decision<'a> {
    /// Index of the candidate of each actor.
    chosen: Vec<usize>,
    sweeps: Vec<Arc<Sweep>>,
    /// The motions of the agents that do not act.
    fixed: Vec<&'a Sweep>,
    /// The first dangerous step of each actor with each other actor, then with each fixed motion.
    dangers: Vec<Vec<Option<usize>>>,
    /// Number of decisions that each actor may still make.
    left: Vec<usize>,
}

impl Decision<'_> {
    /// All motions except that of actor `but`.
    fn others(&self, but: usize) -> Vec<&Sweep> {
        let actors = self.sweeps.iter().enumerate().filter(|(j, _)| *j != but).map(|(_, sweep)| &**sweep);
        self.fixed.iter().copied().chain(actors).collect()
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
        let deciding = (0..self.sweeps.len()).filter(|i| self.left[*i] > 0);
        deciding.flat_map(of).min().map(|(_, i, j)| (i, j))
    }
}

impl OptionTable<'_> {
    /// Lets drivers without goals that are still in conflict drive behind the other road user, if that lowers the cost.
    pub(super) fn resolve(&mut self, settled: Settled) -> Settled {
        let of = self.of;
        let yields = |i: &usize| {
            let actor = &of.actors[*i];
            let drives = actor.plan.model.kind == MotionKind::Drive && actor.plan.target.position.is_none();
            drives && actor.kept.is_none() && !actor.keeps_still()
        };
        let left: Vec<usize> =
            of.indices().iter().map(|i| if yields(i) { MOST_DECISIONS } else { 0 }).collect();
        if left.iter().all(|left| *left == 0) {
            return settled;
        }
        let others = of.others.with(&settled.reacted);
        let sweeps: Vec<Arc<Sweep>> =
            settled.changed.iter().map(|changed| Arc::clone(&changed.sweep)).collect();
        let fixed: Vec<&Sweep> = others.iter().map(|(_, sweep)| sweep.as_ref()).collect();
        let dangers = vec![vec![None; sweeps.len() + fixed.len()]; sweeps.len()];
        let mut now = Decision { chosen: settled.chosen.clone(), sweeps, fixed, dangers, left };
        for i in of.indices() {
            now.update(i);
        }
        while let Some((i, j)) = now.earliest() {
            let pair = [i, j];
            let deciding = pair.into_iter().filter(|k| now.left.get(*k).is_some_and(|left| *left > 0));
            let deciding: Vec<usize> = deciding.collect();
            let mut best: Option<(f64, usize, usize)> = None;
            for &k in &deciding {
                let Some((gain, option)) = self.yielding(k, &now) else { continue };
                if best.is_none_or(|(most, ..)| gain > most) {
                    best = Some((gain, k, option));
                }
            }
            // If no option helps, a later change of another actor may.
            for k in best.map_or(deciding, |(_, k, _)| vec![k]) {
                now.left[k] -= 1;
            }
            if let Some((_, k, option)) = best {
                now.chosen[k] = option;
                now.sweeps[k] = Arc::clone(&self.choice.agents[k][option].sweep);
                now.update(k);
            }
        }
        let Decision { chosen, fixed, .. } = now;
        let worse = self.joint_cost(&chosen, &fixed) > self.joint_cost(&settled.chosen, &fixed) - 1e-9;
        if worse { settled } else { self.settled(chosen) }
    }

    /// Cost of a choice: the cost of each option by itself, plus that of all encounters.
    fn joint_cost(&self, chosen: &[usize], fixed: &[&Sweep]) -> f64 {
        let options: Vec<&JointOption> =
            chosen.iter().zip(&self.choice.agents).map(|(option, agent)| &agent[*option]).collect();
        let met = |a: &JointOption, b: &Sweep| price(a.sweep.swept(), b.swept(), self.choice.tuning);
        let one = |(i, option): (usize, &&JointOption)| {
            let later: f64 = options[i + 1..].iter().map(|other| met(option, &other.sweep)).sum();
            option.cost + later + fixed.iter().map(|other| met(option, other)).sum::<f64>()
        };
        options.iter().enumerate().map(one).sum()
    }

    /// The cost that the best option behind the others saves, and its index; `None` if no such option saves cost.
    fn yielding(&mut self, i: usize, now: &Decision<'_>) -> Option<(f64, usize)> {
        let all = now.others(i);
        let total = |table: &Self, option: usize| {
            let option = &table.choice.agents[i][option];
            let met = |other: &Sweep| price(option.sweep.swept(), other.swept(), table.choice.tuning);
            let fixed: f64 = now.fixed.iter().map(|other| met(other)).sum();
            let actors = now.sweeps.iter().enumerate().filter(|(j, _)| *j != i);
            let actors = actors.map(|(j, other)| if now.left[j] > 0 { PASSED_ON } else { 1.0 } * met(other));
            option.cost + fixed + actors.sum::<f64>()
        };
        let options = &self.choice.agents[i];
        let meant = (0..options.len()).min_by(|a, b| options[*a].cost.total_cmp(&options[*b].cost))?;
        let before = total(self, now.chosen[i]);
        let mut bases = vec![now.chosen[i]];
        bases.extend(Some(meant).filter(|meant| *meant != now.chosen[i]));
        let found: Vec<MotionCandidate> =
            bases.into_iter().flat_map(|option| self.behind(i, option, &all)).collect();
        let found = self.add(i, found).into_iter().map(|option| (before - total(self, option), option));
        found.filter(|(gain, _)| *gain > 1e-9).max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))
    }
}
