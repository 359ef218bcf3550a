//! Counts of recordings and results by dimensions and by pairs of dimensions.

use super::count::BucketCount;
use super::dimension::CoverageDimension;
use super::diversity::CaseSpace;
use crate::case::facts::CaseFacts;
use std::collections::BTreeMap;

/// Time and distance of cases.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Seconds.
    pub seconds: f64,
    /// Metres.
    pub metres: f64,
}

impl Exposure {
    fn add(&mut self, facts: &CaseFacts) {
        let fact = |name| facts.numbers.get(name).copied().unwrap_or(0.0);
        self.seconds += fact("driven_s");
        self.metres += fact("driven_m");
    }
}

/// A pair of buckets: index of the dimension and of its bucket, for the first dimension and the second.
pub type BucketPair = [(usize, usize); 2];

/// Counts of a batch. Its size depends on the dimensions, not on the number of results.
#[derive(Clone, Debug)]
pub struct CoverageTable {
    /// The dimensions.
    pub dimensions: Vec<CoverageDimension>,
    /// Counts by dimension and bucket.
    pub single: Vec<Vec<BucketCount>>,
    /// Exposure of the recordings, and of the actors of kept results, by dimension and bucket.
    pub exposure: Vec<Vec<[Exposure; 2]>>,
    /// Counts by pair of buckets; a pair without cases is absent.
    pub pairs: BTreeMap<BucketPair, BucketCount>,
    /// The space of recordings and results.
    pub space: CaseSpace,
}

/// The kind of a counted case.
enum CountedCase<'a> {
    Recorded,
    Kept,
    /// Left out by these comparisons of the condition.
    LeftOut(&'a [usize]),
}

impl CoverageTable {
    /// An empty table, for a plan with these situations.
    pub fn new(situations: &[String]) -> Self {
        let dimensions = CoverageDimension::all(situations);
        let single = dimensions.iter().map(|of| vec![BucketCount::default(); of.buckets.len()]).collect();
        let exposure =
            dimensions.iter().map(|of| vec![<[Exposure; 2]>::default(); of.buckets.len()]).collect();
        Self { dimensions, single, exposure, pairs: BTreeMap::new(), space: CaseSpace::default() }
    }

    /// Counts a road user of a recorded scene.
    pub fn add_recorded(&mut self, facts: &CaseFacts) {
        self.space.add(&self.dimensions, facts, true);
        self.add(None, facts, &CountedCase::Recorded);
    }

    /// Counts a kept result.
    pub fn add_kept(&mut self, situation: &str, facts: &CaseFacts) {
        self.space.add(&self.dimensions, facts, false);
        self.add(Some(situation), facts, &CountedCase::Kept);
    }

    /// Counts a result that is not kept, with the comparisons of the condition that it fails.
    pub fn add_left_out(&mut self, situation: &str, facts: &CaseFacts, missed: &[usize]) {
        self.add(Some(situation), facts, &CountedCase::LeftOut(missed));
    }

    fn add(&mut self, situation: Option<&str>, facts: &CaseFacts, counted: &CountedCase<'_>) {
        let buckets = self.dimensions.iter().enumerate();
        let buckets: Vec<(usize, usize)> =
            buckets.filter_map(|(i, of)| Some((i, of.bucket(situation, facts)?))).collect();
        for (at, first) in buckets.iter().enumerate() {
            let (dimension, bucket) = *first;
            if let Some(count) = self.single.get_mut(dimension).and_then(|of| of.get_mut(bucket)) {
                counted.count(count);
            }
            let exposure = self.exposure.get_mut(dimension).and_then(|of| of.get_mut(bucket));
            match (exposure, counted) {
                (Some([recorded, _]), CountedCase::Recorded) => recorded.add(facts),
                (Some([_, kept]), CountedCase::Kept) => kept.add(facts),
                _ => {}
            }
            for second in buckets.iter().skip(at + 1) {
                counted.count(self.pairs.entry([*first, *second]).or_default());
            }
        }
    }
}

impl CountedCase<'_> {
    fn count(&self, count: &mut BucketCount) {
        match self {
            Self::Recorded => count.recorded += 1,
            Self::Kept => {
                count.tried += 1;
                count.kept += 1;
            }
            Self::LeftOut(missed) => {
                count.tried += 1;
                missed.iter().for_each(|condition| *count.left_out.entry(*condition).or_default() += 1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::count::BucketState;
    use super::CoverageTable;
    use crate::case::facts::CaseFacts;
    use std::collections::BTreeMap;

    fn facts(layout: &str, ttc_s: f64) -> CaseFacts {
        CaseFacts {
            words: BTreeMap::from([("layout", layout.to_owned())]),
            numbers: BTreeMap::from([("ttc_s", ttc_s), ("driven_s", 2.0), ("driven_m", 30.0)]),
        }
    }

    #[test]
    fn holes_say_whether_they_were_tried_and_by_what_they_were_left_out() {
        let mut table = CoverageTable::new(&["brake".to_owned(), "late".to_owned()]);
        table.add_recorded(&facts("straight", 4.0));
        (0..5).for_each(|_| table.add_kept("brake", &facts("junction", 1.2)));
        table.add_kept("brake", &facts("bend", 0.2));
        table.add_left_out("brake", &facts("merge", 4.0), &[0]);
        table.add_left_out("brake", &facts("merge", 0.0), &[1]);
        table.add_left_out("brake", &facts("merge", 9.0), &[0, 1]);
        let layout = table.dimensions.iter().position(|of| of.name == "layout").unwrap();
        let state = |bucket: &str| {
            let at = table.dimensions[layout].buckets.iter().position(|name| name == bucket).unwrap();
            (table.single[layout][at].state(5), table.single[layout][at].worst_condition())
        };
        assert_eq!(state("junction"), (BucketState::Full, None));
        assert_eq!(state("bend"), (BucketState::Thin, None));
        assert_eq!(state("merge"), (BucketState::LeftOut, Some((0, 2))));
        assert_eq!(state("crosswalk"), (BucketState::NeverTried, None));
        assert_eq!(state("straight"), (BucketState::NeverTried, None), "in the recordings alone");
        assert_eq!(table.single[0][1].state(5), BucketState::NeverTried, "no case of the situation");
        // Two buckets of two dimensions.
        let ttc = table.dimensions.iter().position(|of| of.name == "ttc_s").unwrap();
        assert_eq!(table.pairs[&[(layout, 1), (ttc, 2)]].kept, 5);
        assert_eq!(table.exposure[layout][1][1].seconds, 10.0);
        assert_eq!(table.exposure[layout][4][0].metres, 30.0);
        let (recorded, kept, both) = (table.space.recorded(), table.space.kept(), table.space.both());
        assert_eq!((recorded.cells, recorded.entropy_bits), (1, 0.0));
        assert_eq!((kept.cases, kept.cells, kept.entropy_bits), (6, 2, 0.65));
        assert_eq!((both.cells, table.space.new_cells()), (3, 2));
    }
}
