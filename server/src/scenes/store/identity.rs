//! Identity of the open file, so that nothing is written to one that was deleted, replaced or overwritten.

use super::StoreError;
use rusqlite::Connection;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::SystemTime;

/// Suffixes of the files that SQLite keeps beside the open store; commits go to the first one.
const BESIDE: [&str; 2] = ["-wal", "-shm"];

/// Device and inode of a file; `None` on systems without.
type FileNumber = Option<(u64, u64)>;

/// Length and last change of a file; `None` without one.
type Stamp = Option<(u64, SystemTime)>;

/// A file of a store as its writer left it.
#[derive(Debug)]
pub struct LeftState {
    /// The store and its log.
    stamps: [Stamp; 2],
    /// SQLite's number of the changes by other connections.
    changes: i64,
}

/// The files of a store by name and, if the system has them, inode.
#[derive(Debug)]
pub struct FileIdentity {
    path: PathBuf,
    number: FileNumber,
    /// The files beside it, with their first inodes.
    beside: [(PathBuf, OnceLock<FileNumber>); 2],
    /// Whether another program has written to the files, and not through SQLite.
    overwritten: AtomicBool,
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
        Ok(Self { path: path.to_owned(), number: number(path)?, beside, overwritten: AtomicBool::new(false) })
    }

    /// Before a change by the only writer: looks whether another program has written to the files since the
    /// writer left them, and not through SQLite. A copy over the open store leaves its name and inode.
    pub fn look(&self, left: Option<&LeftState>, connection: &Connection) {
        if let (Some(left), Some(now)) = (left, self.state(connection))
            && left.changes == now.changes
            && left.stamps != now.stamps
        {
            self.overwritten.store(true, Ordering::Relaxed);
        }
    }

    /// The files as the writer leaves them.
    pub fn state(&self, connection: &Connection) -> Option<LeftState> {
        let stamp = |path: &Path| {
            let metadata = path.metadata().ok()?;
            Some((metadata.len(), metadata.modified().ok()?))
        };
        let changes = connection.pragma_query_value(None, "data_version", |row| row.get(0)).ok()?;
        Some(LeftState { stamps: [stamp(&self.path), stamp(&self.beside[0].0)], changes })
    }

    /// Within a change: checks that the names still refer to the same files, and that no other program has
    /// written to them.
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
        let intact = !self.overwritten.load(Ordering::Relaxed);
        if intact && has_bytes && same && same_beside { Ok(()) } else { Err(StoreError::Gone) }
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
