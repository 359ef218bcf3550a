//! A pull scanner for the XML of traffic formats: elements, attributes, and text on request. It reads all
//! XML.
//!
//! XML 1.0 without document type definitions (so the only entities are the five of section 4.6 and character
//! references), bounded in depth, in attributes and in the length of a tag. Memory does not grow with the
//! file. Encodings other than UTF-8 are decoded first ([`Utf8`]).
//!
//! Why not a library: on an FCD file of 50 MB (366,000 elements) this scanner took 0.41 to 0.49 s, quick-xml
//! (0.42) took 0.44 to 0.63 s, and roxmltree 0.62 to 0.86 s with a tree of 336 MB. quick-xml keeps a whole
//! text, comment or tag in memory (51 to 105 MB if one fills a file of 50 MB; here 2 MB) and limits neither
//! depth nor attributes. Lines, limits, the root and unclosed elements would still have to be checked here.

use crate::encoding::Utf8;
use crate::markup::is_char;
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, found_expected, quoted, shown, tag, wanted, what};
use crate::unpack;
use scene::message::{Message, Word};
use std::io::{self, BufRead};

/// Deepest nesting that is read; a map has about ten levels.
const MAX_DEPTH: usize = 32;
/// Beginning of a CDATA section, after the `<`.
const CDATA: &[u8] = b"![CDATA[";
/// Most attributes of one element.
const MAX_ATTRIBUTES: usize = 128;

/// A start tag.
#[derive(Clone, Debug, Default)]
pub(crate) struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    /// Line in the file, from 1.
    pub line: u32,
}

impl Element {
    pub fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, value)| value.as_str())
    }

    /// # Errors When the attribute is missing.
    pub fn required(&self, attribute: &'static str) -> Result<&str, Missing> {
        let missing = || Missing { element: shown(&self.name), attribute, line: self.line };
        self.get(attribute).ok_or_else(missing)
    }
}

/// A required attribute is missing.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: <{element}> has no attribute \"{attribute}\"")]
pub struct Missing {
    /// Element name.
    pub element: String,
    /// Attribute that was expected.
    pub attribute: &'static str,
    /// Line in the file, from 1.
    pub line: u32,
}

impl From<Missing> for ReadError {
    fn from(missing: Missing) -> Self {
        let message = refusals::element_lacks_attribute(&missing.element, missing.attribute);
        FieldProblem::new("", code::INVALID_FIELD, message.at_line(missing.line)).into()
    }
}

/// One event of the scanner.
#[derive(Clone, Debug)]
pub(crate) enum XmlEvent {
    /// Also for an element without content, which has an end too.
    Start(Element),
    /// The end of an element.
    End,
    /// Text within an element, trimmed and never empty; only if the caller requested texts.
    Text(String),
}

/// Reads events one by one.
pub(crate) struct Scanner<R> {
    input: Utf8<R>,
    line: u32,
    offset: u64,
    open: Vec<String>,
    /// Whether an empty element still has to end.
    pending: bool,
    seen_root: bool,
    max_tag: usize,
    tag: Vec<u8>,
    /// Whether text is returned instead of skipped.
    texts: bool,
    /// Whether the `<` of the next tag has been read, after text.
    in_tag: bool,
}

impl<R: BufRead> Scanner<R> {
    /// `max_tag`: most bytes of one tag.
    pub fn new(input: R, max_tag: usize) -> Self {
        Self {
            input: Utf8::new(input),
            line: 1,
            offset: 0,
            open: Vec::new(),
            pending: false,
            seen_root: false,
            max_tag,
            tag: Vec::new(),
            texts: false,
            in_tag: false,
        }
    }

    /// Returns text too. One piece is at most as long as a tag.
    pub fn with_texts(self) -> Self {
        Self { texts: true, ..self }
    }

    /// The next event; `None` after the end of the root.
    ///
    /// # Errors
    /// `malformed-file` with the byte and the line of the tag; the limits of the reader.
    pub fn next(&mut self) -> Result<Option<XmlEvent>, ReadError> {
        if std::mem::take(&mut self.pending) {
            return Ok(Some(XmlEvent::End));
        }
        loop {
            if !std::mem::take(&mut self.in_tag) {
                self.tag.clear();
                if !self.until(b'<', self.texts && !self.open.is_empty())? {
                    return match self.open.last() {
                        Some(name) => Err(self.wrong(refusals::file_ends_inside(tag(name)))),
                        None if !self.seen_root => Err(self.wrong(refusals::file_has_no(what::XML_ELEMENT))),
                        None => Ok(None),
                    };
                }
                if let Some(text) = self.text()? {
                    self.in_tag = true;
                    return Ok(Some(XmlEvent::Text(text)));
                }
            }
            let (start, line) = (self.offset.saturating_sub(1), self.line);
            self.tag.clear();
            self.until_tag_end(start, line)?;
            let result = match self.tag.first() {
                Some(b'!') if self.tag.starts_with(CDATA) => {
                    match self.character_data().map_err(|fault| at(start, line, fault))? {
                        Some(text) => return Ok(Some(XmlEvent::Text(text))),
                        None => continue,
                    }
                }
                Some(b'?' | b'!') => continue,
                Some(b'/') => self.end(),
                _ => self.start(line),
            };
            return result.map(Some).map_err(|fault| at(start, line, fault));
        }
    }

