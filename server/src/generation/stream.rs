//! One sequence of events in three forms: SSE, NDJSON, or only the last event as JSON.

use super::feed::EventReader;
use super::outbox::{EventMessage, JobEnd};
use crate::http::accept::ReplyFormat;
use api::Problem;
use axum::body::{Body, Bytes};
use axum::http::header;
use axum::response::{IntoResponse, Response};
use base::problem::Refusal;
use futures_util::stream::unfold;
use std::time::Duration;
use work::{Stop, superseded};

/// Timing of a stream.
#[derive(Clone, Copy)]
pub struct StreamPace {
    /// Silence after which a heartbeat is sent.
    pub heartbeat: Duration,
    /// How long the first event waits for the second, so that both are sent and read together.
    pub together: Duration,
}

/// Replies with the events of a job.
pub async fn reply(reader: EventReader, form: ReplyFormat, pace: StreamPace) -> Response {
    match form {
        ReplyFormat::Json => last(reader).await,
        ReplyFormat::Ndjson | ReplyFormat::Sse => stream(reader, form, pace).await,
    }
}

/// JSON: the last event, or a problem instead of it.
async fn last(reader: EventReader) -> Response {
    while let Some(message) = reader.next().await {
        match message.end {
            Some(JobEnd::Final) => {
                let head = [(header::CONTENT_TYPE, ReplyFormat::Json.media_type())];
                return (head, Body::from(message.json)).into_response();
            }
            Some(JobEnd::Stopped(Stop::Superseded(by))) => {
                return Refusal::from(superseded(by)).into_response();
            }
            Some(JobEnd::Stopped(Stop::Problem(problem))) => return Refusal::from(problem).into_response(),
            None => {}
        }
    }
    Refusal::from(Problem::internal("a job ended without its last event")).into_response()
}

/// A stream. A refusal before `accepted` is an ordinary problem reply. A wait longer than the heartbeat
/// starts the stream in any case.
async fn stream(reader: EventReader, form: ReplyFormat, pace: StreamPace) -> Response {
    let within = async |time| tokio::time::timeout(time, reader.next()).await.ok().flatten();
    let first = within(pace.heartbeat).await;
    if let Some(EventMessage { end: Some(JobEnd::Stopped(Stop::Problem(problem))), .. }) = first {
        return Refusal::from(problem).into_response();
    }
    let waits = first.is_some() && !pace.together.is_zero();
    let second = if waits { within(pace.together).await } else { None };
    let begun = first.into_iter().chain(second).collect();
    let source = EventSource { reader, form, heartbeat: pace.heartbeat, begun, done: false };
    form.streamed(unfold(
        source,
        |mut source| async move { source.next().await.map(|bytes| (bytes, source)) },
    ))
}

struct EventSource {
    reader: EventReader,
    form: ReplyFormat,
    heartbeat: Duration,
    /// Events from before the reply's head was sent.
    begun: Vec<EventMessage>,
    done: bool,
}

impl EventSource {
    async fn next(&mut self) -> Option<Bytes> {
        if self.done {
            return None;
        }
        let mut messages = std::mem::take(&mut self.begun);
        if messages.is_empty() {
            match tokio::time::timeout(self.heartbeat, self.reader.next()).await {
                Ok(message) => messages.push(message?),
                Err(_) => return Some(self.form.sign_of_life()),
            }
        }
        self.done = messages.iter().any(|message| message.end.is_some());
        let mut bytes = Vec::with_capacity(messages.iter().map(|message| message.json.len() + 64).sum());
        for EventMessage { event, seq, json, .. } in &messages {
            self.form.write(event, seq, json, &mut bytes);
        }
        Some(bytes.into())
    }
}
