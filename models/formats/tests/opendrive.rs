//! OpenDRIVE maps as scenes: values by hand, real maps, and files that break promises.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::{ImportOptions, Imported, ReadError, registry};
use scene::geometry::segments::{Segment, SegmentIndex, pieces};
use scene::map::{Lane, LaneMap, LaneType};
use scene::{Scene, SignalState, Vec2};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

const STREET: &str = include_str!("../../../fuzz/corpus/opendrive/street.xodr");
const JUNCTION: &str = include_str!("../../../fuzz/corpus/opendrive/junction.xodr");

fn import(bytes: &[u8]) -> Result<Imported, ReadError> {
    let options = ImportOptions::default();
    registry::import(bytes, "map.xodr", "auto", &options)?.remove(0)
}

fn scene(text: &str) -> Scene {
    import(text.as_bytes()).unwrap().0
}

fn lane<'a>(map: &'a LaneMap, id: &str) -> &'a Lane {
    map.lanes.iter().find(|lane| lane.id == id).unwrap_or_else(|| panic!("no lane {id}"))
}

fn near(found: Vec2, expected: (f64, f64)) {
    let gap = (found - Vec2::new(expected.0, expected.1)).norm();
    assert!(gap < 0.01, "{found:?} found, {expected:?} expected");
}

/// Places where an edge of the road lies across a way that vehicles take.
fn kerbs_across(map: &LaneMap) -> Vec<String> {
    let edges = map.road_edges.iter().zip(0..).flat_map(|(edge, i)| pieces(&edge.points.xy, i)).collect();
    let edges = SegmentIndex::new(edges);
    let by_id: HashMap<&str, &Lane> = map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect();
    let mut across = Vec::new();
    for lane in map.lanes.iter().filter(|lane| lane.lane_type.carries_vehicles()) {
        let ends = lane.successors.iter().map(|next| by_id[next.as_str()].points.xy[0]);
        let links = ends.map(|start| [lane.points.xy[lane.points.xy.len() - 1], start]);
        let ways = lane.points.xy.windows(2).map(|w| [w[0], w[1]]).chain(links);
        for [p, q] in ways {
            let reach = (q - p).norm() + 1.0;
            if edges.near(p, reach).any(|edge: &Segment| edge.crosses(p, q)) {
                across.push(format!("lane {} at {p:?}", lane.id));
            }
        }
    }
    across
}

/// Links of any map hold: both ends name each other, and their points meet.
fn links_hold(map: &LaneMap, gap_m: f64) {
    let by_id: HashMap<&str, &Lane> = map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect();
    for lane in &map.lanes {
        for next in &lane.successors {
            let next = by_id[next.as_str()];
            assert!(next.predecessors.contains(&lane.id), "{} -> {}", lane.id, next.id);
            let gap = (next.points.xy[0] - lane.points.xy.last().unwrap()).norm();
            assert!(gap < gap_m, "{} -> {}: {gap} m", lane.id, next.id);
        }
    }
}

