//! Clients that take more than their share: slow bodies, many uploads, long calls. Other clients still get
//! replies.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::scenes::{generate, street};
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Sends the head and one byte of a body of a thousand.
fn one_byte(server: &Server, path: &str, media_type: &str) -> Option<TcpStream> {
    let request = Request::new("POST", path).header("content-type", media_type).body("{").length("1000");
    request.open(server.address).ok()
}

/// Another client repeats a small request until it gets a reply.
fn answered(server: &Server) {
    let began = Instant::now();
    loop {
        if server.get("/v1/info").is_ok_and(|reply| reply.status == 200) {
            return;
        }
        assert!(began.elapsed() < Duration::from_secs(20), "everybody else is shut out");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn slow_bodies_make_room_for_others() {
    let server = Server::start(&["--limit", "connections=16"]).unwrap();
    for (path, media_type) in
        [("/v1/import", "application/octet-stream"), ("/v1/generate", "application/json")]
    {
        let slow: Vec<_> = (0..40).filter_map(|_| one_byte(&server, path, media_type)).collect();
        answered(&server);
        assert!(slow.len() >= 16);
    }
}

#[test]
fn a_body_that_comes_too_slowly_is_refused() {
    let server = Server::start(&["--limit", "body_grace_s=0"]).unwrap();
    let request = Request::new("POST", "/v1/generate").header("content-type", "application/json");
    let reply = request.body("{").length("1000").send(server.address).unwrap();
    assert_eq!((reply.status, reply.code().as_str()), (408, "body-timeout"));
    assert_eq!(reply.json()["limit"], 10_000);
}

#[test]
fn uploads_beyond_their_number_are_refused_before_they_are_read() {
    let server = Server::start(&["--limit", "uploads=2", "--limit", "body_grace_s=60"]).unwrap();
    let hold = || one_byte(&server, "/v1/import", "application/octet-stream").unwrap();
    let mut held: Vec<_> = (0..2).map(|_| hold()).collect();
    let began = Instant::now();
    let refused = loop {
        let request =
            Request::new("POST", "/v1/import?dry_run=true").header("content-type", "application/json");
        let reply = request.body(street(2, 20).to_string()).send(server.address).unwrap();
        if reply.status != 200 || began.elapsed() > Duration::from_secs(40) {
            break reply;
        }
        // This connection may have taken the place of one that was then refused.
        held.push(hold());
    };
    assert_eq!((refused.status, refused.code().as_str()), (503, "busy"), "{}", refused.text());
    assert!(refused.header("retry-after").parse::<u32>().is_ok());
    drop(held);
}

/// A call of several seconds: all road users, many times.
fn heavy() -> Value {
    let mut body = generate(24);
    body["agents"] = json!("all");
    body["steps"] = json!(100);
    body["samples"] = json!(16);
    body["score"] = json!(false);
    body
}

#[test]
fn small_calls_are_answered_while_long_ones_run_and_wait() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let (address, ended) = (server.address, Arc::new(AtomicUsize::new(0)));
    let callers: Vec<_> = (0..4)
        .map(|_| {
            let ended = Arc::clone(&ended);
            std::thread::spawn(move || {
                let reply = Request::new("POST", "/v1/generate").json(&heavy()).send(address).unwrap();
                ended.fetch_add(1, Ordering::SeqCst);
                assert_eq!(reply.status, 200, "{}", reply.text());
            })
        })
        .collect();
    let began = Instant::now();
    while server.metric("dragtraffic_running{lane=\"patient\"}").unwrap() < 1.0 {
        assert!(began.elapsed() < Duration::from_secs(30), "nobody is at it");
        std::thread::sleep(Duration::from_millis(5));
    }
    for _ in 0..5 {
        assert_eq!(server.post("/v1/generate", &generate(2)).unwrap().status, 200);
    }
    assert!(ended.load(Ordering::SeqCst) < 4, "small calls waited for all long ones");
    callers.into_iter().for_each(|caller| caller.join().unwrap());
}

#[test]
fn a_refused_revision_may_be_tried_again() {
    let server = Server::start(&["--limit", "queue=0"]).unwrap();
    let mut body = generate(2);
    body["client"] = json!("me");
    body["revision"] = json!(7);
    for _ in 0..2 {
        let refused = server.post("/v1/generate", &body).unwrap();
        assert_eq!((refused.status, refused.code().as_str()), (503, "busy"), "{}", refused.text());
    }
}

/// Sends a request as the user `nobody`; `None` if the present user cannot switch to it.
#[cfg(target_os = "linux")]
fn as_nobody(server: &Server, path: &str) -> Option<String> {
    use std::os::unix::process::CommandExt;
    let (ip, port) = (server.address.ip(), server.address.port());
    let head =
        format!("GET {path} HTTP/1.1\\r\\nhost: {}\\r\\nconnection: close\\r\\n\\r\\n", server.address);
    let script = format!("exec 3<>/dev/tcp/{ip}/{port}; printf '{head}' >&3; cat <&3");
    let output =
        std::process::Command::new("bash").args(["-c", &script]).uid(65534).gid(65534).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

#[cfg(target_os = "linux")]
#[test]
#[allow(clippy::print_stdout, reason = "it says why it does nothing")]
fn another_user_of_the_machine_is_not_let_in() {
    let server = Server::start(&[]).unwrap();
    assert_eq!(server.get("/v1/scenes").unwrap().status, 200);
    let Some(reply) = as_nobody(&server, "/v1/scenes") else {
        println!("skipped: only root can ask as another user");
        return;
    };
    assert!(reply.starts_with("HTTP/1.1 401") && reply.contains("another user"), "{reply}");
    assert!(as_nobody(&server, "/healthz").unwrap().starts_with("HTTP/1.1 200"));
}

#[cfg(unix)]
#[test]
fn files_of_the_data_folder_stay_in_their_bounds() {
    let (outside, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let scene = |source: &str, id: &str| {
        let mut scene = street(2, 20);
        (scene["meta"]["source"], scene["meta"]["source_id"]) = (json!(source), json!(id));
        scene.to_string()
    };
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("taken.json"), scene("demo", "crossing")).unwrap();
    std::fs::write(at("own.json"), scene("mine", "own")).unwrap();
    std::fs::write(outside.path().join("secret.json"), scene("mine", "secret")).unwrap();
    std::os::unix::fs::symlink(outside.path().join("secret.json"), at("link.json")).unwrap();
    std::fs::File::create(at("huge.json")).unwrap().set_len(3 << 30).unwrap();
    let flags = ["--limit", "cached_scene_bytes=1", "--data", folder.path().to_str().unwrap()];
    let server = Server::start(&flags).unwrap();
    let status = |id: &str| server.get(&format!("/v1/scenes/{id}")).unwrap().status;
    let began = Instant::now();
    while status("file-taken-0") != 200 || status("mine-own") != 200 {
        assert!(began.elapsed() < Duration::from_secs(20), "the folder was not read");
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!(status("mine-secret"), 404, "a link leads out of the folder");
    let demo = server.get("/v1/scenes/demo-crossing").unwrap().json();
    assert_eq!(demo["agents"].as_array().unwrap().len(), 44, "the example is as it was");
    std::fs::remove_file(at("own.json")).unwrap();
    let gone = server.get("/v1/scenes/mine-own").unwrap();
    assert_eq!((gone.status, gone.code().as_str()), (404, "not-found"));
}
