//! `cargo xtask fuzz` and `cargo xtask imports`: programs of the tests, built as they are.

use crate::{Outcome, built, root, run};
use std::process::Command;

/// Builds one of them and runs it with the arguments given.
pub fn command(program: &str, arguments: &[String]) -> anyhow::Result<Outcome> {
    run(Command::new(built(program)?).args(arguments).current_dir(root()))
}
