//! Bytes of a file, plain or compressed with gzip, decompressed within limits while they are read.

use crate::limits::MAX_EXPANSION;
use crate::problem::{ReadError, code};
use crate::refusals::{self, more_than, what};
use crate::source::Source;
use flate2::CrcReader;
use flate2::read::{DeflateDecoder, MultiGzDecoder};
use scene::message::Message;
use std::fmt;
use std::io::{self, BufRead, BufReader, Read};
use std::ops::Range;
use std::sync::Arc;
use zip::result::ZipError;
use zip::{CompressionMethod, ZipArchive};

/// The expansion ratio is checked after this many decoded bytes.
const RATIO_FROM: u64 = 1 << 20;
/// Most files of a zip that are examined.
const MAX_FILES: usize = 1_000;
/// Bytes that are decoded at a time.
const PIECE: usize = 64 << 10;

/// Limits of a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// Most bytes once decoded.
    pub decoded: u64,
    /// Greatest ratio of decoded to encoded bytes, after the first MiB.
    pub expansion: u64,
}

impl Bounds {
    /// At most this many decoded bytes, at the usual ratio.
    pub fn of(decoded: u64) -> Self {
        Self { decoded, expansion: MAX_EXPANSION }
    }
}

/// An exceeded limit; travels inside an `io::Error`.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Excess {
    code: &'static str,
    limit: u64,
    message: Message,
}

/// An exceeded limit, for [`fault`].
pub(crate) fn excess(code: &'static str, limit: u64, message: Message) -> io::Error {
    io::Error::other(Excess { code, limit, message })
}

/// Counts the bytes that are read.
struct CountingReader<R> {
    inner: R,
    count: u64,
}

impl<R: Read> Read for CountingReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer)?;
        self.count += n as u64;
        Ok(n)
    }
}

type Whole<R> = CountingReader<io::Chain<io::Cursor<Vec<u8>>, R>>;

enum Inner<R: Read> {
    Plain(Whole<R>),
    Gzip(Box<MultiGzDecoder<Whole<R>>>),
}

/// Decoded bytes of a file.
pub(crate) struct Unpacked<R: Read> {
    inner: Inner<R>,
    decoded: u64,
    bounds: Bounds,
}

impl<R: Read> Read for Unpacked<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let left = self.bounds.decoded.saturating_sub(self.decoded);
        // Reading one byte past the limit distinguishes the end of the file from a file that is too large.
        let most = usize::try_from(left).unwrap_or(usize::MAX).clamp(1, buffer.len().max(1));
        let buffer = buffer.get_mut(..most).unwrap_or_default();
        let n = match &mut self.inner {
            Inner::Plain(inner) => inner.read(buffer)?,
            Inner::Gzip(inner) => inner.read(buffer)?,
        };
        self.decoded += n as u64;
        if self.decoded > self.bounds.decoded {
            let limit = self.bounds.decoded;
            return Err(excess(code::DECODED_TOO_LARGE, limit, more_than(limit, what::DECODED_BYTES)));
        }
        let Inner::Gzip(inner) = &self.inner else { return Ok(n) };
        let limit = self.bounds.expansion;
        if self.decoded > RATIO_FROM && self.decoded / inner.get_ref().count.max(1) > limit {
            return Err(excess(code::EXPANSION_TOO_HIGH, limit, refusals::inflates_too_much(limit)));
        }
        Ok(n)
    }
}

/// True for the first bytes of a gzip file (RFC 1952, 2.3.1).
fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x1f, 0x8b])
}

/// Opens a file, plain or compressed with gzip; its first two bytes decide.
///
/// # Errors
/// If these bytes cannot be read.
pub(crate) fn open<R: Read>(mut input: R, bounds: Bounds) -> io::Result<BufReader<Unpacked<R>>> {
    let mut head = Vec::new();
    input.by_ref().take(2).read_to_end(&mut head)?;
    let gzip = is_gzip(&head);
    let whole = CountingReader { inner: io::Cursor::new(head).chain(input), count: 0 };
    let inner = if gzip { Inner::Gzip(Box::new(MultiGzDecoder::new(whole))) } else { Inner::Plain(whole) };
    Ok(BufReader::with_capacity(PIECE, Unpacked { inner, decoded: 0, bounds }))
}

/// Whether an input contains these bytes, as far as it can be read.
pub(crate) fn has_word(mut input: impl BufRead, word: &[u8]) -> bool {
    let mut kept: Vec<u8> = Vec::new();
    while let Ok(chunk) = input.fill_buf() {
        if chunk.is_empty() {
            break;
        }
        let count = chunk.len();
        kept.extend_from_slice(chunk);
        input.consume(count);
        if kept.windows(word.len()).any(|part| part == word) {
            return true;
        }
        // The word may continue in the next piece.
        kept.drain(..kept.len().saturating_sub(word.len() - 1));
    }
    false
}

/// Beginning of a zip.
pub(crate) const ZIP: &[u8] = b"PK\x03\x04";

/// A file in a zip. The compressed zip is in memory; the file is decompressed while it is read.
#[derive(Clone)]
pub(crate) struct ZipEntry {
    zip: Arc<Vec<u8>>,
    packed: Range<usize>,
    is_deflated: bool,
    /// Decompressed size, bytes.
    size: u64,
    checksum: u32,
}

impl fmt::Debug for ZipEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ZipEntry").field("packed", &self.packed).field("size", &self.size).finish()
    }
}

