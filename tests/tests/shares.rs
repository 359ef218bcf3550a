//! Fair shares: a caller with many connections does not take those of the others.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::http::connect_from;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::io::{BufReader, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

fn small(agent: &str) -> Value {
    json!({"scene_id": "demo-crossing", "agents": [agent], "score": false, "futures": "compact"})
}

/// Sends one request repeatedly on its own connection from an address, without pause.
fn pester((from, request): (u8, &Request), server: SocketAddr, over: &AtomicBool) {
    let request = request.bytes(server);
    while !over.load(Ordering::Relaxed) {
        let stream = connect_from(from, server).unwrap();
        let mut reader = BufReader::new(stream.try_clone().unwrap());
        let mut stream = stream;
        // The server closes a connection that it refuses to make room for others.
        while !over.load(Ordering::Relaxed)
            && stream.write_all(&request).is_ok()
            && Reply::read(&mut reader, false).is_ok()
        {}
    }
}

/// Number of refused drags of 40 beside 60 connections from an address that repeat a request.
fn refused_drags(server: &Server, neighbour: (u8, &Request), drag: &Request) -> usize {
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        (0..60).for_each(|_| drop(scope.spawn(|| pester(neighbour, server.address, &over))));
        std::thread::sleep(Duration::from_secs(2));
        let refused = (0..40).filter(|_| server.send(drag).unwrap().status != 200).count();
        over.store(true, Ordering::Relaxed);
        refused
    })
}

fn drag(agent: &str) -> Request {
    Request::new("POST", "/v1/generate").json(&small(agent))
}

#[cfg(target_os = "linux")]
#[test]
fn sixty_connections_of_a_neighbour_leave_a_drag_its_turn() {
    let server = Server::with_demos().unwrap();
    server.wait_ready().unwrap();
    let refused = refused_drags(&server, (2, &drag("5").keep()), &drag("6"));
    assert!(refused < 2, "{refused} of 40 drags were refused");
}

#[cfg(target_os = "linux")]
#[test]
fn a_token_has_a_share_of_its_own_whatever_the_address() {
    let folder = tempfile::tempdir().unwrap();
    let (file, [anna, berta]) = (folder.path().join("tokens"), ["a".repeat(32), "b".repeat(32)]);
    std::fs::write(&file, format!("anna admin {anna}\nberta edit {berta}\n")).unwrap();
    std::fs::set_permissions(&file, std::os::unix::fs::PermissionsExt::from_mode(0o600)).unwrap();
    let server = Server::start(&["--token-file", file.to_str().unwrap()]).unwrap();
    let of = |request: Request, token: &str| request.header("authorization", &format!("Bearer {token}"));
    let greedy = of(drag("5").keep(), &anna);
    let refused = refused_drags(&server, (1, &greedy), &of(drag("6"), &berta));
    assert!(refused < 2, "{refused} of 40 drags were refused");
}

#[test]
fn a_newcomer_is_answered_beside_six_hundred_refused_connections() {
    let server = Server::start(&["--limit", "queue=0"]).unwrap();
    let pipelined =
        Request::new("POST", "/v1/generate").keep().json(&small("5")).bytes(server.address).repeat(20);
    let over = AtomicBool::new(false);
    let statuses = std::thread::scope(|scope| {
        for _ in 0..60 {
            scope.spawn(|| {
                while !over.load(Ordering::Relaxed) {
                    let refused: Vec<_> = (0..10)
                        .filter_map(|_| {
                            let mut stream = TcpStream::connect(server.address).ok()?;
                            let _ = stream.write_all(&pipelined);
                            Some(stream)
                        })
                        .collect();
                    std::thread::sleep(Duration::from_millis(500));
                    drop(refused);
                }
            });
        }
        std::thread::sleep(Duration::from_secs(1));
        // From the same address, so without their own share.
        let asked = [
            Request::new("GET", "/healthz"),
            Request::new("GET", "/v1/info"),
            Request::new("POST", "/v1/generate").json(&small("6")),
        ];
        let statuses: Vec<_> =
            (0..32).map(|k| server.send(&asked[k % 3]).map(|reply| reply.status)).collect();
        over.store(true, Ordering::Relaxed);
        statuses
    });
    for (k, status) in statuses.into_iter().enumerate() {
        let status = status.unwrap();
        assert!(status == 200 || (k % 3 > 0 && status == 503), "{k}: {status}");
    }
}

/// Waits as long as a refusal demands.
fn obey(refusal: &Reply) {
    std::thread::sleep(Duration::from_millis(refusal.json()["retry_after_ms"].as_u64().unwrap()));
}

#[test]
fn a_token_beyond_its_rate_is_told_when_to_ask_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [anna, berta] = ["a".repeat(32), "b".repeat(32)];
    std::fs::write(at("tokens"), format!("anna read {anna}\nberta admin {berta}\n")).unwrap();
    #[cfg(unix)]
    std::fs::set_permissions(at("tokens"), std::os::unix::fs::PermissionsExt::from_mode(0o600)).unwrap();
    // Options come from the file and the command line alike.
    std::fs::write(at("server.toml"), "limit = [\"party_rate=2\", \"party_burst=6\"]\n").unwrap();
    let (tokens, config, audit) = (at("tokens"), at("server.toml"), at("audit"));
    let server = Server::start(&["--token-file", &tokens, "--config", &config, "--audit", &audit]).unwrap();
    let info = |token: &str| {
        let request = Request::new("GET", "/v1/info").header("authorization", &format!("Bearer {token}"));
        server.send(&request).unwrap()
    };
    let began = Instant::now();
    let statuses: Vec<u16> = (0..6).map(|_| info(&anna).status).collect();
    let refused = info(&anna);
    if began.elapsed() < Duration::from_millis(400) {
        assert_eq!((statuses, refused.status), (vec![200; 6], 429), "six at once, and no more");
    }
    // After the initial burst the rate counts, regardless of the speed of this machine.
    let refused = (0..40).map(|_| info(&anna)).find(|reply| reply.status == 429).unwrap();
    assert_eq!((refused.code().as_str(), &refused.json()["limit"]), ("too-many-requests", &json!(2)));
    let wait_ms = refused.json()["retry_after_ms"].as_u64().unwrap();
    assert!((1..=500).contains(&wait_ms), "{wait_ms}");
    assert_eq!(refused.header("retry-after"), "1");
    assert_eq!(info(&berta).status, 200, "another token has a rate of its own");
    let waited = (0..5).any(|_| {
        let reply = info(&anna);
        if reply.status == 429 {
            obey(&reply);
        }
        info(&anna).status == 200
    });
    assert!(waited, "the wait that is told is enough");
    // Monitoring is never refused.
    assert!((0..30).all(|_| server.get("/healthz").unwrap().status == 200));
    let counted = Request::new("GET", "/metrics").header("authorization", &format!("Bearer {berta}"));
    let metrics = server.send(&counted).unwrap().text();
    assert!(metrics.contains(r#"route="/v1/info",method="GET",status="429""#), "{metrics}");
    let lines = std::fs::read_to_string(&audit).unwrap();
    let told: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let of_rate: Vec<&Value> = told.iter().filter(|line| line["status"] == 429).collect();
    assert_eq!(of_rate.len(), 1, "once a minute: {lines}");
    assert_eq!((&of_rate[0]["who"], &of_rate[0]["what"]), (&json!("anna"), &json!("GET /v1/info")));
}
