//! Frames of a WebSocket as they arrive (RFC 6455, 5.2): a message must be complete within a time limit.
//!
//! The WebSocket library only reports complete messages, so a client could hold one open for ever.

use base::memory::{Memory, MemoryShare};
use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::Sleep;

/// A stream that fails with `TimedOut` if a message takes longer than `patience` from its first byte to its
/// last, and with `OutOfMemory` if there is no memory for it.
pub struct WholeMessages<S> {
    stream: S,
    patience: Duration,
    frames: FrameReader,
    /// Time limit of the arriving message.
    limit: Option<Pin<Box<Sleep>>>,
    /// Memory of the arriving message.
    memory: MemoryShare,
}

impl<S> WholeMessages<S> {
    /// A reader of a stream that begins with a frame.
    pub fn new(stream: S, patience: Duration, memory: &Arc<Memory>) -> Self {
        Self { stream, patience, frames: FrameReader::default(), limit: None, memory: memory.nothing() }
    }
}

/// State of the parser between reads.
#[derive(Debug, Default)]
struct FrameReader {
    /// Bytes of an incomplete head.
    head: Vec<u8>,
    /// Remaining bytes of the payload.
    payload: u64,
    /// Whether the last data frame was not the final one of its message.
    continues: bool,
}

impl FrameReader {
    fn is_between_messages(&self) -> bool {
        self.head.is_empty() && self.payload == 0 && !self.continues
    }

    /// Continues parsing; true if a message ended in these bytes.
    fn read(&mut self, mut bytes: &[u8]) -> bool {
        let mut ended = false;
        while let Some((first, rest)) = bytes.split_first() {
            if self.payload > 0 {
                let count = usize::try_from(self.payload).unwrap_or(usize::MAX).min(bytes.len());
                self.payload -= count as u64;
                bytes = bytes.get(count..).unwrap_or_default();
            } else {
                self.head.push(*first);
                bytes = rest;
                self.end_head();
            }
            ended |= self.is_between_messages();
        }
        ended
    }

    /// Begins the payload once the head is complete.
    fn end_head(&mut self) {
        let [first, second, rest @ ..] = self.head.as_slice() else { return };
        let mask = if second & 0x80 == 0 { 0 } else { 4 };
        let extended = match second & 0x7f {
            126 => 2,
            127 => 8,
            _ => 0,
        };
        if rest.len() < extended + mask {
            return;
        }
        let number = rest.iter().take(extended).fold(0, |number, byte| number << 8 | u64::from(*byte));
        self.payload = if extended == 0 { u64::from(second & 0x7f) } else { number };
        // Pings may come between the frames of a message.
        if first & 0x08 == 0 {
            self.continues = first & 0x80 == 0;
        }
        self.head.clear();
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for WholeMessages<S> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let before = buffer.filled().len();
        let polled = Pin::new(&mut self.stream).poll_read(context, buffer);
        if let Some(bytes) = buffer.filled().get(before..).filter(|bytes| !bytes.is_empty()) {
            let ended = self.frames.read(bytes);
            let count = bytes.len();
            if ended {
                self.limit = None;
                let held = self.memory.bytes();
                self.memory.shrink(held);
            }
            if !self.frames.is_between_messages() {
                if self.limit.is_none() {
                    self.limit = Some(Box::pin(tokio::time::sleep(self.patience)));
                }
                if !self.memory.grow(count) {
                    let detail = "Other requests fill the memory.";
                    return Poll::Ready(Err(io::Error::new(io::ErrorKind::OutOfMemory, detail)));
                }
            }
        }
        if let Some(limit) = &mut self.limit
            && limit.as_mut().poll(context).is_ready()
        {
            let detail = format!("A message must arrive within {} s.", self.patience.as_secs_f64());
            return Poll::Ready(Err(io::Error::new(io::ErrorKind::TimedOut, detail)));
        }
        polled
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for WholeMessages<S> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        Pin::new(&mut self.stream).poll_write(context, bytes)
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed test panics")]
mod tests {
    use super::{FrameReader, WholeMessages};
    use base::memory::Memory;
    use std::time::Duration;
    use tokio::io::{AsyncReadExt, AsyncWriteExt};

    /// A masked frame.
    fn frame(first: u8, payload: &[u8]) -> Vec<u8> {
        let length = match payload.len() {
            short @ 0..126 => vec![0x80 | short as u8],
            long => [&[0x80 | 126][..], &(long as u16).to_be_bytes()].concat(),
        };
        [&[first][..], &length, &[0; 4], payload].concat()
    }

    #[test]
    fn ends_of_messages_are_found_wherever_the_bytes_are_cut() {
        let frames = [frame(0x81, b"{}"), frame(0x01, &[b'x'; 300]), frame(0x89, b""), frame(0x80, b"y")];
        let whole = frames.concat();
        let ends: Vec<usize> = vec![frames[0].len(), whole.len()];
        for step in 1..40 {
            let (mut reader, mut at, mut found) = (FrameReader::default(), 0, Vec::new());
            for bytes in whole.chunks(step) {
                at += bytes.len();
                if reader.read(bytes) {
                    found.push(at);
                }
            }
            let expected: Vec<usize> =
                ends.iter().map(|end| whole.len().min(end.div_ceil(step) * step)).collect();
            assert_eq!(found, expected, "step {step}");
            assert!(reader.is_between_messages());
        }
        let mut reader = FrameReader::default();
        assert!(!reader.read(&[0x81, 0xff, 0, 0, 0, 0, 0, 0, 1, 0, 9, 9, 9, 9, 7]));
        assert_eq!(reader.payload, 255);
    }

    #[tokio::test]
    async fn a_message_that_dribbles_is_cut_and_a_silent_line_is_not() {
        let (mut client, server) = tokio::io::duplex(1 << 10);
        let mut server = WholeMessages::new(server, Duration::from_millis(40), &Memory::new(1 << 20));
        let mut buffer = [0; 64];
        let whole = frame(0x81, b"{}");
        client.write_all(&whole).await.unwrap();
        assert_eq!(server.read(&mut buffer).await.unwrap(), whole.len());
        let silent = tokio::time::timeout(Duration::from_millis(200), server.read(&mut buffer)).await;
        assert!(silent.is_err(), "{silent:?}");
        let dribble = tokio::spawn(async move {
            for byte in frame(0x81, &[b'x'; 100]) {
                let _ = client.write_all(&[byte]).await;
                tokio::time::sleep(Duration::from_millis(5)).await;
            }
        });
        let mut bytes = 0;
        let cut = loop {
            match server.read(&mut buffer).await {
                Ok(count) => bytes += count,
                Err(error) => break error,
            }
        };
        assert!(cut.kind() == std::io::ErrorKind::TimedOut && bytes < 100, "{cut} after {bytes} bytes");
        dribble.abort();
    }
}
