//! Shares of parties: one caller with many connections leaves the others theirs.

#![allow(clippy::unwrap_used, reason = "a failed test panics")]

use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};
use std::io::{BufReader, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A connection from another address of this machine, so of another party.
fn connect_from(last: u8, server: SocketAddr) -> TcpStream {
    let socket = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None).unwrap();
    socket.bind(&SocketAddr::from((Ipv4Addr::new(127, 0, 0, last), 0)).into()).unwrap();
    socket.connect(&server.into()).unwrap();
    socket.into()
}

fn small(agent: &str) -> Value {
    json!({"scene_id": "demo-crossing", "agents": [agent], "score": false, "futures": "compact"})
}

/// Sends one request over and over on a connection of its own, without pause.
fn pester(server: SocketAddr, over: &AtomicBool) {
    let request = Request::new("POST", "/v1/generate").keep().json(&small("5")).bytes(server);
    while !over.load(Ordering::Relaxed) {
        let stream = connect_from(2, server);
        let mut reader = BufReader::new(stream.try_clone().unwrap());
        let mut stream = stream;
        // The server ends a connection that it refuses to make room for others.
        while !over.load(Ordering::Relaxed)
            && stream.write_all(&request).is_ok()
            && Reply::read(&mut reader, false).is_ok()
        {}
    }
}

#[cfg(target_os = "linux")]
#[test]
fn sixty_connections_of_a_neighbour_leave_a_drag_its_turn() {
    let server = Server::with_demos().unwrap();
    server.wait_ready().unwrap();
    let over = AtomicBool::new(false);
    let busy = std::thread::scope(|scope| {
        (0..60).for_each(|_| drop(scope.spawn(|| pester(server.address, &over))));
        while server.metric("dragtraffic_queue_length{lane=\"quick\"}").unwrap() < 8.0 {
            std::thread::sleep(Duration::from_millis(20));
        }
        let drag = || server.post("/v1/generate", &small("6")).unwrap().status;
        let busy = (0..40).filter(|_| drag() != 200).count();
        over.store(true, Ordering::Relaxed);
        busy
    });
    assert!(busy < 2, "{busy} of 40 drags were refused");
}

#[test]
fn a_newcomer_is_answered_beside_six_hundred_refused_connections() {
    let server = Server::start(&["--limit", "queue=0"]).unwrap();
    let pipelined =
        Request::new("POST", "/v1/generate").keep().json(&small("5")).bytes(server.address).repeat(20);
    let refused: Vec<_> = (0..600)
        .filter_map(|_| {
            let mut stream = TcpStream::connect(server.address).ok()?;
            let _ = stream.write_all(&pipelined);
            Some(stream)
        })
        .collect();
    assert!(refused.len() > 256);
    for _ in 0..10 {
        assert_eq!(server.get("/healthz").unwrap().status, 200);
    }
}
