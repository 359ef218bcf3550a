//! The command line over many files: the documented task, conditions on scores, invalid values, and progress
//! messages.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::{program, root};
use dragtraffic_tests::scenes::street;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(program()).args(arguments).current_dir(folder).output().unwrap()
}

/// Runs the program, checks its exit code, and returns stdout and stderr.
fn ends(folder: &Path, arguments: &[&str], code: i32) -> (String, String) {
    let output = run_in(folder, arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let told = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
    assert!(!told.contains('\u{1b}'), "a bar where there is no terminal: {told}");
    (text(&output.stdout), told)
}

fn demo(name: &str) -> String {
    root().join(format!("assets/scenes/{name}.json")).to_str().unwrap().to_owned()
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// The lines of a table after its heading, each by column.
fn table(text: &str) -> Vec<std::collections::BTreeMap<String, String>> {
    // Cells with commas are quoted; the tested columns come before those.
    let mut lines = text.lines();
    let heading: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells = line.split(',').map(str::to_owned);
        heading.iter().map(|name| (*name).to_owned()).zip(cells).collect()
    };
    lines.map(row).collect()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[cfg(unix)]
#[test]
fn the_documented_task_runs_and_repeats() {
    let page = std::fs::read_to_string(root().join("docs/scripting.md")).unwrap();
    let part = page.split_once("### Hard situations in five lines").unwrap().1;
    let task = part.split_once("```sh\n").unwrap().1.split_once("```").unwrap().0;
    assert!(task.lines().count() <= 5, "{task}");
    let folders: Vec<tempfile::TempDir> = (0..2).map(|_| tempfile::tempdir().unwrap()).collect();
    for folder in &folders {
        std::os::unix::fs::symlink(root().join("assets"), folder.path().join("assets")).unwrap();
        let path = format!("{}:{}", program().parent().unwrap().display(), std::env::var("PATH").unwrap());
        let output = Command::new("sh")
            .args(["-e", "-c", task])
            .current_dir(folder)
            .env("PATH", path)
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{told}");
        assert!(told.contains("brake: ") && told.contains("no road user fits"), "{told}");
        // A line for each scene and template, regardless of the seeds.
        let without = 4 * told.matches("no road user fits").count();
        assert!(part.contains(&format!("In {without} cases no road user fits")), "{told}");
    }
    let [first, second] = [folders[0].path(), folders[1].path()];
    let manifest = std::fs::read_to_string(first.join("found/manifest.csv")).unwrap();
    let rows = table(&manifest);
    assert!(part.contains(&format!("{} meet the condition", rows.len())), "{manifest}");
    for template in ["brake", "cut-in", "late"] {
        assert!(rows.iter().any(|row| row["template"] == template), "{template}: {manifest}");
    }
    for row in &rows {
        assert!(row["actor.min_ttc_s"].parse::<f64>().unwrap() < 1.5 && row["collisions"] == "0", "{row:?}");
        let scene = json_of(&first.join("found").join(&row["file"]));
        assert_eq!(scene["generated"]["request"]["agents"], json!([row["actor"]]));
        assert_eq!(scene["generated"]["seed"].to_string(), row["seed"]);
    }
    // The written scenes satisfy the filter when they are scored again.
    let (text, told) =
        ends(first, &["score", "found", "--where", "!(actor.min_ttc_s < 1.5 && collisions == 0)"], 0);
    assert!(text.is_empty() && told.contains(&format!("0 of {} hold", rows.len())), "{text}{told}");
    let kept = names(&first.join("kept"));
    assert!(part.contains(&format!("{} of these meet their goal", kept.len())), "{kept:?}");
    let motion = std::fs::read_to_string(first.join("motion.csv")).unwrap();
    assert!(
        motion.starts_with("scenario_id,agent_id,type,subtype,sample,mode,probability,step,time_s,x_m,y_m,")
    );
    assert_eq!(motion.matches("scenario_id,agent_id").count(), 1, "one heading");
    for name in &kept {
        assert!(motion.contains(&format!("\n{},", name.strip_suffix(".json").unwrap())), "{name}");
    }
    // Equal calls give equal files.
    for folder in ["found", "kept", "."] {
        assert_eq!(names(&first.join(folder)), names(&second.join(folder)));
        for name in names(&first.join(folder)) {
            let files = [first, second].map(|base| base.join(folder).join(&name));
            if files[0].is_file() {
                assert!(
                    std::fs::read(&files[0]).unwrap() == std::fs::read(&files[1]).unwrap(),
                    "{name} differs"
                );
            }
        }
    }
}

#[test]
fn values_are_told_in_words_of_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let wrong = |flags: &[&str]| ends(folder.path(), &[&["generate", &scene], flags].concat(), 2).1;
    for (flags, expected) in [
        (&["--horizon", "30"][..], "'--horizon <SECONDS>': 0.5 to 20 seconds expected"),
        (&["--replan-interval", "4"], "3, 6, 9 expected"),
        (&["--replan", "6"], "--replan is --replan-interval now"),
        (&["--forget"], "--forget is --kept-futures forgotten now"),
        (&["--at", "1"], "--at is --start-time now"),
        (&["--kept-futures", "gone"], "answered, omitted or forgotten expected"),
        (&["--agents", "@none"], "--agents: expected \"all\", at least one id"),
        (&["--where", "violations > 0"], "violations is kinematic.violations now"),
        (&["--goal", "6=2,27,5,90"], "heading: 90 rad is more than a turn; 90 degrees are 1.5708 rad"),
        (&["--seed", "-1"], "a whole number from 0 to 9007199254740991 expected"),
        (&["--samples", "33"], "'--samples <N>': 33 is not in 1..=32"),
        (&["--goal", "6=-40"], "x needs y beside it"),
        (&["--goal", "6=ahead:4,speed:80"], "speed: 0 to 60 m/s expected"),
        (&["--goal", "6=1,2", "--goal", "6=3,4"], "--goal is given twice for 6"),
        (&["--goal", "99=1,2"], "--goal 99: the scene has no such road user"),
        (&["--goal", "6=speed:5,time:12"], "--goal 6: time: 12 found, 0.5 to 9 expected"),
        (&["--agents", "99"], "--agents: the scene has no road user \"99\""),
        (&["--agents", "@walkers"], "@moving"),
        (&["--size", "6=12"], "LENGTHxWIDTH"),
        (&["--type", "6=tank"], "vehicle, pedestrian or cyclist expected"),
        (&["--seeds", "9..3"], "at least one seed expected"),
        (&["--seeds", "3"], "--output DIR/"),
        (&["--react", "7,8"], "as in --react=7,8"),
        (
            &["--where", "min_tcc_s < 1"],
            "column 1: no figure is named \"min_tcc_s\" (did you mean min_ttc_s?)",
        ),
        (&["--where", "collisions = 0"], "column 12: \"=\" found; == compares"),
        (&["--template", "brake", "--agents", "6"], "cannot be used with"),
    ] {
        let told = wrong(flags);
        assert!(told.contains(expected) && !told.contains("/horizon_s"), "{flags:?}: {told}");
    }
    for (flags, expected) in [
        (&["--types", "car=1"][..], "--types car: vehicle, pedestrian or cyclist expected"),
        (&["--keep=99"], "--keep: the scene has no road user \"99\""),
        (&["--arrivals", "nowhere=10"], "--arrivals: "),
    ] {
        let told = ends(folder.path(), &[&["place", &scene], flags].concat(), 2).1;
        assert!(told.contains(expected), "{flags:?}: {told}");
    }
    let told = ends(folder.path(), &["convert", &scene, "--to", "netcdf"], 2).1;
    assert!(
        told.contains(": dragtraffic, womd, ")
            && told.contains("opendrive")
            && told.contains("can be written"),
        "{told}"
    );
    let told = ends(folder.path(), &["convert", &scene, "--from", "geojson"], 2).1;
    assert!(told.contains("can be read"), "{told}");
    let told = ends(folder.path(), &["convert", &scene, "--format", "csv"], 2).1;
    assert!(told.contains("--format is --to now"), "{told}");
    let told = ends(folder.path(), &["score", &scene, "--samples", "all"], 2).1;
    assert!(told.contains("--samples is --sample now"), "{told}");
    let told = ends(folder.path(), &["--port", "1", "score", &scene], 2).1;
    assert!(told.contains("--port is a flag of serve"), "{told}");
    assert!(names(folder.path()).is_empty());
}

#[test]
fn flags_stand_anywhere_and_swallow_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let generate = |flags: &[&str]| ends(folder.path(), flags, 0).1;
    let told = generate(&["-q", "generate", "--react", &scene, "--agents", "6", "-o", "deep/er/a.json"]);
    assert_eq!(told, "", "-q says nothing");
    let goal = "6=ahead:30,speed:8,time:6";
    let told = generate(&["generate", "--agents", "6", &scene, "--react", "--goal", goal, "-o", "b.json"]);
    assert!(told.contains("6: goal met at 6.0 s") && told.contains(" m/s at the end"), "{told}");
    let told = generate(&["generate", &scene, "--agents", "6", "--goal", "6=900,900", "-o", "c.json"]);
    assert!(told.contains("6: goal missed by") && told.contains("Too far for 9.0 s"), "{told}");
    let told =
        generate(&["generate", &scene, "--agents", "6", "--goal", "6=-40,8", "--react", "-o", "d.json"]);
    assert!(told.lines().any(|line| line.contains(" for 6, ") && !line.contains("6: goal")), "{told}");
    let told = generate(&["place", "--keep", &scene, "--count", "5", "-o", "placed.json"]);
    assert!(told.contains("placed"), "{told}");
    let only = json_of(&folder.path().join("deep/er/a.json"))["generated"]["samples"][0]["agents"].clone();
    assert!(only["6"].is_object());
}

