//! `cargo xtask test`: sets up what the checks need and runs all of them.
//! `cargo xtask golden`: shows how the answers of the shipped weights differ from the golden ones.
//! `cargo xtask soak NAME`: trials that go on for as long as one likes.
//! `cargo xtask dependencies`: shows which crates came and went since the list of them was committed.
//! `cargo xtask fuzz`: readers and requests, with unexpected inputs.
//! `cargo xtask imports`: how long readers take, and how much memory.
//! `cargo xtask slowest`: the slowest valid request, and a drag beside it.
//! `cargo xtask doubling`: how the time of each operation grows with a map.
//! `cargo xtask schemathesis`: the API against its document, with many examples.
//!
//! `cargo xtask quick`: checks of what changed, in two minutes.
//! `cargo xtask advisories`: known faults of the crates that we use.
//!
//! `cargo xtask test NAME…` runs some. What a check needs is installed; where that fails it is skipped with a
//! printed reason, and with `--strict` it fails.

#![allow(clippy::print_stdout, reason = "it talks to people")]

mod advisories;
mod browser;
mod checkers;
mod commits;
mod dependencies;
mod environments;
mod figures;
mod fuzzing;
mod packages;
mod quick;
mod report;
mod schemathesis;
mod slowest;
mod soak;
mod suites;
mod system;
mod tools;
mod wasm;

use anyhow::{Context, bail};
use environments::Environment;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Outcome of a check.
enum Outcome {
    Passed,
    /// Passed, with a message.
    Told(String),
    Skipped(String),
    Failed(String),
}

type Check = (&'static str, fn() -> anyhow::Result<Outcome>);

/// The checks in stages, ordered by how fast faults are found. Lanes of a stage run in parallel if one of
/// them leaves cores idle: the page's checks while the lints compile, and other programs that read our files.
/// Checks that measure time or wait run alone.
const STAGES: &[&[&[Check]]] = &[
    &[&[
        ("web-packages", web_packages),
        ("commits", commits::check),
        ("fmt", || cargo(&["fmt", "--all", "--check"])),
    ]],
    &[
        &[
            ("clippy", clippy),
            // The program without the lab, as users have it; everything else is as in the check before.
            ("plain", || {
                cargo(&["clippy", "--workspace", "--locked", "--all-targets", "--", "-D", "warnings"])
            }),
            ("wasm", wasm::check),
        ],
        &[
            ("web-lint", || npm("web", &["run", "lint"])),
            ("web-types", || npm("web", &["run", "check"])),
            ("web-test", browser::page),
        ],
    ],
    &[&[
        ("test", suites::check),
        ("openapi", || drift(&["openapi"], "assets/openapi.json")),
        ("schema", || drift(&["schema"], "assets/schema/scene.v1.schema.json")),
        ("batch-schema", || drift(&["schema", "batch"], "assets/schema/batch.v1.schema.json")),
        ("pattern-schema", || drift(&["schema", "pattern"], "assets/schema/pattern.v1.schema.json")),
        ("domain", || drift(&["domain"], "assets/domain.json")),
        ("shear", || tools::check("shear", &[])),
        ("deny", || tools::check("deny", &["check", "licenses", "bans", "sources"])),
        ("dependencies", dependencies::check),
        ("package", packages::check),
        ("python", python),
    ]],
    &[&[("maps", maps), ("checkers", checkers::check)], &[("schemathesis", schemathesis::check)]],
    &[&[("figures", figures::drag), ("browser", browser::check)]],
];

fn checks() -> impl Iterator<Item = &'static Check> {
    STAGES.iter().flat_map(|lanes| lanes.iter().flat_map(|lane| lane.iter()))
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.split_first() {
        Some((command, names)) if command == "test" => test(names),
        Some((command, [])) if command == "quick" => quick::run(),
        Some((command, [])) if command == "advisories" => alone(advisories::command()),
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
        Some((command, [])) if command == "doubling" => alone(slowest::command(command, &[])),
        Some((command, rest)) if command == "slowest" => alone(slowest::command(command, rest)),
        Some((command, rest)) if command == "schemathesis" => alone(schemathesis::command(rest)),
        _ => {
            let names: Vec<&str> = checks().map(|check| check.0).collect();
            let names = names.join(", ");
            eprintln!(
                "usage: cargo xtask test [NAME…] [--strict]\n       cargo xtask quick\n       cargo xtask advisories\n       cargo xtask golden [--accept]\n       \
                 cargo xtask soak attacks|clients|faults|goodput|kills|live|power|schedule [--minutes N | --count N] [--seed S]\n       \
                 cargo xtask dependencies [--accept]\n       cargo xtask fuzz [TARGET…] [--seconds N] [--seed S]\n       \
                 cargo xtask fuzz --guided [READER…] [--seconds N]\n       \
                 cargo xtask imports [FORMAT…] [--megabytes N]\n       \
                 cargo xtask slowest [--tries N] [--seed S]\n       cargo xtask doubling\n       \
                 cargo xtask schemathesis [--examples N] [--seed S]\nchecks: {names}"
            );
            ExitCode::from(2)
        }
    }
}

