//! `dragtraffic lab prepare`.

use super::{failed, print_json};
use crate::cli::inputs::patterns;
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, output};
use clap::Args;
use lab_train::scenes::Crop;
use scene::AgentType;
use std::path::PathBuf;

/// Flags of `prepare`.
#[derive(Args, Clone, Debug)]
pub struct PrepareArgs {
    /// Files, folders or patterns of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// File of records to write.
    #[arg(short, long)]
    output: PathBuf,
    /// Expert to make records for.
    #[arg(long, value_enum)]
    expert: AgentType,
    /// Seed that draws road users and conditions.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Maximum number of road users per scene.
    #[arg(long, default_value_t = 6)]
    per_scene: usize,
    /// Draws of conditions per moving road user.
    #[arg(long, default_value_t = 2)]
    draws: usize,
    /// Maximum number of records.
    #[arg(long, default_value_t = 200_000)]
    most: u64,
    /// Side of a square around the ego (or the first road user), m; road users outside are left out. The
    /// paper uses 120.
    #[arg(long, value_name = "METRES", value_parser = metres)]
    crop: Option<f64>,
    /// Minimum number of road users at the first step; scenes with fewer are left out. The paper uses 32.
    #[arg(long, value_name = "N", default_value_t = 0)]
    least_agents: usize,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
    /// Add each scene's mirror image, which doubles the records.
    #[arg(long)]
    mirror: bool,
}

fn metres(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(metres) if f64::is_finite(metres) && metres > 0.0 => Ok(metres),
        _ => Err("a length above 0 in metres expected".into()),
    }
}

/// Makes training records.
///
/// # Errors
/// Exit 3 when nothing can be read, 1 when the records cannot be written, 8 when they exist already.
pub fn prepare(args: PrepareArgs, common: &Common) -> Result<(), Failure> {
    output::keep(&args.output, args.force)?;
    let options = lab_train::prepare::PrepareOptions {
        inputs: patterns(&args.inputs)?,
        out: args.output,
        agent_type: args.expert,
        seed: args.seed,
        per_scene: args.per_scene,
        draws: args.draws,
        most_records: args.most,
        crop: Crop { side_m: args.crop, least_agents: args.least_agents },
        mirror: args.mirror,
    };
    // The work itself reports folders that cannot be listed.
    let files = lab_train::scenes::scene_files(&options.inputs).map_or(0, |files| files.len());
    let bar = Progress::new("files", files as u64, common.quiet);
    let progress = |report: &lab_train::prepare::PrepareReport| bar.reach(report.files as u64);
    let report = lab_train::prepare::run(&options, progress).map_err(failed)?;
    drop(bar);
    print_json(&report)
}
