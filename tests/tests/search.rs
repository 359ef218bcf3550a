//! Searches over HTTP: tries as they come, results that can be rebuilt, an immediate end, and refusals.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Car 4 of the crossing; speed and position are searched.
fn body(more: &Value) -> Value {
    let mut body = json!({
        "scene_id": "demo-crossing", "where": "actor.min_ttc_s < 2.5", "tries": 8,
        "situation": {"agents": ["4"], "goal": {
            "ahead_m": {"uniform": [10, 45]}, "speed_mps": {"uniform": [0, 12]},
        }},
        "generate": {"horizon_s": 6},
    });
    body.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    body
}

fn events(server: &Server, body: &Value) -> Vec<Value> {
    let request = Request::new("POST", "/v1/search").header("accept", "application/x-ndjson").json(body);
    let reply = server.send(&request).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    reply.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn tries_come_as_events_and_are_made_again_by_their_requests() {
    let server = Server::start(&[]).unwrap();
    let all = events(&server, &body(&json!({})));
    let names: Vec<&str> = all.iter().map(|event| event["event"].as_str().unwrap()).collect();
    assert_eq!((names[0], names[1], names[names.len() - 1]), ("accepted", "try", "final"));
    assert_eq!(all[0]["varied"], json!(["goal.ahead_m", "goal.speed_mps"]));
    let last = &all[all.len() - 1];
    let tries = last["tries"].as_array().unwrap();
    assert_eq!((tries.len(), &last["ended"]), (8, &json!("tries")));
    // The tries are in the order of the events, and the found ones satisfy the condition.
    for (i, of) in tries.iter().enumerate() {
        assert_eq!((&of["number"], &of["drawn"]), (&json!(i), &all[i + 1]["drawn"]));
        let ttc_s = of["figures"]["actor.min_ttc_s"].as_f64();
        let is_found = last["found"].as_array().unwrap().contains(&json!(i));
        assert_eq!(is_found, ttc_s.is_some_and(|ttc_s| ttc_s < 2.5), "{of}");
        assert_eq!(is_found, of["outcome"] == "kept", "{of}");
    }
    let nearest = &tries[last["nearest"].as_u64().unwrap() as usize];
    let least = tries.iter().filter_map(|of| of["miss"].as_f64()).fold(f64::MAX, f64::min);
    assert_eq!(nearest["miss"].as_f64().unwrap(), least);

    let mut request = nearest["request"].clone();
    request["scene_id"] = json!("demo-crossing");
    let again = server.post("/v1/generate", &request).unwrap();
    assert_eq!((again.status, &again.json()["code"]), (200, &nearest["code"]), "{}", again.text());

    // Equal requests give equal tries; another seed gives others.
    let drawn = |all: &[Value]| all.iter().map(|event| event["drawn"].clone()).collect::<Vec<_>>();
    assert_eq!(drawn(&events(&server, &body(&json!({})))), drawn(&all));
    assert_ne!(drawn(&events(&server, &body(&json!({"seed": 1})))), drawn(&all));
}

#[test]
fn figures_of_a_pair_are_those_with_the_named_road_user() {
    let server = Server::start(&[]).unwrap();
    let gaps = |with: Value| {
        let mut asked = body(&json!({"where": "pair.gap_m < 5 && pair.other_first == 0", "tries": 4}));
        asked["situation"]["with"] = with;
        let tries = server.post("/v1/search", &asked).unwrap().json()["tries"].clone();
        let of = |one: &Value| (one["other"].clone(), one["figures"]["pair.gap_m"].as_f64());
        tries.as_array().unwrap().iter().map(of).collect::<Vec<_>>()
    };
    let (near, far, any) = (gaps(json!("5")), gaps(json!("1")), gaps(Value::Null));
    assert_eq!([near.len(), far.len(), any.len()], [4, 4, 4]);
    assert!(near.iter().all(|(other, _)| *other == "5") && any.iter().all(|(other, _)| other.is_null()));
    assert!(near.iter().zip(&far).any(|(near, far)| near.1 != far.1), "{near:?} {far:?}");
    // Without a name, the figures are those of the hardest pair.
    assert!(any.iter().any(|(_, gap_m)| gap_m.is_some()), "{any:?}");
}

#[test]
fn a_search_ends_with_what_was_wanted_or_when_its_client_leaves() {
    let server = Server::start(&[]).unwrap();
    // Every result satisfies this condition.
    let one = json!({"found": 3, "tries": 1000, "where": "collisions >= 0", "method": "random"});
    let reply = server.post("/v1/search", &body(&one)).unwrap().json();
    assert_eq!((&reply["ended"], &reply["found"]), (&json!("found"), &json!([0, 1, 2])), "{reply}");

    let none = body(&json!({"tries": 1000, "where": "collisions < 0"}));
    let request = Request::new("POST", "/v1/search").header("accept", "application/x-ndjson").json(&none);
    let (head, mut lines) = request.stream(server.address).unwrap();
    assert_eq!(head.status, 200);
    for _ in 0..3 {
        assert!(lines.next().is_some());
    }
    drop(lines);
    let idle = "dragtraffic_running{lane=\"patient\"}";
    let since = Instant::now();
    while server.metric(idle).unwrap() > 0.0 {
        assert!(since.elapsed() < Duration::from_secs(20), "the search goes on");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn faults_are_named_by_their_members() {
    let server = Server::start(&[]).unwrap();
    let refused = |more: Value| {
        let reply = server.post("/v1/search", &body(&more)).unwrap();
        let pointer = reply.json()["errors"][0]["pointer"].as_str().unwrap_or_default().to_owned();
        (reply.status, reply.code(), pointer)
    };
    let wrong = |code: &str, pointer: &str| (422, code.to_owned(), pointer.to_owned());
    assert_eq!(refused(json!({"where": "min_tcc_s < 1"})), wrong("invalid-field", "/where"));
    assert_eq!(refused(json!({"tries": 2000})), wrong("out-of-range", "/tries"));
    let unknown = json!({"situation": {"template": "cutin"}});
    assert_eq!(refused(unknown), wrong("invalid-field", "/situation/template"));
    assert_eq!(refused(json!({"trys": 3})), wrong("invalid-field", "/trys"));
    let absent = server.post("/v1/search", &body(&json!({"scene_id": "nothing"}))).unwrap();
    assert_eq!((absent.status, absent.code().as_str()), (404, "not-found"));
}