#[test]
fn what_is_asked_of_single_road_users_is_in_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let flags = [
        "generate",
        &scene,
        "--agents",
        "6,11",
        "--size",
        "6=6x2.1",
        "--start",
        "6=speed:4",
        "--type",
        "6=vehicle",
        "--goal-from-log",
        "6,11",
        "--goal",
        "6=ahead:20",
        "-o",
        "a.json",
    ];
    ends(folder.path(), &flags, 0);
    let made = json_of(&folder.path().join("a.json"));
    let agent = |id: &str| {
        made["agents"].as_array().unwrap().iter().find(|agent| agent["id"] == id).unwrap()["conditions"]
            .clone()
    };
    let six = agent("6");
    assert_eq!((&six["length_m"], &six["width_m"]), (&json!(6.0), &json!(2.1)));
    assert_eq!((&six["start"]["speed_mps"], &six["type"]), (&json!(4.0), &json!("vehicle")));
    assert!(six["goal"]["x_m"].is_number() && six["goal"]["time_s"].is_null(), "its own goal: {six}");
    assert_eq!(agent("11")["goal"]["time_s"], json!(9.0), "the log's");
    // A further call about its size leaves its goal.
    ends(folder.path(), &["generate", "a.json", "--agents", "6", "--size", "6=5x2", "-o", "b.json"], 0);
    let again = json_of(&folder.path().join("b.json"));
    let conditions =
        &again["agents"].as_array().unwrap().iter().find(|agent| agent["id"] == "6").unwrap()["conditions"];
    assert_eq!((&conditions["goal"], &conditions["length_m"]), (&six["goal"], &json!(5.0)));
}

