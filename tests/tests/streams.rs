//! Generation over HTTP: three representations, latest wins, cancelling, many clients at once.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::scenes::{generate, street};
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Only long calls: their bodies are read in another queue.
const RUNNING: &str = "dragtraffic_running{lane=\"patient\"}";
const WAITING: &str = "dragtraffic_queue_length{lane=\"patient\"}";

fn ask(body: &Value, accept: &str) -> Request {
    Request::new("POST", "/v1/generate").header("accept", accept).json(body)
}

fn ndjson(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn sse(text: &str) -> Vec<Value> {
    let data = text.lines().filter_map(|line| line.strip_prefix("data: "));
    data.map(|data| serde_json::from_str(data).unwrap()).collect()
}

/// A body that takes long: many steps for many road users.
fn long(client: &str, revision: u64) -> Value {
    let mut body = generate(24);
    body["agents"] = json!("all");
    body["steps"] = json!(100);
    body["client"] = json!(client);
    body["revision"] = json!(revision);
    body["score"] = json!(false);
    body
}

/// A body with an even longer answer, larger than the sockets' buffers.
fn endless(client: &str, revision: u64) -> Value {
    let mut body = long(client, revision);
    body["stream_modes"] = json!("all");
    body["samples"] = json!(16);
    body
}

/// A drag sends its surroundings once, and refers to them afterwards.
#[test]
fn a_scene_is_held_for_the_calls_that_follow() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(6);
    let plain = server.send(&ask(&body, "application/json")).unwrap();
    assert_eq!(plain.header("dragtraffic-scene"), "");
    body["hold"] = json!(true);
    let first = server.send(&ask(&body, "application/x-ndjson")).unwrap();
    let name = first.header("dragtraffic-scene").to_owned();
    assert!(name.starts_with("held:"), "{name}");

    let mut follows = body.clone();
    follows.as_object_mut().unwrap().retain(|member, _| member != "scene" && member != "hold");
    follows["scene_id"] = json!(name);
    let second = server.send(&ask(&follows, "application/json")).unwrap();
    assert_eq!(second.status, 200, "{}", second.text());
    assert_eq!(second.json()["samples"], plain.json()["samples"], "the same answer as with the scene");
    println!(
        "a call with its scene takes {} bytes, one that names it {}",
        body.to_string().len(),
        follows.to_string().len()
    );

    follows["scene_id"] = json!("held:0190");
    let gone = server.send(&ask(&follows, "application/json")).unwrap();
    assert_eq!((gone.status, gone.json()["code"].clone()), (404, json!("not-found")), "{}", gone.text());
}

#[test]
fn via_points_are_passed_reported_and_stored() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(1);
    // The next lane half way, at its own time, and a second place that is unreachable in time.
    let via = json!([{"x_m": -20.0, "y_m": 3.5, "tolerance_m": 1.0, "time_s": 4.5}]);
    body["conditions"]["0"]["via"] = via.clone();
    let answer = server.send(&ask(&body, "application/json")).unwrap();
    assert_eq!(answer.status, 200, "{}", answer.text());
    let passed = &answer.json()["resolved"]["0"]["via"][0];
    assert_eq!(passed["passed"], json!(true), "{passed}");
    assert!(
        passed["distance_m"].as_f64().unwrap() <= 1.0
            && (passed["time_s"].as_f64().unwrap() - 4.5).abs() <= 0.5
    );
    body["conditions"]["0"]["via"] = json!([{"x_m": 60.0, "y_m": 40.0}]);
    let missed = server.send(&ask(&body, "application/json")).unwrap().json();
    assert_eq!(missed["resolved"]["0"]["via"][0]["passed"], json!(false));
    let modes = missed["samples"][0]["agents"]["0"]["modes"].as_array().unwrap();
    let says = |mode: &Value| mode["faults"].as_array().unwrap().iter().any(|f| f["kind"] == "via_missed");
    assert!(modes.iter().all(says), "every future says that it misses the place");
    assert!(missed["warnings"].as_array().unwrap().iter().any(|w| w["code"] == "via-missed"));
    // A stored scene keeps them.
    let mut scene = street(1, 91);
    scene["agents"][0]["conditions"] = json!({"via": via});
    let stored = server.send(&Request::new("POST", "/v1/scenes").json(&scene)).unwrap();
    assert_eq!(stored.status, 201, "{}", stored.text());
    let id = stored.json()["id"].as_str().unwrap().to_owned();
    let back = server.send(&Request::new("GET", &format!("/v1/scenes/{id}"))).unwrap().json();
    assert_eq!(back["agents"][0]["conditions"]["via"], via);
}

