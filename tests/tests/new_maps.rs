//! Maps from templates, on the command line and over HTTP: each can be filled, and the experts drive on it.

#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a failed test panics")]

use dragtraffic_tests::Server;
use dragtraffic_tests::program::program;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

/// Greatest share of off-road states in all futures on templates.
const MOST_OFF_ROAD: f64 = 0.03;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(program()).args(arguments).current_dir(folder).output().unwrap()
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

fn templates() -> Vec<(String, Value)> {
    let output = run(Path::new("."), &["map", "--list"]);
    let list: Value = serde_json::from_slice(&output.stdout).unwrap();
    let name =
        |item: &Value| (item["layout"]["template"].as_str().unwrap().to_owned(), item["layout"].clone());
    list["templates"].as_array().unwrap().iter().map(name).collect()
}

#[test]
fn each_template_can_be_filled_and_driven_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let names = templates();
    assert_eq!(names.len(), 8);
    let mut shares = Vec::new();
    for (name, _) in &names {
        let output = run(path, &["map", "--template", name, "-o", "map.json", "--force"]);
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(told.contains("Every lane leads somewhere") && !told.contains("LOOK"), "{name}: {told}");
        let place = ["place", "map.json", "--count", "24", "--seed", "5", "-o", "placed.json", "--force"];
        assert!(run(path, &place).status.success(), "{name}");
        let placed = json_of(&path.join("placed.json"));
        let count = placed["agents"].as_array().unwrap().len();
        assert!(count >= 12, "{name}: {count} found a place");
        assert_eq!(placed["x_layout"]["template"], **name);
        let generate = ["generate", "placed.json", "--seed", "1", "-o", "driven.json", "--force"];
        assert!(run(path, &generate).status.success(), "{name}");
        let output = run(path, &["score", "driven.json", "--json"]);
        let score: Value = serde_json::from_slice(&output.stdout).unwrap();
        let share = found(&score, "offroad_share").unwrap_or_else(|| panic!("{name}: {score}"));
        shares.push((name.clone(), share));
    }
    let mean = shares.iter().map(|(_, share)| share).sum::<f64>() / shares.len() as f64;
    assert!(mean < MOST_OFF_ROAD, "{shares:?}");
}

/// The scene's own member of this name.
fn found(score: &Value, name: &str) -> Option<f64> {
    match score {
        Value::Object(members) => members
            .get("scene")
            .and_then(|scene| scene.get(name))
            .and_then(Value::as_f64)
            .or_else(|| members.values().find_map(|member| found(member, name))),
        Value::Array(items) => items.iter().find_map(|item| found(item, name)),
        _ => None,
    }
}

#[test]
fn a_map_is_made_over_http_and_on_the_command_line_alike() {
    let folder = tempfile::tempdir().unwrap();
    let server = Server::start(&[]).unwrap();
    let parameters = json!({"kerb_radius_m": 6.0, "control": "equal", "traffic": "left-hand"});
    let reply = server.post("/v1/map", &json!({"template": "four-arms", "parameters": parameters})).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    let made: Value = serde_json::from_slice(&reply.body).unwrap();
    std::fs::write(folder.path().join("p.json"), parameters.to_string()).unwrap();
    let map = ["map", "--template", "four-arms", "--parameters", "p.json", "-o", "m.json"];
    assert!(run(folder.path(), &map).status.success());
    let file = json_of(&folder.path().join("m.json"));
    assert_eq!(file["map"], made["scene"]["map"]);
    assert_eq!(file["map"]["stop_signs"].as_array().unwrap().len(), 4);
    assert_eq!(made["layout"]["parameters"]["arms"].as_array().unwrap().len(), 4);
    assert_eq!(made["arms"][1]["name"], "North");
    // The layout stored in the file generates the same map again.
    let again = server.post("/v1/map", &file["x_layout"]).unwrap();
    let again: Value = serde_json::from_slice(&again.body).unwrap();
    assert_eq!(again["scene"]["map"], file["map"]);
    // The scene can be saved with the parameters of its map.
    let saved = server.post("/v1/scenes", &made["scene"]).unwrap();
    assert_eq!(saved.status, 201, "{}", saved.text());
    let id = serde_json::from_slice::<Value>(&saved.body).unwrap()["id"].as_str().unwrap().to_owned();
    let kept: Value = serde_json::from_slice(&server.get(&format!("/v1/scenes/{id}")).unwrap().body).unwrap();
    assert_eq!(kept["x_layout"], made["layout"]);
}

#[test]
fn faults_of_parameters_have_their_place() {
    let server = Server::start(&[]).unwrap();
    let refused = |body: Value| -> Value {
        let reply = server.post("/v1/map", &body).unwrap();
        assert_eq!(reply.status, 422, "{body}: {}", reply.text());
        serde_json::from_slice::<Value>(&reply.body).unwrap()["errors"][0].clone()
    };
    let close = json!([{"angle_deg": 0.0}, {"angle_deg": 10.0}, {"angle_deg": 180.0}]);
    let error = refused(json!({"template": "four-arms", "parameters": {"arms": close}}));
    assert_eq!(error["pointer"], "/parameters/arms/1/angle_deg");
    assert_eq!(error["detail"], "Arms need 20° between them");
    let error = refused(json!({"template": "merge", "parameters": {"lanes": 9}}));
    assert_eq!(
        (&error["pointer"], &error["code"], &error["max"]),
        (&json!("/parameters/lanes"), &json!("out-of-range"), &json!(5.0))
    );
    let error = refused(json!({"template": "merge", "parameters": {"arms": []}}));
    assert_eq!(error["code"], "invalid-field");
    let error = refused(json!({"template": "motorway"}));
    assert_eq!(error["pointer"], "/template");
    let list: Value = serde_json::from_slice(&server.get("/v1/map/templates").unwrap().body).unwrap();
    assert_eq!(list["templates"].as_array().unwrap().len(), 8);
}
