//! `cargo xtask fuzz` and `cargo xtask imports`: programs of the tests. `cargo xtask fuzz --guided`: the
//! readers under `cargo fuzz`, which a nightly compiler guides by the branches that an input reaches.

use crate::{Outcome, built, root, run, tools};
use anyhow::{Context, bail, ensure};
use std::process::Command;

/// Default seconds for each reader.
const SECONDS: &str = "60";

/// Builds one of the programs and runs it with the given arguments; `--guided` runs `cargo fuzz` instead.
pub fn command(program: &str, arguments: &[String]) -> anyhow::Result<Outcome> {
    match arguments.split_first() {
        Some((flag, rest)) if program == "fuzz" && flag == "--guided" => guided(rest),
        _ => run(Command::new(built(program)?).args(arguments).current_dir(root())),
    }
}

/// Runs the named readers, or all of them, each for the same time.
fn guided(arguments: &[String]) -> anyhow::Result<Outcome> {
    let Some(nightly) = nightly()? else {
        return Ok(Outcome::Failed("no nightly compiler here; rustup toolchain install nightly".into()));
    };
    let seconds = arguments.iter().position(|argument| argument == "--seconds");
    let (mut names, seconds) = match seconds {
        Some(at) => {
            let seconds = arguments.get(at + 1).context("--seconds takes a number")?;
            ([&arguments[..at], &arguments[at + 2..]].concat(), seconds.as_str())
        }
        None => (arguments.to_vec(), SECONDS),
    };
    let tool = |arguments: &[&str]| -> anyhow::Result<Command> {
        let mut tool = tools::command("fuzz")?.map_err(anyhow::Error::msg)?;
        // The cargo that runs this program belongs to another compiler.
        tool.env_remove("CARGO").env("RUSTUP_TOOLCHAIN", &nightly).current_dir(root().join("fuzz"));
        tool.args(arguments);
        Ok(tool)
    };
    let all = tool(&["list"])?.output()?;
    let all = String::from_utf8(all.stdout)?;
    if names.is_empty() {
        names = all.lines().map(str::to_owned).collect();
    }
    let target = root().canonicalize()?.join("target/fuzz");
    let mut failed = Vec::new();
    for name in names {
        ensure!(
            all.lines().any(|known| known == name),
            "no reader is named {name}; readers: {}",
            all.replace('\n', " ")
        );
        // New inputs go to the first folder; the committed corpus is unchanged.
        let found = target.join("guided").join(&name);
        std::fs::create_dir_all(&found)?;
        let mut fuzz = tool(&["run", "--target-dir"])?;
        fuzz.arg(target.join("build")).arg(&name).arg(&found).arg(format!("corpus/{name}"));
        fuzz.arg("--").args([&format!("-max_total_time={seconds}"), "-rss_limit_mb=2048", "-timeout=10"]);
        fuzz.arg(format!("-artifact_prefix={}/{name}-", target.display()));
        if let Outcome::Failed(_) = run(&mut fuzz)? {
            failed.push(name);
        }
    }
    if !failed.is_empty() {
        bail!("{} failed; inputs that break a reader are in {}", failed.join(", "), target.display());
    }
    Ok(Outcome::Passed)
}

/// The name of a nightly toolchain of rustup.
fn nightly() -> anyhow::Result<Option<String>> {
    let Ok(output) = Command::new("rustup").args(["toolchain", "list"]).output() else { return Ok(None) };
    let text = String::from_utf8(output.stdout)?;
    let names = text.lines().filter_map(|line| line.split_whitespace().next());
    Ok(names.filter(|name| name.starts_with("nightly")).map(str::to_owned).next())
}
