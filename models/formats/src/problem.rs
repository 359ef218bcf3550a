//! Faults of outside data, in one shape for every format.

use crate::refusals::{wanted, what};
use crate::sentences;
use scene::message::{Message, Word};
use scene::sentences::{expected, more_than, out_of_range};
use scene::{Scene, SceneError};
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::Value;
use std::fmt;

/// Most faults that one refusal lists.
pub const MAX_PROBLEMS: usize = 32;

/// The codes that a reader can give. Programs switch on them, so they never change.
pub mod code {
    #![allow(missing_docs, reason = "the names say it")]
    pub const MALFORMED_JSON: &str = "malformed-json";
    pub const MALFORMED_FILE: &str = "malformed-file";
    pub const DECODED_TOO_LARGE: &str = "decoded-too-large";
    pub const EXPANSION_TOO_HIGH: &str = "expansion-too-high";
    pub const INVALID_FIELD: &str = "invalid-field";
    pub const OUT_OF_RANGE: &str = "out-of-range";
    pub const HALF_POSITION: &str = "half-position";
    pub const START_MISSING: &str = "start-missing";
    pub const DUPLICATE: &str = "duplicate";
    pub const UNKNOWN_AGENT: &str = "unknown-agent";
    pub const UNKNOWN_MAP: &str = "unknown-map";
    pub const TOO_MANY_AGENTS: &str = "too-many-agents";
    pub const MAP_TOO_LARGE: &str = "map-too-large";
    pub const UNSUPPORTED_VERSION: &str = "unsupported-version";
    pub const FORMAT_UNKNOWN: &str = "format-unknown";
    pub const CANNOT_REPRESENT: &str = "cannot-represent";
    pub const PICKLE_REFUSED: &str = "pickle-refused";
}

/// Text as one token of a JSON pointer (RFC 6901): `~` and `/` are escaped.
pub fn pointer_token(text: &str) -> String {
    text.replace('~', "~0").replace('/', "~1")
}

/// Transform for the schema of output types: optional members are omitted, never null. For types that skip
/// every `None` member.
pub fn never_null(schema: &mut Schema) {
    let required: Vec<String> = schema
        .get("required")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
        .filter_map(|name| name.as_str().map(str::to_owned))
        .collect();
    let members = schema.get_mut("properties").and_then(Value::as_object_mut);
    for (_, member) in members.into_iter().flatten().filter(|(name, _)| !required.contains(name)) {
        let Some(member) = member.as_object_mut() else { continue };
        if let Some(Value::Array(types)) = member.get_mut("type") {
            types.retain(|kind| kind != "null");
            if let [only] = types.as_slice() {
                let only = only.clone();
                member.insert("type".into(), only);
            }
        }
        if let Some(Value::Array(choices)) = member.remove("anyOf") {
            let mut choices: Vec<Value> = choices.into_iter().filter(|c| c["type"] != "null").collect();
            match (choices.pop(), choices.is_empty()) {
                (Some(Value::Object(only)), true) => member.extend(only),
                (last, _) => {
                    choices.extend(last);
                    member.insert("anyOf".into(), choices.into());
                }
            }
        }
    }
}

/// A fault of a request and its place.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(transform = never_null)]
pub struct FieldProblem {
    /// JSON pointer into the body, empty for the whole of it; /query/NAME for a parameter.
    pub pointer: String,
    /// Code for programs.
    pub code: &'static str,
    /// Value found and value expected, in English.
    pub detail: String,
    /// Least allowed value, if it is not reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<f64>,
    /// Greatest allowed value, if it is exceeded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<f64>,
    /// The value found, if it is a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub got: Option<f64>,
    /// The fault as data; faults outside of bodies and files may have none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<Box<Message>>,
}

impl FieldProblem {
    /// A fault without a range.
    pub fn new(pointer: impl Into<String>, code: &'static str, message: Message) -> Self {
        Self {
            pointer: pointer.into(),
            code,
            detail: message.english.clone(),
            min: None,
            max: None,
            got: None,
            message: Some(Box::new(message)),
        }
    }

    /// A number outside `min..=max`.
    pub fn range(pointer: impl Into<String>, min: f64, max: f64, got: f64) -> Self {
        Self::range_of(pointer, min, max, got, out_of_range(got, min, max))
    }

    /// A number outside `min..=max`, with its own sentence.
    pub fn range_of(pointer: impl Into<String>, min: f64, max: f64, got: f64, message: Message) -> Self {
        Self {
            min: Some(min),
            max: Some(max),
            got: Some(got),
            ..Self::new(pointer, code::OUT_OF_RANGE, message)
        }
    }
}

impl fmt::Display for FieldProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at \"{}\": {}", self.code, self.pointer, self.detail)
    }
}

impl From<SceneError> for FieldProblem {
    fn from(error: SceneError) -> Self {
        Self::new(error.at, error.code, error.message)
    }
}

/// Kind of refusal, which decides the HTTP status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusalKind {
    /// The text is not JSON (400). Line and column count from one.
    MalformedJson {
        /// Line of the fault.
        line: usize,
        /// Column of the fault, in bytes.
        column: usize,
    },
    /// A binary file is broken at this byte of its decoded form (400).
    MalformedFile {
        /// Byte offset.
        offset: u64,
    },
    /// The decoded form is larger than allowed (413).
    TooLarge {
        /// The exceeded limit, bytes or a ratio.
        limit: u64,
    },
    /// Readable, but invalid for a scene (422).
    Invalid,
}

