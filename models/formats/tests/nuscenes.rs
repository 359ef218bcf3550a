//! nuScenes tables as scenes, from a writer of tables after the published schema.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod zipped;

use formats::{ImportOptions, Imported, ReadError, registry};
use scene::{AgentType, Subtype, Vec2};
use serde_json::{Value, json};
use zipped::zipped;

/// Two scenes of ten samples each at 2 Hz: a car that turns, an adult, and the ego, which drives east at 8 m/s.
fn tables() -> Vec<(String, Value)> {
    let half_turn = |heading: f64| json!([(heading / 2.0).cos(), 0.0, 0.0, (heading / 2.0).sin()]);
    let (mut samples, mut annotations, mut data, mut poses) = (vec![], vec![], vec![], vec![]);
    for scene in 0..2 {
        for i in 0..10 {
            let token = format!("s{scene}-{i}");
            let next = if i < 9 { format!("s{scene}-{}", i + 1) } else { String::new() };
            let time = 1_532_402_927_647_951_i64 + 500_000 * i;
            samples.push(json!({"token": token, "timestamp": time, "prev": "", "next": next, "scene_token": format!("scene{scene}")}));
            let x = 600.0 + 4.0 * i as f64;
            let heading = 0.1 * i as f64;
            annotations.push(json!({"token": "a", "sample_token": token, "instance_token": "car-1", "translation": [x, 1_640.0, 1.0],
                "size": [1.9, 4.6, 1.6], "rotation": half_turn(heading), "attribute_tokens": []}));
            annotations.push(json!({"token": "b", "sample_token": token, "instance_token": "adult-1", "translation": [620.0, 1_650.0, 1.0],
                "size": [0.6, 0.7, 1.8], "rotation": [1.0, 0.0, 0.0, 0.0]}));
            for (channel, shift) in [("CAM_FRONT", 5.0), ("LIDAR_TOP", 0.0)] {
                let pose = format!("p{scene}-{i}-{channel}");
                data.push(
                    json!({"token": "d", "sample_token": token, "ego_pose_token": pose, "is_key_frame": true,
                    "filename": format!("samples/{channel}/x.bin")}),
                );
                poses.push(json!({"token": pose, "timestamp": time, "translation": [590.0 + 4.0 * i as f64 + shift, 1_636.0, 0.0],
                    "rotation": [1.0, 0.0, 0.0, 0.0]}));
            }
        }
    }
    let scene = |i: usize| {
        json!({"token": format!("scene{i}"), "name": format!("scene-006{i}"), "description": "", "log_token": "log", "nbr_samples": 10,
        "first_sample_token": format!("s{i}-0"), "last_sample_token": format!("s{i}-9")})
    };
    let table = |name: &str, rows: Value| (format!("v1.0-mini/{name}.json"), rows);
    vec![
        table("calibrated_sensor", json!([])),
        table(
            "category",
            json!([{"token": "c1", "name": "vehicle.car"}, {"token": "c2", "name": "human.pedestrian.adult"}]),
        ),
        table("ego_pose", json!(poses)),
        table(
            "instance",
            json!([{"token": "car-1", "category_token": "c1"}, {"token": "adult-1", "category_token": "c2"}]),
        ),
        table("log", json!([{"token": "log", "location": "boston-seaport"}])),
        table("sample", json!(samples)),
        table("sample_annotation", json!(annotations)),
        table("sample_data", json!(data)),
        table("scene", json!([scene(0), scene(1)])),
    ]
}

/// A street of two lanes in a row, a connector between them, and another far away.
fn expansion() -> (String, Value) {
    let node = |token: &str, x: f64, y: f64| json!({"token": token, "x": x, "y": y});
    let lane =
        |token: &str, polygon: &str| json!({"token": token, "polygon_token": polygon, "lane_type": "CAR"});
    let path = |x: f64, length: f64| {
        json!([{"start_pose": [x, 1_640.0, 0.0], "end_pose": [x + length, 1_640.0, 0.0],
        "shape": "LSR", "radius": 50.0, "segment_length": [0.0, length, 0.0]}])
    };
    let value = json!({
        "version": "1.3",
        "node": [node("n1", 500.0, 1_638.0), node("n2", 600.0, 1_638.0), node("n3", 600.0, 1_642.0), node("n4", 500.0, 1_642.0),
            node("n5", 300.0, 1_500.0), node("n6", 1_500.0, 1_500.0), node("n7", 1_500.0, 1_800.0), node("n8", 300.0, 1_800.0)],
        "polygon": [{"token": "p1", "exterior_node_tokens": ["n1", "n2", "n3", "n4"], "holes": []},
            {"token": "p2", "exterior_node_tokens": ["n5", "n6", "n7", "n8"], "holes": [{"node_tokens": ["n1", "n2", "n3", "n4"]}]}],
        "line": [{"token": "l1", "node_tokens": ["n1", "n2"]}],
        "lane": [lane("in", "p1"), lane("out", "p1"), lane("far", "p1"), lane("bare", "p1")],
        "lane_connector": [{"token": "way", "polygon_token": null}],
        "ped_crossing": [{"token": "x1", "polygon_token": "p1"}],
        "drivable_area": [{"token": "d1", "polygon_tokens": ["p2"]}],
        "lane_divider": [{"token": "v1", "line_token": "l1"}],
        "connectivity": {"in": {"incoming": [], "outgoing": ["way"]}, "way": {"incoming": ["in"], "outgoing": ["out"]}},
        "arcline_path_3": {"in": path(540.0, 60.0), "way": path(600.0, 20.0), "out": path(620.0, 300.0), "far": path(4_000.0, 50.0)}
    });
    ("maps/expansion/boston-seaport.json".into(), value)
}

