//! `batch merge`: writes the tables of the whole batch, with all kept cases or the best of each bucket.

use super::folder::BatchFolder;
use super::inspect::DoneChunks;
use super::record::BatchRecord;
use super::tally::OutcomeTally;
use crate::cli::values::whole;
use crate::cli::{Common, Failure};
use batch::case::likeness::{self, CaseDigest};
use batch::case::motion::CaseMotion;
use batch::figures;
use batch::row::{self, UnitOutcome};
use batch::unit::UnitList;
use clap::Args;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::PathBuf;

/// Lists and counts of the score whose entries are faults.
const FAULTS: [&str; 9] = [
    "collisions",
    "kinematic.violations",
    "off_road",
    "over_median",
    "wrong_way",
    "red_lights",
    "implausible_turns",
    "harsh_braking",
    "harsh_steering",
];
/// The table of the listed cases.
const TABLE: &str = "cases.parquet";
/// Their references, one per line.
const REFERENCES: &str = "cases.jsonl";
/// Distance of the actor from its recording.
const OFF_LOG: &str = "actor.ade_m";

/// Flags of `batch merge`.
#[derive(Args, Clone, Debug)]
pub struct MergeArgs {
    /// Folder of the results, or its URL in an object store.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// List at most N cases of each bucket, the hardest and the most realistic in turn, and no near copies.
    #[arg(long, value_name = "N", value_parser = whole(1, 1_000_000))]
    per_bucket: Option<u64>,
}

/// Rows in memory at a time, in addition to those of one chunk.
const GROUP_ROWS: usize = 4096;

/// The data by which the kept cases of a batch are compared.
#[derive(Default)]
struct KeptCases {
    tally: OutcomeTally,
    codes: Vec<Option<String>>,
    digests: Vec<CaseDigest>,
}

/// The cases that the tables list.
struct ListedCases<'a> {
    folder: &'a BatchFolder,
    chunks: &'a DoneChunks,
    kept: &'a KeptCases,
    /// For each kept case, the harder one of which it is a near copy.
    copies: Vec<Option<usize>>,
    /// Indices of the listed cases among the kept ones; `None` for all.
    chosen: Option<BTreeSet<usize>>,
}

/// Writes the tables of the whole batch.
///
/// # Errors
/// Exit 1 when a table cannot be written, 3.
pub fn merge(args: &MergeArgs, common: &Common) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list)?;
    let mut kept = KeptCases::default();
    for (_, name) in &chunks.done {
        kept.add(&folder, name)?;
    }
    let copies = likeness::near_copies(&kept.digests);
    let (cases, distinct) = (copies.len(), copies.iter().filter(|copy| copy.is_none()).count());
    let best = |most: u64| likeness::best_of_buckets(&kept.digests, &copies, most as usize);
    let chosen = args.per_bucket.map(best);
    let listed = chosen.as_ref().map_or(cases, BTreeSet::len);
    let lists = ListedCases { folder: &folder, chunks: &chunks, kept: &kept, copies, chosen };
    lists.write_references()?;
    lists.write_table()?;
    let names: Vec<&String> = chunks.done.iter().map(|(_, name)| name).collect();
    let tally = &kept.tally;
    let manifest = json!({
        "format": "dragtraffic.batch-manifest", "version": 1,
        "complete": chunks.done.len() as u64 == chunks.all,
        "units": list.len(), "units_done": tally.units(), "cases": cases, "distinct": distinct,
        "per_bucket": args.per_bucket, "listed": listed, "tally": tally, "chunks": names,
    });
    folder.write("manifest.json", format!("{manifest:#}\n").as_bytes())?;
    let of = if listed == cases { String::new() } else { format!("{listed} of ") };
    let units = tally.units();
    common.say(&format!(
        "{of}{cases} cases of {units} units, {distinct} without near copies: {}",
        folder.shown_at(TABLE)
    ));
    Ok(())
}

impl KeptCases {
    fn add(&mut self, folder: &BatchFolder, chunk: &str) -> Result<(), Failure> {
        let motions = folder.read(&BatchFolder::motions(chunk))?;
        let motions =
            motions.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok());
        let mut relative: BTreeMap<String, Vec<Option<[i32; 2]>>> =
            motions.map(|CaseMotion { unit, relative, .. }| (unit, relative)).collect();
        for row in folder.rows(chunk)? {
            self.tally.add(&row);
            if row.outcome != UnitOutcome::Kept {
                continue;
            }
            let figure = |name: &str| row.figures.get(name).copied().unwrap_or(0.0);
            self.digests.push(CaseDigest {
                faults: FAULTS.iter().map(|name| figure(name)).sum(),
                off_log_m: figure(OFF_LOG),
                relative: relative.remove(&row.unit).unwrap_or_default(),
                situation: row.situation,
                facts: row.facts,
            });
            self.codes.push(row.code);
        }
        Ok(())
    }
}

impl ListedCases<'_> {
    fn has(&self, case: usize) -> bool {
        self.chosen.as_ref().is_none_or(|chosen| chosen.contains(&case))
    }

    /// Writes `cases.jsonl`, chunk by chunk.
    fn write_references(&self) -> Result<(), Failure> {
        let failed = |error: std::io::Error| self.folder.unwritten(REFERENCES, &error);
        let mut file = self.folder.writer(REFERENCES)?;
        let mut case = 0;
        for (_, name) in &self.chunks.done {
            for line in self.folder.read(&BatchFolder::cases(name))?.split_inclusive(|byte| *byte == b'\n') {
                if self.has(case) {
                    file.write_all(line).map_err(failed)?;
                }
                case += 1;
            }
        }
        file.finish().map_err(failed)
    }

    /// Writes `cases.parquet`, one row group after the other.
    fn write_table(&self) -> Result<(), Failure> {
        let (mut chunks, mut case, mut failure) = (self.chunks.done.iter(), 0, None);
        let mut is_first = true;
        let groups = std::iter::from_fn(|| {
            let (mut rows, mut copies) = (Vec::new(), Vec::new());
            while rows.len() < GROUP_ROWS {
                let Some((_, name)) = chunks.next() else { break };
                let of_chunk = self.folder.rows(name).unwrap_or_else(|error| {
                    failure.get_or_insert(error);
                    Vec::new()
                });
                for row in of_chunk.into_iter().filter(|row| row.outcome == UnitOutcome::Kept) {
                    if self.has(case) {
                        let copy = self.copies.get(case).copied().flatten();
                        copies.push(copy.and_then(|of| self.kept.codes.get(of).cloned().flatten()));
                        rows.push(row);
                    }
                    case += 1;
                }
            }
            // A table without cases still has its columns.
            (std::mem::take(&mut is_first) || !rows.is_empty()).then_some((rows, copies))
        });
        let table = row::case_table(groups, figures::names())?;
        failure.map_or(Ok(()), Err)?;
        self.folder.write(TABLE, &table)
    }
}
