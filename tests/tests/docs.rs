//! Checks the documentation: its sizes, its links, the sections that a command prints, and every command that
//! it shows. With `DOCS_ACCEPT=1`, sections and shown outputs are rewritten. `python/tests/test_docs.py` runs
//! the Python blocks.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::Server;
use dragtraffic_tests::markdown::{Block, Page, Section, pages};
use dragtraffic_tests::program::{program, root};
use serde_json::Value;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::File;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Greatest size of the pages that must stay short, bytes.
const SIZES: [(&str, usize); 3] =
    [("README.md", 10_240), ("ARCHITECTURE.md", 6_144), ("CONTRIBUTING.md", 8_192)];
/// Languages of blocks: the first three are run.
const LANGUAGES: [&str; 9] = ["sh", "js", "python", "json", "text", "rust", "toml", "nginx", "yaml"];
/// Blocks that no test runs, each with its reason. This number may only change by a decision.
const NORUN: usize = 38;
/// Address of the server in the examples.
const ADDRESS: &str = "127.0.0.1:8080";
/// Time of a block before it counts as hanging.
const LIMIT: Duration = Duration::from_secs(120);

/// A part of a page and its expected text.
type Due = (Range<usize>, String);

fn accepts() -> bool {
    std::env::var_os("DOCS_ACCEPT").is_some()
}

/// Fails with these lines, if there are any.
fn none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn short_pages_stay_short() {
    for (path, most) in SIZES {
        let size = std::fs::metadata(root().join(path)).unwrap().len();
        assert!(size <= most as u64, "{path} has {size} bytes, at most {most} are allowed");
    }
}

#[test]
fn links_and_anchors_resolve() {
    let pages = pages().unwrap();
    let mut wrong = Vec::new();
    for page in &pages {
        for (line, link) in page.links() {
            if let Some(why) = page.broken(&link, &pages) {
                wrong.push(format!("{}:{line}: {link}: {why}", page.path));
            }
        }
    }
    none(&wrong);
}

#[test]
fn every_block_has_a_language_and_is_run_or_says_why_not() {
    let (mut wrong, mut norun) = (Vec::new(), 0);
    for page in pages().unwrap() {
        for block in page.blocks() {
            let place = format!("{}:{}", page.path, block.line);
            if !LANGUAGES.contains(&block.language.as_str()) {
                wrong.push(format!("{place}: the language is \"{}\"", block.language));
            }
            if let Some(reason) = &block.norun {
                norun += 1;
                if reason.len() < 10 {
                    wrong.push(format!("{place}: norun without a reason"));
                }
            }
            let body = &page.text[block.body.clone()];
            if block.language == "json" && serde_json::from_str::<Value>(body).is_err() {
                wrong.push(format!("{place}: this is no JSON"));
            }
        }
    }
    none(&wrong);
    assert_eq!(norun, NORUN, "blocks tagged norun");
}

/// Runs every block of every page in the order of the page, in a folder with the example scenes, and the
/// command of each generated section.
#[cfg(unix)]
#[test]
fn commands_run_and_print_what_the_pages_show() {
    let pages = pages().unwrap();
    let played: Vec<(&Page, Played)> = std::thread::scope(|scope| {
        let running: Vec<_> = pages.iter().map(|page| (page, scope.spawn(|| play(page)))).collect();
        running.into_iter().map(|(page, thread)| (page, thread.join().unwrap())).collect()
    });
    let ran: usize = played.iter().map(|(_, played)| played.ran).sum();
    assert!(ran >= 12, "{ran} blocks were run");
    let mut sections = 0;
    let mut wrong = Vec::new();
    for (page, Played { wrong: failed, mut due, .. }) in played {
        let generated = page.sections();
        sections += generated.len();
        due.extend(generated.iter().map(|section| (section.content.clone(), printed(section))));
        wrong.extend(failed);
        wrong.extend(settle(page, due));
    }
    assert!(sections >= 6, "{sections} generated sections were found");
    none(&wrong);
}

