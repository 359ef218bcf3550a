//! Batches in an object store give the bytes of a local run, regardless of lost requests and replies.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

mod s3;

use dragtraffic_tests::program::program;
use dragtraffic_tests::scenes::street;
use s3::{ObjectStore, WriteFault};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use tempfile::TempDir;

/// One chunk per unit: many moments between two objects.
const PLAN: &str = r#"
scenes = ["a.json"]
seeds = 2
where = "collisions == 0"
chunk_units = 1
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
/// Location of the results.
const PLACE: &str = "s3://night/out";

fn prepared() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.json"), street(6, 31).to_string()).unwrap();
    std::fs::write(folder.path().join("plan.toml"), PLAN).unwrap();
    folder
}

fn command(folder: &Path, store: &ObjectStore, arguments: &[&str]) -> Command {
    let mut command = Command::new(program());
    command.args(arguments).current_dir(folder).envs(store.variables());
    for name in ["SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX"] {
        command.env_remove(name);
    }
    command
}

/// Runs the program, checks its exit code, and returns stdout and stderr.
fn ends(folder: &Path, store: &ObjectStore, arguments: &[&str], code: i32) -> (String, String) {
    let output = command(folder, store, arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    (text(&output.stdout), told)
}

fn started(folder: &Path, store: &ObjectStore) -> Child {
    let arguments = ["batch", "plan.toml", "-o", PLACE, "--quiet"];
    command(folder, store, &arguments).stderr(Stdio::null()).spawn().unwrap()
}

/// The files of a local run of the same plan.
fn local(folder: &Path, store: &ObjectStore) -> BTreeMap<String, Vec<u8>> {
    ends(folder, store, &["batch", "plan.toml", "-o", "local"], 0);
    let mut files = BTreeMap::new();
    for part in ["", "chunks", "scenes"] {
        for entry in std::fs::read_dir(folder.join("local").join(part)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                let name = path.strip_prefix(folder.join("local")).unwrap().to_str().unwrap().to_owned();
                files.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    files
}

#[test]
fn lost_requests_kills_and_a_second_process_change_no_byte() {
    let folder = prepared();
    let base = folder.path();
    // Every third reply is lost after the write, every fifth request before it.
    let store = ObjectStore::start(|write| match write {
        n if n % 3 == 1 => WriteFault::AnswerLost,
        n if n % 5 == 2 => WriteFault::Refused,
        _ => WriteFault::None,
    })
    .unwrap();
    let whole = local(base, &store);
    let mut kills = 0;
    for objects in [1, 4, 9, 10, 20, 35] {
        let mut child = started(base, &store);
        let running = loop {
            match child.try_wait().unwrap() {
                Some(_) => break false,
                None if store.objects("out/").len() >= objects => break true,
                None => std::thread::sleep(Duration::from_millis(2)),
            }
        };
        kills += usize::from(running);
        let _ = child.kill();
        child.wait().unwrap();
    }
    assert!(kills >= 4, "{kills} kills");
    let mut both = [started(base, &store), started(base, &store)];
    for child in &mut both {
        assert!(child.wait().unwrap().success());
    }
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    let there = store.objects("out/");
    assert_eq!(names(&there), names(&whole));
    assert!(there == whole);

    let (_, told) = ends(base, &store, &["batch", "plan.toml", "-o", PLACE], 0);
    assert!(told.contains("; 0 of "), "{told}");
    ends(base, &store, &["batch", "merge", PLACE], 0);
    ends(base, &store, &["batch", "merge", "local"], 0);
    ends(base, &store, &["batch", "report", PLACE], 0);
    for table in ["manifest.json", "cases.jsonl", "cases.parquet"] {
        assert!(
            store.objects("out/")[table] == std::fs::read(base.join("local").join(table)).unwrap(),
            "{table}"
        );
    }
    let (text, _) = ends(base, &store, &["batch", "verify", PLACE, "--units", "4"], 0);
    assert_eq!(text, "4 units made again: all equal\n");
    let (text, _) = ends(base, &store, &["batch", "status", PLACE, "--json"], 0);
    let status: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&status["chunks"], &status["shares_due"]), (&status["chunks_done"], &serde_json::json!([])));
    ends(base, &store, &["replay", PLACE, "--kept", "-o", "cases/"], 0);
    ends(base, &store, &["replay", "local", "--kept", "-o", "again/"], 0);
    let scenes = |folder: &str| std::fs::read_dir(base.join(folder)).unwrap().count();
    assert!(scenes("cases") > 0 && scenes("cases") == scenes("again"));
}

#[test]
fn other_bytes_other_plans_and_wrong_places_are_refused() {
    let folder = prepared();
    let base = folder.path();
    let store = ObjectStore::start(|_| WriteFault::None).unwrap();
    ends(base, &store, &["batch", "plan.toml", "-o", PLACE], 0);
    let chunk: Vec<String> = store.objects("out/chunks/").into_keys().take(3).collect();
    let [cases, _, table] = [&chunk[0], &chunk[1], &chunk[2]].map(|name| format!("out/chunks/{name}"));
    assert!(cases.ends_with(".jsonl") && table.ends_with(".parquet"), "{chunk:?}");
    store.set(&cases, Some(b"{}\n"));
    store.set(&table, None);
    let (_, told) = ends(base, &store, &["batch", "plan.toml", "-o", PLACE], 1);
    assert!(told.contains("not-reproducible: s3://night/out/chunks/"), "{told}");
    assert_eq!(store.objects(&cases)[""], b"{}\n", "nothing is replaced");

    std::fs::write(base.join("plan.toml"), PLAN.replace("seeds = 2", "seeds = 3")).unwrap();
    let (_, told) = ends(base, &store, &["batch", "plan.toml", "-o", PLACE], 8);
    assert!(told.contains("s3://night/out has results of another plan"), "{told}");
    for (place, code, reason) in [
        ("s3://elsewhere/out", 1, "NoSuchBucket"),
        ("ftp://night/out", 2, "an object store expected"),
        ("memory:///out", 2, "an object store expected"),
        ("s3://", 2, "s3://"),
    ] {
        let (_, told) = ends(base, &store, &["batch", "plan.toml", "-o", place], code);
        assert!(told.contains(reason), "{place}: {told}");
    }
    let (_, told) = ends(base, &store, &["batch", "status", "s3://night/nothing"], 3);
    assert!(told.contains("s3://night/nothing: no results of a batch"), "{told}");
}
