//! Whole runs on the toy world.

use std::path::{Path, PathBuf};

use experts::net::{Architecture, Expert};

use super::sample::Shard;
use super::stages::Tools;
use super::*;

fn small() -> Architecture {
    Architecture { width: 32, gating_blocks: 2, ..Architecture::default() }
}

fn records(folder: &Path, scenes: usize) -> PathBuf {
    let path = folder.join("toy.records");
    toy::write(&path, &toy::scenes(scenes, 8, 7));
    path
}

fn options(folder: &Path, stage: Stage, steps: u64) -> TrainOptions {
    TrainOptions {
        steps,
        batch: 40,
        rate: 3e-3,
        architecture: small(),
        ..TrainOptions::new(vec![folder.join("toy.records")], stage, folder.join("out.safetensors"))
    }
}

fn trained(options: &TrainOptions) -> (Metrics, Vec<u8>) {
    let metrics = run(options, &mut |line| eprintln!("{line}")).unwrap();
    (metrics, std::fs::read(&options.out).unwrap())
}

#[test]
fn stopping_and_going_on_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    records(folder.path(), 30);
    for stage in [Stage::Denoiser, Stage::Initializer, Stage::Joint] {
        let straight = options(folder.path(), stage, 20);
        let (_, expected) = trained(&straight);
        // The run stops after ten steps, as a killed one would: the file of step ten is restored.
        let stopped = TrainOptions { validate_every: 10, ..straight.clone() };
        let mut at_ten = None;
        run(&stopped, &mut |line| {
            // The report comes before the save, so the file is still that of step ten.
            if let TrainProgress::Validation { step: 20, .. } = line {
                at_ten = Some(std::fs::read(checkpoint_path(&stopped.out)).unwrap());
            }
        })
        .unwrap();
        std::fs::write(checkpoint_path(&stopped.out), at_ten.unwrap()).unwrap();
        let resumed = TrainOptions { resume: true, threads: 2, ..straight.clone() };
        let mut from = 0;
        run(&resumed, &mut |line| {
            if let TrainProgress::Begin { step, .. } = line {
                from = *step;
            }
        })
        .unwrap();
        assert_eq!(from, 10);
        assert!(std::fs::read(&resumed.out).unwrap() == expected, "{stage:?}: weights differ");
    }
    let other = TrainOptions { resume: true, seed: 2, ..options(folder.path(), Stage::Joint, 20) };
    assert!(run(&other, &mut |_| ()).unwrap_err().to_string().contains("another seed"));
}

#[test]
fn a_run_that_is_stopped_goes_on_as_if_it_had_not_been() {
    let folder = tempfile::tempdir().unwrap();
    records(folder.path(), 30);
    let straight =
        TrainOptions { checkpoint_every_s: 0.0, ..options(folder.path(), Stage::Initializer, 130) };
    let (_, expected) = trained(&straight);
    let log = |out: &Path| std::fs::read(format!("{}.jsonl", out.display())).unwrap();
    let expected_log = log(&straight.out);
    let stopped = TrainOptions { out: folder.path().join("stopped.safetensors"), ..straight.clone() };
    let ended = run(&stopped, &mut |line| {
        if let TrainProgress::Training { step: 100, .. } = line {
            stopped.stop.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    });
    assert!(matches!(ended, Err(TrainError::Stopped { step: 100 })));
    assert!(!stopped.out.exists() && checkpoint_path(&stopped.out).exists());
    let resumed = TrainOptions { resume: true, stop: Default::default(), ..stopped.clone() };
    let (_, bytes) = trained(&resumed);
    assert!(bytes == expected, "weights differ");
    assert_eq!(log(&resumed.out), expected_log);
    // Other settings make another run.
    let other = [
        (TrainOptions { steps: 140, ..resumed.clone() }, "number of steps"),
        (TrainOptions { rate: 1e-3, ..resumed.clone() }, "rate"),
        (TrainOptions { minutes: Some(1.0), ..resumed.clone() }, "minutes"),
    ];
    for (other, what) in other {
        let refused = run(&other, &mut |_| ()).unwrap_err().to_string();
        assert!(refused.contains(what), "{refused}");
    }
}

#[test]
fn epochs_count_what_is_trained_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = records(folder.path(), 30);
    let loaded = Records::load(std::slice::from_ref(&path)).unwrap();
    let known = (0..loaded.len()).filter(|i| !is_held_out(loaded.scene_of(*i).0)).count();
    assert!(known < loaded.len());
    assert_eq!(steps_of(&[path], 2.0, known).unwrap(), 2);
}

