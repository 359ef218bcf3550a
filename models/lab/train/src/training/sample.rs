//! Chooses the records of a batch, and prepares shards of them for the networks.

use std::collections::HashMap;

use experts::planning::{MODES, RESIDUAL};
use scene::random::{Key, Stream};

use super::fit;
use super::route::ResidualBasis;
use super::{Record, Records, TrainError};
use crate::polylines::PIECE;

/// One scene in this many is held out.
const HELD_OUT: u64 = 10;

/// Whether scenes of this key are only for validation, whatever file they are in.
pub fn is_held_out(key: u64) -> bool {
    let hash = blake3::hash(&key.to_le_bytes());
    u64::from(hash.as_bytes()[0]) * HELD_OUT < 256
}

/// Whether scenes of this key are only for tests, if a tenth of the places is reserved for them. None of
/// these is held out for validation.
pub fn is_for_tests(key: u64) -> bool {
    let hash = blake3::hash(&key.to_le_bytes());
    u64::from(hash.as_bytes()[0]) * HELD_OUT / 256 == 1
}

/// Training records with their probabilities, and held-out records.
pub(super) struct Split {
    train: Vec<usize>,
    /// Scene of each record.
    scenes: Vec<usize>,
    /// Running sums of the weights.
    sums: Vec<f64>,
    pub(super) held_out: Vec<usize>,
}

impl Split {
    /// Splits the records that `takes` accepts by the hash of the scenes' keys; `most_held_out` limits the
    /// cost of a validation. With `even`, draws come from each file with the same probability.
    pub(super) fn new(
        records: &Records,
        most_held_out: usize,
        even: bool,
        takes: impl Fn(&Record) -> bool,
    ) -> Result<Self, TrainError> {
        let mut split =
            Self { train: Vec::new(), scenes: Vec::new(), sums: Vec::new(), held_out: Vec::new() };
        let mut weights = Vec::new();
        let mut by_file = vec![0.0; records.files()];
        for index in 0..records.len() {
            let record = records.get(index)?;
            let (key, scene) = records.scene_of(index);
            if !takes(&record) {
                continue;
            }
            if is_held_out(key) {
                split.held_out.push(index);
            } else {
                split.train.push(index);
                split.scenes.push(scene);
                weights.push(f64::from(record.weight));
                by_file[records.file_of(index)] += f64::from(record.weight);
            }
        }
        let mut sum = 0.0;
        for (&index, weight) in split.train.iter().zip(weights) {
            sum += if even { weight / by_file[records.file_of(index)] } else { weight };
            split.sums.push(sum);
        }
        if split.train.is_empty() {
            return Err(TrainError::Invalid(format!("no record of {} is left to train on", records.len())));
        }
        let every = split.held_out.len().div_ceil(most_held_out.max(1)).max(1);
        split.held_out = split.held_out.iter().copied().step_by(every).collect();
        Ok(split)
    }

    pub(super) fn train(&self) -> usize {
        self.train.len()
    }

    /// The records of a step's batch: a function of seed and step only. Up to `together` records of one scene
    /// are consecutive.
    pub(super) fn batch(&self, seed: u64, step: u64, size: usize, together: usize) -> Vec<usize> {
        let mut rng = stream(seed, step, 0);
        let total = self.sums.last().copied().unwrap_or(0.0);
        let mut batch = Vec::with_capacity(size);
        while batch.len() < size {
            // One number for the whole search: a new draw at each comparison would favour the middle.
            let ticket = rng.unit() * total;
            let place = self.sums.partition_point(|&sum| sum <= ticket).min(self.train.len() - 1);
            batch.push(self.train[place]);
            let of_scene = |i: &usize| self.scenes[*i] == self.scenes[place];
            let others = (0..place)
                .rev()
                .take_while(of_scene)
                .chain((place + 1..self.train.len()).take_while(of_scene));
            batch.extend(others.take(together - 1).map(|i| self.train[i]));
        }
        batch.truncate(size);
        batch
    }
}