#[test]
fn a_street_becomes_a_scene_without_road_users() {
    let (scene, warnings) = import(STREET.as_bytes()).unwrap();
    let codes: Vec<&str> = warnings.iter().map(|w| w.code).collect();
    assert_eq!(codes, ["parts-dropped", "signals-made"], "{warnings:?}");
    assert_eq!((scene.name.as_str(), scene.agents.len(), scene.time.steps), ("street", 0, 91));
    assert_eq!(scene.meta.origin.crs.as_deref(), Some("+proj=tmerc"));
    let map = &scene.map;
    let types: Vec<_> = map.lanes.iter().map(|l| (l.id.as_str(), l.lane_type)).collect();
    use LaneType::{BikeLane, Sidewalk, SurfaceStreet};
    let expected =
        [("1.0.-3", Sidewalk), ("1.0.-2", BikeLane), ("1.0.-1", SurfaceStreet), ("1.0.1", SurfaceStreet)];
    assert_eq!(types, expected);
    // 80 m along 0.5 rad from (100, -20); the lane is 1.75 m to the right. Centre lines have a point a metre.
    let right = lane(map, "1.0.-1");
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    let (sin, cos) = 0.5_f64.sin_cos();
    near(right.points.xy[0] + origin, (100.0 + 1.75 * sin, -20.0 - 1.75 * cos));
    near(right.points.xy[80] + origin, (100.0 + 80.0 * cos + 1.75 * sin, -20.0 + 80.0 * sin - 1.75 * cos));
    assert_eq!((right.points.xy.len(), right.width_m), (81, Some(3.5)));
    assert!((right.speed_limit_mps.unwrap() - 50.0 / 3.6).abs() < 1e-3);
    assert!((right.points.z_m.as_ref().unwrap()[80] - 2.8).abs() < 1e-3);
    // Against the road.
    near(
        lane(map, "1.0.1").points.xy[0] + origin,
        (100.0 + 80.0 * cos - 1.75 * sin, -20.0 + 80.0 * sin + 1.75 * cos),
    );
    assert_eq!((right.right_neighbors[0].lane.as_str(), right.left_neighbors.len()), ("1.0.-2", 0));
    // The middle line bounds both lanes on the left.
    let middle = map.road_lines.iter().find(|line| line.line_type == "solid_double_yellow").unwrap();
    for id in ["1.0.-1", "1.0.1"] {
        let boundary = &lane(map, id).left_boundary[0];
        assert_eq!((boundary.line.as_str(), boundary.from, boundary.to), (middle.id.as_str(), 0, 80));
    }
    // Edges lie at the outer sides, the right one beyond the bicycles and before the raised pavement.
    assert_eq!(map.road_edges.len(), 2);
    let across = |p: &Vec2| (p + origin - Vec2::new(100.0, -20.0)).dot(&Vec2::new(-sin, cos));
    let mut sides: Vec<f64> = map.road_edges.iter().map(|edge| across(&edge.points.xy[0])).collect();
    sides.sort_by(f64::total_cmp);
    assert!((sides[0] + 5.0).abs() < 0.02 && (sides[1] - 3.5).abs() < 0.02, "{sides:?}");
    assert_eq!((map.crosswalks.len(), map.crosswalks[0].polygon.xy.len()), (1, 4));
    assert_eq!(map.stop_signs[0].lanes, ["1.0.1"]);
    // The head holds back at the painted line, a metre beyond it.
    let signal = &scene.signals[0];
    assert_eq!((scene.signals.len(), signal.lane.as_str(), signal.at(0)), (1, "1.0.-1", SignalState::Go));
    near(signal.stop.unwrap() + origin, (100.0 + 37.0 * cos + 1.75 * sin, -20.0 + 37.0 * sin - 1.75 * cos));
    assert!(kerbs_across(map).is_empty());
}

#[test]
fn a_junction_of_left_hand_traffic_is_one_surface() {
    let scene = scene(JUNCTION);
    let map = &scene.map;
    links_hold(map, 0.05);
    assert_eq!(lane(map, "1.0.1").successors, ["10.0.1", "12.0.1"]);
    assert_eq!(lane(map, "10.0.1").successors, ["2.0.-1"]);
    assert!(lane(map, "10.0.1").interpolating && !lane(map, "1.0.1").interpolating);
    // From the west, traffic keeps north of the centre line.
    let from_west = &lane(map, "1.0.1").points.xy;
    assert!(from_west[0].x < from_west[40].x && from_west[0].y > lane(map, "1.0.-1").points.xy[0].y);
    assert_eq!(map.drivable.len(), 1);
    assert!(kerbs_across(map).is_empty());
    // The arms from west and east have green together, by the controllers of the junction.
    let shown: Vec<_> = scene.signals.iter().map(|s| (s.lane.as_str(), s.at(0))).collect();
    use SignalState::{Go, Stop};
    assert_eq!(shown, [("1.0.1", Go), ("2.0.1", Go), ("3.0.1", Stop)]);
}

#[test]
fn coordinates_of_a_whole_country_keep_their_places() {
    let (east, north) = (691_000.25, 5_334_000.75);
    let moved = STREET.replace("x=\"100\"", &format!("x=\"{}\"", 100.0 + east));
    let far = scene(&moved.replace("y=\"-20\"", &format!("y=\"{}\"", north - 20.0)));
    let here = scene(STREET);
    let place = |scene: &Scene, p: &Vec2| p + Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    for (a, b) in here.map.lanes.iter().zip(&far.map.lanes) {
        for (p, q) in a.points.xy.iter().zip(&b.points.xy) {
            let gap = place(&far, q) - place(&here, p) - Vec2::new(east, north);
            assert!(gap.norm() < 1e-3, "{gap:?}");
        }
    }
}

