//! `cargo xtask test`: sets up what the checks need and runs all of them.
//! `cargo xtask golden`: shows how the answers of the shipped weights differ from the golden ones.
//! `cargo xtask soak NAME`: trials that go on for as long as one likes.
//! `cargo xtask dependencies`: shows which crates came and went since the list of them was committed.
//! `cargo xtask fuzz`: readers and requests, with inputs that nobody thought of.
//! `cargo xtask imports`: how long readers take, and how much memory.
//! `cargo xtask schemathesis`: the API against its document, with many examples.
//!
//! `cargo xtask test NAME…` runs some. What is missing on this machine (a browser) is skipped with a
//! printed reason; a check that fails does not stop the others. With `--strict`, foreign checkers whose packages
//! cannot be had fail.

#![allow(clippy::print_stdout, reason = "it talks to people")]

mod advisories;
mod checkers;
mod dependencies;
mod environments;
mod figures;
mod fuzzing;
mod packages;
mod schemathesis;
mod soak;
mod suites;

use anyhow::{Context, bail};
use environments::Environment;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;

/// How a check ended.
enum Outcome {
    Passed,
    /// Passed, with something to tell.
    Told(String),
    Skipped(String),
    Failed(String),
}

type Check = (&'static str, fn() -> anyhow::Result<Outcome>);

/// In the order of what is found fastest.
const CHECKS: &[Check] = &[
    ("web-packages", web_packages),
    ("fmt", || cargo(&["fmt", "--all", "--check"])),
    ("web-lint", || npm("web", &["run", "lint"])),
    ("web-types", || npm("web", &["run", "check"])),
    ("web-test", || npm("web", &["test"])),
    ("clippy", || cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"])),
    ("wasm", wasm),
    ("test", suites::check),
    ("schedules", soak::schedules),
    ("openapi", || drift("openapi", "assets/openapi.json")),
    ("schema", || drift("schema", "assets/schema/scene.v1.schema.json")),
    ("domain", || drift("domain", "assets/domain.json")),
    ("machete", || tool("machete", &["machete"])),
    ("deny", || tool("deny", &["deny", "check", "licenses", "bans", "sources"])),
    ("advisories", advisories::check),
    ("dependencies", dependencies::check),
    ("package", packages::check),
    ("python", python),
    ("maps", maps),
    ("checkers", checkers::check),
    ("schemathesis", schemathesis::check),
    ("figures", figures::drag),
    ("browser", browser),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.split_first() {
        Some((command, names)) if command == "test" => test(names),
        Some((command, [])) if command == "golden" => golden("review"),
        Some((command, [flag])) if command == "golden" && flag == "--accept" => golden("accept"),
        Some((command, rest)) if command == "soak" => soak::run(rest),
        Some((command, [])) if command == "dependencies" => alone(dependencies::check()),
        Some((command, [flag])) if command == "dependencies" && flag == "--accept" => {
            alone(dependencies::accept())
        }
        Some((command, rest)) if command == "fuzz" || command == "imports" => {
            alone(fuzzing::command(command, rest))
        }
        Some((command, rest)) if command == "schemathesis" => alone(schemathesis::command(rest)),
        _ => {
            let names: Vec<&str> = CHECKS.iter().map(|check| check.0).collect();
            let names = names.join(", ");
            eprintln!(
                "usage: cargo xtask test [NAME…] [--strict]\n       cargo xtask golden [--accept]\n       \
                 cargo xtask soak clients|kills|faults|schedule [--minutes N | --count N] [--seed S]\n       \
                 cargo xtask dependencies [--accept]\n       cargo xtask fuzz [TARGET…] [--seconds N] [--seed S]\n       \
                 cargo xtask imports [FORMAT…] [--megabytes N]\n       \
                 cargo xtask schemathesis [--examples N] [--seed S]\nchecks: {names}"
            );
            ExitCode::from(2)
        }
    }
}

fn test(names: &[String]) -> ExitCode {
    let strict = |name: &String| name == "--strict";
    checkers::STRICT.store(names.iter().any(strict), std::sync::atomic::Ordering::Relaxed);
    let names: Vec<&String> = names.iter().filter(|name| !strict(name)).collect();
    if let Some(unknown) = names.iter().find(|name| !CHECKS.iter().any(|check| check.0 == name.as_str())) {
        eprintln!("no check is named {unknown}");
        return ExitCode::from(2);
    }
    if names.is_empty()
        && let Err(error) = environments::begin()
    {
        eprintln!("{error:#}");
    }
    let mut lines = Vec::new();
    let mut failed = false;
    for (name, check) in
        CHECKS.iter().filter(|check| names.is_empty() || names.iter().any(|n| n.as_str() == check.0))
    {
        println!("== {name}");
        let began = Instant::now();
        let outcome = check().unwrap_or_else(|error| Outcome::Failed(format!("{error:#}")));
        let text = match outcome {
            Outcome::Passed => "passed".to_owned(),
            Outcome::Told(what) => format!("passed: {what}"),
            Outcome::Skipped(why) => format!("skipped: {why}"),
            Outcome::Failed(why) => {
                failed = true;
                format!("FAILED: {why}")
            }
        };
        lines.push(format!("{name:<13} {:>5} s  {text}", began.elapsed().as_secs()));
    }
    println!("\n{}", lines.join("\n"));
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// A single piece of work, outside the list of checks.
fn alone(outcome: anyhow::Result<Outcome>) -> ExitCode {
    match outcome {
        Ok(Outcome::Passed) => ExitCode::SUCCESS,
        Ok(Outcome::Told(what)) => {
            println!("{what}");
            ExitCode::SUCCESS
        }
        Ok(Outcome::Skipped(why) | Outcome::Failed(why)) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Prints what changed in the golden answers; `accept` keeps it.
fn golden(mode: &str) -> ExitCode {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["test", "--quiet", "--workspace", "--test", "golden", "--", "--nocapture"];
    let status = Command::new(program).args(arguments).env("GOLDEN", mode).current_dir(root()).status();
    if status.is_ok_and(|status| status.success()) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The repository's root.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn run(command: &mut Command) -> anyhow::Result<Outcome> {
    let shown = format!("{command:?}").replace('"', "");
    let status = command.stdin(Stdio::null()).status().with_context(|| format!("cannot run {shown}"))?;
    Ok(if status.success() { Outcome::Passed } else { Outcome::Failed(format!("{shown}: {status}")) })
}

fn cargo(arguments: &[&str]) -> anyhow::Result<Outcome> {
    run(cargo_command().args(arguments))
}

/// Cargo at the root of the project.
fn cargo_command() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // A subcommand that finds the name of this package would take itself for a program that cargo runs.
    cargo.env_remove("CARGO_PKG_NAME").current_dir(root());
    cargo
}

/// Runs a cargo tool that is installed apart; without it the check is skipped.
fn tool(name: &str, arguments: &[&str]) -> anyhow::Result<Outcome> {
    missing_tool(name).map_or_else(|| cargo(arguments), |why| Ok(Outcome::Skipped(why)))
}

/// Why a cargo tool cannot be run here.
fn missing_tool(name: &str) -> Option<String> {
    let program = format!("cargo-{name}");
    let found = Command::new(&program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let missing = !found.is_ok_and(|status| status.success());
    missing.then(|| format!("{program} is not here; cargo install --locked {program}"))
}

/// Types, tests and notebook of the Python module, over the program as it is built for tests.
fn python() -> anyhow::Result<Outcome> {
    let own = match Environment::of_file("python")?.python()? {
        Ok(own) => own,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    let program = built("dragtraffic")?;
    for module in ["mypy", "pytest"] {
        let checked = run(Command::new(&own)
            .args(["-m", module])
            .env("DRAGTRAFFIC_BIN", &program)
            .current_dir(root()))?;
        if let Outcome::Failed(why) = checked {
            return Ok(Outcome::Failed(why));
        }
    }
    Ok(Outcome::Passed)
}

/// One network that a foreign program writes in several formats, read by all of ours; and an extract of OpenStreetMap.
fn maps() -> anyhow::Result<Outcome> {
    let own = match Environment::of_file("maps")?.python()? {
        Ok(own) => own,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    let folder = root().join("target/maps");
    let netconvert = own.with_file_name(format!("netconvert{}", std::env::consts::EXE_SUFFIX));
    let written = run(Command::new(own).arg("tests/equal_maps.py").arg(&folder).current_dir(root()))?;
    if let Outcome::Failed(why) = written {
        return Ok(Outcome::Failed(why));
    }
    run(cargo_command()
        .args(["test", "--workspace", "--locked", "--test", "equal_maps", "--test", "osm"])
        .env("DRAGTRAFFIC_EQUAL_MAPS", &folder)
        .env("DRAGTRAFFIC_NETCONVERT", netconvert))
}

fn npm(folder: &str, arguments: &[&str]) -> anyhow::Result<Outcome> {
    let folder = root().join(folder);
    run(Command::new("npm").args(arguments).current_dir(&folder)).with_context(|| {
        format!("{}: Node.js 20 or later with npm is needed (https://nodejs.org)", folder.display())
    })
}

/// The engine without clock, threads or files, as a page would hold it.
fn wasm() -> anyhow::Result<Outcome> {
    let target = "wasm32-unknown-unknown";
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let sysroot = Command::new(rustc).args(["--print", "sysroot"]).output()?.stdout;
    let sysroot = PathBuf::from(String::from_utf8(sysroot)?.trim());
    if !sysroot.join("lib/rustlib").join(target).join("lib").is_dir() {
        return Ok(Outcome::Skipped(format!("no {target} here; rustup target add {target}")));
    }
    cargo(&[
        "check",
        "--locked",
        "--target",
        target,
        "-p",
        "scene",
        "-p",
        "formats",
        "-p",
        "experts",
        "-p",
        "dragtraffic-api",
    ])
}

/// Installs the packages of a folder unless those there match its lock file.
fn npm_packages(folder: &str) -> anyhow::Result<Outcome> {
    let changed = |path: &str| root().join(folder).join(path).metadata().and_then(|m| m.modified()).ok();
    let (locked, installed) = (changed("package-lock.json"), changed("node_modules/.package-lock.json"));
    if installed.is_some() && installed >= locked {
        return Ok(Outcome::Passed);
    }
    npm(folder, &["ci", "--no-audit", "--no-fund"])
}

fn web_packages() -> anyhow::Result<Outcome> {
    npm_packages("web")
}

/// Compares a committed document with what the program prints.
fn drift(command: &str, file: &str) -> anyhow::Result<Outcome> {
    run(Command::new(program()?).args([command, "--check", file]).current_dir(root()))
}

/// A program, built as `cargo test --workspace` does: with what tests alone ask of our crates, so that nothing is
/// built twice.
fn built(name: &str) -> anyhow::Result<PathBuf> {
    if let Outcome::Failed(why) = cargo(&["test", "--workspace", "--locked", "--no-run", "--quiet"])? {
        bail!(why);
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    Ok(target.join("debug").join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// The program that `cargo test --workspace` has built, else built now.
fn program() -> anyhow::Result<PathBuf> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    let program = target.join("debug/dragtraffic");
    if !program.is_file()
        && let Outcome::Failed(why) = cargo(&["build", "--locked", "-p", "dragtraffic"])?
    {
        bail!(why);
    }
    Ok(program.canonicalize()?)
}

fn browser() -> anyhow::Result<Outcome> {
    let folder = "tests/browser";
    if !root().join(folder).join("package.json").exists() {
        return Ok(Outcome::Skipped(format!("{folder} is not in this checkout")));
    }
    let Some(chromium) = CHROMIUM.find()? else {
        let why = "no Chromium here; install it (Debian: apt-get install chromium) or set CHROMIUM";
        return Ok(Outcome::Skipped(why.into()));
    };
    if let failed @ Outcome::Failed(_) = npm_packages(folder)? {
        return Ok(failed);
    }
    let mut e2e = Command::new("npm");
    e2e.args(["run", "e2e"]).current_dir(root().join(folder));
    // Without a Firefox its journey says so and is passed over.
    if let Ok(Some(firefox)) = FIREFOX.find() {
        e2e.env("FIREFOX", firefox);
    }
    run(e2e.env("CHROMIUM", chromium).env("DRAGTRAFFIC_BIN", program()?))
}

/// A browser of the journeys: where people say it is, and what it is called on the path and by Debian.
struct Browser {
    variable: &'static str,
    names: &'static [&'static str],
    package: &'static str,
}

const CHROMIUM: Browser = Browser {
    variable: "CHROMIUM",
    names: &["chromium", "chromium-browser", "google-chrome", "chrome"],
    package: "chromium",
};
/// For the first minute alone.
const FIREFOX: Browser =
    Browser { variable: "FIREFOX", names: &["firefox", "firefox-esr"], package: "firefox-esr" };

impl Browser {
    /// The one that its variable names, one on the path, or one installed now where that is allowed.
    fn find(&self) -> anyhow::Result<Option<String>> {
        if let Ok(given) = std::env::var(self.variable) {
            return Ok(Some(given));
        }
        if let Some(found) = self.on_path() {
            return Ok(Some(found));
        }
        let is_root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout == b"0\n");
        let has_apt = Path::new("/usr/bin/apt-get").exists();
        if !is_root || !has_apt {
            return Ok(None);
        }
        let apt = |arguments: &[&str]| {
            run(Command::new("apt-get").args(arguments).env("DEBIAN_FRONTEND", "noninteractive"))
        };
        apt(&["update", "-q"])?;
        match apt(&["install", "-y", "-q", "--no-install-recommends", self.package])? {
            Outcome::Passed | Outcome::Told(_) => Ok(self.on_path()),
            Outcome::Failed(why) | Outcome::Skipped(why) => {
                bail!("{} could not be installed: {why}", self.package)
            }
        }
    }

    fn on_path(&self) -> Option<String> {
        let folders: Vec<_> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
        let places = self.names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
        places.filter(|place| place.is_file()).map(|place| place.display().to_string()).next()
    }
}
