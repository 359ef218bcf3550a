//! `batch merge`: the tables of the whole batch, of all kept cases or of the best of each bucket.

use super::folder::BatchFolder;
use super::inspect::DoneChunks;
use super::record::BatchRecord;
use super::tally::OutcomeTally;
use crate::cli::score::figures;
use crate::cli::values::whole;
use crate::cli::{Common, Failure, output};
use batch::case::likeness::{self, CaseDigest};
use batch::case::motion::CaseMotion;
use batch::row::{self, BatchRow, UnitOutcome};
use batch::unit::UnitList;
use clap::Args;
use serde_json::json;
use std::collections::BTreeMap;
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
/// Distance of the actor from its recording.
const OFF_LOG: &str = "actor.ade_m";

/// Flags of `batch merge`.
#[derive(Args, Clone, Debug)]
pub struct MergeArgs {
    /// Folder of the results.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// List at most N cases of each bucket, the hardest and the most realistic in turn, and no near copies.
    #[arg(long, value_name = "N", value_parser = whole(1, 1_000_000))]
    per_bucket: Option<u64>,
}

/// The kept cases of a batch.
#[derive(Default)]
struct KeptCases {
    rows: Vec<BatchRow>,
    lines: Vec<String>,
    digests: Vec<CaseDigest>,
}

/// Writes the tables of the whole batch.
///
/// # Errors
/// Exit 1 when one cannot be written, 3.
pub fn merge(args: &MergeArgs, common: &Common) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list);
    let (mut tally, mut kept) = (OutcomeTally::default(), KeptCases::default());
    for (_, name) in &chunks.done {
        kept.add(&folder, name, &mut tally)?;
    }
    let copies = likeness::near_copies(&kept.digests);
    let (cases, distinct) = (kept.rows.len(), copies.iter().filter(|copy| copy.is_none()).count());
    let codes: Vec<Option<String>> = kept.rows.iter().map(|row| row.code.clone()).collect();
    let mut copies_of: Vec<Option<String>> =
        copies.iter().map(|copy| copy.and_then(|of| codes.get(of).cloned().flatten())).collect();
    if let Some(most) = args.per_bucket {
        let best = likeness::best_of_buckets(&kept.digests, &copies, most as usize);
        kept.retain(|i| best.contains(&i));
        copies_of = vec![None; kept.rows.len()];
    }
    let listed = kept.rows.len();
    let names: Vec<&String> = chunks.done.iter().map(|(_, name)| name).collect();
    let manifest = json!({
        "format": "dragtraffic.batch-manifest", "version": 1,
        "complete": chunks.done.len() as u64 == chunks.all,
        "units": list.len(), "units_done": tally.units(), "cases": cases, "distinct": distinct,
        "per_bucket": args.per_bucket, "listed": listed, "tally": tally, "chunks": names,
    });
    let table = row::case_table(&kept.rows, copies_of, figures::names())?;
    output::write(Some(&folder.at("cases.jsonl")), kept.lines.concat().as_bytes(), true)?;
    output::write(Some(&folder.at("cases.parquet")), &table, true)?;
    output::write(Some(&folder.at("manifest.json")), format!("{manifest:#}\n").as_bytes(), true)?;
    let of = if listed == cases { String::new() } else { format!("{listed} of ") };
    let (units, table) = (tally.units(), folder.at("cases.parquet"));
    common.say(&format!(
        "{of}{cases} cases of {units} units, {distinct} without near copies: {}",
        table.display()
    ));
    Ok(())
}

impl KeptCases {
    fn add(&mut self, folder: &BatchFolder, chunk: &str, tally: &mut OutcomeTally) -> Result<(), Failure> {
        let rows = folder.rows(chunk)?;
        rows.iter().for_each(|row| tally.add(row));
        let bytes = output::read(&folder.cases(chunk))?;
        self.lines.extend(String::from_utf8_lossy(&bytes).split_inclusive('\n').map(str::to_owned));
        let motions = output::read(&folder.motions(chunk))?;
        let motions =
            motions.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok());
        let mut relative: BTreeMap<String, Vec<Option<[i32; 2]>>> =
            motions.map(|CaseMotion { unit, relative, .. }| (unit, relative)).collect();
        for row in rows.into_iter().filter(|row| row.outcome == UnitOutcome::Kept) {
            let figure = |name: &str| row.figures.get(name).copied().unwrap_or(0.0);
            self.digests.push(CaseDigest {
                situation: row.situation.clone(),
                facts: row.facts.clone(),
                relative: relative.remove(&row.unit).unwrap_or_default(),
                faults: FAULTS.iter().map(|name| figure(name)).sum(),
                off_log_m: figure(OFF_LOG),
            });
            self.rows.push(row);
        }
        Ok(())
    }

    /// Leaves those at the places that are wanted.
    fn retain(&mut self, is_wanted: impl Fn(usize) -> bool) {
        let mut at = 0..;
        self.rows.retain(|_| at.next().is_some_and(&is_wanted));
        at = 0..;
        self.lines.retain(|_| at.next().is_some_and(&is_wanted));
        at = 0..;
        self.digests.retain(|_| at.next().is_some_and(&is_wanted));
    }
}
