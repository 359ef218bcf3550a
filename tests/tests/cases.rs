//! Cases of a batch: results rebuilt from their references, tables without near copies, coverage, and the
//! page.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::program;
use dragtraffic_tests::scenes::street;
use formats::columnar::{ColumnValue, ParquetTable};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// Two scenes with a cut-in and six road users each, three seeds.
const PLAN: &str = r#"
scenes = ["scenes/*.json"]
seeds = 3
where = "collisions == 0 && actor.min_distance_m < 1.4"
chunk_units = 20
[sampling]
method = "random"
draws = 1
[generate]
horizon_s = 2
steps = 1
[[situations]]
template = "cut-in"
[[situations]]
name = "speeds"
agents = ["@vehicles"]
goal = { ahead_m = { uniform = [5, 30] } }
"#;
/// A name that is markup if it is not escaped.
const NAME: &str = "</script><b>";

/// A folder with a plan, its scenes, and its results in `out`.
fn finished() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("scenes")).unwrap();
    for (name, steps) in [("a.json", 31), ("b.json", 41)] {
        let mut scene = street(6, steps);
        scene["name"] = NAME.into();
        std::fs::write(at("scenes").join(name), scene.to_string()).unwrap();
    }
    std::fs::write(at("plan.toml"), PLAN).unwrap();
    ends(folder.path(), &["batch", "plan.toml", "-o", "out"], 0);
    folder
}

/// Runs the program, checks its exit code, and returns stdout and stderr.
fn ends(folder: &Path, arguments: &[&str], code: i32) -> (Vec<u8>, String) {
    let output = Command::new(program())
        .args(arguments)
        .current_dir(folder)
        .env_remove("SLURM_ARRAY_TASK_ID")
        .env_remove("JOB_COMPLETION_INDEX")
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    (output.stdout, told)
}

/// The texts and whole numbers of some columns, row by row.
fn texts(path: &Path, columns: &[&str]) -> Vec<Vec<Option<String>>> {
    let bytes = std::fs::read(path).unwrap();
    let mut table = ParquetTable::open(&bytes).unwrap();
    let place = |name: &&str| table.names().iter().position(|known| known == name).unwrap();
    let chosen: Vec<usize> = columns.iter().map(place).collect();
    table.choose(chosen).unwrap();
    let mut rows = Vec::new();
    while table.advance().unwrap() {
        let text = |i| match table.value(i) {
            ColumnValue::Text(text) => Some(text.to_owned()),
            ColumnValue::Whole(whole) => Some(whole.to_string()),
            _ => None,
        };
        rows.push((0..columns.len()).map(text).collect());
    }
    rows
}

/// The rows of all chunks.
fn all_rows(out: &Path, columns: &[&str]) -> Vec<Vec<Option<String>>> {
    let files = std::fs::read_dir(out.join("chunks")).unwrap().map(|entry| entry.unwrap().path());
    let mut tables: Vec<_> = files.filter(|path| path.extension().unwrap() == "parquet").collect();
    tables.sort();
    tables.iter().flat_map(|path| texts(path, columns)).collect()
}

