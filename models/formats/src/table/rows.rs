//! Rows of a table in any file format.

use super::columns::Wide;
use crate::columnar::{self, ColumnValue, is_parquet};
use crate::limits::MAX_DECODED_BYTES;
use crate::problem::{ReadError, code};
use crate::refusals::{self, wanted, what};
use crate::source::Source;
use crate::unpack::{self, Bounds, ZipEntry};
use std::collections::BTreeMap;
use std::io::{self, BufRead, Read};

/// Most bytes of a row of CSV.
const MAX_ROW: u64 = 64 << 10;
/// Most bytes of a row of a table with a row per road user: an hour at 25 Hz.
const MAX_WIDE_ROW: u64 = 8 << 20;
/// Most columns of CSV.
const MAX_COLUMNS: usize = 1_024;

/// A file with a table: one that was given, or one of a zip.
#[derive(Clone, Debug)]
pub(super) enum TableFile<'a> {
    Given(&'a dyn Source),
    Packed(ZipEntry),
}

impl<'a> TableFile<'a> {
    /// Its bytes from the beginning.
    ///
    /// # Errors
    /// When they cannot be read.
    pub fn open(&self) -> io::Result<Box<dyn Read + Send + 'a>> {
        match self {
            Self::Given(file) => file.open(),
            Self::Packed(entry) => Ok(entry.reader()),
        }
    }

    /// Size in bytes before decompression.
    pub fn encoded_len(&self) -> u64 {
        match self {
            Self::Given(file) => file.encoded_len(),
            Self::Packed(entry) => entry.encoded_len(),
        }
    }

    /// Size in bytes after unpacking from its zip.
    pub fn unpacked_len(&self) -> u64 {
        match self {
            Self::Given(file) => file.encoded_len(),
            Self::Packed(entry) => entry.unpacked_len(),
        }
    }
}

impl Source for TableFile<'_> {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        TableFile::open(self)
    }

    fn encoded_len(&self) -> u64 {
        TableFile::encoded_len(self)
    }
}

/// Rows of a table.
pub(super) enum Rows<'a> {
    Csv(CsvRows<'a>),
    Parquet(Box<columnar::ParquetTable>, Vec<usize>),
}

impl<'a> Rows<'a> {
    /// Opens a CSV file.
    ///
    /// # Errors
    /// Those of the file.
    pub fn csv(file: &TableFile<'a>, wide: Option<Wide>) -> Result<Self, ReadError> {
        CsvRows::open(file, wide).map(Self::Csv)
    }

    /// Opens a Parquet file.
    ///
    /// # Errors
    /// Those of the file.
    pub fn parquet(file: &dyn Source) -> Result<Self, ReadError> {
        Ok(Self::Parquet(Box::new(columnar::ParquetTable::open(file)?), Vec::new()))
    }

    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        match self {
            Self::Csv(rows) => &rows.names,
            Self::Parquet(table, _) => table.names(),
        }
    }

    /// Metadata of the file.
    pub fn notes(&self) -> BTreeMap<String, String> {
        match self {
            Self::Csv(_) => BTreeMap::new(),
            Self::Parquet(table, _) => table.notes(),
        }
    }

    /// Selects the columns to read, by position.
    ///
    /// # Errors
    /// Those of the file.
    pub fn choose(&mut self, mut columns: Vec<usize>) -> Result<(), ReadError> {
        columns.sort_unstable();
        columns.dedup();
        match self {
            Self::Csv(_) => Ok(()),
            Self::Parquet(table, chosen) => {
                chosen.clone_from(&columns);
                table.choose(columns)
            }
        }
    }

    /// Advances to the next row; false at the end.
    ///
    /// # Errors
    /// Those of the file.
    pub fn advance(&mut self) -> Result<bool, ReadError> {
        match self {
            Self::Csv(rows) => rows.advance(),
            Self::Parquet(table, _) => table.advance(),
        }
    }

    /// The value of a selected column, by position in the file.
    pub fn value(&self, column: usize) -> ColumnValue<'_> {
        match self {
            Self::Csv(rows) => rows.value(column),
            Self::Parquet(table, chosen) => {
                chosen.binary_search(&column).map_or(ColumnValue::Nothing, |at| table.value(at))
            }
        }
    }

    /// Position of the row, for messages.
    pub fn place(&self) -> String {
        match self {
            Self::Csv(rows) => format!("line {}", rows.record.position().map_or(0, csv::Position::line)),
            Self::Parquet(table, _) => format!("row {}", table.row()),
        }
    }
}

/// A reader that returns a limited number of bytes and then fails.
pub(super) struct BoundedReader<R> {
    inner: R,
    left: u64,
    most: u64,
}

