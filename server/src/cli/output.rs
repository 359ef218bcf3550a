//! Reading inputs and writing outputs: `-` is stdin or stdout, existing files are kept.

use super::{Exit, Failure};
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

/// Writes a file whole or not at all, or stdout for `-` and `None`.
///
/// # Errors
/// Exit 8 when the file exists and `force` is not given; exit 1.
pub fn write(path: Option<&Path>, bytes: &[u8], force: bool) -> Result<(), Failure> {
    let Some(path) = path.filter(|p| *p != Path::new("-")) else { return print(bytes) };
    if path.exists() && !force {
        let message = format!("{} exists; --force overwrites it", path.display());
        return Err(Failure::new(Exit::OutputExists, message));
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let partial = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
    let written = std::fs::File::create(&partial)
        .and_then(|mut file| file.write_all(bytes).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(&partial, path));
    written.map_err(|error| {
        let _ = std::fs::remove_file(&partial);
        Failure::new(Exit::Failure, format!("{}: {error}", path.display()))
    })
}
