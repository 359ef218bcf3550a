//! Reads SQLite files of others from memory: no other file is opened, nothing in them is executed, and rows,
//! bytes and steps are bounded by the size of the file.

use crate::limits::MAX_DECODED_BYTES;
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, more_than, what};
use crate::source::Source;
use crate::unpack;
use rusqlite::config::DbConfig;
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, MAIN_DB, Row};
use std::cell::Cell;
use std::collections::HashMap;
use std::io::{self, Read};

/// First bytes of an SQLite file.
pub(super) const MAGIC: &[u8] = b"SQLite format 3\0";
/// Zero bytes after the file: SQLite may read past the end of a broken one, by less than its largest page.
const BEHIND: u64 = 64 << 10;
/// Steps of SQLite's virtual machine per byte of the file, and for any file. A row of the tables takes some
/// tens.
const STEPS_A_BYTE: u64 = 4;
const STEPS_ANYWAY: u64 = 2_000_000;
/// Steps between two checks of their count.
const STEPS_AT_A_TIME: i32 = 1_000;
/// Greatest length of a value, number of columns of a table and depth of an expression.
const LIMITS: [(Limit, i32); 4] = [
    (Limit::SQLITE_LIMIT_LENGTH, 16 << 20),
    (Limit::SQLITE_LIMIT_COLUMN, 200),
    (Limit::SQLITE_LIMIT_EXPR_DEPTH, 50),
    (Limit::SQLITE_LIMIT_ATTACHED, 0),
];

/// An open file.
pub(super) struct Database {
    connection: Connection,
    /// Columns of each table.
    tables: HashMap<String, Vec<String>>,
    /// Bytes of texts and blobs that may still be read: pages of a broken file can be shared.
    bytes_left: Cell<u64>,
}

impl Database {
    /// # Errors
    /// `decoded-too-large`, `malformed-file` for what SQLite does not open.
    pub fn open(file: &dyn Source) -> Result<Self, ReadError> {
        let size = size(file).map_err(|error| unpack::fault(&error, 0))?;
        if size > MAX_DECODED_BYTES {
            let message = more_than(MAX_DECODED_BYTES, what::BYTES);
            return Err(ReadError::too_large(code::DECODED_TOO_LARGE, MAX_DECODED_BYTES, message));
        }
        let (connection, tables) = opened(file, size).map_err(|error| malformed(&error))?;
        Ok(Self { connection, tables, bytes_left: Cell::new(2 * size) })
    }

    /// Whether the table exists.
    pub fn has(&self, table: &str) -> bool {
        self.tables.contains_key(table)
    }

    /// Passes on the rows of a table: the row id, then these columns. A missing column is empty.
    ///
    /// # Errors
    /// `cannot-represent` for a missing table, `malformed-file` for a broken one, `out-of-range` for more
    /// rows than the file can hold.
    pub fn rows(
        &self,
        table: &str,
        columns: &[&str],
        mut take: impl FnMut(&DatabaseRow<'_>),
    ) -> Result<(), ReadError> {
        let missing = || ReadError::other_content(refusals::no_table(table));
        let known = self.tables.get(table).ok_or_else(missing)?;
        let listed = columns.iter().map(|column| {
            let known = known.iter().any(|known| known.eq_ignore_ascii_case(column));
            if known { quoted(column) } else { "NULL".to_owned() }
        });
        let listed: Vec<String> = std::iter::once("rowid".to_owned()).chain(listed).collect();
        let query = format!("SELECT {} FROM {}", listed.join(", "), quoted(table));
        let broken = |error: rusqlite::Error| malformed(&error).under(&format!("/{table}"));
        let mut statement = self.connection.prepare(&query).map_err(broken)?;
        let mut rows = statement.query([]).map_err(broken)?;
        while let Some(row) = rows.next().map_err(broken)? {
            let row = DatabaseRow { row };
            let bytes: u64 = (0..columns.len()).map(|i| row.bytes(i).len() as u64).sum();
            let Some(left) = self.bytes_left.get().checked_sub(bytes) else {
                let message = more_than(self.bytes_left.get(), what::BYTES);
                return Err(FieldProblem::new(format!("/{table}"), code::OUT_OF_RANGE, message).into());
            };
            self.bytes_left.set(left);
            take(&row);
        }
        Ok(())
    }
}

/// A row of a table.
pub(super) struct DatabaseRow<'a> {
    row: &'a Row<'a>,
}