#[test]
fn three_representations_have_equal_samples() {
    let server = Server::start(&[]).unwrap();
    let body = generate(4);
    let plain = server.send(&ask(&body, "application/json")).unwrap();
    assert_eq!(plain.status, 200, "{}", plain.text());
    let lines = server.send(&ask(&body, "application/x-ndjson")).unwrap();
    let events = server.send(&ask(&body, "text/event-stream")).unwrap();
    let (lines, events) = (ndjson(&lines.text()), sse(&events.text()));
    for list in [&lines, &events] {
        let names: Vec<&str> = list.iter().map(|e| e["event"].as_str().unwrap()).collect();
        assert_eq!(names.first(), Some(&"accepted"));
        assert_eq!(names.last(), Some(&"final"));
        assert_eq!(names.iter().filter(|n| ["final", "error", "superseded"].contains(n)).count(), 1);
        let initial = names.iter().position(|n| *n == "initial");
        let step = names.iter().position(|n| *n == "step");
        assert!(initial.is_some() && step.is_none_or(|s| Some(s) > initial), "{names:?}");
        assert!(list.windows(2).all(|w| w[0]["seq"].as_u64() < w[1]["seq"].as_u64()));
        assert_eq!(list.last().unwrap()["samples"], plain.json()["samples"]);
    }
    let last = plain.json();
    let modes = last["samples"][0]["agents"]["0"]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 6);
    assert_eq!(modes[0]["x_m"].as_array().unwrap().len(), 90);
    assert_eq!(modes[0]["first_step"], 1);
    assert_eq!(last["resolved"]["0"]["goal"]["x_m"]["from"], "user");
    assert!(last["resolved"]["0"]["reach"]["status"].is_string());
    assert_eq!(last["scores"].as_array().unwrap().len(), 1);
    let x = modes[0]["x_m"][40].as_f64().unwrap();
    assert!(((x * 1000.0).round() / 1000.0 - x).abs() < 1e-12, "rounded to a millimetre");
}

#[test]
fn drafts_sooner_or_closer_than_asked_are_left_out() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(4);
    let names = |body: &Value| {
        let list = ndjson(&server.send(&ask(body, "application/x-ndjson")).unwrap().text());
        let names: Vec<String> = list.iter().map(|e| e["event"].as_str().unwrap().to_owned()).collect();
        (names, list.last().unwrap()["samples"].clone())
    };
    let (all, samples) = names(&body);
    assert_eq!(all, ["accepted", "initial", "step", "step", "step", "step", "step", "final"]);
    body["draft_interval_ms"] = json!(1000);
    assert_eq!(names(&body), (["accepted", "initial", "final"].map(str::to_owned).to_vec(), samples.clone()));
    body["draft_delay_ms"] = json!(1000);
    assert_eq!(names(&body), (["accepted", "final"].map(str::to_owned).to_vec(), samples));
    body["draft_delay_ms"] = json!(0);
    body["draft_interval_ms"] = json!(1001);
    let reply = server.post("/v1/generate", &body).unwrap();
    assert_eq!((reply.status, &reply.json()["errors"][0]["pointer"]), (422, &json!("/draft_interval_ms")));
}

