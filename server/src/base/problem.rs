//! Refusals: RFC 9457 `application/problem+json` whose codes stand in one table.
//!
//! A handler returns a [`Problem`]; `http::observe` writes it out once the request id and the path are
//! at hand. Clients switch on `code`, which never changes.

pub use super::code::Code;

use super::code::CodeName;
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use experts::GenerateError;
use formats::{FieldProblem, Kind, ReadError};
use schemars::JsonSchema;
use serde::Serialize;

/// What a refusal says beyond its sentence; each member only where it means something.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Members {
    /// All faults that were found in the body or the query.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 32))]
    pub errors: Option<Vec<FieldProblem>>,
    /// The bound that was met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<u64>,
    /// ETag of the scene as it is stored now.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub etag: Option<String>,
    /// When the scene was stored, RFC 3339.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub updated_at: Option<String>,
    /// Seconds after which to ask again, as in Retry-After.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub retry_after_s: Option<u64>,
    /// Byte of the decoded file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub offset: Option<u64>,
    /// What the reader of a file found there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Line of the fault, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// Column of the fault in bytes, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<usize>,
    /// The revision that took over.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_revision: Option<u64>,
    /// The highest revision that the client has sent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub highest_revision: Option<u64>,
    /// What is not ready.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failing: Option<Vec<&'static str>>,
    /// Refinement step at which an expert failed; 0 is the first guess.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    /// Road user that an expert failed for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub agent: Option<String>,
}

/// RFC 9457 problem. Switch on `code`, which never changes.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Problem", transform = formats::never_null)]
pub struct ProblemDoc {
    /// Page about the code, relative to this server.
    #[serde(rename = "type")]
    page: String,
    /// A few words for people, the same for each occurrence.
    title: &'static str,
    /// HTTP status.
    #[schemars(range(min = 400, max = 599))]
    status: u16,
    /// What happened this time.
    detail: String,
    /// The word to switch on.
    code: CodeName,
    /// Address that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    instance: Option<String>,
    /// Id of the request, as in X-Request-Id and in the server's log.
    #[serde(skip_serializing_if = "Option::is_none")]
    request_id: Option<String>,
    #[serde(flatten)]
    members: Members,
}

impl ProblemDoc {
    /// The document as text.
    pub fn text(&self) -> String {
        // Plain members with string keys: serde_json writes those without fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// One refusal.
#[derive(Clone, Debug)]
pub struct Problem {
    /// What sort.
    pub code: Code,
    /// What happened this time; never has paths, queries or stack traces.
    pub detail: String,
    /// Further members, such as `limit` or `errors`.
    pub members: Box<Members>,
    /// Headers that go with it, such as Retry-After.
    pub headers: Vec<(HeaderName, HeaderValue)>,
}

impl Problem {
    /// A refusal with one sentence.
    pub fn new(code: Code, detail: impl Into<String>) -> Self {
        Self { code, detail: detail.into(), members: Box::default(), headers: Vec::new() }
    }

    /// One field's fault.
    pub fn field(pointer: &str, code: Code, detail: impl Into<String>) -> Self {
        let detail = detail.into();
        let error = FieldProblem::new(pointer, code.name(), detail.clone());
        Self::new(code, detail).with(|m| m.errors = Some(vec![error]))
    }

    /// A number outside its range.
    pub fn range(pointer: &str, min: f64, max: f64, got: f64) -> Self {
        let error = FieldProblem::range(pointer, min, max, got);
        Self::new(Code::OutOfRange, error.detail.clone()).with(|m| m.errors = Some(vec![error]))
    }

    /// A defect: the cause goes to the log, the client gets a plain sentence.
    pub fn internal(cause: impl std::fmt::Display) -> Self {
        tracing::error!(%cause, "defect");
        Self::new(Code::Internal, "The server failed; its log says more.")
    }

    /// Sets members.
    #[must_use]
    pub fn with(mut self, set: impl FnOnce(&mut Members)) -> Self {
        set(&mut self.members);
        self
    }

    /// Names the bound that was met.
    #[must_use]
    pub fn limit(self, limit: u64) -> Self {
        self.with(|m| m.limit = Some(limit))
    }

    /// Puts a prefix before the pointers: the problem is about a part of the body.
    #[must_use]
    pub fn under(mut self, prefix: &str) -> Self {
        for error in self.members.errors.iter_mut().flatten() {
            error.pointer.insert_str(0, prefix);
        }
        self
    }

    /// Adds Retry-After in seconds.
    #[must_use]
    pub fn retry_after(mut self, seconds: u64) -> Self {
        self.headers.push((header::RETRY_AFTER, HeaderValue::from(seconds)));
        self.with(|m| m.retry_after_s = Some(seconds))
    }

    /// The object of RFC 9457.
    pub fn doc(&self, instance: Option<&str>, request_id: Option<&str>) -> ProblemDoc {
        ProblemDoc {
            page: format!("/docs/problems#{}", self.code.name()),
            title: self.code.title(),
            status: self.code.status(),
            detail: self.detail.clone(),
            code: CodeName(self.code),
            instance: instance.map(str::to_owned),
            request_id: request_id.map(str::to_owned),
            members: (*self.members).clone(),
        }
    }
}

impl IntoResponse for Problem {
    /// A reply without a body that carries the problem to `http::observe`, which writes it.
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.code.status()).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = status.into_response();
        for (name, value) in &self.headers {
            response.headers_mut().append(name.clone(), value.clone());
        }
        response.extensions_mut().insert(self);
        response
    }
}

