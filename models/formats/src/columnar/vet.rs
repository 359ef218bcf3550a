//! Checks of a Parquet file's metadata before anything is allocated or decoded from it.

use super::thrift::ThriftReader;
use crate::problem::{ReadError, code};
use crate::refusals::{self, expected, wanted, what};
use scene::message::{Message, Word};
use std::ops::Range;

/// First and last bytes of a file.
pub(super) const MAGIC: &[u8] = b"PAR1";
/// Most bytes of the metadata at a file's end, plus an eighth of the file: decoded, they take many times as
/// much.
const MAX_FOOTER: usize = 1 << 20;
/// Most column chunks, plus one for each 512 bytes of the file.
const MAX_CHUNKS: u64 = 50_000;
/// Most bytes of a decompressed page.
const MAX_PAGE: i64 = 8 << 20;

/// A column's part of a row group.
pub(super) struct ColumnChunk {
    /// Byte range of its pages.
    pub range: Range<i64>,
    /// Least bytes of a value in a dictionary.
    pub least: i64,
    /// Rows of the group.
    pub rows: i64,
}

/// Checks the frame of a file and the structure of its metadata.
///
/// # Errors
/// `malformed-file`, `decoded-too-large`.
pub(super) fn frame(bytes: &[u8]) -> Result<(), ReadError> {
    let whole = bytes.len();
    let broken = |offset: usize, fault: Message| Err(ReadError::malformed(offset as u64, fault));
    if !bytes.starts_with(MAGIC) {
        return broken(0, expected(wanted::MAGIC));
    }
    let Some((rest, [a, b, c, d, magic @ ..])) = bytes.split_last_chunk::<8>() else {
        return broken(whole, expected(wanted::MAGIC));
    };
    if magic != MAGIC {
        return broken(whole - 4, expected(wanted::MAGIC));
    }
    let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
    let most = MAX_FOOTER + whole / 8;
    if length > most && length <= whole {
        let message = refusals::at_most(length, what::COLUMN_BYTES, most);
        return Err(ReadError::too_large(code::DECODED_TOO_LARGE, most as u64, message));
    }
    let Some(start) = rest.len().checked_sub(length).filter(|start| *start >= MAGIC.len()) else {
        return broken(whole - 8, refusals::at_most(length, what::COLUMN_BYTES, whole));
    };
    let footer = rest.get(start..).unwrap_or_default();
    let mut chunks = 0;
    let seen = ThriftReader::new(footer).each(|reader, field| {
        if field.id != 4 {
            return Some(false);
        }
        for _ in 0..reader.structs(field)? {
            reader.each(|reader, field| {
                if field.id != 1 {
                    return Some(false);
                }
                let count = reader.structs(field)?;
                chunks += count;
                for _ in 0..count {
                    reader.each(|_, _| Some(false))?;
                }
                Some(true)
            })?;
        }
        Some(true)
    });
    let most = MAX_CHUNKS + whole as u64 / 512;
    match seen {
        Some(()) if chunks <= most => Ok(()),
        Some(()) => broken(start, refusals::more_than(most, what::CHUNKS)),
        None => broken(start, expected(wanted::THRIFT)),
    }
}

/// Checks the headers of all pages of a chunk; returns the most bytes that it takes in memory at a time.
///
/// # Errors
/// `malformed-file`, `decoded-too-large`.
pub(super) fn pages(bytes: &[u8], chunk: &ColumnChunk) -> Result<u64, ReadError> {
    let broken = |offset: usize, wanted: Word| ReadError::malformed(offset as u64, expected(wanted));
    let ends = (usize::try_from(chunk.range.start), usize::try_from(chunk.range.end));
    let (Ok(mut at), Ok(end)) = ends else { return Err(broken(0, wanted::WITHIN_FILE)) };
    if at < MAGIC.len() || end > bytes.len() || at > end {
        return Err(broken(at, wanted::WITHIN_FILE));
    }
    let (mut values, mut largest, mut dictionary, mut first) = (0i64, 0i64, 0i64, true);
    while at < end && values < chunk.rows {
        let page = page(bytes.get(at..end).unwrap_or_default()).ok_or_else(|| broken(at, wanted::HEADER))?;
        if page.unpacked > MAX_PAGE {
            let message = refusals::at_most(page.unpacked as u64, what::PAGE_BYTES, MAX_PAGE as u64);
            return Err(ReadError::too_large(code::DECODED_TOO_LARGE, MAX_PAGE as u64, message));
        }
        let sound = page.packed >= 0 && page.unpacked >= 0 && page.values >= 0;
        // A dictionary comes first; no writer produces index pages.
        let in_place = if page.is_dictionary { first } else { page.kind != 1 };
        // Delta encodings allocate by their own data, which is known only after decompression.
        let readable = matches!(page.encoding, 0 | 2 | 3 | 8 | 9);
        if !(sound && in_place) {
            return Err(broken(at, wanted::HEADER_VALUES));
        }
        if !readable {
            return Err(broken(at, wanted::ENCODING));
        }
        if page.is_dictionary {
            if page.values.saturating_mul(chunk.least) > page.unpacked {
                return Err(broken(at, wanted::DICTIONARY_VALUES));
            }
            // A text of a few bytes takes 40 more for its position.
            dictionary = page.unpacked.saturating_add(page.values.saturating_mul(48));
        } else {
            values = values.saturating_add(page.values);
            largest = largest.max(page.unpacked);
        }
        first = false;
        at =
            at.saturating_add(page.header).saturating_add(usize::try_from(page.packed).unwrap_or(usize::MAX));
        if at > end {
            return Err(broken(end, wanted::PAGE_PLACE));
        }
    }
    if values != chunk.rows {
        return Err(broken(at, wanted::COLUMN_VALUES));
    }
    Ok(u64::try_from(dictionary.saturating_add(largest)).unwrap_or(u64::MAX))
}

/// Header of a page.
struct ColumnPage {
    header: usize,
    kind: i64,
    is_dictionary: bool,
    packed: i64,
    unpacked: i64,
    values: i64,
    encoding: i64,
}

fn page(bytes: &[u8]) -> Option<ColumnPage> {
    let mut page = ColumnPage {
        header: 0,
        kind: -1,
        is_dictionary: false,
        packed: -1,
        unpacked: -1,
        values: -1,
        encoding: -1,
    };
    let mut reader = ThriftReader::new(bytes);
    reader.each(|reader, field| {
        match field.id {
            1 => page.kind = reader.whole(field)?,
            2 => page.unpacked = reader.whole(field)?,
            3 => page.packed = reader.whole(field)?,
            // Data, dictionary, data of version 2: the encoding is the second number, of version 2 the fourth.
            id @ (5 | 7 | 8) => {
                let encoding = if id == 8 { 4 } else { 2 };
                reader.each(|reader, field| {
                    match field.id {
                        1 => page.values = reader.whole(field)?,
                        id if id == encoding => page.encoding = reader.whole(field)?,
                        _ => return Some(false),
                    }
                    Some(true)
                })?;
            }
            _ => return Some(false),
        }
        Some(true)
    })?;
    page.is_dictionary = page.kind == 2;
    page.header = reader.position();
    Some(page)
}