#[test]
fn equal_calls_give_equal_files_and_no_clock() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let made = |name: &str, epoch: Option<&str>| {
        let mut command = Command::new(program());
        command.args(["generate", &scene, "--agents", "6", "--seed", "3", "-o", name]).current_dir(&folder);
        epoch.map(|epoch| command.env("SOURCE_DATE_EPOCH", epoch));
        assert!(command.status().unwrap().success());
        std::fs::read(folder.path().join(name)).unwrap()
    };
    assert!(made("a.json", None) == made("b.json", None));
    assert!(json_of(&folder.path().join("a.json"))["generated"].get("created_at").is_none());
    assert!(made("c.json", Some("951782400")) == made("d.json", Some("951782400")));
    assert_eq!(json_of(&folder.path().join("c.json"))["generated"]["created_at"], "2000-02-29T00:00:00.000Z");
}

#[test]
fn many_files_have_one_verdict_each() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("in")).unwrap();
    for i in 0..6 {
        std::fs::write(at(&format!("in/s{i}.json")), street(2 + i, 91).to_string()).unwrap();
    }
    std::fs::write(at("in/README.md"), "no scene").unwrap();
    // Results come in the order of the files.
    let (text, _) = ends(folder.path(), &["score", "in/*.json", "-j", "3"], 0);
    let files: Vec<&str> = text.lines().map(|line| line.split(':').next().unwrap()).collect();
    assert_eq!(files, ["in/s0.json", "in/s1.json", "in/s2.json", "in/s3.json", "in/s4.json", "in/s5.json"]);
    // Folder to folder, folder to one file, and back.
    let told = ends(folder.path(), &["convert", "in", "--to", "waymo", "-o", "out/"], 0).1;
    assert_eq!(told.lines().filter(|line| line.contains("in/s")).count(), 6, "{told}");
    assert_eq!(names(&at("out")).len(), 6);
    ends(folder.path(), &["-q", "export", "in", "--to", "womd", "-o", "all.tfrecord"], 0);
    ends(folder.path(), &["-q", "import", "all.tfrecord", "-o", "back/"], 0);
    let (text, _) = ends(folder.path(), &["score", "all.tfrecord"], 0);
    assert_eq!(text.lines().count(), 6);
    ends(folder.path(), &["convert", "in", "-o", "one.json"], 2);
    ends(folder.path(), &["convert", "all.tfrecord", "-o", "one.json"], 2);
    assert!(!at("one.json").exists());
    let (csv, told) = ends(folder.path(), &["convert", "in", "--to", "csv"], 0);
    assert_eq!(csv.lines().count(), 1 + 91 * (2 + 3 + 4 + 5 + 6 + 7));
    assert!(
        told.contains("not in csv: no-licence, no-map, no-timing") && told.lines().count() == 1,
        "{told}"
    );
    assert_eq!(ends(folder.path(), &["-q", "convert", "in", "--to", "csv", "-o", "t.csv"], 0).1, "");
    assert_eq!(std::fs::read_to_string(at("t.csv")).unwrap(), csv);
    // One bad file fails alone, and the message names it.
    std::fs::write(at("in/bad.json"), "{").unwrap();
    let (text, told) = ends(folder.path(), &["score", "in", "--csv", "scores.csv"], 4);
    assert!(
        text.lines().count() == 6 && told.contains("in/bad.json") && told.contains("1 of 7 files failed"),
        "{told}"
    );
    assert_eq!(table(&std::fs::read_to_string(at("scores.csv")).unwrap()).len(), 6);
    let told = ends(folder.path(), &["convert", "in", "--to", "womd", "-o", "out2/"], 4).1;
    assert!(told.contains("1 of 7 files failed"), "{told}");
    ends(folder.path(), &["score", "in/bad.json"], 3);
    ends(folder.path(), &["score", "nothing/*.json"], 3);
    // A road user that some scenes lack.
    let told =
        ends(folder.path(), &["generate", "in/s*.json", "--agents", "3", "--seeds", "2", "-o", "gen/"], 4).1;
    assert!(told.contains("s1, seed 0: --agents: the scene has no road user \"3\""), "{told}");
    assert_eq!(names(&at("gen")).len(), 1 + 2 * 4, "{told}");
    ends(folder.path(), &["generate", "in/s5.json", "--seeds", "2", "-o", "gen/"], 8);
    let place =
        ends(folder.path(), &["place", "in/s0.json", "in/s1.json", "--count", "2", "-o", "placed/"], 0).1;
    assert!(place.contains("placed/s1.json"), "{place}");
}

