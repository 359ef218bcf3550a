//! Picks one candidate per actor so that the scene is coherent: coordinate descent with pair moves. It takes
//! microseconds and does not reduce accuracy.

use super::motion::Sweep;
use crate::tuning::ChoiceTuning;
use crate::tuning::fixed::choice::{LEAST_SPREAD_M, MOST_MOMENTS};
use scene::HORIZON_STEPS;
use scene::geometry::obb::overlaps;
use scene::motion::Trajectory;
use scene::score::{CLOSE_M, SweptBounds, SweptBoxes, Thresholds, comes_within, dangerous_moments, overlap};
use std::sync::Arc;

const MOST_SWEEPS: usize = 12;

/// A candidate of an actor as the joint choice sees it.
pub(super) struct JointOption {
    pub(super) sweep: Arc<Sweep>,
    /// Total cost of the candidate by itself.
    pub(super) cost: f64,
    /// Part of `cost` for broken rules.
    pub(super) rule_cost: f64,
    /// Part of `cost` that the other agents bear.
    pub(super) burden: f64,
    /// The agent has this motion without the call, so its distance to other kept motions does not change.
    pub(super) kept: bool,
}

impl JointOption {
    fn boxes(&self) -> &SweptBoxes {
        self.sweep.swept()
    }
}

/// A motion that the choice does not change.
#[derive(Clone, Copy)]
pub(super) struct FixedMotion<'a> {
    pub(super) sweep: &'a Sweep,
    /// For a road user that enters later and stays out if its place is taken: the first and last step of its
    /// entry.
    pub(super) comes_in: Option<(usize, usize)>,
}

impl FixedMotion<'_> {
    fn boxes(&self) -> &SweptBoxes {
        self.sweep.swept()
    }

    /// Whether the road user cannot enter because this motion is in its place then, or too soon after.
    pub(super) fn is_kept_out_by(&self, motion: &Sweep) -> bool {
        let touch = |step: usize| {
            self.sweep.at(step).zip(motion.at(step)).is_some_and(|(own, other)| overlaps(own, other, 0.0))
        };
        self.comes_in.is_some_and(|(first, last)| (first..=last).any(touch))
    }
}

/// Steps between the states at which two motions are compared.
const EVERY: usize = 5;

/// Mean distance of two motions, metres.
pub(super) fn distance(a: &Trajectory, b: &Trajectory) -> f64 {
    let sum: f64 = (EVERY..a.len()).step_by(EVERY).map(|i| (a[i].position - b[i].position).norm()).sum();
    sum / (HORIZON_STEPS / EVERY) as f64
}

/// Cost of each option by itself: its expected distance to the modes, minus the least such distance.
pub(super) fn medoid_costs(options: &[&Trajectory], modes: &[(&Trajectory, f64)]) -> Vec<f64> {
    let expected: Vec<f64> =
        options.iter().map(|o| modes.iter().map(|(m, p)| p * distance(o, m)).sum::<f64>()).collect();
    let least = expected.iter().copied().fold(f64::INFINITY, f64::min).max(LEAST_SPREAD_M);
    expected.into_iter().map(|e| e / least).collect()
}

/// The scene's options and its fixed motions.
pub(super) struct Choice<'a> {
    pub(super) agents: Vec<Vec<JointOption>>,
    pub(super) fixed: &'a [FixedMotion<'a>],
    pub(super) tuning: &'a ChoiceTuning,
    /// Costs of encounters of the options that are computed so far.
    prices: Prices,
}

