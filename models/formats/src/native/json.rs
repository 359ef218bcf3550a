//! From bytes to a typed document with the place of the fault.

use crate::limits::{MAX_DOCUMENT_VALUES, memory_for};
use crate::problem::{FieldProblem, ReadError, code, pointer_token};
use crate::refusals::{more_than, parser_words, what};
use crate::source::{Source, unmarked};
use crate::unpack;
use scene::objects::Objects;
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde_json::Deserializer;
use serde_json::error::Category;
use serde_path_to_error::{Path, Segment};
use std::io::{self, BufReader, Read};

/// Longest message: it may quote the document.
const MAX_DETAIL: usize = 300;

/// Parses JSON as any document type. A list is never read as an object.
///
/// # Errors
/// `malformed-json` with line and column for text that is not JSON (including NaN, numbers beyond f64 and
/// nesting over 128); `invalid-field` with a JSON pointer for a wrong type, or an unknown, missing or
/// repeated member.
pub fn from_json<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, ReadError> {
    parse(|| Ok(Deserializer::from_slice(bytes)))
}

/// Most bytes of a document that is read into memory before it is parsed, which is faster.
const WHOLE_BYTES: u64 = 8 << 20;
/// Memory for detecting a longer text, and for holding a long one while it is parsed.
const WHOLE_MEMORY: u64 = 24 << 20;
/// Memory of a value, bytes: eight, and half as much while its list grows.
const VALUE_MEMORY: u64 = 12;

/// The text of a document.
pub(super) enum Text<'a> {
    /// The whole text.
    Whole(Vec<u8>),
    /// A text that is too long to be in memory beside its result.
    Long(Long<'a>),
}

/// Text that is parsed while it is read.
pub(super) struct Long<'a>(&'a dyn Source);

impl<'a> Text<'a> {
    /// The text of a file.
    ///
    /// # Errors
    /// `malformed-file` when it cannot be read.
    pub fn of(file: &'a dyn Source) -> Result<Self, ReadError> {
        let mut bytes = Vec::new();
        let read = file
            .open()
            .and_then(unmarked)
            .and_then(|input| input.take(WHOLE_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| unpack::fault(&error, bytes.len() as u64))?;
        Ok(if bytes.len() as u64 > WHOLE_BYTES { Self::Long(Long(file)) } else { Self::Whole(bytes) })
    }
}

impl<'a> Long<'a> {
    /// Reads the text from its beginning.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn open(&self) -> io::Result<BufReader<ValueLimiter<impl Read + use<'a>>>> {
        let room = memory_for(self.0.encoded_len()).saturating_sub(WHOLE_MEMORY) / VALUE_MEMORY;
        let most = room.min(MAX_DOCUMENT_VALUES);
        let inner = unmarked(self.0.open()?)?;
        Ok(BufReader::with_capacity(64 << 10, ValueLimiter { inner, commas: 0, most }))
    }

    /// As [`from_json`].
    ///
    /// # Errors
    /// Those of [`from_json`], and `malformed-file` when it cannot be read.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, ReadError> {
        let open = || self.open().map(Deserializer::from_reader);
        parse(|| open().map_err(|error| unpack::fault(&error, 0)))
    }
}

/// Ends a text that has more values than a scene, by counting commas: there is one between any two values of
/// a list.
pub(super) struct ValueLimiter<R> {
    inner: R,
    commas: u64,
    most: u64,
}

impl<R: Read> Read for ValueLimiter<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        let text = buffer.get(..count).unwrap_or_default();
        self.commas += text.iter().filter(|byte| **byte == b',').count() as u64;
        if self.commas > self.most {
            let message = more_than(self.most, what::DOCUMENT_VALUES);
            return Err(unpack::excess(code::DECODED_TOO_LARGE, self.most, message));
        }
        Ok(count)
    }
}

/// Parses text that can be read again to find a fault's place.
fn parse<'de, R: serde_json::de::Read<'de>, T: DeserializeOwned>(
    open: impl Fn() -> Result<Deserializer<R>, ReadError>,
) -> Result<T, ReadError> {
    let mut parser = open()?;
    match T::deserialize(Objects(&mut parser)).and_then(|value| parser.end().map(|()| value)) {
        Ok(value) => Ok(value),
        // The plain parser is twice as fast; the one that tracks places runs only after a fault.
        Err(error) if error.is_io() => Err(unpack::fault(&error.into(), 0)),
        // For a wrong word, such as null, the plain parser reports a fault of the text.
        Err(error) if error.classify() == Category::Data || lacks_a_word(&error) && is_json(open()?) => {
            Err(locate::<R, T>(open()?, &error))
        }
        Err(error) => Err(ReadError::malformed_json(&error, reason(&error))),
    }
}

/// If one of a set of words is expected, the plain parser reports other values as broken text.
fn lacks_a_word(error: &serde_json::Error) -> bool {
    error.classify() == Category::Syntax && error.to_string().starts_with("expected value")
}

fn is_json<'de, R: serde_json::de::Read<'de>>(mut parser: Deserializer<R>) -> bool {
    IgnoredAny::deserialize(&mut parser).is_ok() && parser.end().is_ok()
}

