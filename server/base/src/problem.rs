//! Refusals over HTTP: RFC 9457 `application/problem+json`.
//!
//! A handler ends with a [`Refusal`]; `http::observe` writes it once the request id and the path are known.

use super::base_path;
pub use super::status::{code_of, status_of};

use api::code::CodeName;
use api::problem::ProblemMembers;
use api::{Code, Problem};
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use schemars::JsonSchema;
use serde::Serialize;
use std::time::Duration;

/// RFC 9457 problem. Programs switch on `code`, which never changes.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Problem", transform = formats::never_null)]
pub struct ProblemDoc {
    /// Page about the code, relative to this server.
    #[serde(rename = "type")]
    page: String,
    /// Short title, the same for each occurrence.
    title: &'static str,
    /// HTTP status.
    #[schemars(range(min = 400, max = 599))]
    status: u16,
    /// Explanation of this occurrence.
    detail: String,
    /// Code for programs.
    code: CodeName,
    /// Requested address.
    #[serde(skip_serializing_if = "Option::is_none")]
    instance: Option<String>,
    /// Id of the request, as in X-Request-Id and in the server's log.
    #[serde(skip_serializing_if = "Option::is_none")]
    request_id: Option<String>,
    #[serde(flatten)]
    members: ProblemMembers,
}

impl ProblemDoc {
    /// The document of a problem at an address, in a request.
    pub fn of(problem: &Problem, instance: Option<&str>, request_id: Option<&str>) -> Self {
        Self {
            page: base_path::published(&format!("/docs/problems#{}", problem.code.name())),
            title: problem.code.title(),
            status: status_of(problem.code),
            detail: problem.detail.clone(),
            code: CodeName(problem.code),
            instance: instance.map(base_path::published),
            request_id: request_id.map(str::to_owned),
            members: (*problem.members).clone(),
        }
    }

    /// The document as text.
    pub fn text(&self) -> String {
        // It has plain members with string keys, which serde_json always writes.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// Logs the cause of a defect, once.
pub fn logged(mut problem: Problem) -> Problem {
    if let Some(cause) = problem.cause.take() {
        tracing::error!(%cause, "defect");
    }
    problem
}

/// A problem that ends a request.
#[derive(Clone, Debug)]
pub struct Refusal(pub Problem);

impl From<Problem> for Refusal {
    fn from(problem: Problem) -> Self {
        Self(logged(problem))
    }
}

impl Refusal {
    /// Subtracts the time for which a reply was held back from the time that its client is asked to wait.
    pub fn hold(response: &mut Response, time: Duration) {
        let Some(Self(problem)) = response.extensions_mut().get_mut::<Self>() else { return };
        let Some(asked_ms) = problem.members.retry_after_ms else { return };
        let left_ms = asked_ms.saturating_sub(time.as_millis() as u64).max(1);
        *problem = problem.clone().retry_after_ms(left_ms);
        let headers = Self(problem.clone()).headers();
        headers.into_iter().for_each(|(name, value)| drop(response.headers_mut().insert(name, value)));
    }

    /// Headers for the problem.
    fn headers(&self) -> Vec<(HeaderName, HeaderValue)> {
        let Self(problem) = self;
        let text = |name: &str| problem.facts.get(name).and_then(|value| HeaderValue::from_str(value).ok());
        let by_code = match problem.code {
            Code::Unauthorized => Some((header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"))),
            Code::UpgradeRequired => Some((header::UPGRADE, HeaderValue::from_static("websocket"))),
            _ => None,
        };
        let seconds = problem.members.retry_after_s.map(HeaderValue::from);
        let given = [
            (header::RETRY_AFTER, seconds),
            (header::ALLOW, text(ALLOWED)),
            (header::ACCEPT_ENCODING, text(ENCODINGS)),
        ];
        by_code
            .into_iter()
            .chain(given.into_iter().filter_map(|(name, value)| Some((name, value?))))
            .collect()
    }
}

/// Fact of a problem: the allowed methods, in the form of the header Allow.
pub const ALLOWED: &str = "allowed";
/// Fact of a problem: the accepted encodings, in the form of the header Accept-Encoding.
pub const ENCODINGS: &str = "encodings";

impl IntoResponse for Refusal {
    /// A reply without a body that carries the problem to `http::observe`, which writes it.
    fn into_response(self) -> Response {
        let status =
            StatusCode::from_u16(status_of(self.0.code)).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let mut response = status.into_response();
        response.headers_mut().extend(self.headers());
        response.extensions_mut().insert(self);
        response
    }
}

#[cfg(test)]
mod tests {
    use super::{ProblemDoc, Refusal};
    use api::{Code, Problem};
    use axum::response::IntoResponse;
    use std::time::Duration;

    #[test]
    fn body_has_the_members_of_rfc_9457() {
        let problem = Problem::new(Code::Busy, "full").retry_after(3);
        let doc = ProblemDoc::of(&problem, Some("/v1/generate"), Some("r1"));
        let body: serde_json::Value = serde_json::from_str(&doc.text()).unwrap();
        assert_eq!(body["type"], "/docs/problems#busy");
        assert_eq!(body["status"], 503);
        assert_eq!(body["code"], "busy");
        assert_eq!(body["instance"], "/v1/generate");
        assert_eq!(body["request_id"], "r1");
        assert_eq!((&body["retry_after_s"], &body["retry_after_ms"]), (&3.into(), &3_000.into()));
        let soon = ProblemDoc::of(&Problem::new(Code::Busy, "full").retry_after_ms(120), None, None);
        let soon: serde_json::Value = serde_json::from_str(&soon.text()).unwrap();
        assert_eq!((&soon["retry_after_s"], &soon["retry_after_ms"]), (&1.into(), &120.into()));
        assert!(body.get("errors").is_none());
    }

    #[test]
    fn the_time_of_a_held_reply_is_part_of_the_wait() {
        let told = |asked_ms: u64| {
            let mut reply =
                Refusal(Problem::new(Code::Busy, "full").retry_after_ms(asked_ms)).into_response();
            Refusal::hold(&mut reply, Duration::from_millis(100));
            let left = reply.extensions().get::<Refusal>().and_then(|held| held.0.members.retry_after_ms);
            (left, reply.headers()["retry-after"].to_str().unwrap().to_owned())
        };
        assert_eq!(told(2_050), (Some(1_950), "2".to_owned()));
        assert_eq!(told(30), (Some(1), "1".to_owned()));
    }

    #[test]
    fn headers_follow_from_code_and_values() {
        let header = |problem: Problem, name: &str| {
            let reply = Refusal::from(problem).into_response();
            reply.headers().get(name).and_then(|value| value.to_str().ok()).map(str::to_owned)
        };
        let busy = Problem::new(Code::Busy, "full").retry_after(3);
        assert_eq!(header(busy, "retry-after").as_deref(), Some("3"));
        let unauthorized = Problem::new(Code::Unauthorized, "no");
        assert_eq!(header(unauthorized, "www-authenticate").as_deref(), Some("Bearer"));
        let method = Problem::new(Code::MethodNotAllowed, "no").fact(super::ALLOWED, "GET, HEAD");
        assert_eq!(header(method, "allow").as_deref(), Some("GET, HEAD"));
        assert_eq!(header(Problem::new(Code::NotFound, "no"), "retry-after"), None);
    }
}
