use std::path::{Path, PathBuf};
use std::sync::Arc;

use candle_core::{DType, Device, Tensor};
use experts::features::AgentFeatures;
use experts::features::agent::plan_with;
use experts::planning::MODES;
use experts::planning::world::World;
use scene::routes::LaneGraph;
use scene::{Goal, Scene, Vec2};

use super::encoder::Sight;
use super::regressor::NUMBERS;
use super::sight::{Truth, forget_goals};
use super::*;
use crate::polylines::Polylines;
use crate::samples::{log, scene, shifted};
use crate::scenes::blind;
use crate::training::{Record, toy};

fn random(kind: BaselineKind, expert: &str, seed: u64) -> Networks {
    Networks::small(kind, expert, seed).unwrap()
}

fn written(folder: &Path, name: &str, networks: &Networks) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, networks.save().unwrap()).unwrap();
    path
}

/// Two cars with logs, and the networks' futures of the first under a goal.
fn answers(networks: &Networks, scene: &Scene, goal: Goal) -> Vec<scene::Future> {
    let folder = tempfile::tempdir().unwrap();
    let path = written(folder.path(), "a.safetensors", networks);
    let baseline = Baseline::load("a", &path).unwrap();
    let mut asked = blind(scene);
    asked.agents[0].conditions.goal = goal;
    let world = World::new(&asked, Arc::new(LaneGraph::new(&scene.map)), 0);
    baseline.futures(&world, &Polylines::new(&scene.map), &[0]).unwrap().remove(0)
}

fn two_cars() -> Scene {
    scene(vec![log("a", 8.0, 91), shifted(log("b", 6.0, 91), 30.0, 3.5)])
}

fn goal() -> Goal {
    Goal { position: Some(Vec2::new(60.0, 3.0)), speed_mps: Some(5.0), time_s: Some(9.0), heading_rad: None }
}

#[test]
fn shapes_are_those_of_six_futures() {
    let features = AgentFeatures {
        own: [0.1; experts::features::OWN],
        neighbours: Vec::new(),
        anchors: Box::new([[0.0; experts::features::ANCHOR]; MODES]),
        tangent: Box::new([[[0.0; scene::KNOTS]; scene::KNOTS]; 2]),
    };
    let networks = random(BaselineKind::Paper, "vehicle", 1);
    let sight =
        Sight::stack(&networks.plan, &[], &[&[], &[]], &[&features, &features], &Device::Cpu).unwrap();
    let regressed = networks.regressor.forward(&sight).unwrap();
    assert_eq!(regressed.points.dims(), [2, MODES, NUMBERS]);
    assert_eq!(regressed.score.dims(), [2, MODES]);
    let refiner = networks.refiner.as_ref().unwrap();
    let seen = refiner.context(&sight).unwrap();
    let noise = refiner.noise(&seen, &regressed.points, &[5, 100]).unwrap();
    assert_eq!(noise.dims(), [2, MODES, NUMBERS]);
    assert_eq!(unet::steps(), [(5, 4), (4, 3), (3, 2), (2, 1), (1, 0)]);
    assert!(random(BaselineKind::TrafficGen, "vehicle", 1).refiner.is_none());
}

#[test]
fn nothing_but_start_and_goal_changes_an_answer() {
    let scene = two_cars();
    let mut other = scene.clone();
    for agent in &mut other.agents {
        for state in agent.track.states.iter_mut().skip(1).flatten() {
            (state.x_m, state.vx_mps) = (state.x_m + 17.0, 0.0);
        }
    }
    for kind in [BaselineKind::TrafficGen, BaselineKind::TrafficGenConditional, BaselineKind::Paper] {
        let networks = random(kind, kind.expert().unwrap_or("vehicle"), 3);
        let free = answers(&networks, &scene, Goal::default());
        assert_eq!(free.len(), MODES);
        assert!(free.iter().all(|f| f.probability <= free[0].probability && f.states.len() == 90));
        assert_eq!(free, answers(&networks, &other, Goal::default()));
        let asked = answers(&networks, &scene, goal());
        assert_eq!(asked, answers(&networks, &other, goal()));
        assert_eq!(asked != free, kind.has_condition(), "{kind:?}");
    }
}

#[test]
fn goals_can_be_forgotten() {
    let scene = two_cars();
    let graph = Arc::new(LaneGraph::new(&scene.map));
    let features = |goal: Goal| {
        let mut scene = scene.clone();
        scene.agents.iter_mut().for_each(|a| a.conditions.goal = Goal { position: None, ..goal });
        scene.agents[1].conditions.goal = goal;
        let world = World::new(&scene, graph.clone(), 0);
        let who = world.present.iter().find(|p| p.index == 0).unwrap();
        plan_with(&world, who, Vec::new()).features
    };
    let (free, mut asked) =
        (features(Goal::default()), features(Goal { heading_rad: Some(0.3), time_s: Some(5.0), ..goal() }));
    assert_ne!(free.own, asked.own);
    assert_ne!(free.neighbours, asked.neighbours);
    let mut forgotten = free.clone();
    forget_goals(&mut forgotten);
    forget_goals(&mut asked);
    assert_eq!((forgotten.own, &forgotten.neighbours), (asked.own, &asked.neighbours));
    assert_eq!(free.own[..11], forgotten.own[..11]);
}

