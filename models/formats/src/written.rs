//! Exported files, limited in bytes, for as long as a caller waits for them.

use crate::refusals;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use scene::Cancel;
use std::io::{self, Write as _};

/// Refusal of a file of more than `most` bytes.
fn too_long(bytes: u64, most: u64) -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, refusals::file_too_long(bytes, most))
}

/// Whether an export failed because its file would exceed the limit.
pub fn is_too_long(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::FileTooLarge
}

/// Limits of a file that is being written.
#[derive(Clone, Debug)]
pub(crate) struct FileBounds {
    most: u64,
    cancel: Cancel,
}

impl FileBounds {
    /// At most this many bytes, until the call that requests the file is cancelled.
    pub fn new(most: u64, cancel: Cancel) -> Self {
        Self { most, cancel }
    }

    /// Refuses a file that already has this many bytes.
    ///
    /// # Errors
    /// `FileTooLarge` beyond the limit, `ConnectionAborted` when nobody waits for the file any more.
    pub fn check(&self, bytes: u64) -> io::Result<()> {
        if self.cancel.is_cancelled() {
            return Err(io::ErrorKind::ConnectionAborted.into());
        }
        if bytes > self.most { Err(too_long(bytes, self.most)) } else { Ok(()) }
    }
}

impl Default for FileBounds {
    /// No limits.
    fn default() -> Self {
        Self::new(u64::MAX, Cancel::default())
    }
}

/// Bytes of a part of a file.
const PART_BYTES: usize = 1 << 20;
/// Parts that stay as they are. Further ones are packed until the file is complete, because a long file may
/// turn out to be too long.
const PLAIN_PARTS: usize = 4;

/// A part of a file.
enum FilePiece {
    Plain(Vec<u8>),
    /// Deflated.
    Packed(Vec<u8>),
}

/// A file in memory within limits.
pub(crate) struct BoundedFile {
    pieces: Vec<FilePiece>,
    /// The current part.
    part: Vec<u8>,
    /// Bytes of the finished parts.
    bytes: u64,
    bounds: FileBounds,
}

impl BoundedFile {
    /// An empty file.
    pub fn new(bounds: FileBounds) -> Self {
        Self { pieces: Vec::new(), part: Vec::new(), bytes: 0, bounds }
    }

    /// Refuses a file that is already too long, or for which nobody waits any more.
    ///
    /// # Errors
    /// Those of [`FileBounds::check`].
    pub fn check(&self) -> io::Result<()> {
        self.bounds.check(self.bytes + self.part.len() as u64)
    }

    /// Finishes the current part.
    fn end_part(&mut self) -> io::Result<()> {
        self.bytes += self.part.len() as u64;
        let piece = if self.pieces.len() < PLAIN_PARTS {
            FilePiece::Plain(self.part.clone())
        } else {
            let mut packed = DeflateEncoder::new(Vec::new(), Compression::fast());
            packed.write_all(&self.part)?;
            FilePiece::Packed(packed.finish()?)
        };
        self.pieces.push(piece);
        self.part.clear();
        Ok(())
    }

    /// The file in one piece.
    ///
    /// # Errors
    /// Those of [`FileBounds::check`].
    pub fn whole(self) -> io::Result<Vec<u8>> {
        self.check()?;
        let mut whole = Vec::with_capacity(self.bytes as usize + self.part.len());
        self.write_to(&mut whole)?;
        Ok(whole)
    }

    /// Writes the file, part by part.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_to(self, out: &mut impl io::Write) -> io::Result<()> {
        for piece in self.pieces {
            match piece {
                FilePiece::Plain(bytes) => out.write_all(&bytes)?,
                FilePiece::Packed(packed) => {
                    io::copy(&mut DeflateDecoder::new(packed.as_slice()), out)?;
                }
            }
        }
        out.write_all(&self.part)
    }
}

impl io::Write for BoundedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bounds.check(self.bytes + (self.part.len() + bytes.len()) as u64)?;
        self.part.extend_from_slice(bytes);
        if self.part.len() >= PART_BYTES {
            self.end_part()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{BoundedFile, FileBounds, FilePiece};
    use scene::Cancel;
    use std::io::{self, Write};

    #[test]
    fn a_file_takes_as_many_bytes_as_it_may_have() {
        let cancel = Cancel::default();
        let mut file = BoundedFile::new(FileBounds::new(5, cancel.clone()));
        file.write_all(b"abc").unwrap();
        assert_eq!(file.write_all(b"def").unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        file.write_all(b"de").unwrap();
        assert_eq!(file.whole().unwrap(), b"abcde");
        let mut left = BoundedFile::new(FileBounds::new(5, cancel.clone()));
        left.write_all(b"abc").unwrap();
        cancel.cancel();
        assert_eq!(left.write_all(b"d").unwrap_err().kind(), io::ErrorKind::ConnectionAborted);
    }

    #[test]
    fn a_long_file_is_packed_until_it_is_complete() {
        let mut file = BoundedFile::new(FileBounds::default());
        let lines: Vec<String> = (0..2_000_000).map(|i| format!("{i:9}\n")).collect();
        lines.iter().for_each(|line| file.write_all(line.as_bytes()).unwrap());
        let kept = |piece: &FilePiece| match piece {
            FilePiece::Plain(bytes) | FilePiece::Packed(bytes) => bytes.len(),
        };
        let kept: usize = file.pieces.iter().map(kept).sum();
        assert!(kept < 12 << 20, "{kept} of 20 MB");
        assert_eq!(file.whole().unwrap(), lines.concat().into_bytes());
    }
}
