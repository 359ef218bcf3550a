//! Maps that are read in part: what lies within a circle.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ImportOptions, Imported, ReadError, registry};
use scene::Scene;
use std::collections::HashSet;
use std::fmt::Write as _;

fn read(text: &str, name: &str, around: Option<&str>) -> Result<Imported, ReadError> {
    let around = around.map(|text| text.parse().unwrap());
    let options = ImportOptions { around, ..ImportOptions::default() };
    registry::import(text.as_bytes(), name, "auto", &options)?.remove(0)
}

/// Lanes lie within the circle, links name lanes whose ends meet, and no lane is led to from one side alone.
fn is_consistent(scene: &Scene, middle: (f64, f64), radius_m: f64) {
    let ids: HashSet<&str> = scene.map.lanes.iter().map(|lane| lane.id.as_str()).collect();
    for lane in &scene.map.lanes {
        for p in &lane.points.xy {
            let away = (p.x + scene.meta.origin.x_m - middle.0).hypot(p.y + scene.meta.origin.y_m - middle.1);
            assert!(away < radius_m + 1e-6, "lane {}: {away}", lane.id);
        }
        for next in &lane.successors {
            let other = scene.map.lanes.iter().find(|other| other.id == *next).unwrap();
            assert!(other.predecessors.contains(&lane.id), "{} to {next}", lane.id);
            assert!((other.points.xy[0] - lane.points.xy.last().unwrap()).norm() < 1.0);
        }
        assert!(lane.predecessors.iter().all(|id| ids.contains(id.as_str())), "lane {}", lane.id);
    }
}

/// A row of streets of 100 m, each of which leads to the next, `count` rows of 50.
fn net(rows: usize) -> String {
    let mut text = String::from("<net>");
    let mut links = String::new();
    for row in 0..rows {
        for i in 0..50 {
            let (x, y) = (i * 100, row * 20);
            let _ = write!(
                text,
                r#"<edge id="{row}-{i}" from="{row}n{i}" to="{row}n{}"><lane id="{row}-{i}_0" index="0" speed="13.9" length="100" width="3.2" shape="{x},{y} {},{y}"/></edge>"#,
                i + 1,
                x + 100
            );
            if i > 0 {
                let _ = write!(
                    links,
                    r#"<connection from="{row}-{}" to="{row}-{i}" fromLane="0" toLane="0"/>"#,
                    i - 1
                );
            }
        }
    }
    text + &links + "</net>"
}

#[test]
fn a_network_that_is_too_large_is_read_in_part() {
    let text = net(140);
    let refused = read(&text, "city.net.xml", None).unwrap_err();
    assert_eq!(refused.code(), "map-too-large");
    assert!(refused.problems[0].detail.contains("--around X,Y,RADIUS"), "{refused}");
    let (scene, warnings) = read(&text, "city.net.xml", Some("2530,1010,120")).unwrap();
    is_consistent(&scene, (2530.0, 1010.0), 120.0);
    // Rows at 900 to 1120 m.
    let ended = scene.map.lanes.iter().filter(|lane| lane.predecessors.is_empty()).count();
    assert_eq!((scene.map.lanes.len(), ended), (34, 12));
    let said = warnings.iter().find(|warning| warning.code == "cut-around").unwrap();
    assert_eq!(
        said.detail,
        "within 120 m of 2530, 1010: lanes kept 34, of these ending at the circle 24; lanes outside 6966"
    );
    let again = read(&text, "city.net.xml", Some("2530,1010,120")).unwrap().0;
    assert_eq!(scene, again);
    let elsewhere = read(&text, "city.net.xml", Some("-9000,0,100")).unwrap_err().to_string();
    assert!(elsewhere.contains("the file has x 0 to 5000 and y 0 to 2780"), "{elsewhere}");
}

