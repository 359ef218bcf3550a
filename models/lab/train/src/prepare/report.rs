//! Report of a preparation: counts, exclusions with reasons, the split, and the fit of residuals to
//! recordings.

use crate::quantile;
use crate::training::is_held_out;
use serde::Serialize;
use std::collections::BTreeSet;

/// Counts of records and of exclusions.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PrepareReport {
    /// Files read.
    pub files: usize,
    /// Scenes read from them.
    pub scenes: usize,
    /// Road users of those scenes.
    pub road_users: usize,
    /// Road users that have records.
    pub used: usize,
    /// Records written.
    pub records: u64,
    /// Exclusions by reason.
    pub left_out: LeftOut,
    /// Share of the records that training holds out.
    pub split: PlaceSplit,
    /// Distance of recordings from the nearest residual.
    pub fit: Fit,
    /// BLAKE3 of the whole file of records, in hex; empty while it is being written.
    pub blake3: String,
}

/// Exclusions by reason. Of every scene, [`PrepareReport::used`] and the counts of road users here add up to
/// [`PrepareReport::road_users`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Files that cannot be opened, that no format reads, or that hold no scene.
    pub unreadable_files: usize,
    /// Scenes with too few road users.
    pub scenes_with_too_few: usize,
    /// Road users of those scenes.
    pub in_scenes_with_too_few: usize,
    /// Road users outside the square, or absent at the first step if a square is set.
    pub outside_the_crop: usize,
    /// Road users of another type than the expert's.
    pub wrong_type: usize,
    /// Road users of the expert's type that are absent at the first step.
    pub absent_at_the_start: usize,
    /// Road users known at fewer than 30 of the 90 steps after the first.
    pub too_short: usize,
    /// Standing road users that were not drawn.
    pub standing: usize,
    /// Road users beyond the limit of their scene.
    pub over_the_scenes_limit: usize,
    /// Road users beyond the total limit of records.
    pub over_the_files_limit: usize,
}

impl LeftOut {
    /// Adds another count to this.
    pub(super) fn add(&mut self, other: &Self) {
        self.unreadable_files += other.unreadable_files;
        self.scenes_with_too_few += other.scenes_with_too_few;
        self.in_scenes_with_too_few += other.in_scenes_with_too_few;
        self.outside_the_crop += other.outside_the_crop;
        self.wrong_type += other.wrong_type;
        self.absent_at_the_start += other.absent_at_the_start;
        self.too_short += other.too_short;
        self.standing += other.standing;
        self.over_the_scenes_limit += other.over_the_scenes_limit;
        self.over_the_files_limit += other.over_the_files_limit;
    }
}

/// Split of the records by place: all scenes of a place are on the same side. Training may use fewer of the
/// held-out ones, but never others.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PlaceSplit {
    /// Places with records.
    pub places: usize,
    /// Places that are held out.
    pub places_held_out: usize,
    /// Scenes with records.
    pub scenes: usize,
    /// Scenes that are held out.
    pub scenes_held_out: usize,
    /// Records held out.
    pub records_held_out: usize,
    #[serde(skip)]
    keys: BTreeSet<u64>,
}

impl PlaceSplit {
    /// Counts a scene that was written.
    pub(super) fn add(&mut self, key: u64, records: usize) {
        let held_out = usize::from(is_held_out(key));
        let new = usize::from(self.keys.insert(key));
        self.places += new;
        self.places_held_out += new * held_out;
        self.scenes += 1;
        self.scenes_held_out += held_out;
        self.records_held_out += records * held_out;
    }
}

/// Distance of each record's recording from its own best residual on its best anchor, metres, averaged over
/// the record's instants ([`crate::training::FitError`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Fit {
    /// Records measured.
    pub records: usize,
    /// Mean over the records.
    pub mean_m: f64,
    /// 95th percentile over the records.
    pub p95_m: f64,
}

impl Fit {
    /// Statistics of these distances.
    pub(super) fn of(mut distances: Vec<f64>) -> Self {
        distances.sort_by(f64::total_cmp);
        let records = distances.len();
        let mean_m = distances.iter().sum::<f64>() / records.max(1) as f64;
        Self { records, mean_m, p95_m: quantile(&distances, 0.95) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_summed_up() {
        let fit = Fit::of((0..=100).rev().map(f64::from).collect());
        assert_eq!((fit.records, fit.mean_m, fit.p95_m), (101, 50.0, 95.0));
        assert_eq!(Fit::of(Vec::new()), Fit::default());
    }

    #[test]
    fn a_place_is_held_out_whole() {
        let held = (0..).find(|k| is_held_out(*k)).unwrap_or_default();
        let kept = (0..).find(|k| !is_held_out(*k)).unwrap_or_default();
        let mut split = PlaceSplit::default();
        split.add(held, 4);
        split.add(kept, 5);
        split.add(held, 2);
        assert_eq!((split.places, split.places_held_out), (2, 1));
        assert_eq!((split.scenes, split.scenes_held_out, split.records_held_out), (3, 2, 6));
    }
}
