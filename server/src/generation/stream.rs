//! One sequence of events in three representations: SSE, NDJSON, or the last event alone as JSON.

use super::feed::Reader;
use super::outbox::{End, Message};
use crate::base::problem::Problem;
use crate::http::accept::Form;
use crate::work::{Stop, superseded};
use axum::body::{Body, Bytes};
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use std::convert::Infallible;
use std::time::Duration;

/// Answers with the events of a job.
pub async fn reply(reader: Reader, form: Form, heartbeat: Duration) -> Response {
    match form {
        Form::Json => last(reader).await,
        Form::Ndjson | Form::Sse => first(reader, form, heartbeat).await,
    }
}

/// JSON: the last event, or a problem in its place.
async fn last(reader: Reader) -> Response {
    while let Some(message) = reader.next().await {
        match message.end {
            Some(End::Final) => {
                let head = [(header::CONTENT_TYPE, Form::Json.media_type())];
                return (head, Body::from(message.json)).into_response();
            }
            Some(End::Stopped(Stop::Superseded(by))) => return superseded(by).into_response(),
            Some(End::Stopped(Stop::Problem(problem))) => return problem.into_response(),
            None => {}
        }
    }
    Problem::internal("a job ended without its last event").into_response()
}

/// A stream. What is refused before anything was accepted is an ordinary problem reply; a wait
/// longer than the heartbeat begins the stream in any case.
async fn first(reader: Reader, form: Form, heartbeat: Duration) -> Response {
    let first = tokio::time::timeout(heartbeat, reader.next()).await.ok().flatten();
    if let Some(Message { end: Some(End::Stopped(Stop::Problem(problem))), .. }) = first {
        return problem.into_response();
    }
    let source = Source { reader, form, heartbeat, first, done: false };
    let events = stream::unfold(source, |mut source| async move {
        source.next().await.map(|bytes| (Ok::<_, Infallible>(bytes), source))
    });
    let mut response = Body::from_stream(events).into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(form.media_type()));
    headers.insert("x-accel-buffering", HeaderValue::from_static("no"));
    response
}

struct Source {
    reader: Reader,
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
            None => match tokio::time::timeout(self.heartbeat, self.reader.next()).await {
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
