//! The native document: round trips, defaults, schema, speed.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::approx_constant,
    reason = "a test stops at the first surprise"
)]

use formats::native::{self, ConditionsDoc, Context, MapForm, SceneDoc, Window};
use scene::{AgentType, Conditions, State, Vec2};
use std::path::Path;
use std::time::Instant;

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

#[test]
fn read_write_read_is_equal() {
    let scene = native::read(JUNCTION).unwrap();
    let written = native::write(&scene);
    let again = native::read(&written).unwrap();
    assert_eq!(scene, again);
    assert_eq!(written, native::write(&again));
    assert_eq!(scene.map.hash(), again.map.hash());
}

#[test]
fn junction_is_read_as_written() {
    let scene = native::read(JUNCTION).unwrap();
    assert_eq!(scene.agents.len(), 4);
    assert_eq!(scene.agents[1].track.at(3), None);
    assert_eq!(scene.agents[1].track.at(5).unwrap().x_m, 16.25);
    assert_eq!(scene.agents[2].track.first_step, 2);
    assert_eq!(scene.agents[2].track.last_valid_step(), Some(3));
    // The size of the subtype, and a goal given from the start pose.
    assert_eq!(scene.agents[3].size.length_m, 1.8);
    let goal = scene.agents[3].conditions.goal;
    assert_eq!(goal.position, Some(Vec2::new(-5.0, -4.5)));
    assert_eq!((goal.speed_mps, goal.heading_rad), (Some(5.0), Some(0.0)));
    assert_eq!(scene.extra["x_editor"]["zoom"], 1.5);
}

#[test]
fn map_by_hash_needs_a_known_map() {
    let scene = native::read(JUNCTION).unwrap();
    let bytes = native::write_doc(&SceneDoc::from_scene(&scene, MapForm::Ref));
    assert_eq!(native::read(&bytes).unwrap_err().code(), "unknown-map");
    let doc = native::read_doc(&bytes).unwrap();
    let again = doc.into_scene(|hash| (*hash == scene.map.hash()).then(|| scene.map.clone())).unwrap();
    assert_eq!(scene, again);
}

#[test]
fn numbers_come_back_bit_for_bit() {
    let mut scene = native::read(JUNCTION).unwrap();
    let states = scene.agents[0].track.states.iter_mut().flatten();
    for (i, state) in states.enumerate() {
        state.x_m = (i as f64 + 0.1).sqrt() * 1234.567890123;
        state.heading_rad = (i as f64).sin() * f64::MIN_POSITIVE;
    }
    assert_eq!(native::read(&native::write(&scene)).unwrap(), scene);
}

#[test]
fn generated_numbers_are_rounded() {
    let mut scene = native::read(JUNCTION).unwrap();
    let generated = scene.generated.as_mut().unwrap();
    let futures = generated.samples[0].agents.get_mut("1").unwrap();
    futures.modes[0].states[0] = State {
        x_m: 1.000_49,
        y_m: -0.000_1,
        heading_rad: -std::f64::consts::PI,
        vx_mps: 2.518_28,
        vy_mps: 0.0,
    };
    let text = String::from_utf8(native::write(&scene)).unwrap();
    let state =
        native::read(text.as_bytes()).unwrap().generated.unwrap().samples[0].agents["1"].modes[0].states[0];
    assert_eq!(state.x_m, 1.0);
    assert!(state.y_m == 0.0 && state.y_m.is_sign_positive());
    assert_eq!(state.heading_rad, -3.1415);
    assert_eq!(state.vx_mps, 2.518);
}

fn resolve(json: &str) -> Result<Conditions, Vec<formats::FieldProblem>> {
    let doc: ConditionsDoc = native::from_json(json.as_bytes()).unwrap();
    let start = State { x_m: 10.0, y_m: 5.0, heading_rad: 0.5, vx_mps: 0.0, vy_mps: 0.0 };
    let window = Window { start_s: 1.0, horizon_s: 9.0 };
    let context = Context { agent_type: AgentType::Vehicle, start: Some(start), window };
    doc.resolve("/conditions/1", &context)
}

