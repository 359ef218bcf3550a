//! Searches: tries that approach the condition of a plan. The numbers of a population follow from the rows of
//! earlier populations, so an interrupted search resumes from its chunks.

pub mod call;
mod cma;
pub mod one_scene;
pub(crate) mod order;
pub(crate) mod state;

use crate::row::BatchRow;
use crate::unit::{BatchUnit, UnitList};
use order::SearchGroup;
use state::SearchState;

/// The searches of a group, at one population.
pub struct GroupSearch<'a> {
    list: &'a UnitList<'a>,
    group: SearchGroup,
    /// One per search; `None` if no road user fits.
    searches: Vec<Option<SearchState<'a>>>,
    generation: u64,
}

impl<'a> GroupSearch<'a> {
    /// The searches of a group at their start, by the share of its chunks; `None` for a plan without
    /// searches.
    pub fn new(list: &'a UnitList<'a>, share: u64) -> Option<Self> {
        let group = list.searches()?.group(share)?;
        let searches = group.series.iter().map(|series| list.search(series.place)).collect();
        Some(Self { list, group, searches, generation: 0 })
    }

    /// A unit of the next chunk, with its numbers.
    pub fn unit(&self, number: u64) -> Option<BatchUnit> {
        let (series, place) = self.group.find(number)?;
        let mut unit = self.list.at(place)?;
        let search = self.searches.get(series)?.as_ref();
        unit.drawn = search.map(|search| search.drawn(place.draw)).unwrap_or_default();
        Some(unit)
    }

    /// Takes the rows of the next chunk, in their order.
    pub fn learn(&mut self, rows: &[BatchRow]) {
        let mut misses = rows.iter().map(|row| row.miss);
        for (series, search) in self.group.series.iter().zip(&mut self.searches) {
            let tries = series.tries(self.generation);
            let misses: Vec<Option<f64>> = tries.zip(&mut misses).map(|(_, miss)| miss).collect();
            if let (Some(search), false) = (search, misses.is_empty()) {
                search.learn(&misses);
            }
        }
        self.generation += 1;
    }
}
