//! Rounds with feedback over HTTP: cards, feedback, the next cards.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};

fn ask(server: &Server, feedback: Value) -> Value {
    let body = json!({"scene_id": "demo-crossing", "agents": ["5"], "seed": 3, "score": false, "feedback": feedback});
    let reply = server.send(&Request::new("POST", "/v1/generate").json(&body)).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    reply.json()
}

/// A card as a client sends it back.
fn said(card: &Value, verdict: &str) -> Value {
    json!({"features": card["features"], "places": card["places"], "verdict": verdict})
}

#[test]
fn cards_are_sent_back_and_the_next_ones_follow() {
    let server = Server::start(&[]).unwrap();
    // The examples exist once it is ready.
    server.wait_ready().unwrap();
    let first = ask(&server, json!({}));
    let cards = first["feedback"]["cards"].as_array().unwrap();
    let futures = &first["samples"][0]["agents"]["5"];
    assert_eq!((cards.len(), futures["modes"].as_array().unwrap().len()), (6, 6));
    assert_eq!(first["samples"].as_array().unwrap().len(), 1);
    let pace = |card: &Value| card["features"]["pace_mps"].as_f64().unwrap();
    let mut by_pace: Vec<&Value> = cards.iter().collect();
    by_pace.sort_by(|a, b| pace(b).total_cmp(&pace(a)));
    let answers: Vec<Value> = by_pace
        .iter()
        .enumerate()
        .map(|(i, card)| said(card, if i < 2 { "keep" } else { "reject" }))
        .collect();
    let mean = |cards: &[Value]| cards.iter().map(pace).sum::<f64>() / cards.len() as f64;
    let next = ask(&server, json!({"answers": answers}));
    let round = &next["feedback"];
    let told = round["wishes"].as_array().unwrap();
    let wish = told.iter().find(|wish| wish["trait"] == "pace").unwrap();
    assert_eq!((&wish["wants"], &wish["said"]), (&json!("more"), &json!(false)));
    let faster = round["cards"].as_array().unwrap();
    assert!(pace(&faster[0]) > mean(cards), "{} then {}", mean(cards), pace(&faster[0]));
    assert!(faster[0]["match"].as_f64().unwrap() > 0.0);
    assert!(faster.iter().all(|card| cards.iter().all(|old| old["places"] != card["places"])));
    assert_eq!(next["generated"]["request"]["feedback"]["answers"].as_array().unwrap().len(), 6);
    // A wish taken back is not learned again.
    let forgotten = ask(&server, json!({"answers": answers, "forgotten": [{"trait": "pace"}]}));
    let told = forgotten["feedback"]["wishes"].as_array().unwrap();
    assert!(told.iter().all(|wish| wish["trait"] != "pace"));
    assert!(ask(&server, json!({}))["feedback"] == first["feedback"]);
}

#[test]
fn nonsense_is_told_where_it_is() {
    let server = Server::start(&[]).unwrap();
    // The examples exist once it is ready.
    server.wait_ready().unwrap();
    let features = json!({"pace_mps": 5.0, "gap_s": 5.0, "harshness_mps2": 1.0, "standing_s": 0.0});
    let answer = json!({"features": features, "verdict": "keep"});
    let with = |pointer: &str, value: Value| {
        let mut answer = answer.clone();
        *answer.pointer_mut(pointer).unwrap() = value;
        json!({"answers": [answer]})
    };
    let mut crowded = answer.clone();
    let firsts: serde_json::Map<String, Value> = (0..70).map(|i| (i.to_string(), json!(true))).collect();
    crowded["features"]["first"] = json!({"5": firsts});
    let mut long = answer.clone();
    long["places"] = json!({"5": vec![[0.0, 0.0]; 42]});
    let cases = [
        (with("/verdict", json!("maybe")), "/feedback/answers/0/verdict"),
        (with("/features/pace_mps", json!(1e9)), "/feedback/answers/0/features/pace_mps"),
        (json!({"answers": vec![answer.clone(); 201]}), "/feedback/answers"),
        (json!({"answers": [crowded]}), "/feedback/answers"),
        (json!({"answers": [long]}), "/feedback/answers/0/places/5"),
        (json!({"wishes": [{"trait": "colour", "wants": "more"}]}), "/feedback/wishes/0"),
        (json!({"wish": []}), "/feedback/wish"),
    ];
    for (feedback, pointer) in cases {
        let body = json!({"scene_id": "demo-crossing", "agents": ["5"], "feedback": feedback});
        let reply = server.send(&Request::new("POST", "/v1/generate").json(&body)).unwrap();
        let problem = reply.json();
        assert_eq!(reply.status, 422, "{problem}");
        let at = problem["errors"][0]["pointer"].as_str().unwrap();
        assert!(at.starts_with(pointer), "{at} for {pointer}");
    }
}
