//! The access log: one line per request, when its reply is complete. The frequent requests of a drag are
//! sampled.

use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, Method, StatusCode};
use base::party::Party;
use hyper::body::{Body as HttpBody, Frame, SizeHint};
use std::pin::Pin;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

/// Routes that receive 60 requests per second while a user drags, or a planner steps.
const SAMPLED: [&str; 2] = ["/v1/generate", "/v1/runs/{id}/step"];
/// Shortest time between two logged successes of these routes.
const SAMPLE: Duration = Duration::from_millis(200);

/// Bytes of a body so far.
#[derive(Clone, Debug, Default)]
pub struct ByteCount(Arc<AtomicU64>);

impl ByteCount {
    fn add(&self, bytes: usize) {
        self.0.fetch_add(bytes as u64, Ordering::Relaxed);
    }

    fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// Position of a request in its caller's trace (W3C Trace Context, `traceparent`).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceParent {
    /// 32 hex digits.
    pub trace_id: String,
    /// Span of the caller, 16 hex digits.
    pub span_id: String,
}

impl TraceParent {
    /// From the headers of a request; `None` if the header is missing or malformed.
    pub fn of(headers: &HeaderMap) -> Option<Self> {
        let mut given = headers.get_all("traceparent").iter();
        let (Some(value), None) = (given.next(), given.next()) else { return None };
        let mut parts = value.to_str().ok()?.split('-');
        let hex = |part: &str, length: usize| {
            let digits = part.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'));
            part.len() == length && digits
        };
        let named = |part: &&str, length| hex(part, length) && part.bytes().any(|digit| digit != b'0');
        let version = parts.next().filter(|part| hex(part, 2) && *part != "ff")?;
        let trace_id = parts.next().filter(|part| named(part, 32))?.to_owned();
        let span_id = parts.next().filter(|part| named(part, 16))?.to_owned();
        parts.next().filter(|part| hex(part, 2))?;
        // Only later versions may have more parts.
        (version != "00" || parts.next().is_none()).then_some(Self { trace_id, span_id })
    }
}

/// Sampler of the successes of sampled routes.
#[derive(Debug, Default)]
pub struct AccessSample(Mutex<(Option<Instant>, u64)>);

impl AccessSample {
    /// Number of omitted requests before this one; `None` if this one is omitted too.
    fn take(&self) -> Option<u64> {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if state.0.is_some_and(|last| last.elapsed() < SAMPLE) {
            state.1 += 1;
            return None;
        }
        state.0 = Some(Instant::now());
        Some(std::mem::take(&mut state.1))
    }
}

/// A line of the access log.
#[derive(Debug)]
pub struct AccessLine {
    /// `None` if the head could not be read.
    pub method: Option<Method>,
    /// Template of the route.
    pub route: String,
    /// Status of the reply.
    pub status: StatusCode,
    /// When the request's head was complete.
    pub began: Instant,
    /// Party of the connection.
    pub peer: Option<Party>,
    /// Name of the token, or of the user that a trusted proxy authenticated.
    pub user: Option<String>,
    /// Trace of the caller.
    pub trace: Option<TraceParent>,
    /// Value of X-Request-Id.
    pub request_id: String,
    /// Bytes of the request's body.
    pub received: ByteCount,
}

impl AccessLine {
    /// Logs the request when this body has been sent, or its reader has left.
    pub fn at_end_of(self, body: Body, sample: Option<Arc<AccessSample>>) -> Body {
        let head_ms = self.began.elapsed().as_secs_f64() * 1e3;
        Body::new(CountingBody { body, bytes: ByteCount::default(), end: Some((self, head_ms, sample)) })
    }

    fn log(&self, ms: f64, sent: u64, sample: Option<&AccessSample>) {
        let sampled = self.status.is_success() && SAMPLED.contains(&self.route.as_str());
        let left_out = match sample.filter(|_| sampled).map(AccessSample::take) {
            Some(None) => return,
            Some(Some(left_out)) => left_out,
            None => 0,
        };
        let trace = self.trace.as_ref();
        tracing::info!(
            target: "access",
            method = self.method.as_ref().map_or("OTHER", Method::as_str),
            route = self.route,
            status = self.status.as_u16(),
            ms,
            sent_ms = self.began.elapsed().as_secs_f64() * 1e3,
            peer = self.peer.map(tracing::field::display),
            user = self.user,
            received = self.received.get(),
            sent,
            request_id = self.request_id,
            trace_id = trace.map(|trace| trace.trace_id.as_str()),
            span_id = trace.map(|trace| trace.span_id.as_str()),
            left_out = (left_out > 0).then_some(left_out),
        );
    }
}

/// A body whose bytes are counted.
pub struct CountingBody {
    body: Body,
    bytes: ByteCount,
    /// The line to log at the end, with the time to the reply's head in milliseconds.
    end: Option<(AccessLine, f64, Option<Arc<AccessSample>>)>,
}

impl CountingBody {
    /// Counts the bytes of a request's body.
    pub fn received(body: Body, bytes: &ByteCount) -> Body {
        Body::new(Self { body, bytes: bytes.clone(), end: None })
    }
}

impl HttpBody for CountingBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let polled = Pin::new(&mut self.body).poll_frame(context);
        if let Poll::Ready(Some(Ok(frame))) = &polled {
            self.bytes.add(frame.data_ref().map_or(0, Bytes::len));
        }
        polled
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for CountingBody {
    fn drop(&mut self) {
        if let Some((line, ms, sample)) = self.end.take() {
            line.log(ms, self.bytes.get(), sample.as_deref());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AccessSample, TraceParent};
    use axum::http::HeaderMap;

    #[test]
    fn trace_parents_are_those_of_the_standard() {
        let of = |value: &str| {
            let mut headers = HeaderMap::new();
            headers.insert("traceparent", value.parse().unwrap());
            TraceParent::of(&headers).map(|trace| (trace.trace_id, trace.span_id))
        };
        let (trace, span) = ("4bf92f3577b34da6a3ce929d0e0e4736", "00f067aa0ba902b7");
        let known = Some((trace.to_owned(), span.to_owned()));
        assert_eq!(of(&format!("00-{trace}-{span}-01")), known);
        assert_eq!(of(&format!("cc-{trace}-{span}-01-later")), known);
        let zeros = "0".repeat(32);
        for wrong in [
            String::new(),
            format!("00-{trace}-{span}"),
            format!("00-{trace}-{span}-01-more"),
            format!("ff-{trace}-{span}-01"),
            format!("00-{zeros}-{span}-01"),
            format!("00-{trace}-{}-01", &zeros[..16]),
            format!("00-{}-{span}-01", trace.to_uppercase()),
            format!("00-{span}-{trace}-01"),
        ] {
            assert_eq!(of(&wrong), None, "{wrong}");
        }
        let mut twice = HeaderMap::new();
        for _ in 0..2 {
            twice.append("traceparent", format!("00-{trace}-{span}-01").parse().unwrap());
        }
        assert_eq!(TraceParent::of(&twice), None);
    }

    #[test]
    fn a_sample_tells_how_many_were_left_out() {
        let sample = AccessSample::default();
        assert_eq!(sample.take(), Some(0));
        assert_eq!([sample.take(), sample.take()], [None, None]);
        std::thread::sleep(super::SAMPLE);
        assert_eq!(sample.take(), Some(2));
    }
}