/// Writes the expected text into the page if requested; otherwise reports where the page differs.
fn settle(page: &Page, mut due: Vec<Due>) -> Vec<String> {
    due.retain(|(place, text)| page.text[place.clone()] != *text);
    if !accepts() {
        return due.iter().map(|due| difference(page, due)).collect();
    }
    due.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
    let mut text = page.text.clone();
    for (place, new) in &due {
        text.replace_range(place.clone(), new);
    }
    if !due.is_empty() {
        std::fs::write(root().join(&page.path), text).unwrap();
    }
    Vec::new()
}

/// The first line in which a page differs from the output.
fn difference(page: &Page, (place, new): &Due) -> String {
    let old = &page.text[place.clone()];
    let line = page.text[..place.start].matches('\n').count() + 1;
    let differs = old.lines().zip(new.lines()).enumerate().find(|(_, (old, new))| old != new);
    let (down, (old, new)) = differs.unwrap_or((0, (old.trim_end(), new.trim_end())));
    let path = &page.path;
    format!("{path}:{}: the page shows\n  {old}\nand the program prints\n  {new}", line + down)
}

/// Results of a page's blocks.
#[derive(Default)]
struct Played {
    ran: usize,
    wrong: Vec<String>,
    /// Expected text blocks after commands.
    due: Vec<Due>,
}

fn play(page: &Page) -> Played {
    let blocks = page.blocks();
    let runs = |block: &Block| block.norun.is_none() && matches!(block.language.as_str(), "sh" | "js");
    let mut played = Played::default();
    if !blocks.iter().any(runs) {
        return played;
    }
    let folder = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(root().join("assets"), folder.path().join("assets")).unwrap();
    let server: OnceCell<Server> = OnceCell::new();
    for (index, block) in blocks.iter().enumerate().filter(|(_, block)| runs(block)) {
        let mut body = page.text[block.body.clone()].to_owned();
        if body.contains(ADDRESS) {
            let server = server.get_or_init(|| Server::with_demos().unwrap());
            body = body.replace(ADDRESS, &server.address.to_string());
        }
        let command = command_of(block, &body, folder.path());
        let (ended, output) = run(command, folder.path());
        played.ran += 1;
        if !ended {
            played.wrong.push(format!("{}:{}: failed\n{output}", page.path, block.line));
            continue;
        }
        let shown = blocks.get(index + 1).filter(|next| {
            let between = &page.text[block.body.end..next.body.start];
            next.language == "text" && between.lines().all(|line| line.is_empty() || line.starts_with("```"))
        });
        if let Some(shown) = shown {
            played.due.push((shown.body.clone(), output));
        }
    }
    played
}

/// Command that runs a block.
fn command_of(block: &Block, body: &str, folder: &Path) -> Command {
    if block.language == "sh" {
        let mut command = Command::new("sh");
        command.args(["-e", "-c", body]);
        return command;
    }
    let file = folder.join("block.mjs");
    std::fs::write(&file, body).unwrap();
    let mut command = Command::new("node");
    // A page has WebSockets; Node.js has them without the flag since 22.
    command.arg("--experimental-websocket").arg(file);
    command
}

/// Runs a command in a folder with the program on its path; returns whether it succeeded, and its output.
fn run(mut command: Command, folder: &Path) -> (bool, String) {
    let path = format!("{}:{}", program().parent().unwrap().display(), std::env::var("PATH").unwrap());
    let printed = folder.join("printed");
    let out = File::create(&printed).unwrap();
    let mut child = command
        .current_dir(folder)
        .env("PATH", path)
        .stdin(Stdio::null())
        .stdout(out.try_clone().unwrap())
        .stderr(out)
        .spawn()
        .unwrap();
    let began = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break Some(status);
        }
        if began.elapsed() > LIMIT {
            child.kill().unwrap();
            child.wait().unwrap();
            break None;
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    (status.is_some_and(|status| status.success()), std::fs::read_to_string(printed).unwrap())
}

