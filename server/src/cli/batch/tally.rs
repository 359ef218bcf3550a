//! Counts of units by outcome.

use batch::row::{BatchRow, UnitOutcome};
use serde::Serialize;
use std::collections::BTreeMap;

/// Numbers of units.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OutcomeTally {
    /// Number of units by outcome.
    pub outcomes: BTreeMap<&'static str, u64>,
    /// Failed units by the code of their problem.
    pub problems: BTreeMap<String, u64>,
    /// Kept results by situation.
    pub kept_by_situation: BTreeMap<String, u64>,
}

impl OutcomeTally {
    /// Counts one more unit.
    pub fn add(&mut self, row: &BatchRow) {
        *self.outcomes.entry(row.outcome.name()).or_default() += 1;
        if let Some(problem) = &row.problem {
            *self.problems.entry(problem.code.clone()).or_default() += 1;
        }
        let kept = self.kept_by_situation.entry(row.situation.clone()).or_default();
        *kept += u64::from(row.outcome == UnitOutcome::Kept);
    }

    /// Number of units.
    pub fn units(&self) -> u64 {
        self.outcomes.values().sum()
    }

    /// Number of units with an outcome.
    pub fn of(&self, outcome: UnitOutcome) -> u64 {
        self.outcomes.get(outcome.name()).copied().unwrap_or(0)
    }

    /// The counts as text: "3 kept, 9 left out, ...".
    pub fn words(&self) -> String {
        let words = [
            (UnitOutcome::Kept, "kept"),
            (UnitOutcome::LeftOut, "left out"),
            (UnitOutcome::NobodyFits, "without a fitting road user"),
            (UnitOutcome::Failed, "failed"),
        ];
        words.map(|(outcome, word)| format!("{} {word}", self.of(outcome))).join(", ")
    }
}
