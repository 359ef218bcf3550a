//! The accept loop: a limited number of connections, time limits of request heads, orderly shutdown.
//!
//! `axum::serve` sets no timer, so a client that sends its head slowly would hold a connection for ever. Here
//! hyper's HTTP/1 builder runs with a timer. When all places are taken, the connection that has waited
//! longest without a request makes room. A client that has left is noticed whatever it sent before.

use super::extract::Connection;
use super::pause::RefusalPause;
use super::proxies::{ForwardedUser, TrustedProxies};
use super::stream::{ByteStream, Listener};
use super::wire::{self, PARTING, Socket, Wire};
use super::{observe, owner};
use api::{Code, Problem};
use axum::Router;
use base::base_path;
use base::limits::Limits;
use base::memory::Memory;
use base::party::Party;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::collections::{HashMap, VecDeque};
use std::convert::Infallible;
use std::future::Future;
use std::pin::{Pin, pin};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{Notify, mpsc, watch};

/// Heads up to this size reach our own check, which replies with a problem document.
const HEAD_BUFFER: usize = 128 << 10;
/// Addresses of health probes.
const HEALTH: [&str; 2] = ["/healthz", "/readyz"];
/// Header fields up to this number reach our own check.
const HEAD_FIELDS: usize = 512;

/// Interval of checks of all connections.
const LOOK: Duration = Duration::from_millis(250);
/// Least number of connections beyond all places that are told so; half the places if that is more.
const OVERFLOW: usize = 8;
/// Time for such a client to send its request, and then to close the connection.
const OVERFLOW_TIME: Duration = Duration::from_secs(2);
/// Time to send the refusal on a connection that makes room before its first request.
const TELLING: Duration = Duration::from_millis(50);
/// Time for a new client to send its first request; afterwards its connection can make room for others.
const FIRST_REQUEST: Duration = Duration::from_millis(200);
/// Interval at which such a connection tries to get a place.
const PLACE_LOOK: Duration = Duration::from_millis(50);
/// Interval at which room among the connections beyond all places is checked.
const ROOM_LOOK: Duration = Duration::from_millis(10);
/// Time for a refused client to take its reply after its place was given away.
const HURRY: Duration = Duration::from_millis(500);
/// Time before the arrival rate of a body is known.
const ARRIVING_GRACE: Duration = Duration::from_secs(1);

/// An open connection in the table.
struct ConnectionEntry {
    number: u64,
    socket: Arc<Socket>,
    idle_since: Mutex<Instant>,
    /// Whether a request has arrived.
    has_asked: AtomicBool,
    /// When the reply in progress was last polled; `None` without a reply.
    asked: Mutex<Option<Instant>>,
    /// Progress of the arriving body.
    arriving: Mutex<Option<BodyProgress>>,
    /// Party of the connection.
    party: Party,
    /// Pause before the reply to a refused client.
    pause: RefusalPause,
    close: Notify,
}

/// Bytes of a body so far, and its start.
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
struct ConnectionTable {
    places: Mutex<Vec<Arc<ConnectionEntry>>>,
    next: AtomicU64,
    /// Number of places.
    most: usize,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl ConnectionEntry {
    fn is_busy(&self) -> bool {
        self.socket.requests.load(Ordering::Relaxed) > 0
    }

    /// Whether its client waits for no reply: all its requests are answered, or it took too long to send one.
    fn is_idle(&self) -> bool {
        let is_new =
            || !self.has_asked.load(Ordering::Relaxed) && lock(&self.idle_since).elapsed() < FIRST_REQUEST;
        !self.is_busy() && !is_new() && !self.socket.has_unread()
    }

    /// The form in which its requests carry the connection.
    fn connection(&self, proxies: &TrustedProxies) -> Connection {
        let ends = self.socket.stream().ends();
        let trusted = proxies.trusts(ends.map(|(peer, _)| peer.ip()));
        let strangers = !trusted && ends.is_some_and(|(peer, own)| owner::is_strangers(peer, own));
        Connection { number: self.number, party: self.party, is_line: false, strangers, trusted }
    }

    /// Sends a refusal to a client without a request so far; if it is about to send one, it reads this reply.
    async fn tell_busy(&self) {
        if self.has_asked.load(Ordering::Relaxed) {
            return;
        }
        let since = *lock(&self.idle_since);
        wire::refuse(&self.socket, observe::unread(all_in_use(), since, Some(self.party)), TELLING).await;
    }

    /// Closes the connection. A pending refusal is sent first, if the client takes it soon.
    fn make_room(self: &Arc<Self>) {
        if self.pause.since().is_none() {
            return self.close.notify_one();
        }
        self.pause.hurry();
        let entry = Arc::clone(self);
        tokio::spawn(async move {
            tokio::time::sleep(HURRY).await;
            entry.close.notify_one();
        });
    }
}

impl ConnectionTable {
    fn new(most: usize) -> Self {
        Self { places: Mutex::default(), next: AtomicU64::new(0), most: most.max(1) }
    }