impl<R: Read> Read for BoundedReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 {
            let most = self.most;
            let message = refusals::more_than(most, what::ROW_BYTES);
            return Err(unpack::excess(code::DECODED_TOO_LARGE, most, message));
        }
        let most = usize::try_from(self.left).unwrap_or(usize::MAX).min(buffer.len());
        let count = self.inner.read(buffer.get_mut(..most).unwrap_or_default())?;
        self.left -= count as u64;
        Ok(count)
    }
}

/// Rows of CSV, separated by commas, semicolons or tabs, with column names in the first line.
pub(super) struct CsvRows<'a> {
    reader: csv::Reader<BoundedReader<Box<dyn BufRead + 'a>>>,
    names: Vec<String>,
    record: csv::StringRecord,
    wide: Option<Wide>,
    /// Index of the repeated part of a wide row that is read; `None` before the first row.
    part: Option<usize>,
}

impl<'a> CsvRows<'a> {
    fn open(file: &TableFile<'a>, wide: Option<Wide>) -> Result<Self, ReadError> {
        let fault = |error: io::Error| unpack::fault(&error, 0);
        let head = unpack::head(file.open().map_err(fault)?);
        let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_DECODED_BYTES)));
        let mut input = input.map_err(fault)?;
        if is_parquet(&head) {
            return Err(ReadError::malformed(0, refusals::expected(wanted::CSV)));
        }
        let delimiter = delimiter(&head);
        if head.starts_with(b"\xef\xbb\xbf") {
            input.read_exact(&mut [0; 3]).map_err(fault)?;
        }
        let input: Box<dyn BufRead + 'a> = Box::new(input);
        // A row may begin at the end of the bytes that were read for the previous one.
        let most = if wide.is_some() { MAX_WIDE_ROW } else { MAX_ROW };
        let input = BoundedReader { inner: input, left: 2 * most, most };
        let reader = csv::ReaderBuilder::new()
            .delimiter(delimiter)
            .flexible(true)
            .has_headers(false)
            .buffer_capacity(MAX_ROW as usize / 4)
            .from_reader(input);
        let (names, record) = (Vec::new(), csv::StringRecord::new());
        let mut rows = Self { reader, names, record, wide, part: None };
        rows.next_record()?;
        // The names of a wide table may be repeated like its columns.
        let most = wide.map_or(MAX_COLUMNS, |Wide { fixed, repeated }| fixed + repeated);
        rows.names = rows.record.iter().take(most).map(|name| name.trim().to_owned()).collect();
        Ok(rows)
    }

    fn advance(&mut self) -> Result<bool, ReadError> {
        let Some(Wide { fixed, repeated }) = self.wide else { return self.next_record() };
        loop {
            let part = self.part.map_or(0, |part| part + 1);
            let from = fixed + part * repeated;
            let mut cells = (from..from + repeated).map(|at| self.record.get(at));
            // Rows may end with a separator: a part with an empty cell is not a part.
            if self.has_row() && cells.all(|cell| cell.is_some_and(|text| !text.trim().is_empty())) {
                self.part = Some(part);
                return Ok(true);
            }
            if !self.next_record()? {
                return Ok(false);
            }
            self.part = None;
        }
    }

    /// Whether the record is one of data, not the names.
    fn has_row(&self) -> bool {
        self.record.position().is_some_and(|position| position.record() > 0)
    }

    fn next_record(&mut self) -> Result<bool, ReadError> {
        let reader = self.reader.get_mut();
        reader.left = 2 * reader.most;
        let line = self.reader.position().line();
        let offset = self.reader.position().byte();
        self.reader.read_record(&mut self.record).map_err(|error| {
            let told = error.to_string();
            match error.into_kind() {
                csv::ErrorKind::Io(error) => unpack::fault(&error, offset),
                _ => ReadError::malformed(offset, refusals::parser_words(&told).at_line(line)),
            }
        })
    }

    fn value(&self, column: usize) -> ColumnValue<'_> {
        let part = self.wide.zip(self.part).filter(|(wide, _)| column >= wide.fixed);
        let column = part.map_or(column, |(wide, part)| column + part * wide.repeated);
        match self.record.get(column).map(str::trim) {
            None | Some("") => ColumnValue::Nothing,
            Some(text) => ColumnValue::Text(text),
        }
    }
}

/// Separator of values: the most frequent candidate in the first line.
pub(super) fn delimiter(head: &[u8]) -> u8 {
    let line = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let count = |delimiter: &u8| line.iter().filter(|byte| *byte == delimiter).count();
    // `max_by_key` returns the last of equal candidates: a comma if there are no separators.
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}
