//! `imports [FORMAT…] [--megabytes 10]`: time and memory that readers take for a file of about that size in
//! each format. `cargo xtask imports` builds and runs it.
//!
//! Files are written by the formats' own writers, from repeated copies of a demo scene. A format without a
//! writer reads the largest file of its corpus. Each file is read in its own process.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to people")]

use anyhow::{Context, bail, ensure};
use dragtraffic_tests::program::{peak_memory_mb, root};
use formats::{ExportOptions, Format, ImportOptions, registry};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

const DEMO: &str = "assets/scenes/demo-crossing.json";
/// Distance between copies, metres, and the number of copies in a row.
const APART_M: f64 = 300.0;
const ABREAST: usize = 6;
/// Scenes of increasing size: copies of the map and its road users, and steps.
const SIZES: [(usize, usize); 8] =
    [(1, 91), (4, 91), (9, 91), (9, 300), (9, 600), (16, 600), (25, 600), (36, 600)];
/// Most road users of a scene, and most copies of one road user in a file.
const MOST: (usize, usize) = (256, 190);
/// A file is large enough from this share of the requested size.
const ENOUGH: f64 = 0.8;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> anyhow::Result<()> {
    if let [inside, id, path] = arguments
        && inside == "--inside"
    {
        return inside_of(id, Path::new(path));
    }
    let (mut names, mut megabytes) = (Vec::new(), 10.0);
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--megabytes" => {
                let number = arguments.next().and_then(|text| text.parse().ok());
                megabytes = number.context("--megabytes takes a number")?;
            }
            name if registry::by_id(name).is_some_and(|format| format.info().import) => names.push(name),
            other => bail!("no format that is read is called {other}"),
        }
    }
    let folder = root().join("target/imports");
    std::fs::create_dir_all(&folder)?;
    println!("{:<14} {:>8} {:>7} {:>9} {:>8} {:>8}  file", "format", "MB", "scenes", "ms", "MB/s", "peak MB");
    for format in registry::FORMATS.iter().filter(|format| format.info().import) {
        let id = format.info().id;
        if !names.is_empty() && !names.contains(&id) {
            continue;
        }
        match file_of(*format, megabytes * 1e6, &folder)? {
            Some((path, what)) => tell(id, &path, &what)?,
            None => println!("{id:<14} no writer and no file of its own"),
        }
    }
    Ok(())
}

/// Reads a file in its own process.
fn tell(id: &str, path: &Path, what: &str) -> anyhow::Result<()> {
    let output = Command::new(std::env::current_exe()?).args(["--inside", id]).arg(path).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let figures: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [scenes, seconds, peak_mb] = figures[..] else {
        println!("{id:<14} {}", String::from_utf8_lossy(&output.stderr).trim());
        return Ok(());
    };
    let megabytes = std::fs::metadata(path)?.len() as f64 / 1e6;
    println!(
        "{id:<14} {megabytes:>8.2} {scenes:>7} {:>9.1} {:>8.1} {peak_mb:>8}  {what}",
        seconds * 1e3,
        megabytes / seconds
    );
    Ok(())
}

/// Reads one file in this process: prints scenes, seconds, and the peak memory in MB.
fn inside_of(id: &str, path: &Path) -> anyhow::Result<()> {
    let format = registry::by_id(id).with_context(|| format!("no format is called {id}"))?;
    let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
    let start = Instant::now();
    let mut count = 0;
    for scene in format.scenes(&bytes, &ImportOptions::default()) {
        scene.map_err(|error| anyhow::anyhow!("{error}"))?;
        count += 1;
    }
    ensure!(count > 0, "nothing was read");
    println!("{count} {} {}", start.elapsed().as_secs_f64(), peak_memory_mb("self").unwrap_or_default());
    Ok(())
}