#[test]
fn conditions_at_and_beyond_each_bound() {
    let fields = [
        ("goal.speed_mps", 0.0, 60.0),
        ("start.speed_mps", 0.0, 60.0),
        ("goal.heading_rad", -1000.0, 1000.0),
        ("goal.time_s", 1.5, 10.0),
        ("length_m", 1.5, 25.0),
        ("width_m", 0.5, 4.0),
    ];
    for (field, min, max) in fields {
        let json = |v: f64| match field.split_once('.') {
            Some((part, name)) => format!("{{\"{part}\":{{\"{name}\":{v}}}}}"),
            None => format!("{{\"{field}\":{v}}}"),
        };
        for inside in [min, max, (min + max) / 2.0] {
            assert!(resolve(&json(inside)).is_ok(), "{field} {inside}");
        }
        for outside in [min - 0.07, max + 0.07, 1e29, -1e29] {
            let problems = resolve(&json(outside)).unwrap_err();
            assert_eq!(problems[0].code, "out-of-range", "{field} {outside}");
            assert_eq!((problems[0].min, problems[0].max), (Some(min), Some(max)), "{field}");
            assert_eq!(problems[0].got, Some(outside));
            assert_eq!(problems[0].pointer, format!("/conditions/1/{}", field.replace('.', "/")));
        }
    }
}

#[test]
fn edges_that_may_be_crossed_come_back_and_are_bounded() {
    let list = |n: usize| (0..n).map(|i| format!("\"e{i}\"")).collect::<Vec<_>>().join(",");
    let read = |list: &str| resolve(&format!("{{\"goal\":{{\"may_cross\":[{list}]}}}}"));
    let found = read("\"b\",\"a\"").unwrap();
    assert_eq!(found.may_cross, ["b", "a"]);
    let written = serde_json::to_value(ConditionsDoc::from_conditions(&found)).unwrap();
    assert_eq!(written, serde_json::json!({"goal": {"may_cross": ["b", "a"]}}));
    assert_eq!(read(&list(32)).unwrap().may_cross.len(), 32);
    let problem = read(&list(33)).unwrap_err().remove(0);
    assert_eq!((problem.pointer.as_str(), problem.code), ("/conditions/1/goal/may_cross", "invalid-field"));
}

