//! The schema and its history. `user_version` says how many steps a file has taken.

use super::StoreError;
use rusqlite::Connection;
use std::path::Path;

/// One SQL script a version; scripts that were released are never changed.
const STEPS: &[&str] = &["
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
"];

/// Newest schema this program knows.
pub const LATEST: i64 = STEPS.len() as i64;

/// Brings a file up to date in one transaction, after a copy beside it.
///
/// # Errors
/// When the file is newer, or a step fails; the file is then as before.
pub fn run(connection: &mut Connection, path: &Path) -> Result<(), StoreError> {
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    if version > LATEST {
        return Err(StoreError::Newer(version));
    }
    if version == LATEST {
        return Ok(());
    }
    if version > 0 {
        let copy = path.with_extension(format!("v{version}.sqlite"));
        if !copy.exists() {
            connection.execute("VACUUM INTO ?1", [copy.to_string_lossy()])?;
        }
    }
    let transaction = connection.transaction()?;
    for step in STEPS.iter().skip(usize::try_from(version).unwrap_or(0)) {
        transaction.execute_batch(step)?;
    }
    transaction.pragma_update(None, "user_version", LATEST)?;
    transaction.commit()?;
    Ok(())
}
