//! Runs over HTTP: begun, stepped, peeked, saved, restored and forgotten; and what is refused.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Reply, Request, Server};
use serde_json::{Value, json};

/// Four cars of 10 m/s in two lanes; car 2 is 15 m ahead of car 0.
fn begun(server: &Server, more: &Value) -> Value {
    let mut body = json!({"scene": street(4, 20), "egos": ["2"]});
    body.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let reply = server.post("/v1/runs", &body).unwrap();
    assert_eq!(reply.status, 201, "{}", reply.text());
    reply.json()
}

/// Car 2 after this many steps of 0.1 s while it brakes with 4 m/s2.
fn braking(number: u64) -> Value {
    let t = (0.1 * number as f64).min(2.5);
    let x_m = -45.0 + 10.0 * t - 2.0 * t * t;
    json!({"id": "2", "x_m": x_m, "y_m": 0.0, "heading_rad": 0.0, "vx_mps": 10.0 - 4.0 * t, "vy_mps": 0.0})
}

fn step(server: &Server, run: &Value, number: u64) -> Reply {
    let path = format!("/v1/runs/{}/step", run["run"].as_str().unwrap());
    server.post(&path, &json!({"number": number, "egos": [braking(number)]})).unwrap()
}

fn refused(server: &Server, path: &str, body: &Value) -> (u16, String) {
    let reply = server.post(path, body).unwrap();
    (reply.status, reply.code())
}

#[test]
fn a_run_is_stepped_peeked_saved_and_forgotten() {
    let server = Server::start(&[]).unwrap();
    let run = begun(&server, &json!({"seed": 3}));
    assert_eq!((&run["egos"], &run["step_s"], &run["seed"]), (&json!(["2"]), &json!(0.1), &json!(3)));
    assert_eq!(run["present"]["states"].as_object().unwrap().len(), 4);
    let path = |what: &str| format!("/v1/runs/{}{what}", run["run"].as_str().unwrap());
    for number in 1..=5 {
        let reply = step(&server, &run, number);
        assert_eq!((reply.status, &reply.json()["number"]), (200, &json!(number)), "{}", reply.text());
    }
    // A lost reply can be requested again; any other number is out of order.
    let again = step(&server, &run, 5);
    assert_eq!((again.status, again.text()), (200, step(&server, &run, 5).text()));
    for wrong in [4, 7] {
        let reply = step(&server, &run, wrong);
        assert_eq!((reply.status, reply.code().as_str()), (409, "step-order"), "{}", reply.text());
        assert_eq!(reply.json()["message"]["values"]["next"].as_f64(), Some(6.0));
    }
    // What if the car keeps its velocity?
    let column = |of: &dyn Fn(f64) -> f64| (1..=90).map(|i| of(0.1 * f64::from(i))).collect::<Vec<_>>();
    let still = column(&|_| 0.0);
    let x_m = column(&|t| -40.0 + 8.0 * t);
    let on =
        json!({"x_m": x_m, "y_m": still, "heading_rad": still, "vx_mps": column(&|_| 8.0), "vy_mps": still});
    let peek = server.post(&path("/peek"), &json!({"plans": {"2": on}})).unwrap();
    assert_eq!(peek.status, 200, "{}", peek.text());
    assert_eq!(peek.json()["futures"]["0"]["x_m"].as_array().unwrap().len(), 90);
    // A restored copy continues with the same bytes.
    let saved = server.send(&Request::new("POST", &path("/snapshot"))).unwrap();
    assert_eq!(saved.status, 200, "{}", saved.text());
    let body = json!({"scene": street(4, 20), "snapshot": saved.json()["snapshot"]});
    let copy = server.post("/v1/runs", &body).unwrap();
    assert_eq!(copy.status, 201, "{}", copy.text());
    let copy = copy.json();
    assert_eq!(copy["present"]["number"], 5);
    for number in 6..=40 {
        let (one, other) = (step(&server, &run, number), step(&server, &copy, number));
        assert_eq!((one.status, one.text()), (200, other.text()), "step {number}");
        assert_eq!(one.json()["faults"], json!([]), "step {number}");
    }
    // The following car has reacted: it stands or nearly does.
    let last = step(&server, &run, 40).json();
    assert!(
        last["states"]["0"]["vx_mps"].as_f64().is_none_or(|v| v < 9.0) || last["states"]["0"]["y_m"] != 0.0
    );
    let delete = || server.send(&Request::new("DELETE", &path(""))).unwrap();
    assert_eq!(delete().status, 204);
    assert_eq!((delete().status, step(&server, &run, 41).status), (404, 404));
}

