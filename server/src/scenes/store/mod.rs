//! Saved scenes and maps in one SQLite file.
//!
//! Write-ahead log, `synchronous=FULL`, one writer thread and a few reader threads, each with its own
//! connection and no other work. A write is acknowledged after its commit, so a success survives a power cut.

mod backup;
mod dump;
mod error;
mod identity;
mod list;
mod migrations;
mod owners;
mod records;
mod reserve;

pub use backup::{backup, restore};
pub use dump::{DumpedScene, count, each};
pub use error::StoreError;
pub use list::{PageQuery, Sort};
pub use owners::{Ownership, SceneShare, Viewer};
pub use records::{
    Expect, MapRecord, PackedScene, SceneRecord, SceneSummary, StoredMap, StoredText, Written,
};

use base::limits::Limits;
use base::memory::Memory;
use identity::FileIdentity;
use reserve::Reserve;
use rusqlite::{Connection, OpenFlags};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;
use tokio::sync::oneshot;

const READERS: usize = 4;

/// Version of the file that this program writes.
pub const SCHEMA: u64 = migrations::LATEST as u64;

type Work = Box<dyn FnOnce(&mut Connection) + Send>;

type Query = Box<dyn FnOnce(&Connection) + Send>;

/// The store. Cheap to clone.
#[derive(Clone)]
pub struct Store {
    writer: mpsc::Sender<Work>,
    readers: mpsc::Sender<Query>,
    limits: Arc<Limits>,
    reserve: Arc<Reserve>,
    file: Arc<FileIdentity>,
    /// User whose view this is.
    viewer: Viewer,
    /// Memory of the texts that are read.
    memory: Arc<Memory>,
}

impl Store {
    /// Opens or creates the file and migrates its schema.
    ///
    /// # Errors
    /// When the file cannot be opened, is not a database, is damaged, another program's, or of a later
    /// version.
    pub fn open(path: &Path, limits: &Arc<Limits>) -> Result<Self, StoreError> {
        reserve::make_private(path).map_err(StoreError::File)?;
        let mut connection = match open_writer(path) {
            // On a full disk SQLite cannot recover its log; the reserve has room for it.
            Err(error) if error.is_disk_full() && reserve::give_up_beside(path) => open_writer(path)?,
            opened => opened?,
        };
        let file = Arc::new(FileIdentity::of(path).map_err(StoreError::File)?);
        let (writer, work) = mpsc::channel::<Work>();
        let watched = Arc::clone(&file);
        spawn("store-writer".into(), move || {
            let mut left = watched.state(&connection);
            for task in work {
                watched.look(left.as_ref(), &connection);
                task(&mut connection);
                left = watched.state(&connection);
            }
        })?;
        let (readers, queries) = mpsc::channel::<Query>();
        let queries = Arc::new(Mutex::new(queries));
        for number in 0..READERS {
            let (connection, queries) = (open_reader(path)?, Arc::clone(&queries));
            spawn(format!("store-reader-{number}"), move || {
                while let Some(query) = next(&queries) {
                    query(&connection);
                }
            })?;
        }
        let reserve = Arc::new(Reserve::beside(path));
        let (limits, viewer, memory) = (Arc::clone(limits), Viewer::default(), Memory::new(u64::MAX));
        Ok(Self { writer, readers, limits, reserve, file, viewer, memory })
    }

    /// The same whose texts are read into this memory.
    pub fn within(self, memory: &Arc<Memory>) -> Self {
        Self { memory: Arc::clone(memory), ..self }
    }

    /// The same for a user, who sees scenes of others only as their owners allow.
    pub fn of(&self, viewer: Viewer) -> Self {
        Self { viewer, ..self.clone() }
    }

    /// Runs a query on a reader.
    async fn read<T: Send + 'static>(
        &self,
        task: impl FnOnce(&Connection) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, StoreError> {
        let (reply, done) = oneshot::channel();
        let query: Query = Box::new(move |connection| {
            // A caller that left no longer needs the reply.
            if !reply.is_closed() {
                let _ = reply.send(task(connection));
            }
        });
        self.readers.send(query).map_err(|_| StoreError::Closed)?;
        done.await.unwrap_or(Err(StoreError::Closed))
    }

