//! The order of the tries of searches. Searches form groups. A chunk has one population of each search of a
//! group, so that it follows from the previous chunks of the group.

use super::cma::CmaEs;
use crate::chunk::BatchChunk;
use crate::distribution::Distribution;
use crate::order::{UnitBlock, UnitPlace};
use crate::plan::BatchPlan;
use std::ops::Range;

/// All tries of all searches of a plan.
pub struct SearchOrder {
    blocks: Vec<UnitBlock>,
    /// Number of tries between two adaptations, by situation.
    populations: Vec<u64>,
    /// Number of searches in a group.
    group_size: u64,
    /// Most populations of a search.
    generations: u64,
}

/// Searches that advance together.
pub struct SearchGroup {
    /// The searches of the group.
    pub series: Vec<TrySeries>,
    first_unit: u64,
}

/// The tries of one search.
#[derive(Clone, Copy, Debug)]
pub struct TrySeries {
    /// Place of the first try.
    pub place: UnitPlace,
    tries: u64,
    population: u64,
}

impl SearchOrder {
    /// The order over the blocks of a plan: each road user and each seed of a block is a separate search.
    pub fn new(plan: &BatchPlan, blocks: Vec<UnitBlock>) -> Self {
        let is_range = |distribution: &Distribution| matches!(distribution, Distribution::Uniform { .. });
        let populations = plan.situations.iter().map(|situation| {
            let dimensions = situation.dimensions();
            let ranges = dimensions.iter().filter(|dimension| is_range(dimension.distribution)).count();
            CmaEs::population(ranges) as u64
        });
        let populations: Vec<u64> = populations.collect();
        let most = populations.iter().copied().max().unwrap_or(1);
        let least = populations.iter().copied().min().unwrap_or(1);
        Self {
            blocks,
            populations,
            group_size: (plan.chunk_units / most).max(1),
            generations: plan.sampling.draws.div_ceil(least),
        }
    }

    /// Number of tries.
    pub fn len(&self) -> u64 {
        self.blocks.last().map_or(0, UnitBlock::end)
    }

    /// A group, by its index.
    pub fn group(&self, index: u64) -> Option<SearchGroup> {
        let first = index.checked_mul(self.group_size)?;
        let (block, _) = UnitBlock::of_search(&self.blocks, first)?;
        let first_unit = block.first_of(first);
        let searches = first..first.saturating_add(self.group_size);
        let series = searches.map_while(|search| {
            let (block, place) = UnitBlock::of_search(&self.blocks, search)?;
            let population = self.populations.get(block.situation).copied()?;
            Some(TrySeries { place, tries: block.draws, population })
        });
        Some(SearchGroup { series: series.collect(), first_unit })
    }

    /// The group of a try.
    pub fn group_of(&self, number: u64) -> Option<SearchGroup> {
        // Every order of the tries within groups leaves the groups unchanged.
        self.group(UnitBlock::search_of(&self.blocks, number)? / self.group_size)
    }

    /// The chunks, group by group. Their numbers have gaps where searches end early.
    pub fn chunks(&self) -> impl Iterator<Item = BatchChunk> {
        let groups = (0..).map_while(|share| Some((share, self.group(share)?)));
        groups.flat_map(move |(share, group)| {
            (0..group.generations()).map(move |generation| BatchChunk {
                number: share * self.generations + generation,
                units: group.first_unit + group.before(generation)
                    ..group.first_unit + group.before(generation + 1),
                share,
            })
        })
    }
}

impl SearchGroup {
    fn generations(&self) -> u64 {
        self.series.iter().map(|series| series.tries.div_ceil(series.population)).max().unwrap_or(0)
    }

    /// Number of tries before a population.
    fn before(&self, generation: u64) -> u64 {
        self.series.iter().map(|series| series.before(generation)).sum()
    }

    /// The population of a try.
    fn generation(&self, within: u64) -> u64 {
        let (mut low, mut high) = (0, self.generations());
        while low + 1 < high {
            let middle = low + (high - low) / 2;
            if self.before(middle) <= within {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    /// The try with a number: index of its search in the group, and its place in the plan.
    pub fn find(&self, number: u64) -> Option<(usize, UnitPlace)> {
        let within = number.checked_sub(self.first_unit)?;
        let generation = self.generation(within);
        let mut left = within - self.before(generation);
        for (i, series) in self.series.iter().enumerate() {
            let tries = series.tries(generation);
            let count = tries.end - tries.start;
            if left < count {
                return Some((i, UnitPlace { draw: tries.start + left, ..series.place }));
            }
            left -= count;
        }
        None
    }
}

impl TrySeries {
    /// Numbers of the tries of a population.
    pub fn tries(&self, generation: u64) -> Range<u64> {
        self.before(generation)..self.before(generation + 1)
    }

    fn before(&self, generation: u64) -> u64 {
        generation.saturating_mul(self.population).min(self.tries)
    }
}
