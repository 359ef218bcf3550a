//! Exported files, limited in bytes, for as long as a caller waits for them.

use crate::refusals;
use scene::Cancel;
use std::io;

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

/// A file in memory within limits.
pub(crate) struct BoundedFile {
    /// Its bytes so far.
    pub bytes: Vec<u8>,
    bounds: FileBounds,
}

impl BoundedFile {
    /// An empty file.
    pub fn new(bounds: FileBounds) -> Self {
        Self { bytes: Vec::new(), bounds }
    }
}

impl io::Write for BoundedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.bounds.check((self.bytes.len() + bytes.len()) as u64)?;
        self.bytes.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{BoundedFile, FileBounds};
    use scene::Cancel;
    use std::io::{self, Write};

    #[test]
    fn a_file_takes_as_many_bytes_as_it_may_have() {
        let cancel = Cancel::default();
        let mut file = BoundedFile::new(FileBounds::new(5, cancel.clone()));
        file.write_all(b"abc").unwrap();
        assert_eq!(file.write_all(b"def").unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        file.write_all(b"de").unwrap();
        assert_eq!(file.bytes, b"abcde");
        let mut left = BoundedFile::new(FileBounds::new(5, cancel.clone()));
        left.write_all(b"abc").unwrap();
        cancel.cancel();
        assert_eq!(left.write_all(b"d").unwrap_err().kind(), io::ErrorKind::ConnectionAborted);
    }
}
