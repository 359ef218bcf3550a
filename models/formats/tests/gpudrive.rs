//! JSON of GPUDrive and Nocturne as scenes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, ImportOptions, Imported, ReadError, registry};
use scene::map::LaneType;
use scene::routes::LaneGraph;
use scene::{AgentType, SignalState, Vec2};

const GPUDRIVE: &str = include_str!("../../../fuzz/corpus/gpudrive/gpudrive.json");
const NOCTURNE: &str = include_str!("../../../fuzz/corpus/gpudrive/nocturne.json");

fn import(text: &str) -> Result<Imported, ReadError> {
    registry::import(text.as_bytes(), "a.json", "auto", &ImportOptions::default())?.remove(0)
}

#[test]
fn a_scenario_is_read() {
    let (scene, warnings) = import(GPUDRIVE).unwrap();
    assert_eq!(warnings.iter().map(|w| w.code).collect::<Vec<_>>(), ["no-lane-graph"]);
    assert_eq!((scene.meta.source.as_str(), scene.meta.source_id.as_deref()), ("gpudrive", Some("drawn-1")));
    assert_eq!((scene.meta.origin.x_m, scene.meta.origin.y_m), (100.0, 50.0));
    let kinds: Vec<_> =
        scene.agents.iter().map(|a| (a.id.as_str(), a.agent_type, a.role.as_deref())).collect();
    let expected = [
        ("7", AgentType::Vehicle, Some("ego")),
        ("8", AgentType::Vehicle, None),
        ("9", AgentType::Cyclist, None),
    ];
    assert_eq!(kinds, expected);
    assert_eq!(scene.agent("9").unwrap().track.valid_steps().collect::<Vec<_>>(), [1, 3]);
    assert_eq!(scene.agent("9").unwrap().track.z_m.as_deref(), Some(&[0.0, 1.5, 0.0, 1.5][..]));
    let eighth = scene.agent("8").unwrap().track.at(0).unwrap().heading_rad;
    assert!((eighth - std::f64::consts::PI).abs() < 1e-8, "{eighth}");
    assert_eq!(
        (&scene.meta.objects_of_interest[0], &scene.meta.tracks_to_predict[0].0),
        (&"9".to_owned(), &"9".to_owned())
    );
    let map = &scene.map;
    assert_eq!(
        (map.lanes[0].lane_type, map.lanes[0].points.xy[0]),
        (LaneType::SurfaceStreet, Vec2::new(-10.0, 0.0))
    );
    assert_eq!(
        (map.road_lines[0].line_type.as_str(), map.road_edges[0].line_type.as_str()),
        ("solid_single_yellow", "boundary")
    );
    let counts = [map.lanes.len(), map.crosswalks.len(), map.stop_signs.len()];
    assert_eq!(counts, [2, 1, 1]);
    // The file has no links; where one lane ends another begins.
    assert_eq!(
        (LaneGraph::new(map).lanes()[0].successors.as_slice(), map.lanes[0].successors.len()),
        (&[1][..], 1)
    );
    let shown: Vec<_> = (0..4).map(|step| scene.signals[0].at(step)).collect();
    use SignalState::{ArrowGo, Stop, Unknown};
    assert_eq!(
        (scene.signals[0].lane.as_str(), shown.as_slice()),
        ("11", &[Stop, Stop, ArrowGo, Unknown][..])
    );
}

#[test]
fn headings_in_degrees_are_known_by_their_size_and_by_where_one_goes() {
    let (scene, warnings) = import(NOCTURNE).unwrap();
    assert_eq!(warnings.iter().map(|w| w.code).collect::<Vec<_>>(), ["headings-in-degrees", "no-lane-graph"]);
    assert!((scene.agents[1].track.at(0).unwrap().heading_rad.abs() - std::f64::consts::PI).abs() < 1e-9);
    assert_eq!((scene.meta.source.as_str(), scene.agents[1].id.as_str()), ("nocturne", "1"));
    // Six degrees are less than a turn; in the plane they are degrees all the same.
    let slight = NOCTURNE.replace("180.0", "-6.0");
    let (scene, _) = import(&slight).unwrap();
    assert!((scene.agents[1].track.at(0).unwrap().heading_rad + 6f64.to_radians()).abs() < 1e-9);
    // Motion that agrees with headings in radians, and not in degrees, has radians.
    let (_, warnings) = import(&NOCTURNE.replace("180.0", "3.1415926")).unwrap();
    let codes: Vec<_> = warnings.iter().map(|w| w.code).collect();
    assert_eq!(codes, ["headings-in-radians", "no-lane-graph"]);
    assert!(warnings[0].detail.contains("1 of 1 moving"), "{}", warnings[0].detail);
}

#[test]
fn each_engine_gets_its_own_file() {
    let (scene, _) = import(GPUDRIVE).unwrap();
    let text = |id: &str| {
        let file = registry::by_id(id).unwrap().export(&[&scene], &ExportOptions::default()).unwrap();
        serde_json::from_slice::<serde_json::Value>(&file.bytes).unwrap()
    };
    let (full, flat) = (text("gpudrive"), text("nocturne"));
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((number(&full["objects"][1]["heading"][0]) - std::f64::consts::PI).abs() < 1e-8);
    assert!((number(&flat["objects"][1]["heading"][0]) - 180.0).abs() < 1e-6);
    assert_eq!((full["roads"][0]["map_element_id"].as_i64(), flat["roads"][0].get("id")), (Some(2), None));
    assert_eq!(
        (&full["objects"][0]["position"][0]["x"], flat["objects"][0]["position"][0].get("z")),
        (&100.0.into(), None)
    );
    let goal = |document: &serde_json::Value| number(&document["objects"][0]["goalPosition"]["x"]);
    assert!((goal(&full) - 102.4).abs() < 1e-9 && (goal(&flat) - 102.4).abs() < 1e-9);
    assert_eq!(full["metadata"]["sdc_track_index"], 0);
}

#[test]
fn faults_have_their_place() {
    let of = |from: &str, to: &str| import(&GPUDRIVE.replacen(from, to, 1)).unwrap_err();
    let error = of("\"width\": 1.9", "\"width\": \"wide\"");
    assert_eq!((error.problems[0].pointer.as_str(), error.code()), ("/objects/0/width", "invalid-field"));
    let short = of("\"valid\": [true, true, true, true]", "\"valid\": [true]");
    assert_eq!(short.problems[0].pointer, "/objects/0/valid");
    assert!(short.to_string().contains("1 value, 4 expected, as in position"));
    assert_eq!(of("\"width\": 1.9", "\"width\": NaN").code(), "malformed-json");
    let cut = &GPUDRIVE[..GPUDRIVE.len() - 9];
    assert_eq!(import(cut).unwrap_err().code(), "malformed-json");
    let many = format!(
        "{{\"objects\": [], \"goalPosition\": 0, \"roads\": [{}]}}",
        "{\"type\":\"lane\",\"geometry\":[]},".repeat(30_000)
    );
    assert!(import(&many).unwrap_err().to_string().contains("more than 20000 entries"));
}

#[test]
fn damaged_files_never_panic() {
    for text in [GPUDRIVE, NOCTURNE] {
        for at in 0..text.len() {
            let mut damaged = text.as_bytes().to_vec();
            damaged[at] ^= 1 << (at % 7);
            formats::checks::both_ways("gpudrive", &damaged);
            formats::checks::both_ways("gpudrive", &damaged[..at]);
        }
    }
}
