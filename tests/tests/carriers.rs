//! The same calls by HTTP, by the command line and directly: the same answers, byte for byte.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use api::feedback::FeedbackDoc;
use api::generate::GenerationRun;
use api::generate::request::AgentChoice;
use api::{AboutScene, GenerateRequest, Operations, Problem, SceneRef, Subject};
use dragtraffic_tests::Server;
use dragtraffic_tests::program::{program, root};
use experts::{Cancel, Engine};
use formats::native;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::process::Command;
use std::sync::LazyLock;

static OPERATIONS: LazyLock<Operations> = LazyLock::new(|| Operations::new(Engine::built_in().unwrap()));

fn path() -> String {
    root().join("assets/scenes/demo-crossing.json").display().to_string()
}

fn demo() -> Value {
    serde_json::from_slice(&std::fs::read(path()).unwrap()).unwrap()
}

/// A request and its scene, as any carrier has them: from JSON, with a home that has no scenes of its own.
fn opened<T: DeserializeOwned + AboutScene>(body: &Value) -> (T, Subject) {
    let mut request: T = serde_json::from_value(body.clone()).unwrap();
    let wanted: SceneRef = request.take_scene();
    let subject = api::home::at_once(OPERATIONS.open(wanted, &BTreeMap::new())).unwrap();
    (request, subject.map_err(|problem| problem.detail).unwrap())
}

