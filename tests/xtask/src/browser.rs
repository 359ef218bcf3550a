//! `browser`: the journeys through the editor, in a real browser.

use crate::system::SystemProgram;
use crate::{Outcome, npm_packages, program, root, run};
use std::process::Command;

/// Runs all of them.
pub fn check() -> anyhow::Result<Outcome> {
    let folder = "tests/browser";
    if !root().join(folder).join("package.json").exists() {
        return Ok(Outcome::Skipped(format!("{folder} is not in this checkout")));
    }
    let Some(chromium) = CHROMIUM.find()? else {
        let why = "no Chromium here; install it (Debian: apt-get install chromium) or set CHROMIUM";
        return Ok(Outcome::Skipped(why.into()));
    };
    if let failed @ Outcome::Failed(_) = npm_packages(folder)? {
        return Ok(failed);
    }
    let mut e2e = Command::new("npm");
    e2e.args(["run", "e2e"]).current_dir(root().join(folder));
    // Without a Firefox its journey says so and is passed over.
    if let Ok(Some(firefox)) = FIREFOX.find() {
        e2e.env("FIREFOX", firefox);
    }
    run(e2e.env("CHROMIUM", chromium).env("DRAGTRAFFIC_BIN", program()?))
}

const CHROMIUM: SystemProgram = SystemProgram {
    variable: "CHROMIUM",
    names: &["chromium", "chromium-browser", "google-chrome", "chrome"],
    package: "chromium",
};
/// Only for the journey of the first minute.
const FIREFOX: SystemProgram =
    SystemProgram { variable: "FIREFOX", names: &["firefox", "firefox-esr"], package: "firefox-esr" };
