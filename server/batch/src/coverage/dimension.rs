//! The dimensions of coverage, each with its buckets.

use crate::case::facts::{CaseFacts, NONE};
use crate::case::layout::LAYOUTS;

/// Source of a case's bucket.
#[derive(Clone, Copy, Debug, PartialEq)]
enum BucketSource {
    /// The situation of the plan.
    Situation,
    /// A textual fact.
    Word(&'static str),
    /// A numeric fact; buckets begin at these edges, in ascending order.
    Number(&'static str, &'static [f64]),
}

/// A dimension of coverage.
#[derive(Clone, Debug, PartialEq)]
pub struct CoverageDimension {
    /// Its name in the documents.
    pub name: &'static str,
    /// Unit of its edges.
    pub unit: Option<&'static str>,
    /// Names of its buckets. The last one of a fact holds the cases without that fact.
    pub buckets: Vec<String>,
    /// Whether it is part of the space in which recordings and results are compared.
    pub is_of_space: bool,
    source: BucketSource,
}

const TYPES: [&str; 3] = ["vehicle", "pedestrian", "cyclist"];
const SPEEDS_MPS: [f64; 6] = [0.0, 2.0, 5.0, 10.0, 15.0, 20.0];
const TIMES_S: [f64; 6] = [0.0, 0.5, 1.0, 1.5, 3.0, 5.0];
const GAPS_M: [f64; 6] = [f64::NEG_INFINITY, 0.0, 0.5, 1.0, 2.0, 5.0];

impl CoverageDimension {
    /// All dimensions of a plan with these situations.
    pub fn all(situations: &[String]) -> Vec<Self> {
        let mut names = situations.to_vec();
        names.sort();
        names.dedup();
        let of_plan = Self {
            name: "situation",
            unit: None,
            buckets: names,
            is_of_space: false,
            source: BucketSource::Situation,
        };
        let others = [
            Self::of_words("layout", &LAYOUTS, true),
            Self::of_words("signal", &["go", "caution", "stop", "unknown"], true),
            Self::of_words("actor_type", &TYPES, true),
            Self::of_words("other_type", &TYPES, true),
            Self::of_words("meeting", &["crossing", "following", "oncoming", "beside"], true),
            Self::of_words("first", &["actor", "other"], true),
            Self::of_numbers("ttc_s", "s", &TIMES_S, true),
            Self::of_numbers("pet_s", "s", &TIMES_S, false),
            Self::of_numbers("gap_m", "m", &GAPS_M, false),
            Self::of_numbers("actor_mps", "m/s", &SPEEDS_MPS, true),
            Self::of_numbers("other_mps", "m/s", &SPEEDS_MPS, false),
        ];
        std::iter::once(of_plan).chain(others).collect()
    }

    fn of_words(name: &'static str, words: &[&str], is_of_space: bool) -> Self {
        let buckets = words.iter().copied().chain([NONE]).map(str::to_owned).collect();
        Self { name, unit: None, buckets, is_of_space, source: BucketSource::Word(name) }
    }

    fn of_numbers(name: &'static str, unit: &'static str, edges: &'static [f64], is_of_space: bool) -> Self {
        let bucket = |(i, from): (usize, &f64)| match edges.get(i + 1) {
            Some(to) if from.is_infinite() => format!("under {to}"),
            Some(to) => format!("{from} to {to}"),
            None => format!("{from} or more"),
        };
        let buckets = edges.iter().enumerate().map(bucket).chain([NONE.to_owned()]).collect();
        Self { name, unit: Some(unit), buckets, is_of_space, source: BucketSource::Number(name, edges) }
    }

    /// The bucket of a case; `None` if the dimension does not apply, as the situation does not to a
    /// recording.
    pub fn bucket(&self, situation: Option<&str>, facts: &CaseFacts) -> Option<usize> {
        let last = self.buckets.len().checked_sub(1)?;
        match self.source {
            BucketSource::Situation => self.buckets.iter().position(|name| Some(name.as_str()) == situation),
            BucketSource::Word(fact) => {
                let word = facts.word(fact);
                Some(self.buckets.iter().position(|name| name == word).unwrap_or(last))
            }
            BucketSource::Number(fact, edges) => {
                let number = facts.numbers.get(fact).filter(|number| !number.is_nan());
                let at = number.map(|number| edges.iter().rposition(|edge| number >= edge).unwrap_or(0));
                Some(at.unwrap_or(last))
            }
        }
    }

    /// Whether the bucket contains the cases without the fact; if it is empty, it is not a hole.
    pub fn is_nothing(&self, bucket: usize) -> bool {
        self.source != BucketSource::Situation && bucket + 1 == self.buckets.len()
    }
}

#[cfg(test)]
mod tests {
    use super::CoverageDimension;
    use crate::case::facts::CaseFacts;
    use std::collections::BTreeMap;

    #[test]
    fn numbers_and_words_have_their_buckets() {
        let all = CoverageDimension::all(&["late".to_owned(), "brake".to_owned(), "brake".to_owned()]);
        let facts = CaseFacts {
            words: BTreeMap::from([("layout", "bend".to_owned()), ("signal", "none".to_owned())]),
            numbers: BTreeMap::from([("ttc_s", 0.5), ("gap_m", -0.2), ("actor_mps", 99.0)]),
        };
        let bucket = |name: &str| {
            let of = all.iter().find(|dimension| dimension.name == name).unwrap();
            of.bucket(Some("late"), &facts).map(|at| (of.buckets[at].as_str(), of.is_nothing(at)))
        };
        assert_eq!(bucket("situation"), Some(("late", false)));
        assert_eq!(bucket("layout"), Some(("bend", false)));
        assert_eq!(bucket("signal"), Some(("none", true)));
        assert_eq!(bucket("ttc_s"), Some(("0.5 to 1", false)));
        assert_eq!(bucket("gap_m"), Some(("under 0", false)));
        assert_eq!(bucket("actor_mps"), Some(("20 or more", false)));
        assert_eq!(bucket("pet_s"), Some(("none", true)));
        assert_eq!(all[0].bucket(None, &facts), None);
    }
}