impl<'a> Choice<'a> {
    /// A choice among these options.
    pub(super) fn new(
        agents: Vec<Vec<JointOption>>,
        fixed: &'a [FixedMotion<'a>],
        tuning: &'a ChoiceTuning,
    ) -> Self {
        let prices = Prices::of(agents.len());
        Self { agents, fixed, tuning, prices }
    }

    /// Replaces the options of a road user. Computed costs stay valid if options were only appended.
    pub(super) fn set_options(&mut self, i: usize, options: Vec<JointOption>) {
        let known = &self.agents[i];
        let same =
            known.iter().zip(&options).all(|(a, b)| Arc::ptr_eq(&a.sweep, &b.sweep) && a.kept == b.kept);
        if !same || known.len() > options.len() {
            self.prices.forget(i);
        }
        self.agents[i] = options;
    }

    /// Index of the chosen option of each road user. The lower index wins ties.
    pub(super) fn solve(&mut self) -> Vec<usize> {
        let mut prices = std::mem::take(&mut self.prices);
        let chosen = self.solved(&mut prices);
        self.prices = prices;
        chosen
    }

    fn solved(&self, prices: &mut Prices) -> Vec<usize> {
        let own = self.own_costs(prices);
        let mut pairs = Pairs { agents: &self.agents, tuning: self.tuning, known: &mut prices.pairs };
        let mut chosen: Vec<usize> = own.iter().map(|costs| least(costs.iter().copied())).collect();
        let near = self.near();
        for _ in 0..MOST_SWEEPS {
            let mut changed = false;
            for i in 0..self.agents.len() {
                let total = |option: usize, pairs: &mut Pairs<'_>| {
                    let with: f64 = near[i].iter().map(|&j| pairs.cost(i, option, j, chosen[j])).sum();
                    own[i][option] + with
                };
                let costs: Vec<f64> = (0..own[i].len()).map(|o| total(o, &mut pairs)).collect();
                let best = least(costs.iter().copied());
                if costs[best] < costs[chosen[i]] - 1e-9 {
                    chosen[i] = best;
                    changed = true;
                }
            }
            changed |= self.pair_moves(&own, &near, &mut pairs, &mut chosen);
            if !changed {
                break;
            }
        }
        chosen
    }

    /// For each road user, whether its chosen option overlaps another chosen option or a fixed motion.
    pub(super) fn in_conflict(&self, chosen: &[usize]) -> Vec<bool> {
        let mut out = vec![false; chosen.len()];
        let near = self.near();
        for (i, &o) in chosen.iter().enumerate() {
            let (boxes, sweep) = (self.agents[i][o].boxes(), &self.agents[i][o].sweep);
            out[i] |= self.fixed.iter().any(|f| overlap(boxes, f.boxes()).close && !f.is_kept_out_by(sweep));
            for &j in near[i].iter().filter(|j| **j > i) {
                if overlap(boxes, self.agents[j][chosen[j]].boxes()).close {
                    out[i] = true;
                    out[j] = true;
                }
            }
        }
        out
    }

    /// Changes both options of a conflicting pair at once, which escapes conflicts that no single change
    /// resolves.
    fn pair_moves(
        &self,
        own: &[Vec<f64>],
        near: &[Vec<usize>],
        pairs: &mut Pairs<'_>,
        chosen: &mut [usize],
    ) -> bool {
        let mut changed = false;
        for i in 0..chosen.len() {
            for &j in near[i].iter().filter(|j| **j > i) {
                if pairs.cost(i, chosen[i], j, chosen[j]) == 0.0 {
                    continue;
                }
                let others =
                    |me: usize, option: usize, but: usize, pairs: &mut Pairs<'_>, chosen: &[usize]| {
                        let rest = near[me].iter().filter(|k| **k != but);
                        own[me][option] + rest.map(|&k| pairs.cost(me, option, k, chosen[k])).sum::<f64>()
                    };
                let mine: Vec<f64> = (0..own[i].len()).map(|a| others(i, a, j, pairs, chosen)).collect();
                let theirs: Vec<f64> = (0..own[j].len()).map(|b| others(j, b, i, pairs, chosen)).collect();
                let (a0, b0) = (chosen[i], chosen[j]);
                let mut best = (mine[a0] + theirs[b0] + pairs.cost(i, a0, j, b0) - 1e-9, a0, b0);
                for a in 0..mine.len() {
                    for b in 0..theirs.len() {
                        let bound = mine[a] + theirs[b];
                        if bound < best.0 {
                            let cost = bound + pairs.cost(i, a, j, b);
                            if cost < best.0 {
                                best = (cost, a, b);
                            }
                        }
                    }
                }
                if (best.1, best.2) != (a0, b0) {
                    (chosen[i], chosen[j]) = (best.1, best.2);
                    changed = true;
                }
            }
        }
        changed
    }

    /// Cost of each option by itself and against the fixed motions.
    fn own_costs(&self, prices: &mut Prices) -> Vec<Vec<f64>> {
        let against = |option: &JointOption| -> f64 {
            let fixed = self.fixed.iter().filter(|f| !option.kept && !f.is_kept_out_by(&option.sweep));
            fixed.map(|f| price(option.boxes(), f.boxes(), self.tuning)).sum()
        };
        let each = self.agents.iter().zip(&mut prices.fixed).map(|(options, known)| {
            known.extend(options[known.len()..].iter().map(against));
            options.iter().zip(&*known).map(|(option, against)| option.cost + against).collect()
        });
        each.collect()
    }

    /// For each road user, the others whose options can come near one of its options.
    fn near(&self) -> Vec<Vec<usize>> {
        let n = self.agents.len();
        // An encounter of two motions has a cost only below this distance.
        let margin_m = Thresholds::default().gap_m.max(CLOSE_M);
        let bounds: Vec<SweptBounds> = self
            .agents
            .iter()
            .map(|options| SweptBounds::about(options.iter().map(JointOption::boxes)))
            .collect();
        let mut near = vec![Vec::new(); n];
        for i in 0..n {
            for j in (i + 1..n).filter(|j| bounds[i].may_come_within(&bounds[*j], margin_m)) {
                let meet = self.agents[i]
                    .iter()
                    .any(|a| self.agents[j].iter().any(|b| comes_within(a.boxes(), b.boxes(), margin_m)));
                if meet {
                    near[i].push(j);
                    near[j].push(i);
                }
            }
        }
        near
    }
}

