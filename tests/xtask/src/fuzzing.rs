//! `cargo xtask fuzz`: the program `fuzz` of the tests, built as they are.

use crate::{Outcome, built, root, run};
use std::process::Command;

/// Builds it and runs it with the arguments given.
pub fn command(arguments: &[String]) -> anyhow::Result<Outcome> {
    run(Command::new(built("fuzz")?).args(arguments).current_dir(root()))
}
