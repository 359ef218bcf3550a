//! Which records make a batch, and a shard of them ready for the networks.

use std::collections::HashMap;

use experts::features::{ANCHOR, MODES, NEIGHBOUR, OWN, PIECE, PIECE_POSE, RESIDUAL};
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::fit;
use super::route::Route;
use super::{Record, Records, TrainError};

/// One scene in this many is held out.
const HELD_OUT: u64 = 10;

/// Whether scenes of this key are for validation alone, whatever file they are in.
pub fn is_held_out(key: u64) -> bool {
    let hash = blake3::hash(&key.to_le_bytes());
    u64::from(hash.as_bytes()[0]) * HELD_OUT < 256
}

/// Signs that turn features into those of the mirrored world (left and right swapped), one a number.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Of [`OWN`] numbers.
    pub own: [f32; OWN],
    /// Of a map piece.
    pub piece: [f32; PIECE],
    /// Of a seen piece.
    pub piece_pose: [f32; PIECE_POSE],
    /// Of a neighbour.
    pub neighbour: [f32; NEIGHBOUR],
    /// Of an anchor.
    pub anchor: [f32; ANCHOR],
}

/// Records to train on with their chances, and records held out.
pub(super) struct Split {
    train: Vec<usize>,
    /// Running sums of the weights.
    sums: Vec<f64>,
    pub(super) held_out: Vec<usize>,
}

impl Split {
    /// Splits those that `takes` wants by the hash of the scenes' keys; `most_held_out` bounds the cost of a
    /// validation. With `even` each file has the same chance to be drawn from.
    pub(super) fn new(
        records: &Records,
        most_held_out: usize,
        even: bool,
        takes: impl Fn(&Record) -> bool,
    ) -> Result<Self, TrainError> {
        let mut split = Self { train: Vec::new(), sums: Vec::new(), held_out: Vec::new() };
        let mut weights = Vec::new();
        let mut by_file = vec![0.0; records.files()];
        for index in 0..records.len() {
            let record = records.get(index)?;
            let (key, _) = records.scene_of(index);
            if !takes(&record) {
                continue;
            }
            if is_held_out(key) {
                split.held_out.push(index);
            } else {
                split.train.push(index);
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

    /// The records of a step's batch: the same for the same seed and step, whatever came before.
    pub(super) fn batch(&self, seed: u64, step: u64, size: usize) -> Vec<usize> {
        let mut rng = stream(seed, step, 0);
        let total = self.sums.last().copied().unwrap_or(0.0);
        (0..size)
            .map(|_| {
                let place = self.sums.partition_point(|&sum| sum <= unit(&mut rng) * total);
                self.train[place.min(self.train.len() - 1)]
            })
            .collect()
    }
}

/// The random numbers of a part of a step.
pub(crate) fn stream(seed: u64, step: u64, part: u64) -> ChaCha12Rng {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    rng.set_stream(step << 16 | part);
    rng
}

/// Uniform in 0..1.
pub(crate) fn unit(rng: &mut ChaCha12Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// A standard normal draw.
pub(crate) fn normal(rng: &mut ChaCha12Rng) -> f32 {
    let (a, b) = (1.0 - unit(rng), unit(rng));
    ((-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()) as f32
}

/// Records that go through the networks together.
pub(crate) struct Shard {
    pub(crate) records: Vec<Record>,
    /// Map pieces that they see; the records' piece indices are rows of this.
    pub(crate) pieces: Vec<[f32; PIECE]>,
    /// The recording on each mode's anchor.
    pub(super) recorded: Vec<[[f32; RESIDUAL]; MODES]>,
}

impl Shard {
    /// Decodes records; with `mirror` each is mirrored by an even chance.
    pub(super) fn new(
        records: &Records,
        indices: &[usize],
        route: &Route,
        mirror: Option<(&Mirror, &mut ChaCha12Rng)>,
    ) -> Result<Self, TrainError> {
        let mut shard = Self { records: Vec::new(), pieces: Vec::new(), recorded: Vec::new() };
        let mut rows: HashMap<(usize, usize, bool), usize> = HashMap::new();
        let mut mirror = mirror;
        for &index in indices {
            let (_, scene) = records.scene_of(index);
            let mut record = records.get(index)?;
            let signs = mirror.as_mut().and_then(|(signs, rng)| (unit(rng) < 0.5).then_some(*signs));
            if let Some(signs) = signs {
                mirror_record(&mut record, signs);
            }
            for seen in &mut record.agent.pieces {
                seen.piece = *rows.entry((scene, seen.piece, signs.is_some())).or_insert_with(|| {
                    let mut piece = records.piece(scene, seen.piece);
                    if let Some(signs) = signs {
                        flip(&mut piece, &signs.piece);
                    }
                    shard.pieces.push(piece);
                    shard.pieces.len() - 1
                });
            }
            shard.recorded.push(fit::recorded(route, &record.agent, &record.target));
            shard.records.push(record);
        }
        Ok(shard)
    }
}

fn flip(values: &mut [f32], signs: &[f32]) {
    for (value, sign) in values.iter_mut().zip(signs) {
        *value *= sign;
    }
}

fn mirror_record(record: &mut Record, signs: &Mirror) {
    let agent = &mut record.agent;
    flip(&mut agent.own, &signs.own);
    agent.pieces.iter_mut().for_each(|seen| flip(&mut seen.pose, &signs.piece_pose));
    agent.neighbours.iter_mut().for_each(|other| flip(other, &signs.neighbour));
    agent.anchors.iter_mut().for_each(|anchor| flip(anchor, &signs.anchor));
    record.target.across.as_flattened_mut().iter_mut().for_each(|across| *across = -*across);
    for pose in record.boxes.iter_mut().flat_map(|logged| &mut logged.poses) {
        pose[1] = -pose[1];
        pose[3] = -pose[3];
    }
    record.paths.iter_mut().flat_map(|path| &mut path.points).for_each(|point| point[1] = -point[1]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::toy;

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
        assert_eq!(split.batch(1, 5, 32), split.batch(1, 5, 32));
        assert_ne!(split.batch(1, 5, 32), split.batch(1, 6, 32));
        assert_eq!(Split::new(&records, 2, false, |_| true).unwrap().held_out.len(), 2);
    }

    #[test]
    fn mirrored_records_are_the_mirrored_world() {
        let records = records(1);
        let signs = Mirror {
            own: [1.0; OWN],
            piece: [-1.0; PIECE],
            piece_pose: [1.0; PIECE_POSE],
            neighbour: [1.0; NEIGHBOUR],
            anchor: [1.0; ANCHOR],
        };
        let route = Route::new();
        let indices = [0, 1, 2, 0, 1, 2, 0, 1, 2];
        let mut rng = stream(1, 1, 1);
        let shard = Shard::new(&records, &indices, &route, Some((&signs, &mut rng))).unwrap();
        let plain = Shard::new(&records, &indices, &route, None).unwrap();
        let mut mirrored = 0;
        for (a, b) in shard.recorded.iter().zip(&plain.recorded) {
            let same = a[0][15] == b[0][15];
            assert!(same || a[0][15] == -b[0][15]);
            assert_eq!(a[0][3], b[0][3]);
            mirrored += usize::from(!same);
        }
        assert!((1..9).contains(&mirrored));
        assert!(shard.pieces.len() > plain.pieces.len());
    }
}
