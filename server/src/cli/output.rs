//! Reading inputs and writing outputs: `-` is stdin or stdout, existing files are kept.

use super::{Exit, Failure};
use formats::files;
use std::collections::HashSet;
use std::io::{ErrorKind, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Prints one line to stderr.
pub fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "dragtraffic: {message}");
}

/// Reads a file or stdin.
///
/// # Errors
/// Exit 3.
pub fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let result = if path == Path::new("-") {
        std::io::stdin().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        std::fs::read(path)
    };
    result.map_err(|error| Failure::new(Exit::Input, format!("{}: {error}", path.display())))
}

/// Reads text; `-` is standard input.
///
/// # Errors
/// Exit 3.
pub fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(read(path)?)
        .map_err(|_| Failure::input(format!("{}: this is no text in UTF-8", path.display())))
}

/// Writes to stdout. A closed pipe is not a failure.
///
/// # Errors
/// Exit 1.
pub fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => Ok(result?),
    }
}

/// Refuses an existing file or folder before the work on its content.
///
/// # Errors
/// Exit 8.
pub fn keep(path: &Path, force: bool) -> Result<(), Failure> {
    if files::would_replace(path) && !force {
        let message = format!("{} exists; --force overwrites it", path.display());
        return Err(Failure::new(Exit::OutputExists, message));
    }
    Ok(())
}

/// Writes a file completely or not at all, or stdout for `-` and `None`. Links are followed, and a device or
/// a pipe is written to, never replaced.
///
/// # Errors
/// Exit 8 when the file exists and `force` is not given; exit 1.
pub fn write(path: Option<&Path>, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let Some(path) = path.filter(|p| *p != Path::new("-")) else { return print(bytes) };
    keep(path, force)?;
    match files::replace(path, bytes) {
        // A closed pipe is not a failure.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|error| Failure::new(Exit::Failure, format!("{}: {error}", path.display()))),
    }
}

/// Whether the output would go to a terminal, where a scene is unreadable.
pub fn is_terminal(path: Option<&Path>) -> bool {
    path.is_none() && std::io::stdout().is_terminal()
}

/// Writes a scene as [`write`] does. On a terminal its size is printed instead, unless `--json` is given.
///
/// # Errors
/// Those of [`write`].
pub fn write_scene(path: Option<&Path>, bytes: &[u8], force: bool, json: bool) -> Result<(), Failure> {
    if json || !is_terminal(path) {
        return write(path, bytes, force);
    }
    print_size(bytes.len(), " of JSON", "--json")
}

/// Prints the size of a document instead of its text, and the flags that print or write it.
///
/// # Errors
/// Those of [`print`].
pub fn print_size(bytes: usize, of: &str, flag: &str) -> Result<(), Failure> {
    let size = bytes.div_ceil(1000);
    print(format!("{size} kB{of}: --output FILE writes them, {flag} prints them\n").as_bytes())
}

/// A folder for results, each with a unique name.
pub struct Folder {
    path: PathBuf,
    force: bool,
    taken: Mutex<HashSet<String>>,
}

impl Folder {
    /// Whether `-o` names a folder: it exists, or the path ends with a slash.
    pub fn named(path: &Path) -> bool {
        path.is_dir() || path.to_string_lossy().ends_with('/')
    }

    /// A folder that is created when the first file is written.
    ///
    /// # Errors
    /// Exit 2 when the path is a file.
    pub fn new(path: &Path, force: bool) -> Result<Self, Failure> {
        if path.exists() && !path.is_dir() {
            let message =
                format!("--output {}: a folder expected for many scenes, this is a file", path.display());
            return Err(Failure::usage(message));
        }
        Ok(Self { path: path.to_path_buf(), force, taken: Mutex::default() })
    }

    /// The path of a file with this name.
    pub fn at(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file under a name that no other result of this call has.
    ///
    /// # Errors
    /// Exit 8 when it exists, 1 when it cannot be written or two results have one name.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
        let path = self.at(name);
        let new = self.taken.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_owned());
        if !new {
            return Err(Failure::new(
                Exit::Failure,
                format!("{}: two scenes have this name", path.display()),
            ));
        }
        write(Some(&path), bytes, self.force)?;
        Ok(path)
    }
}
