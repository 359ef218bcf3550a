//! One search: the numbers of its next tries follow from the distances of earlier tries to the condition.

use super::cma::CmaEs;
use crate::distribution::Distribution;
use crate::situation::{BatchSituation, Dimension};
use crate::sobol;
use nalgebra::DVector;
use scene::random::Key;
use std::collections::BTreeMap;

/// Initial standard deviation of the tries as a share of each range: most of the range is within two of them.
const FIRST_STEP: f64 = 0.3;
/// A search whose tries lie closer together than this share of a range is exhausted.
const LEAST_STEP: f64 = 0.002;

/// Growth of the step after a population that satisfies the condition: more tries at the same place would be
/// near copies.
const WIDENING: f64 = 1.5;
/// Number of satisfying populations after which the search restarts elsewhere.
const MOST_HOLDING: u32 = 4;

/// A search of one situation, for one road user of one scene and one seed.
pub struct SearchState<'a> {
    dimensions: Vec<Dimension<'a>>,
    key: Key,
    optimiser: CmaEs,
    starts: u64,
    /// Number of populations since the start whose better half satisfies the condition.
    holding: u32,
    /// Number of tries with a known result.
    known: u64,
}

impl<'a> SearchState<'a> {
    /// A new search. `key` is the key of its random numbers.
    pub fn new(situation: &'a BatchSituation, key: Key) -> Self {
        let dimensions = situation.dimensions();
        let optimiser = CmaEs::new(DVector::zeros(0), FIRST_STEP);
        let mut search = Self { dimensions, key, optimiser, starts: 0, holding: 0, known: 0 };
        search.start();
        search
    }

    /// Restarts at another place. The places spread over all ranges.
    fn start(&mut self) {
        let ranges = self.dimensions.iter().filter(|dimension| is_range(dimension)).enumerate();
        let at = |(i, dimension): (usize, &Dimension<'_>)| {
            sobol::share(&self.key.clone().words(&["start", &dimension.path]), i, self.starts)
        };
        let mut mean: Vec<f64> = ranges.map(at).collect();
        if mean.is_empty() {
            // Nothing to adapt: all numbers are fixed or from lists.
            mean.push(0.5);
        }
        self.optimiser = CmaEs::new(mean.into(), FIRST_STEP);
        self.starts += 1;
        self.holding = 0;
    }

    /// The point of a try, as shares of the ranges; the ranges are mirrored outside of 0 to 1.
    fn point(&self, number: u64) -> DVector<f64> {
        let mut stream = self.key.clone().text("try").number(number).stream();
        let ranges = self.dimensions.iter().filter(|dimension| is_range(dimension)).count().max(1);
        self.optimiser.point(&DVector::from_fn(ranges, |_, _| stream.normal()))
    }

    /// The numbers of a try of the next population, by path. Numbers without a range are drawn at random.
    pub fn drawn(&self, number: u64) -> BTreeMap<String, f64> {
        let point = self.point(number);
        let mut ranges = point.iter().copied().map(mirrored);
        let value = |dimension: &Dimension<'_>| {
            let random = || self.key.clone().words(&["list", &dimension.path]).number(number).stream().unit();
            let share = is_range(dimension).then(|| ranges.next()).flatten();
            (dimension.path.clone(), dimension.distribution.at(share.unwrap_or_else(random)))
        };
        self.dimensions.iter().map(value).collect()
    }

    /// Takes the results of the next population: how far each try was from the condition, 0 if it holds,
    /// `None` without a result.
    pub fn learn(&mut self, misses: &[Option<f64>]) {
        let misses = misses.iter().map(|miss| miss.unwrap_or(f64::MAX));
        let mut tries: Vec<(f64, DVector<f64>)> =
            misses.zip(self.known..).map(|(miss, number)| (miss, self.point(number))).collect();
        self.known += tries.len() as u64;
        tries.sort_by(|a, b| a.0.total_cmp(&b.0));
        let holds = tries.iter().filter(|(miss, _)| *miss == 0.0).count();
        let is_flat = tries.first().map(|(miss, _)| miss) == tries.last().map(|(miss, _)| miss);
        let mut points: Vec<DVector<f64>> = tries.into_iter().map(|(_, point)| point).collect();
        // Only the better half counts; if all of it satisfies the condition, its ranks mean nothing.
        if 2 * holds >= points.len() && self.holding < MOST_HOLDING {
            points.truncate(holds);
            self.optimiser.widen(&points, WIDENING);
            self.holding += 1;
        } else if 2 * holds >= points.len() || is_flat || self.optimiser.extent() < LEAST_STEP {
            self.start();
        } else {
            self.optimiser.adapt(&points);
        }
    }
}

