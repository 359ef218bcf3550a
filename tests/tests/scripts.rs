//! The command line in scripts: consecutive edits, files that stay intact, data that fit, licences that are
//! passed on.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::Server;
use dragtraffic_tests::program::{program, root};
use dragtraffic_tests::scenes::street;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn run(arguments: &[&str]) -> Output {
    Command::new(program()).args(arguments).output().unwrap()
}

/// Runs the program, checks its exit code, and returns stderr.
fn ends(arguments: &[&str], code: i32) -> String {
    let output = run(arguments);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    told
}

fn json_of(path: &str) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn demo() -> String {
    root().join("assets/scenes/demo-crossing.json").to_str().unwrap().to_owned()
}

#[test]
fn edits_chain() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (first, second, third) = (at("a.json"), at("b.json"), at("c.json"));
    ends(&["generate", &demo(), "--agents", "6", "--goal", "6=-40,8", "--seed", "7", "-o", &first], 0);
    ends(&["generate", &first, "--agents", "7", "--seed", "7", "-o", &second], 0);
    let agents = |path: &str| json_of(path)["generated"]["samples"][0]["agents"].clone();
    let (before, after) = (agents(&first), agents(&second));
    assert_eq!(before["6"], after["6"], "6 keeps its future");
    assert!(after["7"].is_object());
    assert_eq!(json_of(&second)["generated"]["stale"], false);
    ends(
        &["generate", &first, "--agents", "7", "--seed", "7", "--kept-futures", "forgotten", "-o", &third],
        0,
    );
    assert!(agents(&third)["6"].is_null() && agents(&third)["7"].is_object());

    let server = Server::start(&[]).unwrap();
    let mut ask = json!({"scene": json_of(&first), "agents": ["7"], "seed": 7});
    let answer = |ask: &Value| {
        let reply = server.post("/v1/generate", ask).unwrap();
        assert_eq!(reply.status, 200, "{}", reply.text());
        reply.json()
    };
    let kept = answer(&ask);
    assert_eq!(kept["samples"][0]["agents"], after, "the same over HTTP");
    ask["kept_futures"] = json!("omitted");
    let omitted = answer(&ask);
    assert!(omitted["samples"][0]["agents"]["6"].is_null());
    assert_eq!(omitted["samples"][0]["agents"]["7"], kept["samples"][0]["agents"]["7"]);
    ask["kept_futures"] = json!("forgotten");
    let forgotten = answer(&ask);
    assert_eq!(forgotten["samples"][0]["agents"], agents(&third));
    // A new condition on road user 6 makes its kept future stale.
    ask["kept_futures"] = json!("answered");
    ask["conditions"] = json!({"6": {"goal": {"speed_mps": 3.0}}});
    assert_eq!(answer(&ask)["generated"]["stale"], true);
}

#[test]
fn thresholds_and_pairs_are_flags_of_score() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json").to_str().unwrap().to_owned();
    let mut scene = street(4, 91);
    // The second car in the lane stands, the first one drives into it.
    scene["agents"][2]["track"]["x_m"] = json!(vec![-10.0; 91]);
    scene["agents"][2]["track"]["vx_mps"] = json!(vec![0.0; 91]);
    std::fs::write(&path, scene.to_string()).unwrap();
    let collisions = |flags: &[&str]| {
        let output = run(&[&["score", "--json", &path], flags].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let score: Value = serde_json::from_slice(&output.stdout).unwrap();
        (score["scene"]["collisions"].as_array().unwrap().len(), score["thresholds"].clone())
    };
    let (plain, thresholds) = collisions(&[]);
    assert_eq!((plain, thresholds["iou"].as_f64(), thresholds["ttc_s"].as_f64()), (1, Some(0.0), Some(1.5)));
    assert_eq!(collisions(&["--pairs", "regenerated"]).0, 0);
    let (_, thresholds) = collisions(&["--iou", "0.1", "--ttc", "2", "--gap", "0.5"]);
    let given = ["iou", "ttc_s", "gap_m"].map(|name| thresholds[name].as_f64());
    assert_eq!(given, [Some(0.1), Some(2.0), Some(0.5)]);
    for beyond in [["--iou", "2"], ["--ttc", "9"], ["--gap", "-1"]] {
        ends(&[&["score", &path], &beyond[..]].concat(), 2);
    }
}

