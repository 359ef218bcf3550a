//! Known faults of the crates we use, by the RustSec database: fetched, else the copy of this machine.

use crate::{Outcome, cargo, missing_tool, root};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Looks the lock file up. Without the network the copy that an earlier run fetched is used, and its date told;
/// without either the check is skipped.
pub fn check() -> anyhow::Result<Outcome> {
    if let Some(why) = missing_tool("deny") {
        return Ok(Outcome::Skipped(why));
    }
    let fetched = fetched();
    let Some(copy) = copies().and_then(|folder| copy_in(&folder)) else {
        let why = "the RustSec database cannot be fetched, and there is no copy of it here";
        return Ok(Outcome::Skipped(why.into()));
    };
    let outcome = cargo(&["deny", "--offline", "check", "advisories"])?;
    Ok(match outcome {
        Outcome::Passed if !fetched => {
            Outcome::Told(format!("by the copy of {} alone, since none can be fetched", date_of(&copy)?))
        }
        other => other,
    })
}

fn fetched() -> bool {
    let mut fetch = Command::new("cargo-deny");
    fetch.args(["fetch", "db"]).current_dir(root()).stdout(Stdio::null()).stderr(Stdio::null());
    fetch.status().is_ok_and(|status| status.success())
}

/// Where cargo-deny keeps its copies.
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
