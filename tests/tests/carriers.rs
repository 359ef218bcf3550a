//! The same calls by HTTP, by the command line and directly give the same replies, byte for byte.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use api::feedback::FeedbackDoc;
use api::generate::GenerationRun;
use api::generate::request::AgentChoice;
use api::map::MapBody;
use api::place::{PlaceBody, PlaceReply};
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

/// A request and its scene as every carrier reads them: from JSON, without stored scenes.
fn opened<T: DeserializeOwned + AboutScene>(body: &Value) -> (T, Subject) {
    let mut request: T = serde_json::from_value(body.clone()).unwrap();
    let wanted: SceneRef = request.take_scene();
    let subject = api::home::at_once(wanted.open(&BTreeMap::new())).unwrap();
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

/// A reply without its durations and its date.
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
    let (request, subject) = opened::<PlaceBody>(&body);
    let placed = OPERATIONS.place(&request, &subject.scene, &Cancel::default());
    let placed = placed.map_err(|problem| problem.detail).unwrap();
    let direct = serde_json::to_value(PlaceReply::of(&placed, &subject.scene)).unwrap();
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
    let direct = serde_json::from_value::<MapBody>(body.clone()).unwrap().reply();
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

/// A condition that would change no motion is refused by each carrier, with its place.
#[test]
fn conditions_of_other_road_users_are_refused() {
    let server = Server::start(&[]).unwrap();
    let refused = |body: &Value| {
        let reply = server.post("/v1/generate", body).unwrap();
        assert_eq!((reply.status, reply.code()), (422, "not-asked".to_owned()), "{}", reply.text());
        let problem = reply.json();
        assert_eq!(problem["message"], json!({"code": "not-asked", "values": {"id": "6"}}));
        let places = problem["errors"].as_array().unwrap().iter();
        places.map(|error| error["pointer"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let asked = |of: &str, condition: Value| json!({"scene": demo(), "agents": ["7"], "score": false, "steps": 0, "conditions": {of: condition}});
    let goal = json!({"x_m": -40.0, "y_m": 8.0});
    let mut body = asked("6", json!({"goal": goal}));
    assert_eq!(refused(&body), ["/conditions/6/goal"]);
    // Road users that may react keep their motion unless another motion conflicts with it.
    for react in [json!(true), json!(["6"])] {
        body["react"] = react;
        assert_eq!(refused(&body), ["/conditions/6/goal"]);
    }
    let via = json!([{"x_m": -20.0, "y_m": 8.0}]);
    let places = refused(&asked("6", json!({"start": {"speed_mps": 3.0}, "via": via})));
    assert_eq!(places, ["/conditions/6/start", "/conditions/6/via"]);
    // Without `agents` the goal of 7 selects only 7.
    let mut body = asked("6", json!({"start": {"speed_mps": 3.0}}));
    (body["agents"], body["conditions"]["7"]) = (Value::Null, json!({"goal": goal}));
    assert_eq!(refused(&body), ["/conditions/6/start"]);

    let call = |flags: &[&str]| Command::new(program()).arg("generate").args(flags).output().unwrap();
    let output = call(&[&path(), "--agents", "7", "--goal", "6=-40,8"]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{told}");
    assert!(told.contains("--goal 6: road user \"6\" is not in agents: add \"6\" to agents"), "{told}");
    // Type and size apply to every road user.
    let output = call(&[&path(), "--agents", "7", "--steps", "0", "--size", "6=5x2"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// A condition without generation is accepted if the scene keeps a future of the road user or has the same condition.
#[test]
fn conditions_of_kept_futures_and_of_the_scene_are_taken() {
    let server = Server::start(&[]).unwrap();
    let answered =
        |body: &Value| -> Value { serde_json::from_str(&posted(&server, "/v1/generate", body)).unwrap() };
    let flags = ["generate", &path(), "--goal", "6=-40,8", "--steps", "0", "--quiet"];
    let mut scene: Value = serde_json::from_slice(&printed(&flags)).unwrap();
    let mut body = json!({"scene": scene, "agents": ["7"], "score": false, "steps": 0,
        "conditions": {"6": {"goal": {"x_m": -30.0, "y_m": 8.0}}}});
    let kept = answered(&body);
    assert_eq!(kept["generated"]["stale"], true, "the kept future came of another goal");
    assert!(kept["samples"][0]["agents"]["6"].is_object());
    body["kept_futures"] = json!("forgotten");
    assert_eq!(server.post("/v1/generate", &body).unwrap().code(), "not-asked");

    scene["generated"] = Value::Null;
    let own =
        &scene["agents"].as_array().unwrap().iter().find(|agent| agent["id"] == "6").unwrap()["conditions"];
    let body = json!({"scene": scene, "agents": ["7"], "score": false, "steps": 0, "conditions": {"6": own}});
    assert!(own["goal"].is_object() && answered(&body)["samples"][0]["agents"]["7"].is_object());
}

/// An empty list regenerates no road user; with `react`, motion that ends early is continued. A call that generates
/// nothing gets a warning.
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

/// A score contains every member of its schema, null if the value is unknown.
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
