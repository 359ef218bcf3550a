//! Checks commit messages: a title of at most 72 characters, and a body with the reason.

use crate::{Outcome, root};
use anyhow::{Context, ensure};
use std::process::{Command, Stdio};

/// Only commits after this one are checked.
const BASE: &str = "406bb2d4a3c529b78d228abe1277c81e88cc8763";
/// Most characters of a title.
const MOST_CHARS: usize = 72;

/// Checks the commits since the base.
pub fn check() -> anyhow::Result<Outcome> {
    if git(&["cat-file", "-e", &format!("{BASE}^{{commit}}")]).is_err() {
        return Ok(Outcome::Skipped(format!("the history lacks {BASE}")));
    }
    let range = format!("{BASE}..HEAD");
    let faults = faults(&git(&["log", "--no-merges", "--format=%h%x00%s%x00%b%x1e", &range])?);
    Ok(if faults.is_empty() { Outcome::Passed } else { Outcome::Failed(faults.join(", ")) })
}

/// The faults of each commit. Hash, title and body each end with a zero byte, and the commit with a record
/// separator.
fn faults(log: &str) -> Vec<String> {
    let commits = log.split('\u{1e}').filter_map(|commit| {
        let (hash, words) = commit.trim_start().split_once('\0')?;
        let (title, body) = words.split_once('\0')?;
        Some((hash, title.chars().count(), body.trim().is_empty()))
    });
    let fault = |(hash, chars, is_bare): (&str, usize, bool)| match (chars > MOST_CHARS, is_bare) {
        (true, _) => Some(format!("{hash} has a title of {chars} characters; at most {MOST_CHARS}")),
        (false, true) => Some(format!("{hash} has no body that says why")),
        (false, false) => None,
    };
    commits.filter_map(fault).collect()
}

/// Output of git.
fn git(arguments: &[&str]) -> anyhow::Result<String> {
    let mut git = Command::new("git");
    let output = git.args(arguments).current_dir(root()).stdin(Stdio::null()).output().context("git")?;
    ensure!(output.status.success(), "git {}: {}", arguments.join(" "), output.status);
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

#[cfg(test)]
mod tests {
    use super::faults;

    #[test]
    fn long_titles_and_bare_commits_are_named() {
        let long = "x".repeat(73);
        let log = format!(
            "a1\0Add a check\0It finds them.\n\u{1e}\nb2\0{long}\0Why.\n\u{1e}\nc3\0Fix it\0\n\u{1e}\n"
        );
        let expected = ["b2 has a title of 73 characters; at most 72", "c3 has no body that says why"];
        assert_eq!(faults(&log), expected);
        assert!(faults("").is_empty());
    }
}
