//! Training and evaluation of experts: the only folder that depends on the lab. One file per command or pair
//! of commands.

mod crowd_bench;
mod eval;
mod http_bench;
mod placement;
mod prepare;
mod reproduce;
mod run_bench;
mod served;
mod statistics;
mod synthesize;
mod train;

use super::inputs::patterns;
use super::{Common, Exit, Failure, output};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// The commands that train and evaluate experts.
#[derive(Subcommand)]
pub enum LabCommand {
    /// Simulate training windows on procedural networks, with SUMO.
    #[command(after_help = examples!("dragtraffic lab synthesize --seed 0 --count 8 --per-seed 20 -o windows/", "dragtraffic lab synthesize --seed 900 --count 8 --sumo-home /opt/sumo -o held-out/"))]
    Synthesize(synthesize::SynthesizeArgs),
    /// Compare the statistics of sets of scenes.
    #[command(after_help = examples!("dragtraffic lab statistics synthetic=windows/ recorded=recordings/", "dragtraffic lab statistics recorded=recordings/ --json --most 50"))]
    Statistics(statistics::StatisticsArgs),
    /// Make training records from scenes.
    #[command(after_help = examples!("dragtraffic lab prepare windows/ --expert vehicle -o vehicle.records", "dragtraffic lab prepare recordings/ --expert cyclist --crop 120 --least-agents 32 --mirror -o cyclist.records"))]
    Prepare(prepare::PrepareArgs),
    /// Train an expert.
    #[command(after_help = examples!("dragtraffic lab train vehicle.records --expert vehicle --stage initializer --steps 20000 -o v1.safetensors", "dragtraffic lab train vehicle.records --expert vehicle --stage joint --steps 1200 --init v1.safetensors -o vehicle.safetensors"))]
    Train(train::TrainArgs),
    /// Learn the placement weights from scenes.
    #[command(after_help = examples!("dragtraffic lab train-placement windows/ -o placement.json", "dragtraffic lab train-placement windows/ --trained-on \"Synthetic traffic, seeds 0 to 99\" -o placement.json"))]
    TrainPlacement(placement::TrainPlacementArgs),
    /// Evaluate the placement on recorded scenes.
    #[command(after_help = examples!("dragtraffic lab eval-placement recordings/", "dragtraffic lab eval-placement recordings/ --radius 80 --seeds 8 --json"))]
    #[command(alias = "eval-place")]
    EvalPlacement(placement::EvalPlacementArgs),
    /// Evaluate filled scenes: road users placed on templates and on the maps of scenes, generated together.
    #[command(after_help = examples!("dragtraffic lab eval-filled assets/scenes/", "dragtraffic lab eval-filled assets/scenes/ --draws 52 --list"))]
    EvalFilled(placement::EvalFilledArgs),
    /// Evaluate the experts on scenes, in tables and pictures.
    #[command(after_help = examples!("dragtraffic lab eval recordings/ --tables 1,2 -o tables/", "dragtraffic lab eval recordings/ --tables 1,2,4 --baseline TrafficGen=trafficgen.safetensors -o tables/"))]
    Eval(eval::EvalArgs),
    /// Reproduce the tables and the figure of the paper on recordings.
    #[command(after_help = examples!("dragtraffic lab reproduce recordings/ --quick -o paper/", "dragtraffic lab reproduce training_20s/ --test validation/ --condition-width 1024 -o paper/"))]
    Reproduce(reproduce::ReproduceArgs),
    /// Measure the response times of drags and of whole scenes.
    #[command(after_help = examples!("dragtraffic lab bench recordings/", "dragtraffic lab bench assets/scenes/demo-crossing.json --steps"))]
    Bench(eval::BenchArgs),
}

impl LabCommand {
    /// Training ends with a checkpoint, by itself or for the paper's tables.
    pub fn ends_by_itself(&self) -> bool {
        matches!(self, Self::Train(_) | Self::Reproduce(_))
    }

    /// Runs the command.
    ///
    /// # Errors
    /// Those of the command.
    pub fn run(self, common: &Common) -> Result<(), Failure> {
        look_at_scenes_side_by_side();
        match self {
            Self::Synthesize(args) => synthesize::synthesize(args, common),
            Self::Statistics(args) => statistics::statistics(args),
            Self::Prepare(args) => prepare::prepare(args, common),
            Self::Train(args) => train::train(args, common),
            Self::TrainPlacement(args) => placement::train_placement(args, common),
            Self::EvalPlacement(args) => placement::eval_placement(args, common),
            Self::EvalFilled(args) => placement::eval_filled(args, common),
            Self::Eval(args) => eval::eval(args, common),
            Self::Reproduce(args) => reproduce::reproduce(args, common),
            Self::Bench(args) => eval::bench(args, common),
        }
    }
}

/// Starts the threads over which the lab splits scenes and files, one per core. The program's own setting
/// (`RAYON_NUM_THREADS`) is for matrix products. Results keep the order of their inputs.
fn look_at_scenes_side_by_side() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    // Fails only if such threads exist already.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
}

/// Scenes to look at.
#[derive(Args, Clone, Debug)]
struct SceneArgs {
    /// Files, folders or patterns of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Maximum number of files, in the order of their names.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    scenes: usize,
}

/// Reads the scenes.
///
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
