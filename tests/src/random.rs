//! Reproducible random numbers for tests: a seed determines the whole sequence.

/// A sequence of numbers (SplitMix64).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The sequence of a part of something that has a seed.
    pub fn of_part(seed: u64, part: u64) -> Self {
        let mut own = Self(seed ^ part.wrapping_mul(0xd6e8_feb8_6659_fd93));
        own.any();
        own
    }

    /// Any number.
    pub fn any(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`; 0 if `end` is 0.
    pub fn below(&mut self, end: u64) -> u64 {
        self.any().checked_rem(end).unwrap_or(0)
    }

    /// An index into a list of this length; 0 for an empty one.
    pub fn index(&mut self, length: usize) -> usize {
        self.below(length as u64) as usize
    }

    /// A number below 1000, usually a small one.
    pub fn small(&mut self) -> usize {
        let most = 1 << self.below(10);
        self.index(most)
    }

    /// An element of a list, which must not be empty.
    #[allow(clippy::indexing_slicing, reason = "lists that are drawn from are never empty")]
    pub fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.index(list.len())]
    }
}
