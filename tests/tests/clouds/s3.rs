//! A test double of S3: keeps objects in memory, supports `If-None-Match`, and loses requests and replies on
//! demand.

use axum::Router;
use axum::body::Bytes;
use axum::extract::{Query, State};
use axum::http::{HeaderMap, Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use std::collections::{BTreeMap, HashMap};
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Fate of a request that writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WriteFault {
    /// It is done and answered.
    None,
    /// It is answered with 503 and not done.
    Refused,
    /// It is done, and answered with 503.
    AnswerLost,
}

/// Fault of the write with this number, from 0.
type Faults = Arc<dyn Fn(usize) -> WriteFault + Send + Sync>;

#[derive(Default)]
struct Bucket {
    objects: BTreeMap<String, Vec<u8>>,
    writes: usize,
}

#[derive(Clone)]
struct Shared {
    bucket: Arc<Mutex<Bucket>>,
    faults: Faults,
}

/// A running server with one bucket, `night`.
pub struct ObjectStore {
    address: SocketAddr,
    shared: Shared,
}

impl ObjectStore {
    /// Starts a store.
    ///
    /// # Errors
    /// When no port is free or no thread can be started.
    pub fn start(faults: impl Fn(usize) -> WriteFault + Send + Sync + 'static) -> std::io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0))?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let shared = Shared { bucket: Arc::default(), faults: Arc::new(faults) };
        let app = Router::new().fallback(answer).with_state(shared.clone());
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build()?;
        std::thread::spawn(move || {
            runtime.block_on(async {
                let listener = tokio::net::TcpListener::from_std(listener)?;
                axum::serve(listener, app).await
            })
        });
        Ok(Self { address, shared })
    }

    /// Environment variables with which a program reaches the store.
    pub fn variables(&self) -> [(&'static str, String); 5] {
        [
            ("AWS_ENDPOINT_URL", format!("http://{}", self.address)),
            ("AWS_ALLOW_HTTP", "true".into()),
            ("AWS_ACCESS_KEY_ID", "key".into()),
            ("AWS_SECRET_ACCESS_KEY", "secret".into()),
            ("AWS_REGION", "us-east-1".into()),
        ]
    }

    /// The objects whose names begin with a prefix, by the rest of their names.
    pub fn objects(&self, prefix: &str) -> BTreeMap<String, Vec<u8>> {
        let bucket = locked(&self.shared);
        let below = bucket.objects.iter().filter_map(|(name, bytes)| {
            let name = name.strip_prefix(prefix)?;
            Some((name.to_owned(), bytes.clone()))
        });
        below.collect()
    }

    /// Replaces an object, or removes it if `bytes` is `None`.
    pub fn set(&self, name: &str, bytes: Option<&[u8]>) {
        let mut bucket = locked(&self.shared);
        match bytes {
            Some(bytes) => bucket.objects.insert(name.to_owned(), bytes.to_vec()),
            None => bucket.objects.remove(name),
        };
    }
}

fn locked(shared: &Shared) -> MutexGuard<'_, Bucket> {
    shared.bucket.lock().unwrap_or_else(PoisonError::into_inner)
}

async fn answer(
    State(shared): State<Shared>,
    method: Method,
    uri: Uri,
    Query(query): Query<HashMap<String, String>>,
    headers: HeaderMap,
    body: Bytes,
) -> Response {
    let Some(name) = uri.path().strip_prefix("/night").map(|name| name.trim_start_matches('/')) else {
        return problem(StatusCode::NOT_FOUND, "NoSuchBucket");
    };
    let mut bucket = locked(&shared);
    match method {
        Method::GET if query.contains_key("list-type") => {
            list(&bucket, query.get("prefix").map_or("", String::as_str))
        }
        Method::GET | Method::HEAD => match bucket.objects.get(name) {
            Some(bytes) => {
                ([(header::ETAG, etag(bytes)), (header::LAST_MODIFIED, LONG_AGO.into())], bytes.clone())
                    .into_response()
            }
            None => problem(StatusCode::NOT_FOUND, "NoSuchKey"),
        },
        Method::PUT => {
            let fault = (shared.faults)(bucket.writes);
            bucket.writes += 1;
            let busy = || problem(StatusCode::SERVICE_UNAVAILABLE, "SlowDown");
            if fault == WriteFault::Refused {
                return busy();
            }
            if headers.contains_key(header::IF_NONE_MATCH) && bucket.objects.contains_key(name) {
                return problem(StatusCode::PRECONDITION_FAILED, "PreconditionFailed");
            }
            let tag = etag(&body);
            bucket.objects.insert(name.to_owned(), body.to_vec());
            if fault == WriteFault::AnswerLost { busy() } else { [(header::ETAG, tag)].into_response() }
        }
        _ => problem(StatusCode::NOT_IMPLEMENTED, "NotImplemented"),
    }
}

/// A date in the form of HTTP.
const LONG_AGO: &str = "Thu, 01 Jan 2026 00:00:00 GMT";

fn etag(bytes: &[u8]) -> String {
    format!("\"{}\"", bytes.len())
}

fn problem(status: StatusCode, code: &str) -> Response {
    (status, format!("<Error><Code>{code}</Code></Error>")).into_response()
}

fn list(bucket: &Bucket, prefix: &str) -> Response {
    let entries: String = bucket.objects.iter().filter(|(name, _)| name.starts_with(prefix)).map(|(name, bytes)| {
        let size = bytes.len();
        format!("<Contents><Key>{name}</Key><LastModified>2026-01-01T00:00:00Z</LastModified><Size>{size}</Size></Contents>")
    }).collect();
    let body = format!("<ListBucketResult><IsTruncated>false</IsTruncated>{entries}</ListBucketResult>");
    ([(header::CONTENT_TYPE, "application/xml")], body).into_response()
}