#[test]
fn real_maps_are_read_whole() {
    let Some(files) = samples::files("formats/opendrive", ".xodr") else { return };
    for path in files {
        let bytes = std::fs::read(&path).unwrap();
        let (scene, warnings) = import(&bytes).unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        println!(
            "{name}: {} lanes, {} edges, {warnings:?}",
            scene.map.lanes.len(),
            scene.map.road_edges.len()
        );
        links_hold(&scene.map, 0.6);
        assert!(kerbs_across(&scene.map).is_empty(), "{name}: {:?}", kerbs_across(&scene.map));
        let longest = scene.map.lanes.iter().flat_map(|lane| lane.points.xy.windows(2));
        assert!(longest.map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max) < 1.1, "{name}");
        match name.as_str() {
            "e6mini.xodr" => {
                let medians = scene.map.road_edges.iter().filter(|edge| edge.line_type == "median").count();
                assert_eq!((scene.map.lanes.len(), scene.map.road_edges.len(), medians), (6, 4, 2));
            }
            "fabriksgatan.xodr" => {
                let ways =
                    scene.map.lanes.iter().filter(|l| l.interpolating && l.lane_type.carries_vehicles());
                assert_eq!((ways.count(), scene.map.road_edges.len(), scene.map.drivable.len()), (12, 4, 1));
                let linked = |l: &&Lane| {
                    l.lane_type.carries_vehicles() && l.predecessors.len() + l.successors.len() > 0
                };
                assert_eq!(scene.map.lanes.iter().filter(linked).count(), 20);
            }
            "two_plus_one.xodr" => assert_eq!((scene.map.lanes.len(), scene.map.road_edges.len()), (17, 2)),
            _ => {}
        }
    }
}

