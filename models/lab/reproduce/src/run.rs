//! One run from recordings to tables.

use crate::collisions::{self, CollisionOptions};
use crate::figure::{self, FIGURE_FILE};
use crate::methods::Entrants;
use crate::quality;
use crate::report::Report;
use crate::sets::{self, Data, Part, SetOptions, Sets};
use crate::training::{Schedule, Training};
use crate::{Stop, stopped};
use anyhow::{Context, Result};
use experts::Engine;
use scene::ContentHash;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Results to make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// Tables I and II, and the trainings that they need.
    pub tables: bool,
    /// The page of pictures, with the shipped weights.
    pub figure: bool,
}

/// Options of a run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// Sources of the scenes.
    pub data: Data,
    /// Folder of the run.
    pub out: PathBuf,
    /// Options of the sets.
    pub sets: SetOptions,
    /// Schedule of the trainings.
    pub schedule: Schedule,
    /// Hidden size of the condition's MLP.
    pub condition_width: usize,
    /// Options of Table II.
    pub collisions: CollisionOptions,
    /// Parts to make.
    pub parts: Parts,
    /// Seed of all draws.
    pub seed: u64,
    /// Threads that share a step of training.
    pub threads: usize,
    /// Flag that ends the run.
    pub stop: Stop,
}

/// The folder holds a run with other settings.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{folder} holds a run with another {what}; give another folder, or --force to begin anew")]
pub struct OtherRun {
    /// Folder.
    pub folder: String,
    /// Difference between the runs.
    pub what: String,
}

/// Settings that decide the sets and weights of a run.
#[derive(Serialize)]
struct Settings {
    /// Hash of the names and sizes of all files.
    data: String,
    sets: SetOptions,
    schedule: Schedule,
    condition_width: usize,
    seed: u64,
}

const SETTINGS_FILE: &str = "settings.json";
const SETS_FILE: &str = "sets.json";

/// Makes sets, pictures, weights and tables, except existing sets and weights; returns the tables as
/// Markdown.
///
/// # Errors
/// [`OtherRun`] if the folder belongs to another run, [`crate::Stopped`] if a stop was requested, and errors
/// of files and networks.
pub fn run(options: &RunOptions, engine: Engine, progress: &dyn Fn(&str)) -> Result<String> {
    let folder = options.out.as_path();
    begin(options)?;
    let sets = sets_of(options, progress)?;
    if options.parts.figure {
        let made = (&options.data, &options.sets, &sets);
        let panels = figure::make(made.0, made.1, made.2, &engine, options.seed, &options.stop, progress)?;
        let path = folder.join(FIGURE_FILE);
        formats::files::replace(&path, figure::page(&panels, &sets.sources).as_bytes())
            .with_context(|| format!("write {}", path.display()))?;
        progress(&format!("{} pictures in {}", panels.len(), path.display()));
    }
    if !options.parts.tables {
        return Ok(String::new());
    }
    let training = Training {
        folder,
        schedule: options.schedule,
        condition_width: options.condition_width,
        seed: options.seed,
        threads: options.threads,
        stop: &options.stop,
    };
    let trained = training.run(&sets, progress)?;
    let entrants = Entrants::load(folder, &sets, engine.generator, options.seed)?;
    let (data, cut, stop) = (&options.data, &options.sets, &options.stop);
    let first = quality::table(data, cut, &sets, &entrants, options.seed, stop, progress)?;
    let (second, interactive) =
        collisions::table(data, cut, &sets, &entrants, options.collisions, stop, progress)?;
    stopped(stop)?;
    let report = Report {
        options: cut,
        sets: &sets,
        own_tests: !data.test.is_empty(),
        trained: &trained,
        condition_width: options.condition_width,
        seed: options.seed,
        interactive,
        sheets: &[first, second],
    };
    report.write(folder)?;
    Ok(report.markdown())
}

/// Claims the folder, or checks that it belongs to this run.
fn begin(options: &RunOptions) -> Result<()> {
    let mut names = String::new();
    for part in [Part::Data, Part::Test] {
        for file in options.data.files(part)? {
            let size = std::fs::metadata(&file).with_context(|| format!("read {}", file.display()))?.len();
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            names += &format!("{part:?} {name} {size}\n");
        }
    }
    let settings = Settings {
        data: ContentHash::of_bytes(names.as_bytes()).hex(),
        sets: options.sets,
        schedule: options.schedule,
        condition_width: options.condition_width,
        seed: options.seed,
    };
    let settings = serde_json::to_value(settings)?;
    let path = options.out.join(SETTINGS_FILE);
    if !path.exists() {
        std::fs::create_dir_all(&options.out).with_context(|| format!("make {}", options.out.display()))?;
        return write_json(&path, &settings);
    }
    let text = std::fs::read(&path).with_context(|| format!("read {}", path.display()))?;
    let before: serde_json::Value = serde_json::from_slice(&text)
        .with_context(|| format!("{}: settings of a run expected", path.display()))?;
    let other = ["data", "sets", "schedule", "condition_width", "seed"]
        .into_iter()
        .find(|k| before[k] != settings[k]);
    match other {
        None => Ok(()),
        Some(what) => {
            let folder = options.out.display().to_string();
            Err(OtherRun { folder, what: what.replace('_', " ") }.into())
        }
    }
}

/// The sets of a run, made if they are missing.
fn sets_of(options: &RunOptions, progress: &dyn Fn(&str)) -> Result<Sets> {
    let path = options.out.join(SETS_FILE);
    if path.exists() {
        let text = std::fs::read(&path).with_context(|| format!("read {}", path.display()))?;
        return serde_json::from_slice(&text)
            .with_context(|| format!("{}: sets of a run expected", path.display()));
    }
    let records = options.out.join("records");
    std::fs::create_dir_all(&records).with_context(|| format!("make {}", records.display()))?;
    let made = sets::make(&options.data, &options.sets, &options.out, &options.stop, progress)?;
    write_json(&path, &made)?;
    Ok(made)
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let text = format!("{}\n", serde_json::to_string_pretty(value)?);
    formats::files::replace(path, text.as_bytes()).with_context(|| format!("write {}", path.display()))
}

/// Removes a run's files from a folder, so that the next run starts from the beginning. Other files stay, and
/// so does a folder without a run.
///
/// # Errors
/// When something cannot be removed.
pub fn forget(folder: &Path) -> Result<()> {
    if !folder.join(SETTINGS_FILE).exists() {
        return Ok(());
    }
    for name in [SETTINGS_FILE, SETS_FILE] {
        let path = folder.join(name);
        if path.exists() {
            std::fs::remove_file(&path).with_context(|| format!("remove {}", path.display()))?;
        }
    }
    for name in ["records", "training", "weights"] {
        let path = folder.join(name);
        if path.exists() {
            std::fs::remove_dir_all(&path).with_context(|| format!("remove {}", path.display()))?;
        }
    }
    Ok(())
}