    fn wrong(&self, fault: Message) -> ReadError {
        at(self.offset, self.line, fault)
    }

    /// Skips everything up to and including `byte`, and appends it to `self.tag` if `keep`. False at the end
    /// of the file.
    fn until(&mut self, byte: u8, keep: bool) -> Result<bool, ReadError> {
        loop {
            let chunk = match self.input.fill_buf() {
                Ok(chunk) => chunk,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(unpack::fault(&error, self.offset)),
            };
            let found = chunk.iter().position(|b| *b == byte);
            let length = found.map_or(chunk.len(), |i| i + 1);
            let part = chunk.get(..length).unwrap_or(chunk);
            self.line += part.iter().filter(|b| **b == b'\n').count() as u32;
            if keep {
                self.tag.extend_from_slice(part);
            }
            let ended = part.is_empty();
            self.input.consume(length);
            self.offset += length as u64;
            if ended || found.is_some() {
                return Ok(found.is_some());
            }
            if keep && self.tag.len() > self.max_tag {
                // Comments may be of any length: only their last bytes are needed.
                if self.tag.starts_with(b"!--") {
                    self.tag.drain(3..self.tag.len() - 2);
                    continue;
                }
                return Err(self.wrong(refusals::more_than(self.max_tag, what::TAG_BYTES)));
            }
        }
    }

    /// The text before a tag whose `<` has just been read.
    fn text(&self) -> Result<Option<String>, ReadError> {
        let bytes = self.tag.strip_suffix(b"<").unwrap_or(&self.tag).trim_ascii();
        if bytes.is_empty() {
            return Ok(None);
        }
        let text = utf8(bytes, what::TEXT);
        text.and_then(unescaped).map(Some).map_err(|fault| self.wrong(fault))
    }

    /// Content of a CDATA section, if the caller requested texts.
    fn character_data(&self) -> Result<Option<String>, Message> {
        let bytes = self.tag.strip_prefix(CDATA).and_then(|rest| rest.strip_suffix(b"]]>"));
        let bytes = bytes.unwrap_or_default().trim_ascii();
        if !self.texts || self.open.is_empty() || bytes.is_empty() {
            return Ok(None);
        }
        Ok(Some(utf8(bytes, what::TEXT)?.to_owned()))
    }

    /// Reads to the `>` that ends the tag, which is neither in a quoted value nor in a comment.
    fn until_tag_end(&mut self, start: u64, line: u32) -> Result<(), ReadError> {
        let mut quote = None;
        let mut checked = 0;
        loop {
            if !self.until(b'>', true)? {
                return Err(at(start, line, refusals::file_ends_inside(what::TAG)));
            }
            if self.tag.len() > self.max_tag {
                return Err(at(start, line, refusals::more_than(self.max_tag, what::TAG_BYTES)));
            }
            if self.tag.starts_with(b"!--") {
                // Comments may be of any length: only their last bytes are needed.
                if self.tag.len() >= 6 && self.tag.ends_with(b"-->") {
                    return Ok(());
                }
                let last = self.tag.len().saturating_sub(2).max(3);
                self.tag.drain(3..last);
                continue;
            }
            if self.tag.starts_with(CDATA) {
                if self.tag.len() >= CDATA.len() + 3 && self.tag.ends_with(b"]]>") {
                    return Ok(());
                }
                // The same is true of CDATA sections if no text was requested.
                if !self.texts {
                    let last = self.tag.len().saturating_sub(2).max(CDATA.len());
                    self.tag.drain(CDATA.len()..last);
                }
                continue;
            }
            if self.tag.first() == Some(&b'!') {
                return Err(at(start, line, refusals::not_read(what::DOCTYPE)));
            }
            if self.tag.first() == Some(&b'?') {
                if self.tag.ends_with(b"?>") {
                    return Ok(());
                }
                continue;
            }
            for byte in self.tag.get(checked..).unwrap_or_default() {
                match (quote, byte) {
                    (None, b'"' | b'\'') => quote = Some(*byte),
                    (Some(open), close) if open == *close => quote = None,
                    _ => {}
                }
            }
            checked = self.tag.len();
            if quote.is_none() {
                return Ok(());
            }
        }
    }