fn test(names: &[String]) -> ExitCode {
    let is_strict = |name: &&String| name.as_str() == "--strict";
    let (flags, names): (Vec<&String>, Vec<&String>) = names.iter().partition(is_strict);
    let strict = !flags.is_empty();
    checkers::STRICT.store(strict, std::sync::atomic::Ordering::Relaxed);
    if let Some(unknown) = names.iter().find(|name| !checks().any(|check| check.0 == name.as_str())) {
        eprintln!("no check is named {unknown}");
        return ExitCode::from(2);
    }
    if names.is_empty()
        && let Err(error) = environments::begin()
    {
        eprintln!("{error:#}");
    }
    let asked = |name: &str| names.is_empty() || names.iter().any(|asked| asked.as_str() == name);
    let lane = |lane: &&'static [Check]| -> report::Lane<'static> {
        lane.iter().filter(|check| asked(check.0)).map(|(name, work)| (*name, work as _)).collect()
    };
    report::run(STAGES.iter().map(|lanes| lanes.iter().map(lane).collect()).collect(), strict)
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
    let mut command = whole_test();
    command.args(["--quiet", "--test", "golden", "--", "--nocapture"]);
    let status = command.env("GOLDEN", mode).status();
    if status.is_ok_and(|status| status.success()) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The repository's root.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn run(command: &mut Command) -> anyhow::Result<Outcome> {
    let shown = format!("{command:?}").replace('"', "");
    let status = report::status(command).with_context(|| format!("cannot run {shown}"))?;
    Ok(if status.success() { Outcome::Passed } else { Outcome::Failed(format!("{shown}: {status}")) })
}

/// Everything, with the single set of features that all checks share, so that nothing is built twice.
const WHOLE: &[&str] = &["--workspace", "--locked", "--features", "dragtraffic/lab"];

fn clippy() -> anyhow::Result<Outcome> {
    run(cargo_command().arg("clippy").args(WHOLE).args(["--all-targets", "--", "-D", "warnings"]))
}

/// `cargo test` of everything.
fn whole_test() -> Command {
    let mut cargo = cargo_command();
    cargo.arg("test").args(WHOLE);
    cargo
}

fn cargo(arguments: &[&str]) -> anyhow::Result<Outcome> {
    run(cargo_command().args(arguments))
}

/// Cargo at the root of the project.
fn cargo_command() -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // A subcommand that finds the name of this package would assume that cargo runs it.
    cargo.env_remove("CARGO_PKG_NAME").current_dir(root());
    cargo
}

/// Types, tests and notebook of the Python package, with the test build of the extension module.
fn python() -> anyhow::Result<Outcome> {
    let own = match Environment::of_file("python")?.python()? {
        Ok(own) => own,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    // With the tests, since without them dependencies have other features and are compiled again.
    let module = ["build", "--lib", "--tests", "--quiet"];
    if let Outcome::Failed(why) = run(cargo_command().args(module).args(WHOLE))? {
        return Ok(Outcome::Failed(why));
    }
    // Python loads an extension module by its platform's ending, from beside the package's files.
    let (library, module) = if cfg!(windows) {
        ("_native.dll", "_native.pyd")
    } else if cfg!(target_os = "macos") {
        ("lib_native.dylib", "_native.abi3.so")
    } else {
        ("lib_native.so", "_native.abi3.so")
    };
    let place = root().join("python/dragtraffic").join(module);
    std::fs::copy(target().join("debug").join(library), &place).context("the extension module")?;
    for module in ["mypy", "pytest"] {
        let checked = run(Command::new(&own).args(["-m", module]).current_dir(root()))?;
        if let Outcome::Failed(why) = checked {
            return Ok(Outcome::Failed(why));
        }
    }
    Ok(Outcome::Passed)
}

/// One network that another program writes in several formats, read by all our readers; and an extract of
/// OpenStreetMap.
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
    run(whole_test()
        .args(["--test", "equal_maps", "--test", "osm", "--", "--include-ignored"])
        .env("DRAGTRAFFIC_EQUAL_MAPS", &folder)
        .env("DRAGTRAFFIC_NETCONVERT", netconvert))
}

fn npm(folder: &str, arguments: &[&str]) -> anyhow::Result<Outcome> {
    let folder = root().join(folder);
    run(Command::new("npm").args(arguments).current_dir(&folder)).with_context(|| {
        format!("{}: Node.js 20 or later with npm is needed (https://nodejs.org)", folder.display())
    })
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
fn drift(command: &[&str], file: &str) -> anyhow::Result<Outcome> {
    run(Command::new(program()?).args(command).args(["--check", file]).current_dir(root()))
}

/// A program, built as `cargo test --workspace` does, with the features that only tests need, so that nothing
/// is built twice.
fn built(name: &str) -> anyhow::Result<PathBuf> {
    if let Outcome::Failed(why) = run(whole_test().args(["--no-run", "--quiet"]))? {
        bail!(why);
    }
    Ok(target().join("debug").join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// Where cargo builds.
fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// The present program: a build older than the sources must not be checked.
fn program() -> anyhow::Result<PathBuf> {
    Ok(built("dragtraffic")?.canonicalize()?)
}