#[test]
fn a_run_is_stepped_over_a_websocket() {
    let server = Server::start(&[]).unwrap();
    let run = begun(&server, &json!({}));
    let open = |id: &str| {
        let stream = std::net::TcpStream::connect(server.address).unwrap();
        stream.set_read_timeout(Some(std::time::Duration::from_secs(60))).unwrap();
        tungstenite::client(format!("ws://{}/v1/runs/{id}/step", server.address), stream).map_err(Box::new)
    };
    let (mut line, _) = open(run["run"].as_str().unwrap()).unwrap();
    let mut ask = |number: u64| -> (Value, Value) {
        let body = json!({"number": number, "egos": [braking(number)]});
        line.send(json!({"ask": number, "body": body}).to_string().into()).unwrap();
        let (mut head, mut text) = (json!({}), String::new());
        while head["last"] != json!(true) {
            let message = line.read().unwrap();
            let Ok(piece) = message.to_text() else { continue };
            let Some((first, rest)) = piece.split_once('\n') else { continue };
            let new: Value = serde_json::from_str(first).unwrap();
            head.as_object_mut().unwrap().extend(new.as_object().unwrap().clone());
            text.push_str(rest);
        }
        (head, serde_json::from_str(&text).unwrap())
    };
    for number in 1..=3 {
        let (head, step) = ask(number);
        assert_eq!((&head["status"], &step["number"]), (&json!(200), &json!(number)), "{step}");
    }
    let (head, problem) = ask(9);
    assert_eq!((&head["status"], &problem["code"]), (&json!(409), &json!("step-order")));
    assert!(open("nothing").is_err());
}

#[test]
fn a_run_is_looked_at_and_followed_while_somebody_else_steps_it() {
    let server = Server::start(&["--limit", "run_idle_s=4"]).unwrap();
    let run = begun(&server, &json!({}));
    let path = format!("/v1/runs/{}", run["run"].as_str().unwrap());
    let follow = |accept: &str| {
        let request = Request::new("GET", &path).header("Accept", accept);
        let (head, events) = request.stream(server.address).unwrap();
        assert_eq!((head.status, head.header("content-type")), (200, accept));
        events
    };
    let mut lines = follow("application/x-ndjson");
    let mut event = || loop {
        let event: Value = serde_json::from_str(&lines.next().unwrap()).unwrap();
        if event["event"] != "heartbeat" {
            return event;
        }
    };
    let first = event();
    assert_eq!((&first["event"], &first["run"]["present"]["number"]), (&json!("run"), &json!(0)), "{first}");
    for number in 1..=3 {
        let stepped = step(&server, &run, number).json();
        assert_eq!(event(), json!({"event": "step", "step": stepped}));
    }
    let seen = server.get(&path).unwrap().json();
    assert_eq!((&seen["present"]["number"], &seen["egos"]), (&json!(3), &json!(["2"])));
    assert_eq!(seen["steps_left"], json!(36_000 - 3));
    assert!(seen["unused_s"].as_u64().unwrap() <= 4, "{seen}");
    let scene = server.get(&format!("{path}/scene")).unwrap();
    assert_eq!((scene.status, scene.json()["agents"].as_array().unwrap().len()), (200, 4));
    // Server-sent events begin with the present state of the run.
    let mut sse = follow("text/event-stream");
    let head: Vec<String> = sse.by_ref().take(2).collect();
    assert_eq!(head, ["event: run", "id: 3"]);
    // Watching does not count as use: the run is forgotten, and the stream ends.
    std::thread::sleep(std::time::Duration::from_millis(4_500));
    for what in ["", "/scene"] {
        let gone = server.get(&format!("{path}{what}")).unwrap();
        assert_eq!((gone.status, gone.code().as_str()), (404, "not-found"), "{}", gone.text());
    }
    assert_eq!(event(), json!({"event": "end"}));
    assert_eq!(lines.next(), None, "nothing follows the end");
    let wrong = Request::new("GET", "/v1/runs/nothing").header("Accept", "text/html").send(server.address);
    assert_eq!(wrong.unwrap().code(), "not-acceptable");
}