impl From<ReadError> for Problem {
    fn from(error: ReadError) -> Self {
        let code = match error.kind {
            Kind::MalformedJson { .. } => Code::MalformedJson,
            Kind::MalformedFile { .. } => Code::MalformedFile,
            _ => Code::from_name(error.code()).unwrap_or(Code::InvalidField),
        };
        let first = error.problems.first();
        let mut detail = first.map_or_else(String::new, |p| match p.pointer.as_str() {
            "" => p.detail.clone(),
            pointer => format!("{pointer}: {}", p.detail),
        });
        match error.kind {
            Kind::MalformedJson { line, column } => {
                detail = format!("line {line}, column {column}: {detail}")
            }
            Kind::MalformedFile { offset } => detail = format!("byte {offset}: {detail}"),
            _ => {}
        }
        if error.problems.len() > 1 {
            detail.push_str(&format!(" (and {} more)", error.problems.len() - 1));
        }
        let problem = Self::new(code, detail);
        match error.kind {
            Kind::MalformedJson { line, column } => {
                problem.with(|m| (m.line, m.column) = (Some(line), Some(column)))
            }
            Kind::MalformedFile { offset } => {
                let reason = error.problems.into_iter().next().map(|p| p.detail).unwrap_or_default();
                problem.with(|m| (m.offset, m.reason) = (Some(offset), Some(reason)))
            }
            Kind::TooLarge { limit } => problem.limit(limit),
            Kind::Invalid => problem.with(|m| m.errors = Some(error.problems)),
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
    use super::{Code, Problem};

    #[test]
    fn body_has_the_members_of_rfc_9457() {
        let doc = Problem::new(Code::Busy, "full").retry_after(3).doc(Some("/v1/generate"), Some("r1"));
        let body: serde_json::Value = serde_json::from_str(&doc.text()).unwrap();
        assert_eq!(body["type"], "/docs/problems#busy");
        assert_eq!(body["status"], 503);
        assert_eq!(body["code"], "busy");
        assert_eq!(body["instance"], "/v1/generate");
        assert_eq!(body["request_id"], "r1");
        assert_eq!(body["retry_after_s"], 3);
        assert!(body.get("errors").is_none());
    }

    #[test]
    fn a_part_of_a_body_is_named_by_its_place() {
        let problem = Problem::range("/time/steps", 1.0, 600.0, 0.0).under("/scene");
        assert_eq!(problem.members.errors.unwrap()[0].pointer, "/scene/time/steps");
    }
}
