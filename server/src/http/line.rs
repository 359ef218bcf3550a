//! Generation, and the steps of a run, over a WebSocket (RFC 6455): each message is a request like any other.
//!
//! A separate request costs a browser three times the work of a message, and a drag sends sixty requests per
//! second. The server passes each message to the router as the `POST` that it replaces, so limits, refusals,
//! counters and log are the same.

use super::frames::WholeMessages;
use super::net::Carrier;
use api::{Code, Problem};
use axum::body::{Body, Bytes};
use axum::http::{HeaderMap, HeaderValue, Method, Request, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::base_path;
use base::limits::Limits;
use base::memory::{self, MemoryShare};
use base::problem::{ProblemDoc, Refusal};
use futures_util::{FutureExt, SinkExt, StreamExt};
use http_body_util::BodyExt;
use hyper_util::rt::TokioIo;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::{HashMap, VecDeque};
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::task::{self, AbortHandle, JoinSet};
use tokio::time::Instant;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::tungstenite::handshake::derive_accept_key;
use tokio_tungstenite::tungstenite::protocol::frame::Frame;
use tokio_tungstenite::tungstenite::protocol::frame::coding::{CloseCode, Data, OpCode};
use tokio_tungstenite::tungstenite::protocol::{CloseFrame, Role, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Error, Message};

/// Pieces of replies that may wait for the reader, over all requests.
const PIECES: usize = 8;
/// Requests beyond `line_questions` that may wait; further ones are refused.
const WAITING: usize = 64;
/// The connection's own messages that may wait for the reader; at this number, nothing more is read.
const REPLIES: usize = 64;
/// Time for the reader to take a frame while so many wait: a Close behind unread requests is not heard before.
const FULL_PATIENCE: Duration = Duration::from_secs(1);
/// Interval of pings, which keep a silent connection open and detect a vanished peer.
const PING: Duration = Duration::from_secs(30);
/// Time after which a refused client may repeat its request, seconds.
const RETRY_AFTER_S: u64 = 1;
/// Bytes read from the connection at once.
const READ_BUFFER: usize = 16 << 10;
/// Largest frame that is sent. Larger messages are fragmented, so that little memory waits for the reader.
const FRAME_BYTES: usize = 16 << 10;
/// Limit of bytes that wait in the WebSocket itself: a frame, and pongs. Beyond this, only the newest pong is
/// kept.
const WRITE_BUFFER: usize = 64 << 10;
/// Pings and pongs accepted from the client in a burst, and per second.
const CONTROL_BURST: f64 = 64.0;
const CONTROL_RATE: f64 = 10.0;
/// Longest reason: a control frame holds 125 bytes, two of them its code (RFC 6455, 5.5).
const REASON_BYTES: usize = 123;
/// Reason and refusal once the server shuts down.
const SHUTTING_DOWN: &str = "The server is shutting down.";

/// A message of the client: a request, or the number of a request to cancel.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClientMessage<'a> {
    /// Number of a new request, chosen by the client.
    #[serde(default)]
    ask: Option<u64>,
    /// The body of its request.
    #[serde(borrow, default)]
    body: Option<&'a RawValue>,
    /// Number of the request to cancel.
    #[serde(default)]
    end: Option<u64>,
}

/// The first text line of a message of a reply. A piece of the reply's body follows.
#[derive(Serialize)]
struct ServerMessage {
    ask: u64,
    #[serde(flatten)]
    head: Option<ReplyHead>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    last: bool,
}

impl ServerMessage {
    /// The message with a piece of the body after it.
    fn with(&self, piece: &[u8]) -> Result<Bytes, axum::Error> {
        let mut text = serde_json::to_vec(self).map_err(axum::Error::new)?;
        text.push(b'\n');
        text.extend_from_slice(std::str::from_utf8(piece).map_err(axum::Error::new)?.as_bytes());
        Ok(Bytes::from(text))
    }

    /// The last message of a cancelled request.
    fn given_up(ask: u64) -> Result<Bytes, axum::Error> {
        Self { ask, head: None, last: true }.with(b"")
    }

    /// The last message of a request that arrives during shutdown.
    fn closing(ask: u64) -> Result<Bytes, axum::Error> {
        Self::failed(ask, Problem::new(Code::ShuttingDown, SHUTTING_DOWN))
    }

