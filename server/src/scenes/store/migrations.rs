//! The schema and its history. `user_version` is the number of steps that a file has taken.

use super::{StoreError, backup};
use rusqlite::Connection;
use std::path::Path;

/// One SQL script per version; released scripts never change.
const STEPS: &[&str] = &[
    "
    CREATE TABLE maps (
        sha        TEXT PRIMARY KEY,
        bytes      INTEGER NOT NULL,
        polylines  INTEGER NOT NULL,
        points     INTEGER NOT NULL,
        body       BLOB NOT NULL,
        used_at    INTEGER NOT NULL
    ) STRICT;
    CREATE TABLE scenes (
        id         TEXT PRIMARY KEY,
        rev        INTEGER NOT NULL,
        etag       TEXT NOT NULL,
        name       TEXT NOT NULL,
        tags       TEXT NOT NULL,
        parent_id  TEXT,
        map_sha    TEXT NOT NULL REFERENCES maps(sha),
        meta       TEXT NOT NULL,
        body       BLOB NOT NULL,
        created_at TEXT NOT NULL,
        updated_at TEXT NOT NULL
    ) STRICT;
    CREATE INDEX scenes_by_time ON scenes(updated_at);
    CREATE INDEX scenes_by_map ON scenes(map_sha);
",
    "
    ALTER TABLE scenes ADD COLUMN owner TEXT;
    ALTER TABLE scenes ADD COLUMN shared TEXT NOT NULL DEFAULT 'nobody';
    CREATE INDEX scenes_by_owner ON scenes(owner);
",
];

/// `application_id` of our files: "DrTr".
const OURS: i32 = 0x4472_5472;

/// Newest schema this program knows.
pub const LATEST: i64 = STEPS.len() as i64;

/// Checks that a file is a store, or new, before it is changed. Files of the first schema have no
/// `application_id`: they are recognised by their tables.
///
/// # Errors
/// [`StoreError::Foreign`] for another program's database, [`StoreError::Broken`] for a damaged one.
pub fn check(connection: &Connection) -> Result<(), StoreError> {
    let id: i32 = connection.pragma_query_value(None, "application_id", |row| row.get(0))?;
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let tables = |sql: &str| connection.query_row(sql, [], |row| row.get::<_, i64>(0));
    let any = tables("SELECT count(*) FROM sqlite_master")?;
    let own =
        tables("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('maps', 'scenes')")?;
    let fits = if version == 0 { any == 0 } else { own == 2 || version > LATEST };
    if id != OURS && !(id == 0 && fits) {
        return Err(StoreError::Foreign);
    }
    look_through(connection, "quick_check")
}

/// Runs an integrity check of SQLite.
///
/// # Errors
/// [`StoreError::Broken`] with the first finding, in one line.
pub fn look_through(connection: &Connection, pragma: &str) -> Result<(), StoreError> {
    let found: String = connection.query_row(&format!("PRAGMA {pragma}(1)"), [], |row| row.get(0))?;
    if found == "ok" {
        return Ok(());
    }
    let lines: Vec<&str> = found.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    Err(StoreError::Broken(lines.join(" ")))
}

/// Migrates a file in one transaction, after a copy beside it.
///
/// # Errors
/// When the file is newer, or a step fails; the file is then unchanged.
pub fn run(connection: &mut Connection, path: &Path) -> Result<(), StoreError> {
    take(STEPS, connection, path)
}

/// Runs the steps that a file has not taken yet.
fn take(steps: &[&str], connection: &mut Connection, path: &Path) -> Result<(), StoreError> {
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let latest = steps.len() as i64;
    if version > latest {
        return Err(StoreError::Newer(version));
    }
    let id: i32 = connection.pragma_query_value(None, "application_id", |row| row.get(0))?;
    if version == latest && id == OURS {
        return Ok(());
    }
    if version > 0 && version < latest {
        let copy = path.with_extension(format!("v{version}.sqlite"));
        if !copy.exists() {
            backup::copy(connection, &copy)?;
        }
    }
    let transaction = connection.transaction()?;
    for step in steps.iter().skip(usize::try_from(version).unwrap_or(0)) {
        transaction.execute_batch(step)?;
    }
    transaction.pragma_update(None, "user_version", latest)?;
    transaction.pragma_update(None, "application_id", OURS)?;
    transaction.commit()?;
    Ok(())
}

#[cfg(test)]
mod tests;
