//! The list of all tables. A table is one file and one line of [`TABLES`].

use super::table::TableSpec;
use super::{ablation, coherence, control, cost, feedback, quality, realism, refining, trust, variety};

/// All tables, in the order of their numbers.
pub const TABLES: [TableSpec; 10] = [
    quality::TABLE,
    coherence::TABLE,
    control::TABLE,
    realism::TABLE,
    variety::TABLE,
    cost::TABLE,
    ablation::TABLE,
    refining::TABLE,
    trust::TABLE,
    feedback::TABLE,
];

impl TableSpec {
    /// By its number.
    pub fn numbered(number: usize) -> Option<&'static Self> {
        const { &TABLES }.iter().find(|table| table.number == number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_found_by_their_numbers() {
        for (place, table) in TABLES.iter().enumerate() {
            assert_eq!(table.number, place + 1, "{}", table.name);
            assert_eq!(TableSpec::numbered(table.number).map(|found| found.name), Some(table.name));
        }
        assert!(TableSpec::numbered(0).is_none() && TableSpec::numbered(11).is_none());
    }
}
