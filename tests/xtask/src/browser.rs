//! `browser`: the journeys through the editor, in a real browser.

use crate::{Outcome, npm_packages, program, root, run};
use anyhow::bail;
use std::path::Path;
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

/// A browser of the journeys: where people say it is, and what it is called on the path and by Debian.
struct Browser {
    variable: &'static str,
    names: &'static [&'static str],
    package: &'static str,
}

const CHROMIUM: Browser = Browser {
    variable: "CHROMIUM",
    names: &["chromium", "chromium-browser", "google-chrome", "chrome"],
    package: "chromium",
};
/// Only for the journey of the first minute.
const FIREFOX: Browser =
    Browser { variable: "FIREFOX", names: &["firefox", "firefox-esr"], package: "firefox-esr" };

impl Browser {
    /// The one that its variable names, one on the path, or one installed now where that is allowed.
    fn find(&self) -> anyhow::Result<Option<String>> {
        if let Ok(given) = std::env::var(self.variable) {
            return Ok(Some(given));
        }
        if let Some(found) = self.on_path() {
            return Ok(Some(found));
        }
        let is_root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout == b"0\n");
        let has_apt = Path::new("/usr/bin/apt-get").exists();
        if !is_root || !has_apt {
            return Ok(None);
        }
        let apt = |arguments: &[&str]| {
            run(Command::new("apt-get").args(arguments).env("DEBIAN_FRONTEND", "noninteractive"))
        };
        apt(&["update", "-q"])?;
        match apt(&["install", "-y", "-q", "--no-install-recommends", self.package])? {
            Outcome::Passed | Outcome::Told(_) => Ok(self.on_path()),
            Outcome::Failed(why) | Outcome::Skipped(why) => {
                bail!("{} could not be installed: {why}", self.package)
            }
        }
    }

    fn on_path(&self) -> Option<String> {
        let folders: Vec<_> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
        let places = self.names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
        places.filter(|place| place.is_file()).map(|place| place.display().to_string()).next()
    }
}
