use super::{OURS, STEPS, StoreError, take};
use rusqlite::Connection;
use std::path::Path;

/// A step of a later version; it leaves a trace each time it runs.
const NEXT: &str = "CREATE TABLE IF NOT EXISTS trace (step TEXT); INSERT INTO trace VALUES ('next');";
const LAST: &str = "ALTER TABLE scenes ADD COLUMN stars INTEGER NOT NULL DEFAULT 0;
    INSERT INTO trace VALUES ('last');";

fn opened(path: &Path, steps: &[&str]) -> Result<Connection, StoreError> {
    let mut connection = Connection::open(path)?;
    take(steps, &mut connection, path)?;
    Ok(connection)
}

fn number(connection: &Connection, sql: &str) -> i64 {
    connection.query_row(sql, [], |row| row.get(0)).unwrap()
}

fn one_scene(connection: &Connection) {
    let sql = "INSERT INTO maps VALUES ('aa', 1, 1, 1, x'00', 0);
        INSERT INTO scenes (id, rev, etag, name, tags, parent_id, map_sha, meta, body, created_at, updated_at)
            VALUES ('a', 1, '\"1\"', 'one', '[]', NULL, 'aa', '{}', x'00', '', '');";
    connection.execute_batch(sql).unwrap();
}

#[test]
fn each_step_runs_once_after_a_copy() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    one_scene(&opened(&path, STEPS).unwrap());
    let first = STEPS.len() as i64;
    let steps = [STEPS, &[NEXT]].concat();
    let later = [STEPS, &[NEXT, LAST]].concat();
    for steps in [&steps, &steps, &later, &later] {
        let connection = opened(&path, steps).unwrap();
        assert_eq!(number(&connection, "PRAGMA user_version"), steps.len() as i64);
        assert_eq!(number(&connection, "PRAGMA application_id"), i64::from(OURS));
        assert_eq!(number(&connection, "SELECT count(*) FROM trace"), steps.len() as i64 - first);
        assert_eq!(number(&connection, "SELECT count(*) FROM scenes"), 1);
    }
    for version in [first, first + 1] {
        let copy = path.with_extension(format!("v{version}.sqlite"));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert_eq!(copy.metadata().unwrap().permissions().mode() & 0o777, 0o600);
        }
        let copy = Connection::open(copy).unwrap();
        assert_eq!(number(&copy, "PRAGMA user_version"), version, "the copy is as the file was");
        assert_eq!(number(&copy, "SELECT count(*) FROM scenes"), 1);
    }
}

#[test]
fn a_step_that_fails_leaves_the_file_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    one_scene(&opened(&path, STEPS).unwrap());
    let steps = [STEPS, &[NEXT, "CREATE TABLE scenes (id TEXT);"]].concat();
    assert!(opened(&path, &steps).is_err());
    let connection = opened(&path, STEPS).unwrap();
    assert_eq!(number(&connection, "PRAGMA user_version"), STEPS.len() as i64);
    assert_eq!(number(&connection, "SELECT count(*) FROM sqlite_master WHERE name = 'trace'"), 0);
}

#[test]
fn a_later_file_is_refused_with_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.sqlite");
    drop(opened(&path, &[STEPS, &[NEXT]].concat()).unwrap());
    let refused = opened(&path, STEPS).unwrap_err();
    let (has, knows) = (STEPS.len() + 1, STEPS.len());
    assert_eq!(refused.to_string(), format!("the file has schema {has}, this program knows up to {knows}"));
}
