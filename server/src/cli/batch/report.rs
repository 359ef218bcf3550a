//! `batch report`: writes the coverage of the results as a table, `coverage.json` and a page of the cases.

use super::folder::BatchFolder;
use super::inspect::DoneChunks;
use super::page::{self, CasePage, PageCase, PageScene};
use super::record::BatchRecord;
use crate::cli::progress::Progress;
use crate::cli::values::whole;
use crate::cli::{Common, Failure, output, parallel};
use batch::case::facts::{self, RecordedFacts};
use batch::coverage::document::CoverageDocument;
use batch::coverage::table::CoverageTable;
use batch::figures::{FigureFilter, Figures};
use batch::row::{BatchRow, UnitOutcome};
use batch::unit::UnitList;
use clap::Args;
use scene::score::Drivable;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Flags of `batch report`.
#[derive(Args, Clone, Debug)]
pub struct ReportArgs {
    /// Folder of the results, or its URL in an object store.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of kept results from which a bucket is full.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = whole(1, 1_000_000))]
    full: u64,
    /// Most cases on the page; if there are more, those with the least times to collision are shown.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = whole(1, 100_000))]
    cases: u64,
}

/// The page of the cases.
const PAGE: &str = "index.html";

/// Sort key that decides which cases beyond the limit are left out: the bits of the time to collision, which
/// are monotonic in it, then the index of the row.
type CaseOrder = (u64, usize, usize);

/// Writes the report of a folder.
///
/// # Errors
/// Exit 1 when a file cannot be written, 3 for a folder without results, or with a table that cannot be read.
pub fn report(args: &ReportArgs, common: &Common) -> Result<(), Failure> {
    let folder = BatchFolder::new(&args.folder)?;
    let record = BatchRecord::of(&folder)?;
    let list = UnitList::new(&record.plan, &record.scenes, &record.engine);
    let chunks = DoneChunks::of(&folder, &list)?;
    let filter = record.plan.filter.as_deref().map(FigureFilter::parse).transpose();
    let filter = filter.map_err(|reason| Failure::input(format!("where: {reason}")))?;
    let conditions = filter.map_or_else(Vec::new, |filter| filter.parts());
    let situations: Vec<String> = record.plan.situations.iter().map(|of| of.name().to_owned()).collect();
    let mut table = CoverageTable::new(&situations);

    let (mut shown, mut units, mut kept) = (BTreeMap::<CaseOrder, PageCase>::new(), 0u64, 0u64);
    let progress = Progress::new("chunks", chunks.done.len() as u64, common.quiet);
    let rows = |(_, name): &(_, String)| folder.rows(name);
    let mut failure = None;
    parallel::in_order(&chunks.done, parallel::cores(), rows, |(chunk, _), rows| {
        progress.step();
        let rows = rows.unwrap_or_else(|error| {
            failure.get_or_insert(error);
            Vec::new()
        });
        for (at, row) in rows.into_iter().enumerate() {
            units += 1;
            count(&mut table, &row, &conditions);
            if row.outcome == UnitOutcome::Kept {
                kept += 1;
                let ttc_s = row.facts.numbers.get("ttc_s").map_or(f64::INFINITY, |ttc_s| ttc_s.max(0.0));
                let order = (ttc_s.to_bits(), chunk.number as usize, at);
                shown.insert(order, PageCase::of(row, &table.dimensions));
                if shown.len() as u64 > args.cases {
                    shown.pop_last();
                }
            }
        }
    });
    if let Some(failure) = failure {
        return Err(failure);
    }
    let mut cases: Vec<(CaseOrder, PageCase)> = shown.into_iter().collect();
    cases.sort_by_key(|((_, chunk, at), _)| (*chunk, *at));
    let cases: Vec<PageCase> = cases.into_iter().map(|(_, case)| case).collect();
    let scenes = recorded(&folder, &record, &mut table, &cases, common)?;
    let motions = motions(&folder, &chunks, &cases)?;

    let complete = chunks.done.len() as u64 == chunks.all;
    let conditions = conditions.iter().map(|condition| condition.text().to_owned()).collect();
    let coverage = CoverageDocument::new(&table, conditions, args.full, complete);
    let mut json = serde_json::to_vec_pretty(&coverage).unwrap_or_default();
    json.push(b'\n');
    folder.write("coverage.json", &json)?;
    let page = CasePage { units, kept, cases, motions, scenes, coverage: &coverage, table: &table };
    folder.write(PAGE, &page.bytes())?;
    common.say(&format!("{kept} cases of {units} units: {}", folder.shown_at(PAGE)));
    output::print(coverage.text().as_bytes())
}

