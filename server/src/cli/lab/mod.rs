//! How experts are made and judged: the only folder that knows the lab. One file a command, or a pair.

mod crowd_bench;
mod eval;
mod http_bench;
mod placement;
mod prepare;
mod reproduce;
mod served;
mod statistics;
mod synthesize;
mod train;

pub use eval::{BenchArgs, EvalArgs, bench, eval};
pub use placement::{EvalPlaceArgs, TrainPlacementArgs, eval_place, train_placement};
pub use prepare::{PrepareArgs, prepare};
pub use reproduce::{ReproduceArgs, reproduce};
pub use statistics::{StatisticsArgs, statistics};
pub use synthesize::{SynthesizeArgs, synthesize};
pub use train::{TrainArgs, train};

use super::inputs::patterns;
use super::{Exit, Failure, output};
use clap::Args;
use std::path::PathBuf;

/// Scenes to look at.
#[derive(Args, Clone, Debug)]
struct SceneArgs {
    /// Files, folders or patterns of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Most files, in the order of their names.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    scenes: usize,
}

/// # Errors
/// Exit 3 when no file holds a scene.
fn scenes(args: &SceneArgs) -> Result<Vec<scene::Scene>, Failure> {
    let unreadable = |error: anyhow::Error| Failure::new(Exit::Input, format!("{error:#}"));
    let files = lab_train::scenes::scene_files(&patterns(&args.inputs)?).map_err(unreadable)?;
    let read = files.iter().take(args.scenes).map(|file| lab_train::scenes::read_scenes(file));
    let scenes: Vec<scene::Scene> = read.filter_map(Result::ok).flatten().collect();
    if scenes.is_empty() {
        return Err(Failure::new(Exit::Input, "no file holds a scene that can be read"));
    }
    Ok(scenes)
}

/// A failure with the whole chain of its causes.
fn failed(error: impl Into<anyhow::Error>) -> Failure {
    Failure::new(Exit::Failure, format!("{:#}", error.into()))
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(failed)?;
    output::print(format!("{text}\n").as_bytes())
}
