//! Source of a file's bytes: memory, or a stream that is decompressed while it is read.

use std::fmt;
use std::io::{self, Read};
use std::sync::Arc;

/// Most bytes of the beginning by which a file is recognised.
const HEAD: u64 = 128 << 10;
/// Most bytes of the end by which a file is recognised.
const TAIL: u64 = 64 << 10;

/// A file that can be read from its beginning more than once: to recognise it, to read it, and to find the
/// place of a fault.
pub trait Source: fmt::Debug + Send + Sync {
    /// Its bytes from the beginning.
    ///
    /// # Errors
    /// When they cannot be read.
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>>;

    /// Size in bytes before decompression, from which the memory for reading is estimated.
    fn encoded_len(&self) -> u64;
}

impl Source for &[u8] {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(Box::new(*self))
    }

    fn encoded_len(&self) -> u64 {
        self.len() as u64
    }
}

impl Source for Vec<u8> {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        Ok(Box::new(self.as_slice()))
    }

    fn encoded_len(&self) -> u64 {
        self.len() as u64
    }
}

impl<S: Source + ?Sized> Source for Arc<S> {
    fn open(&self) -> io::Result<Box<dyn Read + Send + '_>> {
        (**self).open()
    }

    fn encoded_len(&self) -> u64 {
        (**self).encoded_len()
    }
}

/// Whether a file begins with these bytes.
pub(crate) fn begins_with(file: &dyn Source, bytes: &[u8]) -> bool {
    let mut head = Vec::with_capacity(bytes.len());
    let read = file.open().and_then(|input| input.take(bytes.len() as u64).read_to_end(&mut head));
    read.is_ok() && head == bytes
}

/// Optional first bytes of UTF-8 text, which are not part of the text.
pub const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The same text without a byte order mark.
///
/// # Errors
/// When it cannot be read.
pub fn unmarked<R: Read>(mut input: R) -> io::Result<impl Read + use<R>> {
    let mut begins = Vec::with_capacity(BYTE_ORDER_MARK.len());
    input.by_ref().take(BYTE_ORDER_MARK.len() as u64).read_to_end(&mut begins)?;
    if begins == BYTE_ORDER_MARK {
        begins.clear();
    }
    Ok(io::Cursor::new(begins).chain(input))
}

/// The same bytes without a byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// Beginnings of files that are recognised by their end: Parquet, and zips, which list their files there.
const BY_END: [&[u8]; 2] = [b"PAR1", b"PK\x03\x04"];

/// The first bytes of a file, by which it is recognised; for files that are recognised by their end, the last
/// ones follow.
pub fn head(file: &dyn Source) -> Vec<u8> {
    let mut head = Vec::new();
    // A broken file is recognised by its content before the fault.
    if let Ok(input) = file.open() {
        let mut input = input.take(HEAD);
        let _ = input.read_to_end(&mut head);
        if BY_END.iter().any(|mark| head.starts_with(mark)) {
            let mut tail = Vec::new();
            let mut rest = input.into_inner();
            while rest.by_ref().take(TAIL).read_to_end(&mut tail).is_ok_and(|count| count > 0) {
                tail.drain(..tail.len().saturating_sub(TAIL as usize));
            }
            head.append(&mut tail);
        }
    }
    head
}
