//! Reads flat columns of a Parquet file, row by row.

use super::vet::{self, ColumnChunk, MAGIC};
use crate::limits::memory_for;
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, expected, found_expected, more_than, wanted, what};
use crate::source::Source;
use crate::unpack;
use bytes::Bytes;
use parquet::basic::Type;
use parquet::column::reader::ColumnReader;
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use std::collections::BTreeMap;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Most bytes of a file. The whole file is in memory, because its metadata is at its end. A file that was
/// decompressed on the way is measured by the bytes before decompression.
fn most_bytes(file: &dyn Source) -> u64 {
    (memory_for(file.encoded_len()) / 4).min(256 << 20)
}
/// Most bytes that the current pages of all columns take, beside the file.
const MAX_PAGES: u64 = 40 << 20;
/// Most rows of a file, plus one per byte: repeated values take no bytes, so bytes do not bound the rows.
const MAX_ROWS: u64 = 1 << 20;
/// Rows that are decoded at a time.
const BATCH: usize = 1_024;
/// Bytes at the end of a file that contain the names of its columns.
const TAIL: usize = 64 << 10;

/// True for the first bytes of a Parquet file.
pub(crate) fn is_parquet(head: &[u8]) -> bool {
    head.starts_with(MAGIC)
}

/// Whether all these names occur at the end of a Parquet file.
pub(crate) fn names_in(bytes: &[u8], names: &[&str]) -> bool {
    let tail = bytes.get(bytes.len().saturating_sub(TAIL)..).unwrap_or_default();
    let has = |name: &&str| tail.windows(name.len()).any(|window| window == name.as_bytes());
    is_parquet(bytes) && names.iter().all(has)
}

/// A value of a row, held by the reader.
#[derive(Clone, Debug, PartialEq)]
enum OwnedValue {
    Nothing,
    Flag(bool),
    Whole(i64),
    Number(f64),
    Text(ByteArray),
}

/// A value of a row, as readers of tables take it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum ColumnValue<'a> {
    Nothing,
    Flag(bool),
    Whole(i64),
    Number(f64),
    Text(&'a str),
}

/// A Parquet file that is being read.
pub struct ParquetTable {
    file: Bytes,
    reader: SerializedFileReader<Bytes>,
    names: Vec<String>,
    /// Index in the file of each selected column.
    chosen: Vec<usize>,
    /// The row group that is read next, and the readers of the previous one.
    group: usize,
    readers: Vec<ColumnReader>,
    left: usize,
    batch: Vec<Vec<OwnedValue>>,
    at: usize,
    row: u64,
}

const FORMAT: &str = "Parquet";

fn unreadable(error: &ParquetError) -> ReadError {
    ReadError::malformed(0, refusals::unreadable(FORMAT, &error.to_string()))
}

/// Runs work that panics on false metadata, and turns the panic into a refusal of the file.
fn guarded<T>(work: impl FnOnce() -> Result<T, ReadError>) -> Result<T, ReadError> {
    let ended = |_| Err(ReadError::malformed(0, refusals::contradiction(FORMAT)));
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(ended)
}

impl ParquetTable {
    /// Opens a file and checks its metadata.
    ///
    /// # Errors
    /// `malformed-file`, `decoded-too-large`, `cannot-represent` for more columns or rows than can be read.
    pub fn open(file: &dyn Source) -> Result<Self, ReadError> {
        let mut bytes = Vec::new();
        let fault = |error: &std::io::Error| unpack::fault(error, 0);
        let input = file.open().map_err(|error| fault(&error))?;
        let most = most_bytes(file);
        input.take(most + 1).read_to_end(&mut bytes).map_err(|error| fault(&error))?;
        if bytes.len() as u64 > most {
            let message = more_than(most, what::FILE_BYTES);
            return Err(ReadError::too_large(code::DECODED_TOO_LARGE, most, message));
        }
        vet::frame(&bytes)?;
        let file = Bytes::from(bytes);
        guarded(|| {
            let reader = SerializedFileReader::new(file.clone()).map_err(|error| unreadable(&error))?;
            let columns = reader.metadata().file_metadata().schema_descr().columns();
            let names = columns.iter().map(|column| column.path().parts().join(".")).collect();
            let most = MAX_ROWS + file.len() as u64;
            let rows = |group: &parquet::file::metadata::RowGroupMetaData| u64::try_from(group.num_rows());
            let mut rows = reader.metadata().row_groups().iter().map(rows);
            let rows = rows.try_fold(0u64, |sum, rows| rows.ok().and_then(|rows| sum.checked_add(rows)));
            if rows.is_none_or(|rows| rows > most) {
                let message = more_than(most, what::ROWS);
                return Err(ReadError::too_large(code::DECODED_TOO_LARGE, most, message));
            }
            let (readers, batch, chosen) = (Vec::new(), Vec::new(), Vec::new());
            Ok(Self {
                file: file.clone(),
                reader,
                names,
                chosen,
                group: 0,
                readers,
                left: 0,
                batch,
                at: 0,
                row: 0,
            })
        })
    }

    /// Names of all columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Key-value metadata of the file.
    pub fn notes(&self) -> BTreeMap<String, String> {
        let notes = self.reader.metadata().file_metadata().key_value_metadata();
        let notes = notes.into_iter().flatten();
        notes.filter_map(|note| Some((note.key.clone(), note.value.clone()?))).collect()
    }

