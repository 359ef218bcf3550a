//! SUMO's networks and recordings as scenes: values by hand, and files that break promises.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::{ImportOptions, registry};
use formats::{Imported, ReadError};
use scene::map::LaneType;
use scene::{AgentType, Scene, SignalState};
use std::io::Write;
use std::sync::Arc;
use std::time::{Duration, Instant};

const NET: &str = include_str!("fixtures/street.net.xml");
const FCD: &str = include_str!("fixtures/street.fcd.xml");
const CSV: &str = include_str!("fixtures/street.fcd.csv");

fn gzip(data: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(data).unwrap();
    encoder.finish().unwrap()
}

fn with_net() -> ImportOptions {
    ImportOptions { net: Some(Arc::new(NET.as_bytes().to_vec())), ..ImportOptions::default() }
}

fn import(bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>> {
    registry::import(bytes, "upload", "auto", options).unwrap()
}

fn scenes(bytes: &[u8], options: &ImportOptions) -> Vec<Imported> {
    import(bytes, options).into_iter().map(Result::unwrap).collect()
}

fn codes(imported: &Imported) -> Vec<&str> {
    imported.1.iter().map(|w| w.code).collect()
}

#[test]
fn a_network_becomes_a_scene_without_road_users() {
    let imported = scenes(NET.as_bytes(), &ImportOptions::default()).remove(0);
    assert_eq!(codes(&imported), ["ids-renumbered", "lanes-dropped"]);
    let scene = &imported.0;
    assert_eq!((scene.meta.origin.x_m, scene.meta.origin.y_m), (1055.0, 2000.0));
    assert_eq!((scene.agents.len(), scene.time.steps, scene.meta.source.as_str()), (0, 91, "sumo"));
    let types: Vec<LaneType> = scene.map.lanes.iter().map(|l| l.lane_type).collect();
    use LaneType::{Sidewalk, SurfaceStreet};
    assert_eq!(types, [SurfaceStreet, Sidewalk, SurfaceStreet, SurfaceStreet, SurfaceStreet]);
    let (inner, incoming) = (&scene.map.lanes[0], &scene.map.lanes[2]);
    assert!(inner.interpolating && incoming.successors == [inner.id.clone()]);
    assert_eq!((incoming.points.xy[0].x, incoming.points.xy[0].y), (-55.0, -1.5));
    assert_eq!(incoming.speed_limit_mps, Some(13.9));
    assert_eq!(scene.map.crosswalks.len(), 1);
    assert!(!scene.map.road_edges.is_empty() && !scene.map.drivable.is_empty());
    use SignalState::{Caution, Go, Stop};
    let runs: Vec<_> = scene.signals.iter().map(|s| s.runs.clone()).collect();
    assert_eq!(runs, [vec![(0, Go), (50, Caution), (70, Stop)], vec![(0, Stop), (70, Go)]]);
    assert_eq!(scene.signals[0].lane, inner.id);
    let packed = scenes(&gzip(NET.as_bytes()), &ImportOptions::default()).remove(0);
    assert_eq!(&packed.0, scene);
    let licensed = ImportOptions { licence: Some("cc0".into()), ..ImportOptions::default() };
    assert_eq!(scenes(NET.as_bytes(), &licensed)[0].0.meta.licence.as_deref(), Some("cc0"));
}

/// Position and velocity of a road user at a step.
fn at(scene: &Scene, id: &str, step: usize) -> Option<[f64; 4]> {
    let state = scene.agent(id).unwrap().track.at(step)?;
    Some([state.x_m, state.y_m, state.vx_mps, state.vy_mps])
}

fn near(found: Option<[f64; 4]>, expected: [f64; 4]) {
    let found = found.unwrap();
    let same = found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-6);
    assert!(same, "{found:?} found, {expected:?} expected");
}

