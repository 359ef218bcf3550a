//! Lanelet2 maps as scenes: values by hand, and files that break promises.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ImportOptions, Imported, ReadError, registry};
use scene::map::{Lane, LaneMap};
use scene::{SignalState, Vec2};

const STREET: &str = include_str!("../../../fuzz/corpus/lanelet2/street.osm");

fn import(text: &str) -> Result<Imported, ReadError> {
    registry::import(text.as_bytes(), "map.osm", "auto", &ImportOptions::default())?.remove(0)
}

fn lane<'a>(map: &'a LaneMap, id: &str) -> &'a Lane {
    map.lanes.iter().find(|lane| lane.id == id).unwrap_or_else(|| panic!("no lane {id}"))
}

#[test]
fn a_street_becomes_a_scene_without_road_users() {
    let (scene, warnings) = import(STREET).unwrap();
    assert_eq!(warnings.iter().map(|w| w.code).collect::<Vec<_>>(), ["signals-made"]);
    let map = &scene.map;
    let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
    assert_eq!(origin, Vec2::new(35.0, -5.0));
    // Sides are drawn in any direction; the opposite lane has the centre line on its left too.
    let (there, beside, back) = (lane(map, "1"), lane(map, "2"), lane(map, "3"));
    assert_eq!(
        (there.points.xy[0] + origin, back.points.xy[0] + origin),
        (Vec2::new(0.0, -1.5), Vec2::new(50.0, 1.75))
    );
    assert_eq!((there.points.xy.len(), there.width_m, back.width_m), (51, Some(3.0), Some(3.5)));
    assert_eq!(
        (there.successors.as_slice(), beside.successors.as_slice()),
        (&["4".to_owned()][..], &["5".to_owned()][..])
    );
    assert_eq!(lane(map, "5").predecessors, ["2"]);
    assert!(back.successors.is_empty() && lane(map, "4").interpolating && !there.interpolating);
    assert_eq!((there.speed_limit_mps, beside.speed_limit_mps), (Some(13.889), Some(13.411)));
    assert_eq!((there.right_neighbors[0].lane.as_str(), there.left_neighbors.len()), ("2", 0));
    let words: Vec<&str> = map.road_lines.iter().map(|line| line.line_type.as_str()).collect();
    assert_eq!(words, ["solid_double_yellow", "broken_single_white"]);
    assert_eq!((there.left_boundary[0].line.as_str(), back.left_boundary[0].line.as_str()), ("101", "101"));
    assert_eq!((map.crosswalks.len(), map.stop_signs[0].lanes.as_slice()), (1, &["3".to_owned()][..]));
    let heads: Vec<_> =
        scene.signals.iter().map(|s| (s.lane.as_str(), s.stop.unwrap() + origin, s.at(0))).collect();
    let expected =
        [("1", Vec2::new(48.0, -1.5), SignalState::Go), ("2", Vec2::new(48.0, -4.5), SignalState::Go)];
    assert_eq!(heads, expected);
    assert!(!map.road_edges.is_empty() && map.drivable.len() == 1);
}

#[test]
fn degrees_are_projected_where_there_is_nothing_else() {
    // Metres of a degree of latitude and of longitude at 48.1 N on WGS 84.
    let (north, east) = (111_192.3, 74_481.3);
    let degrees = |line: &str| {
        let number = |key: &str| line.split_once(key)?.1.split('\'').nth(2)?.parse::<f64>().ok();
        let Some((x, y)) = number("local_x").zip(number("local_y")) else { return line.to_owned() };
        let id = line.split('\'').nth(1).unwrap();
        format!("<node id='{id}' lat='{}' lon='{}'/>", 48.1 + y / north, 11.5 + x / east)
    };
    let text: String = STREET.lines().map(degrees).collect();
    let (scene, _) = import(&text).unwrap();
    assert!(scene.meta.origin.crs.unwrap().starts_with("+proj=tmerc +lat_0=48.1 +lon_0=11.5 "));
    let metres = import(STREET).unwrap().0;
    for (a, b) in scene.map.lanes.iter().zip(&metres.map.lanes) {
        assert_eq!((&a.id, &a.successors), (&b.id, &b.successors));
        let length = |lane: &Lane| formats::polyline::length(&lane.points.xy);
        assert!(
            (length(a) - length(b)).abs() < 0.01 && (a.width_m.unwrap() - b.width_m.unwrap()).abs() < 0.01
        );
    }
}

#[test]
fn other_files_are_refused_precisely() {
    let extract = "<osm><node id='1' lat='48' lon='11'/><way id='2'><nd ref='1'/><tag k='highway' v='road'/></way></osm>";
    let cases = [
        (extract.to_owned(), "cannot-represent", "OpenStreetMap"),
        (
            STREET.replace("node id='1'", "node id='one'"),
            "invalid-field",
            "\"one\" found, a whole number as id",
        ),
        (STREET.replace("v='0'", "v='1e300'"), "out-of-range", "found, -100000000"),
        (STREET.replace("v='70'", "v='70000'"), "map-too-large", "from its middle"),
        (STREET.replace("</osm>", ""), "malformed-file", "the file ends inside <osm>"),
        (STREET.replace("'left'", "'top'"), "cannot-represent", "no lanelets"),
    ];
    for (text, code, detail) in cases {
        let error = import(&text).unwrap_err();
        assert!(error.code() == code && error.problems[0].detail.contains(detail), "{code}: {error}");
    }
}

