//! `test`: everything that `cargo test --workspace` runs, by `cargo nextest` where it can be had: it runs as many tests
//! at a time as there are cores, whatever program they are in. `.config/nextest.toml` says in which order.

use crate::{Outcome, WHOLE, cargo_command, run, tools};
use std::process::Command;

/// The package whose features the build of all others uses.
const PROGRAM: &str = "dragtraffic";
/// Packages without a library.
const WITHOUT_LIBRARY: &[&str] = &[PROGRAM, "xtask"];

/// Runs all tests, and the documentation's examples.
pub fn check() -> anyhow::Result<Outcome> {
    let mut tests = runner()?;
    let mut examples = cargo_command();
    examples.arg("test").args(WHOLE).arg("--doc");
    let outcomes = [run(tests.args(WHOLE))?, run(&mut examples)?];
    let failed: Vec<String> = outcomes
        .into_iter()
        .filter_map(|outcome| if let Outcome::Failed(why) = outcome { Some(why) } else { None })
        .collect();
    Ok(if failed.is_empty() { Outcome::Passed } else { Outcome::Failed(failed.join(", ")) })
}

/// Unit tests of some crates, built with the features that the full run gives them.
pub fn units(crates: &[String]) -> anyhow::Result<Outcome> {
    let mut tests = runner()?;
    tests.args(["--locked", "--package", PROGRAM, "--features", "dragtraffic/lab", "--lib"]);
    tests.args(crates.iter().flat_map(|name| ["--package", name]));
    if crates.iter().any(|name| WITHOUT_LIBRARY.contains(&name.as_str())) {
        tests.arg("--bins");
    }
    run(&mut tests)
}

/// `cargo nextest run`, else `cargo test`.
fn runner() -> anyhow::Result<Command> {
    Ok(match tools::command("nextest")? {
        Ok(mut nextest) => {
            nextest.args(["run", "--no-tests", "pass"]);
            nextest
        }
        Err(_) => {
            let mut cargo = cargo_command();
            cargo.args(["test", "--no-fail-fast"]);
            cargo
        }
    })
}
