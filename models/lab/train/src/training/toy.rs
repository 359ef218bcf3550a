//! Records of a toy world for tests: straight paths, an acceleration and a lateral offset that the features
//! reveal, and recorded neighbours beside the path.

use std::collections::BTreeMap;
use std::path::Path;

use experts::Refining;
use experts::features::{ANCHOR, AgentFeatures, GroundTruth, NEIGHBOUR, OWN};
use experts::planning::{INSTANTS, MODES};
use scene::random::{Key, Stream};

use super::sample::{Shard, stream};
use super::stages::{Stage, Tools};
use super::trainee::Trainee;
use super::{AnchorPath, LoggedBox, Record, RecordWriter, Records};
use crate::polylines::{PIECE, PIECE_POSE, SeenPiece};
use crate::provenance::Provenance;

/// Key, map pieces and records of a scene.
pub(crate) type ToyScene = (u64, Vec<[f32; PIECE]>, Vec<Record>);

/// Seeded scenes with some records each.
pub(crate) fn scenes(count: usize, records: usize, seed: u64) -> Vec<ToyScene> {
    let mut rng = Key::default().number(seed).stream();
    (0..count)
        .map(|scene| {
            let mut map = Vec::new();
            for _ in 0..7 {
                map.push(std::array::from_fn::<f32, PIECE, _>(|_| between(&mut rng, -1.0, 1.0)));
            }
            let records = (0..records).map(|number| record(&mut rng, number as u32, map.len())).collect();
            (scene as u64, map, records)
        })
        .collect()
}

/// Writes scenes to a file.
pub(crate) fn write(path: &Path, scenes: &[ToyScene]) {
    let scenes_of =
        BTreeMap::from([("toy".to_owned(), BTreeMap::from([("cc0".to_owned(), scenes.len() as u64)]))]);
    let provenance = Provenance { expert: "vehicle".into(), scenes: scenes_of };
    let mut writer = RecordWriter::create(path, provenance).unwrap();
    for (key, map, records) in scenes {
        writer.scene(*key, map, records).unwrap();
    }
    writer.finish().unwrap();
}

/// All records of a file as one shard, and the constants that losses need.
pub(crate) fn shard(path: &Path) -> (Tools, Shard) {
    let (tools, records) = (Tools::new(Refining::default()), Records::load(&[path.into()]).unwrap());
    let indices: Vec<usize> = (0..records.len()).collect();
    let shard = Shard::new(&records, &indices, &tools.route).unwrap();
    (tools, shard)
}

/// Asserts that each stage's loss reaches exactly the variables that the stage trains.
pub(crate) fn assert_gradients_by_stage(trainee: &impl Trainee, tools: &Tools, shard: &Shard) {
    for stage in [Stage::Denoiser, Stage::Initializer, Stage::Joint] {
        let (loss, _) = trainee.loss(tools, shard, stage, &mut stream(1, 1, 1)).unwrap();
        let grads = loss.backward().unwrap();
        for (name, var) in trainee.vars() {
            let expected = match stage {
                Stage::Denoiser => !name.starts_with("initializer."),
                Stage::Initializer => !name.starts_with("refiner."),
                Stage::Joint => true,
            };
            let norm = grads
                .get(var.as_tensor())
                .map_or(0.0, |g| g.sqr().unwrap().sum_all().unwrap().to_scalar::<f32>().unwrap());
            assert!(norm.is_finite() && (norm > 0.0) == expected, "{stage:?}: {name} has {norm}");
        }
    }
}

fn between(rng: &mut Stream, low: f32, high: f32) -> f32 {
    rng.between(low.into(), high.into()) as f32
}

fn record(rng: &mut Stream, number: u32, pieces: usize) -> Record {
    let (speed, accel, aside) = (between(rng, 2.0, 10.0), between(rng, -0.5, 0.5), between(rng, -1.0, 1.0));
    let mut own = [0.0; OWN];
    own[..3].copy_from_slice(&[speed / 10.0, accel, aside]);
    let pieces = (0..1 + rng.below(pieces))
        .map(|piece| SeenPiece {
            piece,
            pose: std::array::from_fn::<f32, PIECE_POSE, _>(|_| between(rng, -1.0, 1.0)),
        })
        .collect();
    let neighbours = (0..rng.below(4))
        .map(|_| std::array::from_fn::<f32, NEIGHBOUR, _>(|_| between(rng, -1.0, 1.0)))
        .collect();
    let mut anchors = Box::new([[0.0; ANCHOR]; MODES]);
    for (mode, anchor) in anchors.iter_mut().enumerate() {
        anchor[..2].copy_from_slice(&[mode as f32 / 6.0, speed / 10.0]);
    }
    let identity = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    let agent = AgentFeatures { own, neighbours, anchors, tangent: Box::new([identity, identity]) };
    let path = AnchorPath { start: -2.0, points: (0..150).map(|i| [i as f32 - 2.0, 0.0]).collect() };
    Record {
        number,
        // Side by side, too far apart to meet.
        place: [0.0, 200.0 * number as f32, 1.0, 0.0],
        agent,
        pieces,
        target: target(speed, accel, aside),
        boxes: vec![crossing(speed, between(rng, 4.0, 8.0)), parked(between(rng, 5.0, 60.0))],
        half: [2.2, 0.9],
        centre_ahead: 1.3,
        paths: Box::new(std::array::from_fn(|_| path.clone())),
        weight: 1.0,
    }
}

fn target(speed: f32, accel: f32, aside: f32) -> GroundTruth {
    let mut target = GroundTruth {
        base_along: [[0.0; INSTANTS]; MODES],
        along: [[0.0; INSTANTS]; MODES],
        across: [[0.0; INSTANTS]; MODES],
        valid: [1.0; INSTANTS],
        stays: if speed < 2.5 { 1.0 } else { 0.0 },
    };
    for instant in 0..INSTANTS {
        let t = 0.5 * (instant + 1) as f32;
        for mode in 0..MODES {
            target.base_along[mode][instant] = speed * t + 0.1 * (mode as f32 - 2.5) * t * t;
            target.along[mode][instant] = speed * t + 0.5 * accel * t * t;
            target.across[mode][instant] = aside * (t / 4.0).min(1.0);
        }
    }
    target.valid[INSTANTS - 1] = if aside > 0.0 { 1.0 } else { 0.0 };
    target
}

/// A car that crosses the path from the right at a time.
fn crossing(speed: f32, when: f32) -> LoggedBox {
    let mut poses = [[0.0; 4]; INSTANTS];
    for (instant, pose) in poses.iter_mut().enumerate() {
        let t = 0.5 * (instant + 1) as f32;
        *pose = [speed * 4.0, 6.0 * (t - when), 0.0, 1.0];
    }
    poses[INSTANTS - 1] = [0.0; 4];
    LoggedBox { poses, half: [2.2, 0.9], number: 100 }
}

fn parked(x: f32) -> LoggedBox {
    LoggedBox { poses: [[x, 2.4, 1.0, 0.0]; INSTANTS], half: [2.4, 1.0], number: 101 }
}