#[test]
fn a_goal_says_who_is_regenerated_and_ranges_have_both_ends() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let asked = |path: &str| json_of(&folder.path().join(path))["generated"]["request"]["agents"].clone();
    ends(folder.path(), &["generate", &scene, "--goal", "6=-40,8", "-o", "goal.json"], 0);
    assert_eq!(asked("goal.json"), json!(["6"]));
    let all = ["generate", &scene, "--agents", "@all", "--goal", "6=-40,8", "-o", "all.json"];
    ends(folder.path(), &all, 0);
    assert_eq!(asked("all.json"), json!("all"));
    let seeds = ["generate", &scene, "--goal", "6=-40,8", "--seeds", "4..5", "-o", "seeds/"];
    ends(folder.path(), &seeds, 0);
    let made = names(&folder.path().join("seeds"));
    assert_eq!(made, ["demo-crossing-seed004.json", "demo-crossing-seed005.json", "manifest.csv"]);
}

#[test]
fn samples_are_scored_picked_and_copied() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let generate =
        ["generate", &scene, "--agents", "6", "--samples", "4", "--diversity", "1.5", "-o", "a.json"];
    ends(folder.path(), &generate, 0);
    let lines =
        |flags: &[&str]| ends(folder.path(), &[&["score", "a.json"], flags].concat(), 0).0.lines().count();
    assert_eq!((lines(&[]), lines(&["--sample", "all"]), lines(&["--sample", "1..2"])), (1, 4, 2));
    let told = ends(folder.path(), &["score", "a.json", "--sample", "7"], 2).1;
    assert!(told.contains("a.json: no sample 7; the scene has 4 samples, numbers 0 to 3"), "{told}");
    let told = ends(folder.path(), &["score", &scene, "--sample", "0"], 2).1;
    assert!(told.contains("no sample 0; the scene has no samples"), "{told}");
    let all = ["--sample", "all"];
    let low = lines(&[&all[..], &["--where", "min_ttc_s < 1"]].concat());
    assert_eq!(low + lines(&[&all[..], &["--where", "!(min_ttc_s < 1)"]].concat()), 4);
    let flags =
        ["score", "a.json", "--sample", "2", "--where", "road_users > 1", "--copy-to", "kept", "--csv", "-"];
    let (csv, _) = ends(folder.path(), &flags, 0);
    let rows = table(&csv);
    assert_eq!((rows.len(), rows[0]["sample"].as_str(), rows[0]["actor"].as_str()), (1, "2", "6"));
    assert_eq!(json_of(&folder.path().join("kept/a-sample002.json"))["generated"]["chosen_sample"], 2);
    ends(folder.path(), &flags, 8);
    // Samples for which the condition does not hold are not written.
    let flags = ["generate", &scene, "--agents", "6", "--where", "road_users < 0", "-o", "none.json"];
    let told = ends(folder.path(), &flags, 4).1;
    assert!(
        told.contains("no sample of 1 holds road_users < 0") && !folder.path().join("none.json").exists(),
        "{told}"
    );
    let strict = ["generate", &scene, "--where", "road_users < 0", "--seeds", "2", "-o", "many/"];
    let told = ends(folder.path(), &strict, 4).1;
    assert!(told.contains("0 of 2 hold road_users < 0") && told.contains("no result was kept"), "{told}");
    ends(folder.path(), &[&strict[..], &["--strict", "--force"]].concat(), 4);
}