/// A file of about `bytes` bytes, with a description.
fn file_of(format: &dyn Format, bytes: f64, folder: &Path) -> anyhow::Result<Option<(PathBuf, String)>> {
    let info = format.info();
    if !info.export {
        let corpus = root().join("fuzz/corpus").join(info.id);
        let mut files: Vec<(u64, PathBuf)> = Vec::new();
        for entry in std::fs::read_dir(corpus).into_iter().flatten() {
            let entry = entry?;
            let reads = format.import(&std::fs::read(entry.path())?, &ImportOptions::default());
            if reads.first().is_some_and(Result::is_ok) {
                files.push((entry.metadata()?.len(), entry.path()));
            }
        }
        let found = files.into_iter().max();
        return Ok(found.map(|(_, path)| (path, "of the fuzz corpus: there is no writer".into())));
    }
    let demo: Value = serde_json::from_slice(&std::fs::read(root().join(DEMO))?)?;
    let mut best: Option<(Vec<u8>, String)> = None;
    for (copies, steps) in SIZES {
        let text = serde_json::to_vec(&laid_out(&demo, copies, steps))?;
        let scene = registry::import(&text, "", "dragtraffic", &ImportOptions::default())?.remove(0);
        let (scene, _) = scene.map_err(|error| anyhow::anyhow!("{copies} copies: {error}"))?;
        let Ok(one) = format.export(&[&scene], &ExportOptions::default()) else { break };
        let count = (bytes / one.bytes.len() as f64).round().clamp(1.0, MOST.1 as f64) as usize;
        let many = if info.many && count > 1 {
            let labels = vec![&scene; count];
            format.export(&labels, &ExportOptions::default()).ok().map(|file| (file.bytes, count))
        } else {
            None
        };
        let (file, scenes) = many.unwrap_or((one.bytes, 1));
        // Files beyond a reader's limits are out of scope.
        if format.import(&file, &ImportOptions { max_scenes: 1, ..ImportOptions::default() })[0].is_err() {
            break;
        }
        let enough = file.len() as f64 >= ENOUGH * bytes;
        let what = format!("{copies} copies of the demo, {steps} steps, {scenes} times");
        best = Some((file, what));
        if enough {
            break;
        }
    }
    let Some((file, what)) = best else { return Ok(None) };
    let path = folder.join(format!("{}.{}", info.id, info.extensions[0]));
    std::fs::write(&path, file)?;
    Ok(Some((path, what)))
}

/// Copies of the scene side by side, with motion of `steps` steps, alternately forwards and backwards.
fn laid_out(demo: &Value, copies: usize, steps: usize) -> Value {
    let mut scene = demo.clone();
    scene["generated"] = Value::Null;
    scene["time"]["steps"] = json!(steps);
    let (mut map, mut signals, mut agents) = (json!({}), Vec::new(), Vec::new());
    for copy in 0..copies {
        let shift = [(copy % ABREAST) as f64 * APART_M, (copy / ABREAST) as f64 * APART_M];
        let mut part = demo["map"].clone();
        moved(&mut part, copy, shift);
        for (name, list) in part.as_object().into_iter().flatten() {
            let all = map.as_object_mut().map(|map| map.entry(name.clone()).or_insert_with(|| json!([])));
            if let (Some(Value::Array(all)), Some(list)) = (all, list.as_array()) {
                all.extend(list.iter().cloned());
            }
        }
        let mut lights = demo["signals"].clone();
        moved(&mut lights, copy, shift);
        signals.extend(lights.as_array().into_iter().flatten().cloned());
        for agent in demo["agents"].as_array().into_iter().flatten() {
            agents.extend(driven(agent, copy, shift, steps));
        }
    }
    agents.truncate(MOST.0);
    signals.truncate(512);
    (scene["map"], scene["signals"], scene["agents"]) = (map, json!(signals), json!(agents));
    scene
}

/// Moves points and renames ids at any depth.
fn moved(value: &mut Value, copy: usize, shift: [f64; 2]) {
    match value {
        Value::Array(list) if list.len() == 2 && list.iter().all(Value::is_number) => {
            for (number, by) in list.iter_mut().zip(shift) {
                *number = json!(number.as_f64().unwrap_or_default() + by);
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| match value {
            Value::String(id) => *id = format!("{copy}-{id}"),
            other => moved(other, copy, shift),
        }),
        Value::Object(members) => {
            for (name, value) in members {
                match (name.as_str(), &mut *value) {
                    ("id" | "lane" | "line", Value::String(id)) => *id = format!("{copy}-{id}"),
                    // Ranges and runs are not points.
                    ("self" | "other" | "states", _) => {}
                    _ => moved(value, copy, shift),
                }
            }
        }
        _ => {}
    }
}

/// A copy of a road user that is seen all the time, moved and extended; `None` for all others.
fn driven(agent: &Value, copy: usize, shift: [f64; 2], steps: usize) -> Option<Value> {
    let mut agent = agent.clone();
    let count = agent["track"]["x_m"].as_array()?.len();
    if agent["track"]["valid"] != json!([[0, count]]) || count < 2 {
        return None;
    }
    agent["id"] = json!(format!("{copy}-{}", agent["id"].as_str()?));
    agent["conditions"] = json!({});
    let track = agent["track"].as_object_mut()?;
    track.insert("valid".into(), json!([[0, steps]]));
    for (name, list) in track.iter_mut() {
        let by = match name.as_str() {
            "x_m" => shift[0],
            "y_m" => shift[1],
            _ => 0.0,
        };
        let Some(own) = list.as_array().filter(|list| list.len() == count && list[0].is_number()) else {
            continue;
        };
        let at = |step: usize| {
            let place = step % (2 * (count - 1));
            own[place.min(2 * (count - 1) - place)].as_f64().unwrap_or_default() + by
        };
        *list = json!((0..steps).map(at).collect::<Vec<f64>>());
    }
    Some(agent)
}
