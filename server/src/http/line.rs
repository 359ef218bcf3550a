//! An open line: questions over a WebSocket (RFC 6455), each of them a request like any other.
//!
//! A request of its own costs a browser three times the work of a message, and who drags asks sixty times a second.
//! A question is handed to the router as the `POST` that it would have been, so that limits, refusals, counters and
//! log are the same.

use super::net::Carrier;
use crate::base::limits::Limits;
use axum::body::{Body, Bytes};
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, WebSocketUpgrade, close_code};
use axum::http::{HeaderMap, HeaderValue, Request, header};
use axum::response::Response;
use futures_util::{FutureExt, SinkExt, StreamExt};
use http_body_util::BodyExt;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::HashMap;
use std::time::Duration;
use tokio::sync::mpsc;
use tokio::task::{self, AbortHandle, JoinSet};
use tokio::time::Instant;

/// Pieces of answers that wait for the reader, of all questions together.
const PIECES: usize = 8;
/// Keeps a silent line open, and finds out when its other end has vanished.
const PING: Duration = Duration::from_secs(30);
/// Most of a reason: a control frame holds 125 bytes, two of them its code (RFC 6455, 5.5).
const REASON_BYTES: usize = 123;

/// What a client says.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Said<'a> {
    /// A question, by a number of the client's own.
    #[serde(default)]
    ask: Option<u64>,
    /// The body of its request.
    #[serde(borrow, default)]
    body: Option<&'a RawValue>,
    /// The question of that number is given up.
    #[serde(default)]
    end: Option<u64>,
}

/// The first text line of what is told of a question. What follows is a piece of the reply's body.
#[derive(Serialize)]
struct Told {
    ask: u64,
    #[serde(flatten)]
    head: Option<Head>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    last: bool,
}

/// What a client needs to know of the head of a reply.
#[derive(Serialize)]
struct Head {
    status: u16,
    #[serde(skip_serializing_if = "Option::is_none")]
    retry_after_s: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
}

impl Head {
    fn of(reply: &Response) -> Self {
        let field = |name: &str| reply.headers().get(name).and_then(|value| value.to_str().ok());
        Self {
            status: reply.status().as_u16(),
            retry_after_s: field("retry-after").and_then(|seconds| seconds.parse().ok()),
            scene: field("dragtraffic-scene").map(str::to_owned),
        }
    }
}

/// Makes a line of a connection. Questions go to `path`, on behalf of the page or program that opened it.
pub fn open(
    upgrade: WebSocketUpgrade,
    carrier: Carrier,
    path: &'static str,
    headers: &HeaderMap,
) -> Response {
    let given = [header::HOST, header::ORIGIN, header::AUTHORIZATION];
    let given = given.into_iter().filter_map(|name| Some((name.clone(), headers.get(name)?.clone())));
    let own = [(header::CONTENT_TYPE, "application/json"), (header::ACCEPT, "application/x-ndjson")];
    let own = own.map(|(name, value)| (name, HeaderValue::from_static(value)));
    let most = carrier.limits.line_bytes as usize;
    let line = Line { carrier, path, headers: given.chain(own).collect() };
    upgrade.max_message_size(most).max_frame_size(most).on_upgrade(move |socket| line.serve(socket))
}

struct Line {
    carrier: Carrier,
    path: &'static str,
    headers: HeaderMap,
}

/// A part of an answer on its way.
struct Piece {
    message: Message,
    /// The task whose last one it is.
    ends: Option<task::Id>,
}

/// Questions that are open.
#[derive(Default)]
struct Open {
    tasks: JoinSet<()>,
    /// By the numbers of the client.
    numbers: HashMap<u64, AbortHandle>,
}

impl Open {
    /// Who asks more at the same time waits to be heard.
    fn has_room(&self, limits: &Limits) -> bool {
        (self.tasks.len() as u64) < limits.line_questions.max(1)
    }
}

