//! Schemathesis checks the API against its own document: examples, boundaries, valid and invalid drawn
//! bodies, and chains of calls. `tests/schemathesis.toml` lists the checks, and the reasons for omitted ones.

use crate::environments::Environment;
use crate::{Outcome, built, root, run};
use anyhow::{Context, bail};
use std::process::Command;

const CONFIG: &str = "tests/schemathesis.toml";
/// Examples per operation in the check of every merge, and their seed.
const EXAMPLES: u64 = 20;
const SEED: u64 = 1;

/// Runs a few examples of each operation.
pub fn check() -> anyhow::Result<Outcome> {
    examples(EXAMPLES, SEED)
}

/// Runs the requested number of examples.
pub fn command(arguments: &[String]) -> anyhow::Result<Outcome> {
    let (mut number, mut seed) = (500, SEED);
    for pair in arguments.chunks(2) {
        let value = pair.get(1).and_then(|text| text.parse().ok());
        let value = value.with_context(|| format!("{} takes a number", pair.concat()))?;
        match pair.first().map(String::as_str) {
            Some("--examples") => number = value,
            Some("--seed") => seed = value,
            _ => bail!("cargo xtask schemathesis [--examples N] [--seed S]"),
        }
    }
    examples(number, seed)
}

fn examples(number: u64, seed: u64) -> anyhow::Result<Outcome> {
    let own = match Environment::of_file("schemathesis")?.python()? {
        Ok(own) => own,
        Err(why) => return Ok(Outcome::Skipped(why)),
    };
    println!("{number} examples of each operation, seed {seed}");
    let mut api = Command::new(built("api")?);
    api.arg(own.with_file_name("schemathesis")).args([CONFIG, &number.to_string(), &seed.to_string()]);
    run(api.current_dir(root()))
}
