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
        // The run is stopped after ten steps, as a killed one would be: the file of step ten is put back.
        let stopped = TrainOptions { validate_every: 10, ..straight.clone() };
        let mut at_ten = None;
        run(&stopped, &mut |line| {
            // Reported before it is saved, so the file is still that of step ten.
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
