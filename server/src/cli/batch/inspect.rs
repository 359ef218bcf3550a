//! Checks a folder of results: counts its units, or regenerates some of them.

use super::folder::{BatchFolder, not_reproducible};
use super::record::BatchRecord;
use super::searching;
use super::tally::OutcomeTally;
use super::worker::{CaseLines, UnitWorker};
use crate::cli::values::whole;
use crate::cli::{Common, Failure, output, parallel};
use batch::chunk::BatchChunk;
use batch::row::UnitOutcome;
use batch::unit::UnitList;
use clap::Args;
use formats::native::MAX_SAFE_INTEGER;
use scene::random::Key;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Flags of `batch status`.
#[derive(Args, Clone, Debug)]
pub struct StatusArgs {
    /// Folder of the results, or its URL in an object store.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Flags of `batch verify`.
#[derive(Args, Clone, Debug)]
pub struct VerifyArgs {
    /// Folder of the results, or its URL in an object store.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of units to regenerate.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = whole(1, 1_000_000))]
    units: u64,
    /// Seed of the choice of units.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole(0, MAX_SAFE_INTEGER))]
    seed: u64,
}

/// The existing chunks of a folder, and how many there should be.
pub struct DoneChunks {
    /// Existing chunks with their names.
    pub done: Vec<(BatchChunk, String)>,
    /// Number of all chunks.
    pub all: u64,
    /// Numbers of the shares with a missing chunk.
    pub due: BTreeSet<u64>,
}

impl DoneChunks {
    /// The chunks of a folder.
    ///
    /// # Errors
    /// Exit 3 when it cannot be listed.
    pub fn of(folder: &BatchFolder, list: &UnitList<'_>) -> Result<Self, Failure> {
        let (mut done, mut all, mut due) = (Vec::new(), 0, BTreeSet::new());
        for (chunk, name, is_there) in folder.look_up(list.chunks(), list)? {
            all += 1;
            if is_there {
                done.push((chunk, name));
            } else {
                due.insert(chunk.share);
            }
        }
        Ok(Self { done, all, due })
    }
}

/// Prints the progress of a batch.
///
/// # Errors
/// Exit 3 for a folder without results, or with a table that cannot be read.
pub fn status(args: &StatusArgs) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list)?;
    let mut tally = OutcomeTally::default();
    for (_, name) in &chunks.done {
        folder.rows(name)?.iter().for_each(|row| tally.add(row));
    }
    let (done, all, units) = (chunks.done.len(), chunks.all, list.len());
    if args.json {
        let status = json!({
            "scenes": record.scenes.len(), "units": units, "units_done": tally.units(),
            "chunks": all, "chunks_done": done, "shares_due": chunks.due, "tally": tally,
        });
        return output::print(format!("{status:#}\n").as_bytes());
    }
    let mut text = format!("{} of {units} units done, {done} of {all} chunks\n", tally.units());
    for outcome in UnitOutcome::ALL {
        text.push_str(&format!("{:<12} {}\n", outcome.name(), tally.of(outcome)));
    }
    for (code, count) in &tally.problems {
        text.push_str(&format!("  {code} {count}\n"));
    }
    output::print(text.as_bytes())
}

/// Regenerates some units and compares.
///
/// # Errors
/// Exit 1 for a unit that differs, 3, 7, 8.
pub fn verify(args: &VerifyArgs, common: &Common) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let operations = common.operations_on(1)?;
    record.check(&folder, None, &operations.generator.hashes())?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list)?;
    let worker = UnitWorker::new(&folder, &record, &operations);
    let mut by_chunk: BTreeMap<usize, BTreeSet<u64>> = BTreeMap::new();
    for (chunk, unit) in sample(&chunks, args.units, args.seed) {
        by_chunk.entry(chunk).or_default().insert(unit);
    }
    let items: Vec<(usize, BTreeSet<u64>)> = by_chunk.into_iter().collect();
    let check = |(at, units): &(usize, BTreeSet<u64>)| -> Result<usize, Failure> {
        let Some((chunk, name)) = chunks.done.get(*at) else { return Ok(0) };
        let rows = folder.rows(name)?;
        let files = [folder.read(&BatchFolder::cases(name))?, folder.read(&BatchFolder::motions(name))?];
        let texts = files.iter().map(|file| std::str::from_utf8(file).unwrap_or_default());
        let lines: BTreeSet<&str> = texts.flat_map(|text| text.split_inclusive('\n')).collect();
        let searches = searching::before(&folder, &list, chunk)?;
        let missing = |number: &u64| Failure::input(format!("{}: no unit {number}", folder.shown()));
        for number in units {
            let unit = match &searches {
                Some(searches) => searches.unit(*number),
                None => list.unit(*number),
            };
            let end = worker.end(&unit.ok_or_else(|| missing(number))?)?;
            let stored = rows.get((number - chunk.units.start) as usize);
            let listed = end.lines.as_ref().is_none_or(|CaseLines { case, motion }| {
                lines.contains(case.as_str()) && (motion.is_empty() || lines.contains(motion.as_str()))
            });
            if stored != Some(&end.row) || !listed {
                return Err(not_reproducible(&format!("unit {number} of chunk {name} has another result")));
            }
        }
        Ok(units.len())
    };
    let (mut equal, mut failure) = (0, None);
    parallel::in_order(&items, parallel::cores(), check, |_, checked| match checked {
        Ok(count) => equal += count,
        Err(error) => drop(failure.get_or_insert(error)),
    });
    match failure {
        Some(failure) => Err(failure),
        None => output::print(format!("{equal} units made again: all equal\n").as_bytes()),
    }
}

/// A sample of completed units without repetition: index of the chunk among the existing ones, and number of
/// the unit.
fn sample(chunks: &DoneChunks, count: u64, seed: u64) -> BTreeSet<(usize, u64)> {
    let units: Vec<(usize, u64)> = (chunks.done.iter().enumerate())
        .flat_map(|(at, (chunk, _))| chunk.units.clone().map(move |number| (at, number)))
        .collect();
    if count >= units.len() as u64 {
        return units.into_iter().collect();
    }
    let mut stream = Key::default().words(&["batch verify"]).number(seed).stream();
    let mut chosen = BTreeSet::new();
    while (chosen.len() as u64) < count {
        chosen.extend(units.get(stream.below(units.len())).copied());
    }
    chosen
}
