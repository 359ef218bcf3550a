//! `Idempotency-Key`: a request that is repeated after a lost reply creates nothing twice
//! (draft-ietf-httpapi-idempotency-key-header). The table is in memory, so a restart clears it.

use api::{Code, Problem};
use axum::body::{Body, Bytes};
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, Method, StatusCode, Uri};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use base::party::Party;
use base::problem::Refusal;
use futures_util::TryStreamExt;
use scene::ContentHash;
use sha2::{Digest, Sha256};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Name of the header.
pub const KEY: HeaderName = HeaderName::from_static("idempotency-key");
/// Most characters of a key.
const KEY_CHARS: usize = 128;
/// Limits of kept replies, and of the bytes of one.
const REPLIES: usize = 1_024;
const REPLY_BYTES: usize = 256 << 10;
/// How long a reply is kept.
const KEPT: Duration = Duration::from_secs(24 * 3_600);
/// Time for the body of a repeated request.
const BODY_TIME: Duration = Duration::from_secs(120);

/// The sender of a request; keys of different senders are independent. Extension of requests.
#[derive(Clone, Debug, Default)]
pub struct Sender {
    /// Name of the token, or of the user that a trusted proxy authenticated.
    pub name: Option<String>,
    /// Party whose share it uses.
    pub party: Party,
    /// Whether the token is an administrator's.
    pub is_admin: bool,
}

/// A reply as it was sent.
#[derive(Clone)]
struct KeptReply {
    at: Instant,
    request: [u8; 32],
    status: StatusCode,
    headers: HeaderMap,
    body: Bytes,
}

#[derive(Default)]
struct ReplyTable {
    /// `None` while the first request is in progress.
    replies: HashMap<String, Option<KeptReply>>,
    /// Keys with a reply, oldest first.
    order: VecDeque<String>,
}

/// Replies by key.
#[derive(Clone, Default)]
pub struct Replies(Arc<Mutex<ReplyTable>>);

/// State of a key.
enum KeyState {
    Nothing,
    UnderWay,
    Reply(KeptReply),
}

impl Replies {
    fn table(&self) -> MutexGuard<'_, ReplyTable> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The state of a key; an unknown one is in progress from now on.
    fn begin(&self, key: &str) -> KeyState {
        let mut table = self.table();
        let expired = |table: &ReplyTable| {
            let oldest = table.order.front().and_then(|key| table.replies.get(key)?.as_ref());
            oldest.is_some_and(|reply| reply.at.elapsed() > KEPT)
        };
        while expired(&table) {
            drop_oldest(&mut table);
        }
        match table.replies.get(key) {
            Some(Some(reply)) => KeyState::Reply(reply.clone()),
            Some(None) => KeyState::UnderWay,
            None => {
                table.replies.insert(key.to_owned(), None);
                KeyState::Nothing
            }
        }
    }

    fn end(&self, key: String, reply: Option<KeptReply>) {
        let mut table = self.table();
        if reply.is_none() {
            table.replies.remove(&key);
            return;
        }
        table.replies.insert(key.clone(), reply);
        table.order.push_back(key);
        if table.order.len() > REPLIES {
            drop_oldest(&mut table);
        }
    }
}

fn drop_oldest(table: &mut ReplyTable) {
    if let Some(oldest) = table.order.pop_front() {
        table.replies.remove(&oldest);
    }
}

/// Ends the first request of a key, whatever its outcome.
struct FirstRequest {
    replies: Replies,
    key: String,
    reply: Option<KeptReply>,
}

impl Drop for FirstRequest {
    fn drop(&mut self) {
        self.replies.end(std::mem::take(&mut self.key), self.reply.take());
    }
}

/// Whether a request creates something that a repetition would create again.
fn makes(method: &Method, uri: &Uri) -> bool {
    let path = uri.path();
    let copies = path.starts_with("/v1/scenes/") && path.ends_with("/duplicate");
    method == Method::POST && (path == "/v1/scenes" || path == "/v1/import" || copies)
}