    /// The last message of a request that failed, at once or midway.
    fn failed(ask: u64, problem: Problem) -> Result<Bytes, axum::Error> {
        let refusal = Refusal::from(problem);
        let document = ProblemDoc::of(&refusal.0, None, None).text();
        Self { ask, head: Some(ReplyHead::of(&refusal.into_response())), last: true }
            .with(document.as_bytes())
    }
}

/// Status and headers of a reply that a client needs.
#[derive(Serialize)]
struct ReplyHead {
    status: u16,
    #[serde(skip_serializing_if = "Option::is_none")]
    retry_after_s: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
}

impl ReplyHead {
    fn of(reply: &Response) -> Self {
        let field = |name: &str| reply.headers().get(name).and_then(|value| value.to_str().ok());
        Self {
            status: reply.status().as_u16(),
            retry_after_s: field("retry-after").and_then(|seconds| seconds.parse().ok()),
            scene: field("dragtraffic-scene").map(str::to_owned),
        }
    }
}

/// Upgrades a connection to a WebSocket. Requests go to `path`, with the headers of the page or program that
/// opened it. `None` for a request that is not a handshake (RFC 6455, 4.2.1).
pub fn open(mut request: Request<Body>, carrier: Carrier, path: String) -> Option<Response> {
    let accept = HeaderValue::try_from(accept_key(&request)?).ok()?;
    let given = [header::HOST, header::ORIGIN, header::AUTHORIZATION, header::COOKIE];
    let given =
        given.into_iter().filter_map(|name| Some((name.clone(), request.headers().get(name)?.clone())));
    let own = [(header::CONTENT_TYPE, "application/json"), (header::ACCEPT, "application/x-ndjson")];
    let own = own.map(|(name, value)| (name, HeaderValue::from_static(value)));
    let headers = given.chain(own).collect();
    let most = carrier.limits.line_bytes as usize;
    let config = WebSocketConfig::default()
        .max_message_size(Some(most))
        .max_frame_size(Some(most))
        .read_buffer_size(READ_BUFFER)
        .write_buffer_size(0)
        .max_write_buffer_size(WRITE_BUFFER);
    let line = Line { carrier, path, headers };
    let upgrade = hyper::upgrade::on(&mut request);
    tokio::spawn(async move {
        let Ok(stream) = upgrade.await else { return };
        let patience = Duration::from_secs(line.carrier.limits.body_read_s.max(1));
        let stream = WholeMessages::new(TokioIo::new(stream), patience, &line.carrier.memory);
        line.serve(WebSocketStream::from_raw_socket(stream, Role::Server, Some(config)).await).await;
    });
    let upgraded = [
        (header::CONNECTION, HeaderValue::from_static("upgrade")),
        (header::UPGRADE, HeaderValue::from_static("websocket")),
        (header::SEC_WEBSOCKET_ACCEPT, accept),
    ];
    Some((StatusCode::SWITCHING_PROTOCOLS, upgraded).into_response())
}

/// The server's half of a handshake; `None` if the client's half is invalid.
fn accept_key(request: &Request<Body>) -> Option<String> {
    let fields = |name| request.headers().get_all(name).iter().filter_map(|value| value.to_str().ok());
    let lists = |name, word: &str| {
        fields(name).flat_map(|value| value.split(',')).any(|given| given.trim().eq_ignore_ascii_case(word))
    };
    let key = fields(header::SEC_WEBSOCKET_KEY).next()?.as_bytes();
    let is_base64 = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'/');
    // 16 bytes in base64.
    let is_key = key.len() == 24 && key.strip_suffix(b"==").is_some_and(|key| key.iter().all(is_base64));
    let is_handshake = request.method() == Method::GET
        && lists(header::CONNECTION, "upgrade")
        && lists(header::UPGRADE, "websocket")
        && fields(header::SEC_WEBSOCKET_VERSION).eq(["13"])
        && is_key;
    is_handshake.then(|| derive_accept_key(key))
}

struct Line {
    carrier: Carrier,
    path: String,
    headers: HeaderMap,
}

/// A piece of a reply.
struct ReplyPiece {
    ask: u64,
    /// Id of the request's task, because clients reuse numbers.
    task: task::Id,
    text: Bytes,
    is_last: bool,
}

/// Open requests of a client, by the client's numbers.
#[derive(Default)]
struct Questions {
    tasks: JoinSet<()>,
    /// Requests that have not sent their last piece.
    running: HashMap<u64, AbortHandle>,
    /// Waiting requests, with their bodies.
    waiting: VecDeque<(u64, String, MemoryShare)>,
    /// The server is shutting down: no new request starts.
    closing: bool,
}

