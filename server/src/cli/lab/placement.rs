//! `dragtraffic lab train-placement`, `eval-placement` and `eval-filled`.

use super::{SceneArgs, failed, print_json, scenes};
use crate::cli::inputs::patterns;
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, output};
use clap::Args;
use std::path::PathBuf;

/// Flags of `train-placement`.
#[derive(Args, Clone, Debug)]
pub struct TrainPlacementArgs {
    /// Files, folders or patterns of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Weights file to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
    /// Description of the data for the header of the weights. Default: the description in the scenes.
    #[arg(long, value_name = "TEXT")]
    trained_on: Option<String>,
}

/// Flags of `eval-placement`.
#[derive(Args, Clone, Debug)]
pub struct EvalPlacementArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Radius of the region around the ego, m.
    #[arg(long, value_name = "METRES", default_value_t = 60.0)]
    radius: f64,
    /// Placements per scene.
    #[arg(long, value_name = "N", default_value_t = 4)]
    seeds: u64,
    /// Print JSON instead of Markdown.
    #[arg(long)]
    json: bool,
}

/// Flags of `eval-filled`.
#[derive(Args, Clone, Debug)]
pub struct EvalFilledArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Number of filled scenes; templates and maps take turns.
    #[arg(long, value_name = "N", default_value_t = 200)]
    draws: u64,
    /// List each fault with its road users.
    #[arg(long)]
    list: bool,
}

/// Learns the placement weights.
///
/// # Errors
/// Exit 1 when nothing can be read, 8 when the output exists.
pub fn train_placement(args: TrainPlacementArgs, common: &Common) -> Result<(), Failure> {
    output::keep(&args.output, args.force)?;
    let options = lab_train::placement::PlacementOptions {
        inputs: patterns(&args.inputs)?,
        trained_on: args.trained_on,
    };
    // The work itself reports folders that cannot be listed.
    let files = lab_train::scenes::scene_files(&options.inputs).map_or(0, |files| files.len());
    let bar = Progress::new("files", files as u64, common.quiet);
    let progress = |summary: &lab_train::placement::PlacementSummary| bar.reach(summary.files as u64);
    let (model, summary) = lab_train::placement::run(&options, progress).map_err(failed)?;
    drop(bar);
    let bytes = model.save().map_err(failed)?;
    output::write(Some(&args.output), &bytes, args.force)?;
    print_json(&summary)
}

/// Compares placed road users with recorded ones.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn eval_placement(args: EvalPlacementArgs, common: &Common) -> Result<(), Failure> {
    let scenes = scenes(&args.scenes)?;
    let placer = common.engine()?.placer;
    let options = lab_eval::placement::EvalPlaceOptions { radius_m: args.radius, seeds: args.seeds };
    let report = lab_eval::placement::eval(&placer, &scenes, options).map_err(failed)?;
    if args.json {
        print_json(&report)
    } else {
        output::print(lab_eval::placement::markdown(&report).as_bytes())
    }
}

/// Fills templates and the maps of scenes, generates them and prints their faults.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn eval_filled(args: EvalFilledArgs, common: &Common) -> Result<(), Failure> {
    let maps = lab_eval::filled::maps(&scenes(&args.scenes)?).map_err(failed)?;
    let all = lab_eval::filled::eval(&common.engine()?, &maps, args.draws).map_err(failed)?;
    output::print(lab_eval::filled::markdown(&all, args.list).as_bytes())
}
