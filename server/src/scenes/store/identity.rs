//! The file that was opened, so that nothing is written into one that has no name any more.

use super::StoreError;
use std::io;
use std::path::{Path, PathBuf};

/// A file by its name, and by its number on the disk where the system has one.
#[derive(Debug)]
pub struct FileIdentity {
    path: PathBuf,
    number: Option<(u64, u64)>,
}

impl FileIdentity {
    /// Of a file that exists.
    ///
    /// # Errors
    /// When it cannot be looked at.
    pub fn of(path: &Path) -> io::Result<Self> {
        Ok(Self { path: path.to_owned(), number: number(path)? })
    }

    /// The name still belongs to the same file.
    ///
    /// # Errors
    /// [`StoreError::Gone`].
    pub fn check(&self) -> Result<(), StoreError> {
        let same = number(&self.path).is_ok_and(|number| number == self.number);
        if same { Ok(()) } else { Err(StoreError::Gone) }
    }
}

#[cfg(unix)]
#[allow(clippy::unnecessary_wraps, reason = "other systems have no number")]
fn number(path: &Path) -> io::Result<Option<(u64, u64)>> {
    use std::os::unix::fs::MetadataExt;
    let metadata = path.metadata()?;
    Ok(Some((metadata.dev(), metadata.ino())))
}

#[cfg(not(unix))]
fn number(path: &Path) -> io::Result<Option<(u64, u64)>> {
    path.metadata().map(|_| None)
}
