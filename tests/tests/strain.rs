//! Clients that take more than their share: slow bodies, many uploads, long calls. Other clients still get
//! replies.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::random::Random;
use dragtraffic_tests::scenes::{generate, street};
#[cfg(target_os = "linux")]
use dragtraffic_tests::{Reply, http::connect_from};
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
#[cfg(target_os = "linux")]
use std::io::{BufReader, Read, Write};
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

/// A street under lanes with random points on a square, so that they cross each other everywhere.
fn tangled(lanes: usize, points: usize, side_m: f64) -> Value {
    let mut random = Random::new(11);
    let mut at = || side_m * (random.below(10_000) as f64 / 10_000.0 - 0.5);
    let mut body = generate(2);
    let tangle = (0..lanes).map(|i| {
        let points: Vec<[f64; 2]> = (0..points).map(|_| [at(), at()]).collect();
        json!({"id": format!("t{i}"), "type": "surface_street", "points_m": points})
    });
    let tangle: Vec<Value> = tangle.collect();
    body["scene"]["map"]["lanes"].as_array_mut().unwrap().extend(tangle);
    body
}

#[test]
fn a_map_whose_lanes_cross_everywhere_is_refused() {
    let server = Server::start(&[]).unwrap();
    for body in [tangled(5, 4_000, 40.0), tangled(20, 1_000, 400.0), tangled(90, 4_000, 19_000.0)] {
        let refused = server.post("/v1/generate", &body).unwrap();
        assert_eq!((refused.status, refused.code().as_str()), (422, "map-too-complex"), "{}", refused.text());
        assert_eq!(refused.json()["errors"][0]["pointer"], "/scene/map");
    }
}

#[test]
fn a_map_that_must_be_worked_out_first_keeps_no_drag_waiting() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let address = server.address;
    for (path, body) in [
        ("/v1/generate", tangled(2, 4_000, 60.0)),
        ("/v1/score", json!({"scene": tangled(2, 4_000, 61.0)["scene"]})),
        ("/v1/place", json!({"scene": tangled(2, 4_000, 62.0)["scene"], "density": {"count": 1}})),
        ("/v1/export?format=sumo", tangled(2, 4_000, 63.0)["scene"].clone()),
    ] {
        let caller =
            std::thread::spawn(move || Request::new("POST", path).json(&body).send(address).unwrap());
        let mut seen = 0;
        while !caller.is_finished() {
            let running = |lane| server.metric(&format!("dragtraffic_running{{lane=\"{lane}\"}}")).unwrap();
            assert!(running("quick") == 0.0, "{path} runs in the lane of the drags");
            seen += usize::from(running("patient") == 1.0);
        }
        let reply = caller.join().unwrap();
        assert_eq!(reply.status, 200, "{path}: {}", reply.text());
        assert!(seen > 0, "{path} was not seen at work");
    }
}