/// Costs of encounters; each is computed once.
#[derive(Default)]
struct Prices {
    /// For each road user, the costs of its first options against the fixed motions.
    fixed: Vec<Vec<f64>>,
    /// Costs of the options of two road users, at index `lower * count + higher`.
    pairs: Vec<PairPrices>,
}

impl Prices {
    /// An empty table for `count` road users.
    fn of(count: usize) -> Self {
        Self { fixed: vec![Vec::new(); count], pairs: vec![PairPrices::default(); count * count] }
    }

    /// Drops all costs that involve a road user.
    fn forget(&mut self, i: usize) {
        let count = self.fixed.len();
        self.fixed[i].clear();
        for j in 0..count {
            self.pairs[i.min(j) * count + i.max(j)] = PairPrices::default();
        }
    }
}

/// Costs of the options of two road users, one row per option of the first. NaN where a pair has not been compared.
#[derive(Clone, Default)]
struct PairPrices {
    columns: usize,
    costs: Vec<f64>,
}

impl PairPrices {
    /// The cost of options `a` and `b`, where the road users have `rows` and `columns` options.
    fn cost(&mut self, (rows, columns): (usize, usize), a: usize, b: usize) -> &mut f64 {
        if self.columns < columns {
            let mut costs = Vec::with_capacity(rows * columns);
            for row in self.costs.chunks(self.columns.max(1)) {
                costs.extend_from_slice(row);
                costs.resize(costs.len() + columns - row.len(), f64::NAN);
            }
            (self.columns, self.costs) = (columns, costs);
        }
        if self.costs.len() < rows * self.columns {
            self.costs.resize(rows * self.columns, f64::NAN);
        }
        &mut self.costs[a * self.columns + b]
    }
}

/// Costs of pairs of options.
struct Pairs<'a> {
    agents: &'a [Vec<JointOption>],
    tuning: &'a ChoiceTuning,
    known: &'a mut [PairPrices],
}

impl Pairs<'_> {
    fn cost(&mut self, i: usize, a: usize, j: usize, b: usize) -> f64 {
        let (i, a, j, b) = if i < j { (i, a, j, b) } else { (j, b, i, a) };
        let (first, second) = (&self.agents[i], &self.agents[j]);
        let cost = self.known[i * self.agents.len() + j].cost((first.len(), second.len()), a, b);
        if cost.is_nan() {
            let (one, other) = (&first[a], &second[b]);
            let kept = one.kept && other.kept;
            *cost = if kept { 0.0 } else { price(one.boxes(), other.boxes(), self.tuning) };
        }
        *cost
    }
}

/// Cost of an encounter of two motions.
pub(super) fn price(a: &SweptBoxes, b: &SweptBoxes, tuning: &ChoiceTuning) -> f64 {
    let found = overlap(a, b);
    if found.overlaps {
        return tuning.overlap + tuning.close;
    }
    let close = if found.close { tuning.close } else { 0.0 };
    let danger = if tuning.near_miss > 0.0 { dangerous_moments(a, b).count() } else { 0 };
    close + tuning.near_miss * (danger as f64).min(MOST_MOMENTS) / MOST_MOMENTS
}