#[test]
fn via_points_come_back_in_order_and_are_held_to_their_ranges() {
    let read = |list: &str| resolve(&format!("{{\"goal\":{{\"time_s\":8}},\"via\":[{list}]}}"));
    let found = read(r#"{"x_m":1,"y_m":2},{"x_m":30,"y_m":2,"tolerance_m":5,"time_s":4.04}"#).unwrap();
    let told: Vec<_> = found.via.iter().map(|v| (v.position.x, v.tolerance_m, v.time_s)).collect();
    assert_eq!(told, [(1.0, 1.0, None), (30.0, 5.0, Some(4.0))]);
    let doc = ConditionsDoc::from_conditions(&found);
    let context = Context { agent_type: AgentType::Vehicle, start: None, window: Window::default() };
    assert_eq!(doc.resolve("", &context).unwrap().via, found.via);
    let five = [r#"{"x_m":1,"y_m":2}"#; 5].join(",");
    for (list, at, code) in [
        (five.as_str(), "", "invalid-field"),
        (r#"{"x_m":1e9,"y_m":2}"#, "/0/x_m", "out-of-range"),
        (r#"{"x_m":4000,"y_m":2}"#, "/0/x_m", "out-of-range"),
        (r#"{"x_m":1,"y_m":2,"tolerance_m":0.4}"#, "/0/tolerance_m", "out-of-range"),
        (r#"{"x_m":1,"y_m":2,"tolerance_m":5.1}"#, "/0/tolerance_m", "out-of-range"),
        (r#"{"x_m":1,"y_m":2,"time_s":0.2}"#, "/0/time_s", "out-of-range"),
        (r#"{"x_m":1,"y_m":2,"time_s":8}"#, "/0/time_s", "invalid-field"),
        (r#"{"x_m":1,"y_m":2,"time_s":4},{"x_m":2,"y_m":2,"time_s":4}"#, "/1/time_s", "invalid-field"),
    ] {
        let problem = read(list).unwrap_err().remove(0);
        assert_eq!((problem.pointer, problem.code), (format!("/conditions/1/via{at}"), code), "{list}");
    }
}

#[test]
fn agent_frame_equals_scene_frame() {
    let (sin, cos) = 0.5_f64.sin_cos();
    let here = resolve(
        r#"{"frame":"agent","goal":{"ahead_m":100,"left_m":-3,"velocity":{"ahead_mps":20,"left_mps":-2}}}"#,
    )
    .unwrap()
    .goal;
    let (x, y) = (10.0 + 100.0 * cos + 3.0 * sin, 5.0 + 100.0 * sin - 3.0 * cos);
    let (vx, vy) = (20.0 * cos + 2.0 * sin, 20.0 * sin - 2.0 * cos);
    let there =
        resolve(&format!(r#"{{"goal":{{"x_m":{x},"y_m":{y},"velocity":{{"x_mps":{vx},"y_mps":{vy}}}}}}}"#))
            .unwrap()
            .goal;
    assert!((here.position.unwrap() - there.position.unwrap()).norm() < 1e-12);
    assert!((here.heading_rad.unwrap() - there.heading_rad.unwrap()).abs() < 1e-12);
    assert!((here.speed_mps.unwrap() - there.speed_mps.unwrap()).abs() < 1e-12);
}

#[test]
fn all_faults_are_listed() {
    let problems = resolve(r#"{"length_m":0,"goal":{"x_m":1,"speed_mps":99,"time_s":0},"start":{"y_m":2}}"#)
        .unwrap_err();
    let codes: Vec<_> = problems.iter().map(|p| (p.pointer.as_str(), p.code)).collect();
    assert_eq!(
        codes,
        [
            ("/conditions/1/length_m", "out-of-range"),
            ("/conditions/1/start/y_m", "half-position"),
            ("/conditions/1/goal/x_m", "half-position"),
            ("/conditions/1/goal/speed_mps", "out-of-range"),
            ("/conditions/1/goal/time_s", "out-of-range"),
        ]
    );
}

#[test]
fn own_members_and_texts_are_bounded() {
    let changed = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut doc: serde_json::Value = serde_json::from_slice(JUNCTION).unwrap();
        change(&mut doc);
        native::read(&serde_json::to_vec(&doc).unwrap()).map_err(|refused| refused.to_string())
    };
    // The bound holds for all own members together.
    let members = |count: usize| {
        changed(&|doc| (0..2).for_each(|i| doc[format!("x_{i}")] = serde_json::json!(vec![0; count])))
    };
    assert!(members(20_000).is_ok());
    assert!(members(30_000).unwrap_err().contains("more than 50000 values"));
    let long = || serde_json::json!("x".repeat(257));
    let places: [&dyn Fn(&mut serde_json::Value); 4] = [
        &|doc| doc["agents"][0]["role"] = long(),
        &|doc| doc["meta"]["parent_id"] = long(),
        &|doc| doc["meta"]["created_with"] = long(),
        &|doc| doc["meta"]["origin"]["crs"] = serde_json::json!("x".repeat(8_193)),
    ];
    for place in places {
        assert!(changed(place).unwrap_err().contains("bytes"), "{:?}", changed(place));
    }
}

#[test]
fn free_and_null_are_the_same_and_minus_zero_is_zero() {
    assert!(resolve("{}").unwrap().is_empty());
    assert!(resolve(r#"{"length_m":null,"goal":{"x_m":null,"y_m":null},"start":null}"#).unwrap().is_empty());
    let goal = resolve(r#"{"goal":{"x_m":-0.0,"y_m":-0.0,"heading_rad":-0.0,"time_s":2.04}}"#).unwrap().goal;
    let position = goal.position.unwrap();
    assert!(position.x.is_sign_positive() && position.y.is_sign_positive());
    assert!(goal.heading_rad.unwrap().is_sign_positive());
    assert_eq!(goal.time_s, Some(2.0));
}

#[test]
fn committed_schema_is_the_generated_one() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/schema/scene.v1.schema.json");
    let text = serde_json::to_string_pretty(&native::schema()).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "run with UPDATE_SCHEMA=1 to write {}", path.display());
}

#[test]
fn a_big_scene_opens_quickly() {
    let mut scene = native::read(JUNCTION).unwrap();
    let mut map = (*scene.map).clone();
    let line = map.road_edges[0].clone();
    for i in 0..200 {
        let mut line = line.clone();
        line.id = format!("big-{i}");
        line.points.xy = (0..200)
            .map(|k| Vec2::new(f64::from(k).sqrt() * 7.1 + f64::from(i), f64::from(k) / 3.0))
            .collect();
        map.road_edges.push(line);
    }
    scene.map = map.into();
    let bytes = native::write(&scene);
    let start = Instant::now();
    let again = native::read(&bytes).unwrap();
    let took = start.elapsed();
    assert_eq!(scene, again);
    println!("{} kB read in {took:?}", bytes.len() / 1000);
    assert!(took.as_millis() < 1000, "{took:?}");
}
