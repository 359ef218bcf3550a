//! System programs that checks need: on the path, or installed by `apt-get` if that is allowed.

use crate::{Outcome, run};
use anyhow::bail;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Two runs of `apt-get` at the same time fail.
static APT: Mutex<()> = Mutex::new(());

/// Lock to hold while `apt-get` runs.
pub fn apt_lock() -> MutexGuard<'static, ()> {
    APT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A program: the variable that may name it, its names on the path, and its Debian package if it has one.
pub struct SystemProgram {
    pub variable: &'static str,
    pub names: &'static [&'static str],
    pub package: Option<&'static str>,
}

/// The proxy of `docs/hosting.md`, for its test and for a journey.
pub const NGINX: SystemProgram =
    SystemProgram { variable: "NGINX", names: &["nginx"], package: Some("nginx-light") };

impl SystemProgram {
    /// The program that its variable names, one on the path, or one installed now if that is allowed.
    pub fn find(&self) -> anyhow::Result<Option<String>> {
        if let Ok(given) = std::env::var(self.variable) {
            return Ok(Some(given));
        }
        if let Some(found) = self.on_path() {
            return Ok(Some(found));
        }
        let Some(package) = self.package else { return Ok(None) };
        let is_root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout == b"0\n");
        let has_apt = Path::new("/usr/bin/apt-get").exists();
        if !is_root || !has_apt {
            return Ok(None);
        }
        let _alone = apt_lock();
        let apt = |arguments: &[&str]| {
            run(Command::new("apt-get").args(arguments).env("DEBIAN_FRONTEND", "noninteractive"))
        };
        apt(&["update", "-q"])?;
        match apt(&["install", "-y", "-q", "--no-install-recommends", package])? {
            Outcome::Passed | Outcome::Told(_) => Ok(self.on_path()),
            Outcome::Failed(why) | Outcome::Skipped(why) => {
                bail!("{package} could not be installed: {why}")
            }
        }
    }

    fn on_path(&self) -> Option<String> {
        let path = std::env::var_os("PATH")?;
        let folders: Vec<_> = std::env::split_paths(&path).chain(["/usr/sbin".into()]).collect();
        let places = self.names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
        places.filter(|place| place.is_file()).map(|place| place.display().to_string()).next()
    }
}
