//! Generation over a WebSocket: replies to several requests at once, and the clients that may open one.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::scenes::generate;
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::io::Write;
use std::net::TcpStream;
use std::os::unix::fs::PermissionsExt;
use std::time::{Duration, Instant};
use tungstenite::client::IntoClientRequest;
use tungstenite::error::ProtocolError;
use tungstenite::protocol::frame::Frame;
use tungstenite::protocol::frame::coding::{CloseCode, Data, OpCode};
use tungstenite::{Error, Message, WebSocket};

/// Longer than the duration of any answer here.
const PATIENCE: Duration = Duration::from_secs(60);

/// A client of a line.
struct Line(WebSocket<TcpStream>);

/// A message of a reply.
#[derive(Debug)]
struct ServerMessage {
    head: Value,
    lines: Vec<Value>,
}

impl ServerMessage {
    fn of(text: &str) -> Self {
        let mut lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
        Self { head: lines.next().unwrap(), lines: lines.collect() }
    }

    fn is_last(&self) -> bool {
        self.head["last"] == json!(true)
    }
}

impl Line {
    fn to(server: &Server) -> Self {
        Self::with(server, &[]).unwrap_or_else(|status| panic!("refused with {status}"))
    }

    /// Opens a line with further headers; returns the status if it is refused.
    fn with(server: &Server, headers: &[(&'static str, &str)]) -> Result<Self, u16> {
        let stream = TcpStream::connect(server.address).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let mut request = format!("ws://{}/v1/generate", server.address).into_client_request().unwrap();
        for (name, value) in headers {
            request.headers_mut().insert(*name, value.parse().unwrap());
        }
        match tungstenite::client(request, stream) {
            Ok((line, _)) => Ok(Self(line)),
            Err(tungstenite::HandshakeError::Failure(Error::Http(reply))) => Err(reply.status().as_u16()),
            Err(error) => panic!("{error}"),
        }
    }

    fn say(&mut self, text: impl Into<String>) {
        self.0.send(Message::text(text.into())).unwrap();
    }

    fn ask(&mut self, number: u64, body: &Value) {
        self.say(json!({"ask": number, "body": body}).to_string());
    }

    fn hear(&mut self) -> ServerMessage {
        loop {
            match self.0.read().unwrap() {
                Message::Text(text) => return ServerMessage::of(&text),
                Message::Ping(_) => {}
                other => panic!("{other:?}"),
            }
        }
    }

    /// All messages of one request, the only open one.
    fn answer(&mut self, number: u64) -> (Value, Vec<Value>) {
        let ServerMessage { head, mut lines } = self.hear();
        let mut last = head["last"] == json!(true);
        while !last {
            let told = self.hear();
            assert_eq!(told.head["ask"], json!(number));
            assert!(told.head.get("status").is_none(), "the head is told once");
            last = told.is_last();
            lines.extend(told.lines);
        }
        (head, lines)
    }

    /// Close code and reason from the server.
    fn end(&mut self) -> (CloseCode, String) {
        loop {
            match self.0.read() {
                Ok(Message::Close(Some(frame))) => return (frame.code, frame.reason.to_string()),
                Ok(Message::Ping(_) | Message::Text(_)) => {}
                other => panic!("{other:?}"),
            }
        }
    }
}

/// A request that runs for a long time.
fn long() -> Value {
    let mut body = generate(24);
    body["agents"] = json!("all");
    body["steps"] = json!(100);
    body["samples"] = json!(16);
    body
}

/// Waits until a metric of the server satisfies a condition.
fn until(server: &Server, metric: &str, fits: impl Fn(f64) -> bool) {
    let began = Instant::now();
    while !fits(server.metric(metric).unwrap()) {
        assert!(began.elapsed() < PATIENCE, "{metric}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

const GIVEN_UP: &str = "dragtraffic_generates_total{outcome=\"cancelled\"}";

#[test]
fn answers_are_those_of_requests() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(4);
    body["hold"] = json!(true);
    let asked = Request::new("POST", "/v1/generate").header("accept", "application/x-ndjson").json(&body);
    let asked = server.send(&asked).unwrap();
    let expected: Vec<Value> = asked.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let mut line = Line::to(&server);
    for number in [7, 3] {
        line.ask(number, &body);
        let (head, events) = line.answer(number);
        assert_eq!(head["status"], json!(200));
        assert!(head["scene"].as_str().unwrap().starts_with("held:"), "{head}");
        let names = |events: &[Value]| events.iter().map(|e| e["event"].clone()).collect::<Vec<_>>();
        assert_eq!(names(&events), names(&expected));
        assert_eq!(events.last().unwrap()["samples"], expected.last().unwrap()["samples"]);
    }
    // A reply that HTTP would send as a whole comes in one message.
    body["draft_delay_ms"] = json!(1000);
    line.ask(4, &body);
    let told = line.hear();
    assert!(told.is_last(), "{:?}", told.head);
    assert_eq!(told.lines.len(), 2, "accepted and final");
    assert!(server.metric("dragtraffic_http_requests_total").unwrap() >= 5.0, "each is counted as a request");
}

#[test]
fn questions_do_not_wait_for_each_other_and_can_be_given_up() {
    let server = Server::start(&["--limit", "running=2"]).unwrap();
    let mut line = Line::to(&server);
    line.ask(1, &long());
    line.ask(2, &generate(1));
    let mut told = line.hear();
    while told.head["ask"] != json!(2) || !told.is_last() {
        assert!(!told.is_last(), "the long one is over first: {:?}", told.head);
        told = line.hear();
    }
    line.say(r#"{"end": 1}"#);
    until(&server, GIVEN_UP, |count| count == 1.0);
    while told.head["ask"] != json!(1) || !told.is_last() {
        told = line.hear();
    }
    assert_eq!(told.head, json!({"ask": 1, "last": true}));
    // Its number is free again.
    line.ask(1, &generate(1));
    told = line.hear();
    while told.head["ask"] != json!(1) || !told.is_last() {
        told = line.hear();
    }
    // A client that disconnects cancels its open requests.
    line.ask(5, &long());
    line.hear();
    drop(line);
    until(&server, GIVEN_UP, |count| count == 2.0);
}

#[test]
fn more_at_once_than_allowed_wait_to_be_heard() {
    let server = Server::start(&["--limit", "line_questions=1"]).unwrap();
    let mut line = Line::to(&server);
    for number in 1..=4 {
        line.ask(number, &generate(2));
    }
    let mut over = Vec::new();
    while over.len() < 4 {
        let told = line.hear();
        if told.is_last() {
            over.push(told.head["ask"].as_u64().unwrap());
        }
    }
    assert_eq!(over, [1, 2, 3, 4]);
}

#[test]
fn a_line_with_all_its_questions_running_hears_an_end_a_ping_and_a_close() {
    let server = Server::start(&["--limit", "line_questions=1"]).unwrap();
    let mut line = Line::to(&server);
    line.ask(1, &long());
    assert!(!line.hear().is_last());
    line.ask(2, &generate(1));
    line.0.send(Message::Ping("here".into())).unwrap();
    let mut pong = line.0.read().unwrap();
    while !matches!(pong, Message::Pong(_)) {
        assert!(!pong.to_text().unwrap().contains(r#""last":true"#), "the long one is over first");
        pong = line.0.read().unwrap();
    }
    line.say(r#"{"end": 1}"#);
    let mut told = line.hear();
    while !told.is_last() {
        told = line.hear();
    }
    assert_eq!(told.head, json!({"ask": 1, "last": true}));
    assert_eq!(line.answer(2).0["status"], json!(200), "what was held back runs now");
    line.ask(3, &long());
    assert!(!line.hear().is_last());
    line.0.close(None).unwrap();
    let closed = std::iter::repeat_with(|| line.0.read()).find_map(Result::err).unwrap();
    assert!(matches!(closed, Error::ConnectionClosed), "{closed}");
    until(&server, GIVEN_UP, |count| count == 2.0);
}

#[test]
fn a_question_with_the_number_of_one_given_up_reads_its_own_answer_alone() {
    let server = Server::start(&["--limit", "line_questions=1"]).unwrap();
    let mut line = Line::to(&server);
    let mut body = long();
    body["stream_modes"] = json!("all");
    for _ in 0..3 {
        line.ask(1, &body);
        assert!(!line.hear().is_last());
        // Pieces of the answer are on their way and wait for this reader.
        std::thread::sleep(Duration::from_millis(300));
        line.say(r#"{"end": 1}"#);
        line.ask(1, &json!({"scene_id": "nowhere"}));
        let mut told = line.hear();
        while !told.is_last() {
            assert!(told.head.get("status").is_none(), "{:?}", told.head);
            told = line.hear();
        }
        assert_eq!(told.head, json!({"ask": 1, "last": true}));
        assert_eq!(line.answer(1).0["status"], json!(404));
    }
}

#[test]
fn a_question_that_waits_can_be_given_up_and_too_many_are_refused() {
    let server = Server::start(&["--limit", "line_questions=1"]).unwrap();
    let mut line = Line::to(&server);
    line.ask(1, &long());
    (2..=80).for_each(|number| line.ask(number, &generate(1)));
    line.say(r#"{"end": 2}"#);
    let (mut refused, mut told) = (Vec::new(), line.hear());
    while told.head["ask"] != json!(2) {
        assert!(told.head["ask"] != json!(1) || !told.is_last(), "the long one is over first");
        if told.is_last() {
            assert_eq!((&told.head["status"], &told.lines[0]["code"]), (&json!(503), &json!("busy")));
            refused.push(told.head["ask"].as_u64().unwrap());
        }
        told = line.hear();
    }
    assert_eq!(told.head, json!({"ask": 2, "last": true}));
    assert_eq!(refused, (66..=80).collect::<Vec<_>>(), "64 wait");
}

#[test]
fn a_refusal_is_told_and_the_line_goes_on() {
    let server = Server::start(&[]).unwrap();
    let mut line = Line::to(&server);
    let unasked = json!({"scene_id": "demo-crossing", "agents": ["7"],
        "conditions": {"6": {"goal": {"x_m": -40.0, "y_m": 8.0}}}});
    for (body, status, code) in [
        (json!({"scene_id": "nowhere"}), 404, "not-found"),
        (json!({"scene_id": "demo-crossing", "speed": 3}), 422, "invalid-field"),
        (json!(7), 422, "invalid-field"),
        (unasked, 422, "not-asked"),
    ] {
        line.ask(1, &body);
        let (head, problem) = line.answer(1);
        assert_eq!(head["status"], json!(status), "{body}");
        assert_eq!((problem.len(), &problem[0]["code"]), (1, &json!(code)), "{body}");
    }
    line.ask(1, &generate(1));
    assert_eq!(line.answer(1).0["status"], json!(200));
}

#[test]
fn a_number_is_free_once_the_last_is_heard() {
    let server = Server::start(&[]).unwrap();
    let mut line = Line::to(&server);
    for _ in 0..300 {
        line.ask(1, &json!({"scene_id": "nowhere"}));
        assert_eq!(line.answer(1).0["status"], json!(404));
    }
}

#[test]
fn what_cannot_be_understood_ends_the_line() {
    let server = Server::start(&["--limit", "line_bytes=30000"]).unwrap();
    let mut body = generate(1);
    body["steps"] = json!(100);
    let twice = json!({"ask": 1, "body": body}).to_string();
    for said in [
        vec!["hello".to_owned()],
        vec!["{}".to_owned()],
        vec![r#"{"ask": 1}"#.to_owned()],
        vec![r#"{"ask": -1, "body": {}}"#.to_owned()],
        vec![r#"{"ask": 1, "body": {}, "end": 1}"#.to_owned()],
        vec![r#"{"ask": 1, "body": {}, "more": 1}"#.to_owned()],
        vec![twice.clone(), twice],
        vec![json!([1, generate(1), null]).to_string()],
    ] {
        let mut line = Line::to(&server);
        said.iter().for_each(|text| line.say(text.clone()));
        let (code, reason) = line.end();
        assert_eq!(code, CloseCode::Policy, "{reason}");
        assert!(!reason.is_empty());
    }
    let mut line = Line::to(&server);
    line.0.send(Message::binary(vec![1, 2, 3])).unwrap();
    assert_eq!(line.end().0, CloseCode::Unsupported);
    let mut line = Line::to(&server);
    line.ask(1, &json!("x".repeat(30_001)));
    let (code, reason) = line.end();
    assert!(code == CloseCode::Size && reason.contains("too long"), "{reason}");
    let mut line = Line::to(&server);
    let broken = Frame::message(vec![0xff, 0xfe], OpCode::Data(Data::Text), true);
    line.0.send(Message::Frame(broken)).unwrap();
    assert_eq!(line.end().0, CloseCode::Invalid);
    assert_eq!(server.get("/healthz").unwrap().status, 200);
}

#[test]
fn more_pings_than_a_client_needs_end_the_line() {
    let server = Server::start(&[]).unwrap();
    let mut line = Line::to(&server);
    for count in 0..1_000 {
        if line.0.send(Message::Ping(vec![b'x'; 125].into())).is_err() {
            assert!(count >= 64, "a burst is taken");
            break;
        }
    }
    let (mut pongs, mut end) = (0, None);
    while end.is_none() {
        match line.0.read() {
            Ok(Message::Pong(_)) => pongs += 1,
            Ok(Message::Close(frame)) => end = frame,
            // Data sent after the close have reset the connection, so the reason is lost.
            Err(Error::Protocol(ProtocolError::ResetWithoutClosingHandshake) | Error::Io(_)) => break,
            other => panic!("{other:?}"),
        }
    }
    assert!(end.is_none_or(|frame| frame.code == CloseCode::Policy && frame.reason.contains("pings")));
    assert!(pongs <= 80, "{pongs}");
    let mut line = Line::to(&server);
    line.ask(1, &generate(1));
    assert_eq!(line.answer(1).0["status"], json!(200));
}

#[cfg(target_os = "linux")]
#[test]
fn pongs_that_nobody_reads_take_no_memory() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let until = Instant::now() + Duration::from_secs(3);
                while Instant::now() < until {
                    let mut line = Line::to(&server);
                    while Instant::now() < until && line.0.send(Message::Ping(vec![b'x'; 125].into())).is_ok()
                    {
                    }
                }
            });
        }
    });
    assert!(server.peak_memory().unwrap() < 200 << 20, "{:?}", server.peak_memory());
}

#[test]
fn eight_open_questions_are_given_up_within_a_tenth_of_a_second() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let mut body = long();
    body["stream_modes"] = json!("all");
    let mut line = Line::to(&server);
    // The shortest of three: other work on the machine takes time too.
    let took = (0..3).map(|round| {
        let numbers: Vec<u64> = (1..=8).map(|number| 8 * round + number).collect();
        numbers.iter().for_each(|number| line.ask(*number, &body));
        assert!(!line.hear().is_last());
        let began = Instant::now();
        numbers.iter().for_each(|number| line.say(format!("{{\"end\": {number}}}")));
        let mut open = numbers.len();
        while open > 0 {
            open -= usize::from(line.hear().is_last());
        }
        began.elapsed()
    });
    let took = took.min().unwrap();
    assert!(took < Duration::from_millis(100), "{took:?}");
}

#[test]
fn a_close_is_heard_while_its_sender_takes_nothing() {
    // Only a received Close ends the requests: the patience is longer than the test's.
    let server = Server::start(&["--limit", "stalled_s=600"]).unwrap();
    let mut line = Line::to(&server);
    let mut body = long();
    body["stream_modes"] = json!("all");
    for number in 1..=4 {
        line.ask(number, &body);
    }
    // Events are dropped once the connection takes no more.
    until(&server, "dragtraffic_events_dropped_total", |count| count >= 1.0);
    line.0.close(None).unwrap();
    until(&server, GIVEN_UP, |count| count >= 1.0);
    until(&server, "dragtraffic_running", |count| count == 0.0);
}

#[test]
fn a_message_must_arrive_whole_in_its_time() {
    let server = Server::start(&["--limit", "body_read_s=1"]).unwrap();
    for begun in [&[0x81][..], &[0x81, 0xfe, 0x10, 0x00, 0, 0, 0, 0, b'{'], &[0x01, 0x81, 0, 0, 0, 0, b'{']] {
        let mut line = Line::to(&server);
        line.0.get_mut().write_all(begun).unwrap();
        let (code, reason) = line.end();
        assert!(code == CloseCode::Policy && reason.contains("within 1 s"), "{reason}");
    }
}

#[test]
fn a_handshake_needs_a_whole_key() {
    let server = Server::start(&[]).unwrap();
    let fields =
        [("connection", "keep-alive, Upgrade"), ("upgrade", "websocket"), ("sec-websocket-version", "13")];
    for (key, status) in
        [("dGhlIHNhbXBsZSBub25jZQ==", 101), ("x", 426), ("dGhlIHNhbXBsZSBub25jZQ", 426), ("", 426)]
    {
        let request = Request::new("GET", "/v1/generate").keep().header("sec-websocket-key", key);
        let request = fields.iter().fold(request, |request, (name, value)| request.header(name, value));
        assert_eq!(request.stream(server.address).unwrap().0.status, status, "{key}");
    }
}

#[test]
fn only_own_pages_open_one() {
    let server = Server::start(&[]).unwrap();
    let own = format!("http://{}", server.address);
    assert!(Line::with(&server, &[("origin", own.as_str()), ("sec-fetch-site", "same-origin")]).is_ok());
    for headers in [
        [("origin", "http://evil.example"), ("sec-fetch-site", "cross-site")],
        [("origin", "http://evil.example"), ("x-request-id", "no-metadata")],
        [("origin", "null"), ("x-request-id", "of-a-frame")],
        [("host", "evil.example"), ("x-request-id", "rebound")],
    ] {
        let refused = Line::with(&server, &headers).err();
        assert!(matches!(refused, Some(403 | 421)), "{headers:?}: {refused:?}");
    }
    let plain = server.get("/v1/generate").unwrap();
    assert_eq!((plain.status, plain.code().as_str()), (426, "upgrade-required"));
    assert_eq!(plain.header("upgrade"), "websocket");
}

#[test]
fn a_token_is_needed_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("token");
    std::fs::write(&file, "a-token-of-sufficient-length-0123456789\n").unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o600)).unwrap();
    let server = Server::start(&["--token-file", file.to_str().unwrap()]).unwrap();
    assert_eq!(Line::with(&server, &[]).err(), Some(401));
    let bearer = "Bearer a-token-of-sufficient-length-0123456789";
    let mut line = Line::with(&server, &[("authorization", bearer)]).unwrap();
    line.ask(1, &generate(1));
    assert_eq!(line.answer(1).0["status"], json!(200));
}

#[test]
fn an_idle_line_makes_room_and_a_busy_one_does_not() {
    let server = Server::start(&["--limit", "connections=2"]).unwrap();
    let mut idle = Line::to(&server);
    let mut busy = Line::to(&server);
    busy.ask(1, &long());
    assert!(!busy.hear().is_last());
    assert_eq!(server.get("/healthz").unwrap().status, 200, "there is room for a third");
    let idle = idle.0.read().unwrap_err();
    assert!(matches!(idle, Error::Protocol(ProtocolError::ResetWithoutClosingHandshake)), "{idle}");
    busy.say(r#"{"end": 1}"#);
    busy.ask(2, &generate(1));
    let mut told = busy.hear();
    while told.head["ask"] != json!(2) || !told.is_last() {
        told = busy.hear();
    }
}

#[test]
fn a_server_that_ends_answers_first() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let mut line = Line::to(&server);
    let mut body = long();
    body["samples"] = json!(1);
    line.ask(1, &body);
    assert!(!line.hear().is_last());
    let stopped = std::thread::spawn(move || server.stop().unwrap());
    let (_, events) = line.answer(1);
    assert_eq!(events.last().unwrap()["event"], json!("final"));
    assert_eq!(line.end().0, CloseCode::Away);
    assert_eq!(stopped.join().unwrap().0, Some(0));
}

#[test]
fn who_takes_nothing_is_let_go() {
    let server = Server::start(&["--limit", "stalled_s=1", "--limit", "heartbeat_s=1"]).unwrap();
    let mut line = Line::to(&server);
    let mut body = long();
    body["stream_modes"] = json!("all");
    for number in 1..=4 {
        line.ask(number, &body);
    }
    until(&server, GIVEN_UP, |count| count >= 1.0);
    drop(line);
}
