//! TFRecord framing, plain or gzip: `u64 length, u32 masked CRC-32C of it, data, u32 masked CRC-32C
//! of the data`, all little-endian. Nothing is reserved from a declared length, and the decompressed
//! stream is bounded in size and in ratio.

use super::Options;
use crate::problem::ReadError;
use crate::refusals::{self, what};
use crate::unpack::{self, Bounds, Unpacked};
use std::io::{self, BufReader, Read, Write};

/// Most bytes of one record.
pub const MAX_RECORD_BYTES: u64 = 128 << 20;
/// Bytes of a record that are read first.
const PIECE: u64 = 1 << 20;

/// CRC-32C, rotated and offset as in TFRecord, so that the CRC of data that contain CRCs is useful.
pub fn masked_crc(bytes: &[u8]) -> u32 {
    crc32c::crc32c(bytes).rotate_right(15).wrapping_add(0xa282_ead8)
}

/// Writes one record with its frame.
///
/// # Errors
/// Those of the writer.
pub fn write_record(out: &mut impl Write, data: &[u8]) -> io::Result<()> {
    let length = (data.len() as u64).to_le_bytes();
    out.write_all(&length)?;
    out.write_all(&masked_crc(&length).to_le_bytes())?;
    out.write_all(data)?;
    out.write_all(&masked_crc(data).to_le_bytes())
}

/// True when these first bytes of a file are a TFRecord frame, plain or in gzip.
pub fn looks_like(head: &[u8]) -> bool {
    let decoded = unpack::head(head);
    match decoded.split_first_chunk::<8>() {
        Some((length, rest)) => {
            rest.first_chunk::<4>().is_some_and(|crc| masked_crc(length) == u32::from_le_bytes(*crc))
        }
        None => false,
    }
}

/// One record's data, and the beginning of its frame in the decoded stream.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TfRecord {
    /// Offset of `data` in the decoded stream.
    pub offset: u64,
    /// The message.
    pub data: Vec<u8>,
}

/// Reads records one by one from a plain or gzip stream.
pub struct RecordReader<R: Read> {
    input: BufReader<Unpacked<R>>,
    offset: u64,
    verify_crc: bool,
    max_bytes: u64,
    ended: bool,
}

/// Reason for which a read ended early.
enum ReadEnd {
    End,
    Fault(ReadError),
}

impl<R: Read> RecordReader<R> {
    /// Reads the first bytes, to distinguish gzip from plain data.
    ///
    /// # Errors
    /// `malformed-file` if the reader fails.
    pub fn new(input: R, options: &Options) -> Result<Self, ReadError> {
        let bounds = Bounds { decoded: options.max_decoded_bytes, expansion: options.max_expansion };
        let input = unpack::open(input, bounds).map_err(|error| unpack::fault(&error, 0))?;
        let Options { verify_crc, max_record_bytes: max_bytes, .. } = *options;
        Ok(Self { input, offset: 0, verify_crc, max_bytes, ended: false })
    }

    /// Whether nothing can follow: at the end, or after a fault in the framing.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    /// Appends up to `wanted` bytes; fewer only at the end of the stream.
    fn fill(&mut self, buffer: &mut Vec<u8>, wanted: u64) -> Result<(), ReadError> {
        let mut left = wanted;
        while left > 0 {
            // In pieces, so that the reserved memory is at most about twice the bytes that have come.
            let piece = left.min(PIECE.max(buffer.len() as u64));
            let before = buffer.len();
            buffer.reserve_exact(piece as usize);
            let result = self.input.by_ref().take(piece).read_to_end(buffer);
            let got = (buffer.len() - before) as u64;
            self.offset += got;
            result.map_err(|error| {
                self.ended = true;
                unpack::fault(&error, self.offset)
            })?;
            if got < piece {
                return Ok(());
            }
            left -= piece;
        }
        Ok(())
    }

    fn exactly(&mut self, wanted: u64, what: &str) -> Result<Vec<u8>, ReadEnd> {
        let start = self.offset;
        let mut buffer = Vec::new();
        self.fill(&mut buffer, wanted).map_err(ReadEnd::Fault)?;
        let got = buffer.len() as u64;
        if got == wanted {
            return Ok(buffer);
        }
        self.ended = true;
        if got == 0 && what == "length" {
            return Err(ReadEnd::End);
        }
        Err(ReadEnd::Fault(ReadError::malformed(start, refusals::file_ends_after(got, wanted))))
    }

    fn record(&mut self) -> Result<TfRecord, ReadEnd> {
        let start = self.offset;
        let head = self.exactly(8, "length")?;
        let crc = self.exactly(4, "length checksum")?;
        if self.verify_crc && masked_crc(&head).to_le_bytes() != crc[..] {
            self.ended = true;
            let message = refusals::checksum_differs(what::RECORD_LENGTH);
            return Err(ReadEnd::Fault(ReadError::malformed(start, message)));
        }
        let length = head.iter().rev().fold(0u64, |length, byte| length << 8 | u64::from(*byte));
        if length > self.max_bytes {
            self.ended = true;
            let message = refusals::at_most(length, what::RECORD_BYTES, self.max_bytes);
            return Err(ReadEnd::Fault(ReadError::malformed(start, message)));
        }
        let offset = self.offset;
        let data = self.exactly(length, "data")?;
        let crc = self.exactly(4, "data checksum")?;
        if self.verify_crc && masked_crc(&data).to_le_bytes() != crc[..] {
            let message = refusals::checksum_differs(what::RECORD_DATA);
            return Err(ReadEnd::Fault(ReadError::malformed(offset, message)));
        }
        Ok(TfRecord { offset, data })
    }
}

impl<R: Read> Iterator for RecordReader<R> {
    type Item = Result<TfRecord, ReadError>;

    /// After a fault in a record's data the next record follows; after one in the framing, nothing does.
    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        match self.record() {
            Ok(record) => Some(Ok(record)),
            Err(ReadEnd::Fault(error)) => Some(Err(error)),
            Err(ReadEnd::End) if self.offset == 0 => {
                Some(Err(ReadError::malformed(0, refusals::file_has_no(what::RECORD))))
            }
            Err(ReadEnd::End) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{looks_like, masked_crc, write_record};

    #[test]
    fn crc_of_known_vectors() {
        // RFC 3720 B.4.
        assert_eq!(crc32c::crc32c(&[0; 32]), 0x8a91_36aa);
        assert_eq!(crc32c::crc32c(&[0xff; 32]), 0x62a8_ab43);
        let rising: Vec<u8> = (0..32).collect();
        assert_eq!(crc32c::crc32c(&rising), 0x46dd_794e);
        let falling: Vec<u8> = (0..32).rev().collect();
        assert_eq!(crc32c::crc32c(&falling), 0x113f_db5c);
        assert_eq!(crc32c::crc32c(b"123456789"), 0xe306_9283);
        // Masked CRCs of 0 and of a value that can be verified by hand.
        assert_eq!(masked_crc(b""), 0xa282_ead8);
        assert_eq!(masked_crc(b"123456789"), 0xe306_9283_u32.rotate_right(15).wrapping_add(0xa282_ead8));
    }

    #[test]
    fn a_frame_is_recognised() {
        let mut file = Vec::new();
        write_record(&mut file, b"data").expect("a vector takes all");
        assert_eq!(file.len(), 20);
        assert!(looks_like(&file));
        assert!(!looks_like(&file[..11]) && !looks_like(b"{\"format\":\"dragtraffic.scene\"}"));
    }
}
