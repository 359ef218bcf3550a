//! A run: the chunks of a plan that are not there yet, unit after unit, each chunk written when it is whole.

use super::BatchRunArgs;
use super::folder::BatchFolder;
use super::record::BatchRecord;
use super::scenes::{self, Selectors};
use super::tally::OutcomeTally;
use super::worker::{UnitEnd, UnitWorker};
use crate::base::clock;
use crate::cli::progress::Progress;
use crate::cli::score::figures::{self, FigureFilter};
use crate::cli::{Common, Failure, output, parallel};
use batch::chunk::{self, BatchChunk};
use batch::fault::PlanFault;
use batch::plan::BatchPlan;
use batch::row;
use batch::shard::BatchShard;
use batch::unit::UnitList;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Works on the chunks of one share that are not there.
///
/// # Errors
/// Exit 1 when a chunk is there with other bytes, 3 for a plan or an input that cannot be read, 7, and 8 for a folder of
/// another batch.
pub fn run(args: &BatchRunArgs, common: &Common) -> Result<(), Failure> {
    let (Some(path), Some(output)) = (&args.plan, &args.output) else {
        return Err(Failure::usage("a plan and --output expected"));
    };
    let shard = share(args.shard, common)?;
    let workers = args.jobs.map_or_else(parallel::cores, usize::from);
    let (plan, selectors) = read_plan(path)?;
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
            let scenes = scenes::read(&plan, &selectors, base, &folder, workers, common)?;
            let record = BatchRecord::new(&plan, engine, scenes);
            record.write(&folder)?;
            record
        }
    };
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let worker = UnitWorker::new(&folder, &record, &list, &operations)?;
    let mut open: Vec<OpenChunk> = Vec::new();
    let mut all = 0;
    let chunks = chunk::chunks(list.len(), record.plan.chunk_units).filter(|chunk| shard.has(chunk.number));
    for (chunk, name, is_there) in folder.look_up(chunks, &list) {
        all += 1;
        if !is_there {
            open.push(OpenChunk { chunk, name, taken: OnceLock::new() });
        }
    }
    common.say(&format!("{} units; {} of {all} chunks to do", list.len(), open.len()));
    let began = clock::monotonic();
    let tally = work(&open, &folder, &worker, workers, common)?;
    folder.sweep()?;
    let spent = clock::monotonic().saturating_sub(began);
    if tally.units() > 0 {
        common.say(&summary(&tally, spent, worker.engine_time(), workers));
    }
    common.say(&format!("the results are in {}; dragtraffic batch merge makes the tables", folder.shown()));
    Ok(())
}

/// A chunk that was not there when the run began.
struct OpenChunk {
    chunk: BatchChunk,
    name: String,
    /// Another process has made it since.
    taken: OnceLock<bool>,
}

fn work(
    open: &[OpenChunk],
    folder: &BatchFolder,
    worker: &UnitWorker<'_>,
    workers: usize,
    common: &Common,
) -> Result<OutcomeTally, Failure> {
    let units: Vec<(&OpenChunk, u64)> =
        open.iter().flat_map(|open| open.chunk.units.clone().map(move |number| (open, number))).collect();
    let progress = Progress::new("units", units.len() as u64, common.quiet);
    let stopped = AtomicBool::new(false);
    let make = |(open, number): &(&OpenChunk, u64)| {
        if stopped.load(Ordering::Relaxed) || *open.taken.get_or_init(|| folder.has(&open.name)) {
            return None;
        }
        Some(worker.end(*number))
    };
    let (mut rows, mut lines) = (Vec::new(), String::new());
    let (mut tally, mut failure) = (OutcomeTally::default(), None);
    parallel::in_order(&units, workers, make, |(open, number), end| {
        progress.step();
        if failure.is_some() {
            return;
        }
        let put = match end {
            None => Ok(()),
            Some(Err(error)) => Err(error),
            Some(Ok(UnitEnd { row, line })) => {
                tally.add(&row);
                rows.push(row);
                lines.extend(line);
                if number + 1 == open.chunk.units.end {
                    let table = row::table(&std::mem::take(&mut rows), figures::names());
                    let lines = std::mem::take(&mut lines);
                    table
                        .map_err(Failure::from)
                        .and_then(|table| folder.put(&open.name, &table, lines.as_bytes()))
                } else {
                    Ok(())
                }
            }
        };
        if let Err(error) = put {
            stopped.store(true, Ordering::Relaxed);
            failure = Some(error);
        }
    });
    match failure {
        Some(failure) => Err(failure),
        None => Ok(tally),
    }
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

/// The share of this process: of the flag, else of the cluster.
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

/// Reads a plan with the selectors of its situations, and checks what the engine has a say in.
fn read_plan(path: &Path) -> Result<(BatchPlan, Selectors), Failure> {
    let refused = |faults: Vec<PlanFault>| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("{}: {fault}", path.display())).collect();
        Failure::input(lines.join("\n  "))
    };
    let bytes = output::read(path)?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Failure::input(format!("{}: this is no text in UTF-8", path.display())))?;
    let plan = BatchPlan::parse(&text).map_err(refused)?;
    let selectors = scenes::selectors(&plan);
    let filter = plan.filter.as_deref().map(FigureFilter::parse);
    let wrong = filter.and_then(Result::err).map(|reason| PlanFault::new("where", reason));
    match (selectors, wrong) {
        (Ok(selectors), None) => Ok((plan, selectors)),
        (selectors, wrong) => Err(refused(selectors.err().into_iter().flatten().chain(wrong).collect())),
    }
}
