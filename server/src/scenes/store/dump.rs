//! All scenes of a store's file, one after the other, in one snapshot.

use super::records::{SUMMARY, summary};
use super::{SceneSummary, StoreError, migrations, open_reader};
use rusqlite::{Connection, OptionalExtension};
use std::path::Path;

/// A saved scene as it is stored.
pub struct DumpedScene {
    /// Facts.
    pub summary: SceneSummary,
    /// Native JSON, the map by reference.
    pub json: Vec<u8>,
    /// Native JSON of its map.
    pub map: Vec<u8>,
}

/// Calls `take` with each scene, by id, until it fails. A server may use the file: later writes are not seen.
///
/// # Errors
/// When the file is not a store, is damaged or of a later version, and those of `take`.
pub fn each<E: From<StoreError>>(
    path: &Path,
    take: &mut dyn FnMut(DumpedScene) -> Result<(), E>,
) -> Result<(), E> {
    let connection = opened(path)?;
    // One transaction is one snapshot; it ends with the connection.
    connection.execute_batch("BEGIN").map_err(StoreError::from)?;
    let mut last = String::new();
    while let Some(scene) = after(&connection, &last)? {
        last.clone_from(&scene.summary.id);
        take(scene)?;
    }
    Ok(())
}

/// Number of saved scenes in a file that this program can serve.
///
/// # Errors
/// As [`each`].
pub fn count(path: &Path) -> Result<u64, StoreError> {
    let count: i64 = opened(path)?.query_row("SELECT count(*) FROM scenes", [], |row| row.get(0))?;
    Ok(count.unsigned_abs())
}

/// A connection to a file that was checked: it is a store, sound and not too new.
fn opened(path: &Path) -> Result<Connection, StoreError> {
    let connection = open_reader(path)?;
    migrations::check(&connection)?;
    match connection.pragma_query_value(None, "user_version", |row| row.get(0))? {
        0 => Err(StoreError::Empty),
        version if version > migrations::LATEST => Err(StoreError::Newer(version)),
        _ => Ok(connection),
    }
}

/// The scene with the next id.
fn after(connection: &Connection, id: &str) -> Result<Option<DumpedScene>, StoreError> {
    let sql = format!("SELECT {SUMMARY}, body FROM scenes WHERE id > ?1 ORDER BY id LIMIT 1");
    let mut query = connection.prepare_cached(&sql)?;
    let row = query.query_row([id], |row| Ok((summary(row)?, row.get::<_, Vec<u8>>(12)?))).optional()?;
    let Some((summary, packed)) = row else { return Ok(None) };
    let mut query = connection.prepare_cached("SELECT body FROM maps WHERE sha = ?1")?;
    let map: Option<Vec<u8>> = query.query_row([&summary.map_sha], |row| row.get(0)).optional()?;
    let map = map.ok_or(StoreError::MissingMap)?;
    let (json, map) = (zstd::decode_all(packed.as_slice())?, zstd::decode_all(map.as_slice())?);
    Ok(Some(DumpedScene { summary, json, map }))
}
