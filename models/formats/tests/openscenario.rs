//! Scenes as OpenSCENARIO and OpenDRIVE: what is written of a map reads again to the same lanes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, ImportOptions, registry};
use scene::map::{Lane, LaneMap};
use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};
use std::io::{Cursor, Read};

fn example(name: &str) -> Scene {
    let path = format!("{}/../../assets/scenes/demo-{name}.json", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    let list = registry::import(&bytes, "", "dragtraffic", &ImportOptions::default()).unwrap();
    list.into_iter().next().unwrap().unwrap().0
}

fn export(scene: &Scene, format: &str) -> formats::Exported {
    registry::by_id(format).unwrap().export(&[scene], &ExportOptions::default()).unwrap()
}

fn ends(lane: &Lane) -> [Vec2; 2] {
    let points = &lane.points.xy;
    [points[0], points[points.len() - 1]]
}

fn length_m(lane: &Lane) -> f64 {
    formats::polyline::length(&lane.points.xy)
}

/// Reads a map that was written, in the frame that it was written in.
fn again(xodr: &[u8]) -> LaneMap {
    let list = registry::import(xodr, "map.xodr", "auto", &ImportOptions::default()).unwrap();
    let scene = list.into_iter().next().unwrap().unwrap().0;
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let mut map = LaneMap::clone(&scene.map);
    map.lanes.iter_mut().flat_map(|lane| &mut lane.points.xy).for_each(|p| *p += origin);
    map
}

#[test]
fn a_map_comes_back_with_its_lanes_and_links() {
    for name in ["crossing", "roundabout", "residential", "arterial", "motorway"] {
        let scene = example(name);
        let map = again(&export(&scene, "opendrive").bytes);
        let near = |a: &Lane, b: &Lane| (0..2).all(|k| (ends(a)[k] - ends(b)[k]).norm() < 0.05);
        let (mut same, mut links) = (0, 0);
        for lane in &scene.map.lanes {
            let Some(back) = map.lanes.iter().find(|other| near(lane, other)) else { continue };
            same += 1;
            assert!((length_m(lane) - length_m(back)).abs() < 0.05, "{name}: lane {}", lane.id);
            // Ways through junctions are as wide at their ends as the lanes that they connect.
            let off_m = (lane.width_or_assumed_m() - back.width_m.unwrap()).abs();
            assert!(off_m < 0.5 || lane.interpolating, "{name}: lane {}: {off_m}", lane.id);
            links += usize::from(lane.successors.is_empty() == back.successors.is_empty());
        }
        // A lane is shorter if its beginning became a way through a junction.
        let cut = map.lanes.len() - scene.map.lanes.len();
        // One that ends beside the lane it leads to is bent to it.
        let apart = |lane: &&Lane| {
            let next = scene.map.lanes.iter().filter(|next| lane.successors.contains(&next.id));
            lane.interpolating && next.clone().any(|next| (ends(lane)[1] - ends(next)[0]).norm() > 0.05)
        };
        let bent = scene.map.lanes.iter().filter(apart).count();
        assert!(
            same + cut + bent >= scene.map.lanes.len(),
            "{name}: {same} of {}, {cut} cut",
            scene.map.lanes.len()
        );
        assert_eq!(links, same, "{name}");
        assert_eq!(map.crosswalks.len(), scene.map.crosswalks.len(), "{name}");
    }
}

fn unzip(bytes: Vec<u8>) -> Vec<(String, String)> {
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let file = |i: usize| {
        let mut file = zip.by_index(i).unwrap();
        let mut text = String::new();
        file.read_to_string(&mut text).unwrap();
        (file.name().unwrap().into_owned(), text)
    };
    (0..2).map(file).collect()
}

#[test]
fn road_users_come_go_and_follow_their_tracks() {
    let state = |x_m: f64| Some(State { x_m, vx_mps: 10.0, ..State::default() });
    let mut states: Vec<Option<State>> = vec![None; 20];
    states[5..15].iter_mut().enumerate().for_each(|(i, s)| *s = state(i as f64));
    let late = Agent::bare("a<b", AgentType::Vehicle, Subtype::Bus, states);
    let walker =
        Agent::bare("w", AgentType::Pedestrian, Subtype::Adult, (0..20).map(|_| state(50.0)).collect());
    let lanes = vec![Lane::street("1", vec![Vec2::zeros(), Vec2::new(80.0, 0.0)])];
    let mut scene = Scene::bare("Bus & walker", LaneMap { lanes, ..LaneMap::default() }, vec![late, walker]);
    scene.time.steps = 20;
    let first = export(&scene, "openscenario");
    assert_eq!(first, export(&scene, "openscenario"), "the same scene is the same bytes");
    let files = unzip(first.bytes);
    assert_eq!([&*files[0].0, &*files[1].0], ["bus-walker.xosc", "bus-walker.xodr"]);
    let text = &files[0].1;
    let holds = |what: &str| assert!(text.contains(what), "{what} is not in\n{text}");
    holds("LogicFile filepath=\"bus-walker.xodr\"");
    holds("EntityRef entityRef=\"a&lt;b\"");
    holds("vehicleCategory=\"bus\"");
    holds("pedestrianCategory=\"pedestrian\"");
    // Who stands at the end does so for one step more.
    assert_eq!(text.matches("<Vertex").count(), 10 + 20 + 1);
    assert_eq!(text.matches("<AddEntityAction>").count(), 1);
    assert_eq!(text.matches("<DeleteEntityAction/>").count(), 1);
    assert_eq!(text.matches("<Private ").count(), 1, "the bus is not there at first");
    // A way that begins at once would end the initial actions while they are done.
    let at_once = "<SimulationTimeCondition value=\"0\" rule=\"greaterThan\"/>";
    assert_eq!(text.matches(at_once).count(), 1);
    holds("<SimulationTimeCondition value=\"0.5\" rule=\"greaterOrEqual\"/>");
    // The rear axle is behind the centre of the box, which is the scene's position.
    let ahead_m = 0.3 * scene.agents[0].size.length_m;
    holds(&format!("<Center x=\"{}\"", (ahead_m * 1e6).round() / 1e6));
    holds(&format!("<WorldPosition x=\"{}\"", (-ahead_m * 1e6).round() / 1e6));
}

#[test]
fn a_scene_without_lanes_has_no_map() {
    let scene = Scene::bare("empty", LaneMap::default(), Vec::new());
    let error = registry::by_id("opendrive").unwrap().export(&[&scene], &ExportOptions::default());
    assert_eq!(error.unwrap_err().kind(), std::io::ErrorKind::InvalidInput);
    let bytes = export(&scene, "openscenario").bytes;
    let zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    assert_eq!(zip.file_names().map(Result::unwrap).collect::<Vec<_>>(), ["empty.xosc"]);
}