impl Questions {
    fn knows(&self, number: u64) -> bool {
        self.running.contains_key(&number) || self.waiting.iter().any(|(waiting, ..)| *waiting == number)
    }

    /// Ends a request; true if its last piece had not been sent.
    fn end(&mut self, number: u64) -> bool {
        let before = self.waiting.len();
        self.waiting.retain(|(waiting, ..)| *waiting != number);
        let task = self.running.remove(&number);
        if let Some(task) = &task {
            task.abort();
        }
        task.is_some() || self.waiting.len() < before
    }

    /// Whether a piece belongs to a running request. The last piece frees its number.
    fn takes(&mut self, piece: &ReplyPiece) -> bool {
        let runs = self.running.get(&piece.ask).is_some_and(|task| task.id() == piece.task);
        if runs && piece.is_last {
            self.running.remove(&piece.ask);
        }
        runs
    }

    /// Frees and returns the number of a request whose task has panicked.
    fn broken(&mut self, task: task::Id) -> Option<u64> {
        let number = self.running.iter().find(|(_, running)| running.id() == task).map(|(number, _)| *number);
        number.inspect(|number| drop(self.running.remove(number)))
    }

    /// Whether a request of this size may wait: together they take at most twice one message's memory.
    fn may_wait(&self, limits: &Limits) -> bool {
        let bytes: usize = self.waiting.iter().map(|(_, body, _)| body.len()).sum();
        self.waiting.len() < WAITING && bytes < limits.line_bytes as usize
    }
}

/// A message that waits for the reader.
enum Outgoing {
    /// The rest of a message, and whether its first frame has still to be sent.
    Text(Bytes, bool),
    Ping,
}

impl Outgoing {
    /// The next frame, and the rest of the message.
    fn frame(self) -> (Message, Option<Self>) {
        match self {
            Self::Ping => (Message::Ping(Bytes::new()), None),
            Self::Text(mut text, is_first) => {
                let piece = text.split_to(text.len().min(FRAME_BYTES));
                let code = OpCode::Data(if is_first { Data::Text } else { Data::Continue });
                let frame = Message::Frame(Frame::message(piece, code, text.is_empty()));
                (frame, (!text.is_empty()).then_some(Self::Text(text, false)))
            }
        }
    }
}

/// Rate limiter of the client's pings and pongs.
struct ControlAllowance {
    left: f64,
    at: Instant,
}

impl ControlAllowance {
    fn new() -> Self {
        Self { left: CONTROL_BURST, at: Instant::now() }
    }

    /// Counts one; false if the client sends them too fast.
    fn take(&mut self) -> bool {
        let since = std::mem::replace(&mut self.at, Instant::now());
        self.left = (self.left + CONTROL_RATE * since.elapsed().as_secs_f64()).min(CONTROL_BURST) - 1.0;
        self.left >= 0.0
    }
}

type Socket = WebSocketStream<WholeMessages<TokioIo<hyper::upgrade::Upgraded>>>;