impl DatabaseRow<'_> {
    /// Its number in the table.
    pub fn id(&self) -> i64 {
        self.row.get(0).unwrap_or_default()
    }

    fn value(&self, column: usize) -> ValueRef<'_> {
        self.row.get_ref(column + 1).unwrap_or(ValueRef::Null)
    }

    /// A text or blob; nothing for other values.
    pub fn bytes(&self, column: usize) -> &[u8] {
        match self.value(column) {
            ValueRef::Text(bytes) | ValueRef::Blob(bytes) => bytes,
            _ => &[],
        }
    }

    /// A text.
    pub fn text(&self, column: usize) -> String {
        String::from_utf8_lossy(self.bytes(column)).into_owned()
    }

    /// A number; NaN for other values.
    pub fn number(&self, column: usize) -> f64 {
        match self.value(column) {
            ValueRef::Real(value) => value,
            ValueRef::Integer(value) => value as f64,
            _ => f64::NAN,
        }
    }

    /// A finite number above zero.
    pub fn positive(&self, column: usize) -> Option<f64> {
        Some(self.number(column)).filter(|value| value.is_finite() && *value > 0.0)
    }

    /// An integer; GeoPackages store them as numbers and as texts.
    pub fn whole(&self, column: usize) -> Option<i64> {
        match self.value(column) {
            ValueRef::Integer(value) => Some(value),
            ValueRef::Real(value) => (value.fract() == 0.0 && value.abs() < 1e15).then_some(value as i64),
            ValueRef::Text(text) => std::str::from_utf8(text).ok()?.trim().parse().ok(),
            _ => None,
        }
    }
}

/// Bytes of a decoded file, counted up to one more than the limit.
fn size(file: &dyn Source) -> io::Result<u64> {
    io::copy(&mut file.open()?.take(MAX_DECODED_BYTES + 1), &mut io::sink())
}

fn opened(file: &dyn Source, size: u64) -> rusqlite::Result<(Connection, HashMap<String, Vec<String>>)> {
    let unread = |error: io::Error| rusqlite::Error::ToSqlConversionFailure(Box::new(error));
    let mut connection = Connection::open_in_memory()?;
    for (limit, most) in LIMITS {
        connection.set_limit(limit, most)?;
    }
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_VIEW, false)?;
    connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_TRIGGER, false)?;
    let mut input = file.open().map_err(unread)?;
    let mut head = Vec::new();
    input.by_ref().take(100).read_to_end(&mut head).map_err(unread)?;
    // A separate write-ahead log is not opened; without this change SQLite requires one.
    head.get_mut(18..20).into_iter().flatten().for_each(|version| *version = 1);
    let whole = io::Cursor::new(head).chain(input).take(size).chain(io::repeat(0));
    let bytes = usize::try_from(size + BEHIND).unwrap_or(usize::MAX);
    connection.deserialize_read_exact(MAIN_DB, whole, bytes, true)?;
    let mut left = size.saturating_mul(STEPS_A_BYTE).saturating_add(STEPS_ANYWAY);
    let count = move || {
        left = left.saturating_sub(STEPS_AT_A_TIME as u64);
        left == 0
    };
    connection.progress_handler(STEPS_AT_A_TIME, Some(count))?;
    connection.pragma_update(None, "cell_size_check", true)?;
    let tables = tables(&connection)?;
    Ok((connection, tables))
}

/// Tables with their columns, without views, virtual tables and computed columns.
fn tables(connection: &Connection) -> rusqlite::Result<HashMap<String, Vec<String>>> {
    let query = "SELECT name FROM sqlite_master WHERE type = 'table' AND rootpage > 0";
    let names: Vec<String> =
        connection.prepare(query)?.query_map([], |row| row.get(0))?.collect::<Result<_, _>>()?;
    let columns = |name: String| {
        let mut columns = Vec::new();
        connection.pragma(None, "table_info", &name, |row| {
            columns.push(row.get::<_, String>("name")?);
            Ok(())
        })?;
        Ok((name, columns))
    };
    names.into_iter().map(columns).collect()
}

/// A name quoted for SQL.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

fn malformed(error: &rusqlite::Error) -> ReadError {
    ReadError::malformed(0, refusals::unreadable("SQLite", &error.to_string()))
}