    /// Selects the columns to read, and checks all their pages.
    ///
    /// # Errors
    /// `malformed-file`, `decoded-too-large`, `cannot-represent` for a column that is not a flat list of
    /// values.
    pub fn choose(&mut self, chosen: Vec<usize>) -> Result<(), ReadError> {
        for &column in &chosen {
            self.is_flat(column)?;
        }
        let metadata = self.reader.metadata();
        for group in metadata.row_groups() {
            let mut together = 0u64;
            for &column in &chosen {
                let missing = || ReadError::malformed(0, expected(wanted::ROW_GROUP));
                let chunk = group.columns().get(column).ok_or_else(missing)?;
                let start = chunk.dictionary_page_offset().unwrap_or(chunk.data_page_offset());
                let least = match chunk.column_type() {
                    Type::INT32 | Type::FLOAT | Type::BYTE_ARRAY => 4,
                    Type::INT64 | Type::DOUBLE => 8,
                    _ => 0,
                };
                let range = start..start.saturating_add(chunk.compressed_size().max(0));
                let chunk = ColumnChunk { range, least, rows: group.num_rows() };
                together = together.saturating_add(vet::pages(&self.file, &chunk)?);
            }
            if together > MAX_PAGES + self.file.len() as u64 {
                let message = more_than(MAX_PAGES, what::GROUP_BYTES);
                return Err(ReadError::too_large(code::DECODED_TOO_LARGE, MAX_PAGES, message));
            }
        }
        self.batch = vec![Vec::new(); chosen.len()];
        self.chosen = chosen;
        Ok(())
    }

    fn is_flat(&self, column: usize) -> Result<(), ReadError> {
        let columns = self.reader.metadata().file_metadata().schema_descr().columns();
        let Some(column) = columns.get(column) else { return Ok(()) };
        let known = !matches!(column.physical_type(), Type::INT96 | Type::FIXED_LEN_BYTE_ARRAY);
        if column.max_rep_level() == 0 && column.max_def_level() <= 1 && known {
            return Ok(());
        }
        let name = column.path().parts().join(".");
        let message = found_expected(column.physical_type().to_string(), wanted::FLAT_COLUMN);
        Err(FieldProblem::new(format!("/{name}"), code::CANNOT_REPRESENT, message).into())
    }

    /// Advances to the next row; false at the end.
    ///
    /// # Errors
    /// `malformed-file`.
    pub fn advance(&mut self) -> Result<bool, ReadError> {
        self.row += 1;
        self.at += 1;
        if self.batch.first().is_some_and(|column| self.at < column.len()) {
            return Ok(true);
        }
        self.at = 0;
        guarded(|| self.decode())
    }

    /// Number of the row, from 1.
    pub fn row(&self) -> u64 {
        self.row
    }

    /// Value of the current row, by index among the selected columns.
    pub fn value(&self, column: usize) -> ColumnValue<'_> {
        match self.batch.get(column).and_then(|cells| cells.get(self.at)) {
            None | Some(OwnedValue::Nothing) => ColumnValue::Nothing,
            Some(OwnedValue::Flag(flag)) => ColumnValue::Flag(*flag),
            Some(OwnedValue::Whole(whole)) => ColumnValue::Whole(*whole),
            Some(OwnedValue::Number(number)) => ColumnValue::Number(*number),
            Some(OwnedValue::Text(text)) => text.as_utf8().map_or(ColumnValue::Nothing, ColumnValue::Text),
        }
    }

    /// Decodes the next rows of the group, or of the next group that has any.
    fn decode(&mut self) -> Result<bool, ReadError> {
        while self.left == 0 {
            if self.group >= self.reader.num_row_groups() {
                self.batch.iter_mut().for_each(Vec::clear);
                return Ok(false);
            }
            let group = self.reader.get_row_group(self.group).map_err(|error| unreadable(&error))?;
            let readers = self.chosen.iter().map(|column| group.get_column_reader(*column));
            self.readers = readers.collect::<Result<_, _>>().map_err(|error| unreadable(&error))?;
            self.left = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
            self.group += 1;
        }
        let count = self.left.min(BATCH);
        for (reader, cells) in self.readers.iter_mut().zip(&mut self.batch) {
            cells.clear();
            fill(reader, count, cells).map_err(|error| unreadable(&error))?;
            if cells.len() != count {
                return Err(ReadError::malformed(0, expected(wanted::COLUMN_VALUES)));
            }
        }
        self.left -= count;
        Ok(count > 0 && !self.batch.is_empty())
    }
}

/// Reads this many values of a column.
fn fill(reader: &mut ColumnReader, count: usize, cells: &mut Vec<OwnedValue>) -> Result<(), ParquetError> {
    macro_rules! read {
        ($reader:expr, $cell:expr) => {{
            let (mut values, mut levels) = (Vec::new(), Vec::new());
            let (records, known, _) = $reader.read_records(count, Some(&mut levels), None, &mut values)?;
            let mut values = values.into_iter().take(known).map($cell);
            // Without levels every value is present.
            let present = (0..records).map(|i| levels.get(i).is_none_or(|level| *level > 0));
            cells.extend(
                present.map(|there| if there { values.next() } else { None }.unwrap_or(OwnedValue::Nothing)),
            );
        }};
    }
    match reader {
        ColumnReader::BoolColumnReader(reader) => read!(reader, OwnedValue::Flag),
        ColumnReader::Int32ColumnReader(reader) => read!(reader, |v| OwnedValue::Whole(i64::from(v))),
        ColumnReader::Int64ColumnReader(reader) => read!(reader, OwnedValue::Whole),
        ColumnReader::FloatColumnReader(reader) => read!(reader, |v| OwnedValue::Number(f64::from(v))),
        ColumnReader::DoubleColumnReader(reader) => read!(reader, OwnedValue::Number),
        ColumnReader::ByteArrayColumnReader(reader) => read!(reader, OwnedValue::Text),
        ColumnReader::Int96ColumnReader(_) | ColumnReader::FixedLenByteArrayColumnReader(_) => {}
    }
    Ok(())
}