/// Ten road users are listed, the rest with `--verbose`.
#[test]
fn long_lists_are_cut() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let lines = |flags: &[&str]| {
        let told =
            ends(folder.path(), &[&["generate", &scene, "--force", "-o", "a.json"], flags].concat(), 0).1;
        told.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let all = lines(&["--verbose"]);
    let road_users = json_of(&folder.path().join("a.json"))["generated"]["samples"][0]["agents"].clone();
    let count = road_users.as_object().unwrap().len();
    assert!(count > 12 && all.len() > count, "{all:?}");
    let short = lines(&["--goal", "4=2,27.5", "--agents", "@all"]);
    let rest = format!("{} more road users; --verbose lists them", count - 10);
    assert!(short.iter().any(|line| line.ends_with(&rest)) && short.len() < 16, "{short:?}");
    assert!(short[0].starts_with("dragtraffic: 4: goal met"), "what was asked for comes first: {short:?}");
    // A file that many formats cannot hold.
    let export = |flags: &[&str]| {
        let convert = ["convert", "a.json", "--to", "nocturne", "--force", "-o", "b.json"];
        ends(folder.path(), &[&convert, flags].concat(), 0).1
    };
    let (cut, whole) = (export(&[]), export(&["-v"]));
    assert!(whole.lines().count() > 10, "{whole}");
    assert!(cut.lines().count() == 11 && cut.contains("more losses; --verbose lists them"), "{cut}");
    assert_eq!(export(&["-q"]), "");
}