impl Line {
    /// Until the client leaves, says what cannot be understood or takes nothing more, or the server ends.
    async fn serve(mut self, socket: WebSocket) {
        let (mut sink, mut stream) = socket.split();
        let (pieces, mut ready) = mpsc::channel(PIECES);
        let mut open = Open::default();
        let mut ping = tokio::time::interval_at(Instant::now() + PING, PING);
        let mut closing = false;
        loop {
            let message = tokio::select! {
                piece = ready.recv() => match piece {
                    Some(Piece { message, ends }) => {
                        // Who has heard the last of a question may give its number to the next one at once.
                        open.numbers.retain(|_, task| Some(task.id()) != ends);
                        message
                    }
                    None => parting(close_code::NORMAL, ""),
                },
                Some(_) = open.tasks.join_next() => {
                    open.numbers.retain(|_, task| !task.is_finished());
                    continue;
                }
                said = stream.next(), if !closing && open.has_room(&self.carrier.limits) => match said {
                    Some(Ok(Message::Text(text))) => match self.hear(&text, &mut open, &pieces) {
                        Ok(()) => continue,
                        Err(why) => parting(close_code::POLICY, &why),
                    },
                    Some(Ok(Message::Binary(_))) => parting(close_code::UNSUPPORTED, "Text expected."),
                    Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
                    Some(Err(error)) => parting(close_code::PROTOCOL, &error.to_string()),
                    Some(Ok(Message::Close(_))) | None => return,
                },
                () = self.carrier.closes(), if !closing => {
                    closing = true;
                    continue;
                }
                _ = ping.tick() => Message::Ping(Bytes::new()),
                () = std::future::ready(()), if closing && open.tasks.is_empty() && ready.is_empty() => {
                    parting(close_code::AWAY, "The server ends.")
                }
            };
            let parts = matches!(message, Message::Close(_));
            let sent = tokio::time::timeout(self.carrier.patience, sink.send(message)).await;
            if parts || !matches!(sent, Ok(Ok(()))) {
                return;
            }
        }
    }

    /// Begins or ends a question.
    ///
    /// # Errors
    /// Why the client cannot be understood.
    fn hear(&self, text: &str, open: &mut Open, pieces: &mpsc::Sender<Piece>) -> Result<(), String> {
        match serde_json::from_str(text).map_err(|error| error.to_string())? {
            Said { ask: Some(number), body: Some(body), end: None } => {
                if open.numbers.contains_key(&number) {
                    return Err(format!("Question {number} is open already."));
                }
                let answer = answer(self.carrier.clone(), self.request(body.get()), number, pieces.clone());
                open.numbers.insert(number, open.tasks.spawn(answer));
            }
            Said { ask: None, body: None, end: Some(number) } => {
                // It may have been answered in the meantime.
                if let Some(task) = open.numbers.remove(&number) {
                    task.abort();
                }
            }
            _ => return Err("{\"ask\": NUMBER, \"body\": {..}} or {\"end\": NUMBER} expected.".to_owned()),
        }
        Ok(())
    }

    /// The request that a question would have been.
    fn request(&self, body: &str) -> Request<Body> {
        let mut request = Request::new(Body::from(body.to_owned()));
        *request.method_mut() = axum::http::Method::POST;
        *request.uri_mut() = axum::http::Uri::from_static(self.path);
        *request.headers_mut() = self.headers.clone();
        request
    }
}

/// Asks, and tells what comes until it is over or given up.
async fn answer(carrier: Carrier, request: Request<Body>, ask: u64, pieces: mpsc::Sender<Piece>) {
    let (reply, _busy) = carrier.ask(request).await;
    let mut told = Told { ask, head: Some(Head::of(&reply)), last: false };
    let mut body = reply.into_body();
    let mut piece = next(&mut body).await;
    while !told.last {
        // Whether it is the last is mostly known at once, and each message costs the reader a task.
        let following = if piece.is_some() { next(&mut body).now_or_never() } else { Some(None) };
        told.last = matches!(following, Some(None));
        let Ok(message) = message(&told, &piece.unwrap_or_default()) else { return };
        let part = Piece { message, ends: told.last.then(task::id) };
        if pieces.send(part).await.is_err() {
            return;
        }
        told.head = None;
        piece = match following {
            Some(piece) => piece,
            None => next(&mut body).await,
        };
    }
}

/// The next piece of a body; `None` after the last.
async fn next(body: &mut Body) -> Option<Bytes> {
    loop {
        if let Ok(bytes) = body.frame().await?.ok()?.into_data() {
            return Some(bytes);
        }
    }
}

fn message(told: &Told, piece: &[u8]) -> Result<Message, Box<dyn std::error::Error>> {
    let mut text = serde_json::to_vec(told)?;
    text.push(b'\n');
    text.extend_from_slice(piece);
    Ok(Message::Text(Utf8Bytes::try_from(Bytes::from(text))?))
}

fn parting(code: u16, reason: &str) -> Message {
    let reason: String = reason.chars().filter(char::is_ascii).take(REASON_BYTES).collect();
    Message::Close(Some(CloseFrame { code, reason: reason.into() }))
}
