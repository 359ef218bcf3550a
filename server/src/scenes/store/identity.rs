//! Identity of the open file, so that nothing is written to one that was deleted or replaced.

use super::StoreError;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Suffixes of the files that SQLite keeps beside the open store; commits go to the first one.
const BESIDE: [&str; 2] = ["-wal", "-shm"];

/// Device and inode of a file; `None` on systems without.
type FileNumber = Option<(u64, u64)>;

/// The files of a store by name and, if the system has them, inode.
#[derive(Debug)]
pub struct FileIdentity {
    path: PathBuf,
    number: FileNumber,
    /// The files beside it, with their first inodes.
    beside: [(PathBuf, OnceLock<FileNumber>); 2],
}

impl FileIdentity {
    /// The identity of an existing file.
    ///
    /// # Errors
    /// When its metadata cannot be read.
    pub fn of(path: &Path) -> io::Result<Self> {
        let beside = BESIDE.map(|end| {
            let mut name = path.as_os_str().to_owned();
            name.push(end);
            let (file, first) = (PathBuf::from(name), OnceLock::new());
            // SQLite creates it at the first access, at the latest within the first change.
            let _ = number(&file).map(|number| first.set(number));
            (file, first)
        });
        Ok(Self { path: path.to_owned(), number: number(path)?, beside })
    }

    /// Within a change: checks that the names still refer to the same files, and that the store is not empty.
    ///
    /// # Errors
    /// [`StoreError::Gone`].
    pub fn check(&self) -> Result<(), StoreError> {
        let has_bytes = self.path.metadata().is_ok_and(|metadata| metadata.len() > 0);
        let same = number(&self.path).is_ok_and(|number| number == self.number);
        let same_beside = self
            .beside
            .iter()
            .all(|(file, first)| number(file).is_ok_and(|number| *first.get_or_init(|| number) == number));
        if has_bytes && same && same_beside { Ok(()) } else { Err(StoreError::Gone) }
    }
}

#[cfg(unix)]
#[allow(clippy::unnecessary_wraps, reason = "other systems have no number")]
fn number(path: &Path) -> io::Result<FileNumber> {
    use std::os::unix::fs::MetadataExt;
    let metadata = path.metadata()?;
    Ok(Some((metadata.dev(), metadata.ino())))
}

#[cfg(not(unix))]
fn number(path: &Path) -> io::Result<FileNumber> {
    path.metadata().map(|_| None)
}