impl Line {
    /// Serves until the client leaves, sends an invalid message or stops reading, or the server ends.
    async fn serve(mut self, socket: Socket) {
        let (mut sink, mut stream) = socket.split();
        let (pieces, mut ready) = mpsc::channel(PIECES);
        let mut questions = Questions::default();
        let mut replies: VecDeque<Outgoing> = VecDeque::new();
        let mut ping = tokio::time::interval_at(Instant::now() + PING, PING);
        let mut controls = ControlAllowance::new();
        let text = |text| Outgoing::Text(text, true);
        // Since when the reader has not taken the frame that is being sent.
        let mut sending = None;
        let parting = loop {
            if sending.is_none()
                && let Some(reply) = replies.pop_front()
            {
                let (frame, rest) = reply.frame();
                rest.into_iter().for_each(|rest| replies.push_front(rest));
                // Everything sent before has been flushed, so this does not wait.
                if sink.feed(frame).await.is_err() {
                    return;
                }
                sending = Some(Instant::now());
            }
            let is_over =
                questions.closing && questions.tasks.is_empty() && ready.is_empty() && sending.is_none();
            let patience = if replies.len() < REPLIES { self.carrier.patience } else { FULL_PATIENCE };
            let deadline = sending.unwrap_or_else(Instant::now) + patience.min(self.carrier.patience);
            let heard = tokio::select! {
                sent = sink.flush(), if sending.is_some() => {
                    if sent.is_err() {
                        return;
                    }
                    sending = None;
                    continue;
                }
                () = tokio::time::sleep_until(deadline), if sending.is_some() => return,
                Some(piece) = ready.recv(), if sending.is_none() => {
                    if questions.takes(&piece) {
                        replies.push_back(text(piece.text));
                    }
                    continue;
                }
                Some(ended) = questions.tasks.join_next_with_id() => {
                    if let Err(error) = ended
                        && let Some(number) = questions.broken(error.id())
                    {
                        replies.extend(ServerMessage::failed(number, Problem::internal(error)).map(text));
                    }
                    self.start_waiting(&mut questions, &pieces);
                    continue;
                }
                heard = stream.next(), if replies.len() < REPLIES => heard,
                () = self.carrier.closes(), if !questions.closing => {
                    questions.closing = true;
                    let waiting = std::mem::take(&mut questions.waiting);
                    let closing = waiting.into_iter().flat_map(|(number, ..)| ServerMessage::closing(number));
                    replies.extend(closing.map(text));
                    continue;
                }
                _ = ping.tick() => {
                    replies.push_back(Outgoing::Ping);
                    continue;
                }
                () = std::future::ready(()), if is_over => break parting(CloseCode::Away, SHUTTING_DOWN),
            };
            match heard {
                Some(Ok(Message::Text(said))) => match self.hear(&said, &mut questions, &pieces) {
                    Ok(reply) => replies.extend(reply.map(text)),
                    Err(why) => break parting(CloseCode::Policy, &why),
                },
                Some(Ok(Message::Ping(_) | Message::Pong(_))) if !controls.take() => {
                    let why = format!("More than {CONTROL_RATE} pings a second.");
                    break parting(CloseCode::Policy, &why);
                }
                // The pong waits in the socket, and nothing else is sent before the reader has taken it.
                Some(Ok(Message::Ping(_))) => {
                    sending.get_or_insert_with(Instant::now);
                }
                Some(Ok(Message::Pong(_))) => {}
                Some(Ok(Message::Binary(_) | Message::Frame(_))) => {
                    break parting(CloseCode::Unsupported, "Text expected.");
                }
                Some(Err(error)) => break parting(close_code(&error), &error.to_string()),
                Some(Ok(Message::Close(_))) | None => {
                    drop(questions);
                    let _ = tokio::time::timeout(self.carrier.patience, sink.close()).await;
                    return;
                }
            }
        };
        // Open requests end now, not when the reader has taken the last frame.
        drop(questions);
        let parted = async {
            sink.flush().await?;
            sink.send(parting).await
        };
        let _ = tokio::time::timeout(self.carrier.patience, parted).await;
    }

    /// Starts, queues, refuses or cancels a request; returns the immediate reply, if any.
    ///
    /// # Errors
    /// Why the client's message is invalid.
    fn hear(
        &self,
        text: &str,
        questions: &mut Questions,
        pieces: &mpsc::Sender<ReplyPiece>,
    ) -> Result<Option<Bytes>, String> {
        if !text.trim_start().starts_with('{') {
            return Err("An object is expected.".to_owned());
        }
        let reply = match serde_json::from_str(text).map_err(|error| error.to_string())? {
            ClientMessage { ask: Some(number), body: Some(body), end: None } => {
                if questions.knows(number) {
                    return Err(format!("Question {number} is open already."));
                }
                if questions.closing {
                    Some(ServerMessage::closing(number))
                } else {
                    let may_wait = questions.may_wait(&self.carrier.limits);
                    match may_wait.then(|| self.carrier.memory.take(body.get().len())) {
                        Some(Some(memory)) => {
                            questions.waiting.push_back((number, body.get().to_owned(), memory));
                            self.start_waiting(questions, pieces);
                            None
                        }
                        refused => {
                            let detail = "Too many questions wait on this line.";
                            let problem = match refused {
                                None => Problem::new(Code::Busy, detail).retry_after(RETRY_AFTER_S),
                                Some(_) => memory::full(),
                            };
                            Some(ServerMessage::failed(number, problem))
                        }
                    }
                }
            }
            ClientMessage { ask: None, body: None, end: Some(number) } => {
                // Its last piece may have been sent in the meantime.
                questions.end(number).then(|| ServerMessage::given_up(number))
            }
            _ => return Err("{\"ask\": NUMBER, \"body\": {..}} or {\"end\": NUMBER} expected.".to_owned()),
        };
        reply.transpose().map_err(|error| error.to_string())
    }

