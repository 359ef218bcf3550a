//! Sign-in for browsers: a page that takes a token, and a cookie that represents it. Scripts send the token
//! itself.

use super::tokens::TokenList;
use axum::body::Body;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use base::base_path::published;
use scene::ContentHash;
use std::time::Duration;

/// The page, in which [`STATUS`] is replaced.
const PAGE: &str = include_str!("sign_in.html");
const STATUS: &str = "<!-- status -->";
/// Content policy: the page may show itself and send its form to this server.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'; \
    frame-ancestors 'none'";
/// Lifetime of a browser session, seconds.
const STAYS_S: u32 = 7 * 24 * 3600;
/// Most bytes of a form, and the time in which it must arrive.
const FORM_BYTES: usize = 8 << 10;
const FORM_TIME: Duration = Duration::from_secs(5);

/// The cookie for a token. It identifies the token without containing it: a new token ends all sessions, a
/// restart ends none.
#[derive(Clone, Debug)]
pub struct SessionCookie {
    /// Servers on other ports share the browser's cookies, so each token has its own cookie name.
    name: String,
    value: String,
}

impl SessionCookie {
    /// The cookie for this token.
    pub fn of(token: &str) -> Self {
        let derived = |purpose: &str| ContentHash::of(&("dragtraffic session cookie", purpose, token));
        let (name, value) = (derived("name").short(), derived("value").hex());
        Self { name: format!("dragtraffic-{name}"), value }
    }

    /// Whether the request carries this cookie.
    pub fn is_in(&self, headers: &HeaderMap) -> bool {
        let fields = headers.get_all(header::COOKIE).iter().filter_map(|field| field.to_str().ok());
        let pairs = fields.flat_map(|field| field.split(';')).filter_map(|pair| pair.trim().split_once('='));
        let own = pairs.filter(|(name, _)| *name == self.name);
        own.fold(false, |is_in, (_, value)| is_in | same_bytes(value.as_bytes(), self.value.as_bytes()))
    }

    /// The header that sets it; over TLS it is marked secure.
    fn field(&self, secure: bool) -> Option<HeaderValue> {
        let secure = if secure { "; Secure" } else { "" };
        let (Self { name, value }, path) = (self, published("/"));
        let field =
            format!("{name}={value}; Path={path}; HttpOnly; SameSite=Strict; Max-Age={STAYS_S}{secure}");
        HeaderValue::from_str(&field).ok()
    }
}

/// The page that asks for the token.
pub fn page(status: &str) -> Response {
    let head = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8"),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::CACHE_CONTROL, "no-store"),
        (header::WWW_AUTHENTICATE, "Bearer"),
        // Without a referrer browsers send the form with the Origin `null`, which is refused.
        (header::REFERRER_POLICY, "same-origin"),
    ];
    (StatusCode::UNAUTHORIZED, head, PAGE.replace(STATUS, status)).into_response()
}

/// Answers the page's form: back to the same address with the cookie, if the token is valid.
pub async fn enter(tokens: &TokenList, address: &str, headers: &HeaderMap, body: Body) -> Response {
    let form = tokio::time::timeout(FORM_TIME, axum::body::to_bytes(body, FORM_BYTES)).await;
    let Ok(Ok(form)) = form else { return page("The form did not arrive. Try again.") };
    let mut fields = form_urlencoded::parse(&form);
    let given = fields.find(|(name, _)| name == "token").map(|(_, given)| given).unwrap_or_default();
    let secure = headers.get(header::ORIGIN).is_some_and(|origin| origin.as_bytes().starts_with(b"https:"));
    let Some(cookie) = tokens.named(given.trim(), |token| token.cookie.field(secure)) else {
        return page("That is not a token of this server.");
    };
    let (Some(cookie), Ok(address)) = (cookie, HeaderValue::from_str(&published(address))) else {
        return page("That address cannot be opened.");
    };
    let head = [
        (header::LOCATION, address),
        (header::SET_COOKIE, cookie),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
    ];
    (StatusCode::SEE_OTHER, head).into_response()
}

/// Compares in a time that depends only on the lengths.
pub(super) fn same_bytes(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |differ, (x, y)| differ | (x ^ y)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(cookie: &str) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::COOKIE, HeaderValue::from_str(cookie).unwrap());
        headers
    }

    #[test]
    fn a_cookie_stands_for_one_token_and_does_not_contain_it() {
        let token = "0123456789abcdef0123456789abcdef";
        let (own, other) = (SessionCookie::of(token), SessionCookie::of("another"));
        let pair = |cookie: &SessionCookie| format!("{}={}", cookie.name, cookie.value);
        assert!(own.is_in(&with(&format!("theme=dark; {}", pair(&own)))));
        assert!(!own.is_in(&with(&pair(&other))) && !own.is_in(&HeaderMap::new()));
        assert!(!own.is_in(&with(&format!("{}={}", own.name, other.value))));
        assert!(!pair(&own).contains(&token[..8]));
        let field = own.field(true).unwrap();
        let field = field.to_str().unwrap();
        assert!(field.contains("HttpOnly") && field.contains("SameSite=Strict") && field.ends_with("Secure"));
    }
}