#[test]
fn recordings_are_where_they_were() {
    let record: Record = toy::scenes(1, 1, 3).remove(0).2.remove(0);
    let truth = Truth::of(&record);
    let target = &record.target;
    for i in 0..experts::planning::INSTANTS {
        let [x, y] = truth.points[i];
        let expected = [target.along[0][i] + record.centre_ahead, target.across[0][i]];
        assert!((x - expected[0]).abs() < 1e-4 && (y - expected[1]).abs() < 1e-4);
    }
}

/// Seeded scenes with a condition for every road user.
fn asked_scenes(count: usize) -> Vec<toy::ToyScene> {
    let mut scenes = toy::scenes(count, 8, 7);
    for record in scenes.iter_mut().flat_map(|(.., records)| records) {
        let speed = record.agent.own[0];
        record.agent.own[experts::features::OWN_GOAL_VALUES].fill(0.5 + 0.1 * speed);
    }
    scenes
}

fn options_of(folder: &Path, kind: BaselineKind, stage: Stage, steps: u64) -> TrainOptions<Plan> {
    let records = folder.join("toy.records");
    if !records.exists() {
        toy::write(&records, &toy::scenes(40, 8, 7));
    }
    TrainOptions {
        steps,
        batch: 40,
        rate: 3e-3,
        expert: kind.expert().unwrap_or("vehicle").into(),
        architecture: Plan::small(kind),
        ..options(kind, vec![records], stage, folder.join(format!("{kind:?}.safetensors")))
    }
}

#[test]
fn losses_fall_and_runs_repeat() {
    let folder = tempfile::tempdir().unwrap();
    let mean = |metrics: &Metrics, name| metrics.mean(name).unwrap();
    for kind in [BaselineKind::TrafficGen, BaselineKind::TrafficGenConditional, BaselineKind::Paper] {
        let run = |steps, threads| {
            let options =
                TrainOptions { threads, ..options_of(folder.path(), kind, Stage::Initializer, steps) };
            let metrics = train(&options, &mut |_| ()).unwrap();
            (metrics, std::fs::read(&options.out).unwrap())
        };
        let (before, _) = run(1, 1);
        let (after, _) = run(80, 1);
        assert!(mean(&after, "min") < 0.5 * mean(&before, "min"), "{kind:?}: {before} | {after}");
        assert!(run(12, 1).1 == run(12, 2).1, "{kind:?}: another run gives other weights");
    }
    let init = folder.path().join("Paper.safetensors");
    let joint = TrainOptions {
        init: Some(init.clone()),
        ..options_of(folder.path(), BaselineKind::Paper, Stage::Joint, 30)
    };
    let refined = train(&joint, &mut |_| ()).unwrap();
    assert!(mean(&refined, "refined") < 1.5 * mean(&refined, "min"), "{refined}");
    // Continuing a half-completed run gives the same as a single run.
    let expected = std::fs::read(&joint.out).unwrap();
    let mut half = None;
    let stopped = TrainOptions {
        validate_every: 5,
        init: None,
        ..options_of(folder.path(), BaselineKind::Paper, Stage::Joint, 10)
    };
    train(&stopped, &mut |line| {
        if let TrainProgress::Validation { step: 10, .. } = line {
            half = Some(std::fs::read(training::checkpoint_path(&stopped.out)).unwrap());
        }
    })
    .unwrap();
    let straight = std::fs::read(&stopped.out).unwrap();
    assert!(straight != expected);
    std::fs::write(training::checkpoint_path(&stopped.out), half.unwrap()).unwrap();
    train(&TrainOptions { resume: true, ..stopped.clone() }, &mut |_| ()).unwrap();
    assert!(std::fs::read(&stopped.out).unwrap() == straight);
    let other = TrainOptions { resume: true, architecture: Plan::small(BaselineKind::TrafficGen), ..stopped };
    let refused = train(&TrainOptions { stage: Stage::Joint, ..other }, &mut |_| ()).unwrap_err().to_string();
    assert!(refused.contains("one stage"), "{refused}");
}