#[test]
fn records_and_weights_of_another_expert_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    records(folder.path(), 30);
    let own = options(folder.path(), Stage::Initializer, 1);
    let (_, bytes) = trained(&own);
    let card = Expert::load(&bytes).unwrap().card;
    assert_eq!((card.expert.as_str(), card.trained_on.as_str()), ("vehicle", "30 scenes of toy (cc0)"));
    assert_eq!(card.licence, "MIT OR Apache-2.0");
    let other = TrainOptions { expert: "pedestrian".into(), ..own.clone() };
    let refused = run(&other, &mut |_| ()).unwrap_err().to_string();
    assert!(refused.contains("records of the expert \"vehicle\""), "{refused}");
    let files = [bytes.clone().into(), bytes.clone().into(), bytes.into()];
    let refused = experts::Generator::new(&files, std::sync::Arc::default()).err().unwrap().to_string();
    assert!(refused.contains("pedestrian.safetensors") && refused.contains("\"vehicle\""), "{refused}");
}

#[test]
fn the_best_weights_are_kept_beside_the_last() {
    let folder = tempfile::tempdir().unwrap();
    records(folder.path(), 30);
    // A rate this high makes the networks worse again in the fifth validation.
    let wild =
        TrainOptions { rate: 1.0, validate_every: 5, ..options(folder.path(), Stage::Initializer, 40) };
    let mut losses: Vec<f64> = Vec::new();
    let mut at_fourth = Vec::new();
    let ended = run(&wild, &mut |line| {
        if let TrainProgress::Validation { metrics, .. } = line {
            losses.extend(metrics.mean("loss").or(metrics.mean("min")));
            if losses.len() == 5 {
                // The report comes before the save, so the file is still that of the fourth.
                at_fourth = std::fs::read(&wild.out).unwrap();
                wild.stop.store(true, std::sync::atomic::Ordering::Relaxed);
            }
        }
    });
    assert!(matches!(ended, Err(TrainError::Stopped { step: 25 })));
    assert!(losses[4] > losses[3] && losses[..3].iter().all(|loss| *loss > losses[3]), "{losses:?}");
    assert!(std::fs::read(best_path(&wild.out)).unwrap() == at_fourth);
    assert!(std::fs::read(&wild.out).unwrap() != at_fourth);
}

#[test]
fn losses_fall_on_a_toy_world() {
    let folder = tempfile::tempdir().unwrap();
    records(folder.path(), 60);
    let first = options(folder.path(), Stage::Initializer, 1);
    let (before, _) = trained(&first);
    let (after, _) = trained(&TrainOptions { threads: 2, ..options(folder.path(), Stage::Initializer, 120) });
    let mean = |metrics: &Metrics, name| metrics.mean(name).unwrap();
    assert!(mean(&after, "min") < 0.7 * mean(&before, "min"), "{before} | {after}");
    assert!(mean(&after, "score") < mean(&before, "score"));
    let init = folder.path().join("initializer.safetensors");
    std::fs::rename(&first.out, &init).unwrap();
    let joint = TrainOptions { init: Some(init), threads: 2, ..options(folder.path(), Stage::Joint, 60) };
    let (refined, bytes) = trained(&joint);
    assert!(mean(&refined, "overlap'") < mean(&refined, "overlap"), "{refined}");
    assert!(mean(&refined, "refined") < 2.0 * mean(&refined, "min"), "{refined}");
    let expert = Expert::load(&bytes).unwrap();
    assert!(!expert.card.untrained && expert.card.notes.contains_key("joint steps"));
    let (denoised, _) = trained(&TrainOptions { threads: 2, ..options(folder.path(), Stage::Denoiser, 20) });
    assert!(denoised.means().all(|(_, mean)| mean.is_finite()));
}

#[test]
fn every_trained_variable_gets_a_gradient() {
    let folder = tempfile::tempdir().unwrap();
    let records = Records::load(&[records(folder.path(), 2)]).unwrap();
    let tools = Tools::new(experts::Refining::default());
    let indices: Vec<usize> = (0..records.len()).collect();
    let shard = Shard::new(&records, &indices, &tools.route).unwrap();
    let card = Expert::random(1).unwrap().card;
    let expert = Expert::trainable(small(), card, 3, &candle_core::Device::Cpu).unwrap();
    toy::assert_gradients_by_stage(&expert, &tools, &shard);
}
