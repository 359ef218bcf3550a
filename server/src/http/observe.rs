//! The outermost layer: request id, access line, metrics, security headers. All problem documents are written
//! here.

use super::access::{AccessLine, AccessSample, ByteCount, CountingBody, TraceParent};
use super::audit::{self, AuditLine, AuditLog};
use super::extract::{self, Connection};
use super::guard::{self, Guard, PROBES};
use super::idempotency::Sender;
use super::pause::RefusalPause;
use super::proxies::ForwardedUser;
use super::tokens::Right;
use api::{Code, Problem, english};
use axum::body::Body;
use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use base::limits::Limits;
use base::party::Party;
use base::problem::{ProblemDoc, Refusal, code_of, status_of};
use base::rates::{PartyRates, RateExceeded};
use base::{id, metrics};
use std::sync::Arc;
use std::time::{Duration, Instant};
use work::Caller;

/// Pause before the reply to a client that is refused for overload.
const REFUSAL_PAUSE: Duration = Duration::from_millis(100);
/// Route label of requests without a route.
const NO_ROUTE: &str = "(none)";
/// Header with the id of a request, which logs and problems repeat.
pub const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");
/// Content policy of pages: only this server's own files.
const PAGE_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
    font-src 'self'; connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; \
    frame-ancestors 'none'";

/// Checks before a handler runs.
#[derive(Clone)]
pub struct RequestGate {
    /// Access rules of the server.
    pub guard: Arc<Guard>,
    /// Limits of a request's head.
    pub limits: Arc<Limits>,
    /// Request rates by party.
    pub rates: Arc<PartyRates>,
    /// Log of changes and refusals.
    pub audit: Option<Arc<AuditLog>>,
    /// Sampler of the access log.
    pub sample: Arc<AccessSample>,
}

impl RequestGate {
    /// Counts a request of a party; `Some` if it exceeds the rate. Probes never do.
    fn exceeded(&self, path: &str, party: Party) -> Option<RateExceeded> {
        if PROBES.contains(&path) {
            return None;
        }
        self.rates.take(party, Instant::now()).err()
    }
}

fn too_many(exceeded: RateExceeded, limits: &Limits) -> Problem {
    let message = english::too_many_requests(limits.party_rate as usize);
    // Rounded up to a full millisecond, so that the wait is long enough.
    let wait_ms = exceeded.wait.as_millis() as u64 + 1;
    Problem::of(Code::TooManyRequests, message).limit(limits.party_rate).retry_after_ms(wait_ms)
}

/// How long a refusal for overload is held back: a client that retries at once would take cores from requests
/// in progress. It is part of the time that the client is asked to wait.
fn hold_of(response: &mut Response) -> Option<Duration> {
    let code = response.extensions().get::<Refusal>().map(|Refusal(problem)| problem.code);
    let is_overload = response.status() == StatusCode::SERVICE_UNAVAILABLE;
    (is_overload || code == Some(Code::TooManyRequests)).then(|| {
        Refusal::hold(response, REFUSAL_PAUSE);
        REFUSAL_PAUSE
    })
}

/// Wraps every request.
pub async fn observe(State(gate): State<RequestGate>, request: Request, next: Next) -> Response {
    let began = Instant::now();
    let id = request_id(request.headers());
    let method = request.method().clone();
    let path = request.uri().path().to_owned();
    let route =
        request.extensions().get::<MatchedPath>().map_or(NO_ROUTE.to_owned(), |p| p.as_str().to_owned());
    let foreign = gate.guard.foreign_origin(&request);
    let pause = request.extensions().get::<RefusalPause>().cloned();
    let edits = Right::needed(&method, &path, request.uri().query()) == Right::Edit;
    let mut sender = sender(&request, &gate.guard);
    let from = sender.party;
    let (trace, received) = (TraceParent::of(request.headers()), ByteCount::default());
    let mut request = request.map(|body| CountingBody::received(body, &received));
    let caller = share(&mut request, &mut sender);
    request.extensions_mut().insert(sender.clone());
    let exceeded = gate.exceeded(&path, sender.party);
    let checked = match exceeded {
        Some(exceeded) => Err(too_many(exceeded, &gate.limits)),
        None => guard::check(&gate.guard, &gate.limits, &request),
    };
    let mut response = match checked {
        Ok(()) if foreign.is_some() && method == Method::OPTIONS => guard::preflight(),
        Ok(()) => work::on_behalf_of(caller, next.run(request)).await,
        Err(problem) => Refusal::from(problem).into_response(),
    };
    let hold = hold_of(&mut response);
    let mut response = written(response, &method, Some(&path), &id);
    dress(response.headers_mut(), &path, &id);
    if let Some(origin) = foreign {
        guard::allow_cross_origin(response.headers_mut(), origin);
    }
    let status = response.status();
    let is_logged = exceeded.is_some_and(|exceeded| exceeded.is_logged);
    if let Some(audit) = gate.audit.filter(|_| is_logged || audit::is_audited(&method, edits, status)) {
        audit.add(&AuditLine {
            time: jiff::Timestamp::now().to_string(),
            who: sender.name.as_deref(),
            from: from.to_string(),
            what: format!("{method} {route}"),
            scene: audit::scene_in(&path).or_else(|| audit::scene_made(response.headers())),
            status: status.as_u16(),
            request_id: &id,
        });
    }
    match (hold, pause) {
        (Some(hold), Some(pause)) if pause.wait(hold).await => {
            response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
        }
        (Some(hold), None) => tokio::time::sleep(hold).await,
        _ => {}
    }
    metrics::request(&route, Some(&method), status, began.elapsed().as_secs_f64());
    let (peer, user) = (Some(from), sender.name);
    let line = AccessLine {
        method: Some(method),
        route,
        status,
        began,
        peer,
        user,
        trace,
        request_id: id,
        received,
    };
    response.map(|body| line.at_end_of(body, Some(gate.sample)))
}