    /// Runs a change in one transaction on the writer; returns after the commit.
    async fn write<T: Send + 'static>(
        &self,
        task: impl FnOnce(&rusqlite::Transaction<'_>) -> Result<T, StoreError> + Send + 'static,
    ) -> Result<T, StoreError> {
        let (reply, done) = oneshot::channel();
        let file = Arc::clone(&self.file);
        let work: Work = Box::new(move |connection| {
            // The change of a caller that left is dropped, unless it began already.
            if reply.is_closed() {
                return;
            }
            let result = (|| {
                let transaction =
                    connection.transaction_with_behavior(rusqlite::TransactionBehavior::Immediate)?;
                let value = task(&transaction)?;
                file.check()?;
                transaction.commit()?;
                Ok(value)
            })();
            let _ = reply.send(result);
        });
        self.writer.send(work).map_err(|_| StoreError::Closed)?;
        let result = done.await.unwrap_or(Err(StoreError::Closed));
        match &result {
            Ok(_) => self.reserve.note(false),
            Err(error) if error.is_disk_full() => self.reserve.note(true),
            Err(_) => {}
        }
        result
    }

    /// Returns the space of deleted pages and of the log to the disk.
    async fn give_back(&self) -> Result<(), StoreError> {
        let (reply, done) = oneshot::channel();
        let file = Arc::clone(&self.file);
        let work: Work = Box::new(move |connection| {
            let given = file.check().and_then(|()| {
                let given = shrink(connection);
                given.and(empty(connection))
            });
            let _ = reply.send(given);
        });
        self.writer.send(work).map_err(|_| StoreError::Closed)?;
        done.await.unwrap_or(Err(StoreError::Closed))
    }

    /// Whether a change can be written, and all readers are working.
    pub async fn is_ready(&self) -> bool {
        if self.reserve.is_full() {
            return false;
        }
        let read = self.read(|connection| Ok(connection.query_row("SELECT 1", [], |_| Ok(()))?));
        if !matches!(tokio::time::timeout(Duration::from_secs(2), read).await, Ok(Ok(()))) {
            return false;
        }
        let probe = self.write(|tx| Ok(tx.pragma_update(None, "user_version", migrations::LATEST)?));
        matches!(tokio::time::timeout(Duration::from_secs(2), probe).await, Ok(Ok(())))
    }
}

/// Removes the pages of deleted rows from the file, one per row of the result.
fn shrink(connection: &Connection) -> Result<(), StoreError> {
    let mut query = connection.prepare("PRAGMA incremental_vacuum")?;
    let mut rows = query.query([])?;
    while rows.next()?.is_some() {}
    Ok(())
}

/// Writes the log's pages into the file and truncates the log.
fn empty(connection: &Connection) -> Result<(), StoreError> {
    Ok(connection.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(()))?)
}

/// The next query, for any thread; `None` when the store is closed.
fn next(queries: &Mutex<mpsc::Receiver<Query>>) -> Option<Query> {
    queries.lock().unwrap_or_else(PoisonError::into_inner).recv().ok()
}

fn spawn(name: String, run: impl FnOnce() + Send + 'static) -> Result<(), StoreError> {
    std::thread::Builder::new().name(name).spawn(run).map(drop).map_err(StoreError::Thread)
}

/// Log pages (4 kB each) after which they are written into the file. A full disk must hold both.
const LOG_PAGES: i64 = 256;
/// Size to which the log's file is truncated.
const LOG_BYTES: i64 = 1 << 20;

fn prepare(connection: &Connection) -> Result<(), StoreError> {
    connection.busy_timeout(Duration::from_secs(5))?;
    // Only possible for an empty file: the space of deleted rows can be returned to the disk.
    connection.pragma_update(None, "auto_vacuum", "INCREMENTAL")?;
    connection.pragma_update(None, "journal_mode", "WAL")?;
    connection.pragma_update(None, "synchronous", "FULL")?;
    connection.pragma_update(None, "wal_autocheckpoint", LOG_PAGES)?;
    connection.pragma_update(None, "journal_size_limit", LOG_BYTES)?;
    connection.pragma_update(None, "foreign_keys", true)?;
    connection.pragma_update(None, "trusted_schema", false)?;
    Ok(())
}

fn open_writer(path: &Path) -> Result<Connection, StoreError> {
    let mut connection = Connection::open(path)?;
    migrations::check(&connection)?;
    prepare(&connection)?;
    migrations::run(&mut connection, path)?;
    Ok(connection)
}

fn open_reader(path: &Path) -> Result<Connection, StoreError> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(path, flags)?;
    connection.busy_timeout(Duration::from_secs(5))?;
    connection.pragma_update(None, "trusted_schema", false)?;
    Ok(connection)
}

#[cfg(test)]
mod tests;
