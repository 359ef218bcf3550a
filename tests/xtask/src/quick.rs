//! `cargo xtask quick`: the check before each commit. It checks the changes since the branch began: commit
//! messages, format, lints, unit tests of the changed crates and, for the page, lint, types and tests without
//! a browser. Lints include the crates that depend on a changed one, and share what the full run has
//! compiled.

use crate::{Outcome, cargo, cargo_command, clippy, commits, npm, report, root, suites, web_packages};
use anyhow::{Context, ensure};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// Branches from which others begin.
const MAIN: &[&str] = &["@{upstream}", "origin/main", "main"];

/// Folders that the checks of the page cover.
const PAGE: &[&str] = &["web", "tests/browser"];

/// Runs the checks that the changed files need.
pub fn run() -> ExitCode {
    let changed = match changed() {
        Ok(changed) => changed,
        Err(error) => {
            eprintln!("{error:#}");
            return ExitCode::FAILURE;
        }
    };
    println!("crates: {}; page: {}", changed.crates.join(", "), if changed.page { "yes" } else { "no" });
    let format = || cargo(&["fmt", "--all", "--check"]);
    let test = || suites::units(&changed.crates);
    let page = |script: &'static [&'static str]| {
        move || match web_packages()? {
            Outcome::Passed => npm("web", &[&["run"], script].concat()),
            failed => Ok(failed),
        }
    };
    let (page_lint, page_types) = (page(&["lint"]), page(&["check"]));
    let page_test = page(&["test", "--", "--exclude", "test/browser/**"]);
    let mut checks: report::Lane<'_> = vec![("commits", &commits::check), ("fmt", &format)];
    if changed.page {
        checks.extend([
            ("web-lint", &page_lint as _),
            ("web-types", &page_types as _),
            ("web-test", &page_test as _),
        ]);
    }
    if !changed.crates.is_empty() {
        checks.extend([("clippy", &clippy as _), ("units", &test as _)]);
    }
    report::run(vec![vec![checks]], true)
}

/// Changes since the commit at which this branch began.
struct Changed {
    /// Names of packages.
    crates: Vec<String>,
    page: bool,
}

impl Changed {
    /// Packages of changed files. A package may lie in the folder of another one: the innermost has the file.
    fn of(files: &[&Path], packages: &[(PathBuf, String)]) -> Self {
        let package = |file: &&Path| {
            let around = packages.iter().filter(|(folder, _)| file.starts_with(folder));
            around.max_by_key(|(folder, _)| folder.components().count()).map(|(_, name)| name.clone())
        };
        let crates: BTreeSet<String> = files.iter().filter_map(package).collect();
        let of_page = |file: &&Path| PAGE.iter().any(|folder| file.starts_with(folder));
        Self { crates: crates.into_iter().collect(), page: files.iter().any(of_page) }
    }
}

fn changed() -> anyhow::Result<Changed> {
    let began = MAIN.iter().find_map(|main| git(&["merge-base", "HEAD", main]).ok());
    let began = began.unwrap_or_else(|| "HEAD".into());
    let mut files = git(&["diff", "--name-only", began.trim()])?;
    files.push_str(&git(&["ls-files", "--others", "--exclude-standard"])?);
    Ok(Changed::of(&files.lines().map(Path::new).collect::<Vec<_>>(), &packages()?))
}

/// Folder, below the root, and name of each package of the workspace.
fn packages() -> anyhow::Result<Vec<(PathBuf, String)>> {
    let output = cargo_command().args(["metadata", "--no-deps", "--format-version", "1"]).output()?;
    let metadata: Value = serde_json::from_slice(&output.stdout).context("cargo metadata")?;
    let top = PathBuf::from(metadata["workspace_root"].as_str().context("no root")?);
    let packages = metadata["packages"].as_array().context("no packages")?;
    let package = |package: &Value| {
        let manifest = Path::new(package["manifest_path"].as_str()?);
        let folder = manifest.parent()?.strip_prefix(&top).ok()?;
        Some((folder.to_owned(), package["name"].as_str()?.to_owned()))
    };
    Ok(packages.iter().filter_map(package).collect())
}

fn git(arguments: &[&str]) -> anyhow::Result<String> {
    let output = Command::new("git").args(arguments).current_dir(root()).stdin(Stdio::null()).output()?;
    ensure!(output.status.success(), "git {}: {}", arguments.join(" "), output.status);
    Ok(String::from_utf8(output.stdout)?)
}

#[cfg(test)]
mod tests {
    use super::Changed;
    use std::path::Path;

    #[test]
    fn a_file_belongs_to_the_innermost_package() {
        let packages = [("tests", "dragtraffic-tests"), ("tests/xtask", "xtask"), ("server", "dragtraffic")];
        let packages = packages.map(|(folder, name)| (folder.into(), name.to_owned()));
        let changed = |files: &[&str]| {
            let files: Vec<&Path> = files.iter().map(Path::new).collect();
            let changed = Changed::of(&files, &packages);
            (changed.crates, changed.page)
        };
        assert_eq!(changed(&["tests/xtask/src/main.rs", "README.md"]), (vec!["xtask".to_owned()], false));
        let (crates, page) = changed(&["web/src/app.ts", "tests/src/lib.rs", "server/build.rs"]);
        assert_eq!((crates.join(" ").as_str(), page), ("dragtraffic dragtraffic-tests", true));
    }
}
