//! Chunks: consecutive units that are written at once.

use crate::unit::UnitList;
use scene::ContentHash;
use std::ops::Range;

/// Digits of a chunk's number in its name.
const DIGITS: usize = 6;
/// Hex digits of its hash in its name.
const HASH_DIGITS: usize = 16;

/// A range of units of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BatchChunk {
    /// Number of the chunk, from 0.
    pub number: u64,
    /// Numbers of its units.
    pub units: Range<u64>,
    /// Key by which shards are divided: chunks with an equal key belong to one process, because each follows
    /// from the previous one.
    pub share: u64,
}

/// All chunks of `units` units, with `size` units in each but the last.
pub fn chunks(units: u64, size: u64) -> impl Iterator<Item = BatchChunk> {
    let size = size.max(1);
    (0..units.div_ceil(size)).map(move |number| {
        let first = number * size;
        BatchChunk { number, units: first..units.min(first + size), share: number }
    })
}

impl BatchChunk {
    /// The name of its files: its number, and a hash of its first and last unit.
    pub fn name(&self, list: &UnitList<'_>) -> String {
        let ends = [self.units.start, self.units.end.saturating_sub(1)];
        let hash = ContentHash::of(&(ends, ends.map(|number| list.unit(number).map(|unit| unit.id)))).hex();
        format!("{:0DIGITS$}-{}", self.number, hash.get(..HASH_DIGITS).unwrap_or(&hash))
    }
}

#[cfg(test)]
mod tests {
    use super::chunks;

    #[test]
    fn chunks_cover_all_units_once() {
        let all: Vec<_> = chunks(45, 20).map(|chunk| chunk.units).collect();
        assert_eq!(all, [0..20, 20..40, 40..45]);
        assert_eq!(chunks(0, 20).count(), 0);
    }
}
