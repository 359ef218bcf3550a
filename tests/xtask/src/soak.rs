//! Trials of the real program that go on for as long as one likes (`dragtraffic_tests::soak`).

use super::{Outcome, WHOLE, cargo_command, root, run as command};
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Builds program and trials as tests have them, and starts one.
pub fn run(arguments: &[String]) -> ExitCode {
    let build = |what: &[&str]| command(cargo_command().args(["build", "--quiet"]).args(WHOLE).args(what));
    let built = build(&["--bins"]).and_then(|programs| {
        let library = build(&["--example", "faults"])?;
        Ok(matches!((programs, library), (Outcome::Passed, Outcome::Passed)))
    });
    if !built.is_ok_and(|built| built) {
        eprintln!("the program could not be built");
        return ExitCode::FAILURE;
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    match Command::new(target.join("debug/soak")).args(arguments).current_dir(root()).status() {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        Ok(status) => ExitCode::from(u8::try_from(status.code().unwrap_or(1)).unwrap_or(1)),
        Err(error) => {
            eprintln!("the trial could not be started: {error}");
            ExitCode::FAILURE
        }
    }
}
