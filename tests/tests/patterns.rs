//! Patterns over maps, and events in recordings, by the real program.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use formats::columnar::{ColumnValue, ParquetTable};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Runs the program, checks its exit code, and returns stdout and stderr.
fn ends(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    let output = Command::new(program()).args(arguments).current_dir(folder).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    (String::from_utf8_lossy(&output.stdout).into_owned(), told)
}

fn demos() -> String {
    root().join("assets/scenes").to_str().unwrap().to_owned()
}

#[test]
fn every_pattern_that_ships_fits_somewhere_on_the_example_maps() {
    let folder = tempfile::tempdir().unwrap();
    let (text, _) = ends(folder.path(), &["match", "all", &demos()], 0);
    let (list, _) = ends(folder.path(), &["match", "--list"], 0);
    assert_eq!(text.lines().count(), list.lines().count());
    for line in text.lines() {
        assert!(!line.contains(" 0 of "), "{line}");
    }
}

#[test]
fn places_become_scenes_whose_goals_are_met() {
    let folder = tempfile::tempdir().unwrap();
    let crossing = root().join("assets/scenes/demo-crossing.json");
    let map = crossing.to_str().unwrap();
    let (text, _) = ends(folder.path(), &["match", "ccftap", map, "-o", "turns/", "--json"], 0);
    let places: Vec<Value> = serde_json::from_str(&text).unwrap();
    let files: Vec<_> = std::fs::read_dir(folder.path().join("turns")).unwrap().collect();
    assert!(!places.is_empty() && files.len() == places.len(), "{text}");
    let first = files[0].as_ref().unwrap().path();
    let made: Value = serde_json::from_slice(&std::fs::read(&first).unwrap()).unwrap();
    let ids: Vec<&str> =
        made["agents"].as_array().unwrap().iter().map(|a| a["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["vut", "target"]);
    let file = first.to_str().unwrap();
    ends(folder.path(), &["generate", file, "--agents", "vut,target", "-o", "out.json"], 0);
    let (score, _) = ends(folder.path(), &["score", "out.json", "--json"], 0);
    let score: Value = serde_json::from_str(&score).unwrap();
    assert_eq!(score["scene"]["goals_reached"], 1.0, "{score}");
}

#[test]
fn a_plan_varies_a_pattern_at_every_place() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::copy(root().join("assets/patterns/ccrs.toml"), at("own.toml")).unwrap();
    let plan = format!(
        "scenes = ['{}/demo-motorway.json']\n[generate]\nsteps = 1\n\
         [[situations]]\npattern = 'ALKS-deceleration'\nparameters = {{ gap_m = {{ choice = [15, 30] }} }}\n\
         [[situations]]\nname = 'own'\npattern = 'own.toml'",
        demos()
    );
    std::fs::write(at("plan.toml"), plan).unwrap();
    ends(folder.path(), &["batch", "plan.toml", "-o", "out"], 0);
    let (status, _) = ends(folder.path(), &["batch", "status", "out"], 0);
    let kept: u64 = status.lines().find_map(|line| line.strip_prefix("kept")?.trim().parse().ok()).unwrap();
    let count = |name: &str| {
        let map = format!("{}/demo-motorway.json", demos());
        let (text, _) = ends(folder.path(), &["match", name, &map, "--json"], 0);
        serde_json::from_str::<Vec<Value>>(&text).unwrap().len() as u64
    };
    let (braking, standing) = (count("ALKS-deceleration"), count("own.toml"));
    assert!(braking > 0 && standing > 0);
    assert_eq!(kept, 2 * braking + standing, "{status}");
    ends(folder.path(), &["batch", "verify", "out", "--units", "3"], 0);
    ends(folder.path(), &["replay", "out", "--kept", "-o", "cases/"], 0);
    let case = std::fs::read_dir(at("cases")).unwrap().next().unwrap().unwrap().path();
    let case: Value = serde_json::from_slice(&std::fs::read(case).unwrap()).unwrap();
    let ids: BTreeSet<&str> =
        case["agents"].as_array().unwrap().iter().map(|a| a["id"].as_str().unwrap()).collect();
    assert_eq!(ids, BTreeSet::from(["target", "vut"]), "those of the map are left out");
    // The ego has no goal, but a future.
    let futures = case["generated"]["samples"][0]["agents"].as_object().unwrap();
    let moving: BTreeSet<&str> = futures.keys().map(String::as_str).collect();
    assert_eq!(moving, ids, "all of the pattern are generated");
}

#[test]
fn slips_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let (_, told) = ends(folder.path(), &["match", "CCFtop", &demos()], 2);
    assert!(told.contains("did you mean CCFtap?"), "{told}");
    std::fs::write(folder.path().join("bad.toml"), "name = 'a'\ntitle = 'b'\nrode = 3").unwrap();
    let (_, told) = ends(folder.path(), &["match", "bad.toml", &demos()], 3);
    assert!(told.contains("bad.toml: rode: unknown field") && told.contains("mean road?"), "{told}");
    let plan = "scenes = ['a']\n[[situations]]\npattern = 'CCRs'\nparameters = { vut_kph = 3 }\n\
                [[situations]]\npattern = 'none.toml'";
    std::fs::write(folder.path().join("plan.toml"), plan).unwrap();
    let (_, told) = ends(folder.path(), &["batch", "plan.toml", "-o", "out"], 3);
    assert!(told.contains("situations[1].pattern: "), "{told}");
    let plan = "scenes = ['a']\n[[situations]]\npattern = 'CCRs'\nparameters = { vut_kph = 3 }";
    std::fs::write(folder.path().join("plan.toml"), plan).unwrap();
    let (_, told) = ends(folder.path(), &["batch", "plan.toml", "-o", "out"], 3);
    assert!(told.contains("mean vut_kmh?"), "{told}");
}

#[test]
fn events_of_recordings_are_a_table_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let (counts, _) = ends(folder.path(), &["mine", &demos(), "-o", "events.parquet"], 0);
    let (json, _) = ends(folder.path(), &["mine", &demos(), "--json"], 0);
    let events: Vec<Value> = serde_json::from_str(&json).unwrap();
    let braking = events.iter().filter(|event| event["tag"] == "hard-braking").count();
    let line = counts.lines().find(|line| line.starts_with("hard-braking")).unwrap();
    assert_eq!(line.split_whitespace().nth(1).unwrap(), braking.to_string());
    let bytes = std::fs::read(folder.path().join("events.parquet")).unwrap();
    let mut table = ParquetTable::open(&bytes).unwrap();
    let tag = table.names().iter().position(|name| name == "tag").unwrap();
    table.choose([tag].to_vec()).unwrap();
    let mut tags = Vec::new();
    while table.advance().unwrap() {
        if let ColumnValue::Text(text) = table.value(0) {
            tags.push(text.to_owned());
        }
    }
    let told: Vec<&str> = events.iter().map(|event| event["tag"].as_str().unwrap()).collect();
    assert_eq!(tags, told);
    let (_, told) = ends(folder.path(), &["mine", &demos(), "-o", "events.parquet"], 8);
    assert!(told.contains("events.parquet"), "{told}");
}