    /// Starts waiting requests, up to the number that may run at the same time.
    fn start_waiting(&self, questions: &mut Questions, pieces: &mpsc::Sender<ReplyPiece>) {
        while (questions.tasks.len() as u64) < self.carrier.limits.line_questions.max(1)
            && let Some((number, body, _)) = questions.waiting.pop_front()
        {
            let answer = answer(self.carrier.clone(), self.request(body), number, pieces.clone());
            questions.running.insert(number, questions.tasks.spawn(answer));
        }
    }

    /// The `POST` that a message replaces.
    fn request(&self, body: String) -> Request<Body> {
        let mut request = Request::new(Body::from(body));
        *request.method_mut() = Method::POST;
        *request.uri_mut() = base_path::published(&self.path).parse().unwrap_or_default();
        *request.headers_mut() = self.headers.clone();
        request
    }
}

/// Runs a request, and forwards the reply until it ends or is cancelled.
async fn answer(carrier: Carrier, request: Request<Body>, ask: u64, pieces: mpsc::Sender<ReplyPiece>) {
    let (reply, _busy) = carrier.ask(request).await;
    pass_on(reply, ask, pieces).await;
}

/// Sends a reply in pieces. If its body breaks off, the last piece is a problem.
async fn pass_on(reply: Response, ask: u64, pieces: mpsc::Sender<ReplyPiece>) {
    let mut head = ServerMessage { ask, head: Some(ReplyHead::of(&reply)), last: false };
    let mut body = reply.into_body();
    let mut piece = next(&mut body).await;
    while !head.last {
        // Usually the next piece shows at once whether this one is the last; a separate message would cost
        // the reader a task.
        let following =
            if matches!(piece, Some(Ok(_))) { next(&mut body).now_or_never() } else { Some(None) };
        head.last = matches!(following, Some(None));
        let text = piece.unwrap_or_else(|| Ok(Bytes::new())).and_then(|bytes| head.with(&bytes));
        let text = text.or_else(|error| {
            head.last = true;
            ServerMessage::failed(ask, Problem::internal(error))
        });
        let Ok(text) = text else { return };
        let part = ReplyPiece { ask, task: task::id(), text, is_last: head.last };
        if pieces.send(part).await.is_err() {
            return;
        }
        head.head = None;
        piece = match following {
            Some(piece) => piece,
            None => next(&mut body).await,
        };
    }
}

/// The next piece of a body; `None` after the last.
async fn next(body: &mut Body) -> Option<Result<Bytes, axum::Error>> {
    loop {
        match body.frame().await? {
            Ok(frame) => {
                if let Ok(bytes) = frame.into_data() {
                    return Some(Ok(bytes));
                }
            }
            Err(error) => return Some(Err(error)),
        }
    }
}

/// The close code of a connection after an error (RFC 6455, 7.4.1).
fn close_code(error: &Error) -> CloseCode {
    match error {
        Error::Capacity(_) => CloseCode::Size,
        Error::Utf8(_) => CloseCode::Invalid,
        Error::Io(error) if error.kind() == std::io::ErrorKind::TimedOut => CloseCode::Policy,
        Error::Io(error) if error.kind() == std::io::ErrorKind::OutOfMemory => CloseCode::Again,
        _ => CloseCode::Protocol,
    }
}

fn parting(code: CloseCode, reason: &str) -> Message {
    let reason: String = reason.chars().filter(char::is_ascii).take(REASON_BYTES).collect();
    Message::Close(Some(CloseFrame { code, reason: reason.into() }))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed test panics")]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_body_that_breaks_off_ends_with_a_problem() {
        let chunks = [Ok("{}\n"), Err(std::io::Error::other("the disk is gone"))];
        let reply = Response::new(Body::from_stream(futures_util::stream::iter(chunks)));
        let (pieces, mut ready) = mpsc::channel(PIECES);
        tokio::spawn(pass_on(reply, 7, pieces)).await.unwrap();
        let mut texts = Vec::new();
        while let Some(piece) = ready.recv().await {
            texts.push((piece.is_last, String::from_utf8(piece.text.to_vec()).unwrap()));
        }
        assert_eq!(texts.len(), 2, "{texts:?}");
        assert_eq!(texts[0], (false, "{\"ask\":7,\"status\":200}\n{}\n".to_owned()));
        let (head, problem) = texts[1].1.split_once('\n').unwrap();
        assert_eq!((texts[1].0, head), (true, r#"{"ask":7,"status":500,"last":true}"#));
        assert!(problem.contains(r#""code":"internal""#), "{problem}");
    }
}