/// Answers a request with a known key by the reply of the first one.
pub async fn once(State(replies): State<Replies>, request: Request, next: Next) -> Response {
    if !makes(request.method(), request.uri()) {
        return next.run(request).await;
    }
    let key = match request.headers().get(&KEY).map(|value| value.to_str()) {
        None => return next.run(request).await,
        Some(Ok(key)) if !key.is_empty() && key.len() <= KEY_CHARS => key.to_owned(),
        Some(_) => {
            let detail = format!("Idempotency-Key has 1 to {KEY_CHARS} visible ASCII characters.");
            return Refusal::from(Problem::new(Code::BadHeader, detail)).into_response();
        }
    };
    let sender = request.extensions().get::<Sender>().cloned().unwrap_or_default();
    let key = ContentHash::of(&(sender.name, sender.party.to_string(), key)).hex();
    let digest = Arc::new(Mutex::new(head_of(&request)));
    match replies.begin(&key) {
        KeyState::Nothing => {
            let first = FirstRequest { replies, key, reply: None };
            // Runs to its end even if the client leaves, because the client will ask for the result.
            let work =
                tokio::spawn(run_first(first, request.map(|body| counted(body, &digest)), next, digest));
            work.await.unwrap_or_else(|error| Refusal::from(Problem::internal(error)).into_response())
        }
        KeyState::UnderWay => {
            let detail = "The first request with this Idempotency-Key is still under way.";
            Refusal::from(Problem::new(Code::Busy, detail).retry_after(1)).into_response()
        }
        KeyState::Reply(reply) => match repeated(request.into_body(), reply, &digest).await {
            Ok(response) => response,
            Err(problem) => Refusal::from(problem).into_response(),
        },
    }
}

async fn run_first(
    mut first: FirstRequest,
    request: Request,
    next: Next,
    digest: Arc<Mutex<Sha256>>,
) -> Response {
    let response = next.run(request).await;
    let size = axum::body::HttpBody::size_hint(response.body()).exact();
    if !response.status().is_success() || size.is_none_or(|size| size > REPLY_BYTES as u64) {
        return response;
    }
    let (parts, body) = response.into_parts();
    let Ok(body) = axum::body::to_bytes(body, REPLY_BYTES).await else {
        return Refusal::from(Problem::internal("a reply without its end")).into_response();
    };
    let (status, headers) = (parts.status, parts.headers.clone());
    let reply = KeptReply { at: Instant::now(), request: sum(&digest), status, headers, body: body.clone() };
    first.reply = Some(reply);
    Response::from_parts(parts, Body::from(body))
}

async fn repeated(body: Body, reply: KeptReply, digest: &Arc<Mutex<Sha256>>) -> Result<Response, Problem> {
    let all = counted(body, digest).into_data_stream().try_for_each(|_| async { Ok(()) });
    let read = tokio::time::timeout(BODY_TIME, all).await;
    if !matches!(read, Ok(Ok(()))) {
        return Err(Problem::new(Code::BodyTimeout, "The body did not arrive."));
    }
    if sum(digest) != reply.request {
        let detail = "This Idempotency-Key was sent with another request; each request has its own.";
        return Err(Problem::new(Code::IdempotencyKeyReused, detail));
    }
    let mut response = Response::new(Body::from(reply.body));
    *response.status_mut() = reply.status;
    *response.headers_mut() = reply.headers;
    Ok(response)
}

/// Hash of a request's head.
fn head_of(request: &Request) -> Sha256 {
    let mut digest = Sha256::new();
    digest.update(request.uri().path_and_query().map_or("", |path| path.as_str()));
    for name in ["content-type", "content-encoding"] {
        digest.update([0]);
        digest.update(request.headers().get(name).map_or(&b""[..], |value| value.as_bytes()));
    }
    digest.update([0]);
    digest
}

/// The body; its bytes are added to the digest as they pass.
fn counted(body: Body, digest: &Arc<Mutex<Sha256>>) -> Body {
    let digest = Arc::clone(digest);
    Body::from_stream(body.into_data_stream().inspect_ok(move |bytes| {
        digest.lock().unwrap_or_else(PoisonError::into_inner).update(bytes);
    }))
}

fn sum(digest: &Mutex<Sha256>) -> [u8; 32] {
    digest.lock().unwrap_or_else(PoisonError::into_inner).clone().finalize().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reply() -> KeptReply {
        let (status, headers, body) = (StatusCode::CREATED, HeaderMap::new(), Bytes::new());
        KeptReply { at: Instant::now(), request: [0; 32], status, headers, body }
    }

    #[test]
    fn the_table_is_bounded_and_forgets_failures() {
        let replies = Replies::default();
        assert!(matches!(replies.begin("a"), KeyState::Nothing));
        assert!(matches!(replies.begin("a"), KeyState::UnderWay));
        drop(FirstRequest { replies: replies.clone(), key: "a".into(), reply: None });
        assert!(matches!(replies.begin("a"), KeyState::Nothing));
        replies.end("a".into(), Some(reply()));
        assert!(matches!(replies.begin("a"), KeyState::Reply(_)));
        for i in 0..REPLIES {
            assert!(matches!(replies.begin(&i.to_string()), KeyState::Nothing));
            replies.end(i.to_string(), Some(reply()));
        }
        assert!(matches!(replies.begin("a"), KeyState::Nothing), "the oldest made room");
        assert_eq!(replies.table().order.len(), REPLIES);
    }
}
