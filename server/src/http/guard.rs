//! Access rules of a server on this machine: Host, Origin, Sec-Fetch-Site, token, sizes of the head.
//!
//! A web page can point its own name at 127.0.0.1, so the Host decides first, on every address.

use super::extract::Connection;
use super::tokens::{Right, TokenList};
use api::{Code, Problem};
use axum::extract::Request;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::limits::Limits;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

/// Addresses that monitoring uses.
pub const PROBES: [&str; 3] = ["/healthz", "/readyz", "/metrics"];

/// Access rules from the command line.
#[derive(Clone, Debug, Default)]
pub struct Guard {
    /// Hosts with their port, in lower case.
    hosts: Vec<String>,
    /// This server's own origins.
    own_origins: Vec<String>,
    /// Origins given with `--allow-origin`.
    foreign_origins: Vec<String>,
    /// Whether any Host is accepted: the address is only for probes.
    any_host: bool,
    /// Bearer tokens, if one is required.
    pub tokens: Option<Arc<TokenList>>,
}

impl Guard {
    /// Rules of a server bound to an address or a unix socket.
    ///
    /// # Errors
    /// A sentence if an origin is `*` or `null`.
    pub fn new(
        address: Option<SocketAddr>,
        allow_hosts: &[String],
        allow_origins: &[String],
        tokens: Option<Arc<TokenList>>,
    ) -> Result<Self, String> {
        let port = address.map_or(80, |address| address.port());
        let mut names = vec!["127.0.0.1".to_owned(), "localhost".to_owned(), "[::1]".to_owned()];
        match address.map(|address| address.ip()) {
            Some(IpAddr::V4(ip)) if !ip.is_unspecified() => names.push(ip.to_string()),
            Some(IpAddr::V6(ip)) if !ip.is_unspecified() => names.push(format!("[{ip}]")),
            _ => {}
        }
        let mut hosts: Vec<String> = names.iter().map(|name| format!("{name}:{port}")).collect();
        if port == 80 {
            hosts.extend(names);
        }
        hosts.extend(allow_hosts.iter().map(|h| h.to_ascii_lowercase()));
        if let Some(bad) = allow_origins.iter().find(|o| *o == "*" || *o == "null" || !o.contains("://")) {
            return Err(format!("\"{bad}\" is no origin; give one such as https://tools.example"));
        }
        let own_origins =
            hosts.iter().flat_map(|h| [format!("http://{h}"), format!("https://{h}")]).collect();
        let foreign_origins = allow_origins.iter().map(|o| o.to_ascii_lowercase()).collect();
        Ok(Self { hosts, own_origins, foreign_origins, any_host: false, tokens })
    }

    /// Rules of an address for probes, which may use any Host.
    pub fn for_probes() -> Self {
        Self { any_host: true, ..Self::default() }
    }

    /// Name of a request's token, and whether it is an administrator's.
    pub fn bearer(&self, headers: &HeaderMap) -> Option<(String, bool)> {
        self.tokens.as_ref()?.bearer(headers, |token| (token.name.clone(), token.is_admin())).ok()
    }

    /// The tokens, if a request for a page has none of them.
    pub fn closed_to(&self, headers: &HeaderMap) -> Option<&TokenList> {
        self.tokens.as_deref().filter(|tokens| tokens.bearer(headers, |_| ()).is_err())
    }

    /// The request's Origin, if it was given with `--allow-origin`.
    pub fn foreign_origin(&self, request: &Request) -> Option<HeaderValue> {
        let origin = request.headers().get(header::ORIGIN)?;
        let name = origin.to_str().ok()?.to_ascii_lowercase();
        self.foreign_origins.contains(&name).then(|| origin.clone())
    }

    fn origin_allowed(&self, origin: &str) -> bool {
        let origin = origin.to_ascii_lowercase();
        self.own_origins.contains(&origin) || self.foreign_origins.contains(&origin)
    }
}

