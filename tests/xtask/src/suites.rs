//! `test`: everything that `cargo test --workspace` runs, with `cargo nextest` if it is available: it runs as
//! many tests at a time as there are cores, across programs. `.config/nextest.toml` gives their order.

use crate::system::NGINX;
use crate::{Outcome, WHOLE, cargo_command, run, tools, whole_test};
use std::process::Command;

/// Packages without a library.
const WITHOUT_LIBRARY: &[&str] = &["dragtraffic", "xtask"];

/// Runs all tests, and the documentation's examples.
pub fn check() -> anyhow::Result<Outcome> {
    let (mut tests, _) = runner()?;
    let without_nginx = match NGINX.find() {
        Ok(Some(nginx)) => {
            tests.env(NGINX.variable, nginx);
            None
        }
        Ok(None) => Some("the test of docs/hosting.md was skipped: nginx is not installed".to_owned()),
        Err(why) => Some(format!("the test of docs/hosting.md was skipped: {why:#}")),
    };
    let outcomes = [run(tests.args(WHOLE))?, run(whole_test().arg("--doc"))?];
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

/// Unit tests of some crates, from the build of the full run: another choice of packages would have other
/// features, and compile all dependencies again. Without nextest the unit tests of all crates run.
pub fn units(crates: &[String]) -> anyhow::Result<Outcome> {
    let (mut tests, filters) = runner()?;
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

/// `cargo nextest run`, which supports filters, otherwise `cargo test`. A crate without tests passes.
fn runner() -> anyhow::Result<(Command, bool)> {
    Ok(match tools::command("nextest")? {
        Ok(mut nextest) => {
            nextest.args(["run", "--no-tests", "pass"]);
            (nextest, true)
        }
        Err(_) => {
            let mut cargo = cargo_command();
            cargo.args(["test", "--no-fail-fast"]);
            (cargo, false)
        }
    })
}
