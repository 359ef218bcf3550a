//! Training records from scenes: each road user of a kind, under a drawn choice of conditions, with
//! what it really did in the coordinates of its anchors.

mod conditions;
mod record;

use crate::train::{Record, Writer};
use anyhow::{Context, Result};
use conditions::Draw;
use experts::features::STANDING_SHARE;
use experts::features::world::{MapIndex, World};
use rayon::prelude::*;
use scene::{AgentType, HORIZON_STEPS, Scene};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What to prepare.
#[derive(Clone, Debug)]
pub struct Options {
    /// Files or folders of scenes in any format that can be read.
    pub inputs: Vec<PathBuf>,
    /// File of records to write.
    pub out: PathBuf,
    /// Whose expert.
    pub agent_type: AgentType,
    /// Draws conditions and road users.
    pub seed: u64,
    /// Most road users of a scene.
    pub per_scene: usize,
    /// Choices of conditions for each road user.
    pub draws: usize,
    /// Stop after so many records.
    pub most_records: u64,
}

/// What was prepared and what was left out.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Report {
    pub files: usize,
    pub scenes: usize,
    pub records: u64,
    pub unreadable: usize,
    pub too_short: usize,
    pub standing_left_out: usize,
}

/// Reads scenes, writes records; files in order of their names, so the same input gives the same bytes.
///
/// # Errors
/// When nothing can be read or the records cannot be written.
pub fn run(options: &Options, mut progress: impl FnMut(&Report)) -> Result<Report> {
    let files = scene_files(&options.inputs)?;
    let mut writer = Writer::create(&options.out)?;
    let mut report = Report::default();
    for chunk in files.chunks(32) {
        let batches: Vec<Vec<SceneRecords>> =
            chunk.par_iter().map(|file| file_records(file, options)).collect();
        for batch in batches {
            report.files += 1;
            report.unreadable += usize::from(batch.is_empty());
            for scene in batch {
                report.scenes += 1;
                report.too_short += scene.too_short;
                report.standing_left_out += scene.standing;
                if scene.records.is_empty() || report.records >= options.most_records {
                    continue;
                }
                report.records += scene.records.len() as u64;
                writer.scene(scene.key, &scene.map.pieces.features, &scene.records)?;
            }
        }
        progress(&report);
        if report.records >= options.most_records {
            break;
        }
    }
    writer.finish()?;
    Ok(report)
}

/// Scene files below the inputs, sorted.
///
/// # Errors
/// When a folder cannot be listed or holds nothing.
pub fn scene_files(inputs: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for input in inputs {
        if input.is_dir() {
            let listing = std::fs::read_dir(input).with_context(|| format!("list {}", input.display()))?;
            files.extend(listing.filter_map(|e| e.ok().map(|e| e.path())).filter(|p| p.is_file()));
        } else {
            files.push(input.clone());
        }
    }
    files.retain(|p| !p.to_string_lossy().ends_with(".tmp"));
    files.sort();
    anyhow::ensure!(!files.is_empty(), "no files in {inputs:?}");
    Ok(files)
}

/// All scenes of a file that can be read.
///
/// # Errors
/// When the file cannot be opened or no format reads it.
pub fn read_scenes(path: &Path) -> Result<Vec<Scene>> {
    let bytes = std::fs::read(path).with_context(|| format!("read {}", path.display()))?;
    let options = formats::registry::ImportOptions::default();
    let imported = formats::registry::import(&bytes, &path.to_string_lossy(), "auto", &options);
    Ok(imported?.into_iter().filter_map(Result::ok).map(|(scene, _)| scene).collect())
}

struct SceneRecords {
    key: u64,
    map: Arc<MapIndex>,
    records: Vec<Record>,
    too_short: usize,
    standing: usize,
}

fn file_records(path: &Path, options: &Options) -> Vec<SceneRecords> {
    let scenes = read_scenes(path).unwrap_or_default();
    scenes.iter().map(|scene| scene_records(scene, options)).collect()
}

/// Scenes of one place share a key: the source id without its window number.
fn place_key(scene: &Scene) -> u64 {
    let id = scene.meta.source_id.as_deref().unwrap_or(&scene.name);
    let place = if id.starts_with("synth-") { id.rsplit_once('-').map_or(id, |p| p.0) } else { id };
    let hash = blake3::hash(place.as_bytes());
    hash.as_bytes()[..8].iter().fold(0, |key, byte| (key << 8) | u64::from(*byte))
}

fn scene_records(scene: &Scene, options: &Options) -> SceneRecords {
    let map = Arc::new(MapIndex::new(&scene.map));
    let key = place_key(scene);
    let mut out = SceneRecords { key, map: map.clone(), records: Vec::new(), too_short: 0, standing: 0 };
    let mut draw = Draw::new(options.seed, scene.meta.source_id.as_deref().unwrap_or(&scene.name));
    let base = World::new(scene, map.clone(), 0);
    let mut candidates: Vec<usize> = (0..scene.agents.len())
        .filter(|i| scene.agents[*i].agent_type == options.agent_type)
        .filter(|i| base.present.iter().any(|p| p.index == *i))
        .collect();
    draw.shuffle(&mut candidates);
    let mut used = 0;
    for index in candidates {
        let agent = &scene.agents[index];
        let valid = agent.track.valid_steps().filter(|s| *s > 0 && *s <= HORIZON_STEPS).count();
        if valid < 30 {
            out.too_short += 1;
            continue;
        }
        let standing = agent.track.extent_m() < 2.0;
        if standing && !draw.chance(STANDING_SHARE) {
            out.standing += 1;
            continue;
        }
        for _ in 0..if standing { 1 } else { options.draws } {
            let mut conditions = base.conditions.clone();
            conditions[index].goal = draw.goal(agent, standing);
            draw.others(scene, index, &mut conditions);
            let world = World::with_conditions(scene, map.clone(), 0, conditions);
            out.records.extend(record::record(&world, index));
        }
        used += 1;
        if used >= options.per_scene {
            break;
        }
    }
    out
}
