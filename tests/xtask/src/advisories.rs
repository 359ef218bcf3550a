//! `cargo xtask advisories`: known faults of our dependencies, from the RustSec database. No package registry
//! has that database, so the command needs the network, or the copy of an earlier run.

use crate::{Outcome, run, tools};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Checks the lock file. Without the network the last copy is used, and its date printed.
pub fn command() -> anyhow::Result<Outcome> {
    let mut fetch = match tools::command("deny")? {
        Ok(tool) => tool,
        Err(why) => return Ok(Outcome::Failed(why)),
    };
    let fetched = fetch.args(["fetch", "db"]).output().is_ok_and(|output| output.status.success());
    let Some(copy) = copies().and_then(|folder| copy_in(&folder)) else {
        let why =
            "the RustSec database cannot be fetched, and no earlier copy is here: the network is needed";
        return Ok(Outcome::Failed(why.into()));
    };
    let mut check = match tools::command("deny")? {
        Ok(tool) => tool,
        Err(why) => return Ok(Outcome::Failed(why)),
    };
    let outcome = run(check.args(["--offline", "check", "advisories"]))?;
    Ok(match outcome {
        Outcome::Passed if !fetched => {
            Outcome::Told(format!("by the copy of {} alone: none can be fetched", date_of(&copy)?))
        }
        other => other,
    })
}

/// Folder of cargo-deny's copies.
fn copies() -> Option<PathBuf> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| std::env::home_dir().map(|home| home.join(".cargo")))?;
    Some(home.join("advisory-dbs"))
}

/// A copy with advisories about crates; an attempt to fetch may leave an empty folder.
fn copy_in(folder: &Path) -> Option<PathBuf> {
    let copies = std::fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    copies.into_iter().find(|copy| copy.join("crates").is_dir())
}

/// Day of a copy's newest advisory.
fn date_of(copy: &Path) -> anyhow::Result<String> {
    let output = Command::new("git").arg("-C").arg(copy).args(["log", "-1", "--format=%cs"]).output()?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