fn printed(arguments: &[&str]) -> Vec<u8> {
    let output = Command::new(program()).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn posted(server: &Server, path: &str, body: &Value) -> String {
    let reply = server.post(path, body).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    reply.text().to_string()
}

/// An answer without the times that it took and the date.
fn timeless(mut answer: Value) -> String {
    answer["timing"] = Value::Null;
    answer["generated"]["created_at"] = Value::Null;
    for member in ["event", "seq", "job", "elapsed_ms"] {
        answer.as_object_mut().unwrap().remove(member);
    }
    answer.to_string()
}

#[test]
fn a_generation() {
    let server = Server::start(&[]).unwrap();
    let body = json!({"scene": demo(), "agents": ["6"], "react": true, "seed": 7, "samples": 2,
        "conditions": {"6": {"goal": {"x_m": -40.0, "y_m": 8.0}, "frame": "scene"}}});
    let (request, subject) = opened::<GenerateRequest>(&body);
    let call = OPERATIONS.generate(&request, &subject, Cancel::default());
    let answered = call.and_then(GenerationRun::answer).map_err(|problem| problem.detail).unwrap();
    let direct = serde_json::to_value(answered.body()).unwrap();
    let sent: Value = serde_json::from_str(&posted(&server, "/v1/generate", &body)).unwrap();
    assert_eq!(timeless(sent), timeless(direct.clone()));
    let flags = ["--agents", "6", "--react", "--seed", "7", "--samples", "2", "--goal", "6=-40,8", "--quiet"];
    let file: Value =
        serde_json::from_slice(&printed(&[&["generate", &path()], &flags[..]].concat())).unwrap();
    for (i, sample) in direct["samples"].as_array().unwrap().iter().enumerate() {
        let written = &file["generated"]["samples"][i]["agents"];
        assert_eq!(written.to_string(), sample["agents"].to_string());
    }
    for member in ["input_sha256", "weights", "seed", "request", "stale"] {
        assert_eq!(
            file["generated"][member].to_string(),
            direct["generated"][member].to_string(),
            "{member}"
        );
    }
}

#[test]
fn a_placement() {
    let server = Server::start(&[]).unwrap();
    let body =
        json!({"scene": demo(), "keep": [], "density": {"count": 12}, "seed": 3, "parked": {"share": 0.5}});
    let (request, subject) = opened(&body);
    let placed = OPERATIONS.place(&request, &subject, &Cancel::default());
    let direct = serde_json::to_value(placed.map_err(|problem| problem.detail).unwrap()).unwrap();
    let sent: Value = serde_json::from_str(&posted(&server, "/v1/place", &body)).unwrap();
    assert_eq!(sent.to_string(), direct.to_string());
    let flags = ["--keep", "--count", "12", "--seed", "3", "--parked", "0.5", "--quiet"];
    let file: Value = serde_json::from_slice(&printed(&[&["place", &path()], &flags[..]].concat())).unwrap();
    assert_eq!(file["agents"].to_string(), direct["agents"].to_string());
}

#[test]
fn a_map_and_its_score() {
    let server = Server::start(&[]).unwrap();
    let body = json!({"template": "roundabout", "parameters": {}});
    let direct = OPERATIONS.map(serde_json::from_value(body.clone()).unwrap());
    let direct = direct.map_err(|problem| problem.detail).unwrap();
    let sent = posted(&server, "/v1/map", &body);
    assert_eq!(sent, serde_json::to_string(&direct).unwrap());
    assert_eq!(printed(&["map", "--template", "roundabout", "--quiet"]), native::write_doc(&direct.scene));

    let body = json!({"scene": demo()});
    let (request, subject) = opened(&body);
    let direct = OPERATIONS.score(&request, &subject).map_err(|problem| problem.detail).unwrap();
    let direct = serde_json::to_string(&direct).unwrap();
    assert_eq!(posted(&server, "/v1/score", &body), direct);
    let mut line: Value = serde_json::from_slice(&printed(&["score", &path(), "--json"])).unwrap();
    for own in ["file", "source_id", "sample"] {
        line.as_object_mut().unwrap().remove(own);
    }
    assert_eq!(line.to_string(), serde_json::from_str::<Value>(&direct).unwrap().to_string());
}

#[test]
fn a_goal_says_who_is_regenerated() {
    let server = Server::start(&[]).unwrap();
    let body = json!({"scene": demo(), "conditions": {"6": {"goal": {"x_m": -40.0, "y_m": 8.0}}}});
    let sent: Value = serde_json::from_str(&posted(&server, "/v1/generate", &body)).unwrap();
    assert_eq!(sent["generated"]["request"]["agents"], json!(["6"]));
    let flags = ["generate", &path(), "--goal", "6=-40,8", "--quiet"];
    let file: Value = serde_json::from_slice(&printed(&flags)).unwrap();
    assert_eq!(file["generated"]["samples"][0]["agents"], sent["samples"][0]["agents"]);
    assert_eq!(file["generated"]["request"], sent["generated"]["request"]);
    // A start without a goal selects no road user: all are regenerated, as without conditions.
    let body = json!({"scene": demo(), "conditions": {"6": {"start": {"speed_mps": 3.0}}}, "steps": 0});
    let (request, _) = opened::<GenerateRequest>(&body);
    assert!(matches!(request.chosen_agents(), AgentChoice::All(_)));
}

/// A condition of a road user that is not regenerated moves nothing: each carrier warns of it and answers the same.
#[test]
fn conditions_of_other_road_users_are_warned_of() {
    let server = Server::start(&[]).unwrap();
    let body = json!({"scene": demo(), "agents": ["7"], "score": false,
        "conditions": {"6": {"goal": {"x_m": -40.0, "y_m": 8.0}, "frame": "scene"}}});
    let sent: Value = serde_json::from_str(&posted(&server, "/v1/generate", &body)).unwrap();
    let warning = &sent["warnings"][0];
    assert_eq!(
        (&warning["code"], &warning["agent"], &warning["message"]["values"]),
        (&json!("condition-unused"), &json!("6"), &json!({"agent": "6"}))
    );
    let call = ["generate", &path(), "--agents", "7", "--goal", "6=-40,8"];
    let output = Command::new(program()).args(call).output().unwrap();
    assert!(output.status.success());
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("6: condition-unused: Road user 6 is not regenerated"), "{told}");
    let file: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(file["generated"]["samples"][0]["agents"], sent["samples"][0]["agents"]);
    let free = json!({"scene": demo(), "agents": ["7"], "score": false});
    let free: Value = serde_json::from_str(&posted(&server, "/v1/generate", &free)).unwrap();
    assert_eq!(free["samples"][0]["agents"], sent["samples"][0]["agents"]);
    assert_eq!(free["warnings"], json!([]));
    // A future that the scene keeps came of its condition.
    let kept = json!({"scene": file, "agents": ["7"], "score": false,
        "conditions": {"7": {"start": {"speed_mps": 3.0}}}});
    let kept: Value = serde_json::from_str(&posted(&server, "/v1/generate", &kept)).unwrap();
    assert_eq!(kept["warnings"], json!([]));
}

