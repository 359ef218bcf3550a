//! Converts ids of records to ids of scenes.

use crate::problem::ImportWarning;
use crate::sentences;
use scene::message::Word;
use std::collections::BTreeMap;

/// Ids as strings. A repeated number gets the first free suffix: `12`, `12.2`, `12.3`.
#[derive(Default)]
pub(super) struct UniqueIds {
    /// Number of uses of each number.
    seen: BTreeMap<i64, usize>,
    repeated: usize,
}

impl UniqueIds {
    pub(super) fn take(&mut self, number: i64) -> String {
        let count = self.seen.entry(number).or_insert(0);
        *count += 1;
        if *count == 1 {
            return number.to_string();
        }
        self.repeated += 1;
        format!("{number}.{count}")
    }

    pub(super) fn warn(&self, subject: Word, warnings: &mut Vec<ImportWarning>) {
        if self.repeated > 0 {
            warnings
                .push(ImportWarning::new("duplicate-ids", sentences::ids_suffixed(self.repeated, subject)));
        }
    }
}
