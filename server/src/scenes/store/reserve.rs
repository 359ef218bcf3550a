//! Reserved disk space, so that scenes can be deleted when the disk is full.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// A delete first writes a few pages to the log, whose content then needs space in the file. The reserve
/// covers both; the log has up to 1 MB (`LOG_PAGES`).
const RESERVE_BYTES: usize = 2 << 20;
/// Free bytes with which a disk takes writes again.
const ROOM_BYTES: usize = 256 << 10;

/// A file of zeros beside the store's, released when a delete finds the disk full.
#[derive(Debug)]
pub struct Reserve {
    path: PathBuf,
    probe: PathBuf,
    /// A write found the disk full, and none has succeeded since.
    full: AtomicBool,
}

impl Reserve {
    /// The reserve beside a database; created if there is space for it.
    pub fn beside(database: &Path) -> Self {
        let (path, probe) = (named(database, RESERVE), named(database, "-probe"));
        let reserve = Self { path, probe, full: AtomicBool::new(false) };
        reserve.restore();
        reserve
    }

    /// Creates the file again if it is missing and there is space.
    pub fn restore(&self) {
        if !self.is_kept()
            && let Err(error) = fill(&self.path, RESERVE_BYTES)
        {
            tracing::warn!(%error, "no room could be kept for deletes");
            self.give_up();
        }
    }

    /// Returns the space to the disk. True if there was some.
    pub fn give_up(&self) -> bool {
        std::fs::remove_file(&self.path).is_ok()
    }

    /// Whether space is reserved.
    pub fn is_kept(&self) -> bool {
        self.path.metadata().is_ok_and(|m| m.len() == RESERVE_BYTES as u64)
    }

    /// Records whether the last write found the disk full.
    pub fn note(&self, full: bool) {
        self.full.store(full, Ordering::Relaxed);
    }

    /// Whether the disk was full at the last write and still is.
    pub fn is_full(&self) -> bool {
        if !self.full.load(Ordering::Relaxed) {
            return false;
        }
        let full = fill(&self.probe, ROOM_BYTES).is_err();
        // A remaining probe is harmless: the next one overwrites it.
        let _ = std::fs::remove_file(&self.probe);
        self.note(full);
        full
    }
}

/// End of the name of the reserve.
const RESERVE: &str = "-reserve";

/// A file beside a database.
fn named(database: &Path, end: &str) -> PathBuf {
    let mut name = database.file_name().unwrap_or_default().to_owned();
    name.push(end);
    database.with_file_name(name)
}

/// Returns the space of the reserve beside a database to the disk. True if there was some.
pub fn give_up_beside(database: &Path) -> bool {
    std::fs::remove_file(named(database, RESERVE)).is_ok()
}

/// Writes zeros, because holes would reserve no space.
fn fill(path: &Path, bytes: usize) -> io::Result<()> {
    let mut file = private(OpenOptions::new().write(true).create(true).truncate(true)).open(path)?;
    file.write_all(&vec![0; bytes])?;
    file.sync_all()
}

/// Creates a database file that only its owner can read; an existing one gets the same mode.
///
/// # Errors
/// When it cannot be created or changed.
pub fn make_private(path: &Path) -> io::Result<()> {
    let file: File = private(OpenOptions::new().read(true).append(true).create(true)).open(path)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = file.metadata()?.permissions().mode();
        if mode & 0o077 != 0 {
            file.set_permissions(std::fs::Permissions::from_mode(mode & !0o077))?;
        }
    }
    drop(file);
    Ok(())
}

fn private(options: &mut OpenOptions) -> &mut OpenOptions {
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(options, 0o600);
    options
}

#[cfg(test)]
mod tests {
    use super::Reserve;

    #[test]
    fn room_is_given_up_once_and_made_again() {
        let folder = tempfile::tempdir().unwrap();
        let reserve = Reserve::beside(&folder.path().join("s.sqlite"));
        let kept = || folder.path().join("s.sqlite-reserve").metadata().map_or(0, |m| m.len());
        assert!(kept() > 0);
        assert!(reserve.give_up() && !reserve.give_up());
        reserve.restore();
        assert!(kept() > 0);
        // A disk that was full but has space again is not full.
        reserve.note(true);
        assert!(!reserve.is_full());
    }
}
