//! Bytes of a file, plain or gzip, unfolded under bounds while they are read.

use crate::limits::MAX_EXPANSION;
use crate::problem::{ReadError, code};
use crate::refusals::{self, more_than, what};
use crate::source::Source;
use flate2::read::MultiGzDecoder;
use scene::message::Message;
use std::io::{self, BufReader, Read};
use zip::ZipArchive;
use zip::result::ZipError;

/// The expansion ratio is checked after this many decoded bytes.
const RATIO_FROM: u64 = 1 << 20;
/// Most files of a zip that are looked at.
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
    /// So many decoded bytes, at the usual ratio.
    pub fn of(decoded: u64) -> Self {
        Self { decoded, expansion: MAX_EXPANSION }
    }
}

/// A bound that was met while decoding; travels inside an `io::Error`.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
struct Excess {
    code: &'static str,
    limit: u64,
    message: Message,
}

/// A bound that was met, for [`fault`].
pub(crate) fn excess(code: &'static str, limit: u64, message: Message) -> io::Error {
    io::Error::other(Excess { code, limit, message })
}

/// Counts what goes through.
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

/// Opens a file, plain or gzip; its first two bytes decide.
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

/// Files of a zip whose names in small letters are wanted, each with its name.
///
/// # Errors
/// `malformed-file` for a broken zip, the bounds of a file.
pub(crate) fn zipped(
    file: &dyn Source,
    most: u64,
    wanted: impl Fn(&str) -> bool,
) -> Result<Vec<(String, Vec<u8>)>, ReadError> {
    let mut packed = Vec::new();
    let input = file.open().map_err(|error| fault(&error, 0))?;
    input.take(most).read_to_end(&mut packed).map_err(|error| fault(&error, 0))?;
    let broken = |error: ZipError| ReadError::malformed(0, refusals::unreadable("ZIP", &error.to_string()));
    let mut zip = ZipArchive::new(io::Cursor::new(packed)).map_err(broken)?;
    let (mut files, mut left) = (Vec::new(), most);
    for i in 0..zip.len().min(MAX_FILES) {
        let file = zip.by_index(i).map_err(broken)?;
        let name = String::from_utf8_lossy(file.name_raw()).to_ascii_lowercase();
        if !wanted(&name) {
            continue;
        }
        let mut bytes = Vec::new();
        let unpacked = open(file, Bounds::of(left));
        unpacked.and_then(|mut file| file.read_to_end(&mut bytes)).map_err(|error| fault(&error, 0))?;
        left -= bytes.len() as u64;
        files.push((name, bytes));
    }
    Ok(files)
}

/// The first bytes once decoded, for recognising a file; what cannot be decoded is left out.
pub(crate) fn head(input: impl Read) -> Vec<u8> {
    const HEAD: u64 = 32 << 10;
    let mut decoded = Vec::new();
    // A broken file is recognised by what comes before the fault.
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
