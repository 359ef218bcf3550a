//! A run: makes the missing chunks of a plan, and writes each one when it is complete.

use super::BatchRunArgs;
use super::folder::BatchFolder;
use super::record::BatchRecord;
use super::scenes::PlanInputs;
use super::searching;
use super::tally::OutcomeTally;
use super::work::{ChunkWork, OpenChunk};
use super::worker::UnitWorker;
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, output, parallel};
use base::clock;
use batch::fault::PlanFault;
use batch::plan::BatchPlan;
use batch::shard::BatchShard;
use batch::unit::UnitList;
use std::path::Path;
use std::time::Duration;

/// Makes the missing chunks of one share.
///
/// # Errors
/// Exit 1 when a chunk exists with other bytes, 3 for a plan or an input that cannot be read, 7, and 8 for a
/// folder of another batch.
pub fn run(args: &BatchRunArgs, common: &Common) -> Result<(), Failure> {
    let (Some(path), Some(output)) = (&args.plan, &args.output) else {
        return Err(Failure::usage("a plan and --output expected"));
    };
    let shard = share(args.shard, common)?;
    let workers = args.jobs.map_or_else(parallel::cores, usize::from);
    let plan = read_plan(path)?;
    let folder = BatchFolder::new(output)?;
    let operations = common.operations_on(1)?;
    let engine = operations.generator.hashes();
    let record = match BatchRecord::read(&folder)? {
        Some(record) => {
            record.check(&folder, Some(&plan), &engine)?;
            record
        }
        None => {
            let base = path.parent().unwrap_or(Path::new(""));
            let inputs = PlanInputs { plan: &plan, base, folder: &folder, operations: &operations };
            let record = BatchRecord::new(&plan, engine, inputs.read(workers, common)?);
            record.write(&folder)?;
            record
        }
    };
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let worker = UnitWorker::new(&folder, &record, &operations);
    let (mut chunks, mut all, mut due, mut units) = (Vec::new(), 0, 0, 0);
    let of_share = list.chunks().filter(|chunk| shard.has(chunk.share));
    for (chunk, name, is_there) in folder.look_up(of_share, &list)? {
        all += 1;
        if !is_there {
            due += 1;
            units += chunk.units.end - chunk.units.start;
        }
        if !is_there || list.is_searched() {
            chunks.push(OpenChunk::new(chunk, name, is_there));
        }
    }
    common.say(&format!("{} units; {due} of {all} chunks to do", list.len()));
    let began = clock::monotonic();
    let progress = Progress::new("units", units, common.quiet);
    let mut work = ChunkWork::new(&folder, &worker, workers, progress);
    if list.is_searched() {
        searching::work(&mut work, &folder, &list, &chunks)?;
    } else {
        work.make(&chunks, &|number| list.unit(number))?;
    }
    let tally = work.tally();
    folder.sweep_all()?;
    let spent = clock::monotonic().saturating_sub(began);
    if tally.units() > 0 {
        common.say(&summary(&tally, spent, worker.engine_time(), workers));
    }
    common.say(&format!("the results are in {}; dragtraffic batch merge makes the tables", folder.shown()));
    Ok(())
}

fn summary(tally: &OutcomeTally, spent: Duration, engine: Duration, workers: usize) -> String {
    let seconds = spent.as_secs_f64().max(1e-3);
    let rate = tally.units() as f64 / seconds;
    let share = 100.0 * engine.as_secs_f64() / (seconds * workers as f64);
    format!(
        "{} units in {seconds:.1} s ({rate:.1} a second; engine {share:.0} % of {workers} threads): {}",
        tally.units(),
        tally.words()
    )
}

/// The share of this process: from the flag, else from the cluster.
fn share(flag: Option<BatchShard>, common: &Common) -> Result<BatchShard, Failure> {
    if let Some(shard) = flag {
        return Ok(shard);
    }
    let found = BatchShard::of_environment(|name| std::env::var(name).ok()).map_err(Failure::usage)?;
    if let Some(shard) = found {
        common.say(&format!("shard {} by the environment", shard.words()));
    }
    Ok(found.unwrap_or_default())
}

/// Reads a plan.
fn read_plan(path: &Path) -> Result<BatchPlan, Failure> {
    let refused = |faults: Vec<PlanFault>| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("{}: {fault}", path.display())).collect();
        Failure::input(lines.join("\n  "))
    };
    let text = output::read_text(path)?;
    let base = path.parent().unwrap_or(Path::new(""));
    let file = |name: &str| output::read_text(&base.join(name)).map_err(|failure| failure.message);
    BatchPlan::parse_with(&text, &file).map_err(refused)
}
