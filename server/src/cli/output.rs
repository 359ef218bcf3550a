//! Reading inputs and writing outputs: `-` is stdin or stdout, existing files are kept.

use super::{Exit, Failure};
use formats::files;
use std::io::{ErrorKind, Read, Write};
use std::path::Path;

/// One line on stderr.
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

/// Writes to stdout. A reader that has closed its end is no failure.
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

/// Refuses a file or folder that is there already, before work on what is to go there.
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

/// Writes a file whole or not at all, or stdout for `-` and `None`. Links are followed, and a device or a pipe
/// is written into, never replaced.
///
/// # Errors
/// Exit 8 when the file exists and `force` is not given; exit 1.
pub fn write(path: Option<&Path>, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let Some(path) = path.filter(|p| *p != Path::new("-")) else { return print(bytes) };
    keep(path, force)?;
    match files::replace(path, bytes) {
        // A reader of a pipe that has closed its end is no failure.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(|error| Failure::new(Exit::Failure, format!("{}: {error}", path.display()))),
    }
}
