//! Formats of Waymo's challenges: `tf.Example` records and submissions, read as protobuf.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod generated;

use formats::womd::proto::{Example, FeatureKind, SimAgentsChallengeSubmission};
use formats::womd::{Options, RecordReader};
use formats::{ExportOptions, Exported, ExportedMotion, registry};
use proptest::prelude::*;
use prost::Message;
use scene::{AgentFutures, Future, Generated, Sample, Scene, State, Timing, Vec2};
use std::collections::BTreeMap;

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

fn export(format: &str, scenes: &[&Scene], options: &ExportOptions) -> Exported {
    registry::by_id(format).unwrap().export(scenes, options).unwrap()
}

fn log() -> ExportOptions {
    ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() }
}

fn examples(bytes: &[u8]) -> Vec<BTreeMap<String, FeatureKind>> {
    // Lists that are mostly empty pack well.
    let options = Options { max_expansion: 10_000, ..Options::default() };
    let records = RecordReader::new(bytes, &options).unwrap();
    let lists = |data: &[u8]| Example::decode(data).unwrap().features.unwrap().feature;
    let named =
        |data: &[u8]| lists(data).into_iter().map(|(name, list)| (name, list.kind.unwrap())).collect();
    records.map(|record| named(&record.unwrap().data)).collect()
}

fn floats<'a>(lists: &'a BTreeMap<String, FeatureKind>, name: &str) -> &'a [f32] {
    match lists.get(name) {
        Some(FeatureKind::Float(list)) => &list.value,
        other => panic!("{name}: {other:?}"),
    }
}

fn whole<'a>(lists: &'a BTreeMap<String, FeatureKind>, name: &str) -> &'a [i64] {
    match lists.get(name) {
        Some(FeatureKind::Int64(list)) => &list.value,
        other => panic!("{name}: {other:?}"),
    }
}

/// Names with their lengths, as the dataset has them.
fn shapes() -> BTreeMap<String, usize> {
    let mut shapes = BTreeMap::from([("scenario/id".to_owned(), 1)]);
    for name in ["id", "type", "is_sdc", "tracks_to_predict", "difficulty_level", "objects_of_interest"] {
        shapes.insert(format!("state/{name}"), 128);
    }
    for (part, steps) in [("past", 10), ("current", 1), ("future", 80)] {
        for name in [
            "x",
            "y",
            "z",
            "bbox_yaw",
            "length",
            "width",
            "height",
            "velocity_x",
            "velocity_y",
            "speed",
            "vel_yaw",
            "timestamp_micros",
            "valid",
        ] {
            shapes.insert(format!("state/{part}/{name}"), 128 * steps);
        }
        for name in ["id", "state", "valid", "x", "y", "z"] {
            shapes.insert(format!("traffic_light_state/{part}/{name}"), 16 * steps);
        }
        shapes.insert(format!("traffic_light_state/{part}/timestamp_micros"), steps);
    }
    for (name, width) in [("xyz", 3), ("dir", 3), ("id", 1), ("type", 1), ("valid", 1)] {
        shapes.insert(format!("roadgraph_samples/{name}"), 30_000 * width);
    }
    shapes
}

#[test]
fn records_have_the_lists_of_the_dataset() {
    let scene = formats::native::read(JUNCTION).unwrap();
    for gzip in [false, true] {
        let options = ExportOptions { gzip, ..ExportOptions::default() };
        let file = export("womd-example", &[&scene, &scene], &options);
        assert_eq!(
            file,
            export("womd-example", &[&scene, &scene], &options),
            "the same scene is the same bytes"
        );
        let records = examples(&file.bytes);
        assert_eq!((records.len(), &records[0]), (2, &records[1]));
        let lengths = records[0].iter().map(|(name, list)| {
            let length = match list {
                FeatureKind::Bytes(list) => list.value.len(),
                FeatureKind::Float(list) => list.value.len(),
                FeatureKind::Int64(list) => list.value.len(),
            };
            (name.clone(), length)
        });
        assert_eq!(lengths.collect::<BTreeMap<_, _>>(), shapes());
    }
}

