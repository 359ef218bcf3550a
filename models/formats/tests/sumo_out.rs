//! Demo scenes as folders of SUMO: what is written of them reads again, and its files agree with each other.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, ImportOptions, registry};
use scene::map::{Lane, LaneType};
use scene::{STEP_S, Scene, Signal, SignalState, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read};

const DEMOS: [&str; 5] = ["crossing", "roundabout", "residential", "arterial", "motorway"];

fn demo(name: &str) -> Scene {
    let path = format!("{}/../../assets/scenes/demo-{name}.json", env!("CARGO_MANIFEST_DIR"));
    formats::native::read(&std::fs::read(path).unwrap()).unwrap()
}

fn folder(scene: &Scene) -> Vec<u8> {
    registry::by_id("sumo").unwrap().export(&[scene], &ExportOptions::default()).unwrap().bytes
}

fn files(bytes: &[u8]) -> BTreeMap<String, String> {
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut files = BTreeMap::new();
    for i in 0..zip.len() {
        let mut file = zip.by_index(i).unwrap();
        let name = file.name().unwrap().into_owned();
        let mut text = String::new();
        file.read_to_string(&mut text).unwrap();
        files.insert(name.split_once('.').unwrap().1.to_owned(), text);
    }
    files
}

/// Attributes of all elements of this name, in their order.
fn elements<'a>(text: &'a str, name: &str) -> Vec<BTreeMap<&'a str, &'a str>> {
    let open = format!("<{name} ");
    let tags = text.split('\n').map(str::trim).filter_map(|line| line.strip_prefix(&open));
    let attributes = |tag: &'a str| {
        let pairs = tag.split("\" ").filter_map(|pair| pair.split_once("=\""));
        pairs.map(|(name, value)| (name, value.split('"').next().unwrap())).collect()
    };
    tags.map(attributes).collect()
}

fn ends(scene: &Scene, lane: &Lane) -> [Vec2; 2] {
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let points = &lane.points.xy;
    [points[0] + origin, points[points.len() - 1] + origin]
}

#[test]
fn lanes_beside_each_other_stay_so() {
    for name in DEMOS {
        let scene = demo(name);
        let bytes = folder(&scene);
        assert_eq!(bytes, folder(&scene), "the same scene is the same bytes");
        let list = registry::import(&bytes, "upload", "auto", &ImportOptions::default()).unwrap();
        let (again, _) = list.into_iter().next().unwrap().unwrap();
        let near = |a: &Lane, b: &Lane| {
            let (own, its) = (ends(&scene, a), ends(&again, b));
            (0..2).all(|k| (own[k] - its[k]).norm() < 1e-3)
        };
        let back = |lane: &Lane| again.map.lanes.iter().find(|other| near(lane, other));
        let (mut beside, mut kept) = (0, 0);
        // Parking lanes are closed to traffic and not read again, which is a declared loss.
        let open = |lane: &&Lane| lane.lane_type != LaneType::Parking;
        for lane in scene.map.lanes.iter().filter(open) {
            let other = back(lane).unwrap_or_else(|| panic!("{name}: lane {}", lane.id));
            // Ways through junctions are read without neighbours.
            for neighbor in lane.left_neighbors.iter().filter(|_| !lane.interpolating) {
                let its = scene.map.lanes.iter().filter(open).find(|other| other.id == neighbor.lane);
                let Some(its) = its else { continue };
                beside += 1;
                kept += usize::from(other.left_neighbors.iter().any(|n| n.lane == back(its).unwrap().id));
            }
        }
        assert!(kept * 10 >= beside * 9, "{name}: {kept} of {beside} lanes to the left");
        assert!(beside > 0 || name == "residential" || name == "roundabout", "{name}");
    }
}

#[test]
fn files_of_a_folder_agree() {
    for name in DEMOS {
        let scene = demo(name);
        let files = files(&folder(&scene));
        let ends: Vec<&str> = files.keys().map(String::as_str).collect();
        assert_eq!(ends, ["fcd.xml", "net.xml", "rou.xml", "sumocfg"]);
        let (net, trips) = (&files["net.xml"], &files["rou.xml"]);
        let edges: BTreeSet<&str> = elements(net, "edge").iter().map(|edge| edge["id"]).collect();
        let links: BTreeSet<(&str, &str)> =
            elements(net, "connection").iter().map(|link| (link["from"], link["to"])).collect();
        let lanes: BTreeMap<&str, f64> =
            elements(net, "lane").iter().map(|lane| (lane["id"], lane["length"].parse().unwrap())).collect();
        let types: BTreeSet<&str> = elements(trips, "vType").iter().map(|kind| kind["id"]).collect();
        let vehicles = elements(trips, "vehicle");
        let routes = elements(trips, "route");
        assert_eq!(vehicles.len(), routes.len());
        assert!(!vehicles.is_empty(), "{name}");
        for (vehicle, route) in vehicles.iter().zip(&routes) {
            let way: Vec<&str> = route["edges"].split(' ').collect();
            assert!(way.iter().all(|edge| edges.contains(edge)), "{name}: {way:?}");
            assert!(way.windows(2).all(|pair| links.contains(&(pair[0], pair[1]))), "{name}: {way:?}");
            let length_m = lanes[format!("{}_{}", way[0], vehicle["departLane"]).as_str()];
            assert!(vehicle["departPos"].parse::<f64>().unwrap() <= length_m);
            assert!(types.contains(vehicle["type"]));
            let agent = scene.agent(vehicle["id"]).unwrap();
            assert!(scene.shown(agent).track.valid_steps().next().is_some());
        }
        let departures = |list: &[BTreeMap<&str, &str>]| -> Vec<f64> {
            list.iter().map(|user| user["depart"].parse().unwrap()).collect()
        };
        assert!(departures(&vehicles).is_sorted());
        // Every rule of a junction has a letter for each of its links.
        let requests = elements(net, "request");
        assert!(requests.iter().all(|rule| rule["response"].len() == rule["foes"].len()));
        assert!(requests.iter().any(|rule| rule["response"].contains('1')) || name == "motorway", "{name}");
        assert_eq!(elements(net, "tlLogic").is_empty(), scene.signals.is_empty(), "{name}");
    }
}

