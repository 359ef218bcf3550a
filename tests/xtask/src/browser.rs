//! `browser`: the journeys through the editor, in real browsers. `web-test`: the tests of the editor, partly
//! in a browser.

use crate::system::{NGINX, SystemProgram};
use crate::{Outcome, npm_packages, program, root, run};
use std::process::Command;

/// Runs the tests of the editor; those of `web/test/browser` run in Chromium, which is installed first.
pub fn page() -> anyhow::Result<Outcome> {
    let chromium = CHROMIUM.find()?;
    let mut test = Command::new("npm");
    test.arg("test").current_dir(root().join("web"));
    test.envs(chromium.as_ref().map(|path| ("CHROMIUM", path)));
    Ok(match (run(&mut test)?, chromium) {
        (Outcome::Passed, None) => {
            Outcome::Skipped(format!("web/test/browser, the others pass: {NO_CHROMIUM}"))
        }
        (outcome, _) => outcome,
    })
}

/// Runs all journeys.
pub fn check() -> anyhow::Result<Outcome> {
    let folder = "tests/browser";
    if !root().join(folder).join("package.json").exists() {
        return Ok(Outcome::Skipped(format!("{folder} is not in this checkout")));
    }
    let Some(chromium) = CHROMIUM.find()? else { return Ok(Outcome::Skipped(NO_CHROMIUM.into())) };
    if let failed @ Outcome::Failed(_) = npm_packages(folder)? {
        return Ok(failed);
    }
    let mut e2e = Command::new("npm");
    e2e.args(["run", "e2e"]).current_dir(root().join(folder));
    let firefox = FIREFOX.find()?;
    e2e.envs(firefox.as_ref().map(|path| ("FIREFOX", path)));
    // Without it, one journey is skipped with a message.
    e2e.envs(NGINX.find()?.map(|path| (NGINX.variable, path)));
    let outcome = run(e2e.env("CHROMIUM", chromium).env("DRAGTRAFFIC_BIN", program()?))?;
    Ok(match (outcome, firefox) {
        (Outcome::Passed, None) => {
            Outcome::Skipped(format!("the journey in Firefox, the others pass: {NO_FIREFOX}"))
        }
        (Outcome::Passed, Some(_)) => {
            // Files that failed beside others and passed alone.
            let unsteady = std::fs::read_to_string(root().join(folder).join("out/unsteady.txt"))?;
            let told = format!("at the second attempt: {unsteady}");
            if unsteady.is_empty() { Outcome::Passed } else { Outcome::Told(told) }
        }
        (outcome, _) => outcome,
    })
}

const NO_CHROMIUM: &str = "no Chromium here; install it (Debian: apt-get install chromium) or set CHROMIUM";
const NO_FIREFOX: &str = "no Firefox here; install it (Debian: apt-get install firefox-esr) or set FIREFOX";

const CHROMIUM: SystemProgram = SystemProgram {
    variable: "CHROMIUM",
    names: &["chromium", "chromium-browser", "google-chrome", "chrome"],
    package: Some("chromium"),
};
/// Only for the journey of the first minute.
const FIREFOX: SystemProgram =
    SystemProgram { variable: "FIREFOX", names: &["firefox", "firefox-esr"], package: Some("firefox-esr") };
