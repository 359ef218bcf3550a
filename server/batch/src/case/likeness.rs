//! Finds near copies among cases, and selects the cases of a bucket that are worth keeping.
//!
//! The distance compares the textual facts of two cases, their measures and speeds, and the relative motion
//! of the two road users. Absolute positions and ids have no effect.

use super::facts::CaseFacts;
use std::collections::{BTreeMap, BTreeSet};

/// Textual facts that are equal in near copies.
const WORDS: [&str; 6] = ["layout", "signal", "actor_type", "other_type", "meeting", "first"];
/// Numeric facts, and their greatest difference between near copies.
const NUMBERS: [(&str, f64); 5] =
    [("ttc_s", TTC_S), ("gap_m", GAP_M), ("pet_s", 0.3), ("actor_mps", 1.5), ("other_mps", 1.5)];
const TTC_S: f64 = 0.3;
const GAP_M: f64 = 0.5;
/// Greatest mean difference of the relative places of near copies, decimetres.
const RELATIVE_DM: f64 = 15.0;

/// The data by which cases are compared.
#[derive(Clone, Debug, Default)]
pub struct CaseDigest {
    /// Name of the situation.
    pub situation: String,
    /// Facts of the case.
    pub facts: CaseFacts,
    /// Motion of the other road user relative to the actor, as in [`CaseMotion`](super::motion::CaseMotion).
    pub relative: Vec<Option<[i32; 2]>>,
    /// Number of faults in the score, for realism.
    pub faults: f64,
    /// Distance of the actor from its recording, metres.
    pub off_log_m: f64,
}

impl CaseDigest {
    fn number(&self, name: &str) -> Option<f64> {
        self.facts.numbers.get(name).copied()
    }

    /// Sort key with the harder case first: smallest time, then smallest gap.
    fn hardness(&self) -> [f64; 2] {
        let times = [self.number("ttc_s"), self.number("pet_s")];
        let least_s = times.into_iter().flatten().fold(f64::INFINITY, f64::min);
        [least_s, self.number("gap_m").unwrap_or(f64::INFINITY)]
    }

    /// Sort key with the more realistic case first: fewer faults, then nearer to the recording.
    fn realism(&self) -> [f64; 2] {
        [self.faults, self.off_log_m]
    }

    fn words(&self) -> [&str; 6] {
        WORDS.map(|name| self.facts.word(name))
    }

    /// Distance of two cases with equal textual facts: the greatest of the scaled differences. Near copies
    /// have at most 1.
    fn distance(&self, other: &Self) -> f64 {
        let numbers = NUMBERS.iter().map(|(name, most)| match (self.number(name), other.number(name)) {
            (Some(a), Some(b)) => (a - b).abs() / most,
            (None, None) => 0.0,
            _ => f64::INFINITY,
        });
        let seen = self.relative.iter().zip(&other.relative).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
        let apart = seen.map(|(a, b)| f64::from(a[0] - b[0]).hypot(f64::from(a[1] - b[1])));
        let (sum, count) = apart.fold((0.0, 0.0), |(sum, count), apart| (sum + apart, count + 1.0));
        let relative = if count > 0.0 { sum / count / RELATIVE_DM } else { 0.0 };
        numbers.fold(relative, f64::max)
    }

    /// Cell of the search: near copies lie in this cell or a neighbouring one.
    fn cell(&self) -> [i64; 2] {
        let cell = |name: &str, most: f64| {
            self.number(name).map_or(i64::MIN / 2, |value: f64| (value / most).floor() as i64)
        };
        [cell("ttc_s", TTC_S), cell("gap_m", GAP_M)]
    }
}

fn compared(p: &[f64; 2], q: &[f64; 2]) -> std::cmp::Ordering {
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
}

