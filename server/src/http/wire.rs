//! The socket as hyper sees it, and the refusals of heads that never reach a service.
//!
//! hyper itself answers a head that it cannot parse, with only a status. [`Wire`] holds such an answer back;
//! [`refuse`] sends a problem document instead, as for every other refusal.

use super::stream::ByteStream;
use api::{Code, Problem};
use axum::http::header;
use axum::response::Response;
use base::limits::Limits;
use futures_util::FutureExt;
use http_body_util::BodyExt;
use jiff::fmt::rfc2822::DateTimePrinter;
use std::io::{self, IoSlice};
use std::pin::Pin;
use std::sync::atomic::{AtomicU16, AtomicUsize, Ordering};
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, Interest, ReadBuf};

/// Most bytes of hyper's own answer: status line, Connection, Content-Length and Date.
const BARE_ANSWER: usize = 192;
/// Most bytes that a refused client may still send while it receives the answer.
const REST_OF_HEAD: usize = 1 << 20;
/// Time for a refused client to take the reply and close the connection.
pub const PARTING: Duration = Duration::from_secs(2);

/// Socket of a connection, with its state.
pub struct Socket {
    stream: ByteStream,
    /// Number of requests in progress.
    pub requests: AtomicUsize,
    /// Status of hyper's own answer that was held back; 0 without one.
    held_back: AtomicU16,
}

impl Socket {
    /// The socket of an accepted connection.
    pub fn new(stream: ByteStream) -> Self {
        Self { stream, requests: AtomicUsize::new(0), held_back: AtomicU16::new(0) }
    }

    /// The connection itself.
    pub fn stream(&self) -> &ByteStream {
        &self.stream
    }

    /// Whether the client has closed its side, even with unread bytes before that.
    pub fn is_left(&self) -> bool {
        let ready = self.stream.ready(Interest::READABLE).now_or_never();
        ready.is_some_and(|ready| ready.map_or(true, |ready| ready.is_read_closed()))
    }

    /// Whether bytes of the client are unread.
    pub fn has_unread(&self) -> bool {
        self.stream.has_unread()
    }

    /// After the last reply: reads what the client still sends, so that it gets the reply and no reset.
    pub async fn part(&self) {
        shut(&self.stream);
        let _ = tokio::time::timeout(PARTING, self.drain()).await;
    }

    /// Shuts down both directions, for all owners.
    pub fn end(&self) {
        self.stream.shutdown(std::net::Shutdown::Both);
    }