fn roads(count: usize) -> String {
    let mut text = String::from("<OpenDRIVE><header revMajor=\"1\" revMinor=\"6\"/>");
    let lane = r#"<lane id="-1" type="driving"><link><predecessor id="-1"/><successor id="-1"/></link><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>"#;
    for i in 0..count {
        let x = i * 400;
        let link = |name: &str, road: usize, end: &str| {
            format!(r#"<{name} elementType="road" elementId="{road}" contactPoint="{end}"/>"#)
        };
        let before = i.checked_sub(1).map_or_else(String::new, |road| link("predecessor", road, "end"));
        let after = if i + 1 < count { link("successor", i + 1, "start") } else { String::new() };
        let _ = write!(
            text,
            r#"<road id="{i}" length="400" junction="-1"><link>{before}{after}</link><planView><geometry s="0" x="{x}" y="5" hdg="0" length="400"><line/></geometry></planView><lanes><laneSection s="0"><center><lane id="0" type="none"/></center><right>{lane}</right></laneSection></lanes></road>"#,
        );
    }
    text + "</OpenDRIVE>"
}

#[test]
fn roads_of_opendrive_are_read_in_part() {
    let text = roads(80);
    let refused = read(&text, "long.xodr", None).unwrap_err();
    assert!(
        refused.code() == "map-too-large" && refused.problems[0].detail.contains("--around"),
        "{refused}"
    );
    let (scene, warnings) = read(&text, "long.xodr", Some("20100,0,500")).unwrap();
    is_consistent(&scene, (20_100.0, 0.0), 500.0);
    // From 19 600 to 20 600 m: the end of one road, two whole ones and the beginning of another.
    let lengths: Vec<f64> =
        scene.map.lanes.iter().map(|lane| formats::polyline::length(&lane.points.xy).round()).collect();
    assert_eq!(lengths, [400.0, 400.0, 200.0]);
    let codes: Vec<&str> = warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(codes, ["cut-around"]);
    assert!(warnings[0].detail.ends_with("lanes outside 77"), "{}", warnings[0].detail);
    assert!(scene.map.drivable.iter().all(|area| area.polygon.xy.iter().all(|p| p.norm() < 501.0)));
    let elsewhere = read(&text, "long.xodr", Some("0,900,100")).unwrap_err().to_string();
    assert!(elsewhere.contains("the file has x 0 to 31600 and y 5 to 5"), "{elsewhere}");
}

/// Lanelets of 50 m in a row, with their places in metres or in degrees.
fn lanelets(count: usize, local: bool) -> String {
    let mut text = String::from("<osm>");
    for i in 0..=count {
        for side in 0..2 {
            let (id, x, y) = (10 * i + side + 1, 50 * i, 4 * side);
            let lon = 11.0 + x as f64 / (111_320.0 * 48.0_f64.to_radians().cos());
            let lat = 48.0 + y as f64 / 111_320.0;
            let _ = write!(text, r#"<node id="{id}" lat="{lat}" lon="{lon}">"#);
            if local {
                let _ = write!(text, r#"<tag k="local_x" v="{x}"/><tag k="local_y" v="{y}"/>"#);
            }
            text.push_str("</node>");
        }
    }
    let mut relations = String::new();
    for i in 0..count {
        for side in 0..2 {
            let (way, from, to) = (10 * i + side + 100_001, 10 * i + side + 1, 10 * (i + 1) + side + 1);
            let _ = write!(text, r#"<way id="{way}"><nd ref="{from}"/><nd ref="{to}"/></way>"#);
        }
        let (right, left) = (10 * i + 100_001, 10 * i + 100_002);
        let _ = write!(
            relations,
            r#"<relation id="{}"><member type="way" role="left" ref="{left}"/><member type="way" role="right" ref="{right}"/><tag k="type" v="lanelet"/><tag k="subtype" v="road"/></relation>"#,
            200_000 + i
        );
    }
    text + &relations + "</osm>"
}

#[test]
fn lanelets_are_read_in_part_by_metres_and_by_degrees() {
    let (scene, warnings) = read(&lanelets(600, true), "a.osm", Some("10025,2,100")).unwrap();
    is_consistent(&scene, (10_025.0, 2.0), 100.0);
    assert_eq!(scene.map.lanes.len(), 5);
    assert!(warnings.iter().any(|w| w.detail.ends_with("lanes outside 595")), "{warnings:?}");
    let degrees = 11.0 + 10_025.0 / (111_320.0 * 48.0_f64.to_radians().cos());
    let (scene, warnings) =
        read(&lanelets(600, false), "a.osm", Some(&format!("{degrees},48.00002,100"))).unwrap();
    let reach = scene.map.lanes.iter().flat_map(|lane| &lane.points.xy).map(|p| p.norm()).fold(0.0, f64::max);
    assert!((4..=5).contains(&scene.map.lanes.len()) && (90.0..=101.0).contains(&reach), "{reach}");
    assert!(warnings.iter().any(|w| w.code == "cut-around"));
    let elsewhere = read(&lanelets(9, true), "a.osm", Some("9000,0,100")).unwrap_err().to_string();
    assert!(elsewhere.contains("the file has x 0 to 450"), "{elsewhere}");
}
