//! Request heads that reach no handler, over raw sockets: each refusal has the common form, and is counted and logged.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::scenes::generate;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::json;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

const RUNNING: &str = "dragtraffic_running{lane=\"patient\"}";
const CANCELLED: &str = "dragtraffic_generates_total{outcome=\"cancelled\"}";

fn connect(server: &Server) -> TcpStream {
    let stream = TcpStream::connect(server.address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
    stream
}

/// A valid request that keeps the connection open.
fn fine(server: &Server) -> String {
    format!("GET /healthz HTTP/1.1\r\nhost: {}\r\n\r\n", server.address)
}

/// A head with the line `line` in place of a header field.
fn with_line(server: &Server, line: &str) -> String {
    fine(server).replace("\r\n\r\n", &format!("\r\n{line}\r\n\r\n"))
}

/// Bytes to send, with the refusal's status and code.
fn unreadable(server: &Server) -> Vec<(&'static str, Vec<u8>, u16, &'static str)> {
    let head = |line: &str| with_line(server, line).into_bytes();
    let many: String = (0..600).map(|i| format!("x-{i}: 1\r\n")).collect();
    let control = [head("x-a: @")].concat().iter().map(|b| if *b == b'@' { 1 } else { *b }).collect();
    vec![
        ("noise", b"\x16\x03\x01\x02\x00\x01\x00\x01\r\n\r\n".to_vec(), 400, "bad-header"),
        ("no path", b"GET HTTP/1.1\r\n\r\n".to_vec(), 400, "bad-header"),
        ("unknown version", b"GET / HTTP/3.0\r\n\r\n".to_vec(), 400, "bad-header"),
        ("another protocol", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n".to_vec(), 400, "bad-header"),
        ("field without colon", head("nonsense"), 400, "bad-header"),
        ("control character", control, 400, "bad-header"),
        ("two lengths", head("content-length: 1\r\ncontent-length: 2"), 400, "bad-header"),
        ("unknown transfer coding", head("transfer-encoding: rot13"), 400, "bad-header"),
        ("600 fields", head(many.trim_end()), 431, "headers-too-large"),
        ("field of 300 kB", head(&format!("x-a: {}", "a".repeat(300_000))), 431, "headers-too-large"),
        (
            "address of 80 kB",
            fine(server).replace("/healthz", &format!("/{}", "a".repeat(80_000))).into_bytes(),
            414,
            "uri-too-long",
        ),
    ]
}

/// Checks a refusal: its form, its id, and that the connection ends.
fn check(what: &str, stream: TcpStream, status: u16, code: &str) -> String {
    let mut reader = BufReader::new(stream);
    let reply = Reply::read(&mut reader, false).unwrap_or_else(|error| panic!("{what}: {error:#}"));
    check_reply(what, &reply, status, code);
    let mut rest = Vec::new();
    reader.read_to_end(&mut rest).unwrap();
    assert!(rest.is_empty(), "{what}: {rest:?}");
    reply.header("x-request-id").to_owned()
}

fn check_reply(what: &str, reply: &Reply, status: u16, code: &str) {
    assert_eq!((reply.status, reply.code().as_str()), (status, code), "{what}: {}", reply.text());
    let body = reply.json();
    assert_eq!(body["status"], status, "{what}");
    assert_eq!(body["request_id"], reply.header("x-request-id"), "{what}");
    assert_eq!(reply.header("x-request-id").len(), 32, "{what}");
    for (name, value) in [
        ("connection", "close"),
        ("cache-control", "no-store"),
        ("x-content-type-options", "nosniff"),
        ("referrer-policy", "no-referrer"),
        ("cross-origin-opener-policy", "same-origin"),
        ("cross-origin-resource-policy", "same-origin"),
    ] {
        assert_eq!(reply.header(name), value, "{what}: {name}");
    }
    assert!(reply.header("date").ends_with(" GMT"), "{what}");
}

fn refused(server: &Server, status: u16) -> f64 {
    let labels = format!("route=\"(none)\",method=\"OTHER\",status=\"{status}\"");
    server.metric(&format!("dragtraffic_http_requests_total{{{labels}}}")).unwrap()
}

#[test]
fn heads_that_cannot_be_read_are_refused_like_everything_else() {
    let server = Server::with_log(&[]).unwrap();
    for (what, head, status, code) in unreadable(&server) {
        let before = refused(&server, status);
        let mut stream = connect(&server);
        let _ = stream.write_all(&head);
        let id = check(what, stream, status, code);
        assert!((refused(&server, status) - before - 1.0).abs() < 1e-9, "{what}: not counted once");
        let log = server.log().unwrap();
        let lines: Vec<&str> = log.lines().filter(|line| line.contains(&id)).collect();
        let [line] = lines[..] else { panic!("{what}: {lines:?}") };
        assert!(line.contains(&status.to_string()), "{what}: {line}");
        assert_eq!(server.get("/healthz").unwrap().status, 200, "after {what}");
    }
}

#[test]
fn a_refused_head_behind_other_requests_is_answered_after_them() {
    let server = Server::start(&[]).unwrap();
    let long = Request::new("GET", "/openapi.json").keep().bytes(server.address);
    for (what, head, status, code) in unreadable(&server) {
        let mut stream = connect(&server);
        let _ = stream.write_all(&[fine(&server).as_bytes(), &long, &head].concat());
        let mut reader = BufReader::new(stream);
        assert_eq!(Reply::read(&mut reader, false).unwrap().status, 200, "{what}");
        let document = Reply::read(&mut reader, false).unwrap();
        assert!(document.json()["paths"].is_object(), "{what}");
        check_reply(what, &Reply::read(&mut reader, false).unwrap(), status, code);
    }
}

#[test]
fn a_refused_head_on_a_kept_connection_may_come_in_pieces() {
    let server = Server::start(&[]).unwrap();
    let stream = connect(&server);
    stream.set_nodelay(true).unwrap();
    let mut reader = BufReader::new(stream);
    reader.get_mut().write_all(fine(&server).as_bytes()).unwrap();
    assert_eq!(Reply::read(&mut reader, false).unwrap().status, 200);
    for piece in with_line(&server, "non sense").as_bytes().chunks(7) {
        // The server may detect the fault before everything is sent.
        let _ = reader.get_mut().write_all(piece);
        std::thread::sleep(Duration::from_millis(2));
    }
    check_reply("in pieces", &Reply::read(&mut reader, false).unwrap(), 400, "bad-header");
}

#[test]
fn a_head_that_does_not_come_is_refused_and_an_idle_connection_just_ends() {
    let server = Server::start(&["--limit", "header_read_s=1"]).unwrap();
    let mut stream = connect(&server);
    stream.write_all(b"GET /healthz HTTP/1.1\r\nhost: ").unwrap();
    check("half a head", stream, 408, "head-timeout");
    assert!((refused(&server, 408) - 1.0).abs() < 1e-9);
    let mut kept = BufReader::new(connect(&server));
    kept.get_mut().write_all(fine(&server).as_bytes()).unwrap();
    assert_eq!(Reply::read(&mut kept, false).unwrap().status, 200);
    assert!(kept.fill_buf().unwrap().is_empty(), "told something though it asked nothing");
    assert!((refused(&server, 408) - 1.0).abs() < 1e-9);
}

#[test]
fn work_stops_when_a_reader_leaves_who_has_sent_more() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(24);
    body["agents"] = json!("all");
    (body["steps"], body["samples"], body["score"]) = (json!(100), json!(16), json!(false));
    // One reply as a whole: no write in between could fail and reveal the disconnect.
    let ask = Request::new("POST", "/v1/generate").json(&body).keep().bytes(server.address);
    // Once little enough for the server to have read all of it, once more than it reads ahead.
    for behind in [1, 1_000] {
        let gone = server.metric(CANCELLED).unwrap();
        let mut stream = connect(&server);
        stream.write_all(&ask).unwrap();
        stream.write_all(fine(&server).repeat(behind).as_bytes()).unwrap();
        let began = Instant::now();
        while server.metric(RUNNING).unwrap() < 1.0 {
            assert!(began.elapsed() < Duration::from_secs(20), "nobody is at it");
            std::thread::sleep(Duration::from_millis(5));
        }
        drop(stream);
        let left = Instant::now();
        while server.metric(RUNNING).unwrap() > 0.0 {
            assert!(left.elapsed() < Duration::from_secs(20), "still running for nobody");
            std::thread::sleep(Duration::from_millis(20));
        }
        assert!(
            server.metric(CANCELLED).unwrap() > gone,
            "it was not cancelled with {behind} requests behind it"
        );
    }
}
