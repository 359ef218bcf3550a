//! Copies of the store, taken while others read and write.

use super::reserve::make_private;
use super::{StoreError, migrations, open_reader};
use formats::files::Whole;
use rusqlite::Connection;
use rusqlite::backup::{Backup, StepResult};
use std::fs::File;
use std::io;
use std::path::Path;
use std::time::Duration;

/// Number of attempts to copy a file that others have locked, and the pause between them.
const TRIES: usize = 50;
const PAUSE: Duration = Duration::from_millis(100);

/// Content of a copy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Copied {
    /// Saved scenes.
    pub scenes: u64,
    /// Size of the file.
    pub bytes: u64,
}

/// Copies a store as it is at one moment: every write acknowledged before, and each later one completely or
/// not at all. The copy is one file without a log, readable only by its owner, and appears only after an
/// integrity check.
///
/// # Errors
/// When the file is not a store, is damaged, or one of the two cannot be read or written.
pub fn backup(from: &Path, to: &Path) -> Result<Copied, StoreError> {
    let source = open_reader(from)?;
    migrations::check(&source)?;
    copy(&source, to)
}

/// Replaces a store by a copy, completely or not at all. An existing file must be a store.
///
/// # Errors
/// [`StoreError::InUse`] if a server uses the file, and those of [`backup`].
pub fn restore(from: &Path, to: &Path) -> Result<Copied, StoreError> {
    if to.exists() {
        let connection = Connection::open(to)?;
        migrations::check(&connection)?;
        // Only the last process with the file open can leave log mode. The log's content goes into the file,
        // so that nothing of it is taken for the log of the copy.
        let mode =
            connection.pragma_update_and_check(None, "journal_mode", "DELETE", |row| row.get::<_, String>(0));
        match mode {
            Ok(mode) if mode == "delete" => {}
            Err(error) if error.sqlite_error_code() != Some(rusqlite::ErrorCode::DatabaseBusy) => {
                return Err(error.into());
            }
            _ => return Err(StoreError::InUse),
        }
    }
    backup(from, to)
}

/// Copies what a connection sees, with the same guarantees.
///
/// # Errors
/// As [`backup`].
pub(super) fn copy(source: &Connection, to: &Path) -> Result<Copied, StoreError> {
    let version: i64 = source.pragma_query_value(None, "user_version", |row| row.get(0))?;
    if version == 0 {
        return Err(StoreError::Empty);
    }
    let whole = Whole::create(to).map_err(StoreError::File)?;
    let no_file = || StoreError::File(io::Error::other("a plain file is expected for the copy"));
    let partial = whole.partial().ok_or_else(no_file)?;
    make_private(partial).map_err(StoreError::File)?;
    let scenes = fill(source, partial).inspect_err(|_| clear(partial))?;
    whole.finish().map_err(StoreError::File)?;
    let bytes = sync_name(to).map_err(StoreError::File)?;
    Ok(Copied { scenes, bytes })
}

/// Fills an empty file and checks it; returns the number of scenes.
fn fill(source: &Connection, partial: &Path) -> Result<u64, StoreError> {
    let mut target = Connection::open(partial)?;
    // No reader sees the file before it is complete and durable.
    target.pragma_update(None, "journal_mode", "OFF")?;
    target.pragma_update(None, "synchronous", "OFF")?;
    all_pages(source, &mut target)?;
    target.pragma_update(None, "journal_mode", "DELETE")?;
    migrations::look_through(&target, "integrity_check")?;
    if target.prepare("PRAGMA foreign_key_check")?.exists([])? {
        return Err(StoreError::Broken("a scene has lost its map".into()));
    }
    let scenes: i64 = target.query_row("SELECT count(*) FROM scenes", [], |row| row.get(0))?;
    Ok(scenes.unsigned_abs())
}

/// Removes what SQLite has left beside a failed copy.
fn clear(partial: &Path) {
    for end in ["-wal", "-shm", "-journal"] {
        let mut name = partial.as_os_str().to_owned();
        name.push(end);
        // Most of them do not exist.
        let _ = std::fs::remove_file(name);
    }
}

/// All pages in one step, under one read lock. In several steps the copy would restart at each write of
/// another process, and never end on a busy server.
fn all_pages(source: &Connection, target: &mut Connection) -> Result<(), StoreError> {
    let copying = Backup::new(source, target)?;
    for _ in 0..TRIES {
        if copying.step(-1)? == StepResult::Done {
            return Ok(());
        }
        std::thread::sleep(PAUSE);
    }
    Err(StoreError::File(io::Error::other("another program holds the file")))
}

/// Makes the name of a new file durable; returns the file's size.
fn sync_name(path: &Path) -> io::Result<u64> {
    let path = path.canonicalize()?;
    #[cfg(unix)]
    if let Some(folder) = path.parent() {
        File::open(folder)?.sync_all()?;
    }
    Ok(path.metadata()?.len())
}
