//! Refusals as values: a code from one table, a description, and the place.
//!
//! A transport writes them in its own form: HTTP as RFC 9457, the command line as a sentence with an exit
//! code. Programs switch on `code`, which never changes.

use crate::code::Code;
use crate::english;
use experts::GenerateError;
use formats::{FieldProblem, ReadError, RefusalKind};
use scene::message::Message;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Members of a refusal beyond its code; each is present only where it applies.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct ProblemMembers {
    /// `detail` as data.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<Message>,
    /// All faults found in the body or the query.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 32))]
    pub errors: Option<Vec<FieldProblem>>,
    /// The limit that caused the refusal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<u64>,
    /// ETag of the stored scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub etag: Option<String>,
    /// Time at which the scene was stored, RFC 3339.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub updated_at: Option<String>,
    /// Time to wait before the next attempt, seconds, as in Retry-After.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub retry_after_s: Option<u64>,
    /// The same time in milliseconds, more precise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub retry_after_ms: Option<u64>,
    /// Offset in the decoded file, bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<u64>,
    /// Fault that the reader of a file found there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Line of the fault, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Column of the fault in bytes, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// The newer revision that replaced this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_revision: Option<u64>,
    /// The highest revision that the client has sent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub highest_revision: Option<u64>,
    /// Components that are not ready.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failing: Option<Vec<&'static str>>,
    /// Refinement step at which an expert failed; 0 is the initial draft.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    /// Road user for which an expert failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agent: Option<String>,
}

/// One refusal.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Code of the refusal.
    pub code: Code,
    /// What happened this time, in English; it never contains paths, queries or stack traces.
    pub detail: String,
    /// Other members, such as `limit` or `errors`.
    pub members: Box<ProblemMembers>,
    /// Facts that a transport needs besides the document, by name, such as the methods of an address.
    pub facts: BTreeMap<&'static str, String>,
    /// Cause of a defect for the log, not for the caller.
    pub cause: Option<String>,
}

impl Problem {
    /// A refusal with one sentence.
    pub fn new(code: Code, detail: impl Into<String>) -> Self {
        Self { code, detail: detail.into(), members: Box::default(), facts: BTreeMap::new(), cause: None }
    }

    /// A refusal with a sentence as data.
    pub fn of(code: Code, message: Message) -> Self {
        Self::new(code, message.to_string()).with(|m| m.message = Some(message))
    }

    /// The fault of one field.
    pub fn field(pointer: &str, code: Code, detail: impl Into<String>) -> Self {
        Self::new(code, detail).at(pointer)
    }

    /// A number outside its range.
    pub fn range(pointer: &str, min: f64, max: f64, got: f64) -> Self {
        let error = FieldProblem::range(pointer, min, max, got);
        let message = error.message.as_deref().cloned();
        Self::new(Code::OutOfRange, error.detail.clone())
            .with(|m| (m.message, m.errors) = (message, Some(vec![error])))
    }

    /// A defect: the log gets the cause, the caller a general sentence.
    pub fn internal(cause: impl std::fmt::Display) -> Self {
        Self { cause: Some(cause.to_string()), ..Self::of(Code::Internal, english::defect()) }
    }

    /// Attributes the refusal to one field.
    #[must_use]
    pub fn at(self, pointer: &str) -> Self {
        let error = self.as_fault(pointer);
        self.with(|m| m.errors = Some(vec![error]))
    }

    /// The refusal as the fault of a field.
    pub fn as_fault(&self, pointer: impl Into<String>) -> FieldProblem {
        FieldProblem {
            pointer: pointer.into(),
            code: self.code.name(),
            detail: self.detail.clone(),
            min: None,
            max: None,
            got: None,
            message: self.members.message.clone().map(Box::new),
        }
    }

    /// Sets members.
    #[must_use]
    pub fn with(mut self, set: impl FnOnce(&mut ProblemMembers)) -> Self {
        set(&mut self.members);
        self
    }

    /// Adds a fact for the carrier.
    #[must_use]
    pub fn fact(mut self, name: &'static str, fact: impl Into<String>) -> Self {
        self.facts.insert(name, fact.into());
        self
    }

    /// Adds the limit that was reached.
    #[must_use]
    pub fn limit(self, limit: u64) -> Self {
        self.with(|m| m.limit = Some(limit))
    }

    /// Seconds after which to ask again.
    #[must_use]
    pub fn retry_after(self, seconds: u64) -> Self {
        self.retry_after_ms(1_000 * seconds)
    }

