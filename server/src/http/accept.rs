//! Negotiates the format of a reply.

use api::{Code, Problem};
use axum::http::{HeaderMap, header};
use headers_accept::Accept;
use mediatype::names::{APPLICATION, EVENT_STREAM, HTML, JSON, TEXT};
use mediatype::{MediaType, Name};
use std::str::FromStr;

/// Format of a reply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReplyFormat {
    /// Only the last event.
    Json,
    /// One event per line.
    Ndjson,
    /// Server-sent events.
    Sse,
}

const X_NDJSON: Name<'static> = Name::new_unchecked("x-ndjson");

/// Preference order for clients that accept any type.
const OFFERED: &[MediaType<'static>] = &[
    MediaType::new(APPLICATION, JSON),
    MediaType::new(APPLICATION, X_NDJSON),
    MediaType::new(TEXT, EVENT_STREAM),
];
const FORMS: [ReplyFormat; 3] = [ReplyFormat::Json, ReplyFormat::Ndjson, ReplyFormat::Sse];

impl ReplyFormat {
    /// Its media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Json => "application/json",
            Self::Ndjson => "application/x-ndjson",
            Self::Sse => "text/event-stream",
        }
    }

    /// The format that Accept prefers; JSON without the header.
    ///
    /// # Errors
    /// `not-acceptable` if it names none of the three.
    pub fn negotiate(headers: &HeaderMap) -> Result<Self, Problem> {
        let Some(accepted) = accepted(headers) else { return Ok(Self::Json) };
        let best = best(&accepted, OFFERED);
        let form = FORMS.into_iter().zip(OFFERED).find(|(_, offered)| best.as_ref() == Some(*offered));
        form.map(|(form, _)| form).ok_or_else(|| {
            let known = FORMS.map(Self::media_type).join(", ");
            Problem::new(Code::NotAcceptable, format!("Replies come as {known}."))
        })
    }
}

/// Whether a caller asks for JSON rather than for a page.
pub fn prefers_json(headers: &HeaderMap) -> bool {
    const JSON_TYPE: MediaType<'static> = MediaType::new(APPLICATION, JSON);
    const OFFERED: &[MediaType<'static>] = &[MediaType::new(TEXT, HTML), JSON_TYPE];
    accepted(headers).is_some_and(|accepted| best(&accepted, OFFERED) == Some(JSON_TYPE))
}

/// The whole Accept header; `None` without one.
fn accepted(headers: &HeaderMap) -> Option<String> {
    let lines = headers.get_all(header::ACCEPT).iter().map(|v| v.to_str().unwrap_or_default());
    let lines: Vec<&str> = lines.collect();
    let is_empty = lines.iter().all(|line| line.trim().is_empty());
    (!is_empty).then(|| without_parameters(&lines.join(",")))
}

/// The best of the offered types for an Accept header, where one is accepted.
fn best(accepted: &str, offered: &'static [MediaType<'static>]) -> Option<MediaType<'static>> {
    Accept::from_str(accepted).ok()?.negotiate(offered).cloned()
}

/// Accept without the parameters of its types but their weight: no reply has any, and each is UTF-8.
fn without_parameters(accept: &str) -> String {
    let plain = |range: &str| {
        let is_weight = |part: &&str| {
            let name = part.split('=').next().unwrap_or_default().trim();
            name.eq_ignore_ascii_case("q")
        };
        let (media_type, parameters) = range.split_once(';').unwrap_or((range, ""));
        std::iter::once(media_type)
            .chain(parameters.split(';').filter(is_weight))
            .collect::<Vec<_>>()
            .join(";")
    };
    accept.split(',').map(plain).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::{FORMS, OFFERED, ReplyFormat};
    use axum::http::{HeaderMap, header};

    fn form(accept: &str) -> Option<ReplyFormat> {
        let mut headers = HeaderMap::new();
        headers.insert(header::ACCEPT, accept.parse().unwrap());
        ReplyFormat::negotiate(&headers).ok()
    }

    #[test]
    fn accept_is_weighed() {
        assert_eq!(form("*/*"), Some(ReplyFormat::Json));
        assert_eq!(form("text/event-stream"), Some(ReplyFormat::Sse));
        assert_eq!(form("application/x-ndjson, application/json;q=0.5"), Some(ReplyFormat::Ndjson));
        assert_eq!(form("text/*"), Some(ReplyFormat::Sse));
        assert_eq!(form("application/json;q=0, */*"), Some(ReplyFormat::Ndjson));
        assert_eq!(form("image/png"), None);
        assert_eq!(form("application/xml, text/html;q=0.9"), None);
        assert_eq!(ReplyFormat::negotiate(&HeaderMap::new()).ok(), Some(ReplyFormat::Json));
        assert_eq!(form("application/json;q=0.2, text/*;q=0.3"), Some(ReplyFormat::Sse));
        assert_eq!(form("APPLICATION/X-NDJSON"), Some(ReplyFormat::Ndjson));
        assert_eq!(form("text/event-stream;q=0"), None);
        assert_eq!(form("nonsense"), None);
        assert_eq!(form(""), Some(ReplyFormat::Json));
        assert_eq!(form("application/json;charset=utf-8"), Some(ReplyFormat::Json));
        assert_eq!(form("application/x-ndjson; Charset=UTF-8; q=0.9, */*;q=0.1"), Some(ReplyFormat::Ndjson));
        assert_eq!(form("application/json; indent=4"), Some(ReplyFormat::Json));
        assert_eq!(
            form("application/json;odata=verbose;q=0.5, text/event-stream;level=1"),
            Some(ReplyFormat::Sse)
        );
        assert_eq!(form("image/png;charset=utf-8"), None);
    }

    #[test]
    fn a_page_is_for_those_who_do_not_ask_for_json() {
        let prefers = |accept: &'static str| {
            super::prefers_json(&HeaderMap::from_iter([(header::ACCEPT, accept.parse().unwrap())]))
        };
        assert!(["application/json", "application/json, */*;q=0.1"].into_iter().all(prefers));
        let browser = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8";
        assert!(!["*/*", browser, "text/html, application/json", "image/png", ""].into_iter().any(prefers));
        assert!(!super::prefers_json(&HeaderMap::new()));
    }

    #[test]
    fn lines_of_a_repeated_header_are_one_list() {
        let mut headers = HeaderMap::new();
        headers.append(header::ACCEPT, "application/json;q=0.1".parse().unwrap());
        headers.append(header::ACCEPT, "text/event-stream".parse().unwrap());
        assert_eq!(ReplyFormat::negotiate(&headers).ok(), Some(ReplyFormat::Sse));
    }

    #[test]
    fn each_form_is_offered_under_its_name() {
        for (form, offered) in FORMS.into_iter().zip(OFFERED) {
            assert_eq!(form.media_type(), offered.to_string());
        }
    }
}
