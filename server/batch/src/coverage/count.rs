//! Counts of one bucket, and whether it is full.

use serde::Serialize;
use std::collections::BTreeMap;

/// How well a bucket is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BucketState {
    /// Enough kept results.
    Full,
    /// Some, but not enough.
    Thin,
    /// No kept result, although results fell into it: the condition of the plan left out all of them.
    LeftOut,
    /// No result fell into it.
    NeverTried,
    /// It contains the cases without the fact, so it need not be filled.
    Nothing,
}

impl BucketState {
    /// Name of the state in the tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Thin => "thin",
            Self::LeftOut => "hole, left out",
            Self::NeverTried => "hole, never tried",
            Self::Nothing => "",
        }
    }
}

/// Counts of one bucket, or of a pair of buckets of two dimensions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BucketCount {
    /// Road users of the recorded scenes.
    pub recorded: u64,
    /// Results, kept or not.
    pub tried: u64,
    /// Kept results.
    pub kept: u64,
    /// Results that each comparison of the plan's condition left out, by its index.
    pub left_out: BTreeMap<usize, u64>,
}

impl BucketCount {
    /// How well it is filled, if `full` kept results are enough.
    pub fn state(&self, full: u64) -> BucketState {
        match (self.kept, self.tried) {
            (0, 0) => BucketState::NeverTried,
            (0, _) => BucketState::LeftOut,
            (kept, _) if kept < full => BucketState::Thin,
            _ => BucketState::Full,
        }
    }

    /// The condition that left out most results, and their number.
    pub fn worst_condition(&self) -> Option<(usize, u64)> {
        let most =
            self.left_out.iter().max_by_key(|(condition, count)| (**count, std::cmp::Reverse(**condition)));
        most.map(|(condition, count)| (*condition, *count))
    }
}
