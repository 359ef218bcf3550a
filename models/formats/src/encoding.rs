//! Decodes XML files to UTF-8 from the encoding of their byte order mark or their declaration.

use encoding_rs::{CoderResult, Decoder, Encoding, UTF_16BE, UTF_16LE};
use std::io::{self, BufRead, Read};

/// Bytes at the beginning that contain the declaration.
const HEAD: usize = 512;
/// Bytes of text that are decoded at a time.
const PIECE: usize = 16 << 10;

/// A reader that gives UTF-8 for a file of any encoding; UTF-8 passes through unchanged.
pub(crate) struct Utf8<R> {
    inner: R,
    /// The beginning, which was read to find the encoding, and how much of it is used.
    head: Vec<u8>,
    used: usize,
    begun: bool,
    /// Decoder; nothing for UTF-8.
    decoder: Option<Decoder>,
    decoded: Vec<u8>,
    given: usize,
    ended: bool,
}

impl<R: BufRead> Utf8<R> {
    pub fn new(inner: R) -> Self {
        let (head, decoded) = (Vec::new(), Vec::new());
        Self { inner, head, used: 0, begun: false, decoder: None, decoded, given: 0, ended: false }
    }

    fn begin(&mut self) -> io::Result<()> {
        while self.head.len() < HEAD && !self.head.ends_with(b"?>") {
            let chunk = self.inner.fill_buf()?;
            if chunk.is_empty() {
                break;
            }
            let count = chunk.len().min(HEAD - self.head.len());
            self.head.extend_from_slice(chunk.get(..count).unwrap_or_default());
            self.inner.consume(count);
        }
        self.begun = true;
        self.decoder = encoding(&self.head).map(Encoding::new_decoder);
        Ok(())
    }

    /// Decodes until there is text or the file ends.
    fn decode(&mut self) -> io::Result<()> {
        let Some(decoder) = &mut self.decoder else { return Ok(()) };
        while self.given == self.decoded.len() && !self.ended {
            let in_head = self.used < self.head.len();
            let chunk = if in_head { &self.head[self.used..] } else { self.inner.fill_buf()? };
            self.ended = chunk.is_empty();
            self.decoded.resize(PIECE, 0);
            self.given = 0;
            let (result, count, written, _) = decoder.decode_to_utf8(chunk, &mut self.decoded, self.ended);
            self.decoded.truncate(written);
            self.ended &= result == CoderResult::InputEmpty;
            if in_head {
                self.used += count;
            } else {
                self.inner.consume(count);
            }
        }
        Ok(())
    }
}

impl<R: BufRead> BufRead for Utf8<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if !self.begun {
            self.begin()?;
        }
        self.decode()?;
        match &self.decoder {
            Some(_) => Ok(self.decoded.get(self.given..).unwrap_or_default()),
            None if self.used < self.head.len() => Ok(self.head.get(self.used..).unwrap_or_default()),
            None => self.inner.fill_buf(),
        }
    }

    fn consume(&mut self, count: usize) {
        match &self.decoder {
            Some(_) => self.given = (self.given + count).min(self.decoded.len()),
            None if self.used < self.head.len() => self.used += count,
            None => self.inner.consume(count),
        }
    }
}

impl<R: BufRead> Read for Utf8<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.fill_buf()?.read(buffer)?;
        self.consume(count);
        Ok(count)
    }
}

/// The encoding of a file with this beginning; nothing for UTF-8 and for an unknown encoding.
fn encoding(head: &[u8]) -> Option<&'static Encoding> {
    let found = match head {
        [0, b'<', ..] => Some(UTF_16BE),
        [b'<', 0, ..] => Some(UTF_16LE),
        _ => Encoding::for_bom(head).map(|(encoding, _)| encoding).or_else(|| declared(head)),
    };
    found.filter(|encoding| *encoding != encoding_rs::UTF_8)
}

/// The encoding that `<?xml encoding="…"?>` states. A declaration in single bytes cannot be UTF-16.
fn declared(head: &[u8]) -> Option<&'static Encoding> {
    let end = head.windows(2).position(|two| two == b"?>")?;
    let text = std::str::from_utf8(head.get(..end)?).ok()?.trim_start();
    let (_, after) = text.strip_prefix("<?xml")?.split_once("encoding")?;
    let value = after.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let label = value.get(1..)?.split(quote).next()?;
    Encoding::for_label(label.as_bytes()).filter(|found| *found != UTF_16BE && *found != UTF_16LE)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads in pieces of three bytes, as from a slow connection.
    fn text(bytes: &[u8]) -> String {
        let mut text = String::new();
        let mut reader = Utf8::new(io::BufReader::with_capacity(3, bytes));
        reader.read_to_string(&mut text).unwrap_or_default();
        text
    }

    #[test]
    fn declared_encodings_become_utf_8() {
        let with = |label: &str, letter: &[u8]| {
            let begin = format!("<?xml version='1.0' encoding='{label}'?><a n='");
            [begin.as_bytes(), letter, b"'/>"].concat()
        };
        for (label, letter) in
            [("ISO-8859-1", &b"\xdf"[..]), ("windows-1252", b"\xdf"), ("UTF-8", "ß".as_bytes())]
        {
            assert!(text(&with(label, letter)).ends_with("<a n='ß'/>"), "{label}");
        }
        assert!(text(&with("iso-8859-2", b"\xb3")).ends_with("<a n='ł'/>"));
        let utf_16 = |bytes: fn(u16) -> [u8; 2], mark: bool| -> Vec<u8> {
            let mark = if mark { "\u{feff}" } else { "" };
            format!("{mark}<?xml version='1.0' encoding='UTF-16'?><a n='ß'/>")
                .encode_utf16()
                .flat_map(bytes)
                .collect()
        };
        for file in
            [utf_16(u16::to_le_bytes, true), utf_16(u16::to_be_bytes, true), utf_16(u16::to_le_bytes, false)]
        {
            assert!(text(&file).ends_with("<a n='ß'/>"));
        }
        let long = format!("<a>{}</a>", "ü".repeat(40_000));
        assert_eq!(text(long.as_bytes()), long);
        let latin: Vec<u8> = with("latin1", &[0xfc].repeat(40_000));
        assert_eq!(text(&latin).matches('ü').count(), 40_000);
        // An unknown encoding name, and UTF-16 declared in single bytes, are read as UTF-8.
        assert!(text(&with("klingon", "ß".as_bytes())).ends_with("<a n='ß'/>"));
        assert!(text(&with("utf-16", "ß".as_bytes())).ends_with("<a n='ß'/>"));
    }
}
