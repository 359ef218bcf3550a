//! Training records from scenes: each road user of a kind, under a drawn choice of conditions, with its
//! recorded motion in the coordinates of its anchors.

mod cases;
mod conditions;
mod record;
mod report;
#[cfg(test)]
mod tests;

pub use cases::{CaseCondition, CaseRecords};
pub use report::{Fit, LeftOut, PlaceSplit, PrepareReport};

use crate::polylines::Polylines;
use crate::provenance::Provenance;
use crate::scenes::{Crop, Cropped, mirrored, place_key, read_scenes, scene_files};
use crate::training::{FitError, Record, RecordWriter};
use anyhow::Result;
use conditions::Draws;
use experts::features::STANDING_SHARE;
use experts::planning::world::World;
use rayon::prelude::*;
use scene::routes::LaneGraph;
use scene::{AgentType, HORIZON_STEPS, Scene};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Options of a preparation.
#[derive(Clone, Debug)]
pub struct PrepareOptions {
    /// Files or folders of scenes in any format that can be read.
    pub inputs: Vec<PathBuf>,
    /// File of records to write.
    pub out: PathBuf,
    /// Agent type of the expert.
    pub agent_type: AgentType,
    /// Draws conditions and road users.
    pub seed: u64,
    /// Most road users of a scene.
    pub per_scene: usize,
    /// Choices of conditions for each road user.
    pub draws: usize,
    /// Number of records after which the preparation stops.
    pub most_records: u64,
    /// Selection of the road users, and the least number of a scene.
    pub crop: Crop,
    /// Whether the mirror image of each scene is added.
    pub mirror: bool,
}

/// Reads scenes, writes records; files in order of their names, so the same input gives the same bytes.
///
/// # Errors
/// When nothing can be read or the records cannot be written.
pub fn run(options: &PrepareOptions, mut progress: impl FnMut(&PrepareReport)) -> Result<PrepareReport> {
    let files = scene_files(&options.inputs)?;
    let mut writer = RecordWriter::create(&options.out, Provenance::of(options.agent_type))?;
    let mut report = PrepareReport::default();
    let mut distances = Vec::new();
    for chunk in files.chunks(32) {
        let batches: Vec<Vec<SceneRecords>> =
            chunk.par_iter().map(|file| file_records(file, options)).collect();
        for batch in batches {
            report.files += 1;
            report.left_out.unreadable_files += usize::from(batch.is_empty());
            for scene in batch {
                report.scenes += 1;
                report.road_users += scene.road_users;
                report.left_out.add(&scene.left_out);
                if scene.records.is_empty() {
                    continue;
                }
                if report.records >= options.most_records {
                    report.left_out.over_the_files_limit += scene.used;
                    continue;
                }
                report.used += scene.used;
                report.records += scene.records.len() as u64;
                report.split.add(scene.key, scene.records.len());
                distances.extend(scene.distances);
                writer.comes_from(&scene.provenance);
                writer.scene(scene.key, &scene.polylines.pieces, &scene.records)?;
            }
        }
        progress(&report);
        if report.records >= options.most_records {
            break;
        }
    }
    report.blake3 = writer.finish()?.to_hex().to_string();
    report.fit = Fit::of(distances);
    Ok(report)
}

struct SceneRecords {
    key: u64,
    provenance: Provenance,
    polylines: Polylines,
    records: Vec<Record>,
    /// By record, metres; see [`FitError`].
    distances: Vec<f64>,
    road_users: usize,
    used: usize,
    left_out: LeftOut,
}

impl SceneRecords {
    fn new(scene: &Scene) -> Self {
        let mut provenance = Provenance::default();
        provenance.add(scene);
        Self {
            key: place_key(scene),
            provenance,
            polylines: Polylines::new(&scene.map),
            records: Vec::new(),
            distances: Vec::new(),
            road_users: scene.agents.len(),
            used: 0,
            left_out: LeftOut::default(),
        }
    }
}

fn file_records(path: &Path, options: &PrepareOptions) -> Vec<SceneRecords> {
    let scenes = read_scenes(path).unwrap_or_default();
    let images = |scene: Scene| {
        let image = options.mirror.then(|| mirrored(&scene));
        std::iter::once(scene).chain(image)
    };
    scenes.into_iter().flat_map(images).map(|scene| cropped_records(scene, options)).collect()
}

/// Records of a scene after the crop.
fn cropped_records(scene: Scene, options: &PrepareOptions) -> SceneRecords {
    let mut out = SceneRecords::new(&scene);
    match options.crop.apply(scene) {
        Cropped::Kept(scene, outside) => {
            out.left_out.outside_the_crop = outside;
            scene_records(&scene, options, &mut out);
        }
        Cropped::TooFew(_) => {
            out.left_out.scenes_with_too_few = 1;
            out.left_out.in_scenes_with_too_few = out.road_users;
        }
    }
    out
}

fn scene_records(scene: &Scene, options: &PrepareOptions, out: &mut SceneRecords) {
    let graph = Arc::new(LaneGraph::new(&scene.map));
    let mut draw = Draws::new(options.seed, scene.meta.source_id.as_deref().unwrap_or(&scene.name));
    let base = World::new(scene, graph.clone(), 0);
    let fit = FitError::new();
    let mut candidates: Vec<usize> = Vec::new();
    for (i, agent) in scene.agents.iter().enumerate() {
        if agent.agent_type != options.agent_type {
            out.left_out.wrong_type += 1;
        } else if base.present.iter().any(|p| p.index == i) {
            candidates.push(i);
        } else {
            out.left_out.absent_at_the_start += 1;
        }
    }
    draw.shuffle(&mut candidates);
    for (looked_at, &index) in candidates.iter().enumerate() {
        if out.used >= options.per_scene.max(1) {
            out.left_out.over_the_scenes_limit = candidates.len() - looked_at;
            break;
        }
        let agent = &scene.agents[index];
        let valid = agent.track.valid_steps().filter(|s| *s > 0 && *s <= HORIZON_STEPS).count();
        if valid < 30 {
            out.left_out.too_short += 1;
            continue;
        }
        let standing = agent.track.extent_m() < 2.0;
        if standing && !draw.takes(STANDING_SHARE) {
            out.left_out.standing += 1;
            continue;
        }
        for _ in 0..if standing { 1 } else { options.draws } {
            let mut conditions = base.conditions.clone();
            conditions[index].goal = draw.goal(agent, standing);
            draw.others(scene, index, &mut conditions);
            let world = World::with_conditions(scene, graph.clone(), 0, conditions);
            if let Some(record) = record::record(&world, &out.polylines, index) {
                out.distances.extend(fit.of(&record));
                out.records.push(record);
            }
        }
        out.used += 1;
    }
}