    /// A new connection without a place.
    fn entry(&self, stream: ByteStream, party: Party) -> Arc<ConnectionEntry> {
        Arc::new(ConnectionEntry {
            number: self.next.fetch_add(1, Ordering::Relaxed),
            socket: Arc::new(Socket::new(stream)),
            idle_since: Mutex::new(Instant::now()),
            has_asked: AtomicBool::new(false),
            asked: Mutex::new(None),
            arriving: Mutex::new(None),
            party,
            pause: RefusalPause::default(),
            close: Notify::new(),
        })
    }

    /// Gives a connection a place; false if all places have work in progress. In a full table it replaces the
    /// connection that waits longest for a refusal, else the one idle longest, else the one with the slowest
    /// request. Connections of parties with more than a quarter of all places are replaced first. Such a
    /// party replaces no others; any other party may even replace their newest connection with work in
    /// progress.
    fn admit(&self, new: &Arc<ConnectionEntry>) -> bool {
        let mut places = lock(&self.places);
        if places.len() >= self.most {
            let Some(leaves) = self.leaving(&places, new.party) else { return false };
            leaves.make_room();
            places.retain(|p| p.number != leaves.number);
        }
        places.push(Arc::clone(new));
        true
    }

    /// Gives a connection a place as soon as one is free. Connections without a request so far make room once
    /// they are refused, at the latest after [`FIRST_REQUEST`].
    async fn admit_soon(&self, new: &Arc<ConnectionEntry>) -> bool {
        let until = Instant::now() + FIRST_REQUEST;
        while Instant::now() < until {
            tokio::time::sleep(PLACE_LOOK).await;
            if self.admit(new) {
                return true;
            }
        }
        false
    }

    fn leaving(&self, places: &[Arc<ConnectionEntry>], new: Party) -> Option<Arc<ConnectionEntry>> {
        let mut counts: HashMap<Party, usize> = HashMap::new();
        places.iter().for_each(|p| *counts.entry(p.party).or_default() += 1);
        let is_greedy = |party: Party| counts.get(&party).is_some_and(|count| 4 * count > self.most);
        let greedy: Vec<_> = places.iter().filter(|p| is_greedy(p.party)).cloned().collect();
        let refused = |of: &[Arc<ConnectionEntry>]| {
            of.iter()
                .filter_map(|p| Some((p.pause.since()?, p)))
                .min_by_key(|(since, _)| *since)
                .map(|(_, p)| p.clone())
        };
        let idle = |of: &[Arc<ConnectionEntry>]| {
            let mut oldest: Vec<_> = of.iter().filter(|p| !p.is_busy()).collect();
            oldest.sort_by_cached_key(|p| *lock(&p.idle_since));
            oldest.into_iter().find(|p| p.is_idle()).cloned()
        };
        let slow = |of: &[Arc<ConnectionEntry>]| {
            let rate =
                |p: &Arc<ConnectionEntry>| Some((lock(&p.arriving).and_then(BodyProgress::rate)?, p.clone()));
            of.iter().filter_map(rate).min_by_key(|(rate, _)| *rate).map(|(_, p)| p)
        };
        let of = |some: &[Arc<ConnectionEntry>]| refused(some).or_else(|| idle(some)).or_else(|| slow(some));
        if is_greedy(new) {
            return of(&greedy);
        }
        let newest = || greedy.iter().max_by_key(|p| p.number).cloned();
        of(&greedy).or_else(newest).or_else(|| of(places))
    }

    /// Closes connections whose reader has taken nothing of a reply for this long.
    fn close_stalled(&self, limit: Duration) {
        let stalled = |p: &&Arc<ConnectionEntry>| lock(&p.asked).is_some_and(|asked| asked.elapsed() > limit);
        lock(&self.places).iter().filter(stalled).for_each(|p| p.close.notify_one());
    }

    /// Closes connections whose clients left while a request was processed. Bytes that they sent after it
    /// keep hyper from reading on, so it would not notice.
    fn close_left(&self) {
        let left = |p: &&Arc<ConnectionEntry>| p.is_busy() && p.socket.is_left();
        lock(&self.places).iter().filter(left).for_each(|p| p.close.notify_one());
    }

    fn leave(&self, number: u64) {
        lock(&self.places).retain(|p| p.number != number);
    }
}

/// Connections beyond all places, which are told so, in the order of their arrival.
struct OverflowTable {
    entries: Mutex<VecDeque<Arc<ConnectionEntry>>>,
    most: usize,
}

impl OverflowTable {
    fn new(places: usize) -> Self {
        Self { entries: Mutex::default(), most: OVERFLOW.max(places / 2) }
    }