/// Allows pages of this origin to read the reply; never with credentials.
pub fn allow_cross_origin(headers: &mut HeaderMap, origin: HeaderValue) {
    headers.insert(header::ACCESS_CONTROL_ALLOW_ORIGIN, origin);
    headers.append(header::VARY, HeaderValue::from_static("Origin"));
    let exposed =
        "ETag, Location, Retry-After, X-Request-Id, Dragtraffic-Loss, Dragtraffic-Losses, Dragtraffic-Scene";
    headers.insert(header::ACCESS_CONTROL_EXPOSE_HEADERS, HeaderValue::from_static(exposed));
}

/// Reply to a browser's preflight request.
pub fn preflight() -> Response {
    let head = [
        (header::ACCESS_CONTROL_ALLOW_METHODS, "GET, HEAD, POST, PUT, PATCH, DELETE"),
        (
            header::ACCESS_CONTROL_ALLOW_HEADERS,
            "Content-Type, Content-Encoding, Accept, Authorization, If-Match, If-None-Match, X-Request-Id, \
             Idempotency-Key",
        ),
        (header::ACCESS_CONTROL_MAX_AGE, "600"),
    ];
    (StatusCode::NO_CONTENT, head).into_response()
}

/// Refuses requests that must not reach a handler.
///
/// # Errors
/// The problem to reply with.
pub fn check(guard: &Guard, limits: &Limits, request: &Request) -> Result<(), Problem> {
    check_size(limits, request)?;
    check_host(guard, request)?;
    check_origin(guard, request)?;
    check_token(guard, request)
}

fn check_size(limits: &Limits, request: &Request) -> Result<(), Problem> {
    let uri = request.uri().path_and_query().map_or(0, |p| p.as_str().len()) as u64;
    if uri > limits.uri_bytes {
        let detail = format!("The address has {uri} bytes; at most {}.", limits.uri_bytes);
        return Err(Problem::new(Code::UriTooLong, detail).limit(limits.uri_bytes));
    }
    let headers = request.headers();
    let bytes: usize = headers.iter().map(|(name, value)| name.as_str().len() + value.len() + 4).sum();
    if headers.len() as u64 > limits.header_fields {
        let detail = format!("{} header fields; at most {}.", headers.len(), limits.header_fields);
        return Err(Problem::new(Code::HeadersTooLarge, detail).limit(limits.header_fields));
    }
    if bytes as u64 > limits.header_bytes {
        let detail = format!("{bytes} bytes of header fields; at most {}.", limits.header_bytes);
        return Err(Problem::new(Code::HeadersTooLarge, detail).limit(limits.header_bytes));
    }
    Ok(())
}

fn check_host(guard: &Guard, request: &Request) -> Result<(), Problem> {
    let mut given = request.headers().get_all(header::HOST).iter();
    let (Some(host), None) = (given.next(), given.next()) else {
        return Err(Problem::new(Code::BadHost, "Exactly one Host header is needed."));
    };
    let allowed = |host: &str| {
        let host = host.to_ascii_lowercase();
        // A full name may end with a dot (RFC 3986, 3.2.2).
        let undotted = match host.rsplit_once(':') {
            Some((name, port)) => format!("{}:{port}", name.strip_suffix('.').unwrap_or(name)),
            None => host.strip_suffix('.').unwrap_or(&host).to_owned(),
        };
        guard.hosts.contains(&undotted)
    };
    let host = host.to_str().unwrap_or_default();
    let authority_fits = request.uri().authority().is_none_or(|a| allowed(a.as_str()));
    if guard.any_host || allowed(host) && authority_fits {
        return Ok(());
    }
    Err(Problem::new(Code::HostNotAllowed, "This server does not answer for that Host."))
}