/// For each case the harder one of which it is a near copy; `None` for an original. The first of equally hard
/// cases is the original.
pub fn near_copies(cases: &[CaseDigest]) -> Vec<Option<usize>> {
    let mut order: Vec<usize> = (0..cases.len()).collect();
    order.sort_by(|p, q| compared(&cases[*p].hardness(), &cases[*q].hardness()).then(p.cmp(q)));
    let mut own: BTreeMap<([&str; 6], [i64; 2]), Vec<usize>> = BTreeMap::new();
    let mut copies = vec![None; cases.len()];
    for i in order {
        let case = &cases[i];
        let (words, cell) = (case.words(), case.cell());
        let beside = (-1..=1).flat_map(|down| (-1..=1).map(move |right| [cell[0] + down, cell[1] + right]));
        let near = beside.filter_map(|cell| own.get(&(words, cell))).flatten();
        let like = near.copied().filter(|of| case.distance(&cases[*of]) < 1.0);
        copies[i] = like
            .min_by(|p, q| case.distance(&cases[*p]).total_cmp(&case.distance(&cases[*q])).then(p.cmp(q)));
        if copies[i].is_none() {
            own.entry((words, cell)).or_default().push(i);
        }
    }
    copies
}

/// The cases worth keeping: for each bucket of situation and textual facts at most `most` originals,
/// alternately the hardest and the most realistic.
pub fn best_of_buckets(cases: &[CaseDigest], copies: &[Option<usize>], most: usize) -> BTreeSet<usize> {
    let mut buckets: BTreeMap<(&str, [&str; 6]), Vec<usize>> = BTreeMap::new();
    for (i, case) in cases.iter().enumerate().filter(|(i, _)| copies.get(*i).is_some_and(Option::is_none)) {
        buckets.entry((&case.situation, case.words())).or_default().push(i);
    }
    let mut chosen = BTreeSet::new();
    for bucket in buckets.into_values() {
        let by = |key: fn(&CaseDigest) -> [f64; 2]| {
            let mut sorted = bucket.clone();
            sorted.sort_by(|p, q| compared(&key(&cases[*p]), &key(&cases[*q])).then(p.cmp(q)));
            sorted
        };
        let (hard, real) = (by(CaseDigest::hardness), by(CaseDigest::realism));
        let in_turn = hard.into_iter().zip(real).flat_map(|(hard, real)| [hard, real]);
        let mut taken = BTreeSet::new();
        for i in in_turn {
            if taken.len() < most {
                taken.insert(i);
            }
        }
        chosen.extend(taken);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::{CaseDigest, CaseFacts, best_of_buckets, near_copies};
    use std::collections::{BTreeMap, BTreeSet};

    fn case(layout: &str, ttc_s: f64, ahead_dm: i32, faults: f64) -> CaseDigest {
        CaseDigest {
            situation: "brake".into(),
            facts: CaseFacts {
                words: BTreeMap::from([("layout", layout.to_owned())]),
                numbers: BTreeMap::from([("ttc_s", ttc_s), ("gap_m", 2.0)]),
            },
            relative: vec![None, Some([ahead_dm, 0]), Some([ahead_dm / 2, 0])],
            faults,
            off_log_m: 1.0,
        }
    }

    #[test]
    fn near_copies_are_alike_in_all_and_the_hardest_stands_for_them() {
        let cases = [
            case("bend", 1.29, 100, 0.0),
            case("bend", 1.1, 104, 0.0),
            case("junction", 1.1, 104, 0.0),
            case("bend", 1.1, 300, 0.0),
            case("bend", 2.0, 104, 0.0),
            case("bend", 1.38, 100, 0.0),
        ];
        assert_eq!(near_copies(&cases), [Some(1), None, None, None, None, Some(1)]);
        assert_eq!(near_copies(&[]), []);
    }

    #[test]
    fn of_a_bucket_the_hardest_and_the_most_realistic_are_kept() {
        let ttc_s = [4.0, 3.0, 2.0, 1.0];
        let faults = [0.0, 1.0, 2.0, 3.0];
        let cases: Vec<_> =
            ttc_s.iter().zip(faults).map(|(ttc_s, faults)| case("bend", *ttc_s, 0, faults)).collect();
        let copies = near_copies(&cases);
        assert_eq!(copies, [None; 4]);
        let best = |most| best_of_buckets(&cases, &copies, most);
        assert_eq!(best(1), BTreeSet::from([3]));
        assert_eq!(best(2), BTreeSet::from([0, 3]));
        assert_eq!(best(3), BTreeSet::from([0, 2, 3]));
        assert_eq!(best(9).len(), 4);
        let copies = [None, None, None, Some(2)];
        assert_eq!(best_of_buckets(&cases, &copies, 1), BTreeSet::from([2]));
    }
}