    fn end(&mut self) -> Result<XmlEvent, Message> {
        let text = utf8(&self.tag, what::TAG)?;
        let name = text.trim_start_matches('/').trim_end_matches('>').trim_end();
        match self.open.pop() {
            Some(open) if open == name => Ok(XmlEvent::End),
            Some(open) => Err(found_expected(end_tag(name), end_tag(&open))),
            None => Err(found_expected(end_tag(name), wanted::START_TAG)),
        }
    }

    fn start(&mut self, line: u32) -> Result<XmlEvent, Message> {
        let text = utf8(&self.tag, what::TAG)?;
        let text = text.trim_end_matches('>');
        let (text, empty) = match text.strip_suffix('/') {
            Some(rest) => (rest, true),
            None => (text, false),
        };
        let split = text.find(char::is_whitespace).unwrap_or(text.len());
        let (name, mut rest) = text.split_at(split);
        if !is_name(name) {
            return Err(found_expected(quoted(&format!("<{name}")), wanted::ELEMENT));
        }
        if self.open.is_empty() && self.seen_root {
            return Err(found_expected(tag(name), wanted::ROOT_END));
        }
        if self.open.len() >= MAX_DEPTH {
            return Err(refusals::nested_deeper(MAX_DEPTH));
        }
        let mut element = Element { name: name.to_owned(), attributes: Vec::new(), line };
        loop {
            rest = rest.trim_start();
            if rest.is_empty() {
                break;
            }
            let (attribute, after) = attribute(rest)?;
            if element.get(&attribute.0).is_some() {
                return Err(refusals::appears_twice(what::ATTRIBUTE, &shown(&attribute.0)));
            }
            if element.attributes.len() >= MAX_ATTRIBUTES {
                return Err(refusals::more_than(MAX_ATTRIBUTES, what::ATTRIBUTES));
            }
            element.attributes.push(attribute);
            rest = after;
        }
        self.seen_root = true;
        if empty {
            self.pending = true;
        } else {
            self.open.push(element.name.clone());
        }
        Ok(XmlEvent::Start(element))
    }
}

fn at(offset: u64, line: u32, fault: Message) -> ReadError {
    ReadError::malformed(offset, fault.at_line(line))
}

fn end_tag(name: &str) -> String {
    format!("</{}>", shown(name))
}

fn utf8(bytes: &[u8], what: Word) -> Result<&str, Message> {
    std::str::from_utf8(bytes).map_err(|_| refusals::not_utf8(what))
}

fn is_name(text: &str) -> bool {
    let first = text.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_' || c == ':');
    first && !text.contains(['<', '>', '"', '\'', '=', '&', '/'])
}

/// One `name="value"` and the rest of the text.
fn attribute(text: &str) -> Result<((String, String), &str), Message> {
    let wrong = || found_expected(quoted(text), wanted::ATTRIBUTE);
    let (name, rest) = text.split_once('=').ok_or_else(wrong)?;
    let (name, rest) = (name.trim_end(), rest.trim_start());
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\'')).ok_or_else(wrong)?;
    let rest = rest.get(1..).ok_or_else(wrong)?;
    let (value, rest) = rest.split_once(quote).ok_or_else(wrong)?;
    if !is_name(name) || value.contains('<') {
        return Err(wrong());
    }
    Ok(((name.to_owned(), unescaped(value)?), rest))
}

/// Replaces references (XML 1.0, 4.1 and 4.6). No reference can contain another, so nothing grows. Characters
/// that XML does not allow are left out, as they are in written XML.
fn unescaped(value: &str) -> Result<String, Message> {
    let mut text = String::with_capacity(value.len());
    let mut rest = value;
    while let Some((before, after)) = rest.split_once('&') {
        text.push_str(before);
        let name = || format!("&{}", after.split(';').next().unwrap_or_default());
        let wrong = || found_expected(quoted(&name()), wanted::REFERENCE);
        let (name, after) = after.split_once(';').ok_or_else(wrong)?;
        let number = name.strip_prefix('#').map(|n| match n.strip_prefix('x') {
            Some(hex) => u32::from_str_radix(hex, 16),
            None => n.parse(),
        });
        let found = match (name, number) {
            ("lt", _) => Some('<'),
            ("gt", _) => Some('>'),
            ("amp", _) => Some('&'),
            ("quot", _) => Some('"'),
            ("apos", _) => Some('\''),
            (_, Some(Ok(number))) => char::from_u32(number),
            _ => None,
        };
        text.push(found.ok_or_else(wrong)?);
        rest = after;
    }
    text.push_str(rest);
    text.retain(is_char);
    Ok(text)
}