/// The random numbers of a part of a step.
pub(crate) fn stream(seed: u64, step: u64, part: u64) -> Stream {
    Key::default().number(seed).number(step).number(part).stream()
}

/// Records that go through the networks together.
pub(crate) struct Shard {
    pub(crate) records: Vec<Record>,
    /// Scene of each record.
    pub(super) scenes: Vec<usize>,
    /// Map pieces that they see; the records' piece indices refer to this list.
    pub(crate) pieces: Vec<[f32; PIECE]>,
    /// The recording on each mode's anchor.
    pub(super) recorded: Vec<[[f32; RESIDUAL]; MODES]>,
}

impl Shard {
    /// Decodes records.
    pub(super) fn new(
        records: &Records,
        indices: &[usize],
        route: &ResidualBasis,
    ) -> Result<Self, TrainError> {
        let mut shard =
            Self { records: Vec::new(), scenes: Vec::new(), pieces: Vec::new(), recorded: Vec::new() };
        let mut rows: HashMap<(usize, usize), usize> = HashMap::new();
        for &index in indices {
            let (_, scene) = records.scene_of(index);
            let mut record = records.get(index)?;
            for seen in &mut record.pieces {
                seen.piece = *rows.entry((scene, seen.piece)).or_insert_with(|| {
                    shard.pieces.push(records.piece(scene, seen.piece));
                    shard.pieces.len() - 1
                });
            }
            shard.recorded.push(fit::recorded(route, &record.agent, &record.target));
            shard.scenes.push(scene);
            shard.records.push(record);
        }
        Ok(shard)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::toy;

    fn records(scenes: usize) -> Records {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.records");
        toy::write(&path, &toy::scenes(scenes, 3, 7));
        Records::load(&[path]).unwrap()
    }

    #[test]
    fn scenes_are_held_out_whole_and_batches_repeat() {
        let records = records(60);
        let split = Split::new(&records, 1000, false, |_| true).unwrap();
        assert_eq!(split.train() + split.held_out.len(), records.len());
        assert!(!split.held_out.is_empty() && split.held_out.len() < 60);
        let scene = |index: &usize| records.scene_of(*index).1;
        assert!(split.held_out.iter().all(|held| !split.train.iter().any(|t| scene(t) == scene(held))));
        assert_eq!(split.batch(1, 5, 32, 1), split.batch(1, 5, 32, 1));
        assert_ne!(split.batch(1, 5, 32, 1), split.batch(1, 6, 32, 1));
        let together = split.batch(1, 5, 30, 3);
        for three in together.chunks(3) {
            let scenes: Vec<usize> = three.iter().map(scene).collect();
            assert!(scenes.windows(2).all(|pair| pair[0] == pair[1]), "{scenes:?}");
            assert!(three[0] != three[1] && three[1] != three[2] && three[0] != three[2]);
        }
        assert_eq!(Split::new(&records, 2, false, |_| true).unwrap().held_out.len(), 2);
    }

    #[test]
    fn records_are_drawn_in_proportion_to_their_weights() {
        let weights: Vec<f64> = (0..40).map(|i| if i % 4 == 3 { 3.0 } else { 1.0 }).collect();
        let mut sum = 0.0;
        let sums = weights.iter().map(|weight| {
            sum += weight;
            sum
        });
        let split = Split {
            sums: sums.collect(),
            train: (0..40).collect(),
            scenes: (0..40).collect(),
            held_out: Vec::new(),
        };
        let draws = 60_000;
        let mut counts = [0.0; 40];
        split.batch(1, 5, draws, 1).into_iter().for_each(|record| counts[record] += 1.0);
        for (record, (count, weight)) in counts.into_iter().zip(weights).enumerate() {
            let expected = draws as f64 * weight / 60.0;
            assert!((count - expected).abs() < 6.0 * expected.sqrt(), "{record}: {count} for {expected}");
        }
    }
}