/// One sample a seed with a future for every road user, each in another direction.
fn with_samples(scene: &Scene, count: usize) -> Scene {
    let future = |turn: usize| {
        let state = |i: usize| State { x_m: i as f64, y_m: turn as f64, ..State::default() };
        Future::bare(1.0, scene.time.now_step + 1, (0..80).map(state).collect())
    };
    let sample = |turn: usize| {
        let futures = scene.agents.iter().map(|a| (a.id.clone(), AgentFutures::of(0, vec![future(turn)])));
        Sample { agents: futures.collect(), ..Sample::default() }
    };
    let generated = Generated { samples: (0..count).map(sample).collect(), ..Generated::default() };
    Scene { generated: Some(generated), ..scene.clone() }
}

fn submission(file: &Exported) -> SimAgentsChallengeSubmission {
    SimAgentsChallengeSubmission::decode(file.bytes.as_slice()).unwrap()
}

#[test]
fn submissions_begin_at_the_challenges_step() {
    let scene = formats::native::read(JUNCTION).unwrap();
    let refused = |scene: &Scene| {
        let format = registry::by_id("sim-agents").unwrap();
        format.export(&[scene], &ExportOptions::default()).unwrap_err().to_string()
    };
    assert!(refused(&scene).contains("this scene at step 2 (0.2 s)"), "{}", refused(&scene));
    // Futures that begin later are no rollouts either.
    let mut late = with_samples(&Scene { time: Timing { steps: 91, now_step: 20 }, ..scene }, 2);
    late.time.now_step = 10;
    assert!(refused(&late).contains("at step 20 (2.0 s)"), "{}", refused(&late));
}

