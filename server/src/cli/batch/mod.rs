//! `dragtraffic batch`: turns a plan of scenes, situations and seeds into a folder of results. Any number of
//! processes work on its chunks without coordination.

mod cloud;
mod folder;
mod inspect;
mod merge;
mod page;
mod record;
mod replay;
mod report;
mod run;
mod scenes;
mod searching;
mod store;
mod tally;
mod work;
mod worker;

pub use replay::{ReplayArgs, replay};

use super::{Common, Failure};
use batch::shard::BatchShard;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Flags of `batch`.
#[derive(Args, Clone, Debug)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct BatchArgs {
    #[command(subcommand)]
    command: Option<BatchCommand>,
    #[command(flatten)]
    run: BatchRunArgs,
}

/// Flags of a run.
#[derive(Args, Clone, Debug)]
pub struct BatchRunArgs {
    /// Plan of the batch, TOML: scenes, situations, seeds. `dragtraffic schema batch` prints its JSON Schema.
    #[arg(value_name = "PLAN.toml", required = true)]
    plan: Option<PathBuf>,
    /// Folder of the results, or a URL in an object store: s3://, gs://, az://. The same command continues an
    /// interrupted run: existing chunks are not made again.
    #[arg(short, long, value_name = "DIR|URL", required = true)]
    output: Option<PathBuf>,
    /// Work on one of N equal shares of the chunks: I/N, I from 0 to N - 1. Default: the share of a Slurm array
    /// or of an Indexed Job of Kubernetes, else all.
    #[arg(long, value_name = "I/N")]
    shard: Option<BatchShard>,
    /// Units processed in parallel. Default: one per core.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    jobs: Option<u16>,
}

/// Commands on a folder of results.
#[derive(Subcommand, Clone, Debug)]
enum BatchCommand {
    /// Count the units that are done, by outcome.
    #[command(after_help = examples!("dragtraffic batch status out/", "dragtraffic batch status out/ --json"))]
    Status(inspect::StatusArgs),
    /// Regenerate some units and compare them with the results, byte by byte.
    #[command(after_help = examples!("dragtraffic batch verify out/", "dragtraffic batch verify out/ --units 200 --seed 7"))]
    Verify(inspect::VerifyArgs),
    /// Write manifest.json, cases.jsonl and cases.parquet from the existing chunks.
    #[command(after_help = examples!("dragtraffic batch merge out/", "dragtraffic batch merge out/ --per-bucket 5"))]
    Merge(merge::MergeArgs),
    /// Count what the results cover, and write coverage.json and index.html, an offline page of the cases.
    #[command(after_help = examples!("dragtraffic batch report out/", "dragtraffic batch report out/ --full 20 --cases 2000"))]
    Report(report::ReportArgs),
}

/// Runs a plan, or inspects its results.
///
/// # Errors
/// Exit 1 for results that are not reproducible, 2, 3, 7, 8 for a folder of another batch.
pub fn run(args: BatchArgs, common: &Common) -> Result<(), Failure> {
    match args.command {
        None => run::run(&args.run, common),
        Some(BatchCommand::Status(args)) => inspect::status(&args),
        Some(BatchCommand::Verify(args)) => inspect::verify(&args, common),
        Some(BatchCommand::Merge(args)) => merge::merge(&args, common),
        Some(BatchCommand::Report(args)) => report::report(&args, common),
    }
}