#[test]
fn cut_and_damaged_files_never_panic() {
    for end in (0..STREET.len()).step_by(41) {
        formats::checks::map_of("lanelet2", &STREET.as_bytes()[..end]);
    }
    for at in (0..STREET.len()).step_by(29) {
        let mut bytes = STREET.as_bytes().to_vec();
        bytes[at] ^= 1 << (at % 7);
        formats::checks::map_of("lanelet2", &bytes);
    }
}

#[test]
fn a_street_used_both_ways_is_a_scene_that_can_be_kept() {
    let road = "<tag k='subtype' v='road'/><tag k='turn_direction' v='straight'/>";
    let both = STREET.replace(road, &format!("{road}<tag k='one_way' v='no'/>"));
    let (scene, _) = import(&both).unwrap();
    let (there, back) = (lane(&scene.map, "4"), lane(&scene.map, "4.back"));
    assert!(there.points.xy.iter().eq(back.points.xy.iter().rev()));
    assert_eq!((there.predecessors.as_slice(), back.successors.len()), (&["1".to_owned()][..], 0));
    let native = registry::by_id("dragtraffic").unwrap();
    let file = native.export(&[&scene], &formats::ExportOptions::default()).unwrap();
    assert_eq!(formats::native::read(&file.bytes).unwrap().map, scene.map);
}

/// A map of lanelets by their subtypes and sides, which are lists of nodes: id, x and y.
fn map_of(nodes: &[(u32, f64, f64)], lanelets: &[(u32, &str, &[u32], &[u32])]) -> String {
    let node = |(id, x, y): &(u32, f64, f64)| {
        format!("<node id='{id}' lat='0' lon='0'><tag k='local_x' v='{x}'/><tag k='local_y' v='{y}'/></node>")
    };
    let way = |id: u32, nodes: &[u32]| {
        let nodes: String = nodes.iter().map(|node| format!("<nd ref='{node}'/>")).collect();
        format!("<way id='{id}'>{nodes}</way>")
    };
    let ways = lanelets.iter().map(|(id, _, left, right)| way(id * 10, left) + &way(id * 10 + 1, right));
    let relation = |(id, subtype, ..): &(u32, &str, &[u32], &[u32])| {
        format!(
            "<relation id='{id}'><member type='way' ref='{0}0' role='left'/><member type='way' ref='{0}1' role='right'/>\
             <tag k='type' v='lanelet'/><tag k='subtype' v='{subtype}'/></relation>",
            id
        )
    };
    let nodes: String = nodes.iter().map(node).collect();
    let relations: String = lanelets.iter().map(relation).collect();
    format!("<osm>{nodes}{}{relations}</osm>", ways.collect::<String>())
}

#[test]
fn a_turn_about_a_point_leads_from_one_side_to_the_other() {
    // The ends of the turn's sides are as near to each other either way.
    let nodes = [
        (1, 0.0, 0.0),
        (2, 50.0, 0.0),
        (3, 0.0, -3.0),
        (4, 51.0, -2.9),
        (5, 50.16, 0.0),
        (6, 53.5, -1.5),
        (7, 54.0, 0.0),
        (8, 53.5, 1.5),
        (9, 50.83, 2.88),
        (10, 0.16, 0.1),
        (11, 0.0, 3.0),
    ];
    let there: (u32, &str, &[u32], &[u32]) = (100, "road", &[1, 2], &[3, 4]);
    let back: (u32, &str, &[u32], &[u32]) = (102, "road", &[5, 10], &[9, 11]);
    for (left, right) in
        [(&[2, 5][..], &[4, 6, 7, 8, 9][..]), (&[5, 2], &[9, 8, 7, 6, 4]), (&[5, 2], &[4, 6, 7, 8, 9])]
    {
        let map = import(&map_of(&nodes, &[there, (101, "road", left, right), back])).unwrap().0.map;
        assert_eq!(lane(&map, "100").successors, ["101"], "{left:?} {right:?}");
        assert_eq!(lane(&map, "101").successors, ["102"], "{left:?} {right:?}");
        let turn = &lane(&map, "101").points.xy;
        assert!((turn[0].y - turn[turn.len() - 1].y) < -2.0, "{turn:?}");
    }
}

#[test]
fn roads_and_pavements_that_meet_are_no_way_for_anybody() {
    let nodes = [
        (1, 0.0, 0.0),
        (2, 0.0, -3.0),
        (3, 9.0, 0.0),
        (4, 9.0, -3.0),
        (5, 19.0, 0.0),
        (6, 19.0, -3.0),
        (7, 29.0, 0.0),
        (8, 29.0, -3.0),
    ];
    let kinds = |kinds: [&str; 3]| {
        let lanelets: [(u32, &str, &[u32], &[u32]); 3] = [
            (100, kinds[0], &[1, 3], &[2, 4]),
            (101, kinds[1], &[3, 5], &[4, 6]),
            (102, kinds[2], &[5, 7], &[6, 8]),
        ];
        let map = import(&map_of(&nodes, &lanelets)).unwrap().0.map;
        ["100", "101"].map(|id| lane(&map, id).successors.len())
    };
    assert_eq!(kinds(["road", "walkway", "walkway"]), [0, 1]);
    assert_eq!(kinds(["walkway", "walkway", "road"]), [1, 0]);
    assert_eq!(kinds(["bicycle_lane", "road", "bicycle_lane"]), [1, 1]);
}
