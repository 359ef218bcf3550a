//! Batches: equal results for any threads, shards and interruptions; failures as rows; invalid plans.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use dragtraffic_tests::scenes::street;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;
use tempfile::TempDir;

/// Two scenes and a file that is no scene; 2 x (2 seeds + 6 road users x 2 speeds x 2 seeds) + 1 units.
const PLAN: &str = r#"
scenes = ["scenes/*.json"]
seeds = 2
where = "collisions == 0"
chunk_units = 6
[generate]
horizon_s = 2
steps = 1
[[situations]]
template = "cut-in"
parameters = { takes_s = 2 }
[[situations]]
name = "speeds"
agents = ["@vehicles"]
goal = { ahead_m = 20, speed_mps = { choice = [6, 14] } }
"#;
/// Units of the plan.
const UNITS: u64 = 2 * (2 + 6 * 2 * 2) + 1;

/// A folder with a plan and its scenes.
fn prepared() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("scenes")).unwrap();
    for (name, steps) in [("a.json", 31), ("b.json", 41)] {
        std::fs::write(at("scenes").join(name), street(6, steps).to_string()).unwrap();
    }
    std::fs::write(at("scenes/broken.json"), r#"{"format":"dragtraffic.scene","version":1,"#).unwrap();
    std::fs::write(at("plan.toml"), PLAN).unwrap();
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(program());
    command.arg("batch").args(arguments).current_dir(folder);
    for name in ["SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"] {
        command.env_remove(name);
    }
    command
}

/// Runs the program, checks its exit code, and returns stdout and stderr.
fn ends(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    told(&command(folder, arguments).output().unwrap(), arguments, code)
}

fn told(output: &Output, arguments: &[&str], code: i32) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    (text(&output.stdout), told)
}

