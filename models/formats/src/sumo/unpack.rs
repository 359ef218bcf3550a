//! Bytes of a file, plain or gzip, unfolded under bounds.

use crate::limits::MAX_EXPANSION;
use crate::problem::{ReadError, code};
use flate2::read::MultiGzDecoder;
use std::io::{self, BufRead, BufReader, Read};

/// The expansion ratio is looked at after this many decoded bytes.
const RATIO_FROM: u64 = 1 << 20;

/// A bound that was met while decoding; travels inside an `io::Error`.
#[derive(Debug, thiserror::Error)]
#[error("{detail}")]
struct Excess {
    code: &'static str,
    limit: u64,
    detail: String,
}

struct Bounded<R> {
    inner: R,
    /// Bytes of the file; 0 for a plain one, whose ratio is one.
    encoded: u64,
    decoded: u64,
    most: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer)?;
        self.decoded += n as u64;
        let excess = |code, limit, detail| Err(io::Error::other(Excess { code, limit, detail }));
        if self.decoded > self.most {
            let detail = format!("more than {} bytes once decompressed", self.most);
            return excess(code::DECODED_TOO_LARGE, self.most, detail);
        }
        if self.encoded > 0 && self.decoded > RATIO_FROM && self.decoded / self.encoded > MAX_EXPANSION {
            let detail = format!("decompresses to more than {MAX_EXPANSION} times its size");
            return excess(code::EXPANSION_TOO_HIGH, MAX_EXPANSION, detail);
        }
        Ok(n)
    }
}

/// True for the first bytes of a gzip file (RFC 1952, 2.3.1).
pub(super) fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x1f, 0x8b])
}

/// Opens a file in memory; at most `most` decoded bytes can be read.
pub(super) fn open(bytes: &[u8], most: u64) -> Box<dyn BufRead + '_> {
    if is_gzip(bytes) {
        let inner = MultiGzDecoder::new(bytes);
        let encoded = bytes.len() as u64;
        Box::new(BufReader::with_capacity(64 << 10, Bounded { inner, encoded, decoded: 0, most }))
    } else {
        Box::new(BufReader::with_capacity(64 << 10, Bounded { inner: bytes, encoded: 0, decoded: 0, most }))
    }
}

/// The first bytes once decoded, for recognising a file; what cannot be decoded is left out.
pub(super) fn head(bytes: &[u8]) -> Vec<u8> {
    const HEAD: u64 = 32 << 10;
    let mut decoded = Vec::new();
    // A broken file is recognised by what comes before the fault.
    let _ = open(bytes, 1 << 20).take(HEAD).read_to_end(&mut decoded);
    decoded
}

/// A fault of [`open`]'s reader, `offset` decoded bytes into the file.
pub(super) fn fault(error: &io::Error, offset: u64) -> ReadError {
    match error.get_ref().and_then(|inner| inner.downcast_ref::<Excess>()) {
        Some(excess) => ReadError::too_large(excess.code, excess.limit, excess.detail.clone()),
        None => ReadError::malformed(offset, format!("cannot decompress or read: {error}")),
    }
}
