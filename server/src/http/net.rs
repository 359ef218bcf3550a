//! The accept loop: bounded connections, time limits on request heads, orderly end.
//!
//! `axum::serve` sets no timer, so a client that dribbles its head would hold a connection for ever.
//! Here hyper's HTTP/1 builder runs with a timer, and when all places are taken the connection that
//! has waited longest without a request makes room. A client that has left is noticed whatever it sent before.

use super::extract::Connection;
use super::wire::{self, Socket, Wire};
use super::{observe, owner};
use crate::base::limits::Limits;
use axum::Router;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::convert::Infallible;
use std::future::Future;
use std::pin::{Pin, pin};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, mpsc, watch};

/// Heads up to this size reach our own check, which answers with a problem document.
const HEAD_BUFFER: usize = 128 << 10;
/// Header fields up to this number reach our own check.
const HEAD_FIELDS: usize = 512;

/// Time between two looks at all connections.
const LOOK: Duration = Duration::from_millis(250);
/// Before this the arrival rate of a body is unknown.
const ARRIVING_GRACE: Duration = Duration::from_secs(1);

/// One open connection, as the table sees it.
struct ConnectionEntry {
    number: u64,
    socket: Arc<Socket>,
    idle_since: Mutex<Instant>,
    /// Time at which the reply in progress was last polled for more; `None` without one.
    asked: Mutex<Option<Instant>>,
    /// The body that is arriving.
    arriving: Mutex<Option<BodyProgress>>,
    close: Notify,
}

/// Bytes of a body so far, and when it began.
#[derive(Clone, Copy)]
struct BodyProgress {
    began: Instant,
    bytes: u64,
}

impl BodyProgress {
    /// Bytes per second so far; `None` during the grace period.
    fn rate(self) -> Option<u64> {
        let time = self.began.elapsed();
        (time > ARRIVING_GRACE).then(|| (self.bytes as f64 / time.as_secs_f64()) as u64)
    }
}

/// All open connections.
#[derive(Default)]
struct ConnectionTable {
    places: Mutex<Vec<Arc<ConnectionEntry>>>,
    next: AtomicU64,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl ConnectionEntry {
    fn is_busy(&self) -> bool {
        self.socket.requests.load(Ordering::Relaxed) > 0
    }
}

impl ConnectionTable {
    /// A place for a new connection. A full table closes the connection that is idle longest, else the one
    /// with the slowest request. `None` if work is under way on all of them.
    fn enter(&self, stream: TcpStream, most: usize) -> Option<Arc<ConnectionEntry>> {
        let mut places = lock(&self.places);
        if places.len() >= most {
            let oldest = places.iter().filter(|p| !p.is_busy()).min_by_key(|p| *lock(&p.idle_since));
            let slow = |p: &Arc<ConnectionEntry>| {
                Some((lock(&p.arriving).and_then(BodyProgress::rate)?, Arc::clone(p)))
            };
            let slowest = || places.iter().filter_map(slow).min_by_key(|(rate, _)| *rate).map(|(_, p)| p);
            let leaves = oldest.cloned().or_else(slowest)?;
            leaves.close.notify_one();
            places.retain(|p| p.number != leaves.number);
        }
        let place = Arc::new(ConnectionEntry {
            number: self.next.fetch_add(1, Ordering::Relaxed),
            socket: Arc::new(Socket::new(stream)),
            idle_since: Mutex::new(Instant::now()),
            asked: Mutex::new(None),
            arriving: Mutex::new(None),
            close: Notify::new(),
        });
        places.push(Arc::clone(&place));
        Some(place)
    }

    /// Closes connections whose reader has taken nothing of a reply for this long.
    fn close_stalled(&self, limit: Duration) {
        let stalled = |p: &&Arc<ConnectionEntry>| lock(&p.asked).is_some_and(|asked| asked.elapsed() > limit);
        lock(&self.places).iter().filter(stalled).for_each(|p| p.close.notify_one());
    }

