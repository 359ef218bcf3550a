//! Turns all files into sets: records on disk, a list of test cases, and counts.

use super::cut::{cases, cases_at, starts};
use super::interest::{INTERACTIVE_M, interest};
use super::{Centre, Cut, Data, Interest, Part, SetCounts, SetOptions, Sets, Share, TestCase, scenes};
use crate::{Stop, stopped};
use anyhow::{Context, Result};
use lab_train::prepare::{CaseCondition, CaseRecords};
use lab_train::provenance::Provenance;
use lab_train::scenes::place_key;
use lab_train::training::{RecordWriter, is_for_tests, is_held_out};
use rayon::prelude::*;
use scene::random::Key;
use scene::{STEP_S, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Files that are processed at a time.
const CHUNK: usize = 16;
/// Standing road users for training, as a share of the moving ones.
const STANDING_SHARE: f64 = 0.25;
/// Name of the set without conditions; its road users are drawn separately.
const FREE: &str = "vehicle-free";

/// Path of a set's records below a folder.
pub fn records_path(folder: &Path, centre: Centre) -> PathBuf {
    folder.join(format!("records/{}.records", centre.expert()))
}

/// Path of the records of vehicles without conditions.
pub fn free_records_path(folder: &Path) -> PathBuf {
    folder.join(format!("records/{FREE}.records"))
}

/// Counts of one file.
#[derive(Default)]
struct OfFile {
    scenes: usize,
    sources: Provenance,
    seconds: f64,
    intervals: usize,
    shared_places: usize,
    places: BTreeMap<u64, Share>,
    sets: [SetCounts; 3],
    tests: Vec<TestCase>,
    records: Vec<(Centre, CaseRecords)>,
    free: Vec<CaseRecords>,
}

/// Reads all files; writes the records and returns the sets. Places of `test` are never used for training.
///
/// # Errors
/// When nothing can be read, records cannot be written, or the run is stopped.
pub fn make(
    data: &Data,
    options: &SetOptions,
    folder: &Path,
    stop: &Stop,
    progress: &dyn Fn(&str),
) -> Result<Sets> {
    let mut out = Sets::default();
    let mut places = BTreeMap::new();
    let writer = |path: PathBuf, centre: Centre| {
        RecordWriter::create(&path, Provenance::of(centre.judged()))
            .with_context(|| format!("write {}", path.display()))
    };
    let mut writers: Vec<RecordWriter> = Vec::new();
    for centre in Centre::ALL {
        writers.push(writer(records_path(folder, centre), centre)?);
    }
    let mut free = writer(free_records_path(folder), Centre::Ego)?;
    // Tests first: their places must be known before training records are made.
    for part in [Part::Test, Part::Data] {
        let files = data.files(part)?;
        let others: BTreeSet<u64> = places.keys().copied().collect();
        for (chunk, first) in files.chunks(CHUNK).zip((0..).step_by(CHUNK)) {
            stopped(stop)?;
            let found: Vec<OfFile> = chunk
                .par_iter()
                .enumerate()
                .map(|(i, path)| of_file(path, (part, first + i), data, &others, options))
                .collect();
            for file in found {
                out.files += 1;
                out.unreadable += usize::from(file.scenes == 0);
                out.scenes += file.scenes;
                out.sources.merge(&file.sources);
                out.seconds += file.seconds;
                out.intervals += file.intervals;
                out.shared_places += file.shared_places;
                places.extend(file.places);
                out.tests.extend(file.tests);
                for (sum, own) in out.sets.iter_mut().zip(&file.sets) {
                    sum.merge(own);
                }
                for (centre, records) in &file.records {
                    records.write(&mut writers[centre.index()])?;
                }
                for records in &file.free {
                    records.write(&mut free)?;
                }
            }
            let records: usize = out.sets.iter().map(|set| set.records).sum();
            progress(&format!("{} files, {} scenes, {records} records", out.files, out.scenes));
        }
    }
    anyhow::ensure!(out.scenes > 0, "no file holds a scene that can be read");
    places.values().for_each(|share| out.places.add(*share, 1));
    for writer in writers {
        writer.finish()?;
    }
    free.finish()?;
    Ok(out)
}

/// Share of a scene's place; `None` if it may not be used for training.
fn share(scene: &Scene, part: Part, data: &Data, tests: &BTreeSet<u64>) -> (u64, Option<Share>) {
    let key = place_key(scene);
    let share = match part {
        Part::Test => Some(Share::Test),
        Part::Data if tests.contains(&key) => None,
        Part::Data if is_held_out(key) => Some(Share::Validation),
        Part::Data if data.test.is_empty() && is_for_tests(key) => Some(Share::Test),
        Part::Data => Some(Share::Train),
    };
    (key, share)
}

fn of_file(
    path: &Path,
    file: (Part, usize),
    data: &Data,
    tests: &BTreeSet<u64>,
    options: &SetOptions,
) -> OfFile {
    let mut out = OfFile::default();
    for (index, scene) in scenes(path).iter().enumerate() {
        out.scenes += 1;
        out.sources.add(scene);
        out.seconds += scene.time.steps.saturating_sub(1) as f64 * STEP_S;
        let (key, share) = share(scene, file.0, data, tests);
        let Some(share) = share else {
            out.shared_places += 1;
            continue;
        };
        out.intervals += starts(scene, options).count();
        out.places.insert(key, share);
        for centre in Centre::ALL {
            let mut counts = SetCounts::default();
            let cut = cases(scene, centre, options, &mut counts);
            counts.cases.add(share, cut.len());
            for case in &cut {
                if share == Share::Test {
                    counts.judged.add(share, case.judged.len());
                    out.tests.push(test_case(case, centre, file, index));
                } else {
                    let chosen = chosen(case, options);
                    counts.judged.add(share, chosen.len());
                    learn(case, &chosen, centre, options, &mut out);
                    counts.records += out.records.last().map_or(0, |(_, records)| records.count());
                }
            }
            out.sets[centre.index()].merge(&counts);
        }
    }
    out
}

fn test_case(cut: &Cut, centre: Centre, file: (Part, usize), scene: usize) -> TestCase {
    let wanted = cut.is_whole() && centre != Centre::Ego;
    TestCase {
        file,
        scene,
        start: cut.start,
        centre,
        middle: cut.middle.clone(),
        interest: wanted.then(|| interest(&cut.scene, centre.judged())),
    }
}

/// Road users of a case for training: a bounded, random number of moving ones and a quarter as many standing
/// ones, so that whole scenes can be generated too.
fn chosen(cut: &Cut, options: &SetOptions) -> Vec<usize> {
    let middle = cut.middle.as_deref().unwrap_or_default();
    let key = Key::default().number(options.seed).words(&["chosen", &cut.scene.name, middle]);
    let mut draw = key.stream();
    let (mut chosen, mut standing) = (cut.judged.clone(), cut.standing.clone());
    draw.shuffle(&mut chosen);
    chosen.truncate(options.most_vehicles.max(1));
    draw.shuffle(&mut standing);
    let wanted = STANDING_SHARE * chosen.len() as f64;
    standing.truncate(wanted as usize + usize::from(draw.chance(wanted.fract())));
    chosen.extend(standing);
    chosen
}

fn learn(cut: &Cut, chosen: &[usize], centre: Centre, options: &SetOptions, out: &mut OfFile) {
    let asked = CaseCondition::End(options.interval_steps);
    out.records.push((centre, CaseRecords::new(&cut.scene, chosen, asked, options.draws, options.seed)));
    if centre == Centre::Ego {
        out.free.push(CaseRecords::new(&cut.scene, chosen, CaseCondition::Nothing, 1, options.seed));
    }
}

/// The squares of some cases, file by file: `with` gets the index of a case and its cut. The results are in
/// the order of the cases.
///
/// # Errors
/// When a case is missing, `with` fails, or the run is stopped.
pub fn each_case<T: Send>(
    data: &Data,
    options: &SetOptions,
    cases: &[TestCase],
    stop: &Stop,
    progress: &dyn Fn(usize),
    with: impl Fn(usize, &TestCase, Cut) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let mut by_file: BTreeMap<(Part, usize), Vec<usize>> = BTreeMap::new();
    for (i, case) in cases.iter().enumerate() {
        by_file.entry(case.file).or_default().push(i);
    }
    let files = [(Part::Data, data.files(Part::Data)?), (Part::Test, data.files(Part::Test)?)];
    let path = |(part, index): (Part, usize)| {
        let list = files.iter().find(|(own, _)| *own == part).map(|(_, list)| list);
        list.and_then(|list| list.get(index))
            .context("the list of files has changed since the sets were made")
    };
    let mut out: Vec<(usize, T)> = Vec::with_capacity(cases.len());
    let all: Vec<((Part, usize), Vec<usize>)> = by_file.into_iter().collect();
    for chunk in all.chunks(CHUNK) {
        stopped(stop)?;
        let mut jobs = Vec::new();
        for (file, wanted) in chunk {
            let read = scenes(path(*file)?);
            for &i in wanted {
                let case = &cases[i];
                let scene = read.get(case.scene).with_context(|| {
                    format!(
                        "scene {} is no longer in {}",
                        case.scene,
                        path(*file).map_or_else(|_| String::new(), |p| p.display().to_string())
                    )
                })?;
                jobs.push((i, again(scene, case, options)?));
            }
        }
        let done: Result<Vec<(usize, T)>> =
            jobs.into_par_iter().map(|(i, cut)| Ok((i, with(i, &cases[i], cut)?))).collect();
        out.extend(done?);
        progress(out.len());
    }
    out.sort_by_key(|(i, _)| *i);
    Ok(out.into_iter().map(|(_, value)| value).collect())
}

/// Cuts the square of a case again.
fn again(scene: &Scene, case: &TestCase, options: &SetOptions) -> Result<Cut> {
    let mut counts = SetCounts::default();
    let found = cases_at(scene, case.centre, case.start, case.middle.as_deref(), options, &mut counts);
    let found = found.into_iter().next();
    found.with_context(|| {
        format!("{}: the {} square at step {} is no longer there", scene.name, case.centre.name(), case.start)
    })
}

/// The most interactive scenes of a set, up to `most`: one of each interval, each known for the whole 9 s,
/// with a road user of another type near the same place at the same time.
pub fn interactive(sets: &Sets, centre: Centre, most: usize) -> Vec<TestCase> {
    let mut best: BTreeMap<_, (Interest, &TestCase)> = BTreeMap::new();
    for case in sets.tests.iter().filter(|case| case.centre == centre) {
        let Some(own) = case.interest.filter(|interest| interest.nearest_m < INTERACTIVE_M) else { continue };
        let place = best.entry((case.file, case.scene, case.start)).or_insert((own, case));
        if own.order(&place.0).is_lt() {
            *place = (own, case);
        }
    }
    let mut chosen: Vec<(Interest, &TestCase)> = best.into_values().collect();
    chosen.sort_by(|a, b| a.0.order(&b.0));
    chosen.truncate(most);
    chosen.into_iter().map(|(_, case)| case.clone()).collect()
}