/// Name of the root element, by which a file is recognised. Reads no further than `head`.
pub(crate) fn root_of(head: &[u8]) -> Option<String> {
    match Scanner::new(head, head.len().max(1)).next() {
        Ok(Some(XmlEvent::Start(element))) => Some(element.name),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(mut scanner: Scanner<impl BufRead>) -> Result<String, ReadError> {
        let mut out = String::new();
        while let Some(event) = scanner.next()? {
            match event {
                XmlEvent::Start(e) => {
                    out.push_str(&e.name);
                    e.attributes.iter().for_each(|(n, v)| out.push_str(&format!("[{n}:{v}]")));
                }
                XmlEvent::End => out.push(';'),
                XmlEvent::Text(text) => out.push_str(&format!("'{text}'")),
            }
        }
        Ok(out)
    }

    fn all(text: &str) -> Result<String, ReadError> {
        walk(Scanner::new(text.as_bytes(), 200))
    }

    #[test]
    fn text_is_given_where_it_is_asked_for() {
        let text = "<a> 1 &lt; 2 <b>x</b><!-- c --><![CDATA[ <y> & z ]]></a>\n";
        assert_eq!(all(text).unwrap(), "ab;;");
        let scanner = Scanner::new(text.as_bytes(), 200).with_texts();
        assert_eq!(walk(scanner).unwrap(), "a'1 < 2'b'x';'<y> & z';");
        let long = format!("<a><![CDATA[{}]]></a>", "> ]] ".repeat(1_000));
        assert_eq!(all(&long).unwrap(), "a;");
        let refused = walk(Scanner::new(long.as_bytes(), 200).with_texts()).unwrap_err();
        assert!(refused.to_string().contains("more than 200 bytes"));
        assert!(walk(Scanner::new("<a>&b;</a>".as_bytes(), 200).with_texts()).is_err());
    }

    #[test]
    fn reads_elements_and_attributes() {
        let text = "\u{feff}<?xml version=\"1.0\"?>\n<!-- a > b --> <a x = '1>\"' y=\"&lt;&#65;&#x42;&amp;\">t<b/></a>\n<!---->";
        assert_eq!(all(text).unwrap(), "a[x:1>\"][y:<AB&]b;;");
    }

    #[test]
    fn characters_without_a_place_in_xml_are_left_out() {
        let text = "<a x=\"s\u{3}ide\u{ffff}wa&#7;lk\" y=\"ü\t\u{1f6b8}\"/>";
        assert_eq!(all(text).unwrap(), "a[x:sidewalk][y:ü\t\u{1f6b8}];");
    }

    #[test]
    fn long_comments_are_passed_over() {
        let text = format!("<!--{}--><a/>", "> - -- <x> ".repeat(1_000));
        assert_eq!(all(&text).unwrap(), "a;");
        let text = format!("<!--{}--><a/>", "- -- <x ".repeat(1_000));
        let slow = Scanner::new(io::BufReader::with_capacity(7, text.as_bytes()), 200);
        assert_eq!(walk(slow).unwrap(), "a;");
    }

    #[test]
    fn says_where_it_breaks() {
        for (text, expected) in [
            ("", "line 1: the file has no XML element"),
            ("text", "line 1: the file has no XML element"),
            ("<a>\n<b></a>", "line 2: </a> found, </b> expected"),
            ("<a>\n<b>", "line 2: the file ends inside <b>"),
            ("<a x=1/>", "line 1: \"x=1\" found, an attribute"),
            ("<a x='1' x='2'/>", "line 1: attribute \"x\" appears twice"),
            ("<a\nx='", "line 1: the file ends inside a tag"),
            ("<a/><b/>", "line 1: <b> found, the end of the document expected"),
            ("</a>", "line 1: </a> found, an open element expected"),
            ("<a x='&who;'/>", "line 1: \"&who\" found, a known reference expected"),
            ("<!DOCTYPE a [<!ENTITY b 'c'>]><a/>", "line 1: a document type"),
            ("<!-- never", "line 1: the file ends inside a tag"),
            ("< a/>", "line 1: \"<\" found"),
        ] {
            let error = all(text).unwrap_err();
            let detail = &error.problems[0].detail;
            assert!(detail.starts_with(expected), "{text}: {detail}");
        }
        assert!(all(&"<a>".repeat(100)).unwrap_err().to_string().contains("nested deeper than 32"));
        assert!(all(&format!("<a x='{}'/>", "1".repeat(300))).unwrap_err().to_string().contains("200 bytes"));
    }
}