#[test]
fn exports_of_many_links_are_refused_or_bounded() {
    let server = Server::start(&[]).unwrap();
    let scene = |lanes: usize, links: usize| {
        let mut scene = street(1, 20);
        let ids = |i: usize| (1..=links).map(|k| format!("k{}", (i + k) % lanes)).collect::<Vec<_>>();
        let lane = |i: usize| {
            let y = i as f64 * 4.0;
            json!({"id": format!("k{i}"), "type": "surface_street", "points_m": [[0.0, y], [1.0, y]],
                "successors": ids(i)})
        };
        scene["map"]["lanes"] = json!((0..lanes).map(lane).collect::<Vec<_>>());
        scene
    };
    let refused = server.post("/v1/export?format=opendrive", &scene(700, 699)).unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (422, "map-too-complex"), "{}", refused.text());
    let dense = scene(2_000, 60);
    let most = 8 * dense.to_string().len() + (64 << 20);
    for format in ["opendrive", "openscenario", "sumo", "commonroad"] {
        let reply = server.post(&format!("/v1/export?format={format}"), &dense).unwrap();
        match reply.status {
            200 => assert!(reply.body.len() < most, "{format}: {}", reply.body.len()),
            status => {
                assert_eq!((status, reply.code().as_str()), (422, "reply-too-large"), "{}", reply.text())
            }
        }
    }
    assert!(server.peak_memory().unwrap() < (400 << 20) + 2 * most as u64, "{:?}", server.peak_memory());
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
fn as_root_another_user_of_the_machine_is_not_let_in() {
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

#[cfg(target_os = "linux")]
#[test]
fn a_file_that_becomes_a_pipe_or_a_link_outwards_is_gone_and_holds_nobody_up() {
    let (outside, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let at = |name: &str| folder.path().join(name);
    let scene = |id: &str| {
        let mut scene = street(2, 20);
        (scene["meta"]["source"], scene["meta"]["source_id"]) = (json!("mine"), json!(id));
        scene.to_string()
    };
    for name in ["pipe", "link", "other"] {
        std::fs::write(at(name), scene(name)).unwrap();
    }
    let flags = ["--limit", "cached_scene_bytes=1", "--data", folder.path().to_str().unwrap()];
    let server = Server::start(&flags).unwrap();
    server.wait_ready().unwrap();
    let status = |id: &str| server.get(&format!("/v1/scenes/{id}")).unwrap().status;
    let began = Instant::now();
    while ["mine-pipe", "mine-link", "mine-other"].iter().any(|id| status(id) != 200) {
        assert!(began.elapsed() < Duration::from_secs(20), "the folder was not read");
        std::thread::sleep(Duration::from_millis(20));
    }
    for name in ["pipe", "link", "other"] {
        std::fs::remove_file(at(name)).unwrap();
    }
    assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
    std::fs::write(outside.path().join("link"), scene("link")).unwrap();
    std::os::unix::fs::symlink(outside.path().join("link"), at("link")).unwrap();
    std::fs::write(at("other"), scene("other").replace("street", "another")).unwrap();
    for _ in 0..8 {
        for id in ["mine-pipe", "mine-link", "mine-other"] {
            let gone = server.get(&format!("/v1/scenes/{id}")).unwrap();
            assert_eq!((gone.status, gone.code().as_str()), (404, "not-found"), "{id}");
        }
    }
    let began = Instant::now();
    assert_eq!(status("demo-crossing"), 200);
    assert_eq!(server.get("/readyz").unwrap().status, 200);
    assert!(began.elapsed() < Duration::from_secs(1), "{:?}", began.elapsed());
}

#[test]
fn a_form_has_few_parts_with_known_names() {
    let server = Server::start(&[]).unwrap();
    let post = |parts: &[(&str, &str)]| {
        let part = |(name, content): &(&str, &str)| {
            format!(
                "--b\r\ncontent-disposition: form-data; name=\"{name}\"; filename=\"f\"\r\n\r\n{content}\r\n"
            )
        };
        let body: String = parts.iter().map(part).collect();
        let request = Request::new("POST", "/v1/import?dry_run=true");
        let request = request.header("content-type", "multipart/form-data; boundary=b");
        request.body(format!("{body}--b--\r\n")).send(server.address).unwrap()
    };
    let scene = street(2, 20).to_string();
    let read = post(&[("file", &scene), ("file", &scene), ("file", "nonsense")]);
    let scenes = |file: &Value| file["scenes"].as_array().map(Vec::len);
    let files = read.json()["files"].as_array().unwrap().iter().map(scenes).collect::<Vec<_>>();
    assert_eq!((read.status, files), (200, vec![Some(1), Some(1), None]));
    for (parts, word) in [
        (vec![("", ""); 100_000], "another name"),
        (vec![("other", ""), ("file", &*scene)], "another name"),
        (vec![("file", &*scene); 33], "at most 32"),
    ] {
        let began = Instant::now();
        let refused = post(&parts);
        let mut shortest = began.elapsed();
        assert_eq!((refused.status, refused.code().as_str()), (422, "invalid-field"), "{}", refused.text());
        assert!(refused.text().contains(word), "{}", refused.text());
        // Other work on the machine takes time too.
        for _ in 0..2 {
            let began = Instant::now();
            post(&parts);
            shortest = shortest.min(began.elapsed());
        }
        assert!(shortest < Duration::from_secs(2), "{word}: {shortest:?}");
    }
}

#[test]
fn health_is_answered_and_others_are_refused_while_all_places_are_at_work() {
    let server = Server::start(&["--limit", "connections=4", "--limit", "stalled_s=600"]).unwrap();
    server.wait_ready().unwrap();
    let mut body = heavy();
    body["stream_modes"] = json!("all");
    let asked = Request::new("POST", "/v1/generate").header("accept", "text/event-stream").json(&body);
    let mut held: Vec<_> = (0..4).map(|_| asked.open(server.address).unwrap()).collect();
    for stream in &mut held {
        let mut first = [0; 12];
        stream.read_exact(&mut first).unwrap();
        assert_eq!(&first, b"HTTP/1.1 200");
    }
    for _ in 0..20 {
        assert_eq!(server.get("/healthz").unwrap().status, 200);
        let refused = server.get("/v1/info").unwrap();
        assert_eq!((refused.status, refused.code().as_str()), (503, "busy"));
        assert!(refused.json()["retry_after_ms"].is_u64());
    }
    // A refused connection that sends nothing also gets the reason, instead of a silent close.
    let late = TcpStream::connect(server.address).unwrap();
    let told = Reply::read(&mut BufReader::new(late), false).unwrap();
    assert_eq!((told.status, told.code().as_str()), (503, "busy"));
    // A client of another address takes a place from the one that has all of them.
    let other = socket2::Socket::new(socket2::Domain::IPV4, socket2::Type::STREAM, None).unwrap();
    other.bind(&std::net::SocketAddr::from(([127, 0, 0, 2], 0)).into()).unwrap();
    other.connect(&server.address.into()).unwrap();
    let mut other = TcpStream::from(other);
    other.write_all(&Request::new("GET", "/v1/info").bytes(server.address)).unwrap();
    let reply = Reply::read(&mut BufReader::new(other), false).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
}

#[cfg(target_os = "linux")]
#[test]
fn a_client_that_asks_when_its_place_is_taken_already_is_told() {
    let server = Server::start(&["--limit", "connections=4"]).unwrap();
    let mut late = connect_from(2, server.address).unwrap();
    std::thread::sleep(Duration::from_millis(400));
    let ask = Request::new("GET", "/healthz").keep().bytes(server.address);
    let others: Vec<_> = (3..8)
        .map(|address| {
            let mut other = connect_from(address, server.address).unwrap();
            other.write_all(&ask).unwrap();
            assert_eq!(Reply::read(&mut BufReader::new(&other), false).unwrap().status, 200);
            other
        })
        .collect();
    std::thread::sleep(Duration::from_millis(200));
    let _ = late.write_all(&ask);
    let told = Reply::read(&mut BufReader::new(&late), false).unwrap();
    assert_eq!((told.status, told.code().as_str()), (503, "busy"));
    drop(others);
}

#[cfg(target_os = "linux")]
#[test]
fn whoever_has_most_places_takes_none_of_others() {
    let limits = ["--limit", "connections=4", "--limit", "stalled_s=600", "--limit", "header_read_s=600"];
    let server = Server::start(&limits).unwrap();
    server.wait_ready().unwrap();
    let health = Request::new("GET", "/healthz").keep().bytes(server.address);
    let mut other = connect_from(2, server.address).unwrap();
    let mut is_answered = || {
        other.write_all(&health).is_ok()
            && Reply::read(&mut BufReader::new(&other), false).is_ok_and(|reply| reply.status == 200)
    };
    assert!(is_answered());
    let mut body = heavy();
    body["stream_modes"] = json!("all");
    let asked = Request::new("POST", "/v1/generate").header("accept", "text/event-stream").json(&body);
    let asked = asked.bytes(server.address);
    let held: Vec<_> = (0..3)
        .map(|_| {
            let mut greedy = connect_from(3, server.address).unwrap();
            greedy.write_all(&asked).unwrap();
            let mut first = [0; 12];
            greedy.read_exact(&mut first).unwrap();
            assert_eq!(&first, b"HTTP/1.1 200");
            greedy
        })
        .collect();
    let mut fourth = connect_from(3, server.address).unwrap();
    fourth.write_all(&Request::new("GET", "/v1/info").bytes(server.address)).unwrap();
    assert_eq!(Reply::read(&mut BufReader::new(&fourth), false).unwrap().status, 503);
    assert!(is_answered());
    drop(held);
}

#[test]
fn a_newcomer_is_answered_beside_connections_that_wait_for_refusals() {
    let server = Server::start(&["--limit", "connections=8", "--limit", "queue=0"]).unwrap();
    let ask = Request::new("POST", "/v1/generate")
        .keep()
        .json(&json!({"scene_id": "demo-crossing", "agents": ["5"]}));
    let pipelined = ask.bytes(server.address).repeat(200);
    let refused: Vec<_> = (0..24)
        .map(|_| {
            let mut stream = TcpStream::connect(server.address).unwrap();
            let _ = stream.write_all(&pipelined);
            stream
        })
        .collect();
    for _ in 0..20 {
        assert_eq!(server.get("/v1/info").unwrap().status, 200);
    }
    drop(refused);
}

#[cfg(target_os = "linux")]
#[test]
fn connections_stay_below_the_descriptors_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = std::process::Command::new("sh");
    command.args(["-c", "ulimit -n 128; exec \"$0\" serve --port 0 --db \"$1\""]);
    command
        .arg(dragtraffic_tests::program::program())
        .arg(folder.path().join("s.sqlite"))
        .env("DRAGTRAFFIC_LOG", "error");
    let server = Server::launch(command).unwrap();
    let most =
        |server: &Server| server.get("/v1/info").unwrap().json()["limits"]["connections"]["value"].as_u64();
    assert_eq!(most(&server), Some(20));
    let idle: Vec<_> = (0..200).map(|_| TcpStream::connect(server.address)).collect();
    assert_eq!(server.get("/healthz").unwrap().status, 200);
    drop(idle);
}

#[test]
fn scenes_are_held_without_what_no_answer_depends_on() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let mut body = generate(2);
    body["hold"] = json!(true);
    body["steps"] = json!(1);
    body["scene"]["x_big"] = json!(vec!["some letters of no use"; 40_000]);
    server.post("/v1/generate", &body).unwrap();
    let before = server.memory().unwrap();
    for seed in 0..100 {
        body["seed"] = json!(seed);
        let reply = server.post("/v1/generate", &body).unwrap();
        assert_eq!(reply.status, 200, "{}", reply.text());
    }
    // Held with their useless members, the scenes took 4 MB each.
    let grown = server.memory().unwrap().saturating_sub(before);
    assert!(grown < 80 << 20, "{grown} bytes more");
    assert!(server.peak_memory().unwrap() < 300 << 20, "{:?}", server.peak_memory());
}

