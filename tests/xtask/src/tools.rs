//! Cargo's tools (`cargo deny`, `cargo shear`, ...): those of `tests/tools-requirements.txt`, otherwise the
//! installed ones.

use crate::environments::Environment;
use crate::{Outcome, root, run};
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// Runs a tool; without it the check is skipped.
pub fn check(name: &str, arguments: &[&str]) -> anyhow::Result<Outcome> {
    match command(name)? {
        Ok(mut tool) => run(tool.args(arguments)),
        Err(why) => Ok(Outcome::Skipped(why)),
    }
}

/// The command of a tool at the root of the project, without arguments; or the reason why there is none.
pub fn command(name: &str) -> anyhow::Result<Result<Command, String>> {
    let program = format!("cargo-{name}{}", std::env::consts::EXE_SUFFIX);
    let pinned = Environment::of_file("tools")?.python()?.map(|python| python.with_file_name(&program));
    let found = [pinned.unwrap_or_default(), PathBuf::from(&program)].into_iter().find(starts);
    let Some(found) = found else {
        return Ok(Err(format!("{program} cannot be installed; cargo install --locked cargo-{name}")));
    };
    let mut tool = Command::new(found);
    // A tool that finds the name of this package would assume that cargo runs it.
    tool.env_remove("CARGO_PKG_NAME").current_dir(root()).arg(name);
    Ok(Ok(tool))
}

fn starts(program: &PathBuf) -> bool {
    let mut command = Command::new(program);
    let quiet = command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}