fn check_origin(guard: &Guard, request: &Request) -> Result<(), Problem> {
    let headers = request.headers();
    // Browsers open WebSockets to other sites without a preflight, and let any page read the messages.
    let reads = matches!(*request.method(), Method::GET | Method::HEAD | Method::OPTIONS)
        && !headers.contains_key(header::UPGRADE);
    let origins: Vec<&str> =
        headers.get_all(header::ORIGIN).iter().map(|o| o.to_str().unwrap_or_default()).collect();
    let origin_ok = origins.iter().all(|o| guard.origin_allowed(o));
    if !reads && (!origin_ok || origins.len() > 1) {
        return Err(Problem::new(Code::BadOrigin, "Requests of that Origin are refused."));
    }
    let from_allowed = !origins.is_empty() && origin_ok;
    let site = headers.get("sec-fetch-site").map(|v| v.to_str().unwrap_or("cross-site"));
    let foreign = site.is_some_and(|s| s != "same-origin" && s != "none");
    let guarded = !reads || request.uri().path().starts_with("/v1/");
    if foreign && guarded && !from_allowed {
        return Err(Problem::new(Code::CrossSite, "Requests on behalf of another site are refused."));
    }
    Ok(())
}

fn check_token(guard: &Guard, request: &Request) -> Result<(), Problem> {
    let path = request.uri().path();
    let open = !path.starts_with("/v1") && !["/metrics", "/readyz", "/openapi.json"].contains(&path);
    if open || request.method() == Method::OPTIONS {
        return Ok(());
    }
    let Some(tokens) = &guard.tokens else {
        let strangers = request.extensions().get::<Connection>().is_some_and(|by| by.strangers);
        let detail = "This connection belongs to another user of this machine: it needs the token of a \
            server that was started with --token-file.";
        return if strangers { Err(Problem::new(Code::Unauthorized, detail)) } else { Ok(()) };
    };
    let needed = Right::needed(request.method(), path, request.uri().query());
    tokens.bearer(request.headers(), |token| token.allow(needed))?
}

#[cfg(test)]
mod tests {
    use super::{Guard, check};
    use axum::body::Body;
    use axum::extract::Request;
    use base::limits::Limits;

    fn verdict(method: &str, headers: &[(&str, &str)]) -> Option<&'static str> {
        let origins = ["https://tools.example".to_owned()];
        let address = "127.0.0.1:8080".parse().ok();
        let guard = Guard::new(address, &[], &origins, None).unwrap();
        let mut request = Request::builder().method(method).uri("/v1/scenes");
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        let request = request.body(Body::empty()).unwrap();
        check(&guard, &Limits::default(), &request).err().map(|p| p.code.name())
    }

    #[test]
    fn host_matrix() {
        for host in ["127.0.0.1:8080", "localhost:8080", "LocalHost:8080", "[::1]:8080", "localhost.:8080"] {
            assert_eq!(verdict("GET", &[("host", host)]), None, "{host}");
        }
        for host in
            ["evil.example:8080", "localhost", "127.0.0.1:9", "localhost..:8080", "127.0.0.1.nip.io:8080"]
        {
            assert_eq!(verdict("GET", &[("host", host)]), Some("host-not-allowed"), "{host}");
        }
        assert_eq!(verdict("GET", &[]), Some("bad-host"));
        let twice = [("host", "localhost:8080"), ("host", "localhost:8080")];
        assert_eq!(verdict("GET", &twice), Some("bad-host"));
    }

    #[test]
    fn origin_matrix() {
        let host = ("host", "localhost:8080");
        for origin in ["http://localhost:8080", "http://127.0.0.1:8080", "https://tools.example"] {
            assert_eq!(verdict("POST", &[host, ("origin", origin)]), None, "{origin}");
        }
        for origin in ["null", "*", "http://evil.example", "http://localhost:9", "https://tools.example.evil"]
        {
            assert_eq!(verdict("POST", &[host, ("origin", origin)]), Some("bad-origin"), "{origin}");
        }
        assert_eq!(verdict("POST", &[host]), None);
        let cross = ("sec-fetch-site", "cross-site");
        assert_eq!(verdict("GET", &[host, cross]), Some("cross-site"));
        assert_eq!(verdict("POST", &[host, cross]), Some("cross-site"));
        assert_eq!(verdict("POST", &[host, ("sec-fetch-site", "same-origin")]), None);
    }

    #[test]
    fn star_is_no_origin() {
        let address = "127.0.0.1:1".parse().ok();
        assert!(Guard::new(address, &[], &["*".into()], None).is_err());
        assert!(Guard::new(address, &[], &["null".into()], None).is_err());
    }
}