/// Name, file, code, part of the detail.
type Case = (&'static str, Vec<u8>, &'static str, &'static str);

fn bad_files() -> Vec<Case> {
    let case = |name, from: &str, to: &str, code, detail| -> Case {
        assert!(STREET.contains(from), "{name}");
        (name, STREET.replacen(from, to, 1).into(), code, detail)
    };
    let (file, no, large) = ("malformed-file", "cannot-represent", "map-too-large");
    let unfolds = "decoded-too-large";
    let road = |inner: &str| format!("<OpenDRIVE><road id='1' length='100'>{inner}</road></OpenDRIVE>");
    let plan = |count: usize, length: f64| {
        let piece = |i: usize| {
            format!(
                "<geometry s='{i}' x='0' y='0' hdg='0' length='{length}'><spiral curvStart='0' curvEnd='1'/></geometry>"
            )
        };
        road(&format!("<planView>{}</planView>", (0..count).map(piece).collect::<String>()))
    };
    let laughs = "<!DOCTYPE OpenDRIVE [<!ENTITY a \"ha\">]><OpenDRIVE>&a;</OpenDRIVE>";
    vec![
        case("no planView", "<planView>", "<plan>", file, "</planView> found"),
        ("nobody's lanes", STREET.replace("type=\"", "type=\"un").into(), no, "the file has no lane"),
        case("no length", "length=\"80\" junction", "junction", no, "no roads with lanes"),
        case("length NaN", "length=\"80\" junction", "length=\"NaN\" junction", no, "no roads with lanes"),
        case("far away", "x=\"100\"", "x=\"1e300\"", "out-of-range", "found, -100000000"),
        case("cut off", "</OpenDRIVE>", "", file, "the file ends inside <OpenDRIVE>"),
        case("unknown entity", "two lanes", "&two;", file, "\"&two\" found, a known reference"),
        ("billion laughs", laughs.into(), file, "a document type definition"),
        ("deep nesting", format!("<OpenDRIVE>{}", "<road>".repeat(100_000)).into(), file, "deeper than 32"),
        ("no roads", b"<OpenDRIVE/>".into(), no, "no roads with lanes"),
        ("lines to the moon", plan(20_000, 1e5).into(), large, "reference lines"),
        ("roads far apart", long_roads(8, 1_000, 90_000).into(), large, "from its middle"),
        ("roads to the moon", long_roads(8, 12_000, 9_000).into(), unfolds, "m of lanes"),
        ("records", records().into(), unfolds, "100037 elements"),
    ]
}

/// Roads so long, and so far from each other, metres.
fn long_roads(count: usize, length_m: usize, apart_m: usize) -> String {
    let road = |i: usize| {
        STREET
            .replace("<road id=\"1\"", &format!("<road id=\"{i}\""))
            .replace("80\"", &format!("{length_m}\""))
            .replace("x=\"100\"", &format!("x=\"{}\"", i * apart_m))
    };
    let inner = |text: String| {
        let (from, to) = (text.find("<road").unwrap(), text.find("</OpenDRIVE>").unwrap());
        text[from..to].to_owned()
    };
    format!("<OpenDRIVE>{}</OpenDRIVE>", (0..count).map(|i| inner(road(i))).collect::<String>())
}

fn records() -> String {
    let mut list = String::new();
    for i in 0..100_000 {
        write!(list, "<elevation s='{i}' a='0' b='0' c='0' d='0'/>").unwrap();
    }
    STREET
        .replace("<elevation s=\"0\" a=\"2\" b=\"0.01\" c=\"0\" d=\"0\"/>", &list)
        .replace("80\"", "90000\"")
}

#[test]
fn bad_files_are_refused_precisely() {
    let mut wrong = Vec::new();
    for (name, bytes, code, detail) in bad_files() {
        let start = Instant::now();
        let Err(error) = import(&bytes) else {
            wrong.push(format!("{name}: read without a fault"));
            continue;
        };
        println!("{name:20} {:?} {error}", start.elapsed());
        if error.code() != code || !error.problems[0].detail.contains(detail) {
            wrong.push(format!("{name}: expected {code} with \"{detail}\", got {error}"));
        }
        assert!(start.elapsed() < Duration::from_secs(10), "{name}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn cut_and_damaged_files_never_panic() {
    for text in [STREET, JUNCTION] {
        for end in (0..text.len()).step_by(61) {
            formats::checks::map_of("opendrive", &text.as_bytes()[..end]);
        }
        for at in (0..text.len()).step_by(37) {
            let mut bytes = text.as_bytes().to_vec();
            bytes[at] ^= 1 << (at % 7);
            formats::checks::map_of("opendrive", &bytes);
        }
    }
}

#[test]
fn files_are_known_by_what_they_hold() {
    let found = |bytes: &[u8], name: &str| registry::sniff(bytes, name).map(|format| format.info().id);
    assert_eq!(found(STREET.as_bytes(), "map.net.xml"), Some("opendrive"));
    assert_eq!(found(b"", "map.xodr"), Some("opendrive"));
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/sumo-net/street.net.xml");
    assert_eq!(
        found(&std::fs::read(corpus).unwrap_or_else(|_| b"<net/>".to_vec()), "a.xodr"),
        Some("sumo-net")
    );
}

#[test]
fn a_lane_used_both_ways_is_a_scene_that_can_be_kept() {
    let one = r#"<lane id="-1" type="driving" level="false""#;
    let scene = scene(&STREET.replace(one, &format!(r#"{one} direction="both""#)));
    let against: Vec<&str> =
        scene.map.lanes.iter().filter_map(|lane| lane.id.strip_suffix(".back")).collect();
    let [id] = against[..] else { panic!("{against:?}") };
    let (there, back) = (lane(&scene.map, id), lane(&scene.map, &format!("{id}.back")));
    assert!(there.points.xy.iter().eq(back.points.xy.iter().rev()));
    let native = registry::by_id("dragtraffic").unwrap();
    let file = native.export(&[&scene], &formats::ExportOptions::default()).unwrap();
    assert_eq!(formats::native::read(&file.bytes).unwrap().map, scene.map);
}

/// A road of two lanes each way round a ring of 300 m, and one that turns as far and ends elsewhere.
fn ring(length_m: f64) -> String {
    let lane = |id: i32| {
        format!(
            r#"<lane id="{id}" type="driving"><link><predecessor id="{id}"/><successor id="{id}"/></link>
            <width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>"#
        )
    };
    let curvature = std::f64::consts::TAU / 300.0;
    format!(
        r#"<OpenDRIVE><road id="0" length="{length_m}"><link><predecessor elementType="road" elementId="0" contactPoint="end"/>
        <successor elementType="road" elementId="0" contactPoint="start"/></link><planView>
        <geometry s="0" x="0" y="0" hdg="0" length="{length_m}"><arc curvature="{curvature}"/></geometry></planView>
        <lanes><laneSection s="0"><left>{}{}</left><right>{}{}</right></laneSection></lanes></road></OpenDRIVE>"#,
        lane(2),
        lane(1),
        lane(-1),
        lane(-2)
    )
}

#[test]
fn lanes_of_a_ring_lead_into_themselves() {
    let closed = scene(&ring(300.0));
    assert_eq!(closed.map.lanes.len(), 4);
    for lane in &closed.map.lanes {
        assert_eq!((&lane.successors, &lane.predecessors), (&vec![lane.id.clone()], &vec![lane.id.clone()]));
    }
    let open = scene(&ring(200.0));
    assert!(open.map.lanes.iter().all(|lane| lane.successors.is_empty()), "its ends lie apart");
    let exported = |format: &str| {
        let format = registry::by_id(format).unwrap();
        format.export(&[&closed], &formats::ExportOptions::default()).unwrap().bytes
    };
    let again = import(&exported("opendrive")).unwrap().0;
    assert!(again.map.lanes.len() == 4 && again.map.lanes.iter().all(|lane| lane.successors.len() == 1));
    let net = registry::import(&exported("sumo-net"), "x.net.xml", "auto", &ImportOptions::default());
    let (net, _) = net.unwrap().remove(0).unwrap();
    let on: Vec<&Lane> = net.map.lanes.iter().filter(|lane| !lane.interpolating).collect();
    assert!(on.len() == 4 && on.iter().all(|lane| lane.successors.len() == 1), "{:?}", net.map.lanes.len());
}