fn read(files: &[(String, Value)]) -> Vec<Result<Imported, ReadError>> {
    read_after("", files)
}

/// The texts begin with `mark`.
fn read_after(mark: &str, files: &[(String, Value)]) -> Vec<Result<Imported, ReadError>> {
    let texts: Vec<(&str, String)> =
        files.iter().map(|(name, value)| (name.as_str(), format!("{mark}{value}"))).collect();
    let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (*name, text.as_str())).collect();
    registry::import(&zipped(&texts), "mini.zip", "auto", &ImportOptions::default()).unwrap()
}

#[test]
fn scenes_have_their_road_users_and_the_map_round_them() {
    let mut files = tables();
    files.push(expansion());
    let mut list = read(&files);
    assert_eq!(list.len(), 2);
    let (scene, warnings) = list.remove(0).unwrap();
    assert_eq!((scene.name.as_str(), scene.time.steps), ("scene-0060", 46));
    assert_eq!(scene.meta.licence.as_deref(), Some("cc-by-nc-sa-4.0"));
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let kinds: Vec<_> = scene.agents.iter().map(|a| (a.id.as_str(), a.agent_type, a.subtype)).collect();
    assert_eq!(
        kinds,
        [
            ("ego", AgentType::Vehicle, Subtype::Car),
            ("adult-1", AgentType::Pedestrian, Subtype::Adult),
            ("car-1", AgentType::Vehicle, Subtype::Car),
        ]
    );
    // The pose of the lidar, whose box is ahead of the rear axle; and between two samples.
    let at = |agent: usize, step: usize| scene.agents[agent].track.at(step).unwrap().position() + origin;
    assert!((at(0, 0) - Vec2::new(591.385, 1_636.0)).norm() < 1e-9);
    assert!((at(0, 7) - Vec2::new(591.385 + 8.0 * 0.7, 1_636.0)).norm() < 1e-6);
    let car = scene.agents[2].track.at(5).unwrap();
    assert!((car.heading_rad - 0.1).abs() < 1e-6 && (car.vx_mps - 8.0).abs() < 1e-6, "{car:?}");
    assert_eq!((scene.agents[2].size.length_m, scene.agents[2].size.width_m), (4.6, 1.9));
    let lane = |id: &str| scene.map.lanes.iter().find(|lane| lane.id == id).unwrap();
    assert_eq!(
        (lane("in").successors.as_slice(), lane("out").predecessors.as_slice()),
        (&["way".to_owned()][..], &["way".to_owned()][..])
    );
    // 100 m by 4 m over 60 m of line.
    assert_eq!((lane("in").width_m, lane("way").interpolating), (Some(6.667), true));
    let end = lane("out").points.xy.last().unwrap() + origin;
    let reach = (end - origin).norm();
    assert!(end.x < 900.0 && (reach - 118.0).abs() < 1.0, "ends at the circle: {end} {reach}");
    assert_eq!((scene.map.crosswalks.len(), scene.map.road_lines.len(), scene.map.drivable.len()), (1, 1, 1));
    assert_eq!(scene.map.drivable[0].holes.len(), 1);
    let codes: Vec<&str> = warnings.iter().map(|warning| warning.code).collect();
    for code in ["lanes-dropped", "cut-around", "time-resampled", "velocities-derived"] {
        assert!(codes.contains(&code), "{code} is not in {codes:?}");
    }
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_table() {
    let mut files = tables();
    files.push(expansion());
    let scenes =
        |mark: &str| -> Vec<_> { read_after(mark, &files).into_iter().map(|read| read.unwrap().0).collect() };
    assert_eq!(scenes("\u{feff}"), scenes(""));
}

#[test]
fn broken_tables_are_refused_by_name() {
    let change = |name: &str, to: Option<Value>| {
        let mut files = tables();
        let at = files.iter().position(|(path, _)| path.ends_with(name)).unwrap();
        match to {
            Some(value) => files[at].1 = value,
            None => drop(files.remove(at)),
        }
        read(&files).remove(0)
    };
    let pointer = |read: Result<Imported, ReadError>| read.unwrap_err().problems[0].pointer.clone();
    assert_eq!(pointer(change("/sample.json", Some(json!({"a": 1})))), "/sample.json");
    assert_eq!(pointer(change("/ego_pose.json", Some(json!([{"token": 7}])))), "/ego_pose.json");
    assert!(change("/instance.json", None).unwrap_err().to_string().contains("instance.json"));
    // A chain of samples that leads back to itself ends all the same.
    let ring = json!([{"token": "s0-0", "timestamp": 0, "next": "s0-0"}]);
    assert!(change("/sample.json", Some(ring)).is_ok());
    assert!(change("/scene.json", Some(json!([{"token": "x", "first_sample_token": "none"}]))).is_err());
    // Without poses or maps a scene has no ego and no lanes.
    let (scene, _) = change("/ego_pose.json", None).unwrap();
    assert!(scene.agents.len() == 2 && scene.map.lanes.is_empty());
}