    /// Waits until another connection fits. In a full table the oldest one that waits for no reply is closed.
    /// Meanwhile newcomers wait in the system's accept queue instead of being closed without a reply.
    async fn room(&self) {
        while !self.has_room() {
            tokio::time::sleep(ROOM_LOOK).await;
        }
    }

    fn has_room(&self) -> bool {
        let mut entries = lock(&self.entries);
        if entries.len() >= self.most
            && let Some(at) = entries.iter().position(|entry| entry.is_idle())
            && let Some(oldest) = entries.remove(at)
        {
            oldest.close.notify_one();
        }
        entries.len() < self.most
    }

    fn enter(&self, new: &Arc<ConnectionEntry>) {
        lock(&self.entries).push_back(Arc::clone(new));
    }

    fn leave(&self, number: u64) {
        lock(&self.entries).retain(|entry| entry.number != number);
    }
}

/// Marks a connection as busy while a request runs.
pub struct Busy(Arc<ConnectionEntry>);

impl Busy {
    fn new(place: &Arc<ConnectionEntry>) -> Self {
        place.socket.requests.fetch_add(1, Ordering::Relaxed);
        place.has_asked.store(true, Ordering::Relaxed);
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
    user: Option<ForwardedUser>,
    place: Arc<ConnectionEntry>,
    closing: watch::Receiver<bool>,
    /// Limits.
    pub limits: Arc<Limits>,
    /// Memory for arriving and waiting WebSocket messages.
    pub memory: Arc<Memory>,
    /// Longest time for which a reader may leave data waiting.
    pub patience: Duration,
    /// The connection is in use until all clones are dropped.
    _in_use: mpsc::Sender<Infallible>,
}

impl Carrier {
    /// Answers a request as if it came by this connection, which is busy until the reply's companion is
    /// dropped.
    pub async fn ask(&self, mut request: axum::extract::Request) -> (axum::response::Response, Busy) {
        let busy = Busy::new(&self.place);
        request.extensions_mut().insert(Connection { is_line: true, ..self.connection });
        if let Some(user) = &self.user {
            request.extensions_mut().insert(user.clone());
        }
        let Ok(reply) = tower::ServiceExt::oneshot(self.router.clone(), request).await;
        (reply, busy)
    }

