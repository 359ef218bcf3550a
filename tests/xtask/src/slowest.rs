//! The slowest valid request, and the time of a drag beside it (`tests/src/bin/slowest.rs`); the growth of
//! each operation's time with a map (`doubling.rs`). The figures are those of a release build:
//! `DRAGTRAFFIC_BIN` names another one.

use super::{Outcome, built, cargo_command, root, run, target};
use std::path::PathBuf;
use std::process::Command;

/// Runs the measuring program of this name, which prints its table, and fails if a bound is exceeded.
pub fn command(name: &str, arguments: &[String]) -> anyhow::Result<Outcome> {
    let search = built(name)?;
    let program = match std::env::var_os("DRAGTRAFFIC_BIN") {
        Some(given) => PathBuf::from(given),
        None => {
            let build = ["build", "--release", "--locked", "--package", "dragtraffic"];
            if let failed @ Outcome::Failed(_) = run(cargo_command().args(build))? {
                return Ok(failed);
            }
            target().join("release").join(format!("dragtraffic{}", std::env::consts::EXE_SUFFIX))
        }
    };
    run(Command::new(search).args(arguments).env("DRAGTRAFFIC_BIN", program).current_dir(root()))
}