impl ZipEntry {
    /// Its bytes from the beginning.
    pub fn reader(&self) -> Box<dyn Read + Send> {
        let range = ZipRange { zip: Arc::clone(&self.zip), left: self.packed.clone() };
        let inner: Box<dyn Read + Send> =
            if self.is_deflated { Box::new(DeflateDecoder::new(range)) } else { Box::new(range) };
        let (left, checksum) = (self.size, self.checksum);
        Box::new(CheckedEntry { inner: CrcReader::new(BufReader::new(inner)), left, checksum })
    }

    /// Decompressed size in bytes.
    pub fn unpacked_len(&self) -> u64 {
        self.size
    }
}

impl Source for ZipEntry {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(self.reader())
    }

    fn encoded_len(&self) -> u64 {
        self.packed.len() as u64
    }
}

/// Compressed bytes of a file.
struct ZipRange {
    zip: Arc<Vec<u8>>,
    left: Range<usize>,
}

impl Read for ZipRange {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.zip.get(self.left.clone()).unwrap_or_default().read(buffer)?;
        self.left.start += count;
        Ok(count)
    }
}

/// This many bytes with this checksum.
struct CheckedEntry {
    inner: CrcReader<BufReader<Box<dyn Read + Send>>>,
    left: u64,
    checksum: u32,
}

impl Read for CheckedEntry {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let most = usize::try_from(self.left).unwrap_or(usize::MAX).min(buffer.len());
        let count = self.inner.read(buffer.get_mut(..most).unwrap_or_default())?;
        self.left -= count as u64;
        let ends = count == 0 && !buffer.is_empty();
        if ends && (self.left > 0 || self.inner.crc().sum() != self.checksum) {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "a file of the zip is damaged"));
        }
        Ok(count)
    }
}

/// Files of a zip whose lower-case names are wanted and whose size is limited, each with its name.
///
/// # Errors
/// `malformed-file` for a broken zip or a file that is encrypted or compressed by another method than
/// deflate.
pub(crate) fn entries(
    file: &dyn Source,
    most: u64,
    wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, ZipEntry)>, ReadError> {
    let mut packed = Vec::new();
    let input = file.open().map_err(|error| fault(&error, 0))?;
    input.take(most).read_to_end(&mut packed).map_err(|error| fault(&error, 0))?;
    let told = |words: &str| ReadError::malformed(0, refusals::unreadable("ZIP", words));
    let broken = |error: ZipError| told(&error.to_string());
    let mut zip = ZipArchive::new(io::Cursor::new(packed.as_slice())).map_err(broken)?;
    let mut found = Vec::new();
    for i in 0..zip.len().min(MAX_FILES) {
        let file = zip.by_index_raw(i).map_err(broken)?;
        let name = String::from_utf8_lossy(file.name_raw()).into_owned();
        if !wanted(&name.to_ascii_lowercase()) {
            continue;
        }
        let is_deflated = file.compression() == CompressionMethod::Deflated;
        if file.encrypted() || !(is_deflated || file.compression() == CompressionMethod::Stored) {
            return Err(told(&format!("{name}: encrypted, or packed by another method than deflate")));
        }
        let from = file.data_start().and_then(|from| usize::try_from(from).ok());
        let to = from.zip(usize::try_from(file.compressed_size()).ok()).and_then(|(a, b)| a.checked_add(b));
        let Some(range) = from.zip(to).map(|(from, to)| from..to).filter(|range| range.end <= packed.len())
        else {
            return Err(told(&format!("{name}: cut off")));
        };
        found.push((name, range, is_deflated, file.size(), file.crc32()));
    }
    let zip = Arc::new(packed);
    let entry = |(name, packed, is_deflated, size, checksum)| {
        (name, ZipEntry { zip: Arc::clone(&zip), packed, is_deflated, size, checksum })
    };
    Ok(found.into_iter().map(entry).collect())
}

/// Decompressed files of a zip whose lower-case names are wanted, each with this name.
///
/// # Errors
/// Those of [`entries`], the limits of a file.
pub(crate) fn zipped(
    file: &dyn Source,
    most: u64,
    wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<u8>)>, ReadError> {
    let (mut files, mut left) = (Vec::new(), most);
    for (name, entry) in entries(file, most, wanted)? {
        let mut bytes = Vec::new();
        let unpacked = open(entry.reader(), Bounds::of(left));
        unpacked.and_then(|mut file| file.read_to_end(&mut bytes)).map_err(|error| fault(&error, 0))?;
        left -= bytes.len() as u64;
        files.push((name.to_ascii_lowercase(), bytes));
    }
    Ok(files)
}

/// The first decoded bytes, for recognising a file; what cannot be decoded is left out.
pub(crate) fn head(input: impl Read) -> Vec<u8> {
    const HEAD: u64 = 32 << 10;
    let mut decoded = Vec::new();
    // A broken file is recognised by its content before the fault.
    if let Ok(input) = open(input, Bounds::of(1 << 20)) {
        let _ = input.take(HEAD).read_to_end(&mut decoded);
    }
    decoded
}

/// A fault of [`open`] or its reader, `offset` decoded bytes into the file.
pub(crate) fn fault(error: &io::Error, offset: u64) -> ReadError {
    match error.get_ref().and_then(|inner| inner.downcast_ref::<Excess>()) {
        Some(excess) => ReadError::too_large(excess.code, excess.limit, excess.message.clone()),
        None => ReadError::malformed(offset, refusals::cannot_decompress(&error.to_string())),
    }
}