fn least(costs: impl Iterator<Item = f64>) -> usize {
    let mut best = (0, f64::INFINITY);
    for (i, cost) in costs.enumerate() {
        if cost < best.1 {
            best = (i, cost);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tuning::SHIPPED;
    use scene::{Size, State};

    const CAR: Size = Size { length_m: 4.6, width_m: 2.0, height_m: None };

    fn ride(y: f64, speed: f64, cost: f64) -> JointOption {
        let at = |i: usize| Some(State { x_m: 0.1 * speed * i as f64, y_m: y, ..State::default() });
        let sweep = Sweep::new((0..=90).map(at).collect(), &CAR);
        JointOption { sweep: Arc::new(sweep), cost, rule_cost: 0.0, burden: 0.0, kept: false }
    }

    #[test]
    fn the_cheaper_way_out_is_taken() {
        // Both start with the same motion; the second may also change lane.
        let agents = vec![vec![ride(0.0, 8.0, 1.0)], vec![ride(0.5, 8.0, 1.0), ride(4.0, 8.0, 2.0)]];
        let mut choice = Choice::new(agents, &[], &SHIPPED.choice);
        assert_eq!(choice.solve(), vec![0, 1]);
        assert_eq!(choice.in_conflict(&[0, 1]), vec![false, false]);
        assert_eq!(choice.in_conflict(&[0, 0]), vec![true, true]);
    }

    #[test]
    fn pairs_move_together() {
        // Each single change conflicts with the other's present choice; only both changes together are free
        // of conflict.
        let swap = |left: f64, right: f64| vec![ride(left, 8.0, 1.0), ride(right, 8.0, 1.2)];
        let kept = ride(8.3, 8.0, 0.0);
        let fixed = [FixedMotion { sweep: &kept.sweep, comes_in: None }];
        let mut choice = Choice::new(vec![swap(0.0, 8.0), swap(0.0, 4.0)], &fixed, &SHIPPED.choice);
        assert_eq!(choice.solve(), vec![0, 1]);
    }

    #[test]
    fn fixed_motions_are_avoided() {
        let kept = ride(0.0, 8.0, 0.0);
        let fixed = [FixedMotion { sweep: &kept.sweep, comes_in: None }];
        let agents = vec![vec![ride(0.0, 8.0, 1.0), ride(4.0, 8.0, 3.0)]];
        let mut choice = Choice::new(agents, &fixed, &SHIPPED.choice);
        assert_eq!(choice.solve(), vec![1]);
    }

    #[test]
    fn nobody_gives_way_to_a_road_user_that_would_come_in_where_it_is() {
        let late = ride(0.0, 8.0, 0.0);
        let of = |comes_in: Option<(usize, usize)>| {
            let fixed = [FixedMotion { sweep: &late.sweep, comes_in }];
            let agents = vec![vec![ride(0.0, 8.0, 1.0), ride(4.0, 8.0, 3.0)]];
            let mut choice = Choice::new(agents, &fixed, &SHIPPED.choice);
            (choice.solve(), choice.in_conflict(&[0]))
        };
        assert_eq!(of(Some((20, 25))), (vec![0], vec![false]));
        assert_eq!(of(None), (vec![1], vec![true]));
    }

    #[test]
    fn options_that_come_later_are_weighed_as_if_they_had_been_there() {
        let first = |cost: f64| vec![ride(0.0, 8.0, cost)];
        let kept = ride(8.3, 8.0, 0.0);
        let fixed = [FixedMotion { sweep: &kept.sweep, comes_in: None }];
        let mut choice = Choice::new(vec![first(1.0), first(1.0), first(1.0)], &fixed, &SHIPPED.choice);
        assert_eq!(choice.solve(), vec![0, 0, 0]);
        let again = |options: &[JointOption]| -> Vec<JointOption> {
            let copy = |o: &JointOption| JointOption { sweep: Arc::clone(&o.sweep), ..*o };
            options.iter().map(copy).collect()
        };
        for (i, y, chosen) in [(2, 4.0, [0, 0, 1]), (0, 8.0, [0, 0, 1]), (1, -4.0, [0, 1, 1])] {
            let mut options = again(&choice.agents[i]);
            options.push(ride(y, 8.0, 2.0));
            choice.set_options(i, options);
            let anew: Vec<Vec<JointOption>> = choice.agents.iter().map(|own| again(own)).collect();
            assert_eq!(choice.solve(), chosen);
            assert_eq!(Choice::new(anew, &fixed, &SHIPPED.choice).solve(), chosen);
        }
        // Other options replace the known ones.
        choice.set_options(1, vec![ride(4.0, 8.0, 1.0), ride(-8.0, 8.0, 2.0)]);
        let anew: Vec<Vec<JointOption>> = choice.agents.iter().map(|own| again(own)).collect();
        assert_eq!(choice.solve(), Choice::new(anew, &fixed, &SHIPPED.choice).solve());
        assert_eq!(choice.solve()[1], 0, "the motion that was in its place before overlapped others");
    }
}
