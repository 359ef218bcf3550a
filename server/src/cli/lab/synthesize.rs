//! `dragtraffic lab synthesize`.

use super::failed;
use crate::cli::progress::Progress;
use crate::cli::{Common, Exit, Failure, output};
use clap::Args;
use lab_synthesize::{SynthesizeOptions, Template};
use std::path::PathBuf;

/// Flags of `synthesize`.
#[derive(Args, Clone, Debug)]
pub struct SynthesizeArgs {
    /// Number of seeds; each gives one file.
    #[arg(long, default_value_t = 1)]
    count: u64,
    /// First seed.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Folder to write to; existing files are kept.
    #[arg(short, long)]
    output: PathBuf,
    /// Windows of 9 s cut from the two minutes of each seed.
    #[arg(long, default_value_t = 40)]
    per_seed: usize,
    /// Seeds processed in parallel; 0 means one per core.
    #[arg(long, default_value_t = 0)]
    threads: usize,
    /// Folder of SUMO, with bin/ in it. Default: SUMO_HOME, else PATH.
    #[arg(long, value_name = "DIR")]
    sumo_home: Option<PathBuf>,
    /// Kind of all networks. Default: mixed.
    #[arg(long, value_enum)]
    template: Option<Template>,
}

/// Makes training windows.
///
/// # Errors
/// Exit 1 without SUMO, 4 when some seeds failed.
pub fn synthesize(args: SynthesizeArgs, common: &Common) -> Result<(), Failure> {
    let options = SynthesizeOptions {
        seeds: args.seed..args.seed.saturating_add(args.count),
        out_dir: args.output,
        threads: args.threads,
        sumo_home: args.sumo_home,
        per_seed: args.per_seed,
        template: args.template,
    };
    let bar = Progress::new("seeds", args.count, common.quiet);
    let report = lab_synthesize::run(&options, &|progress| {
        let (done, all) = progress.finished;
        let windows = progress.windows.map_or("there already".into(), |n| format!("{n} windows"));
        bar.line(&format!("seed {}: {windows} ({done} of {all})", progress.seed));
        bar.reach(done);
    })
    .map_err(failed)?;
    drop(bar);
    let [vehicles, pedestrians, cyclists] = report.agents;
    let line = serde_json::json!({
        "written": report.written, "skipped": report.skipped, "windows": report.windows,
        "vehicles": vehicles, "pedestrians": pedestrians, "cyclists": cyclists, "failed": report.failed.len(),
    });
    output::print(format!("{line}\n").as_bytes())?;
    for (seed, reason) in &report.failed {
        output::complain(&format!("seed {seed} failed: {reason}"));
    }
    if report.failed.is_empty() {
        return Ok(());
    }
    Err(Failure::new(Exit::Partly, format!("{} seeds failed", report.failed.len())))
}
