//! Writes XML: elements close in reverse order, and text is always escaped.

use crate::written::{BoundedFile, FileBounds};
use std::fmt::{Display, Write as _};
use std::io::{self, Write as _};

/// Bytes of text that are given to the file at once.
const TEXT_BYTES: usize = 1 << 16;

/// A document that is being written.
pub(crate) struct Markup {
    /// The document so far, without the text below. Text beyond its limits is dropped.
    file: BoundedFile,
    text: String,
    open: Vec<&'static str>,
    /// Refusal of a document that is beyond its limits.
    refused: Option<io::Error>,
}

impl Markup {
    /// An empty document within bounds.
    pub fn new(bounds: FileBounds) -> Self {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        Self { file: BoundedFile::new(bounds), text, open: Vec::new(), refused: None }
    }

    /// Gives the text to the file.
    fn give(&mut self) {
        if self.refused.is_none() {
            self.refused = self.file.write_all(self.text.as_bytes()).err();
        }
        self.text.clear();
    }

    /// Refuses a document that would be refused at its end, so that no more of it is written.
    ///
    /// # Errors
    /// Those of [`FileBounds::check`].
    pub fn check(&mut self) -> io::Result<()> {
        self.refused.take().map_or_else(|| self.file.check(), Err)
    }

    fn start(&mut self, name: &'static str, attributes: &[(&str, &str)]) {
        if self.text.len() >= TEXT_BYTES {
            self.give();
        }
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
    pub fn finish(mut self) -> io::Result<BoundedFile> {
        while !self.open.is_empty() {
            self.close();
        }
        self.give();
        self.check()?;
        Ok(self.file)
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
        let text = String::from_utf8(markup.finish().and_then(BoundedFile::whole).unwrap()).unwrap();
        let expected = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<a x=\"1&quot;&gt;&lt;b/&gt;\">\n  \
                        <c>&lt;/c&gt;&amp; </c>\n  <d/>\n</a>\n";
        assert_eq!(text, expected);
        assert_eq!([decimal(-1e-9), decimal(1.0 / 3.0), decimal(2e7)], ["0", "0.333333", "20000000"]);
    }

    #[test]
    fn a_long_document_is_whole_and_one_beyond_its_bound_is_refused() {
        let long = "x".repeat(1_000);
        let written = |most: u64| {
            let mut markup = Markup::new(FileBounds::new(most, Cancel::default()));
            (0..5_000).for_each(|_| markup.empty("a", &[("x", &long)]));
            markup.finish().and_then(BoundedFile::whole)
        };
        let whole = written(u64::MAX).unwrap();
        assert_eq!(whole.len(), 39 + 5_000 * 1_010);
        assert!(whole.ends_with(b"x\"/>\n"));
        assert_eq!(written(2_500_000).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        let cancel = Cancel::default();
        let mut left = Markup::new(FileBounds::new(u64::MAX, cancel.clone()));
        left.open("a", &[]);
        left.check().unwrap();
        cancel.cancel();
        assert_eq!(left.check().unwrap_err().kind(), io::ErrorKind::ConnectionAborted);
    }
}
