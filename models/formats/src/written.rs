//! Files on their way out, bounded in bytes.

use crate::refusals;
use std::io;

/// Refusal of a file of more than `most` bytes.
pub(crate) fn too_long(bytes: u64, most: u64) -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, refusals::file_too_long(bytes, most))
}

/// Whether an export failed because its file would be longer than it may be.
pub fn is_too_long(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::FileTooLarge
}

/// A file in memory of at most so many bytes.
pub(crate) struct BoundedFile {
    /// Its bytes so far.
    pub bytes: Vec<u8>,
    most: u64,
}

impl BoundedFile {
    /// An empty file.
    pub fn new(most: u64) -> Self {
        Self { bytes: Vec::new(), most }
    }
}

impl io::Write for BoundedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let length = (self.bytes.len() + bytes.len()) as u64;
        if length > self.most {
            return Err(too_long(length, self.most));
        }
        self.bytes.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::BoundedFile;
    use std::io::{self, Write};

    #[test]
    fn a_file_takes_as_many_bytes_as_it_may_have() {
        let mut file = BoundedFile::new(5);
        file.write_all(b"abc").unwrap();
        assert_eq!(file.write_all(b"def").unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        file.write_all(b"de").unwrap();
        assert_eq!(file.bytes, b"abcde");
    }
}