/// A terminal shows a summary; a pipe, a file and `--json` get the same bytes.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_shows_no_document() {
    let folder = tempfile::tempdir().unwrap();
    let scene = demo("demo-crossing");
    let program = program().display();
    let on_terminal = |arguments: &str| {
        let call = format!("{program} -q {arguments}");
        let shown = Command::new("script").args(["-qec", &call, "/dev/null"]).output().unwrap();
        assert!(shown.status.success(), "{call}");
        String::from_utf8(shown.stdout).unwrap().replace("\r\n", "\n")
    };
    for (call, hint) in [
        (format!("generate {scene} --agents 6"), "kB of JSON: --output FILE writes them, --json prints them"),
        (format!("place {scene} --count 3"), "kB of JSON: --output FILE writes them, --json prints them"),
        ("map --template curve".to_owned(), "kB of JSON: --output FILE writes them, --json prints them"),
        (format!("convert {scene} --to csv"), "kB: --output FILE writes them, --output - prints them"),
    ] {
        let shown = on_terminal(&call);
        assert!(shown.lines().count() == 1 && shown.trim_end().ends_with(hint), "{call}: {shown}");
        let whole = if call.starts_with("convert") { " -o -" } else { " --json" };
        let arguments: Vec<&str> = call.split(' ').collect();
        let (piped, _) = ends(folder.path(), &arguments, 0);
        assert!(on_terminal(&format!("{call}{whole}")) == piped, "{call}");
        let flagged: Vec<&str> = arguments.into_iter().chain(whole.split_whitespace()).collect();
        assert!(ends(folder.path(), &flagged, 0).0 == piped, "{call}");
    }
}

#[test]
fn completions_and_manual_pages_know_every_command() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (text, _) = ends(folder.path(), &["completions", shell], 0);
        for word in ["generate", "goal-from-log", "template", "convert"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    let (bash, _) = ends(folder.path(), &["completions", "bash"], 0);
    std::fs::write(folder.path().join("c.bash"), bash).unwrap();
    let checked = Command::new("bash").args(["-n", "c.bash"]).current_dir(&folder).status();
    assert!(checked.is_ok_and(|status| status.success()));
    let (page, _) = ends(folder.path(), &["man"], 0);
    assert!(page.contains(".TH DRAGTRAFFIC 1") && page.contains("Exit codes"), "{page}");
    ends(folder.path(), &["man", "-o", "man/"], 0);
    let pages = names(&folder.path().join("man"));
    assert!(pages.len() > 15 && pages.contains(&"dragtraffic-generate.1".to_owned()), "{pages:?}");
    let page = std::fs::read_to_string(folder.path().join("man/dragtraffic-generate.1")).unwrap();
    assert!(page.contains("goal") && page.contains("Examples"));
    ends(folder.path(), &["man", "-o", "man/"], 8);
}