#[test]
fn a_result_is_made_again_byte_for_byte() {
    let folder = finished();
    let base = folder.path();
    let rows = all_rows(&base.join("out"), &["situation", "outcome", "code", "unit"]);
    let named = |situation: &str, outcome: &str| {
        let has = |row: &&Vec<Option<String>>| {
            (row[0].as_deref(), row[1].as_deref()) == (Some(situation), Some(outcome))
        };
        let row = rows.iter().find(has).unwrap_or_else(|| panic!("no {outcome} {situation}: {rows:?}"));
        (row[2].clone().unwrap_or_default(), row[3].clone().unwrap())
    };
    let (code, unit) = named("speeds", "kept");
    let (scene, _) = ends(base, &["replay", "out", &code], 0);
    let (again, _) = ends(base, &["replay", "out", &unit[..10]], 0);
    assert_eq!(scene, again, "by the code and by the unit");
    let scene: Value = serde_json::from_slice(&scene).unwrap();
    assert_eq!(scene["generated"]["samples"].as_array().unwrap().len(), 1);
    // A result that the condition left out is a result too.
    let (code, _) = named("speeds", "left-out");
    ends(base, &["replay", "out", &code, "-o", "left.json"], 0);
    ends(base, &["replay", "out", &code, "-o", "left.json"], 8);

    // `generate` with the same template, scene, seed and options makes the same file.
    let columns = ["situation", "code", "name", "seed"];
    let cut_ins: Vec<_> = all_rows(&base.join("out"), &columns)
        .into_iter()
        .filter(|row| row[0].as_deref() == Some("cut-in"))
        .filter_map(|row| Some((row[1].clone()?, row[2].clone()?, row[3].clone()?)))
        .collect();
    assert!(!cut_ins.is_empty());
    for (code, name, seed) in cut_ins {
        let (input, replayed, made) =
            (format!("scenes/{name}.json"), format!("{code}-r.json"), format!("{code}-m.json"));
        ends(base, &["replay", "out", &code, "-o", &replayed], 0);
        let options =
            ["--template", "cut-in", "--horizon", "2", "--steps", "1", "--where", "collisions >= 0"];
        let arguments = [&["generate", &input, "--seed", &seed, "-o", &made], options.as_slice()].concat();
        ends(base, &arguments, 0);
        let read = |name: &str| std::fs::read(base.join(name)).unwrap();
        assert!(read(&replayed) == read(&made), "{code} of {name} is another file");
    }

    ends(base, &["replay", "out", "--kept", "-o", "kept"], 0);
    let kept: BTreeSet<_> =
        rows.iter().filter(|row| row[1].as_deref() == Some("kept")).map(|row| row[2].clone()).collect();
    assert_eq!(std::fs::read_dir(base.join("kept")).unwrap().count(), kept.len());

    let (_, told) = ends(base, &["replay", "out", "NOBODY"], 3);
    assert!(told.contains("out: no unit and no result is named NOBODY"), "{told}");
    ends(base, &["replay", "out"], 2);
    ends(base, &["replay", "scenes", &code], 3);
}

#[test]
fn near_copies_are_marked_and_few_of_a_bucket_are_listed() {
    let folder = finished();
    let base = folder.path();
    ends(base, &["batch", "merge", "out"], 0);
    let manifest = || -> Value {
        serde_json::from_slice(&std::fs::read(base.join("out/manifest.json")).unwrap()).unwrap()
    };
    let cases = texts(&base.join("out/cases.parquet"), &["code", "copy_of"]);
    let copies: Vec<&String> = cases.iter().filter_map(|row| row[1].as_ref()).collect();
    let of_own: BTreeSet<&String> =
        cases.iter().filter(|row| row[1].is_none()).filter_map(|row| row[0].as_ref()).collect();
    assert!(copies.iter().all(|code| of_own.contains(code)), "{cases:?}");
    let all = manifest();
    assert_eq!(all["cases"], cases.len());
    assert_eq!(all["distinct"], cases.len() - copies.len());

    ends(base, &["batch", "merge", "out", "--per-bucket", "1"], 0);
    let columns =
        ["situation", "case.layout", "case.meeting", "case.first", "case.signal", "case.other_type", "code"];
    let listed = texts(&base.join("out/cases.parquet"), &columns);
    let buckets: BTreeSet<_> = listed.iter().map(|row| row[..6].to_vec()).collect();
    assert_eq!(buckets.len(), listed.len(), "one of each bucket: {listed:?}");
    assert!(listed.len() < cases.len(), "{} of {}", listed.len(), cases.len());
    let few = manifest();
    assert_eq!((&few["cases"], &few["listed"]), (&all["cases"], &Value::from(listed.len())));
    let lines = std::fs::read_to_string(base.join("out/cases.jsonl")).unwrap();
    assert_eq!(lines.lines().count(), listed.len());
    let (first, codes) = (lines.lines().next().unwrap(), &listed[0][6]);
    assert!(first.contains(codes.as_deref().unwrap()), "{first}");
}

