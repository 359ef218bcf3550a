//! Obstacles of the records of a shard: recorded, or along the leading drafts of a step.

use experts::planning::INSTANTS;
use scene::geometry::overlap_energy::{MovingBox, Poses, absent, gap};

use super::Record;
use super::loss;
use super::route::{DraftPoses, ResidualBasis};
use super::sample::Shard;
use super::stages::Modes;

/// A moving box, in a record's frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Obstacle {
    poses: Poses<INSTANTS>,
    half: [f32; 2],
}

impl Obstacle {
    pub(super) fn moving(&self) -> MovingBox<'_, INSTANTS> {
        MovingBox { poses: &self.poses, half: self.half }
    }

    /// Its pose some intervals later at its present velocity.
    pub(super) fn carried_on(&self, intervals: f32) -> Self {
        Self { poses: scene::geometry::overlap_energy::carried_on(&self.poses, intervals), half: self.half }
    }
}

/// The obstacles of each record of a shard.
pub(super) struct ShardObstacles {
    /// Recorded obstacles by record, without those that overlap it in the recording; with their indices.
    recorded: Vec<Vec<(u32, Obstacle)>>,
    /// By record: indices of the road users that overlap it in the recording.
    left_out: Vec<Vec<u32>>,
}

impl ShardObstacles {
    pub(super) fn new(shard: &Shard) -> Self {
        let (mut recorded, mut left_out) = (Vec::new(), Vec::new());
        for (record, residuals) in shard.records.iter().zip(&shard.recorded) {
            let counted = counted(record, residuals);
            let all = || record.boxes.iter().zip(&counted);
            recorded.push(
                all()
                    .filter(|(_, counted)| **counted)
                    .map(|(b, _)| (b.number, Obstacle { poses: b.poses, half: b.half }))
                    .collect(),
            );
            left_out.push(all().filter(|(_, counted)| !**counted).map(|(b, _)| b.number).collect());
        }
        Self { recorded, left_out }
    }

    /// All obstacles as recorded.
    pub(super) fn as_recorded(&self) -> Vec<Vec<Obstacle>> {
        self.recorded.iter().map(|all| all.iter().map(|(_, o)| o.clone()).collect()).collect()
    }

    /// Each record with a mode in `leading` moves along this draft, all others as recorded.
    pub(super) fn along(
        &self,
        route: &ResidualBasis,
        shard: &Shard,
        leading: &[Option<usize>],
        drafts: &[Modes],
    ) -> Vec<Vec<Obstacle>> {
        let placed: Vec<Option<Poses<INSTANTS>>> = (0..drafts.len())
            .map(|i| {
                let (record, mode) = (&shard.records[i], leading[i]?);
                Some(DraftPoses::of(route, record, mode, &drafts[i][mode]).poses)
            })
            .collect();
        (0..drafts.len()).map(|i| self.of(shard, i, &placed)).collect()
    }

    fn of(&self, shard: &Shard, i: usize, placed: &[Option<Poses<INSTANTS>>]) -> Vec<Obstacle> {
        let own = &shard.records[i];
        let (mut numbers, mut found) = (vec![own.number], Vec::new());
        for (j, poses) in placed.iter().enumerate() {
            let other = &shard.records[j];
            let Some(poses) = poses.as_ref().filter(|_| shard.scenes[j] == shard.scenes[i]) else { continue };
            // A batch may contain a road user twice.
            if numbers.contains(&other.number) {
                continue;
            }
            numbers.push(other.number);
            if !self.left_out[i].contains(&other.number) {
                let poses = poses.map(|pose| seen_from(pose, &other.place, &own.place));
                found.push(Obstacle { poses, half: other.half });
            }
        }
        let rest = self.recorded[i].iter().filter(|(number, _)| !numbers.contains(number));
        found.extend(rest.map(|(_, obstacle)| obstacle.clone()));
        found
    }
}

/// Converts a pose in the frame at `from` to one in the frame at `to`.
fn seen_from(pose: [f32; 4], from: &[f32; 4], to: &[f32; 4]) -> [f32; 4] {
    if absent(&pose) {
        return pose;
    }
    let turned = |[x, y]: [f32; 2], [c, s]: [f32; 2]| [x * c - y * s, x * s + y * c];
    let [x, y] = turned([pose[0], pose[1]], [from[2], from[3]]);
    let back = [to[2], -to[3]];
    let [x, y] = turned([x + from[0] - to[0], y + from[1] - to[1]], back);
    let [c, s] = turned(turned([pose[2], pose[3]], [from[2], from[3]]), back);
    [x, y, c, s]
}

/// Whether each recorded neighbour counts for a record: all do except those that overlap the road user in the
/// recording.
fn counted(record: &Record, recorded: &Modes) -> Vec<bool> {
    let mode = loss::least(&recorded.map(|r| r.iter().map(|x| x * x).sum::<f32>()));
    let coordinates = std::array::from_fn(|i| [record.target.along[mode][i], record.target.across[mode][i]]);
    let placed = DraftPoses::new(record, mode, &coordinates);
    let clear = |logged: &super::LoggedBox| {
        let pairs = placed.poses.iter().zip(&logged.poses).zip(&record.target.valid);
        pairs
            .filter(|((_, other), valid)| **valid > 0.0 && !absent(other))
            .all(|((own, other), _)| gap(*own, record.half, *other, logged.half).0 > 0.0)
    };
    record.boxes.iter().map(clear).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::toy;

    #[test]
    fn a_leading_draft_stands_where_the_recording_would_and_elsewhere_with_another_draft() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.records");
        let mut scenes = toy::scenes(1, 2, 3);
        let records = &mut scenes[0].2;
        // The second drives 10 m to the left of the first, in the opposite direction.
        records[1].place = [0.0, 10.0, -1.0, 0.0];
        toy::write(&path, &scenes);
        let (tools, shard) = toy::shard(&path);
        let all = ShardObstacles::new(&shard);
        let drafts = shard.recorded.clone();
        let seen = all.along(&tools.route, &shard, &[None, Some(0)], &drafts);
        let other = &shard.records[1].target;
        let of_first =
            seen[0].iter().find(|o| o.half == shard.records[1].half && o.poses[3][2] < -0.9).unwrap();
        for instant in 0..4 {
            let pose = of_first.poses[instant];
            let x = -(other.along[0][instant] + shard.records[1].centre_ahead);
            let y = 10.0 - other.across[0][instant];
            assert!((pose[0] - x).abs() < 0.6 && (pose[1] - y).abs() < 0.6, "{pose:?} {x} {y}");
        }
        // No draft leads for the second: all obstacles are as recorded.
        assert_eq!(seen[1].len(), all.as_recorded()[1].len());
    }
}