    /// Resolves when the server is asked to shut down.
    pub async fn closes(&mut self) {
        let _ = self.closing.wait_for(|closing| *closing).await;
    }
}

/// Serves until `stop` completes, then gives running requests `limits.shutdown_s` to end.
///
/// `on_stop` is called after that time and cancels the remaining ones.
pub async fn serve(
    listener: Listener,
    router: Router,
    proxies: TrustedProxies,
    (limits, memory): (&Limits, &Arc<Memory>),
    stop: impl Future<Output = ()>,
    on_stop: impl FnOnce(),
) {
    let table = Arc::new(ConnectionTable::new(limits.connections as usize));
    let overflow = Arc::new(OverflowTable::new(limits.connections as usize));
    let (closing, closed) = watch::channel(false);
    // A stream is polled at each heartbeat, so a longer silence is caused by the reader.
    let stalled = Duration::from_secs(limits.stalled_s.max(limits.heartbeat_s + 1));
    let mut look = tokio::time::interval(LOOK);
    let (bounds, proxies) = ((Arc::new(limits.clone()), Arc::clone(memory)), Arc::new(proxies));
    let mut stop = pin!(stop);
    loop {
        let accepted = tokio::select! {
            () = &mut stop => break,
            _ = look.tick() => {
                table.close_stalled(stalled);
                table.close_left();
                continue;
            }
            accepted = async {
                overflow.room().await;
                listener.accept().await
            } => accepted,
        };
        let stream = match accepted {
            Ok(accepted) => accepted,
            Err(error) => {
                // Out of file descriptors, or a peer that left: the next accept may succeed.
                tracing::warn!(%error, "accept failed");
                tokio::time::sleep(Duration::from_millis(50)).await;
                continue;
            }
        };
        let party = stream.party();
        let place = table.entry(stream, party);
        let is_beyond = !table.admit(&place);
        if is_beyond {
            overflow.enter(&place);
        }
        let (table, overflow) = (Arc::clone(&table), Arc::clone(&overflow));
        let (router, closed) = (router.clone(), closed.clone());
        let (bounds, proxies) = (bounds.clone(), Arc::clone(&proxies));
        tokio::spawn(async move {
            if is_beyond {
                let is_admitted = tokio::select! {
                    is_admitted = table.admit_soon(&place) => is_admitted,
                    () = place.close.notified() => {
                        place.tell_busy().await;
                        return overflow.leave(place.number);
                    }
                };
                if !is_admitted {
                    drop(closed);
                    let answered = answer_health(router, place.connection(&proxies), &place);
                    // A request that has arrived meanwhile is answered, however late this task is scheduled.
                    tokio::select! {
                        biased;
                        () = answered => {}
                        () = time_is_up(&place) => place.tell_busy().await,
                        () = place.close.notified() => place.tell_busy().await,
                    }
                    return overflow.leave(place.number);
                }
                overflow.leave(place.number);
            }
            connection(router, &place, &proxies, closed, &bounds, stalled).await;
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

fn all_in_use() -> Problem {
    Problem::new(Code::Busy, "All connections of the server are in use.").retry_after(1)
}

/// Resolves when a connection beyond all places has had its time, and no reply is in progress.
async fn time_is_up(place: &ConnectionEntry) {
    tokio::time::sleep(OVERFLOW_TIME).await;
    while place.is_busy() {
        tokio::time::sleep(ROOM_LOOK).await;
    }
}

/// Answers one request of a connection beyond all places: a health probe, or else a refusal.
async fn answer_health(router: Router, connection: Connection, place: &Arc<ConnectionEntry>) {
    let service = tower::service_fn(|mut request: hyper::Request<hyper::body::Incoming>| {
        let (router, busy) = (router.clone(), Busy::new(place));
        async move {
            let path = request.uri().path();
            let reply = if HEALTH.contains(&base_path::within(path).unwrap_or(path)) {
                request.extensions_mut().insert(connection);
                tower::ServiceExt::oneshot(router, request.map(axum::body::Body::new)).await?
            } else {
                observe::unread(all_in_use(), Instant::now(), Some(connection.party))
            };
            Ok::<_, Infallible>(reply.map(|body| CountedBody { body, busy }))
        }
    });
    let mut http = hyper::server::conn::http1::Builder::new();
    http.keep_alive(false).max_headers(HEAD_FIELDS).max_buf_size(HEAD_BUFFER);
    let wire = TokioIo::new(Wire(Arc::clone(&place.socket)));
    let _ = http.serve_connection(wire, TowerToHyperService::new(service)).await;
    place.socket.part().await;
}

async fn connection(
    router: Router,
    place: &Arc<ConnectionEntry>,
    proxies: &Arc<TrustedProxies>,
    mut closed: watch::Receiver<bool>,
    (limits, memory): &(Arc<Limits>, Arc<Memory>),
    patience: Duration,
) {
    let socket = &place.socket;
    let counted = Arc::clone(place);
    let connection = place.connection(proxies);
    let proxies = Arc::clone(proxies);
    let (held, mut in_use) = mpsc::channel(1);
    let carrier = Carrier {
        router: router.clone(),
        connection,
        user: None,
        place: Arc::clone(place),
        closing: closed.clone(),
        limits: Arc::clone(limits),
        memory: Arc::clone(memory),
        patience,
        _in_use: held,
    };
    let service = tower::service_fn(move |mut request: hyper::Request<hyper::body::Incoming>| {
        let (connection, user) = match connection.trusted {
            true => proxies.seen(connection, request.headers()),
            false => (connection, None),
        };
        let extensions = request.extensions_mut();
        extensions.insert(connection);
        extensions.insert(counted.pause.clone());
        if let Some(user) = &user {
            extensions.insert(user.clone());
        }
        if request.headers().contains_key(hyper::header::UPGRADE) {
            request.extensions_mut().insert(Carrier { connection, user, ..carrier.clone() });
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
        // Pending input and output come before the end, however late this task is scheduled.
        tokio::select! {
            biased;
            result = &mut served => {
                let Err(error) = result else { break };
                tracing::debug!(%error, "connection ended");
                let unread = served.into_parts().map(|parts| parts.read_buf).unwrap_or_default();
                let Some(problem) = wire::refusal(socket, &error, limits, &unread) else { return };
                let since = *lock(&place.idle_since);
                wire::refuse(socket, observe::unread(problem, since, Some(place.party)), PARTING).await;
                return;
            }
            () = place.close.notified() => return place.tell_busy().await,
            _ = closed.changed(), if !draining => {
                draining = true;
                Pin::new(&mut served).graceful_shutdown();
            }
        }
    }
    // It may have become a WebSocket.
    drop(served);
    tokio::select! {
        _ = in_use.recv() => {}
        () = place.close.notified() => return socket.end(),
    }
    if !draining {
        tokio::select! {
            () = socket.part() => {}
            () = place.close.notified() => {}
        }
    }
}

/// Body of a request whose progress is recorded.
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

/// Body of a reply; its connection counts as busy until it is sent.
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