#[test]
fn lights_last_as_long_as_motion() {
    let mut scene = demo("crossing");
    let longest = scene.agents.iter().map(|agent| agent.track.first_step + agent.track.states.len()).max();
    let last = longest.unwrap() - 1;
    // Motion goes on when the scene is over, as that of futures may.
    scene.time.steps = last / 2;
    for signal in &mut scene.signals {
        signal.runs = vec![(0, SignalState::Stop), (last, SignalState::Go)];
    }
    let net =
        registry::by_id("sumo-net").unwrap().export(&[&scene], &ExportOptions::default()).unwrap().bytes;
    for text in [&files(&folder(&scene))["net.xml"], &String::from_utf8(net).unwrap()] {
        let phases = elements(text, "phase");
        let lengths_s: Vec<f64> =
            phases.iter().map(|phase| phase["duration"].parse::<f64>().unwrap()).collect();
        let states: BTreeSet<&str> = phases.iter().map(|phase| &phase["state"][..1]).collect();
        assert_eq!((phases.len(), states), (2, BTreeSet::from(["r", "g"])));
        assert!((lengths_s[0] - last as f64 * STEP_S).abs() < 1e-9, "{lengths_s:?}");
        assert!((lengths_s[1] - STEP_S).abs() < 1e-9, "{lengths_s:?}");
    }
}

/// A lane round a circle that leads into itself, with a light, alone and with roads that lead into it and out of it.
#[test]
fn a_light_of_a_ring_comes_back_or_is_said_to_be_lost() {
    use scene::map::LaneMap;
    let around = |i: i32| scene::geometry::direction(f64::from(i) * std::f64::consts::TAU / 60.0) * 40.0;
    let mut ring = Lane::street("1", (0..=60).map(around).collect::<Vec<Vec2>>());
    (ring.successors, ring.predecessors) = (vec!["1".into()], vec!["1".into()]);
    let beside =
        |id: &str, from: f64, to: f64| Lane::street(id, vec![Vec2::new(40.0, from), Vec2::new(40.0, to)]);
    let mut into = beside("2", -60.0, 0.0);
    into.successors.push("1".into());
    let mut out_of = beside("3", 0.0, 60.0);
    out_of.predecessors.push("1".into());
    for others in [vec![], vec![into.clone()], vec![out_of.clone()], vec![into, out_of]] {
        let count = others.len();
        let lanes = [vec![ring.clone()], others].concat();
        let mut scene = Scene::bare("ring", LaneMap { lanes, ..LaneMap::default() }, Vec::new());
        scene.time.steps = 91;
        let runs = vec![(0, SignalState::Go), (40, SignalState::Stop)];
        scene.signals = vec![Signal { lane: "1".into(), stop: Some(around(0)), stop_z_m: None, runs }];
        let file = registry::by_id("sumo-net").unwrap().export(&[&scene], &ExportOptions::default()).unwrap();
        assert!(file.losses.iter().all(|loss| loss.code != "no-signals"), "{count} others");
        let list = registry::import(&file.bytes, "a.net.xml", "auto", &ImportOptions::default()).unwrap();
        let (again, _) = list.into_iter().next().unwrap().unwrap();
        assert_eq!(again.signals.len(), 1, "{count} others");
        let shown = [0, 39, 40, 90].map(|step| again.signals[0].at(step));
        assert_eq!(shown, [SignalState::Go, SignalState::Go, SignalState::Stop, SignalState::Stop]);
        // A second light of the lane has no place in the network.
        scene.signals.push(scene.signals[0].clone());
        let file = registry::by_id("sumo-net").unwrap().export(&[&scene], &ExportOptions::default()).unwrap();
        assert!(file.losses.iter().any(|loss| loss.code == "no-signals"), "{count} others");
    }
}