/// Output of a section's command, in the form of the page.
fn printed(section: &Section) -> String {
    // Settings from the environment appear in the help, so the test removes them.
    let mut command = Command::new(program());
    for (name, _) in std::env::vars_os() {
        if name.to_string_lossy().starts_with("DRAGTRAFFIC_") {
            command.env_remove(name);
        }
    }
    let output = command.args(&section.arguments).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{:?}", section.arguments);
    let json = || serde_json::from_str::<Value>(&text).unwrap();
    match section.form.as_deref() {
        None => text,
        Some("commands") => commands(&text),
        Some("exit codes") => exit_codes(&text),
        Some("thresholds") => thresholds(&json()["thresholds"]),
        Some("motion limits") => motion_limits(&json()["limits"]),
        Some("limits") => limits(&json()),
        Some(form) => panic!("no form is named {form}"),
    }
}

/// A table in Markdown.
fn table(heading: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = format!("| {} |\n|{}\n", heading.join(" | "), "---|".repeat(heading.len()));
    for row in rows {
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// The commands of the help.
fn commands(help: &str) -> String {
    let (_, rest) = help.split_once("Commands:\n").unwrap();
    let rows = rest.lines().take_while(|line| line.starts_with("  ")).filter_map(|line| {
        let (name, task) = line.trim().split_once("  ")?;
        (name != "help").then(|| vec![format!("`{name}`"), task.trim().to_owned()])
    });
    table(&["command", "task"], rows)
}

/// The exit codes of the help.
fn exit_codes(help: &str) -> String {
    let (_, rest) = help.split_once("Exit codes:\n").unwrap();
    let lines = rest.lines().take_while(|line| line.starts_with("  "));
    let codes = lines.flat_map(|line| line.trim().split("   "));
    table(
        &["code", "meaning"],
        codes.map(|code| {
            let (number, meaning) = code.trim().split_once(' ').unwrap();
            vec![number.to_owned(), meaning.to_owned()]
        }),
    )
}

fn thresholds(all: &Value) -> String {
    let row = |(name, value): (&String, &Value)| {
        let range = &value["range"];
        vec![
            format!("`{name}`"),
            number(&value["usual"]),
            format!("{} to {}", number(&range[0]), number(&range[1])),
        ]
    };
    table(&["threshold", "default", "range"], members(all).into_iter().map(row))
}

fn motion_limits(all: &Value) -> String {
    let columns = ["accel_mps2", "brake_mps2", "lateral_mps2", "curvature_per_m", "speed_mps"];
    let manner = |limits: &Value| {
        ["accel_mps2", "brake_mps2", "lateral_mps2"].map(|column| number(&limits[column])).join(" / ")
    };
    let heading = [
        "type",
        "acceleration, m/s²",
        "braking, m/s²",
        "lateral, m/s²",
        "curvature, 1/m",
        "speed, m/s",
        "comfortable: acceleration / braking / lateral, m/s²",
        "hurried",
    ];
    let row = |(name, limits): (&String, &Value)| {
        let cells = columns.iter().map(|column| number(&limits[column]));
        let manners = ["comfortable", "hurried"].map(|name| manner(&limits[name]));
        std::iter::once(name.clone()).chain(cells).chain(manners).collect()
    };
    table(&heading, members(all).into_iter().map(row))
}

fn limits(all: &Value) -> String {
    let row = |(name, limit): (&String, &Value)| {
        vec![format!("`{name}`"), number(&limit["value"]), limit["what"].as_str().unwrap().to_owned()]
    };
    table(&["limit", "default", "meaning"], members(all).into_iter().map(row))
}

/// Members of an object, sorted by name.
fn members(object: &Value) -> BTreeMap<&String, &Value> {
    object.as_object().unwrap().iter().collect()
}

/// A number with at most three decimals; nothing for null.
fn number(value: &Value) -> String {
    let Some(number) = value.as_f64() else { return "-".into() };
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
