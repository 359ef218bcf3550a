//! Events as a streamed reply: server-sent events or NDJSON.

use super::accept::ReplyFormat;
use axum::body::{Body, Bytes};
use axum::http::{HeaderValue, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream::{Stream, StreamExt};
use std::convert::Infallible;
use std::fmt::Display;

impl ReplyFormat {
    /// The heartbeat of a silent stream.
    pub fn sign_of_life(self) -> Bytes {
        match self {
            Self::Sse => Bytes::from_static(b": heartbeat\n\n"),
            Self::Ndjson | Self::Json => Bytes::from_static(b"{\"event\":\"heartbeat\"}\n"),
        }
    }

    /// Writes one event. Its JSON contains the name too, for NDJSON.
    pub fn write(self, name: &str, id: impl Display, json: &[u8], bytes: &mut Vec<u8>) {
        if self == Self::Sse {
            bytes.extend_from_slice(format!("event: {name}\nid: {id}\ndata: ").as_bytes());
        }
        bytes.extend_from_slice(json);
        bytes.extend_from_slice(if self == Self::Sse { b"\n\n" } else { b"\n" });
    }

    /// The reply for a stream of written events.
    pub fn streamed(self, events: impl Stream<Item = Bytes> + Send + 'static) -> Response {
        let mut response = Body::from_stream(events.map(Ok::<_, Infallible>)).into_response();
        let headers = response.headers_mut();
        headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(self.media_type()));
        headers.insert("x-accel-buffering", HeaderValue::from_static("no"));
        response
    }
}