    /// Adds the milliseconds after which to retry; the header has whole seconds.
    #[must_use]
    pub fn retry_after_ms(self, milliseconds: u64) -> Self {
        self.with(|m| {
            m.retry_after_s = Some(milliseconds.div_ceil(1_000));
            m.retry_after_ms = Some(milliseconds);
        })
    }

    /// Prefixes the pointers, for a problem in a part of the body.
    #[must_use]
    pub fn under(mut self, prefix: &str) -> Self {
        for error in self.members.errors.iter_mut().flatten() {
            error.pointer.insert_str(0, prefix);
        }
        self
    }
}

/// Refuses if there are faults.
///
/// # Errors
/// All of them, at most [`formats::problem::MAX_PROBLEMS`].
pub fn refuse(faults: Vec<FieldProblem>) -> Result<(), Problem> {
    if faults.is_empty() { Ok(()) } else { Err(ReadError::invalid(faults).into()) }
}

/// The fault of an id that no road user of the scene has.
pub fn unknown_agent(pointer: String, id: &str) -> FieldProblem {
    let message = english::unknown_agent(&shortened(id));
    FieldProblem::new(pointer, formats::problem::code::UNKNOWN_AGENT, message)
}

/// An id shortened for a message: outside data may be long.
pub(crate) fn shortened(id: &str) -> String {
    id.chars().take(64).collect()
}

impl From<ReadError> for Problem {
    fn from(error: ReadError) -> Self {
        let code = match error.kind {
            RefusalKind::MalformedJson { .. } => Code::MalformedJson,
            RefusalKind::MalformedFile { .. } => Code::MalformedFile,
            _ => Code::from_name(error.code()).unwrap_or(Code::InvalidField),
        };
        let first = error.problems.first();
        let mut detail = first.map_or_else(String::new, |p| match p.pointer.as_str() {
            "" => p.detail.clone(),
            pointer => format!("{pointer}: {}", p.detail),
        });
        match error.kind {
            RefusalKind::MalformedJson { line, column } => {
                detail = format!("line {line}, column {column}: {detail}")
            }
            RefusalKind::MalformedFile { offset } => detail = format!("byte {offset}: {detail}"),
            _ => {}
        }
        if error.problems.len() > 1 {
            detail.push_str(&format!(" (and {} more)", error.problems.len() - 1));
        }
        let message = first.and_then(|p| p.message.as_deref().cloned());
        let problem = Self::new(code, detail).with(|m| m.message = message);
        match error.kind {
            RefusalKind::MalformedJson { line, column } => {
                problem.with(|m| (m.line, m.column) = (Some(line), Some(column)))
            }
            RefusalKind::MalformedFile { offset } => {
                let reason = error.problems.into_iter().next().map(|p| p.detail).unwrap_or_default();
                problem.with(|m| (m.offset, m.reason) = (Some(offset), Some(reason)))
            }
            RefusalKind::TooLarge { limit } => problem.limit(limit),
            RefusalKind::Invalid => problem.with(|m| m.errors = Some(error.problems)),
        }
    }
}

impl From<GenerateError> for Problem {
    fn from(error: GenerateError) -> Self {
        let detail = error.to_string();
        match error {
            GenerateError::UnknownAgent(_) => Self::field("/agents", Code::UnknownAgent, detail),
            GenerateError::UnknownArm { .. } => Self::field("/arrivals", Code::InvalidField, detail),
            GenerateError::StartMissing { agent, field } => {
                let pointer = format!("/conditions/{}/start/{field}", formats::pointer_token(&agent));
                Self::field(&pointer, Code::StartMissing, detail)
            }
            GenerateError::TooManyAgents { most, .. } => {
                Self::field("/agents", Code::TooManyAgents, detail).limit(most as u64)
            }
            GenerateError::NonFinite { step, agent } => Self::new(Code::NonFiniteOutput, detail)
                .with(|m| (m.step, m.agent) = (Some(step), Some(agent))),
            GenerateError::Cancelled => Self::new(Code::Cancelled, detail),
            GenerateError::Expert(cause) => Self::internal(cause),
            GenerateError::NoWindow => Self::internal(detail),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Problem;

    #[test]
    fn a_part_of_a_body_is_named_by_its_place() {
        let problem = Problem::range("/time/steps", 1.0, 600.0, 0.0).under("/scene");
        assert_eq!(problem.members.errors.unwrap()[0].pointer, "/scene/time/steps");
    }

    #[test]
    fn the_cause_of_a_defect_stays_out_of_what_the_caller_reads() {
        let problem = Problem::internal("disk 7 is gone");
        assert!(!problem.detail.contains("disk"), "{}", problem.detail);
        assert_eq!(problem.cause.as_deref(), Some("disk 7 is gone"));
    }
}
