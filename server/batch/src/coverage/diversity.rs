//! Coverage of the space of possible cases: two numbers, for recordings and for results.

use super::dimension::CoverageDimension;
use crate::case::facts::CaseFacts;
use serde::Serialize;
use std::collections::BTreeMap;

/// Number of cases by cell; a cell is one bucket of each dimension of the space.
#[derive(Clone, Debug, Default)]
pub struct CaseSpace(BTreeMap<Vec<u8>, CellCount>);

#[derive(Clone, Copy, Debug, Default)]
struct CellCount {
    recorded: u64,
    kept: u64,
}

/// The two numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Diversity {
    /// Number of cases.
    pub cases: u64,
    /// Cells with a case.
    pub cells: u64,
    /// Entropy of the cases over the cells, bits.
    pub entropy_bits: f64,
}

impl CaseSpace {
    /// Counts a recorded road user or a kept result.
    pub fn add(&mut self, dimensions: &[CoverageDimension], facts: &CaseFacts, is_recorded: bool) {
        let of_space = dimensions.iter().filter(|dimension| dimension.is_of_space);
        let cell = of_space.map(|of| of.bucket(None, facts).map_or(u8::MAX, |bucket| bucket as u8)).collect();
        let count = self.0.entry(cell).or_default();
        *(if is_recorded { &mut count.recorded } else { &mut count.kept }) += 1;
    }

    /// Numbers of recorded and of kept cases, by cell.
    pub fn cells(&self) -> impl Iterator<Item = [u64; 2]> {
        self.0.values().map(|count| [count.recorded, count.kept])
    }

    /// The numbers of the recordings.
    pub fn recorded(&self) -> Diversity {
        self.of(|count| count.recorded)
    }

    /// The numbers of the kept results.
    pub fn kept(&self) -> Diversity {
        self.of(|count| count.kept)
    }

    /// The numbers of both together.
    pub fn both(&self) -> Diversity {
        self.of(|count| count.recorded + count.kept)
    }

    /// Number of cells with a kept result but no recording.
    pub fn new_cells(&self) -> u64 {
        self.0.values().filter(|count| count.recorded == 0 && count.kept > 0).count() as u64
    }

    fn of(&self, number: impl Fn(&CellCount) -> u64) -> Diversity {
        let counts: Vec<u64> = self.0.values().map(number).filter(|count| *count > 0).collect();
        let cases: u64 = counts.iter().sum();
        let share = |count: &u64| *count as f64 / cases as f64;
        let entropy: f64 = counts.iter().map(share).map(|share| -share * share.log2()).sum();
        Diversity { cases, cells: counts.len() as u64, entropy_bits: (entropy * 1e3).round() / 1e3 + 0.0 }
    }
}
