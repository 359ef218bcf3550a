//! Makes new dependencies visible: a committed list has each crate, and whether it runs code during the
//! build.

use crate::{Outcome, root};
use anyhow::{Context, ensure};
use serde_json::Value;
use std::collections::BTreeSet;
use std::process::{Command, Stdio};

/// The committed list.
const LIST: &str = "tests/dependencies.txt";
const HEAD: &str = "# Every crate that is not ours, on any system, and what of it runs while we build (a build script, a\n\
    # macro). A new line here is a decision: who keeps the crate, what it does, why not without it.\n\
    # cargo xtask dependencies --accept writes this file.\n";

/// Compares the crates of the lock file with the committed list.
pub fn check() -> anyhow::Result<Outcome> {
    let committed = std::fs::read_to_string(root().join(LIST)).with_context(|| LIST.to_owned())?;
    let faults = differences(&lines_of(&committed), &crates()?);
    Ok(if faults.is_empty() {
        Outcome::Passed
    } else {
        Outcome::Failed(format!(
            "{}; look at each, then cargo xtask dependencies --accept",
            faults.join(", ")
        ))
    })
}

/// Writes the present list.
pub fn accept() -> anyhow::Result<Outcome> {
    let lines: Vec<String> = crates()?.into_iter().collect();
    std::fs::write(root().join(LIST), format!("{HEAD}{}\n", lines.join("\n")))?;
    Ok(Outcome::Passed)
}

/// Names of added and removed crates.
fn differences(committed: &BTreeSet<String>, now: &BTreeSet<String>) -> Vec<String> {
    let came = now.difference(committed).map(|line| format!("new: {line}"));
    came.chain(committed.difference(now).map(|line| format!("gone: {line}"))).collect()
}

fn lines_of(text: &str) -> BTreeSet<String> {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.map(str::to_owned).collect()
}

/// A line for each crate of the lock file that is not ours.
fn crates() -> anyhow::Result<BTreeSet<String>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--locked", "--format-version", "1"])
        .current_dir(root())
        .stderr(Stdio::inherit())
        .output()?;
    ensure!(output.status.success(), "cargo metadata: {}", output.status);
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let packages = metadata["packages"].as_array().context("no packages")?;
    Ok(packages.iter().filter(|package| !package["source"].is_null()).map(line_of).collect())
}

/// `name`, and the parts of the crate that run during the build.
fn line_of(package: &Value) -> String {
    let targets = package["targets"].as_array().into_iter().flatten();
    let kinds: Vec<&str> = targets
        .flat_map(|target| target["kind"].as_array().into_iter().flatten())
        .filter_map(Value::as_str)
        .collect();
    let runs = [("custom-build", " (build script)"), ("proc-macro", " (macro)")];
    let runs: String = runs.iter().filter(|(kind, _)| kinds.contains(kind)).map(|(_, word)| *word).collect();
    format!("{}{runs}", package["name"].as_str().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::{differences, line_of, lines_of};
    use serde_json::json;

    #[test]
    fn a_new_crate_and_a_new_build_script_are_told() {
        let committed = lines_of("# note\nserde\nserde_derive (macro)\nold\n");
        let package =
            |name: &str, kind: &str| json!({"name": name, "targets": [{"kind": ["lib"]}, {"kind": [kind]}]});
        let now =
            [package("serde", "custom-build"), package("serde_derive", "proc-macro"), package("new", "test")];
        let now = now.iter().map(line_of).collect();
        let expected = ["new: new", "new: serde (build script)", "gone: old", "gone: serde"];
        assert_eq!(differences(&committed, &now), expected);
    }
}
