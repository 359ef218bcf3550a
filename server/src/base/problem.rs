//! Refusals: RFC 9457 `application/problem+json` with one table of codes.
//!
//! A handler returns a [`Problem`]; `http::observe` writes it out once the request id and the path are
//! at hand. Clients switch on `code`, which never changes.

use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use experts::GenerateError;
use formats::{FieldProblem, Kind, ReadError};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};
use std::borrow::Cow;

macro_rules! codes {
    ($($variant:ident $name:literal $status:literal $title:literal $when:literal;)*) => {
        /// Every code that a refusal can carry.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "the table says it")]
        pub enum Code { $($variant,)* }

        impl Code {
            /// All codes in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The word clients switch on.
            pub fn name(self) -> &'static str { match self { $(Self::$variant => $name,)* } }

            /// HTTP status.
            pub fn status(self) -> u16 { match self { $(Self::$variant => $status,)* } }

            /// A few words for people, the same for each occurrence.
            pub fn title(self) -> &'static str { match self { $(Self::$variant => $title,)* } }

            /// When it is given and what to do about it.
            pub fn when(self) -> &'static str { match self { $(Self::$variant => $when,)* } }
        }
    };
}

codes! {
    MalformedJson "malformed-json" 400 "Not JSON" "The body is not JSON. Line and column of the fault are given; NaN, Infinity and numbers beyond f64 are not JSON.";
    MalformedFile "malformed-file" 400 "Broken file" "The uploaded file is broken at byte `offset` of its decoded form.";
    BadHeader "bad-header" 400 "Unusable header" "A header of the request cannot be read.";
    BadHost "bad-host" 400 "Host missing or given twice" "A request needs exactly one Host header.";
    Unauthorized "unauthorized" 401 "Token needed" "This server was started with a token; send it as `Authorization: Bearer`.";
    BadOrigin "bad-origin" 403 "Origin not allowed" "The Origin is neither this server's nor one given with --allow-origin.";
    CrossSite "cross-site" 403 "Request from another site" "A browser sent this on behalf of another site.";
    ReadOnly "read-only" 403 "Scene is read-only" "Demo scenes and those of the data folder cannot be changed; duplicate the scene and change the copy.";
    NotFound "not-found" 404 "Not found" "Nothing has this address or id.";
    MethodNotAllowed "method-not-allowed" 405 "Method not allowed" "The Allow header lists the methods that this address knows.";
    NotAcceptable "not-acceptable" 406 "No acceptable representation" "None of the media types in Accept can be given.";
    BodyTimeout "body-timeout" 408 "Body too slow" "The body did not arrive in time.";
    Exists "exists" 409 "Exists already" "Something with this id exists already.";
    Superseded "superseded" 409 "Overtaken by a newer revision" "The same client sent a newer revision; `by_revision` names it.";
    StaleRevision "stale-revision" 409 "Revision not newer" "The revision is not above the highest that this client has sent.";
    Cancelled "cancelled" 409 "Cancelled" "The job was cancelled by its id, or its reader left.";
    StaleEtag "stale-etag" 412 "Changed in the meantime" "The stored scene is another than the one the precondition names; its current `etag` is given.";
    BodyTooLarge "body-too-large" 413 "Body too large" "The body is larger than `limit` bytes.";
    DecodedTooLarge "decoded-too-large" 413 "Decoded body too large" "The body decodes to more than `limit` bytes.";
    ExpansionTooHigh "expansion-too-high" 413 "Expands too much" "The body grows by more than `limit` when decoded.";
    UriTooLong "uri-too-long" 414 "Address too long" "The address is longer than `limit` bytes.";
    UnsupportedMediaType "unsupported-media-type" 415 "Media type not supported" "This address does not take this Content-Type or Content-Encoding.";
    HostNotAllowed "host-not-allowed" 421 "Host not served here" "The Host is not this machine's own name; --allow-host adds one. This guards against DNS rebinding.";
    InvalidField "invalid-field" 422 "Field not valid" "A field has the wrong type or form, is unknown, missing or given twice; `errors` lists all faults found.";
    OutOfRange "out-of-range" 422 "Number out of range" "A number lies outside what its field can hold; `errors` gives the bounds.";
    HalfPosition "half-position" 422 "Half a position" "`x_m` and `y_m` are fixed together or not at all.";
    StartMissing "start-missing" 422 "Start unknown" "A start field is free and neither the log nor a default fills it.";
    UnknownAgent "unknown-agent" 422 "No such road user" "An id names no road user of the scene.";
    UnknownMap "unknown-map" 422 "Map not known here" "No map with this hash is known to the server; send the map inline.";
    TooManyAgents "too-many-agents" 422 "Too many road users" "More road users than a scene may hold or a call may regenerate.";
    MapTooLarge "map-too-large" 422 "Map too large" "The map has more lines, points or signals than a scene may hold.";
    ReplyTooLarge "reply-too-large" 422 "Reply would be too large" "samples x modes x road users x steps is above `limit`.";
    UnsupportedVersion "unsupported-version" 422 "Newer version" "The document was written by a newer version of the format.";
    FormatUnknown "format-unknown" 422 "Format not recognised" "The file is in no format this server reads, or no format has this name.";
    CannotRepresent "cannot-represent" 422 "Format cannot hold this" "The format has no place for something that the scene cannot do without.";
    LicenceRefused "licence-refused" 422 "Licence refused" "This server was started with --refuse-nc and the source is for non-commercial use only.";
    PreconditionRequired "precondition-required" 428 "Precondition needed" "Send If-Match with the ETag last read (or If-None-Match: * to create), so that no change is lost.";
    HeadersTooLarge "headers-too-large" 431 "Headers too large" "The request has more than `limit` header fields or bytes.";
    Internal "internal" 500 "Defect of the server" "A defect of the program. The log has more under the request id.";
    NonFiniteOutput "non-finite-output" 500 "Expert gave no number" "An expert gave NaN or Infinity; `step` and `agent` say where. Nothing of it is sent.";
    Busy "busy" 503 "Busy" "The queue is full. Retry-After says when to ask again.";
    NotReady "not-ready" 503 "Not ready" "`failing` lists what is not ready.";
    ShuttingDown "shutting-down" 503 "Shutting down" "The server is about to stop.";
    GenerateTimeout "generate-timeout" 504 "Took too long" "The work took longer than `limit` seconds.";
    StoreFull "store-full" 507 "Store is full" "The store holds as many scenes or bytes as it may.";
}