    /// Closes connections that their clients have ended while a request was worked on. What they sent behind it
    /// keeps hyper from reading on, so that it would not notice.
    fn close_left(&self) {
        let left = |p: &&Arc<ConnectionEntry>| p.is_busy() && p.socket.is_left();
        lock(&self.places).iter().filter(left).for_each(|p| p.close.notify_one());
    }

    fn leave(&self, number: u64) {
        lock(&self.places).retain(|p| p.number != number);
    }
}

/// Counts a request of a connection while it runs.
pub struct Busy(Arc<ConnectionEntry>);

impl Busy {
    fn new(place: &Arc<ConnectionEntry>) -> Self {
        place.socket.requests.fetch_add(1, Ordering::Relaxed);
        Self(Arc::clone(place))
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        *lock(&self.0.idle_since) = Instant::now();
        *lock(&self.0.asked) = None;
        self.0.socket.requests.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Extension of a request that may upgrade its connection to a WebSocket (`super::line`).
#[derive(Clone)]
pub struct Carrier {
    router: Router,
    connection: Connection,
    place: Arc<ConnectionEntry>,
    closing: watch::Receiver<bool>,
    /// Bounds.
    pub limits: Arc<Limits>,
    /// Longest time for which a reader may leave something waiting.
    pub patience: Duration,
    /// The connection is in use until all of these are gone.
    _in_use: mpsc::Sender<Infallible>,
}

impl Carrier {
    /// Answers a request as one that came by this connection, which is busy until what comes with the reply is gone.
    pub async fn ask(&self, mut request: axum::extract::Request) -> (axum::response::Response, Busy) {
        let busy = Busy::new(&self.place);
        request.extensions_mut().insert(self.connection);
        let Ok(reply) = tower::ServiceExt::oneshot(self.router.clone(), request).await;
        (reply, busy)
    }

    /// Resolves when the server is asked to end.
    pub async fn closes(&mut self) {
        let _ = self.closing.wait_for(|closing| *closing).await;
    }
}

/// Serves until `stop` completes, then lets running requests end for `limits.shutdown_s`.
///
/// `on_stop` is called when the grace is over and cancels what still runs.
pub async fn serve(
    listener: TcpListener,
    router: Router,
    limits: &Limits,
    stop: impl Future<Output = ()>,
    on_stop: impl FnOnce(),
) {
    let table = Arc::new(ConnectionTable::default());
    let (closing, closed) = watch::channel(false);
    // A stream polls again at each heartbeat, so a longer silence is the reader's.
    let stalled = Duration::from_secs(limits.stalled_s.max(limits.heartbeat_s + 1));
    let mut look = tokio::time::interval(LOOK);
    let limits = Arc::new(limits.clone());
    let mut stop = pin!(stop);
    loop {
        let accepted = tokio::select! {
            () = &mut stop => break,
            _ = look.tick() => {
                table.close_stalled(stalled);
                table.close_left();
                continue;
            }
            accepted = listener.accept() => accepted,
        };
        let stream = match accepted {
            Ok((stream, _)) => stream,
            Err(error) => {
                // Out of file descriptors, or a peer that left: the next one may be fine.
                tracing::warn!(%error, "accept failed");
                tokio::time::sleep(Duration::from_millis(50)).await;
                continue;
            }
        };
        let Some(place) = table.enter(stream, limits.connections as usize) else { continue };
        let (table, router, closed) = (Arc::clone(&table), router.clone(), closed.clone());
        let limits = Arc::clone(&limits);
        tokio::spawn(async move {
            connection(router, &place, closed, &limits, stalled).await;
            table.leave(place.number);
        });
    }
    drop(listener);
    drop(closed);
    let _ = closing.send(true);
    let grace = Duration::from_secs(limits.shutdown_s);
    if tokio::time::timeout(grace, closing.closed()).await.is_err() {
        on_stop();
        let _ = tokio::time::timeout(Duration::from_secs(2), closing.closed()).await;
    }
}

async fn connection(
    router: Router,
    place: &Arc<ConnectionEntry>,
    mut closed: watch::Receiver<bool>,
    limits: &Arc<Limits>,
    patience: Duration,
) {
    let socket = &place.socket;
    let counted = Arc::clone(place);
    let ends = socket.stream().peer_addr().ok().zip(socket.stream().local_addr().ok());
    let strangers = ends.is_some_and(|(peer, own)| owner::is_strangers(peer, own));
    let connection = Connection { number: place.number, strangers };
    let (held, mut in_use) = mpsc::channel(1);
    let carrier = Carrier {
        router: router.clone(),
        connection,
        place: Arc::clone(place),
        closing: closed.clone(),
        limits: Arc::clone(limits),
        patience,
        _in_use: held,
    };
    let service = tower::service_fn(move |mut request: hyper::Request<hyper::body::Incoming>| {
        request.extensions_mut().insert(connection);
        if request.headers().contains_key(hyper::header::UPGRADE) {
            request.extensions_mut().insert(carrier.clone());
        }
        let busy = Busy::new(&counted);
        let place = Arc::clone(&counted);
        let request = request.map(|body| axum::body::Body::new(Arriving { body, place }));
        let reply = tower::ServiceExt::oneshot(router.clone(), request);
        async move { reply.await.map(|reply| reply.map(|body| CountedBody { body, busy })) }
    });
    let mut http = hyper::server::conn::http1::Builder::new();
    http.timer(TokioTimer::new())
        .header_read_timeout(Duration::from_secs(limits.header_read_s.max(1)))
        .max_headers(HEAD_FIELDS)
        .max_buf_size(HEAD_BUFFER);
    let wire = TokioIo::new(Wire(Arc::clone(socket)));
    let mut served = http.serve_connection(wire, TowerToHyperService::new(service)).with_upgrades();
    let mut draining = false;
    loop {
        tokio::select! {
            result = &mut served => {
                let Err(error) = result else { break };
                tracing::debug!(%error, "connection ended");
                let unread = served.into_parts().map(|parts| parts.read_buf).unwrap_or_default();
                let Some(problem) = wire::refusal(socket, &error, limits, &unread) else { return };
                let since = *lock(&place.idle_since);
                wire::refuse(socket, observe::unread(problem, since.elapsed().as_secs_f64())).await;
                return;
            }
            () = place.close.notified() => return,
            _ = closed.changed(), if !draining => {
                draining = true;
                Pin::new(&mut served).graceful_shutdown();
            }
        }
    }
    // A line may have been made of it.
    drop(served);
    tokio::select! {
        _ = in_use.recv() => {}
        () = place.close.notified() => socket.end(),
    }
}

/// Body of a request, with its progress recorded.
struct Arriving {
    body: hyper::body::Incoming,
    place: Arc<ConnectionEntry>,
}

impl hyper::body::Body for Arriving {
    type Data = bytes::Bytes;
    type Error = hyper::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut std::task::Context<'_>,
    ) -> std::task::Poll<Option<Result<hyper::body::Frame<bytes::Bytes>, hyper::Error>>> {
        let polled = Pin::new(&mut self.body).poll_frame(context);
        let mut arriving = lock(&self.place.arriving);
        let progress = arriving.get_or_insert(BodyProgress { began: Instant::now(), bytes: 0 });
        match &polled {
            std::task::Poll::Ready(Some(Ok(frame))) => {
                progress.bytes += frame.data_ref().map_or(0, |data| data.len() as u64);
            }
            std::task::Poll::Ready(_) => *arriving = None,
            std::task::Poll::Pending => {}
        }
        drop(arriving);
        polled
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> hyper::body::SizeHint {
        self.body.size_hint()
    }
}

impl Drop for Arriving {
    fn drop(&mut self) {
        *lock(&self.place.arriving) = None;
    }
}

/// A reply's body that keeps its connection marked as busy until it is sent.
struct CountedBody {
    body: axum::body::Body,
    busy: Busy,
}

impl hyper::body::Body for CountedBody {
    type Data = bytes::Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut std::task::Context<'_>,
    ) -> std::task::Poll<Option<Result<hyper::body::Frame<bytes::Bytes>, axum::Error>>> {
        *lock(&self.busy.0.asked) = Some(Instant::now());
        Pin::new(&mut self.body).poll_frame(context)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> hyper::body::SizeHint {
        self.body.size_hint()
    }
}