/// Every file below a folder with its bytes, including hidden files.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let (mut files, mut folders) = (BTreeMap::new(), vec![folder.to_path_buf()]);
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.insert(path.strip_prefix(folder).unwrap().to_owned(), std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

/// Names of the files that differ, or exist in one tree only.
fn differences(first: &Path, second: &Path) -> Vec<PathBuf> {
    let (first, second) = (tree(first), tree(second));
    let names = first.keys().chain(second.keys());
    names.filter(|name| first.get(*name) != second.get(*name)).cloned().collect()
}

#[test]
fn the_schema_accepts_a_plan_and_refuses_a_slip() {
    let folder = prepared();
    let base = folder.path();
    ends(base, &["plan.toml", "-o", "out", "--shard", "9/10"], 0);
    let schema = std::fs::read_to_string(root().join("assets/schema/batch.v1.schema.json")).unwrap();
    let (schema, record) =
        (json(&schema), json(&std::fs::read_to_string(base.join("out/plan.json")).unwrap()));
    let mut plan = record["plan"].clone();
    // The names of the inputs are not in the results.
    assert_eq!(plan["scenes"], serde_json::json!([]));
    plan["scenes"] = serde_json::json!(["scenes/*.json"]);
    assert!(jsonschema::is_valid(&schema, &plan), "{plan}");
    for (at, wrong) in [("/sampling", "drawz"), ("", "sedes"), ("/situations/1/goal", "sped_mps")] {
        let mut slip = plan.clone();
        slip.pointer_mut(at).unwrap()[wrong] = 1.into();
        assert!(!jsonschema::is_valid(&schema, &slip), "{slip}");
    }
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn threads_and_shards_change_no_byte_and_a_finished_run_does_nothing() {
    let folder = prepared();
    let base = folder.path();
    ends(base, &["plan.toml", "-o", "one", "--jobs", "1"], 0);
    ends(base, &["plan.toml", "-o", "two", "--jobs", "2"], 0);
    assert_eq!(differences(&base.join("one"), &base.join("two")), Vec::<PathBuf>::new());
    // A share by the flag, one by the variables of Slurm, one by those of Kubernetes.
    ends(base, &["plan.toml", "-o", "shards", "--shard", "2/3"], 0);
    let (text, _) = ends(base, &["status", "shards", "--json"], 0);
    let done = json(&text)["units_done"].as_u64().unwrap();
    assert!(done > 0 && done < UNITS, "{text}");
    let variables: [&[(&str, &str)]; 2] = [
        &[("SLURM_ARRAY_TASK_ID", "1"), ("SLURM_ARRAY_TASK_MIN", "1"), ("SLURM_ARRAY_TASK_COUNT", "3")],
        &[("JOB_COMPLETION_INDEX", "1"), ("JOB_COMPLETION_COUNT", "3")],
    ];
    for variables in variables {
        let arguments = ["plan.toml", "-o", "shards"];
        let output = command(base, &arguments).envs(variables.iter().copied()).output().unwrap();
        assert!(told(&output, &arguments, 0).1.contains("by the environment"));
    }
    assert_eq!(differences(&base.join("one"), &base.join("shards")), Vec::<PathBuf>::new());

    let (text, _) = ends(base, &["status", "one", "--json"], 0);
    let status = json(&text);
    let of = |outcome: &str| status["tally"]["outcomes"][outcome].as_u64().unwrap_or(0);
    assert_eq!((status["units"].as_u64(), status["units_done"].as_u64()), (Some(UNITS), Some(UNITS)));
    // The file that is no scene becomes a row.
    assert_eq!(
        (of("failed"), status["tally"]["problems"]["malformed-json"].as_u64()),
        (1, Some(1)),
        "{text}"
    );
    assert!(of("kept") > 0, "{text}");
    let (text, _) = ends(base, &["verify", "one", "--units", "8"], 0);
    assert_eq!(text, "8 units made again: all equal\n");
    let before = tree(&base.join("one"));
    let (_, told) = ends(base, &["plan.toml", "-o", "one"], 0);
    assert!(told.contains(" 0 of ") && tree(&base.join("one")) == before, "{told}");

    ends(base, &["merge", "one"], 0);
    let manifest = json(&std::fs::read_to_string(base.join("one/manifest.json")).unwrap());
    let cases = std::fs::read_to_string(base.join("one/cases.jsonl")).unwrap();
    assert_eq!((&manifest["complete"], manifest["cases"].as_u64()), (&Value::Bool(true), Some(of("kept"))));
    assert_eq!(cases.lines().count() as u64, of("kept"));
    for line in cases.lines() {
        let case = json(line);
        assert!(line.len() < 4_096 && case["figures"]["collisions"] == 0.0, "{line}");
        let scene = format!("one/scenes/{}.json.zst", case["scene"].as_str().unwrap());
        assert!(base.join(scene).is_file(), "{line}");
    }
    // Merging can be repeated.
    let merged = tree(&base.join("one"));
    ends(base, &["merge", "one"], 0);
    assert!(tree(&base.join("one")) == merged);
}

/// The requested conditions of each kept result of a folder, with its draw.
fn conditions(out: &Path) -> Vec<(u64, String, Value)> {
    let files = tree(out).into_iter().filter(|(name, _)| {
        let name = name.to_string_lossy();
        name.ends_with(".jsonl") && !name.ends_with(".motions.jsonl")
    });
    let text: String = files.map(|(_, bytes)| String::from_utf8(bytes).unwrap()).collect();
    let lines = text.lines().map(json);
    lines
        .map(|line| {
            let actor = line["actor"].as_str().unwrap().to_owned();
            (line["draw"].as_u64().unwrap_or(0), actor, line["conditions"].clone())
        })
        .collect()
}

#[test]
fn goals_of_the_recording_are_pushed_and_kinds_are_set() {
    let folder = prepared();
    let base = folder.path();
    let plan = r#"
scenes = ["scenes/a.json"]
[generate]
horizon_s = 3
steps = 1
[[situations]]
name = "pushed"
agents = ["@vehicles"]
goal = { recorded = true, left_m = 1, speed_times = 0.5, time_s = 2, later_s = { choice = [0, 0.5] } }
start = { speed_times = 0.8 }
others = { agents = ["@vehicles"], length_m = 12 }
[[situations]]
name = "on-bicycles"
agents = ["@vehicles"]
type = "cyclist"
length_m = 1.8
width_m = 0.6
"#;
    std::fs::write(base.join("plan.toml"), plan).unwrap();
    ends(base, &["plan.toml", "-o", "out"], 0);
    let scene = json(&std::fs::read_to_string(base.join("scenes/a.json")).unwrap());
    let found = conditions(&base.join("out"));
    assert_eq!(found.len(), 6 * 2 + 6, "{found:?}");
    let (mut times, mut bicycles) = (Vec::new(), 0);
    for (_, actor, conditions) in &found {
        let own = &conditions[actor];
        if own["type"] == "cyclist" {
            assert_eq!(own, &serde_json::json!({"type": "cyclist", "length_m": 1.8, "width_m": 0.6}));
            bicycles += 1;
            continue;
        }
        let agents = scene["agents"].as_array().unwrap();
        let track = &agents.iter().find(|agent| agent["id"] == **actor).unwrap()["track"];
        let at = |step: usize, name: &str| track[name][step].as_f64().unwrap();
        let near = |value: &Value, expected: f64| {
            assert!((value.as_f64().unwrap() - expected).abs() < 1e-6, "{value} {expected}");
        };
        let heading = at(20, "heading_rad");
        near(&own["goal"]["x_m"], at(20, "x_m") - heading.sin());
        near(&own["goal"]["y_m"], at(20, "y_m") + heading.cos());
        let speed = |step: usize| at(step, "vx_mps").hypot(at(step, "vy_mps"));
        near(&own["goal"]["speed_mps"], 0.5 * speed(20));
        near(&own["start"]["speed_mps"], 0.8 * speed(0));
        times.push(own["goal"]["time_s"].as_f64().unwrap());
        let others = conditions.as_object().unwrap().iter().filter(|(id, _)| *id != actor);
        assert_eq!(others.filter(|(_, of)| **of == serde_json::json!({"length_m": 12.0})).count(), 5);
    }
    times.sort_by(f64::total_cmp);
    assert_eq!((times[0], times[11], bicycles), (2.0, 2.5, 6), "{times:?}");
    let (text, _) = ends(base, &["verify", "out", "--units", "18"], 0);
    assert!(text.contains("all equal"), "{text}");
}

#[test]
fn maps_are_filled_by_their_seeds() {
    let folder = prepared();
    let base = folder.path();
    let plan = "[generate]\nhorizon_s = 2\nsteps = 1\n[[maps]]\ntemplate = 'straight'\ncount = 4\nscenes = 2\nseed = 5\n\
                [[maps]]\nname = 'street'\nfiles = ['scenes/a.json', 'scenes/broken.json']\ncount = 3\n";
    std::fs::write(base.join("plan.toml"), plan).unwrap();
    ends(base, &["plan.toml", "-o", "one", "--jobs", "1"], 0);
    ends(base, &["plan.toml", "-o", "two", "--jobs", "2"], 0);
    assert_eq!(differences(&base.join("one"), &base.join("two")), Vec::<PathBuf>::new());
    let record = json(&std::fs::read_to_string(base.join("one/plan.json")).unwrap());
    let scenes = record["scenes"].as_array().unwrap();
    let names: Vec<&str> = scenes.iter().map(|scene| scene["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["broken", "straight-0", "straight-1", "street-0"]);
    assert_eq!(scenes[0]["problem"]["code"], "malformed-json");
    assert_ne!(scenes[1]["sha256"], scenes[2]["sha256"], "each is filled anew");
    ends(base, &["merge", "one"], 0);
    let cases = std::fs::read_to_string(base.join("one/cases.jsonl")).unwrap();
    let users: Vec<f64> =
        cases.lines().map(|line| json(line)["figures"]["road_users"].as_f64().unwrap()).collect();
    // The six cars of the file are left out; one of the three pedestrians finds no place beside the street.
    let most = [4.0, 4.0, 3.0];
    assert!(users.len() == 3 && users.iter().zip(most).all(|(n, most)| *n > 0.0 && *n <= most), "{users:?}");
    ends(base, &["verify", "one"], 0);
    std::fs::write(base.join("plan.toml"), plan.replace("seed = 5", "seed = 6")).unwrap();
    let (_, told) = ends(base, &["plan.toml", "-o", "one"], 8);
    assert!(told.contains("another plan"), "{told}");
}

/// A search for cars that come close: 8 searches of 13 tries in two scenes, and a file that is no scene.
const SEARCH: &str = r#"
scenes = ["scenes/*.json"]
seeds = 2
where = "actor.min_distance_m < 1.3 && collisions == 0"
chunk_units = 24
[sampling]
method = "search"
draws = 13
[generate]
horizon_s = 2
steps = 1
[[situations]]
name = "aside"
agents = ["0", "3"]
goal = { ahead_m = { uniform = [5, 40] }, left_m = { uniform = [-3, 3] }, speed_mps = { choice = [8, 12] } }
"#;

#[test]
fn a_search_is_the_same_whatever_the_threads_shards_and_interruptions() {
    let folder = prepared();
    let base = folder.path();
    std::fs::write(base.join("plan.toml"), SEARCH).unwrap();
    ends(base, &["plan.toml", "-o", "whole", "--jobs", "1"], 0);
    ends(base, &["plan.toml", "-o", "threads", "--jobs", "2"], 0);
    for shard in ["1/2", "0/2"] {
        ends(base, &["plan.toml", "-o", "shards", "--shard", shard], 0);
    }
    for other in ["threads", "shards"] {
        assert_eq!(differences(&base.join("whole"), &base.join(other)), Vec::<PathBuf>::new());
    }
    let kills = [0, 1, 2, 4].iter().filter(|chunks| killed(base, **chunks)).count();
    assert!(kills >= 2 && tables(base) < 7, "{kills} kills, {} chunks", tables(base));
    ends(base, &["plan.toml", "-o", "out"], 0);
    assert_eq!(differences(&base.join("whole"), &base.join("out")), Vec::<PathBuf>::new());
    // A chunk in the middle is made again from the chunks before it.
    let mut chunks: Vec<PathBuf> =
        std::fs::read_dir(base.join("out/chunks")).unwrap().map(|entry| entry.unwrap().path()).collect();
    chunks.sort();
    assert_eq!(chunks.len(), 3 * 7, "{chunks:?}");
    // Only its table: references and motions are written before it.
    std::fs::remove_file(&chunks[5]).unwrap();
    let (_, told) = ends(base, &["plan.toml", "-o", "out"], 0);
    assert!(told.contains("1 of 7 chunks"), "{told}");
    assert_eq!(differences(&base.join("whole"), &base.join("out")), Vec::<PathBuf>::new());

    let (text, _) = ends(base, &["status", "out", "--json"], 0);
    let status = json(&text);
    let of = |outcome: &str| status["tally"]["outcomes"][outcome].as_u64().unwrap_or(0);
    assert_eq!((status["units"].as_u64(), of("failed")), (Some(8 * 13 + 1), 1), "{text}");
    assert!(of("kept") > 0 && of("left-out") > 0, "{text}");
    let (text, _) = ends(base, &["verify", "out", "--units", "20"], 0);
    assert_eq!(text, "20 units made again: all equal\n");
}

/// Starts a run and kills it once this many chunks exist; false if it had ended by itself.
fn killed(folder: &Path, chunks: usize) -> bool {
    let mut child = started(folder);
    let running = loop {
        match child.try_wait().unwrap() {
            Some(_) => break false,
            None if tables(folder) >= chunks => break true,
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    };
    // A process that has ended cannot be killed.
    let _ = child.kill();
    child.wait().unwrap();
    running
}

/// Number of existing chunks.
fn tables(folder: &Path) -> usize {
    let Ok(entries) = std::fs::read_dir(folder.join("out/chunks")) else { return 0 };
    entries.filter(|entry| entry.as_ref().unwrap().path().extension().unwrap() == "parquet").count()
}

fn started(folder: &Path) -> Child {
    command(folder, &["plan.toml", "-o", "out", "--quiet"]).stderr(Stdio::null()).spawn().unwrap()
}

#[test]
fn a_killed_run_goes_on_and_two_at_once_agree() {
    let folder = prepared();
    let base = folder.path();
    // One chunk per unit: many moments between two files.
    std::fs::write(base.join("plan.toml"), PLAN.replace("chunk_units = 6", "chunk_units = 1")).unwrap();
    ends(base, &["plan.toml", "-o", "whole"], 0);
    let kills = [0, 1, 3, 4, 9, 10, 17, 26, 33].iter().filter(|chunks| killed(base, **chunks)).count();
    let (before, _) = ends(base, &["status", "out", "--json"], 0);
    let done = json(&before)["units_done"].as_u64().unwrap();
    assert!(kills >= 5 && done >= 26, "{kills} kills, {done} units");
    ends(base, &["plan.toml", "-o", "out"], 0);
    assert_eq!(differences(&base.join("whole"), &base.join("out")), Vec::<PathBuf>::new());

    std::fs::remove_dir_all(base.join("out")).unwrap();
    let mut both = [started(base), started(base)];
    for child in &mut both {
        assert!(child.wait().unwrap().success());
    }
    assert_eq!(differences(&base.join("whole"), &base.join("out")), Vec::<PathBuf>::new());
}

#[test]
fn a_chunk_with_other_bytes_and_another_plan_are_refused() {
    let folder = prepared();
    let base = folder.path();
    ends(base, &["plan.toml", "-o", "out"], 0);
    let chunks = base.join("out/chunks");
    let mut names: Vec<PathBuf> = std::fs::read_dir(&chunks).unwrap().map(|e| e.unwrap().path()).collect();
    names.sort();
    // The references, their motions, the table.
    let [cases, table] = [&names[0], &names[2]];
    assert!(cases.extension().unwrap() == "jsonl" && table.extension().unwrap() == "parquet", "{names:?}");
    let good = std::fs::read(cases).unwrap();
    // Without the table, the chunk is made again, and its cases are replaced.
    std::fs::write(cases, b"{}\n").unwrap();
    std::fs::remove_file(table).unwrap();
    let (_, told) = ends(base, &["plan.toml", "-o", "out"], 1);
    assert!(told.contains("not-reproducible: ") && told.contains(".jsonl"), "{told}");
    assert_eq!(std::fs::read(cases).unwrap(), b"{}\n", "nothing is replaced");
    std::fs::write(cases, &good).unwrap();
    ends(base, &["plan.toml", "-o", "out"], 0);
    std::fs::write(cases, b"{}\n").unwrap();
    let (_, told) = ends(base, &["verify", "out", "--units", "1000"], 1);
    assert!(told.contains("not-reproducible: "), "{told}");

    std::fs::write(base.join("plan.toml"), PLAN.replace("seeds = 2", "seeds = 3")).unwrap();
    let (_, told) = ends(base, &["plan.toml", "-o", "out"], 8);
    assert!(told.contains("another plan"), "{told}");
}

#[test]
fn plans_that_make_no_sense_are_refused_with_their_place() {
    let folder = prepared();
    let base = folder.path();
    for (from, to, said) in [
        ("seeds = 2", "seds = 2", "plan.toml: seds: unknown field `seds`"),
        ("seeds = 2", "seds = 2", "did you mean seeds?"),
        ("speed_mps =", "sped_mps =", "situations[1].goal.sped_mps: "),
        ("takes_s", "take_s", "did you mean takes_s?"),
        ("@vehicles", "@cars", "situations[1].agents[0]: an id or one of @all"),
        ("collisions == 0", "colisions == 0", "where: column 1: no figure is named \"colisions\""),
        ("horizon_s = 2", "horizon_s = 200", "generate.horizon_s: "),
        ("scenes/*.json", "none/*.json", "no file matches"),
        ("[generate]", "[[maps]]\ntemplate = \"four-army\"\n[generate]", "did you mean four-arms?"),
        ("seeds = 2", "seeds = ", "line 3"),
    ] {
        std::fs::write(base.join("plan.toml"), PLAN.replace(from, to)).unwrap();
        let (_, told) = ends(base, &["plan.toml", "-o", "out"], 3);
        assert!(told.contains(said), "{said}: {told}");
    }
    assert!(!base.join("out/plan.json").exists());
    ends(base, &["status", "out"], 3);
    ends(base, &["plan.toml"], 2);
    ends(base, &["plan.toml", "-o", "out", "--shard", "3/3"], 2);
}