fn is_range(dimension: &Dimension<'_>) -> bool {
    matches!(dimension.distribution, Distribution::Uniform { .. })
}

/// A share of a range that is mirrored at its bounds.
fn mirrored(share: f64) -> f64 {
    let share = share.rem_euclid(2.0);
    if share > 1.0 { 2.0 - share } else { share }
}

#[cfg(test)]
mod tests {
    use super::{MOST_HOLDING, SearchState, mirrored};
    use crate::draws;
    use crate::sampling::{BatchSampling, SamplingMethod};
    use crate::situation::BatchSituation;
    use scene::random::Key;
    use std::collections::BTreeMap;

    fn situation() -> BatchSituation {
        let text = r#"{"agents":["6"],"width_m":{"choice":[1.8,2]},"goal":{
            "speed_mps":{"uniform":[5,25]},"ahead_m":{"uniform":[20,120]},"left_m":{"uniform":[-4,4]}}}"#;
        serde_json::from_str(text).unwrap()
    }

    /// The condition holds in a corner of 0.2 % of the ranges.
    fn miss(numbers: &BTreeMap<String, f64>) -> f64 {
        let off = |path: &str, at: f64, width: f64| ((numbers[path] - at).abs() / width - 1.0).max(0.0);
        off("goal.speed_mps", 21.0, 1.0) + off("goal.ahead_m", 90.0, 6.0) + off("goal.left_m", 3.0, 0.7)
    }

    fn tries(seed: u64, populations: u64) -> Vec<BTreeMap<String, f64>> {
        let situation = situation();
        let mut search = SearchState::new(&situation, Key::default().number(seed));
        let mut all = Vec::new();
        for first in (0..populations).map(|population| population * 7) {
            let population: Vec<_> = (first..first + 7).map(|number| search.drawn(number)).collect();
            search.learn(&population.iter().map(|numbers| Some(miss(numbers))).collect::<Vec<_>>());
            all.extend(population);
        }
        all
    }

    #[test]
    fn it_finds_what_random_draws_hardly_find() {
        let situation = situation();
        let sampling = BatchSampling { method: SamplingMethod::Random, draws: 700, seed: 1 };
        let hits = |all: &[BTreeMap<String, f64>]| all.iter().filter(|numbers| miss(numbers) == 0.0).count();
        let random: Vec<_> =
            (0..700).map(|draw| draws::drawn(&situation, &sampling, "s", "6", draw)).collect();
        for seed in 0..3 {
            let found = hits(&tries(seed, 100));
            assert!(found > 20 && found > 5 * hits(&random), "{found} beside {}", hits(&random));
        }
    }

    #[test]
    fn tries_stay_in_their_ranges_and_are_the_same_again() {
        let all = tries(3, 40);
        assert_eq!(all, tries(3, 40));
        assert_ne!(all, tries(4, 40));
        for numbers in &all {
            assert!((5.0..=25.0).contains(&numbers["goal.speed_mps"]), "{numbers:?}");
            assert!((-4.0..=4.0).contains(&numbers["goal.left_m"]), "{numbers:?}");
        }
        assert!(all.iter().any(|numbers| numbers["width_m"] == 2.0));
        assert!(all.iter().any(|numbers| numbers["width_m"] == 1.8));
        assert_eq!([mirrored(-0.25), mirrored(1.25), mirrored(2.5), mirrored(0.5)], [0.25, 0.75, 0.5, 0.5]);
    }

    #[test]
    fn a_population_that_says_nothing_begins_elsewhere() {
        let situation = situation();
        let places = |misses: [Option<f64>; 7]| {
            let mut search = SearchState::new(&situation, Key::default());
            let before = search.drawn(0);
            search.learn(&misses);
            assert_ne!(search.drawn(0), before, "{misses:?}");
            search.starts
        };
        assert_eq!(places([None; 7]), 2);
        assert_eq!(places([Some(0.5); 7]), 2);
        assert_eq!(places([0.0, 0.3, 0.4, 0.1, 0.0, 0.2, 0.0].map(Some)), 1);
    }

    #[test]
    fn a_search_that_finds_looks_further_round_and_then_elsewhere() {
        let situation = situation();
        let mut search = SearchState::new(&situation, Key::default());
        let mut extents = Vec::new();
        for _ in 0..=MOST_HOLDING {
            extents.push(search.optimiser.extent());
            search.learn(&[0.0, 0.3, 0.0, 0.1, 0.0, 0.2, 0.0].map(Some));
        }
        assert!(extents.is_sorted() && extents[1] > extents[0], "{extents:?}");
        assert_eq!((search.starts, search.holding, search.optimiser.extent()), (2, 0, extents[0]));
    }
}
