//! `checkers`: other programs read our files. Each script of `tests/checkers` names its packages (PEP 723),
//! and under `[tool.dragtraffic]` those to install without dependencies, and programs that no package
//! contains. It receives the program and a working folder, and prints `N passed, N failed` as its last line.

use crate::environments::Environment;
use crate::system::SystemProgram;
use crate::{Outcome, program, root};
use anyhow::{Context, ensure};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

const SCRIPTS: &str = "tests/checkers";
/// Programs that a script may name as `programs`; their variables pass their paths to it.
const PROGRAMS: &[SystemProgram] =
    &[SystemProgram { variable: "ESMINI", names: &["esmini", BUILT_ESMINI], package: None }];
/// Output of `support/build_esmini.py`: no registry has this program.
const BUILT_ESMINI: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/esmini/bin/esmini");
/// With this set, a script without its packages or programs fails instead of being skipped.
pub static STRICT: AtomicBool = AtomicBool::new(false);

/// Runs all scripts, each in its own environment.
pub fn check() -> anyhow::Result<Outcome> {
    let program = program()?;
    let (mut told, mut skipped, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for script in scripts()? {
        let name = name_of(&script);
        let needed = match programs(&script)? {
            Ok(programs) => environment(&script)?.python()?.map(|python| (python, programs)),
            Err(why) => Err(why),
        };
        match needed {
            Ok((python, programs)) => match run(&python, &script, &program, &name, &programs)? {
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

/// The environment with the packages that a script names.
fn environment(script: &Path) -> anyhow::Result<Environment> {
    let text = std::fs::read_to_string(script)?;
    let (with, without) = (list(&text, "dependencies"), list(&text, "no-deps"));
    Ok(Environment::of_script(&name_of(script), with, without))
}

/// Variables and paths of the programs that a script names, or the name of a missing one.
fn programs(script: &Path) -> anyhow::Result<Result<Vec<(&'static str, String)>, String>> {
    let text = std::fs::read_to_string(script)?;
    let mut places = Vec::new();
    for name in list(&text, "programs") {
        let known = PROGRAMS.iter().find(|program| program.names.contains(&name.as_str()));
        let known = known.with_context(|| format!("{}: no program is called {name}", script.display()))?;
        match known.find()? {
            Some(place) => places.push((known.variable, place)),
            None => {
                return Ok(Err(format!(
                    "{name} is not on the path, {} does not name it, and {SCRIPTS}/support has not built it",
                    known.variable
                )));
            }
        }
    }
    Ok(Ok(places))
}

/// The environments of all scripts.
///
/// # Errors
/// When the scripts cannot be read.
pub fn environments() -> anyhow::Result<Vec<anyhow::Result<Environment>>> {
    Ok(scripts()?.iter().map(|script| environment(script)).collect())
}

/// The last line of a script, as a success or a failure.
fn run(
    python: &Path,
    script: &Path,
    program: &Path,
    name: &str,
    programs: &[(&str, String)],
) -> anyhow::Result<Result<String, String>> {
    let folder = root().join("target/checkers").join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let output = Command::new(python)
        .arg(script)
        .args([program, &folder])
        .envs(programs.iter().map(|(variable, place)| (variable, place)))
        .current_dir(root())
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| script.display().to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    print!("{text}");
    let line = text.lines().last().unwrap_or("said nothing").to_owned();
    // A script without checks has not passed.
    let passed = output.status.success() && line.ends_with(" 0 failed") && !line.starts_with("0 passed");
    Ok(if passed { Ok(line) } else { Err(line) })
}
