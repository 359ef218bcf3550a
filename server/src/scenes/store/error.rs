//! Errors of the store, and their messages to callers.

use super::migrations;
use api::{Code, Problem};
use base::memory;
use base::problem::Refusal;
use rusqlite::ErrorCode;

/// Why the store refused or failed.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// An error of SQLite.
    #[error("{0}")]
    Sqlite(#[from] rusqlite::Error),
    /// A stored body cannot be read.
    #[error("stored body: {0}")]
    Body(#[from] std::io::Error),
    /// A file cannot be created or changed.
    #[error("{0}")]
    File(std::io::Error),
    /// Nothing was ever stored in the file.
    #[error("the file is empty")]
    Empty,
    /// Other requests fill the memory.
    #[error("other requests fill the memory")]
    NoMemory,
    /// The system cannot start a thread.
    #[error("no thread for the store: {0}")]
    Thread(std::io::Error),
    /// Written by a later version of the program.
    #[error("the file has schema {0}, this program knows up to {known}", known = migrations::LATEST)]
    Newer(i64),
    /// The file holds something other than scenes.
    #[error("the file is another program's database; choose another one with --db")]
    Foreign,
    /// SQLite finds the file damaged.
    #[error("the file is damaged: {0}")]
    Broken(String),
    /// The precondition names another version.
    #[error("the scene has changed in the meantime")]
    Stale {
        /// ETag of the stored scene.
        etag: String,
        /// RFC 3339.
        updated_at: String,
    },
    /// Nothing has this id.
    #[error("no such scene")]
    MissingScene,
    /// The map that a scene references is no longer stored.
    #[error("no such map")]
    MissingMap,
    /// The scene belongs to this user, who has not shared it for this.
    #[error("the scene belongs to {0}")]
    OfAnother(String),
    /// A limit is reached.
    #[error("the store is full: {0}")]
    Full(String),
    /// The open file has been deleted, replaced or overwritten.
    #[error("the store's file was removed, replaced or overwritten")]
    Gone,
    /// Another process has the file open.
    #[error("another process uses the store; end it first")]
    InUse,
    /// The writer thread has ended.
    #[error("the store is closed")]
    Closed,
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        let text = error.to_string();
        match error {
            StoreError::Stale { etag, updated_at } => {
                let detail = "The stored scene has changed since it was read.";
                Self::new(Code::StaleEtag, detail)
                    .with(|m| (m.etag, m.updated_at) = (Some(etag), Some(updated_at)))
            }
            StoreError::MissingScene => Self::new(Code::NotFound, "No scene has this id."),
            StoreError::MissingMap => {
                Self::new(Code::UnknownMap, "The map is not stored any more; send it inline.")
            }
            StoreError::Gone => {
                tracing::error!(error = text, "the store is gone");
                let detail = "The file of saved scenes was removed, replaced or overwritten. Nothing is saved \
                              until the server is started again.";
                Self::new(Code::StoreUnavailable, detail).retry_after(60)
            }
            StoreError::OfAnother(owner) => {
                let detail = format!("The scene belongs to \"{owner}\", who does not share it for this.");
                Self::new(Code::Forbidden, detail)
            }
            StoreError::NoMemory => memory::full(),
            StoreError::Full(what) => Self::new(Code::StoreFull, what),
            StoreError::Sqlite(rusqlite::Error::SqliteFailure(e, _)) if e.code == ErrorCode::DiskFull => {
                Self::new(Code::StoreFull, "The disk is full.")
            }
            StoreError::Sqlite(rusqlite::Error::SqliteFailure(e, _)) if is_of_the_disk(e.code) => {
                tracing::error!(error = text, "the disk of the store fails");
                let detail = "The disk cannot read or write saved scenes.";
                Self::new(Code::StoreUnavailable, detail).retry_after(2)
            }
            _ => Self::internal(text),
        }
    }
}

impl From<StoreError> for Refusal {
    fn from(error: StoreError) -> Self {
        Problem::from(error).into()
    }
}

/// An error below SQLite, or a lock of another process: not a defect of this program. SQLite calls pages that
/// the disk cannot return "corrupt".
fn is_of_the_disk(code: ErrorCode) -> bool {
    matches!(
        code,
        ErrorCode::SystemIoFailure
            | ErrorCode::CannotOpen
            | ErrorCode::DatabaseCorrupt
            | ErrorCode::ReadOnly
            | ErrorCode::PermissionDenied
            | ErrorCode::DatabaseBusy
            | ErrorCode::DatabaseLocked
            | ErrorCode::FileLockingProtocolFailed
    )
}

impl StoreError {
    /// Whether the disk is full.
    pub(super) fn is_disk_full(&self) -> bool {
        matches!(self, Self::Sqlite(rusqlite::Error::SqliteFailure(e, _)) if e.code == ErrorCode::DiskFull)
    }
}