    async fn send(&self, mut bytes: &[u8]) -> io::Result<()> {
        while !bytes.is_empty() {
            self.stream.writable().await?;
            match self.stream.try_write(bytes) {
                Ok(count) => bytes = bytes.get(count..).unwrap_or_default(),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Reads remaining bytes, because closing with unread bytes would reset the connection.
    async fn drain(&self) -> io::Result<()> {
        let (mut chunk, mut left) = ([0; 4 << 10], REST_OF_HEAD);
        while left > 0 {
            self.stream.readable().await?;
            match self.stream.try_read(&mut chunk) {
                Ok(0) => break,
                Ok(count) => left = left.saturating_sub(count),
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

/// Stream that hyper reads and writes.
pub struct Wire(pub std::sync::Arc<Socket>);

impl Wire {
    /// Whether these bytes are hyper's own answer, which is then held back.
    fn holds_back(&self, bytes: &[u8]) -> bool {
        if self.0.requests.load(Ordering::Relaxed) > 0 {
            return false;
        }
        let status = bare_answer(bytes);
        status.inspect(|status| self.0.held_back.store(*status, Ordering::Relaxed)).is_some()
    }
}

/// Status of hyper's own answer. Replies of the service always have more headers.
fn bare_answer(bytes: &[u8]) -> Option<u16> {
    let text = std::str::from_utf8(bytes).ok().filter(|text| text.len() < BARE_ANSWER)?;
    let (status, fields) = text.strip_prefix("HTTP/1.1 4")?.strip_suffix("\r\n\r\n")?.split_once("\r\n")?;
    let own = ["connection: close", "content-length: 0", "date: "];
    let bare = fields.split("\r\n").all(|field| own.iter().any(|own| field.starts_with(own)));
    bare.then_some(())?;
    status.get(..2)?.parse::<u16>().ok().map(|rest| 400 + rest)
}

impl AsyncRead for Wire {
    fn poll_read(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        let stream = &self.0.stream;
        loop {
            ready!(stream.poll_read_ready(context))?;
            match stream.try_read_buf(buffer) {
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                result => return Poll::Ready(result.map(|_| ())),
            }
        }
    }
}

impl AsyncWrite for Wire {
    fn poll_write(self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        self.poll_write_vectored(context, &[IoSlice::new(bytes)])
    }

    fn poll_write_vectored(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        if let [only] = slices
            && self.holds_back(only)
        {
            return Poll::Ready(Ok(only.len()));
        }
        let stream = &self.0.stream;
        loop {
            ready!(stream.poll_write_ready(context))?;
            match stream.try_write_vectored(slices) {
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                result => return Poll::Ready(result),
            }
        }
    }

    fn is_write_vectored(&self) -> bool {
        true
    }

    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        if self.0.held_back.load(Ordering::Relaxed) == 0 {
            shut(&self.0.stream);
        }
        Poll::Ready(Ok(()))
    }
}

/// Shuts down the sending direction.
fn shut(stream: &ByteStream) {
    stream.shutdown(std::net::Shutdown::Write);
}

/// Refusal for a client with an unreadable head; `None` if it has left, or never sent one.
pub fn refusal(socket: &Socket, error: &hyper::Error, limits: &Limits, unread: &[u8]) -> Option<Problem> {
    let slow = error.is_timeout() && !unread.is_empty();
    match socket.held_back.load(Ordering::Relaxed) {
        414 => {
            let detail = format!("The address has more than {} bytes.", limits.uri_bytes);
            Some(Problem::new(Code::UriTooLong, detail).limit(limits.uri_bytes))
        }
        431 => {
            let detail = format!(
                "More than {} bytes of header fields, or {} of them.",
                limits.header_bytes, limits.header_fields
            );
            Some(Problem::new(Code::HeadersTooLarge, detail).limit(limits.header_bytes))
        }
        0 if slow => {
            let detail = format!("The head did not arrive within {} s.", limits.header_read_s);
            Some(Problem::new(Code::HeadTimeout, detail).limit(limits.header_read_s))
        }
        0 if !error.is_parse() => None,
        _ => Some(Problem::new(Code::BadHeader, format!("The head cannot be read: {error}."))),
    }
}

/// Replies on the socket itself. The connection ends when the client closes it, at the latest after
/// `parting`.
pub async fn refuse(socket: &Socket, response: Response, parting: Duration) {
    let (parts, body) = response.into_parts();
    let body = body.collect().await.map(|body| body.to_bytes()).unwrap_or_default();
    let mut bytes = format!("HTTP/1.1 {}\r\n", parts.status).into_bytes();
    let date =
        DateTimePrinter::new().timestamp_to_rfc9110_string(&jiff::Timestamp::now()).unwrap_or_default();
    for (name, value) in parts
        .headers
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_bytes()))
        .chain([(header::CONNECTION.as_str(), &b"close"[..]), (header::DATE.as_str(), date.as_bytes())])
    {
        bytes.extend([name.as_bytes(), b": ", value, b"\r\n"].concat());
    }
    bytes.extend_from_slice(b"\r\n");
    bytes.extend_from_slice(&body);
    let sent = async {
        socket.send(&bytes).await?;
        shut(&socket.stream);
        socket.drain().await
    };
    let _ = tokio::time::timeout(parting, sent).await;
}

#[cfg(test)]
mod tests {
    use super::bare_answer;

    #[test]
    fn an_answer_without_anything_is_told_from_ours() {
        let date = "date: Mon, 23 Nov 2026 08:00:00 GMT";
        let bare = |status: &str| {
            format!("HTTP/1.1 {status}\r\nconnection: close\r\ncontent-length: 0\r\n{date}\r\n\r\n")
        };
        assert_eq!(bare_answer(bare("431 Request Header Fields Too Large").as_bytes()), Some(431));
        assert_eq!(bare_answer(bare("400 Bad Request").as_bytes()), Some(400));
        assert_eq!(bare_answer(bare("204 No Content").as_bytes()), None);
        let ours = bare("404 Not Found").replace(date, "x-request-id: a");
        assert_eq!(bare_answer(ours.as_bytes()), None);
        assert_eq!(bare_answer(b"HTTP/1.1 400 Bad Request\r\n"), None);
        assert_eq!(bare_answer(b"{}"), None);
    }
}