/// Lanes that each lead to 30 others: a file with many links.
fn linked() -> Value {
    const LANES: usize = 1_000;
    let mut scene = street(2, 20);
    let lane = |i: usize| {
        let (x, y) = ((i % 30) as f64 * 30.0 - 100.0, (i / 30) as f64 * 4.0);
        let next: Vec<String> = (1..=30).map(|k| format!("g{}", (i + k) % LANES)).collect();
        json!({"id": format!("g{i}"), "type": "surface_street", "points_m": [[x, y], [x + 30.0, y]],
            "successors": next})
    };
    scene["map"]["lanes"].as_array_mut().unwrap().extend((0..LANES).map(lane));
    scene
}

#[test]
fn an_export_whose_reader_leaves_gives_its_place_and_memory_back() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let running = |lane| server.metric(&format!("dragtraffic_running{{lane=\"{lane}\"}}")).unwrap();
    let under_way = || running("quick") + running("patient");
    let taken = || server.metric("dragtraffic_memory_taken_bytes").unwrap();
    let request = Request::new("POST", "/v1/export?format=opendrive").json(&linked());
    let began = Instant::now();
    let reply = request.send(server.address).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    let whole = began.elapsed();
    let wait = |is_there: &dyn Fn() -> bool| {
        let began = Instant::now();
        while !is_there() {
            assert!(began.elapsed() < Duration::from_secs(30), "in vain");
            std::thread::sleep(Duration::from_millis(2));
        }
        began.elapsed()
    };
    wait(&|| under_way() == 0.0);
    let at_rest = taken();
    let stream = request.open(server.address).unwrap();
    wait(&|| under_way() > 0.0);
    assert!(taken() > at_rest, "a file on its way out takes memory");
    drop(stream);
    let stopped = wait(&|| under_way() == 0.0 && taken() <= at_rest);
    assert!(stopped < whole / 2, "it went on for {stopped:?}; as a whole it takes {whole:?}");
}