/// Why outside data was refused. Never empty: `problems` has 1 to [`MAX_PROBLEMS`] entries.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// Kind of refusal.
    pub kind: RefusalKind,
    /// All faults that were found, in the order of the file.
    pub problems: Vec<FieldProblem>,
}

impl ReadError {
    /// A refusal of readable data.
    pub fn invalid(mut problems: Vec<FieldProblem>) -> Self {
        if problems.is_empty() {
            problems.push(FieldProblem::new("", code::INVALID_FIELD, expected(wanted::SCENE)));
        }
        problems.truncate(MAX_PROBLEMS);
        Self { kind: RefusalKind::Invalid, problems }
    }

    /// A broken binary file.
    pub fn malformed(offset: u64, message: Message) -> Self {
        let problem = FieldProblem::new("", code::MALFORMED_FILE, message);
        Self { kind: RefusalKind::MalformedFile { offset }, problems: vec![problem] }
    }

    /// Text that is not JSON, as the parser found it.
    pub fn malformed_json(error: &serde_json::Error, detail: impl Into<String>) -> Self {
        let message = sentences::json_syntax(sentences::json_fault::of(error));
        let mut problem = FieldProblem::new("", code::MALFORMED_JSON, message);
        // The parser's message is more precise than the sentence.
        problem.detail = detail.into();
        Self {
            kind: RefusalKind::MalformedJson { line: error.line(), column: error.column() },
            problems: vec![problem],
        }
    }

    /// A decoded form over its limit; `code` is `decoded-too-large` or `expansion-too-high`.
    pub fn too_large(code: &'static str, limit: u64, message: Message) -> Self {
        Self { kind: RefusalKind::TooLarge { limit }, problems: vec![FieldProblem::new("", code, message)] }
    }

    /// A file with other content than its format has.
    pub fn other_content(message: Message) -> Self {
        FieldProblem::new("", code::CANNOT_REPRESENT, message).into()
    }

    /// A file with a map that is larger than a scene can hold.
    pub fn map_too_large(message: Message) -> Self {
        FieldProblem::new("", code::MAP_TOO_LARGE, message).into()
    }

    /// The code that names the whole refusal: that of the first fault.
    pub fn code(&self) -> &'static str {
        self.problems.first().map_or(code::INVALID_FIELD, |p| p.code)
    }

    /// The same refusal for a document that lies at `prefix` (a JSON pointer) of a larger one.
    #[must_use]
    pub fn under(mut self, prefix: &str) -> Self {
        for problem in &mut self.problems {
            problem.pointer.insert_str(0, prefix);
        }
        self
    }
}

impl From<FieldProblem> for ReadError {
    fn from(problem: FieldProblem) -> Self {
        Self::invalid(vec![problem])
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            RefusalKind::MalformedJson { line, column } => write!(f, "line {line}, column {column}: ")?,
            RefusalKind::MalformedFile { offset } => write!(f, "byte {offset}: ")?,
            RefusalKind::TooLarge { .. } | RefusalKind::Invalid => {}
        }
        let Some(first) = self.problems.first() else { return f.write_str("invalid") };
        first.fmt(f)?;
        match self.problems.len() {
            1 => Ok(()),
            n => write!(f, " (and {} more)", n - 1),
        }
    }
}

impl std::error::Error for ReadError {}

/// A change or an omission by a reader that accepted the file.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ImportWarning {
    /// Kind of the change, a code for programs.
    pub code: &'static str,
    /// The change in English.
    pub detail: String,
    /// The change as data.
    pub message: Message,
}

impl ImportWarning {
    /// A warning of this kind, with its sentence.
    pub fn new(code: &'static str, message: Message) -> Self {
        Self { code, detail: message.to_string(), message }
    }
}

/// A scene and what its reader changed or left out.
pub type Imported = (Scene, Vec<ImportWarning>);

/// Faults collected while reading one document.
#[derive(Debug, Default)]
pub(crate) struct Problems(pub Vec<FieldProblem>);

impl Problems {
    /// Adds a fault, unless there are already enough.
    pub fn push(&mut self, problem: FieldProblem) {
        if self.0.len() < MAX_PROBLEMS {
            self.0.push(problem);
        }
    }

    /// Adds an `invalid-field` fault.
    pub fn invalid(&mut self, pointer: impl Into<String>, message: Message) {
        self.push(FieldProblem::new(pointer, code::INVALID_FIELD, message));
    }

    /// Checks the length of a text, in bytes.
    pub fn length(&mut self, pointer: &str, most: usize, text: Option<&String>) {
        if text.is_some_and(|text| text.len() > most) {
            self.invalid(pointer, more_than(most, what::BYTES));
        }
    }

    /// Checks a number against its range; every number outside it, NaN included, is a fault.
    pub fn range(&mut self, pointer: &str, range: (f64, f64), value: f64) -> bool {
        let inside = value >= range.0 && value <= range.1;
        if !inside {
            self.push(FieldProblem::range(pointer, range.0, range.1, value));
        }
        inside
    }
}

/// Refuses a map with more of something than can be read.
pub(crate) fn at_most(count: usize, most: usize, what: Word) -> Result<(), ReadError> {
    if count > most { Err(ReadError::map_too_large(more_than(most, what))) } else { Ok(()) }
}
