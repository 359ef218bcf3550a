//! The editor's files, the documentation, headers, and slow connections.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

#[test]
fn pages_come_with_their_headers() {
    let server = Server::start(&[]).unwrap();
    for path in ["/", "/scenes/some-editor-address", "/docs", "/docs/problems"] {
        let page = server.get(path).unwrap();
        assert_eq!(page.status, 200, "{path}");
        assert!(page.header("content-type").starts_with("text/html"), "{path}");
        let policy = page.header("content-security-policy");
        assert!(policy.contains("default-src 'none'") && policy.contains("script-src 'self'"), "{path}");
        assert!(!policy.contains("unsafe"));
        assert_eq!(page.header("x-content-type-options"), "nosniff");
        assert_eq!(page.header("referrer-policy"), "no-referrer");
        assert!(!page.text().contains("<script>"), "nothing inline");
    }
    assert_eq!(server.get("/assets/none.js").unwrap().code(), "not-found");
    assert!(server.get("/docs/problems").unwrap().text().contains("id=\"stale-etag\""));
    let document = server.get("/openapi.json").unwrap().json();
    assert_eq!(document["openapi"], "3.1.0");
    let named = server.send(&Request::new("GET", "/healthz").header("x-request-id", "mine-1")).unwrap();
    assert_eq!(named.header("x-request-id"), "mine-1");
    let made = server.send(&Request::new("GET", "/healthz").header("x-request-id", "bad id!")).unwrap();
    assert_eq!(made.header("x-request-id").len(), 32);
}

#[test]
fn texts_of_the_editor_travel_as_the_build_has_compressed_them() {
    let server = Server::start(&[]).unwrap();
    let page = server.get("/").unwrap();
    let is_script = |part: &&str| part.starts_with("/assets/") && part.ends_with(".js");
    let script = page.text().split('"').find(is_script).map(str::to_owned);
    let script = script.expect("a build with the editor inside: without DRAGTRAFFIC_SKIP_WEB");
    let plain = server.get(&script).unwrap();
    assert_eq!((plain.header("content-encoding"), plain.header("vary")), ("", "accept-encoding"));
    let with = |codings: &str| {
        server.send(&Request::new("GET", &script).header("accept-encoding", codings)).unwrap()
    };
    let (brotli, gzip) = (with("gzip, deflate, br, zstd"), with("gzip"));
    assert_eq!((brotli.header("content-encoding"), gzip.header("content-encoding")), ("br", "gzip"));
    assert!(brotli.body.len() < gzip.body.len() && gzip.body.len() * 2 < plain.body.len());
    let mut text = Vec::new();
    flate2::read::GzDecoder::new(gzip.body.as_slice()).read_to_end(&mut text).unwrap();
    assert_eq!(text, plain.body);
    assert_eq!(brotli.header("content-type"), plain.header("content-type"));
    assert_ne!(brotli.header("etag"), plain.header("etag"));
    assert_eq!(with("identity").header("content-encoding"), "");
    let under_its_file = server.get(&format!("{script}.br")).unwrap();
    assert_eq!(under_its_file.code(), "not-found");
}

#[test]
fn every_get_of_the_document_answers() {
    let server = Server::start(&[]).unwrap();
    let document = server.get("/openapi.json").unwrap().json();
    for (path, item) in document["paths"].as_object().unwrap() {
        if item.get("get").is_none() {
            continue;
        }
        let filled = path.replace("{id}", "none").replace("{sha256}", &"0".repeat(64));
        let reply = server.get(&filled).unwrap();
        let is_handshake = item["get"]["responses"].get("101").is_some();
        let expected: &[u16] = match (path.contains('{'), is_handshake) {
            (true, _) => &[404],
            (false, true) => &[426],
            (false, false) => &[200, 503],
        };
        assert!(expected.contains(&reply.status), "{path}: {}", reply.status);
        let wrong = server.send(&Request::new("TRACE", &filled)).unwrap();
        assert_eq!(wrong.code(), "method-not-allowed", "{path}");
    }
}

#[test]
fn a_head_that_dribbles_is_cut_off() {
    let server = Server::start(&["--limit", "header_read_s=1"]).unwrap();
    let mut slow = TcpStream::connect(server.address).unwrap();
    slow.write_all(b"GET /healthz HTTP/1.1\r\nhost: ").unwrap();
    slow.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    let began = Instant::now();
    let mut rest = Vec::new();
    let _ = slow.read_to_end(&mut rest);
    assert!(began.elapsed() < Duration::from_secs(5), "{:?}", began.elapsed());
}