#[test]
fn a_recording_becomes_windows_on_its_network() {
    let wide = format!("\u{feff}{FCD}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in
        [FCD.as_bytes().to_vec(), CSV.as_bytes().to_vec(), gzip(FCD.as_bytes()), gzip(CSV.as_bytes()), wide]
    {
        let list = scenes(&bytes, &with_net());
        assert_eq!(list.len(), 2);
        let (first, second) = (&list[0].0, &list[1].0);
        assert_eq!((first.time.steps, second.time.steps), (91, 30));
        assert_eq!(codes(&list[0]), ["ids-renumbered", "lanes-dropped", "sizes-assumed", "ids-changed"]);
        assert_eq!(first.map, second.map);
        // The front bumper of a car of 5 m that drives east is 2.5 m ahead of its centre.
        near(at(first, "f_1.0", 0), [1010.0 - 2.5 - 1055.0, -1.5, 8.0, 0.0]);
        near(at(first, "f_1.0", 13), [1010.0 + 8.0 * 1.3 - 2.5 - 1055.0, -1.5, 8.0, 0.0]);
        near(at(second, "f_1.0", 0), [1010.0 + 8.0 * 9.1 - 2.5 - 1055.0, -1.5, 8.0, 0.0]);
        // A bicycle of 1.6 m that rides west, away from 4.0 to 6.0 s.
        near(at(first, "k.0", 20), [1040.0 - 8.0 + 0.8 - 1055.0, 1.5, -4.0, 0.0]);
        assert!(at(first, "k.0", 35).is_some() && at(first, "k.0", 65).is_some());
        assert!((36..65).all(|step| at(first, "k.0", step).is_none()));
        // A person's point is the centre.
        assert!(at(first, "p.0", 9).is_none());
        near(at(first, "p.0", 10), [1002.0 + 1.2 - 1055.0, -4.0, 1.2, 0.0]);
        let types = ["f_1.0", "k.0", "p.0"].map(|id| first.agent(id).unwrap().agent_type);
        assert_eq!(types, [AgentType::Vehicle, AgentType::Cyclist, AgentType::Pedestrian]);
        // The signal goes on with the time of the recording.
        assert_eq!(first.signals[0].runs.len(), 3);
        assert_eq!(second.signals[0].runs, [(0, SignalState::Stop)]);
        let times = second.meta.timestamps_s.as_ref().unwrap();
        assert!(first.meta.timestamps_s.is_none() && (times[0] - 9.1).abs() < 1e-9);
    }
}

#[test]
fn windows_can_be_chosen_and_need_no_network() {
    let options = ImportOptions { skip: 1, max_scenes: 1, ..ImportOptions::default() };
    let list = scenes(FCD.as_bytes(), &options);
    assert_eq!((list.len(), list[0].0.name.as_str()), (1, "FCD 9.1 s"));
    assert!(list[0].0.map.lanes.is_empty() && codes(&list[0]).contains(&"no-network"));
    let options = ImportOptions { skip: 2, ..ImportOptions::default() };
    assert!(import(FCD.as_bytes(), &options).is_empty());
}

fn steps(rows: &[(f64, f64)]) -> String {
    let mut text = "<fcd-export>".to_owned();
    for (t, x) in rows {
        text.push_str(&format!(
            "<timestep time=\"{t}\"><vehicle id=\"a\" x=\"{x}\" y=\"0\" angle=\"90\" speed=\"1\"/></timestep>"
        ));
    }
    text + "</fcd-export>"
}

#[test]
fn long_pauses_are_passed_over() {
    let rows = [(0.0, 0.0), (1.0, 1.0), (9.0, 9.0), (10.0, 10.0), (1e8, 5.0), (1e8 + 1.0, 6.0), (9e8, 0.0)];
    let start = Instant::now();
    let list = scenes(steps(&rows).as_bytes(), &ImportOptions::default());
    assert!(start.elapsed() < Duration::from_secs(1));
    let seen: Vec<usize> = list.iter().map(|s| s.0.agents[0].track.valid_steps().count()).collect();
    // 0 to 1 s and 9 s; 9.1 to 10 s; then the second at 1e8 s, however the windows cut it, and 9e8 s.
    assert_eq!(seen[..2], [12, 10]);
    assert_eq!(seen[2..].iter().sum::<usize>(), 11 + 1, "{seen:?}");
}

/// Name, file, network, code, part of the detail.
type Case = (&'static str, Vec<u8>, Option<Vec<u8>>, &'static str, &'static str);

fn bad_files() -> Vec<Case> {
    let net = |name, from: &str, to: &str, code, detail| -> Case {
        assert!(NET.contains(from), "{name}");
        (name, NET.replacen(from, to, 1).into(), None, code, detail)
    };
    let fcd = |name, from: &str, to: &str, code, detail| -> Case {
        assert!(FCD.contains(from), "{name}");
        (name, FCD.replacen(from, to, 1).into(), None, code, detail)
    };
    let csv = |name, from: &str, to: &str, code, detail| -> Case {
        assert!(CSV.contains(from), "{name}");
        (name, CSV.replacen(from, to, 1).into(), None, code, detail)
    };
    let (file, field, no) = ("malformed-file", "invalid-field", "cannot-represent");
    let laughs = "<!DOCTYPE net [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;\">]><net>&b;</net>";
    let many_lanes: String = (0..30_000)
        .map(|i| format!("<edge id='{i}'><lane id='{i}' speed='1' shape='0,0 1,0'/></edge>"))
        .collect();
    let zigzag = "0,0 9000,0 ".repeat(2_000);
    let long_lanes: String = (0..40)
        .map(|i| format!("<edge id='{i}'><lane id='{i}' speed='1' shape='{zigzag}'/></edge>"))
        .collect();
    let attributes: String = (0..200).map(|i| format!(" a{i}='1'")).collect();
    vec![
        net("number that is none", "width=\"3\"", "width=\"wide\"", field, "line 6: \"wide\" found"),
        net("width NaN", "width=\"3\"", "width=\"NaN\"", field, "\"NaN\" found, a number"),
        net("width 1e300", "width=\"3\"", "width=\"1e300\"", "out-of-range", "lane \":c_0_0\", width"),
        net("speed 1e9", "speed=\"6.5\"", "speed=\"1e9\"", "out-of-range", "lane \":c_0_0\", speed"),
        net("coordinate 1e300", "1050,1998.5", "1e300,1998.5", "out-of-range", "coordinate in metres"),
        net("lane to the far end", "1060,1998.5", "90000,1998.5", "map-too-large", "from its middle"),
        net("no id", "id=\":c_0_0\" ", "", field, "<lane> has no attribute \"id\""),
        net("negative phase", "duration=\"5\"", "duration=\"-5\"", field, "a duration in seconds"),
        net("wrong end", "</edge>", "</lane>", file, "line 7: </lane> found, </edge> expected"),
        ("net cut off", NET[..900].into(), None, file, "the file ends inside a tag"),
        ("billion laughs", laughs.into(), None, file, "line 1: a document type definition"),
        ("deep nesting", format!("<net>{}", "<a>".repeat(100_000)).into(), None, file, "deeper than 32"),
        ("many attributes", format!("<net{attributes}/>").into(), None, file, "more than 128 attributes"),
        ("no lanes", b"<net/>".into(), None, no, "has no lane"),
        ("30,000 lanes", format!("<net>{many_lanes}</net>").into(), None, "map-too-large", "--around"),
        ("lanes to the moon", format!("<net>{long_lanes}</net>").into(), None, "map-too-large", "points"),
        (
            "gzip bomb",
            gzip(format!("<net>{}", " ".repeat(20 << 20)).as_bytes()),
            None,
            "expansion-too-high",
            "",
        ),
        ("gzip cut off", gzip(NET.as_bytes())[..400].into(), None, file, "cannot decompress"),
        fcd("angle NaN", "angle=\"90.00\"", "angle=\"NaN\"", field, "line 5: \"NaN\" found, an angle"),
        fcd("x infinite", "x=\"1010.00\"", "x=\"inf\"", field, "line 5: \"inf\" found, a coordinate"),
        fcd("no speed", "speed=\"8.00\" ", "", field, "line 5: <vehicle> has no attribute \"speed\""),
        fcd("time goes back", "time=\"0.50\"", "time=\"0.00\"", field, "after that of the time step before"),
        fcd("time 1e99", "time=\"0.50\"", "time=\"1e99\"", field, "a time in seconds"),
        fcd("id empty", "id=\"f#1.0\"", "id=\"\"", field, "an id of 1 to 256 bytes"),
        fcd("unknown entity", "id=\"f#1.0\"", "id=\"&a;\"", file, "line 5: \"&a\" found, a known reference"),
        ("fcd of nobody", b"<fcd-export/>".into(), None, no, "has no road user"),
        ("network of another sort", FCD.into(), Some(b"<routes/>".into()), no, "a SUMO network"),
        csv("csv without speed", "vehicle_speed", "speed", no, "columns timestep_time"),
        csv("csv angle", ";90.00;", ";east;", field, "line 2: \"east\" found, an angle"),
        (
            "csv line without end",
            format!("{}\n{}", CSV.lines().next().unwrap(), "1".repeat(1 << 20)).into(),
            None,
            file,
            "line 2: more than 65536 bytes in a line",
        ),
    ]
}

#[test]
fn bad_files_are_refused_precisely() {
    let mut wrong = Vec::new();
    for (name, bytes, net, code, detail) in bad_files() {
        let start = Instant::now();
        let net = net.map(|net| Arc::new(net) as Arc<dyn formats::Source>);
        let options = ImportOptions { net, ..ImportOptions::default() };
        let format = registry::sniff(&bytes, "upload").map_or("sumo-net", |f| f.info().id);
        let results = registry::import(&bytes, "upload", format, &options).unwrap();
        let took = start.elapsed();
        let Some(error) = results.iter().find_map(|r| r.as_ref().err()) else {
            wrong.push(format!("{name}: read without a fault"));
            continue;
        };
        println!("{name:26} {error}");
        if error.code() != code || !error.problems[0].detail.contains(detail) {
            wrong.push(format!("{name}: expected {code} with \"{detail}\", got {error}"));
        }
        assert!(took < Duration::from_secs(3), "{name} took {took:?}");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_recording_that_breaks_off_keeps_what_was_whole() {
    let results = import(&FCD.as_bytes()[..FCD.len() - 200], &ImportOptions::default());
    assert_eq!(results.iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn of_many_road_users_the_nearest_are_kept() {
    let mut text = "<fcd-export>".to_owned();
    for t in 0..2 {
        text.push_str(&format!("<timestep time=\"{t}\">"));
        for i in 0..400 {
            let x = i * i;
            text.push_str(&format!("<vehicle id=\"{i}\" x=\"{x}\" y=\"0\" angle=\"0\" speed=\"0\"/>"));
        }
        text.push_str("</timestep>");
    }
    text.push_str("</fcd-export>");
    let imported = scenes(text.as_bytes(), &ImportOptions::default()).remove(0);
    assert!(codes(&imported).contains(&"agents-dropped"));
    assert!(imported.0.agents.len() <= 256 && imported.0.agent("200").is_some());
    assert!(imported.0.agent("399").is_none());
}

#[test]
fn a_network_where_everything_overlaps_takes_bounded_time() {
    let edge = |i: usize| {
        let shape: String = (0..400).map(|k| format!("{},{} ", k as f64 * 2.0, (k + i) % 2)).collect();
        format!("<edge id='{i}' from='{i}' to='x{i}'><lane id='{i}_0' speed='9' shape='{shape}'/></edge>")
    };
    let text: String = (0..300).map(edge).collect();
    let start = Instant::now();
    let results = import(format!("<net>{text}</net>").as_bytes(), &ImportOptions::default());
    println!("{:?} {}", start.elapsed(), results[0].is_ok());
    assert!(start.elapsed() < Duration::from_secs(60));
}
