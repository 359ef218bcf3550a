//! `checkers`: foreign programs read our files. Each script of `tests/checkers` names the packages that it
//! needs (PEP 723, and under `[tool.dragtraffic]` those to install without dependencies). It receives the
//! program and a folder to work in, and prints `N passed, N failed` as its last line.

use crate::environments::Environment;
use crate::{Outcome, program, root};
use anyhow::{Context, ensure};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

const SCRIPTS: &str = "tests/checkers";
/// With this set, a script without its packages fails instead of being skipped.
pub static STRICT: AtomicBool = AtomicBool::new(false);

/// All scripts, each in an environment of its own.
pub fn check() -> anyhow::Result<Outcome> {
    let program = program()?;
    let (mut told, mut skipped, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for script in scripts()? {
        let name = name_of(&script);
        match environment(&script)?.python()? {
            Ok(python) => match run(&python, &script, &program, &name)? {
                Ok(line) => told.push(format!("{name}: {line}")),
                Err(line) => failed.push(format!("{name}: {line}")),
            },
            Err(why) => skipped.push(format!("{name}: {why}")),
        }
    }
    if STRICT.load(Ordering::Relaxed) {
        failed.append(&mut skipped);
    }
    if !failed.is_empty() {
        return Ok(Outcome::Failed(failed.join("; ")));
    }
    if told.is_empty() {
        return Ok(Outcome::Skipped(skipped.join("; ")));
    }
    told.extend(skipped.into_iter().map(|why| format!("skipped {why}")));
    Ok(Outcome::Told(told.join("; ")))
}

/// Strings of a list in the metadata of a script.
fn list(text: &str, name: &str) -> Vec<String> {
    let head: Vec<&str> = text.lines().map_while(|line| line.strip_prefix('#')).map(str::trim).collect();
    let head = head.join("\n");
    let Some((_, rest)) = head.split_once(&format!("\n{name} = [")) else { return Vec::new() };
    // Between quotes a bracket is part of a name, such as `moto[server]`.
    let (mut parts, mut names) = (rest.split('"'), Vec::new());
    while parts.next().is_some_and(|between| !between.contains(']')) {
        names.extend(parts.next().map(str::to_owned));
    }
    names
}

/// The scripts, by name.
fn scripts() -> anyhow::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(root().join(SCRIPTS)).context(SCRIPTS)?;
    let mut scripts: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    scripts.retain(|path| path.extension().is_some_and(|end| end == "py"));
    scripts.sort();
    ensure!(!scripts.is_empty(), "no script in {SCRIPTS}");
    Ok(scripts)
}

fn name_of(script: &Path) -> String {
    script.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// With the packages that a script names.
fn environment(script: &Path) -> anyhow::Result<Environment> {
    let text = std::fs::read_to_string(script)?;
    let (with, without) = (list(&text, "dependencies"), list(&text, "no-deps"));
    Ok(Environment::of_script(&name_of(script), with, without))
}

/// Those of all scripts.
///
/// # Errors
/// When the scripts cannot be read.
pub fn environments() -> anyhow::Result<Vec<anyhow::Result<Environment>>> {
    Ok(scripts()?.iter().map(|script| environment(script)).collect())
}

/// The last line of a script, as a success or a failure.
fn run(python: &Path, script: &Path, program: &Path, name: &str) -> anyhow::Result<Result<String, String>> {
    let folder = root().join("target/checkers").join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let output = Command::new(python)
        .arg(script)
        .args([program, &folder])
        .current_dir(root())
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| script.display().to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    print!("{text}");
    let line = text.lines().last().unwrap_or("said nothing").to_owned();
    // A script that checks nothing has not passed.
    let passed = output.status.success() && line.ends_with(" 0 failed") && !line.starts_with("0 passed");
    Ok(if passed { Ok(line) } else { Err(line) })
}