#[test]
fn twenty_seconds_are_planned_window_after_window() {
    let server = Server::start(&[]).unwrap();
    let mut body = generate(4);
    body["agents"] = json!("all");
    body["horizon_s"] = json!(20);
    body["replan_interval_s"] = json!(6);
    body["conditions"]["0"]["goal"] = json!({"x_m": 90.0, "y_m": 0.0, "time_s": 16.0});
    let plain = server.post("/v1/generate", &body).unwrap();
    assert_eq!(plain.status, 200, "{}", plain.text());
    let last = plain.json();
    assert_eq!(last["windows"], 4);
    for agent in last["samples"][0]["agents"].as_object().unwrap().values() {
        let chosen = &agent["modes"][agent["chosen"].as_u64().unwrap() as usize];
        assert_eq!((&chosen["first_step"], chosen["x_m"].as_array().unwrap().len()), (&json!(1), 200));
        let lengths = agent["modes"].as_array().unwrap().iter().map(|m| m["x_m"].as_array().unwrap().len());
        assert_eq!(lengths.filter(|n| *n == 90).count(), 5, "the alternatives end with the first window");
    }
    let futures = &last["samples"][0]["agents"]["0"];
    let x = futures["modes"][futures["chosen"].as_u64().unwrap() as usize]["x_m"][159].as_f64().unwrap();
    assert!((x - 90.0).abs() < 0.1, "{x}");
    let told = last["resolved"]["0"]["intermediate"].as_array().unwrap();
    assert_eq!(told.iter().map(|i| i["window"].as_u64().unwrap()).collect::<Vec<_>>(), [0, 1]);
    assert!((told[0]["time_s"].as_f64().unwrap() - 9.0).abs() < 1e-9 && told[0]["x_m"].is_number());
    let lines = ndjson(&server.send(&ask(&body, "application/x-ndjson")).unwrap().text());
    assert_eq!(lines[0]["windows"], 4);
    let drafts = lines.iter().filter(|e| e["event"] == "initial");
    assert_eq!(drafts.map(|e| e["window"].as_u64().unwrap()).collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert!(
        lines
            .windows(2)
            .all(|w| w[0]["window"].as_u64() <= w[1]["window"].as_u64() || w[1]["window"].is_null())
    );
    assert_eq!(lines.last().unwrap()["samples"], last["samples"]);
    // Saved with its scene, exported as a record of 20 s, and read again.
    let mut scene = body["scene"].clone();
    scene["generated"] = last["generated"].clone();
    scene["generated"]["samples"] = last["samples"].clone();
    let record = server.post("/v1/export?format=womd", &scene).unwrap();
    assert_eq!(record.status, 200, "{}", record.text());
    assert!(record.header("dragtraffic-loss").contains("long-record"));
    let losses: Value = serde_json::from_str(record.header("dragtraffic-losses")).unwrap();
    let long = losses.as_array().unwrap().iter().find(|loss| loss["code"] == "long-record").unwrap();
    assert_eq!(long["message"]["code"], "loss-longer");
    let steps = |name: &str| long["message"]["values"][name].as_f64().unwrap();
    assert!(steps("steps") > steps("known"), "{long}");
    let again = Request::new("POST", "/v1/import?dry_run=true&format=womd")
        .header("content-type", "application/octet-stream")
        .body(record.body.clone());
    let again = server.send(&again).unwrap();
    assert_eq!(again.status, 200, "{}", again.text());
    assert_eq!(again.json()["scenes"][0]["steps"], 201);
}

#[test]
fn answers_do_not_depend_on_who_else_is_regenerated_or_when_it_is_asked() {
    let server = Server::start(&[]).unwrap();
    let body = generate(4);
    let first = server.post("/v1/generate", &body).unwrap().json();
    let again = server.post("/v1/generate", &body).unwrap().json();
    assert_eq!(first["samples"], again["samples"]);
    assert_eq!(first["scores"], again["scores"]);
    let mut other = body.clone();
    other["seed"] = json!(8);
    assert_ne!(first["samples"], server.post("/v1/generate", &other).unwrap().json()["samples"]);
}

#[test]
fn a_newer_revision_takes_over_and_an_older_one_is_refused() {
    let server = Server::start(&[]).unwrap();
    let (head, mut lines) = ask(&long("tab", 5), "application/x-ndjson").stream(server.address).unwrap();
    assert_eq!(head.status, 200);
    assert!(lines.next().unwrap().contains("\"accepted\""));
    let mut newer = generate(2);
    newer["client"] = json!("tab");
    newer["revision"] = json!(6);
    let answer = server.post("/v1/generate", &newer).unwrap();
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(answer.json()["revision"], 6);
    let last: Value = serde_json::from_str(&lines.last().unwrap()).unwrap();
    assert_eq!((last["event"].as_str(), last["by_revision"].as_u64()), (Some("superseded"), Some(6)));
    let stale = server.post("/v1/generate", &newer).unwrap();
    assert_eq!((stale.status, stale.code().as_str()), (409, "stale-revision"));
    assert_eq!(stale.json()["highest_revision"], 6);
}

#[test]
fn a_superseded_plain_call_is_a_conflict() {
    let server = Server::start(&[]).unwrap();
    let address = server.address;
    let older =
        std::thread::spawn(move || ask(&endless("tab", 1), "application/json").send(address).unwrap());
    while server.metric(RUNNING).unwrap() < 1.0 {
        std::thread::sleep(Duration::from_millis(10));
    }
    let mut newer = generate(2);
    newer["client"] = json!("tab");
    newer["revision"] = json!(2);
    assert_eq!(server.post("/v1/generate", &newer).unwrap().status, 200);
    let older = older.join().unwrap();
    assert_eq!((older.status, older.code().as_str()), (409, "superseded"));
}

#[test]
fn work_stops_when_the_reader_leaves() {
    let server = Server::start(&[]).unwrap();
    let (_, mut lines) = ask(&long("gone", 1), "application/x-ndjson").stream(server.address).unwrap();
    while !lines.next().unwrap().contains("\"event\":\"step\"") {}
    drop(lines);
    let made = server.metric("dragtraffic_steps_total").unwrap();
    let before = Instant::now();
    while server.metric("dragtraffic_running").unwrap() > 0.0 {
        assert!(before.elapsed() < Duration::from_secs(20), "still running");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(300));
    let more = server.metric("dragtraffic_steps_total").unwrap() - made;
    assert!(made < 90.0 && more <= 2.0, "after {made} steps {more} more were made for nobody");
}

#[test]
fn a_job_is_cancelled_by_its_id() {
    let server = Server::start(&[]).unwrap();
    let mut body = long("c", 1);
    body["job"] = json!("mine");
    let (_, mut lines) = ask(&body, "application/x-ndjson").stream(server.address).unwrap();
    assert!(lines.next().is_some());
    let twice = server.post("/v1/generate", &json!({"job": "mine", "scene": body["scene"]})).unwrap();
    assert_eq!((twice.status, twice.code().as_str()), (409, "exists"));
    assert_eq!(server.send(&Request::new("DELETE", "/v1/jobs/mine")).unwrap().status, 204);
    let last: Value = serde_json::from_str(&lines.last().unwrap()).unwrap();
    assert_eq!(last["problem"]["code"], "cancelled");
    assert_eq!(server.send(&Request::new("DELETE", "/v1/jobs/mine")).unwrap().status, 204, "idempotent");
}

/// Occupies the only worker and the only place in the queue of a server started with
/// `running=1` and `queue=1`, until what is returned is dropped.
fn fill_queue(server: &Server) -> impl Sized + use<> {
    // No client reads this reply: its worker waits as soon as the sockets are full.
    let running = ask(&endless("a", 1), "application/x-ndjson").open(server.address).unwrap();
    while server.metric(RUNNING).unwrap() < 1.0 {
        std::thread::sleep(Duration::from_millis(10));
    }
    // As long as the first one: a shorter one would be preferred to it.
    let waiting = ask(&endless("b", 1), "application/x-ndjson").open(server.address).unwrap();
    while server.metric(WAITING).unwrap() < 1.0 {
        std::thread::sleep(Duration::from_millis(10));
    }
    (waiting, running)
}

#[test]
fn a_full_queue_says_when_to_come_back() {
    let server = Server::start(&["--limit", "queue=1", "--limit", "running=1"]).unwrap();
    let held = fill_queue(&server);
    let refused = server.post("/v1/generate", &long("c", 1)).unwrap();
    assert_eq!((refused.status, refused.code().as_str()), (503, "busy"));
    assert!((1..=60).contains(&refused.header("retry-after").parse::<u32>().unwrap()));
    drop(held);
}

#[test]
fn all_work_waits_in_the_same_queue() {
    let server = Server::start(&["--limit", "queue=0"]).unwrap();
    let scene = street(2, 20);
    let calls = [
        ("/v1/generate", generate(1)),
        ("/v1/place", json!({"scene": scene, "density": {"count": 3}})),
        ("/v1/score", json!({ "scene": scene })),
        ("/v1/export?format=womd", scene.clone()),
        ("/v1/import?dry_run=true", scene.clone()),
        // Large enough not to be read immediately.
        ("/v1/scenes", street(40, 91)),
    ];
    for (path, body) in &calls {
        let reply = server.post(path, body).unwrap();
        assert_eq!((reply.status, reply.code().as_str()), (503, "busy"), "{path}: {}", reply.text());
        assert!(reply.header("retry-after").parse::<u32>().is_ok(), "{path}");
    }
    assert_eq!(server.post("/v1/scenes", &scene).unwrap().status, 201, "little ones need no worker");
}

#[test]
fn scenes_are_saved_while_all_workers_are_busy() {
    let server = Server::start(&["--limit", "running=1", "--limit", "queue=1"]).unwrap();
    let held = fill_queue(&server);
    let saved = server.post("/v1/scenes", &street(40, 91)).unwrap();
    assert_eq!(saved.status, 201, "{}", saved.text());
    assert_eq!(server.get(saved.header("location")).unwrap().status, 200);
    let placed = server.post("/v1/place", &json!({"scene": street(2, 20)})).unwrap();
    assert_eq!(placed.status, 200, "small calls have a lane of their own: {}", placed.text());
    drop(held);
}

#[test]
fn a_generation_has_a_time_limit() {
    let server = Server::start(&["--limit", "generate_s=0"]).unwrap();
    let reply = server.post("/v1/generate", &long("a", 1)).unwrap();
    assert_eq!((reply.status, reply.code().as_str()), (504, "generate-timeout"));
}

#[test]
fn a_reader_that_stops_reading_is_let_go() {
    let server = Server::start(&["--limit", "stalled_s=1", "--limit", "heartbeat_s=1"]).unwrap();
    let stalled = ask(&endless("slow", 1), "application/x-ndjson").open(server.address).unwrap();
    let began = Instant::now();
    while server.metric("dragtraffic_generates_total{outcome=\"cancelled\"}").unwrap() < 1.0 {
        assert!(began.elapsed() < Duration::from_secs(50), "still working for a reader that is gone");
        std::thread::sleep(Duration::from_millis(50));
    }
    drop(stalled);
}

#[test]
fn sixty_four_clients_at_once() {
    let server = Server::start(&["--limit", "queue=64"]).unwrap();
    server.wait_ready().unwrap();
    let expected = server.post("/v1/generate", &generate(2)).unwrap().json()["samples"].clone();
    let address = server.address;
    let clients: Vec<_> = (0..64)
        .map(|i| {
            std::thread::spawn(move || {
                let accept = ["application/json", "application/x-ndjson", "text/event-stream"][i % 3];
                let reply = ask(&generate(2), accept).send(address).unwrap();
                assert_eq!(reply.status, 200, "{}", reply.text());
                match i % 3 {
                    0 => reply.json(),
                    1 => ndjson(&reply.text()).pop().unwrap(),
                    _ => sse(&reply.text()).pop().unwrap(),
                }
            })
        })
        .collect();
    for client in clients {
        assert_eq!(client.join().unwrap()["samples"], expected);
    }
    // The last worker finishes its job just after the reply.
    let began = Instant::now();
    while server.metric("dragtraffic_running").unwrap() > 0.0 {
        assert!(began.elapsed() < Duration::from_secs(5), "still running");
    }
}