#[test]
fn half_open_connections_do_not_stop_a_client() {
    // No connection ends by itself while the client is served.
    let server = Server::start(&["--limit", "connections=16", "--limit", "header_read_s=600"]).unwrap();
    let idle: Vec<TcpStream> = (0..200)
        .map(|_| {
            let mut stream = TcpStream::connect(server.address).unwrap();
            stream.write_all(b"GET / HTTP/1.1\r\n").unwrap();
            stream
        })
        .collect();
    let began = Instant::now();
    assert_eq!(server.get("/healthz").unwrap().status, 200);
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
    drop(idle);
}

#[test]
fn an_allowed_origin_may_call() {
    let origin = "https://tools.example";
    let server = Server::start(&["--allow-origin", origin]).unwrap();
    let from = |method: &str, origin: &str| {
        let request = Request::new(method, "/v1/scenes").header("origin", origin);
        server.send(&request.header("sec-fetch-site", "cross-site")).unwrap()
    };
    let asked = from("OPTIONS", origin);
    assert_eq!((asked.status, asked.header("access-control-max-age")), (204, "600"));
    let read = from("GET", origin);
    assert_eq!((read.status, read.header("access-control-allow-origin")), (200, origin));
    assert!(read.header("access-control-allow-credentials").is_empty());
    let foreign = from("GET", "https://evil.example");
    assert_eq!((foreign.code().as_str(), foreign.header("access-control-allow-origin")), ("cross-site", ""));
}

#[test]
fn a_token_guards_what_is_not_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("token");
    let token = "0123456789abcdef0123456789abcdef";
    std::fs::write(&file, token).unwrap();
    let path = file.to_str().unwrap().to_owned();
    set_mode(&file, 0o644);
    assert!(Server::start(&["--token-file", &path]).is_err(), "readable by others");
    set_mode(&file, 0o600);
    let server = Server::start(&["--token-file", &path]).unwrap();
    assert_eq!(server.get("/healthz").unwrap().status, 200);
    let refused = server.get("/v1/scenes").unwrap();
    assert_eq!((refused.code().as_str(), refused.header("www-authenticate")), ("unauthorized", "Bearer"));
    let with = |token: &str| {
        let request = Request::new("GET", "/v1/scenes").header("authorization", &format!("Bearer {token}"));
        server.send(&request).unwrap().status
    };
    assert_eq!(with(token), 200);
    assert_eq!(with("0123456789abcdef0123456789abcdee"), 401);
}

#[test]
fn a_browser_signs_in_with_the_token_and_keeps_a_cookie() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("token");
    let token = "0123456789abcdef+123456789abcdef";
    std::fs::write(&file, token).unwrap();
    set_mode(&file, 0o600);
    let server = Server::start(&["--token-file", file.to_str().unwrap()]).unwrap();
    for path in ["/", "/scenes/demo-crossing?at=2"] {
        let asked = server.get(path).unwrap();
        assert_eq!(asked.status, 401);
        assert!(asked.text().contains("This server needs a token") && asked.header("set-cookie").is_empty());
    }
    let sent = |form: &str, origin: &str| {
        let request = Request::new("POST", "/scenes/demo-crossing?at=2");
        let request =
            request.header("content-type", "application/x-www-form-urlencoded").header("origin", origin);
        server.send(&request.body(form.as_bytes().to_vec())).unwrap()
    };
    let own = format!("http://{}", server.address);
    assert_eq!(sent("token=0123456789abcdef%2B123456789abcdee", &own).status, 401);
    assert_eq!(sent("", &own).status, 401);
    assert_eq!(sent("token=0123456789abcdef%2B123456789abcdef", "http://evil.example").status, 403);
    let entered = sent("token=0123456789abcdef%2B123456789abcdef", &own);
    assert_eq!((entered.status, entered.header("location")), (303, "/scenes/demo-crossing?at=2"));
    let field = entered.header("set-cookie");
    assert!(field.contains("; HttpOnly; SameSite=Strict") && !field.contains("Secure"), "{field}");
    let cookie = field.split(';').next().unwrap();
    let with = |path: &str, cookie: &str| {
        server.send(&Request::new("GET", path).header("cookie", cookie)).unwrap().status
    };
    assert_eq!((with("/v1/scenes", cookie), with("/", cookie)), (200, 200));
    assert_eq!((with("/v1/scenes", &cookie[..cookie.len() - 1]), with("/v1/scenes", "a=b")), (401, 401));
}

fn set_mode(path: &std::path::Path, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(mode)).unwrap();
}

#[test]
fn what_is_no_address_of_the_page_is_not_found() {
    let server = Server::start(&[]).unwrap();
    for path in ["/V1/scenes", "//v1/scenes", "/v2/scenes", "/v1.json", "/anything", "/.env", "//"] {
        let missing = server.get(path).unwrap();
        assert_eq!((missing.status, missing.code().as_str()), (404, "not-found"), "{path}");
    }
}
