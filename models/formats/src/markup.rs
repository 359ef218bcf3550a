//! Writes XML: elements close in reverse order, and text is always escaped.

use crate::written::FileBounds;
use std::fmt::{Display, Write};
use std::io;

/// Bytes of a part of a document: a single text would take three times its size while it grows.
const PART_BYTES: usize = 1 << 20;

/// A document that is being written.
pub(crate) struct Markup {
    /// Finished parts.
    parts: Vec<String>,
    /// The current part.
    text: String,
    open: Vec<&'static str>,
    /// Limits of the document. Text beyond them is dropped, and the document is refused at its end.
    bounds: FileBounds,
    bytes: u64,
}

impl Markup {
    /// An empty document within bounds.
    pub fn new(bounds: FileBounds) -> Self {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        Self { parts: Vec::new(), text, open: Vec::new(), bounds, bytes: 0 }
    }

    /// Finishes the current part if it is long enough.
    fn part(&mut self) {
        if self.text.len() >= PART_BYTES {
            self.bytes += self.text.len() as u64;
            let part = std::mem::take(&mut self.text);
            if self.check().is_ok() {
                self.parts.push(part);
            }
        }
    }

    /// Refuses a document that would be refused at its end, so that no more of it is written.
    ///
    /// # Errors
    /// Those of [`FileBounds::check`].
    pub fn check(&self) -> io::Result<()> {
        self.bounds.check(self.bytes)
    }

    fn start(&mut self, name: &'static str, attributes: &[(&str, &str)]) {
        self.part();
        let _ = write!(self.text, "{:1$}<{name}", "", 2 * self.open.len());
        for (attribute, value) in attributes {
            let _ = write!(self.text, " {attribute}=\"{}\"", escaped(value));
        }
    }

    /// Opens an element.
    pub fn open(&mut self, name: &'static str, attributes: &[(&str, &str)]) {
        self.start(name, attributes);
        self.text.push_str(">\n");
        self.open.push(name);
    }

    /// Closes the innermost open element.
    pub fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            let _ = writeln!(self.text, "{:1$}</{name}>", "", 2 * self.open.len());
        }
    }

    /// An element without content.
    pub fn empty(&mut self, name: &'static str, attributes: &[(&str, &str)]) {
        self.start(name, attributes);
        self.text.push_str("/>\n");
    }

    /// An element that holds a text.
    pub fn leaf(&mut self, name: &'static str, text: impl Display) {
        self.start(name, &[]);
        let _ = writeln!(self.text, ">{}</{name}>", escaped(&text.to_string()));
    }

    /// The document, with all elements closed.
    ///
    /// # Errors
    /// Those of [`FileBounds::check`].
    pub fn finish(mut self) -> io::Result<Vec<u8>> {
        while !self.open.is_empty() {
            self.close();
        }
        let bytes = self.bytes + self.text.len() as u64;
        self.bounds.check(bytes)?;
        let mut whole = Vec::with_capacity(bytes as usize);
        self.parts.push(self.text);
        self.parts.into_iter().for_each(|part| whole.extend(part.into_bytes()));
        Ok(whole)
    }
}

/// A number with six decimals, without an exponent.
pub(crate) fn decimal(value: f64) -> String {
    ((value * 1e6).round() / 1e6 + 0.0).to_string()
}

/// Whether XML text may contain this character (XML 1.0, 2.2, without the discouraged control characters).
pub(crate) fn is_char(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r') || !(c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
}

/// Text with special characters escaped, and without the characters that XML does not allow.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if is_char(c) => out.push(c),
            _ => {}
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Cancel;

    #[test]
    fn text_stays_text() {
        let mut markup = Markup::new(FileBounds::default());
        markup.open("a", &[("x", "1\"><b/>")]);
        markup.leaf("c", "</c>&\u{0}\n");
        markup.empty("d", &[]);
        let text = String::from_utf8(markup.finish().unwrap()).unwrap();
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"1&quot;&gt;&lt;b/&gt;\">\n  \
                        <c>&lt;/c&gt;&amp; </c>\n  <d/>\n</a>\n";
        assert_eq!(text, expected);
        assert_eq!([decimal(-1e-9), decimal(1.0 / 3.0), decimal(2e7)], ["0", "0.333333", "20000000"]);
    }

    #[test]
    fn a_document_in_parts_is_whole_and_one_beyond_its_bound_is_not_kept() {
        let long = "x".repeat(1_000);
        let written = |most: u64| {
            let mut markup = Markup::new(FileBounds::new(most, Cancel::default()));
            (0..5_000).for_each(|_| markup.empty("a", &[("x", &long)]));
            let kept: usize = markup.parts.iter().map(String::len).sum();
            (kept, markup.finish())
        };
        let (_, whole) = written(u64::MAX);
        let whole = whole.unwrap();
        assert_eq!(whole.len(), 39 + 5_000 * 1_010);
        assert!(whole.ends_with(b"x\"/>\n"));
        let (kept, refused) = written(2_500_000);
        assert_eq!(refused.unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        assert!(kept <= 2_500_000, "{kept}");
        let cancel = Cancel::default();
        let mut left = Markup::new(FileBounds::new(u64::MAX, cancel.clone()));
        left.open("a", &[]);
        left.check().unwrap();
        cancel.cancel();
        assert_eq!(left.check().unwrap_err().kind(), io::ErrorKind::ConnectionAborted);
    }
}
