//! Long replies: compressed when they are made, and decompressed while they are sent.

use super::body::{Kept, Room};
use api::Problem;
use axum::body::{Body, Bytes};
use axum::http::header;
use axum::response::{IntoResponse, Response};
use base::problem::Refusal;
use futures_util::stream;
use serde::Serialize;
use std::io::{self, BufWriter, Cursor, Read, Write};

/// Compression level: fast, because the result lives only briefly.
const LEVEL: i32 = 1;
/// Bytes sent at a time.
const PIECE: usize = 64 << 10;

/// Compressor of JSON text.
pub struct TextPacker {
    encoder: zstd::stream::write::Encoder<'static, Vec<u8>>,
    length: u64,
}

impl Write for TextPacker {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.encoder.write(bytes)?;
        self.length += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl TextPacker {
    /// An empty text.
    ///
    /// # Errors
    /// A defect of the compressor, as below.
    pub fn new() -> Result<Self, Problem> {
        let encoder = zstd::stream::write::Encoder::new(Vec::new(), LEVEL).map_err(Problem::internal)?;
        Ok(Self { encoder, length: 0 })
    }

    /// Adds text.
    ///
    /// # Errors
    /// A defect.
    pub fn push(&mut self, text: &[u8]) -> Result<(), Problem> {
        self.write_all(text).map_err(Problem::internal)
    }

    /// Adds a value.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn push_json(&mut self, value: &impl Serialize) -> Result<(), Problem> {
        let mut buffered = BufWriter::with_capacity(PIECE, self);
        serde_json::to_writer(&mut buffered, value).map_err(Problem::internal)?;
        buffered.flush().map_err(Problem::internal)
    }

    /// The complete text, which takes memory until it is sent.
    ///
    /// # Errors
    /// `busy` if there is none.
    pub fn finish(self, room: &Room) -> Result<PackedText, Problem> {
        let packed = self.encoder.finish().map_err(Problem::internal)?;
        let kept = room.keep(packed.len())?;
        Ok(PackedText { packed, length: self.length, kept })
    }
}

/// Compressed JSON text to send.
pub struct PackedText {
    packed: Vec<u8>,
    length: u64,
    kept: Kept,
}

impl IntoResponse for PackedText {
    fn into_response(self) -> Response {
        let Self { packed, length, kept } = self;
        let decoder = match zstd::stream::read::Decoder::with_buffer(Cursor::new(packed)) {
            Ok(decoder) => decoder,
            Err(error) => return Refusal::from(Problem::internal(error)).into_response(),
        };
        let pieces = stream::unfold((decoder, kept), |(mut decoder, kept)| async move {
            let mut piece = Vec::with_capacity(PIECE);
            match decoder.by_ref().take(PIECE as u64).read_to_end(&mut piece) {
                Ok(0) => None,
                Ok(_) => Some((Ok(Bytes::from(piece)), (decoder, kept))),
                Err(error) => Some((Err(error), (decoder, kept))),
            }
        });
        let head = [
            (header::CONTENT_TYPE, "application/json".to_owned()),
            (header::CONTENT_LENGTH, length.to_string()),
        ];
        (head, Body::from_stream(pieces)).into_response()
    }
}