#[test]
fn samples_are_rollouts() {
    let mut plain = formats::native::read(JUNCTION).unwrap();
    plain.time = Timing { steps: 91, now_step: 10 };
    plain.generated = None;
    plain.agents.iter_mut().for_each(|agent| agent.track.first_step += 8);
    let scene = with_samples(&plain, 32);
    let file = export("sim-agents", &[&scene, &plain], &ExportOptions::default());
    assert_eq!(file, export("sim-agents", &[&scene, &plain], &ExportOptions::default()));
    let sent = submission(&file);
    assert_eq!((sent.submission_type, sent.scenario_rollouts.len()), (Some(1), 2));
    let rollouts = &sent.scenario_rollouts[0].joint_scenes;
    assert_eq!(rollouts.len(), 32);
    let now = scene.time.now_step;
    let there = scene.agents.iter().filter(|agent| agent.track.at(now).is_some()).count();
    assert!(there > 0);
    let origin = &scene.meta.origin;
    for (turn, joint) in rollouts.iter().enumerate() {
        assert!(joint.simulated_trajectories.len() >= there);
        for way in &joint.simulated_trajectories {
            let lengths = [&way.center_x, &way.center_y, &way.center_z, &way.heading].map(Vec::len);
            assert_eq!(lengths, [80; 4]);
            assert!((f64::from(way.center_x[79]) - 79.0 - origin.x_m).abs() < 1e-2);
            assert!((f64::from(way.center_y[0]) - turn as f64 - origin.y_m).abs() < 1e-2);
        }
    }
    // Too few samples are a declared loss.
    let codes = |scene: &Scene| -> Vec<&str> {
        export("sim-agents", &[scene], &ExportOptions::default())
            .losses
            .iter()
            .map(|loss| loss.code)
            .collect()
    };
    assert!(codes(&with_samples(&plain, 3)).contains(&"no-rollouts"));
    assert!(!codes(&scene).contains(&"no-rollouts"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn records_say_what_the_scene_does(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let file = export("womd-example", &[&scene], &log());
        let lists = examples(&file.bytes).remove(0);
        let now = scene.time.now_step;
        let lost = |code: &str| file.losses.iter().any(|loss| loss.code == code);
        prop_assert_eq!(lost("no-timing"), now != 10 || scene.time.steps > now + 81);
        let near = |list: f32, value: f64| (f64::from(list) - value).abs() < 0.02;
        for (part, first, steps) in [("past", now as i64 - 10, 10), ("current", now as i64, 1), ("future", now as i64 + 1, 80)] {
            let list = |name: &str| floats(&lists, &format!("state/{part}/{name}"));
            let valid = whole(&lists, &format!("state/{part}/valid"));
            for slot in 0..128 {
                for i in 0..steps {
                    let at = slot * steps + i;
                    let step = usize::try_from(first + i as i64).ok();
                    let agent = scene.agents.get(slot);
                    let state = agent.and_then(|agent| agent.track.at(step?));
                    prop_assert_eq!(valid[at] == 1, state.is_some());
                    let Some(state) = state else {
                        prop_assert_eq!((list("x")[at], list("speed")[at]), (-1.0, -1.0));
                        continue;
                    };
                    prop_assert!(near(list("x")[at], state.x_m + scene.meta.origin.x_m));
                    prop_assert!(near(list("y")[at], state.y_m + scene.meta.origin.y_m));
                    prop_assert!(near(list("bbox_yaw")[at], state.heading_rad));
                    prop_assert!(near(list("speed")[at], state.speed_mps()));
                    prop_assert!(near(list("length")[at], agent.unwrap().size.length_m));
                }
            }
        }
        let ego = scene.agents.iter().position(|agent| agent.role.is_some());
        prop_assert_eq!(whole(&lists, "state/is_sdc").iter().position(|v| *v == 1), ego);
        // Every valid point of a road lies on a line of the map, and its direction is of length one.
        let (valid, ids) = (whole(&lists, "roadgraph_samples/valid"), whole(&lists, "roadgraph_samples/id"));
        let (xyz, along) = (floats(&lists, "roadgraph_samples/xyz"), floats(&lists, "roadgraph_samples/dir"));
        let count = valid.iter().filter(|v| **v == 1).count();
        prop_assert!(count > 0 && count <= 30_000);
        for i in (0..count).step_by(17) {
            let at = Vec2::new(xyz[3 * i].into(), xyz[3 * i + 1].into());
            let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
            if let Some(lane) = scene.map.lanes.iter().find(|lane| lane.id == ids[i].to_string()) {
                prop_assert!(formats::polyline::distance_to(&lane.points.xy, at - origin) < 0.02);
                let norm = along[3 * i..3 * i + 3].iter().map(|v| v * v).sum::<f32>().sqrt();
                prop_assert!((norm - 1.0).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn submissions_follow_the_log_where_nothing_is_generated(scene in generated::scene()) {
        let mut scene = scene.checked().unwrap();
        scene.time = Timing { steps: scene.time.steps.max(11), now_step: 10 };
        scene.generated = None;
        let sent = submission(&export("sim-agents", &[&scene], &log()));
        let now = scene.time.now_step;
        let there: Vec<_> = scene.agents.iter().filter(|agent| agent.track.at(now).is_some()).collect();
        let ways = &sent.scenario_rollouts[0].joint_scenes[0].simulated_trajectories;
        prop_assert_eq!(ways.len(), there.len());
        for (agent, way) in there.iter().zip(ways) {
            prop_assert_eq!(way.object_id.unwrap().to_string(), agent.id.clone());
            prop_assert_eq!(way.center_x.len(), 80);
            for step in now + 1..scene.time.steps {
                let Some(state) = agent.track.at(step) else { continue };
                let x = f64::from(way.center_x[step - now - 1]) - scene.meta.origin.x_m;
                prop_assert!((x - state.x_m).abs() < 0.02);
            }
        }
    }
}