#[test]
fn the_report_counts_every_result_once_and_is_the_same_again() {
    let folder = finished();
    let base = folder.path();
    let (table, _) = ends(base, &["batch", "report", "out"], 0);
    let read = |name: &str| std::fs::read(base.join("out").join(name)).unwrap();
    let (json, page) = (read("coverage.json"), read("index.html"));
    assert_eq!(ends(base, &["batch", "report", "out"], 0).0, table);
    assert_eq!((read("coverage.json"), read("index.html")), (json.clone(), page.clone()));

    let coverage: Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(coverage["conditions"], serde_json::json!(["collisions == 0", "actor.min_distance_m < 1.4"]));
    let rows = all_rows(&base.join("out"), &["outcome", "case.layout", "situation", "code"]);
    let with = |outcome: &str| rows.iter().filter(|row| row[0].as_deref() == Some(outcome)).count() as u64;
    let (kept, left_out) = (with("kept"), with("left-out"));
    assert!(kept > 0 && left_out > 0, "{kept} kept, {left_out} left out");
    for dimension in coverage["dimensions"].as_array().unwrap() {
        let sum = |member: &str| {
            let buckets = dimension["buckets"].as_array().unwrap().iter();
            buckets.map(|bucket| bucket[member].as_u64().unwrap()).sum::<u64>()
        };
        assert_eq!((sum("kept"), sum("tried")), (kept, kept + left_out), "{}", dimension["name"]);
    }
    // Buckets of the layout are those of the rows.
    let mut layouts: BTreeMap<&str, u64> = BTreeMap::new();
    for row in rows.iter().filter(|row| row[0].as_deref() == Some("kept")) {
        *layouts.entry(row[1].as_deref().unwrap()).or_default() += 1;
    }
    let of_layout =
        coverage["dimensions"].as_array().unwrap().iter().find(|of| of["name"] == "layout").unwrap();
    for bucket in of_layout["buckets"].as_array().unwrap() {
        let count = layouts.get(bucket["name"].as_str().unwrap()).copied().unwrap_or(0);
        assert_eq!(bucket["kept"], count, "{bucket}");
    }
    let states: BTreeSet<&str> = coverage["dimensions"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|of| of["buckets"].as_array().unwrap())
        .map(|bucket| bucket["state"].as_str().unwrap())
        .collect();
    assert!(states.contains("full") && states.contains("never-tried"), "{states:?}");
    let diversity = &coverage["diversity"];
    assert_eq!(diversity["kept"]["cases"], kept);
    // Six road users that move in each of two scenes.
    assert_eq!(diversity["recorded"]["cases"], 12);
    let cells = |of: &str| diversity[of]["cells"].as_u64().unwrap();
    assert_eq!(cells("both"), cells("recorded") + diversity["new_cells"].as_u64().unwrap());

    let page = String::from_utf8(page).unwrap();
    assert!(!page.contains(NAME), "names are no markup");
    let has_code = |row: &&Vec<Option<String>>| page.contains(&format!("\"{}\"", row[3].as_deref().unwrap()));
    assert_eq!(
        rows.iter().filter(|row| row[0].as_deref() == Some("kept")).filter(has_code).count() as u64,
        kept
    );
    assert!(page.contains("default-src 'none'") && !page.contains("src=\"http"), "no network");

    ends(base, &["batch", "report", "out", "--cases", "1", "-q"], 0);
    let page = String::from_utf8(read("index.html")).unwrap();
    let codes = rows.iter().filter_map(|row| row[3].as_deref());
    let shown = codes.filter(|code| page.contains(&format!("\"{code}\""))).count();
    assert_eq!(shown, 1, "the hardest case alone");
    ends(base, &["batch", "report", "scenes"], 3);
}

#[test]
fn an_index_has_a_row_for_each_road_user_that_moves() {
    let folder = finished();
    let base = folder.path();
    std::fs::write(base.join("scenes/broken.json"), "{").unwrap();
    let (_, told) = ends(base, &["index", "scenes", "-o", "index.parquet"], 4);
    assert!(told.contains("broken.json"), "{told}");
    ends(base, &["index", "scenes", "-o", "index.parquet"], 8);
    std::fs::remove_file(base.join("scenes/broken.json")).unwrap();
    let first = std::fs::read(base.join("index.parquet")).unwrap();
    ends(base, &["index", "scenes", "-o", "index.parquet", "--force", "--jobs", "1"], 0);
    assert!(std::fs::read(base.join("index.parquet")).unwrap() == first, "equal scenes, other bytes");
    let mut table = ParquetTable::open(&first).unwrap();
    let at = |name: &str| table.names().iter().position(|known| known == name).unwrap();
    let wanted = ["file", "index", "actor", "case.meeting", "case.driven_m"].map(at);
    table.choose(wanted.to_vec()).unwrap();
    let mut actors = BTreeMap::<String, BTreeSet<String>>::new();
    while table.advance().unwrap() {
        let text = |value| if let ColumnValue::Text(text) = value { text.to_owned() } else { String::new() };
        actors.entry(text(table.value(0))).or_default().insert(text(table.value(2)));
        assert!(matches!(table.value(1), ColumnValue::Whole(0)));
        assert!(!text(table.value(3)).is_empty());
        assert!(matches!(table.value(4), ColumnValue::Number(metres) if metres > 1.0));
    }
    assert_eq!(actors.keys().map(String::as_str).collect::<Vec<_>>(), ["scenes/a.json", "scenes/b.json"]);
    assert!(actors.values().all(|ids| ids.len() == 6), "{actors:?}");
}