/// Assigns a request to the share of its sender's name if it has one, else to that of its address.
fn share(request: &mut Request, sender: &mut Sender) -> Caller {
    if let Some(name) = &sender.name {
        sender.party = Party::named(name);
    }
    let Some(connection) = request.extensions_mut().get_mut::<Connection>() else { return Caller::default() };
    connection.party = sender.party;
    Caller::from(*connection)
}

/// The sender of a request: the user that a trusted proxy authenticated, else the name of the token.
fn sender(request: &Request, guard: &Guard) -> Sender {
    let extensions = request.extensions();
    let user = extensions.get::<ForwardedUser>().map(|user| user.0.to_string());
    let party = extract::party_of(extensions).unwrap_or_default();
    let (name, is_admin) = match user {
        // The token is then the proxy's.
        Some(user) => (Some(user), None),
        None => guard.bearer(request.headers()).unzip(),
    };
    Sender { name, party, is_admin: is_admin.unwrap_or(false) }
}

/// The refusal of a head that could not be read, so its route, method and id are unknown. The head began to
/// arrive at `began`.
pub fn unread(problem: Problem, began: Instant, peer: Option<Party>) -> Response {
    let id = new_id();
    let mut response = written(Refusal::from(problem).into_response(), &Method::GET, None, &id);
    dress(response.headers_mut(), "/v1/", &id);
    let status = response.status();
    metrics::request(NO_ROUTE, None, status, began.elapsed().as_secs_f64());
    let (route, received) = (NO_ROUTE.to_owned(), ByteCount::default());
    let line = AccessLine {
        method: None,
        route,
        status,
        began,
        peer,
        user: None,
        trace: None,
        request_id: id,
        received,
    };
    response.map(|body| line.at_end_of(body, None))
}

fn request_id(headers: &HeaderMap) -> String {
    match headers.get(REQUEST_ID).and_then(|v| v.to_str().ok()).filter(|given| id::is_id(given)) {
        Some(given) => given.to_owned(),
        None => new_id(),
    }
}

fn new_id() -> String {
    uuid::Uuid::now_v7().simple().to_string()
}

/// Converts a refusal to its problem document; other replies pass.
fn written(mut response: Response, method: &Method, path: Option<&str>, id: &str) -> Response {
    let status = response.status();
    let problem = match response.extensions_mut().remove::<Refusal>() {
        Some(Refusal(problem)) => problem,
        // The page that asks for the token is itself a refusal.
        None if is_page(response.headers()) => return response,
        None if status.is_client_error() || status.is_server_error() => bare(status),
        None => return response,
    };
    if status_of(problem.code) == 500 {
        tracing::error!(code = problem.code.name(), detail = problem.detail, request_id = id, "refused");
    }
    let body = ProblemDoc::of(&problem, path, Some(id)).text();
    let headers = response.headers_mut();
    headers.remove(header::CONTENT_LENGTH);
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("application/problem+json"));
    // HEAD reports the length of GET's reply.
    headers.insert(header::CONTENT_LENGTH, HeaderValue::from(body.len()));
    *response.body_mut() = if method == Method::HEAD { Body::empty() } else { Body::from(body) };
    response
}

/// The problem for a refusal of the lower HTTP layers.
fn bare(status: StatusCode) -> Problem {
    let code = code_of(status.as_u16());
    Problem::new(code, format!("{}.", code.title()))
}

fn dress(headers: &mut HeaderMap, path: &str, id: &str) {
    let fixed = [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    ];
    for (name, value) in fixed {
        headers.entry(name).or_insert(HeaderValue::from_static(value));
    }
    if let Ok(value) = HeaderValue::from_str(id) {
        headers.insert(REQUEST_ID, value);
    }
    if path.starts_with("/v1/") && !headers.contains_key(header::CACHE_CONTROL) {
        headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    }
    if is_page(headers) && !headers.contains_key(header::CONTENT_SECURITY_POLICY) {
        headers.insert(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(PAGE_POLICY));
    }
}

fn is_page(headers: &HeaderMap) -> bool {
    headers.get(header::CONTENT_TYPE).is_some_and(|t| t.as_bytes().starts_with(b"text/html"))
}
