//! From bytes to a typed document with the place of the fault.

use super::objects::Objects;
use crate::problem::{FieldProblem, ReadError, code, pointer_token};
use serde::de::DeserializeOwned;
use serde_json::error::Category;
use serde_path_to_error::{Path, Segment};

/// Longest message: it may quote the document.
const MAX_DETAIL: usize = 300;

/// Parses JSON into any document type. A list is never taken for an object.
///
/// # Errors
/// `malformed-json` with line and column for text that is not JSON (including NaN, numbers beyond
/// f64 and nesting over 128); `invalid-field` with a JSON pointer for a wrong type, an unknown,
/// missing or repeated member.
pub fn from_json<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, ReadError> {
    let mut parser = serde_json::Deserializer::from_slice(bytes);
    match T::deserialize(Objects(&mut parser)).and_then(|value| parser.end().map(|()| value)) {
        Ok(value) => Ok(value),
        // The plain parser is twice as fast; the one that tracks places runs only for a fault.
        Err(error) => Err(locate::<T>(bytes, &error)),
    }
}

fn locate<T: DeserializeOwned>(bytes: &[u8], error: &serde_json::Error) -> ReadError {
    if error.classify() != Category::Data {
        return ReadError::malformed_json(error.line(), error.column(), reason(error));
    }
    let mut parser = serde_json::Deserializer::from_slice(bytes);
    let (pointer, detail) = match serde_path_to_error::deserialize::<_, T>(Objects(&mut parser)) {
        Err(error) => (pointer_of(error.path()), plain_words(error.inner())),
        Ok(_) => (String::new(), plain_words(error)),
    };
    FieldProblem::new(pointer, code::INVALID_FIELD, detail).into()
}

/// The message without serde_json's own " at line 1 column 2", which `Kind` carries as numbers.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.rfind(" at line ") {
        Some(at) => text.get(..at).unwrap_or(&text).to_owned(),
        None => text,
    }
}

/// The message in words of the document instead of Rust's, at most 300 characters long.
fn plain_words(error: &serde_json::Error) -> String {
    let text = reason(error);
    let words = [
        ("expected f64", "expected a number"),
        ("expected u64", "expected a whole number from 0"),
        ("expected u32", "expected a whole number from 0"),
        ("floating point", "number"),
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
