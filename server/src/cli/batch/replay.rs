//! `dragtraffic replay`: regenerates results of a batch from their references.

use super::folder::{BatchFolder, not_reproducible};
use super::inspect::DoneChunks;
use super::record::BatchRecord;
use super::searching;
use super::worker::UnitWorker;
use crate::cli::output::{self, Folder};
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, parallel};
use batch::chunk::BatchChunk;
use batch::row::RowName;
use batch::unit::UnitList;
use clap::Args;
use formats::native;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::OnceLock;

/// Fewest digits that identify a unit.
const LEAST_DIGITS: usize = 8;

/// Flags of `replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    /// Folder of the results of a batch, or its URL in an object store.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Results, each by its code or by its unit: the id, or the first 8 digits or more.
    #[arg(value_name = "UNIT", required_unless_present = "kept")]
    units: Vec<String>,
    /// Regenerate all kept results.
    #[arg(long, conflicts_with = "units")]
    kept: bool,
    /// File of the scene, or for several the folder of CODE.json. Default: stdout.
    #[arg(short, long, value_name = "FILE|DIR")]
    output: Option<PathBuf>,
    /// Overwrite files that exist.
    #[arg(long)]
    force: bool,
    /// Print the scene on a terminal too.
    #[arg(long)]
    json: bool,
}

/// A unit to regenerate.
struct Wanted {
    /// Index of its chunk among the existing ones.
    chunk: usize,
    /// Number of the unit.
    number: u64,
    name: RowName,
}

/// Regenerates results.
///
/// # Errors
/// Exit 1 for a result that differs, 2, 3 for a unit that does not exist or has no result, 7, 8.
pub fn replay(args: &ReplayArgs, common: &Common) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list)?;
    let wanted = wanted(args, &folder, &chunks)?;
    let many = match args.output.as_deref() {
        Some(path) if args.kept || args.units.len() > 1 || Folder::named(path) => {
            Some(Folder::new(path, args.force)?)
        }
        Some(path) => output::keep(path, args.force).map(|()| None)?,
        None if wanted.len() > 1 => {
            return Err(Failure::usage(format!("{} results: --output DIR expected", wanted.len())));
        }
        None => None,
    };
    let operations = common.operations_on(1)?;
    record.check(&folder, None, &operations.generator.hashes())?;
    let worker = UnitWorker::new(&folder, &record, &operations);
    // Units of one chunk share the preceding tries.
    let searches: Vec<_> = chunks.done.iter().map(|_| OnceLock::new()).collect();
    let made = |of: &Wanted| -> Result<Vec<u8>, Failure> {
        let missing = || Failure::input(format!("{}: no unit {}", folder.shown(), of.name.unit));
        let (chunk, _) = chunks.done.get(of.chunk).ok_or_else(missing)?;
        let before = || searching::before(&folder, &list, chunk);
        let unit = match searches.get(of.chunk).ok_or_else(missing)?.get_or_init(before) {
            Ok(Some(searches)) => searches.unit(of.number),
            Ok(None) => list.unit(of.number),
            Err(failure) => return Err(failure.clone()),
        };
        let result = worker.result(&unit.ok_or_else(missing)?)?;
        let result = result.filter(|result| Some(&result.code) == of.name.code.as_ref());
        let Some(result) = result else {
            return Err(not_reproducible(&format!("unit {} has another result", of.name.unit)));
        };
        Ok(native::write(&result.scene))
    };
    let progress = Progress::new("results", wanted.len() as u64, common.quiet);
    let mut failure = None;
    parallel::in_order(&wanted, parallel::cores(), made, |of, bytes| {
        progress.step();
        let put = |bytes: Vec<u8>| match &many {
            Some(many) => {
                let code = of.name.code.as_deref().unwrap_or(&of.name.unit);
                many.write(&format!("{code}.json"), &bytes).map(drop)
            }
            None => output::write_scene(args.output.as_deref(), &bytes, args.force, args.json),
        };
        if failure.is_none() {
            failure = bytes.and_then(put).err();
        }
    });
    failure.map_or(Ok(()), Err)
}

/// The named units, or all kept ones, each result once.
fn wanted(args: &ReplayArgs, folder: &BatchFolder, chunks: &DoneChunks) -> Result<Vec<Wanted>, Failure> {
    let mut found: BTreeMap<&str, Vec<Wanted>> = BTreeMap::new();
    let mut kept: BTreeMap<String, Wanted> = BTreeMap::new();
    for (chunk, (BatchChunk { units, .. }, name)) in chunks.done.iter().enumerate() {
        for (number, name) in units.clone().zip(folder.names(name)?) {
            let wanted = |name: RowName| Wanted { chunk, number, name };
            if let (true, true, Some(code)) = (args.kept, name.is_kept, &name.code) {
                kept.entry(code.clone()).or_insert_with(|| wanted(name.clone()));
            }
            for asked in args.units.iter().filter(|asked| is_named(&name, asked)) {
                found.entry(asked).or_default().push(wanted(name.clone()));
            }
        }
    }
    if args.kept {
        let mut all: Vec<Wanted> = kept.into_values().collect();
        all.sort_by_key(|of| (of.chunk, of.number));
        return Ok(all);
    }
    let mut all = Vec::new();
    let asked: BTreeSet<&str> = args.units.iter().map(String::as_str).collect();
    for asked in asked {
        let none = || Failure::input(format!("{}: no unit and no result is named {asked}", folder.shown()));
        let mut named = found.remove(asked).ok_or_else(none)?.into_iter();
        let first = named.next().ok_or_else(none)?;
        if named.any(|other| other.name.code != first.name.code || first.name.code.is_none()) {
            return Err(Failure::usage(format!("{asked}: several units begin so; give more digits")));
        }
        if first.name.code.is_none() {
            let of = &first.name.unit;
            return Err(Failure::input(format!("{}: the unit {of} has no result", folder.shown())));
        }
        all.push(first);
    }
    Ok(all)
}

/// Whether the text is the code of a row, or a prefix of its unit's id.
fn is_named(name: &RowName, asked: &str) -> bool {
    let is_unit = asked.len() >= LEAST_DIGITS && name.unit.starts_with(asked);
    is_unit || name.code.as_deref().is_some_and(|code| code.eq_ignore_ascii_case(asked))
}
