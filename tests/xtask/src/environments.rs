//! Virtual environments of Python under `target/environments`: each is made once, with the packages that a
//! requirements file or a script names, and again when these change.

use crate::root;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

/// Environments of checks that list their packages in a file.
const OF_FILES: &[(&str, &str)] = &[
    ("python", "python/requirements-test.txt"),
    ("maps", "tests/equal-maps-requirements.txt"),
    ("schemathesis", "tests/schemathesis-requirements.txt"),
    ("tools", "tests/tools-requirements.txt"),
];

/// Result of each requested environment: its Python, or the reason why there is none. Locked while one is
/// made.
static MADE: Mutex<BTreeMap<String, Result<PathBuf, String>>> = Mutex::new(BTreeMap::new());

/// Content of an environment.
pub struct Environment {
    name: String,
    /// Changes if the environment must be rebuilt.
    wanted: String,
    /// Arguments of `pip install`, one entry per call.
    installs: Vec<Vec<String>>,
}

impl Environment {
    /// An environment with packages listed in a file.
    ///
    /// # Errors
    /// When the file cannot be read.
    pub fn of_file(name: &str) -> anyhow::Result<Self> {
        let known = OF_FILES.iter().find(|(known, _)| *known == name);
        let (_, file) = known.ok_or_else(|| anyhow::anyhow!("no environment is called {name}"))?;
        let wanted = std::fs::read_to_string(root().join(file))?;
        Ok(Self { name: name.to_owned(), wanted, installs: vec![vec!["-r".into(), (*file).to_owned()]] })
    }

    /// The environment of a script that lists its own packages: those installed with dependencies, and those
    /// without.
    pub fn of_script(name: &str, with: Vec<String>, without: Vec<String>) -> Self {
        let wanted = format!("{}\n\n{}\n", with.join("\n"), without.join("\n"));
        let bare = (!without.is_empty()).then(|| [vec!["--no-deps".to_owned()], without].concat());
        let installs = (!with.is_empty()).then_some(with).into_iter().chain(bare).collect();
        Self { name: format!("checker-{name}"), wanted, installs }
    }

    /// Its Python, or the reason why there is none.
    pub fn python(&self) -> anyhow::Result<Result<PathBuf, String>> {
        let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = made.get(&self.name) {
            return Ok(known.clone());
        }
        let python = self.make()?;
        made.insert(self.name.clone(), python.clone());
        Ok(python)
    }

    fn make(&self) -> anyhow::Result<Result<PathBuf, String>> {
        let folder = root().join("target/environments").join(&self.name);
        let own = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
        let stamp = folder.join("installed.txt");
        if std::fs::read_to_string(&stamp).is_ok_and(|installed| installed == self.wanted) {
            return Ok(Ok(own));
        }
        let runs = |program: &Path, arguments: &[&str], more: &[String]| {
            let mut command = Command::new(program);
            command.args(arguments).args(more).current_dir(root());
            command.status().is_ok_and(|status| status.success())
        };
        if !runs(Path::new("python3"), &["-m", "venv", &folder.to_string_lossy()], &[]) {
            return Ok(Err("python3 with venv is not here".into()));
        }
        let pip = ["-m", "pip", "install", "-q", "--disable-pip-version-check"];
        if !self.installs.iter().all(|packages| runs(&own, &pip, packages)) {
            return Ok(Err("its packages cannot be had".into()));
        }
        std::fs::write(&stamp, &self.wanted)?;
        Ok(Ok(own))
    }
}

/// Begins to make all environments in the background: they mostly wait for the network.
///
/// # Errors
/// When a file or script cannot be read.
pub fn begin() -> anyhow::Result<()> {
    let of_files = OF_FILES.iter().map(|(name, _)| Environment::of_file(name));
    let all: Vec<Environment> = of_files.chain(crate::checkers::environments()?).collect::<Result<_, _>>()?;
    // The check that needs an environment reports its error.
    std::thread::spawn(move || all.iter().for_each(|environment| drop(environment.python())));
    Ok(())
}