/// An empty list regenerates no road user; with `react`, motion that ends early goes on. Nothing at all is warned of.
#[test]
fn an_empty_list_of_agents_means_the_same_everywhere() {
    let server = Server::start(&[]).unwrap();
    let mut body = json!({"scene": demo(), "agents": [], "react": true, "score": false});
    let answered =
        |body: &Value| -> Value { serde_json::from_str(&posted(&server, "/v1/generate", body)).unwrap() };
    let nothing = answered(&body);
    assert_eq!(nothing["samples"][0]["agents"], json!({}));
    assert_eq!(nothing["warnings"][0]["code"], "nothing-generated");
    assert_eq!(nothing["warnings"][0]["agent"], Value::Null);
    body["horizon_s"] = json!(15.0);
    let further = answered(&body);
    let agents = further["samples"][0]["agents"].as_object().unwrap();
    assert!(
        !agents.is_empty()
            && further["warnings"].as_array().unwrap().iter().all(|w| w["code"] != "nothing-generated")
    );
    let call = ["generate", &path(), "--agents", "@none", "--react", "--horizon", "15", "--quiet"];
    let file: Value = serde_json::from_slice(&printed(&call)).unwrap();
    assert_eq!(file["generated"]["samples"][0]["agents"], further["samples"][0]["agents"]);
    assert_eq!(file["generated"]["request"], further["generated"]["request"]);
    body["react"] = json!(false);
    let refused = server.post("/v1/generate", &body).unwrap();
    assert_eq!(refused.status, 422, "{}", refused.text());
}

/// Each member of a score stands in it, null where nothing is known: as its schema says.
#[test]
fn scores_have_all_members() {
    let server = Server::start(&[]).unwrap();
    let sent: Value = serde_json::from_str(&posted(&server, "/v1/score", &json!({"scene": demo()}))).unwrap();
    let document: Value =
        serde_json::from_slice(&std::fs::read(root().join("assets/openapi.json")).unwrap()).unwrap();
    let all = |schema: &str, value: &Value| {
        let schema = &document["components"]["schemas"][schema];
        let members = schema["properties"].as_object().unwrap();
        for name in members.keys() {
            assert!(value.as_object().unwrap().contains_key(name), "{name} is absent");
            assert!(schema["required"].as_array().unwrap().contains(&json!(name)), "{name} is optional");
        }
    };
    all("SceneScore", &sent["scene"]);
    all("AgentScore", &sent["agents"]["6"]);
    assert_eq!(sent["scene"]["min_ade_m"], Value::Null);
}

#[test]
fn an_angle_of_more_than_a_turn_is_refused_with_a_hint() {
    let body = json!({"scene": demo(), "conditions": {"6": {"goal": {"heading_rad": 90.0}}}});
    let (request, subject) = opened::<GenerateRequest>(&body);
    let refused = OPERATIONS.generate(&request, &subject, Cancel::default()).err().unwrap();
    let fault = &refused.members.errors.unwrap()[0];
    assert_eq!(fault.pointer, "/conditions/6/goal/heading_rad");
    assert_eq!(fault.code, "out-of-range");
    assert_eq!(fault.detail, "90 rad is more than a turn; 90 degrees are 1.5708 rad");
}

#[test]
fn a_round_of_cards_is_a_generation_with_feedback() {
    let body = json!({"scene": demo(), "agents": ["6"], "modes": 3, "seed": 5, "score": false});
    let (request, subject) = opened::<GenerateRequest>(&body);
    let answer = |call: Result<GenerationRun<'_>, Problem>| {
        let answered = call.and_then(GenerationRun::answer).map_err(|problem| problem.detail).unwrap();
        timeless(serde_json::to_value(answered.body()).unwrap())
    };
    let round = OPERATIONS.feedback(&request, FeedbackDoc::default(), &subject, Cancel::default());
    let asked = GenerateRequest { feedback: Some(FeedbackDoc::default()), ..request.clone() };
    let direct = answer(OPERATIONS.generate(&asked, &subject, Cancel::default()));
    assert!(direct.contains("\"cards\""));
    assert_eq!(answer(round), direct);
}