#[test]
fn the_example_of_the_document_begins_a_run() {
    let server = Server::with_demos().unwrap();
    let document = server.get("/openapi.json").unwrap().json();
    let content = &document["paths"]["/v1/runs"]["post"]["requestBody"]["content"]["application/json"];
    let reply = server.post("/v1/runs", &content["example"]).unwrap();
    assert_eq!((reply.status, &reply.json()["egos"]), (201, &json!(["5"])), "{}", reply.text());
}

#[test]
fn bad_requests_are_refused_with_their_places_and_change_nothing() {
    let server = Server::start(&[]).unwrap();
    let scene = street(2, 20);
    let bad = [
        (json!({"scene": scene, "egos": ["9"]}), 422, "unknown-agent"),
        (json!({"scene": scene, "egos": ["0", "0"]}), 422, "invalid-field"),
        (json!({"scene": scene, "step_s": 1.0}), 422, "out-of-range"),
        (json!({"scene": scene, "snapshot": "AAAA"}), 422, "invalid-field"),
        (json!({"scene": scene, "snapshot": "", "egos": []}), 422, "invalid-field"),
        (json!({"scene": scene, "planes": 1}), 422, "invalid-field"),
        (json!({"scene_id": "nothing"}), 404, "not-found"),
        (json!({"egos": []}), 422, "invalid-field"),
    ];
    for (body, status, code) in &bad {
        assert_eq!(refused(&server, "/v1/runs", body), (*status, (*code).to_owned()), "{body}");
    }
    let run = begun(&server, &json!({}));
    let path = |what: &str| format!("/v1/runs/{}/{what}", run["run"].as_str().unwrap());
    let at = |x_m: f64| json!({"id": "2", "x_m": x_m, "y_m": 0, "heading_rad": 0, "vx_mps": 10, "vy_mps": 0});
    let mut uneven = at(0.0);
    uneven["plan"] = json!({"x_m": [1.0], "y_m": [], "heading_rad": [0], "vx_mps": [0], "vy_mps": [0]});
    let mut other = at(0.0);
    other["id"] = json!("1");
    let bad = [
        (json!({"number": 1, "egos": []}), "invalid-field"),
        (json!({"number": 1, "egos": [at(0.0), at(0.0)]}), "invalid-field"),
        (json!({"number": 1, "egos": [at(1e6)]}), "out-of-range"),
        (json!({"number": 1, "egos": [uneven]}), "invalid-field"),
        (json!({"number": 1, "egos": [at(0.0), other]}), "invalid-field"),
        (json!({"number": -1, "egos": [at(0.0)]}), "invalid-field"),
    ];
    for (body, code) in &bad {
        assert_eq!(refused(&server, &path("step"), body), (422, (*code).to_owned()), "{body}");
    }
    assert_eq!(refused(&server, &path("peek"), &json!({"plans": {"1": {}}})).0, 422);
    assert_eq!(refused(&server, "/v1/runs/nothing/step", &json!({"number": 1})), (404, "not-found".into()));
    assert_eq!(step(&server, &run, 1).status, 200);
}

#[test]
fn runs_are_bounded_and_idle_ones_are_forgotten() {
    let flags = ["--limit", "runs=4", "--limit", "run_idle_s=2"];
    let server = Server::start(&flags).unwrap();
    let run = begun(&server, &json!({}));
    begun(&server, &json!({}));
    // One party has at most half of them.
    let body = json!({"scene": street(4, 20)});
    let full = server.post("/v1/runs", &body).unwrap();
    assert_eq!((full.status, full.code().as_str()), (429, "too-many-runs"), "{}", full.text());
    assert_eq!(full.json()["limit"], 2);
    assert!(full.header("retry-after").parse::<u64>().unwrap() >= 1);
    std::thread::sleep(std::time::Duration::from_millis(2_500));
    let gone = step(&server, &run, 1);
    assert_eq!((gone.status, gone.code().as_str()), (404, "not-found"), "{}", gone.text());
    begun(&server, &json!({}));
}
