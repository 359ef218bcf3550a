//! Metadata of a reply: the code of its inputs, and the events that are reported in it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};

fn ask(server: &Server, more: &Value) -> Value {
    let mut body = json!({"scene_id": "demo-crossing", "agents": ["5"], "seed": 3});
    body.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
    let reply = server.send(&Request::new("POST", "/v1/generate").json(&body)).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    reply.json()
}

fn code(answer: &Value) -> String {
    answer["code"].as_str().unwrap().to_owned()
}

/// Clients show their order and no figure as long as `calibrated` is false.
#[test]
fn probabilities_are_said_to_be_relative_weights() {
    let server = Server::start(&[]).unwrap();
    let answer = ask(&server, &json!({}));
    assert_eq!(answer["calibrated"], false);
    let modes = answer["samples"][0]["agents"]["5"]["modes"].as_array().unwrap().iter();
    let weights: Vec<f64> = modes.map(|mode| mode["probability"].as_f64().unwrap()).collect();
    assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-6, "{weights:?}");
}

#[test]
fn equal_calls_have_equal_codes_and_a_change_has_another() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let usual = code(&ask(&server, &json!({})));
    assert_eq!(usual.len(), 6);
    assert!(
        usual.chars().all(|c| c.is_ascii_digit() || c.is_ascii_uppercase() && !"ILOU".contains(c)),
        "{usual}"
    );
    // The transport and the client are not part of its inputs.
    let sent = json!({"client": "a", "revision": 1, "draft_delay_ms": 8, "draft_interval_ms": 20, "futures": "compact"});
    assert_eq!(code(&ask(&server, &sent)), usual);
    let goal = json!({"goal": {"x_m": -20.0, "y_m": 0.0}});
    let changes = [
        json!({"seed": 4}),
        json!({"diversity": 0.6}),
        json!({"agents": ["6"]}),
        json!({"conditions": {"5": goal}}),
        json!({"thresholds": {"gap_m": 2.0}}),
    ];
    let mut codes: Vec<String> = changes.iter().map(|change| code(&ask(&server, change))).collect();
    codes.push(usual);
    codes.sort();
    codes.dedup();
    assert_eq!(codes.len(), changes.len() + 1);
}

#[test]
fn thresholds_decide_what_is_said_and_change_no_motion() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let count = |answer: &Value, of: &str| answer["scores"][0]["scene"][of].as_array().unwrap().len();
    let usual = ask(&server, &json!({"agents": "all"}));
    let strict = ask(
        &server,
        &json!({"agents": "all", "thresholds": {"gap_m": 4.0, "ttc_s": 4.0, "closing_speed_mps": 0.0, "harsh_brake_mps2": 1.0}}),
    );
    assert!(count(&strict, "near_misses") > count(&usual, "near_misses"));
    assert!(count(&strict, "harsh_braking") > count(&usual, "harsh_braking"));
    assert_eq!(strict["scores"][0]["thresholds"]["gap_m"], 4.0);
    let faults = |answer: &Value| {
        let agents = answer["samples"][0]["agents"].as_object().unwrap().values();
        let modes = agents.flat_map(|a| a["modes"].as_array().unwrap());
        modes.map(|m| m["faults"].as_array().map_or(0, Vec::len)).sum::<usize>()
    };
    assert!(faults(&strict) > faults(&usual));
    let places = |answer: &Value| answer["samples"][0]["agents"]["5"]["modes"][0]["x_m"].clone();
    assert_eq!(places(&strict), places(&usual));
    let body = json!({"scene_id": "demo-crossing", "thresholds": {"gap_m": 99.0}});
    let refused = server.send(&Request::new("POST", "/v1/generate").json(&body)).unwrap();
    assert_eq!((refused.status, &refused.json()["errors"][0]["pointer"]), (422, &json!("/thresholds/gap_m")));
}

#[test]
fn a_picked_future_goes_on_past_its_end() {
    let server = Server::start(&[]).unwrap();
    server.wait_ready().unwrap();
    let first = ask(&server, &json!({}));
    let mut scene = server.send(&Request::new("GET", "/v1/scenes/demo-crossing")).unwrap().json();
    scene["generated"] = first["generated"].clone();
    scene["generated"]["samples"] = first["samples"].clone();
    let futures = |answer: &Value| answer["samples"][0]["agents"]["5"].clone();
    let xs = |answer: &Value| {
        let chosen = futures(answer)["chosen"].as_u64().unwrap() as usize;
        futures(answer)["modes"][chosen]["x_m"].as_array().unwrap().clone()
    };
    for replan_s in [3, 9] {
        let asked = json!({"scene": scene, "agents": ["5"], "pinned": ["5"], "seed": 3, "horizon_s": 15,
            "replan_interval_s": replan_s, "react": true});
        let reply = server.send(&Request::new("POST", "/v1/generate").json(&asked)).unwrap();
        assert_eq!(reply.status, 200, "{}", reply.text());
        let longer = xs(&reply.json());
        assert_eq!(longer.len(), 150, "re-planned every {replan_s} s");
        assert_eq!(longer[..90], xs(&first)[..], "re-planned every {replan_s} s");
        // It does not stop at the end of what was picked.
        let far_m = longer[149].as_f64().unwrap() - longer[89].as_f64().unwrap();
        assert!(far_m.abs() > 1.0, "{far_m} m");
    }
}
