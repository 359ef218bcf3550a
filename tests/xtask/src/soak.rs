//! Open-ended trials of the real program (`dragtraffic_tests::soak`).

use super::{built, root};
use std::process::{Command, ExitCode};

/// Builds program and trials as tests do, and starts one.
pub fn run(arguments: &[String]) -> ExitCode {
    let soak = match built("soak") {
        Ok(soak) => soak,
        Err(why) => {
            eprintln!("the program could not be built: {why:#}");
            return ExitCode::FAILURE;
        }
    };
    match Command::new(soak).args(arguments).current_dir(root()).status() {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        Ok(status) => ExitCode::from(u8::try_from(status.code().unwrap_or(1)).unwrap_or(1)),
        Err(error) => {
            eprintln!("the trial could not be started: {error}");
            ExitCode::FAILURE
        }
    }
}
