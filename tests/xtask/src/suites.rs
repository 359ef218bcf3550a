//! `test`: what `cargo test --workspace` runs, in less time. Most programs of tests keep one core busy with their
//! longest test, so those of the crates run side by side; those over the real server run alone, since they time out.

use crate::{Outcome, WHOLE, cargo_command, root};
use anyhow::{Context, ensure};
use serde_json::Value;
use std::collections::VecDeque;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Packages whose tests start servers and wait for them.
const ALONE: &[&str] = &["tests", "server"];
/// Side by side.
const WORKERS: usize = 2;

/// A program of tests that cargo has built.
struct Suite {
    program: PathBuf,
    /// Where cargo would run it: the folder of its package.
    folder: PathBuf,
    name: String,
}

/// Builds all programs, runs them and the documentation's examples.
pub fn check() -> anyhow::Result<Outcome> {
    let suites = built()?;
    ensure!(!suites.is_empty(), "no program of tests was built");
    let (alone, together): (Vec<Suite>, Vec<Suite>) =
        suites.into_iter().partition(|suite| ALONE.iter().any(|name| suite.folder.ends_with(name)));
    let mut failed = run(together, WORKERS);
    failed.extend(run(alone, 1));
    if let Outcome::Failed(why) = crate::run(cargo_command().arg("test").args(WHOLE).arg("--doc"))? {
        failed.push(why);
    }
    Ok(if failed.is_empty() { Outcome::Passed } else { Outcome::Failed(failed.join(", ")) })
}

/// All programs of the workspace's tests.
fn built() -> anyhow::Result<Vec<Suite>> {
    let output = cargo_command()
        .arg("test")
        .args(WHOLE)
        .args(["--no-run", "--message-format=json-render-diagnostics"])
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()
        .context("cargo")?;
    ensure!(output.status.success(), "cargo test --no-run: {}", output.status);
    let text = String::from_utf8_lossy(&output.stdout);
    let messages: Vec<Value> = text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?;
    Ok(messages.iter().filter_map(suite).collect())
}

/// The program that a message of cargo tells of.
fn suite(message: &Value) -> Option<Suite> {
    let is_test = message["reason"] == "compiler-artifact" && message["profile"]["test"] == true;
    let program = message["executable"].as_str().filter(|_| is_test)?;
    let folder = PathBuf::from(message["manifest_path"].as_str()?).parent()?.to_owned();
    let package = folder.strip_prefix(root().canonicalize().ok()?).unwrap_or(&folder).display().to_string();
    let name = format!("{package} {}", message["target"]["name"].as_str()?);
    Some(Suite { program: program.into(), folder, name })
}

/// Runs programs, so many at a time; gives back the names of those that failed. What one says is printed whole.
fn run(suites: Vec<Suite>, workers: usize) -> Vec<String> {
    let left = Mutex::new(VecDeque::from(suites));
    let failed = Mutex::new(Vec::new());
    let work = || {
        while let Some(suite) = { left.lock().unwrap_or_else(PoisonError::into_inner).pop_front() } {
            let began = Instant::now();
            let output = Command::new(&suite.program)
                .current_dir(&suite.folder)
                .env("CARGO_MANIFEST_DIR", &suite.folder)
                .stdin(Stdio::null())
                .output();
            let passed = output.as_ref().is_ok_and(|output| output.status.success());
            let mut text = format!("-- {}, {} s\n", suite.name, began.elapsed().as_secs()).into_bytes();
            match output {
                Ok(output) => text.extend([output.stdout, output.stderr].concat()),
                Err(error) => text.extend(format!("{error}\n").into_bytes()),
            }
            // Whoever reads along has gone: the outcome is told at the end.
            let _ = std::io::stdout().lock().write_all(&text);
            if !passed {
                failed.lock().unwrap_or_else(PoisonError::into_inner).push(suite.name);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(work);
        }
    });
    failed.into_inner().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::{Suite, run, suite};
    use serde_json::json;

    #[test]
    fn programs_of_tests_are_told_from_others() {
        let manifest = crate::root().join("models/scene/Cargo.toml");
        let message = |reason: &str, test: bool| json!({"reason": reason, "profile": {"test": test}, "executable": "/x", "manifest_path": manifest, "target": {"name": "scene"}});
        assert!(
            suite(&message("compiler-artifact", true)).is_some_and(|suite| suite.folder.ends_with("scene"))
        );
        assert!(suite(&message("compiler-artifact", false)).is_none());
        assert!(suite(&message("build-finished", true)).is_none());
    }

    #[test]
    fn what_fails_is_named_and_what_passes_is_not() {
        let named =
            |program: &str| Suite { program: program.into(), folder: ".".into(), name: program.into() };
        let suites = ["true", "false", "/no/such/program"].map(named).into();
        let mut failed = run(suites, 2);
        failed.sort();
        assert_eq!(failed, ["/no/such/program", "false"]);
    }
}