impl Code {
    /// The code of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|code| code.name() == name)
    }

    /// The code that stands for a bare status of the HTTP layers below.
    pub fn from_status(status: StatusCode) -> Self {
        match status.as_u16() {
            401 => Self::Unauthorized,
            403 => Self::BadOrigin,
            404 => Self::NotFound,
            405 => Self::MethodNotAllowed,
            406 => Self::NotAcceptable,
            408 => Self::BodyTimeout,
            412 => Self::StaleEtag,
            413 => Self::BodyTooLarge,
            414 => Self::UriTooLong,
            415 => Self::UnsupportedMediaType,
            422 => Self::InvalidField,
            431 => Self::HeadersTooLarge,
            503 => Self::Busy,
            400..=499 => Self::BadHeader,
            _ => Self::Internal,
        }
    }
}

/// The word of a [`Code`], as JSON has it.
#[derive(Clone, Copy, Debug)]
pub struct CodeName(Code);

impl Serialize for CodeName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl JsonSchema for CodeName {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Code".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = Code::ALL.iter().map(|code| code.name()).collect();
        json_schema!({"type": "string", "enum": names})
    }
}

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
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Code, Problem};

    #[test]
    fn codes_are_unique_and_found_by_name() {
        for code in Code::ALL {
            assert_eq!(Code::from_name(code.name()), Some(*code));
            assert!((400..600).contains(&code.status()), "{}", code.name());
            assert!(!code.title().is_empty() && !code.when().is_empty());
        }
    }

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