/// Counts a row; a row without a result is not counted.
fn count(table: &mut CoverageTable, row: &BatchRow, conditions: &[FigureFilter]) {
    match row.outcome {
        UnitOutcome::Kept => table.add_kept(&row.situation, &row.facts),
        UnitOutcome::LeftOut => {
            let figures = Figures::of_row(row.figures.clone());
            let missed = conditions.iter().enumerate().filter(|(_, condition)| !condition.holds(&figures));
            let missed: Vec<usize> = missed.map(|(i, _)| i).collect();
            table.add_left_out(&row.situation, &row.facts, &missed);
        }
        UnitOutcome::NobodyFits | UnitOutcome::Failed => {}
    }
}

/// Counts the scenes as recorded, and returns the maps of those with a case on the page, by hash.
fn recorded(
    folder: &BatchFolder,
    record: &BatchRecord,
    table: &mut CoverageTable,
    cases: &[PageCase],
    common: &Common,
) -> Result<BTreeMap<String, PageScene>, Failure> {
    let drawn: BTreeSet<&str> = cases.iter().map(|case| case.scene.as_str()).collect();
    let mut once = BTreeSet::new();
    let scenes = record.scenes.iter().filter(|entry| entry.problem.is_none());
    let scenes: Vec<_> = scenes.filter(|entry| once.insert(&entry.sha256)).collect();
    let progress = Progress::new("scenes", scenes.len() as u64, common.quiet);
    let look = |entry: &&_| -> Result<(Vec<RecordedFacts>, Option<PageScene>), Failure> {
        let scene = folder.read_scene(entry)?;
        let page = drawn.contains(entry.sha256.as_str()).then(|| PageScene::of(&entry.name, &scene.map));
        Ok((facts::recorded(&scene, &Drivable::new(&scene.map)), page))
    };
    let (mut pages, mut bytes, mut failure) = (BTreeMap::new(), 0, None);
    parallel::in_order(&scenes, parallel::cores(), look, |entry, found| {
        progress.step();
        match found {
            Ok((found, page)) => {
                found.iter().for_each(|of| table.add_recorded(&of.facts));
                if let Some(page) = page {
                    bytes += page.map.len();
                    let fits = bytes <= page::MOST_MAP_BYTES;
                    pages.insert(entry.sha256.clone(), if fits { page } else { page.without_map() });
                }
            }
            Err(error) => drop(failure.get_or_insert(error)),
        }
    });
    failure.map_or(Ok(pages), Err)
}

/// The motion line of each case; null if it has none.
fn motions(folder: &BatchFolder, chunks: &DoneChunks, cases: &[PageCase]) -> Result<Vec<String>, Failure> {
    let places: BTreeMap<&str, usize> =
        cases.iter().enumerate().map(|(i, case)| (case.unit.as_str(), i)).collect();
    let mut lines = vec!["null".to_owned(); cases.len()];
    for (_, name) in &chunks.done {
        let bytes = folder.read(&BatchFolder::motions(name))?;
        for line in String::from_utf8_lossy(&bytes).lines() {
            // The unit is the first member of a line.
            let place = line.split('"').nth(3).and_then(|unit| places.get(unit));
            if let Some(of) = place.and_then(|i| lines.get_mut(*i)) {
                line.clone_into(of);
            }
        }
    }
    Ok(lines)
}
