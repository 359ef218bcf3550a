//! One sequence of events in three representations: SSE, NDJSON, or the last event alone as JSON.

use crate::base::problem::{Code, Problem};
use crate::work::{End, Handle, Message};
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use std::convert::Infallible;
use std::time::Duration;

/// How a reply is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The last event.
    Json,
    /// One event a line.
    Ndjson,
    /// Server-sent events.
    Sse,
}

const FORMS: [(Form, &str); 3] = [
    (Form::Json, "application/json"),
    (Form::Ndjson, "application/x-ndjson"),
    (Form::Sse, "text/event-stream"),
];

impl Form {
    /// The form that Accept likes best; JSON without one.
    ///
    /// # Errors
    /// `not-acceptable` when it names none of the three.
    pub fn negotiate(headers: &HeaderMap) -> Result<Self, Problem> {
        let given: Vec<&str> =
            headers.get_all(header::ACCEPT).iter().map(|v| v.to_str().unwrap_or_default()).collect();
        if given.is_empty() {
            return Ok(Self::Json);
        }
        let quality =
            |form: &(Form, &str)| given.iter().map(|list| quality(list, form.1)).fold(0.0, f64::max);
        let best =
            FORMS.iter().map(|form| (form.0, quality(form))).reduce(|a, b| if b.1 > a.1 { b } else { a });
        match best {
            Some((form, quality)) if quality > 0.0 => Ok(form),
            _ => {
                let known = FORMS.map(|f| f.1).join(", ");
                Err(Problem::new(Code::NotAcceptable, format!("Replies come as {known}.")))
            }
        }
    }
}

/// Quality that an Accept list gives a media type: the most specific range decides.
pub fn quality(list: &str, media_type: &str) -> f64 {
    let family = media_type.split('/').next().unwrap_or_default();
    let mut best = (0, 0.0);
    for range in list.split(',') {
        let mut parts = range.split(';').map(str::trim);
        let name = parts.next().unwrap_or_default().to_ascii_lowercase();
        let weight = match name.as_str() {
            "*/*" => 1,
            n if n == media_type => 3,
            n if n.strip_suffix("/*") == Some(family) => 2,
            _ => 0,
        };
        let q = parts.find_map(|p| p.strip_prefix("q=")).map_or(1.0, |q| q.parse().unwrap_or(0.0));
        if weight > best.0 {
            best = (weight, q);
        }
    }
    best.1
}

/// Answers with the events of a job.
pub async fn reply(handle: Handle, form: Form, heartbeat: Duration) -> Response {
    match form {
        Form::Json => last(handle).await,
        Form::Ndjson | Form::Sse => first(handle, form, heartbeat).await,
    }
}

/// JSON: the last event, or a problem in its place.
async fn last(handle: Handle) -> Response {
    while let Some(message) = handle.next().await {
        match message.end {
            Some(End::Final) => {
                return ([(header::CONTENT_TYPE, "application/json")], Body::from(message.json))
                    .into_response();
            }
            Some(End::Superseded(by)) => {
                let detail = format!("Revision {by} of the same client took over.");
                return Problem::new(Code::Superseded, detail).with("by_revision", by).into_response();
            }
            Some(End::Problem(problem)) => return problem.into_response(),
            None => {}
        }
    }
    Problem::internal("a job ended without its last event").into_response()
}

/// A stream. What is refused before anything was accepted is an ordinary problem reply; a wait
/// longer than the heartbeat begins the stream in any case.
async fn first(handle: Handle, form: Form, heartbeat: Duration) -> Response {
    let first = tokio::time::timeout(heartbeat, handle.next()).await.ok().flatten();
    if let Some(Message { end: Some(End::Problem(problem)), .. }) = first {
        return problem.into_response();
    }
    let source = Source { handle, form, heartbeat, first, done: false };
    let events = stream::unfold(source, |mut source| async move {
        source.next().await.map(|bytes| (Ok::<_, Infallible>(bytes), source))
    });
    let media_type = match form {
        Form::Sse => "text/event-stream",
        _ => "application/x-ndjson",
    };
    let mut response = Body::from_stream(events).into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(media_type));
    headers.insert("x-accel-buffering", HeaderValue::from_static("no"));
    headers.insert(header::CONNECTION, HeaderValue::from_static("close"));
    response
}

struct Source {
    handle: Handle,
    form: Form,
    heartbeat: Duration,
    first: Option<Message>,
    done: bool,
}

impl Source {
    async fn next(&mut self) -> Option<Bytes> {
        if self.done {
            return None;
        }
        let message = match self.first.take() {
            Some(message) => message,
            None => match tokio::time::timeout(self.heartbeat, self.handle.next()).await {
                Ok(message) => message?,
                Err(_) => return Some(self.sign_of_life()),
            },
        };
        self.done = message.end.is_some();
        Some(self.written(&message))
    }

    fn sign_of_life(&self) -> Bytes {
        match self.form {
            Form::Sse => Bytes::from_static(b": heartbeat\n\n"),
            _ => Bytes::from_static(b"{\"event\":\"heartbeat\"}\n"),
        }
    }

    fn written(&self, message: &Message) -> Bytes {
        let mut bytes = Vec::with_capacity(message.json.len() + 64);
        if self.form == Form::Sse {
            bytes.extend_from_slice(
                format!("event: {}\nid: {}\ndata: ", message.event, message.seq).as_bytes(),
            );
        }
        bytes.extend_from_slice(&message.json);
        bytes.extend_from_slice(if self.form == Form::Sse { b"\n\n" } else { b"\n" });
        bytes.into()
    }
}

#[cfg(test)]
mod tests {
    use super::{Form, quality};
    use axum::http::{HeaderMap, header};

    fn form(accept: &str) -> Option<Form> {
        let mut headers = HeaderMap::new();
        headers.insert(header::ACCEPT, accept.parse().unwrap());
        Form::negotiate(&headers).ok()
    }

    #[test]
    fn accept_is_weighed() {
        assert_eq!(form("*/*"), Some(Form::Json));
        assert_eq!(form("text/event-stream"), Some(Form::Sse));
        assert_eq!(form("application/x-ndjson, application/json;q=0.5"), Some(Form::Ndjson));
        assert_eq!(form("text/*"), Some(Form::Sse));
        assert_eq!(form("application/json;q=0, */*"), Some(Form::Ndjson));
        assert_eq!(form("image/png"), None);
        assert_eq!(form("application/xml, text/html;q=0.9"), None);
        assert_eq!(Form::negotiate(&HeaderMap::new()).ok(), Some(Form::Json));
        assert!(quality("text/*;q=0.3", "text/event-stream") > 0.2);
    }
}
