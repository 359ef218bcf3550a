//! The editor, which is embedded in the program.

use super::observe::RequestGate;
use super::{accept, coding, sign_in};
use api::{Code, Problem};
use axum::body::Body;
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header};
use axum::response::{Html, IntoResponse, Response};
use base::base_path;
use base::problem::{ALLOWED, Refusal};
use rust_embed::{EmbeddedFile, RustEmbed};

/// The built editor.
#[derive(RustEmbed)]
#[folder = "../web/dist"]
#[allow_missing = true]
struct Editor;

/// Everything without its own route: the editor's files, its page at its own addresses, otherwise a problem.
/// On a server with a token the page asks for it first.
pub async fn fallback(
    State(gate): State<RequestGate>,
    method: Method,
    uri: Uri,
    headers: HeaderMap,
    body: Body,
) -> Response {
    let path = uri.path();
    if path == "/v1" || path.starts_with("/v1/") {
        return Refusal::from(Problem::new(Code::NotFound, "The API has no such address.")).into_response();
    }
    if let Some(tokens) = gate.guard.closed_to(&headers).filter(|_| is_page(path)) {
        let address = uri.path_and_query().map_or(path, |address| address.as_str());
        return match method {
            Method::POST => sign_in::enter(tokens, address, &headers, body).await,
            _ => sign_in::page(""),
        };
    }
    if method != Method::GET && method != Method::HEAD {
        let problem = Problem::new(Code::MethodNotAllowed, "Only GET and HEAD are allowed here.");
        return Refusal::from(problem.fact(ALLOWED, "GET, HEAD")).into_response();
    }
    let name = path.strip_prefix('/').unwrap_or(path);
    match Editor::get(name).filter(|_| !is_packed(name) && name != "index.html") {
        Some(file) => asset(name, &file, &headers),
        // A missing script must not be answered with a page.
        None if name.starts_with("assets/") => {
            Refusal::from(Problem::new(Code::NotFound, "The editor has no such file.")).into_response()
        }
        None if !is_page(path) || accept::prefers_json(&headers) => {
            Refusal::from(Problem::new(Code::NotFound, "Nothing has this address.")).into_response()
        }
        None => match Editor::get("index.html") {
            Some(page) if base_path::base().is_empty() => asset("index.html", &page, &headers),
            Some(page) => rebased(&page),
            None => {
                let detail = "This build has no editor inside; the API works.";
                Refusal::from(Problem::new(Code::NotFound, detail)).into_response()
            }
        },
    }
}

/// Whether an address belongs to the editor's page: its root, and those of scenes.
fn is_page(path: &str) -> bool {
    path == "/" || path == "/index.html" || path == "/scenes" || path.starts_with("/scenes/")
}

/// Codings for which the build stores compressed files, smallest first, with their extensions.
const PACKED: [(&str, &str); 2] = [("br", ".br"), ("gzip", ".gz")];

fn is_packed(name: &str) -> bool {
    PACKED.iter().any(|(_, ending)| name.ends_with(ending))
}

/// The file as the build compressed it, in the smallest accepted coding.
fn packed(name: &str, headers: &HeaderMap) -> Option<(&'static str, EmbeddedFile)> {
    let taken = PACKED.into_iter().filter(|(coding, _)| coding::takes(headers, coding));
    taken.filter_map(|(coding, ending)| Some((coding, Editor::get(&format!("{name}{ending}"))?))).next()
}

/// The page with its links below the server's base path.
fn rebased(page: &EmbeddedFile) -> Response {
    let text = String::from_utf8_lossy(&page.data).replace("=\"/", &format!("=\"{}/", base_path::base()));
    ([(header::CACHE_CONTROL, "no-cache")], Html(text)).into_response()
}

fn asset(name: &str, plain: &EmbeddedFile, headers: &HeaderMap) -> Response {
    let packed = packed(name, headers);
    let file = packed.as_ref().map_or(plain, |(_, file)| file);
    let hash: String = file.metadata.sha256_hash().iter().take(8).map(|b| format!("{b:02x}")).collect();
    let etag = format!("\"{hash}\"");
    // Names below assets/ contain a hash of the content; browsers revalidate all other files.
    let keep = if name.starts_with("assets/") { "public, max-age=31536000, immutable" } else { "no-cache" };
    let head = [
        (header::ETAG, etag.clone()),
        (header::CACHE_CONTROL, keep.to_owned()),
        (header::VARY, header::ACCEPT_ENCODING.as_str().to_owned()),
    ];
    let known = headers.get(header::IF_NONE_MATCH).and_then(|v| v.to_str().ok());
    if known.is_some_and(|list| list.split(',').any(|tag| tag.trim().trim_start_matches("W/") == etag)) {
        return (StatusCode::NOT_MODIFIED, head).into_response();
    }
    let body = match &file.data {
        std::borrow::Cow::Borrowed(bytes) => Body::from(*bytes),
        std::borrow::Cow::Owned(bytes) => Body::from(bytes.clone()),
    };
    let mut reply = (head, [(header::CONTENT_TYPE, media_type(name))], body).into_response();
    if let Some((coding, _)) = packed {
        reply.headers_mut().insert(header::CONTENT_ENCODING, HeaderValue::from_static(coding));
    }
    reply
}

fn media_type(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "map" => "application/json",
        "webmanifest" => "application/manifest+json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "woff2" => "font/woff2",
        "txt" => "text/plain; charset=utf-8",
        "wasm" => "application/wasm",
        _ => "application/octet-stream",
    }
}