#[cfg(unix)]
#[test]
fn devices_pipes_and_links_are_not_replaced() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for flags in [&[][..], &["--force"]] {
        ends(&[&["export", &demo(), "--to", "womd", "-o", "/dev/null"], flags].concat(), 0);
        assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    }
    let (target, link) = (at("target"), at("link"));
    std::fs::write(&target, "old").unwrap();
    symlink(&target, &link).unwrap();
    ends(&["export", &demo(), "--to", "dragtraffic", "-o", &link], 8);
    ends(&["export", &demo(), "--to", "dragtraffic", "-o", &link, "--force"], 0);
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(json_of(&target)["format"], "dragtraffic.scene");
    let pipe = at("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let end = pipe.clone();
    let reader = std::thread::spawn(move || Command::new("cat").arg(end).output().unwrap());
    ends(&["export", &demo(), "--to", "dragtraffic", "-o", &pipe, "--force"], 0);
    let read: Value = serde_json::from_slice(&reader.join().unwrap().stdout).unwrap();
    assert_eq!(read["format"], "dragtraffic.scene");
    assert!(std::fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
}

/// Records of cars in a street under a licence.
fn records(folder: &Path, licence: &str) -> String {
    let mut scene = street(6, 91);
    scene["meta"]["licence"] = json!(licence);
    scene["meta"]["source"] = json!("womd");
    let (input, out) = (folder.join("street.json"), folder.join("vehicle.records"));
    std::fs::write(&input, scene.to_string()).unwrap();
    let (input, out) = (input.to_str().unwrap().to_owned(), out.to_str().unwrap().to_owned());
    ends(&["lab", "prepare", &input, "--expert", "vehicle", "-o", &out], 0);
    ends(&["lab", "prepare", &input, "--expert", "vehicle", "-o", &out], 8);
    out
}

#[test]
fn licences_travel_and_wrong_data_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let records = records(folder.path(), "waymo-nc");
    let weights = at("vehicle.safetensors");
    let train = |expert: &str, more: &[&str]| -> Vec<String> {
        let flags = [
            "lab",
            "train",
            &records,
            "--stage",
            "initializer",
            "--expert",
            expert,
            "--batch",
            "4",
            "-o",
            &weights,
        ];
        flags.iter().chain(more).map(|flag| (*flag).to_owned()).collect()
    };
    let ends_of = |flags: Vec<String>, code: i32| {
        let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
        ends(&flags, code)
    };
    let told = ends_of(train("pedestrian", &["--steps", "1"]), 1);
    assert!(told.contains("records of the expert \"vehicle\""), "{told}");
    ends_of(train("vehicle", &["--steps", "1"]), 0);
    ends_of(train("vehicle", &["--steps", "1"]), 8);
    let told = ends_of(train("vehicle", &["--steps", "2", "--resume"]), 1);
    assert!(told.contains("another number of steps"), "{told}");
    // The same weights under another name, then under their own name beside the shipped ones.
    let shipped = root().join("models/experts/weights");
    for name in ["pedestrian", "cyclist"] {
        let file = format!("{name}.safetensors");
        std::fs::copy(shipped.join(&file), at(&file)).unwrap();
    }
    let own = folder.path().to_str().unwrap().to_owned();
    let info: Value = serde_json::from_slice(&run(&["info", "--weights", &own]).stdout).unwrap();
    let said = info.to_string();
    assert!(said.contains("waymo-nc") && said.contains("1 scenes of womd (waymo-nc)"), "{said}");
    let out = at("out.json");
    ends(&["generate", &demo(), "--agents", "6", "--weights", &own, "-o", &out], 0);
    assert_eq!(json_of(&out)["generated"]["licence"], "waymo-nc");
    ends(&["generate", &demo(), "--agents", "6", "-o", &out, "--force"], 0);
    assert!(json_of(&out)["generated"].get("licence").is_none());
    std::fs::copy(&weights, at("cyclist.safetensors")).unwrap();
    let told = ends(&["info", "--weights", &own], 7);
    assert!(told.contains("cyclist.safetensors") && told.contains("\"vehicle\""), "{told}");
}

#[cfg(unix)]
#[test]
fn a_stopped_training_keeps_its_checkpoint_and_no_half_files() {
    let folder = tempfile::tempdir().unwrap();
    let records = records(folder.path(), "cc0");
    let weights = folder.path().join("w.safetensors");
    let train =
        ["lab", "train", &records, "--stage", "initializer", "--expert", "vehicle", "--steps", "100000"];
    let mut child = Command::new(program())
        .args(train)
        .args(["--batch", "4", "-o"])
        .arg(&weights)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The first line reports that the training runs.
    let mut line = String::new();
    std::io::BufRead::read_line(&mut std::io::BufReader::new(child.stderr.as_mut().unwrap()), &mut line)
        .unwrap();
    assert!(line.contains("from step 0"), "{line}");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let began = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        assert!(began.elapsed() < Duration::from_secs(60), "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    assert_eq!(status.code(), Some(130));
    let names =
        std::fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let names: Vec<String> = names.collect();
    assert!(names.iter().any(|name| name == "w.safetensors.checkpoint"), "{names:?}");
    assert!(!names.iter().any(|name| name.ends_with(".tmp") || name == "w.safetensors"), "{names:?}");
}

#[test]
fn the_paper_is_reproduced_by_one_command() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |name: &str| root().join(format!("assets/scenes/demo-{name}.json"));
    let data = ["arterial", "motorway", "residential", "roundabout"].map(|n| scene(n).display().to_string());
    let out = folder.path().join("paper").display().to_string();
    let own = demo();
    let run = |more: &[&str], code: i32| {
        let mut arguments = vec!["lab", "reproduce", "--test", &own, "--least-agents", "2", "-o", &out];
        arguments.extend(data.iter().map(String::as_str));
        arguments.extend(["--epochs", "0.1,0.1,0.1", "--batch", "8"]);
        arguments.extend(more);
        ends(&arguments, code)
    };
    let told = run(&[], 0);
    assert!(told.contains("5 files, 5 scenes") && told.contains("Table II"), "{told}");
    let read = |name: &str| std::fs::read_to_string(format!("{out}/{name}")).unwrap();
    let tables = read("tables.md");
    for part in ["| Vehicle | DragTraffic with Condition |", "| 9s | T.G. Mixture", "of 49884"] {
        assert!(tables.contains(part), "{part}: {tables}");
    }
    assert!(read("figure.html").contains("<svg") && read("table-2.csv").contains("Rollout Interval"));
    // Again with existing results: nothing is trained, and the result is the same.
    let told = run(&["--only", "tables"], 0);
    assert!(!told.contains("steps") && read("tables.md") == tables, "{told}");
    let told = run(&["--seed", "2"], 8);
    assert!(told.contains("holds a run with another") && told.contains("--force"), "{told}");
    run(&["--seed", "2", "--only", "figure", "--force"], 0);
    assert!(!Path::new(&format!("{out}/weights")).exists());
}
