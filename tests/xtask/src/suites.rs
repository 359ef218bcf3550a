//! `test`: everything that `cargo test --workspace` runs, by `cargo nextest` where it can be had: it runs as many tests
//! at a time as there are cores, whatever program they are in. `.config/nextest.toml` says in which order.

use crate::system::SystemProgram;
use crate::{Outcome, WHOLE, cargo_command, run, tools};
use std::process::Command;

/// Packages without a library.
const WITHOUT_LIBRARY: &[&str] = &["dragtraffic", "xtask"];

/// The proxy of the test of `docs/hosting.md`.
const NGINX: SystemProgram = SystemProgram { variable: "NGINX", names: &["nginx"], package: "nginx-light" };

/// Runs all tests, and the documentation's examples.
pub fn check() -> anyhow::Result<Outcome> {
    let (mut tests, _) = runner("pass")?;
    let without_nginx = match NGINX.find() {
        Ok(Some(nginx)) => {
            tests.env(NGINX.variable, nginx);
            None
        }
        Ok(None) => Some("the test of docs/hosting.md was skipped: nginx is not installed".to_owned()),
        Err(why) => Some(format!("the test of docs/hosting.md was skipped: {why:#}")),
    };
    let mut examples = cargo_command();
    examples.arg("test").args(WHOLE).arg("--doc");
    let outcomes = [run(tests.args(WHOLE))?, run(&mut examples)?];
    let failed: Vec<String> = outcomes
        .into_iter()
        .filter_map(|outcome| if let Outcome::Failed(why) = outcome { Some(why) } else { None })
        .collect();
    Ok(match without_nginx {
        _ if !failed.is_empty() => Outcome::Failed(failed.join(", ")),
        Some(told) => Outcome::Told(told),
        None => Outcome::Passed,
    })
}

/// Unit tests of some crates, from the build of the full run: another choice of packages would have other features,
/// and compile all dependencies again. Without nextest the unit tests of all crates run.
pub fn units(crates: &[String]) -> anyhow::Result<Outcome> {
    let (mut tests, filters) = runner("pass")?;
    tests.args(WHOLE).arg("--lib");
    if crates.iter().any(|name| WITHOUT_LIBRARY.contains(&name.as_str())) {
        tests.arg("--bins");
    }
    if filters {
        let packages: Vec<String> = crates.iter().map(|name| format!("package({name})")).collect();
        tests.args(["-E", &packages.join(" + ")]);
    }
    run(&mut tests)
}

/// The pool of workers in thousands of orders of its threads, under a model checker; `SCHEDULES` says how many of each.
pub fn schedules() -> anyhow::Result<Outcome> {
    let (mut tests, filters) = runner("fail")?;
    tests.args(WHOLE).arg("--lib");
    if filters {
        tests.args(["-E", "package(dragtraffic-work) & test(/^schedules/)"]);
    } else {
        tests.arg("schedules::");
    }
    run(&mut tests)
}

/// `cargo nextest run`, which takes filters, else `cargo test`. `without_tests` says what nextest does where no test is
/// meant: `pass` or `fail`.
fn runner(without_tests: &str) -> anyhow::Result<(Command, bool)> {
    Ok(match tools::command("nextest")? {
        Ok(mut nextest) => {
            nextest.args(["run", "--no-tests", without_tests]);
            (nextest, true)
        }
        Err(_) => {
            let mut cargo = cargo_command();
            cargo.args(["test", "--no-fail-fast"]);
            (cargo, false)
        }
    })
}