fn locate<'de, R: serde_json::de::Read<'de>, T: DeserializeOwned>(
    mut parser: Deserializer<R>,
    error: &serde_json::Error,
) -> ReadError {
    let (pointer, detail) = match serde_path_to_error::deserialize::<_, T>(Objects(&mut parser)) {
        Err(error) => (pointer_of(error.path()), plain_words(error.inner())),
        Ok(_) => (String::new(), plain_words(error)),
    };
    FieldProblem::new(pointer, code::INVALID_FIELD, parser_words(&detail)).into()
}

/// The message without serde_json's own " at line 1 column 2", which `RefusalKind` holds as numbers.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.rfind(" at line ") {
        Some(at) => text.get(..at).unwrap_or(&text).to_owned(),
        None => text,
    }
}

/// The message in terms of the document instead of Rust's, with at most 300 characters.
fn plain_words(error: &serde_json::Error) -> String {
    let text = reason(error);
    let words = [
        ("expected f64", "expected a number"),
        ("expected u64", "expected a whole number from 0"),
        ("expected u32", "expected a whole number from 0"),
        ("floating point", "number"),
        ("expected value", "expected a word"),
    ];
    let text = words.iter().fold(text, |text, (from, to)| text.replace(from, to));
    let text = match text.find("expected struct ") {
        Some(at) => format!("{}expected an object", text.get(..at).unwrap_or_default()),
        None => text,
    };
    let mut end = text.len().min(MAX_DETAIL);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    match text.get(..end) {
        Some(start) if end < text.len() => format!("{start}…"),
        _ => text,
    }
}

/// RFC 6901 form of a place.
fn pointer_of(path: &Path) -> String {
    let mut pointer = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => pointer.push_str(&format!("/{index}")),
            Segment::Map { key } | Segment::Enum { variant: key } => {
                pointer.push('/');
                pointer.push_str(&pointer_token(key));
            }
            Segment::Unknown => {}
        }
    }
    pointer
}

#[cfg(test)]
mod tests {
    use super::super::SceneDoc;
    use super::{Long, from_json};
    use serde::Deserialize;
    use std::collections::BTreeMap;

    #[derive(Debug, PartialEq, Deserialize)]
    struct Goal {
        x_m: f64,
        #[serde(default)]
        inner: Option<Box<Goal>>,
        #[serde(default)]
        list: Vec<Goal>,
        #[serde(default)]
        by_name: BTreeMap<String, Goal>,
        #[serde(default)]
        pair: Option<(f64, f64)>,
    }

    #[test]
    fn a_list_is_no_object_at_any_depth_and_its_place_is_told() {
        let place = |text: &str| {
            let refused = from_json::<Goal>(text.as_bytes()).unwrap_err();
            refused.problems.first().map(|fault| (fault.pointer.clone(), fault.detail.clone())).unwrap()
        };
        let (pointer, detail) = place("[1.0]");
        assert_eq!((pointer.as_str(), detail.contains("an object")), ("", true), "{detail}");
        assert_eq!(place(r#"{"x_m":1,"inner":[2]}"#).0, "/inner");
        assert_eq!(place(r#"{"x_m":1,"list":[{"x_m":1},[2]]}"#).0, "/list/1");
        assert_eq!(place(r#"{"x_m":1,"by_name":{"a":{"x_m":1,"inner":[2]}}}"#).0, "/by_name/a/inner");
        // Lists stay lists.
        let read: Goal = from_json(br#"{"x_m":1,"pair":[2,3],"list":[]}"#).unwrap();
        assert_eq!(read.pair, Some((2.0, 3.0)));
    }

    #[test]
    fn a_value_that_is_no_word_has_a_place_and_is_json() {
        #[derive(Debug, Deserialize)]
        #[serde(rename_all = "snake_case")]
        enum Colour {
            Red,
        }
        #[derive(Debug, Deserialize)]
        struct Worded {
            #[serde(rename = "subtype")]
            _word: Colour,
        }
        for value in ["null", "7", "[]", "true"] {
            let text = format!("[{{\"subtype\":{value}}}]");
            let refused = from_json::<Vec<Worded>>(text.as_bytes()).unwrap_err();
            let fault = refused.problems.first().unwrap();
            assert_eq!((fault.pointer.as_str(), fault.code), ("/0/subtype", "invalid-field"), "{value}");
        }
        let broken = from_json::<Vec<Worded>>(b"[{\"subtype\":nul}]").unwrap_err();
        assert_eq!(broken.code(), "malformed-json");
    }

    #[test]
    fn a_long_text_has_the_same_faults_in_the_same_places() {
        let text = include_str!("../../tests/fixtures/junction.scene.json");
        let lines = text.replace(',', ",\n ");
        let mut different = Vec::new();
        for whole in [text.as_bytes(), lines.as_bytes()] {
            for i in 0..400usize {
                let mut bytes = whole.to_vec();
                let at = i * 7_919 % bytes.len();
                match i % 4 {
                    0 => bytes.truncate(at),
                    1 => bytes[at] = b"{}[]\",:xe-\n\xff"[i / 4 % 12],
                    2 => bytes.insert(at, b"{}[]\",:0e-\n\x01"[i / 4 % 12]),
                    _ => drop(bytes.remove(at)),
                }
                let long = Long(&bytes).parse::<SceneDoc>();
                let short = from_json::<SceneDoc>(&bytes);
                if long != short {
                    different.push((i, at, long.err(), short.err()));
                }
            }
        }
        assert!(different.is_empty(), "{} differ: {:?}", different.len(), different.first());
    }
}