#[test]
fn the_second_stage_leaves_denoiser_and_its_encoder_as_they_are_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    toy::write(&folder.path().join("toy.records"), &asked_scenes(20));
    let trained = |stage: Stage, init: Option<PathBuf>, name: &str| {
        let out = folder.path().join(name);
        let of = options_of(folder.path(), BaselineKind::Paper, stage, 12);
        train(&TrainOptions { init, out: out.clone(), ..of }, &mut |_| ()).unwrap();
        (Networks::load(&std::fs::read(&out).unwrap(), false, &Device::Cpu).unwrap(), out)
    };
    let changed = |before: &Networks, after: &Networks, name: &str| {
        let bits = |networks: &Networks| -> Vec<u32> {
            let values = networks.tensors[name].flatten_all().unwrap().to_vec1::<f32>().unwrap();
            values.into_iter().map(f32::to_bits).collect()
        };
        bits(before) != bits(after)
    };
    let (first, path) = trained(Stage::Denoiser, None, "first");
    let (second, path) = trained(Stage::Initializer, Some(path), "second");
    let (third, _) = trained(Stage::Joint, Some(path), "third");
    let names: Vec<&String> = first.tensors.keys().collect();
    assert!(names.iter().any(|name| name.starts_with("refiner.sight.")), "no encoder of its own");
    for name in names {
        let frozen = name.starts_with("refiner.");
        assert_eq!(changed(&first, &second, name), !frozen, "{name}");
        assert!(changed(&second, &third, name), "{name} takes no part in the joint stage");
    }
}

#[test]
fn the_condition_reaches_the_denoiser_at_each_step() {
    let record: Record = toy::scenes(1, 1, 3).remove(0).2.remove(0);
    let networks = random(BaselineKind::Paper, "vehicle", 3);
    let mut asked = record.agent.clone();
    asked.own[experts::features::OWN_GOAL_VALUES].fill(0.3);
    let refiner = networks.refiner.as_ref().unwrap();
    let noise = |agent: &AgentFeatures| {
        let sight = Sight::stack(&networks.plan, &[], &[&[]], &[agent], &Device::Cpu).unwrap();
        let futures = Tensor::zeros((1, MODES, NUMBERS), DType::F32, &Device::Cpu).unwrap();
        let context = refiner.context(&sight).unwrap();
        refiner.noise(&context, &futures, &[3]).unwrap().flatten_all().unwrap().to_vec1::<f32>().unwrap()
    };
    assert_ne!(noise(&record.agent), noise(&asked));
    // A baseline without conditions sees none of it.
    let blind = Sight::stack(&Plan::small(BaselineKind::TrafficGen), &[], &[&[]], &[&asked], &Device::Cpu);
    assert!(random(BaselineKind::TrafficGen, "vehicle", 3).regressor.forward(&blind.unwrap()).is_ok());
}

#[test]
fn the_conditions_width_is_a_choice() {
    let plan = Plan { condition_width: 1024, ..Plan::of(BaselineKind::Paper) };
    let card = random(BaselineKind::Paper, "vehicle", 1).card;
    let networks = Networks::build(plan, card, Params::random(1, false, &Device::Cpu)).unwrap();
    assert_eq!(networks.tensors["initializer.sight.condition.0.weight"].dims(), [8, 1024]);
    assert_eq!(networks.tensors["refiner.asked.weight"].dims(), [1024, 128]);
    assert!(networks.save().unwrap() == networks.save().unwrap());
}

#[test]
fn every_variable_gets_a_gradient_in_its_stages() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("toy.records");
    toy::write(&path, &asked_scenes(2));
    let (tools, shard) = toy::shard(&path);
    let networks = random(BaselineKind::Paper, "vehicle", 3);
    toy::assert_gradients_by_stage(&networks, &tools, &shard);
}

#[test]
fn files_come_back_and_bad_ones_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let networks = random(BaselineKind::Paper, "vehicle", 5);
    let path = written(folder.path(), "vehicle.safetensors", &networks);
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(Networks::load(&bytes, false, &Device::Cpu).unwrap().save().unwrap(), bytes);
    let refused = |path: &Path| Baseline::load("x", path).err().map(|e| format!("{e:#}")).unwrap();
    assert!(Baseline::load("x", folder.path()).is_ok());
    written(folder.path(), "twice.safetensors", &random(BaselineKind::Paper, "vehicle", 6));
    assert!(refused(folder.path()).contains("same type"));
    written(folder.path(), "twice.safetensors", &random(BaselineKind::TrafficGen, "vehicle", 6));
    assert!(refused(folder.path()).contains("another method"));
    let bad = folder.path().join("bad");
    std::fs::write(&bad, &bytes[..bytes.len() - 3]).unwrap();
    assert!(refused(&bad).contains("not a safetensors file"));
    written(folder.path(), "bad", &random(BaselineKind::Paper, "tram", 6));
    assert!(refused(&bad).contains("expert \"tram\""));
    let expert = experts::net::Expert::random(1).unwrap();
    std::fs::write(&bad, expert.save().unwrap()).unwrap();
    assert!(refused(&bad).contains("not a baseline's weights"));
    let mut fewer = random(BaselineKind::Paper, "vehicle", 5);
    fewer.tensors.remove("refiner.levels");
    written(folder.path(), "bad", &fewer);
    assert!(refused(&bad).contains("\"refiner.levels\" is missing"));
    let narrow = Tensor::zeros((2, 2), DType::F32, &Device::Cpu).unwrap();
    fewer.tensors.insert("refiner.levels".into(), narrow);
    written(folder.path(), "bad", &fewer);
    assert!(refused(&bad).contains("expected F32 [101, 32]"));
    assert!(refused(&folder.path().join("absent")).contains("absent"));
}
