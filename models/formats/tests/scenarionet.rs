//! Pickles of ScenarioNet as scenes: files that Python wrote, and files that would be programs.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ImportOptions, Imported, ReadError, registry};
use scene::map::LaneType;
use scene::{AgentType, SignalState, Vec2};

/// Written by Python 3.11 with NumPy 1.26 out of one drawn scenario.
const BY_PYTHON: [(&str, &[u8]); 6] = [
    ("protocol 0", include_bytes!("../../../fuzz/corpus/scenarionet/protocol-0.pkl")),
    ("protocol 2", include_bytes!("../../../fuzz/corpus/scenarionet/protocol-2.pkl")),
    ("protocol 4", include_bytes!("../../../fuzz/corpus/scenarionet/protocol-4.pkl")),
    ("protocol 5", include_bytes!("../../../fuzz/corpus/scenarionet/protocol-5.pkl")),
    ("names of NumPy 2", include_bytes!("../../../fuzz/corpus/scenarionet/numpy-2.pkl")),
    // A class, ordered dictionaries, columns first, big ends first, numbers of two bytes.
    ("classes", include_bytes!("../../../fuzz/corpus/scenarionet/classes.pkl")),
];
const SYSTEM: &[u8] = include_bytes!("../../../fuzz/corpus/scenarionet/system.pkl");
const SUMMARY: &[u8] = include_bytes!("../../../fuzz/corpus/scenarionet/summary.pkl");

fn import(bytes: &[u8]) -> Result<Imported, ReadError> {
    registry::by_id("scenarionet").unwrap().import(bytes, &ImportOptions::default()).remove(0)
}

#[test]
fn what_python_writes_is_read_in_every_protocol() {
    for (name, bytes) in BY_PYTHON {
        let (scene, warnings) = import(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        let codes: Vec<_> = warnings.iter().map(|w| w.code).collect();
        assert_eq!(codes, ["ids-changed", "features-dropped"], "{name}");
        assert_eq!((scene.name.as_str(), scene.time.steps, scene.time.now_step), ("drawn-1", 4, 1), "{name}");
        let origin = Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m);
        let ego = scene.agent("1").unwrap();
        // The ego is the origin at the present step: at 100.8 m after 0.1 s at 8 m/s.
        assert!((origin - Vec2::new(100.8, 50.0)).norm() < 1e-5, "{name}: {origin:?}");
        let state = ego.track.at(0).unwrap();
        assert!((state.position() - Vec2::new(-0.8, 0.0)).norm() < 1e-5 && state.vx_mps == 8.0, "{name}");
        assert_eq!((ego.role.as_deref(), ego.size.length_m), (Some("ego"), 4.5), "{name}");
        let walker = scene.agent("2").unwrap();
        assert_eq!(walker.agent_type, AgentType::Pedestrian, "{name}");
        assert_eq!(walker.track.valid_steps().collect::<Vec<_>>(), [1, 3], "{name}");
        assert_eq!(scene.agent("cone_3").unwrap().agent_type, AgentType::Other, "{name}");
        let lane = |id: &str| scene.map.lanes.iter().find(|lane| lane.id == id).unwrap();
        assert_eq!(
            (lane("10").width_m, lane("10").successors.as_slice()),
            (Some(3.5), &["11".to_owned()][..]),
            "{name}"
        );
        assert!(
            (lane("10").speed_limit_mps.unwrap() - 11.176).abs() < 1e-9 && lane("11").interpolating,
            "{name}"
        );
        assert_eq!(
            (lane("12").lane_type, lane("12").left_neighbors[0].lane.as_str()),
            (LaneType::BikeLane, "10")
        );
        assert_eq!(
            (lane("10").left_boundary[0].line.as_str(), lane("10").left_boundary[0].kind),
            ("20", Some(6))
        );
        let map = &scene.map;
        let counts = [map.road_lines.len(), map.road_edges.len(), map.crosswalks.len(), map.stop_signs.len()];
        assert_eq!((counts, map.stop_signs[0].lanes.as_slice()), ([1; 4], &["10".to_owned()][..]), "{name}");
        let signal = &scene.signals[0];
        let shown: Vec<_> = (0..4).map(|step| signal.at(step)).collect();
        use SignalState::{Go, Stop, Unknown};
        assert_eq!(
            (signal.lane.as_str(), shown.as_slice()),
            ("10", &[Stop, Stop, Go, Unknown][..]),
            "{name}"
        );
        assert_eq!(scene.meta.tracks_to_predict, [("2".to_owned(), 1)], "{name}");
    }
}

#[test]
fn a_pickle_that_would_be_a_program_is_refused_by_name() {
    let error = import(SYSTEM).unwrap_err();
    assert_eq!(error.code(), "pickle-refused");
    assert!(error.problems[0].detail.contains("asks for posix.system"), "{error}");
    let refused = |bytes: &[u8]| import(bytes).unwrap_err();
    for (bytes, said) in [
        (&b"\x80\x02cbuiltins\neval\n."[..], "builtins.eval"),
        (b"\x80\x04\x8c\x02os\x8c\x05popen\x93.", "os.popen"),
        (b"\x80\x02P1\n.", "outside of the file"),
        (b"\x80\x02(ios\nsystem\n.", "an object of a class"),
        (b"\x80\x02\x82\x01.", "a registry"),
        // A list is no name, whatever its arguments are.
        (b"\x80\x02])R.", "a call of something that is not a name"),
        (b"\x80\x02cnumpy\ndtype\n(X\x01\x00\x00\x00OtR.", "array(O)"),
    ] {
        let error = refused(bytes);
        assert_eq!(error.code(), "pickle-refused", "{error}");
        assert!(error.problems[0].detail.contains(said), "{error}");
    }
}

#[test]
fn another_sort_of_pickle_is_told() {
    assert!(import(SUMMARY).unwrap_err().to_string().contains("import the sd_*.pkl files"));
    assert!(import(b"\x80\x02].").unwrap_err().to_string().contains("of a ScenarioNet scenario expected"));
}

#[test]
fn broken_pickles_say_where() {
    for (bytes, at, said) in [
        (&b"\x80\x02"[..], 2, "the file ends"),
        (b"\x80\x09.", 0, "version 9"),
        (b"\x80\x02X\xff\xff\xff\xff", 2, "the file ends inside an instruction"),
        (b"\x80\x04\x8e\xff\xff\xff\xff\xff\xff\xff\xff", 2, "the file ends inside an instruction"),
        (b"\x80\x02t.", 2, "a mark on the stack"),
        (b"\x80\x02h\x05.", 2, "a memo entry"),
        (b"\x80\x02NNs.", 4, "a dictionary expected"),
        (b"\x80\x02}NNs", 6, "the file ends"),
        (b"\x80\x02Na.", 3, "a list expected"),
        (b"\x80\x02}(Nu.", 5, "a value for each key"),
        (b"\x80\x02r\xff\xff\xff\x7f", 2, "an item on the stack"),
        (b"\x80\x02\x8a\x09123456789.", 2, "at most eight bytes"),
        (b"\x80\x02\xff", 2, "a known instruction"),
    ] {
        let error = import(bytes).unwrap_err();
        assert!(error.to_string().contains(said), "{bytes:?}: {error}");
        assert_eq!(error.kind, formats::RefusalKind::MalformedFile { offset: at }, "{bytes:?}: {error}");
    }
    let deep = [&b"\x80\x02"[..], &b"(".repeat(100)].concat();
    assert!(import(&deep).unwrap_err().to_string().contains("nested deeper"));
}

#[test]
fn small_files_do_not_become_large() {
    // A list of lists for two bytes each, and one that holds itself.
    let many = [&b"\x80\x02]("[..], &b"]".repeat(2 << 20), b"e."].concat();
    assert_eq!(import(&many).unwrap_err().code(), "decoded-too-large");
    let nones = [&b"\x80\x02]("[..], &b"N".repeat(2 << 20), b"e."].concat();
    assert_eq!(import(&nones).unwrap_err().code(), "decoded-too-large");
    assert_eq!(import(b"\x80\x02]q\x00h\x00a.").unwrap_err().code(), "cannot-represent");
    // The same text as bytes, again and again.
    let text = [&b"X\x00\x10\x00\x00"[..], &b"a".repeat(4096)].concat();
    let again = b"c_codecs\nencode\n(h\x00X\x06\x00\x00\x00latin1tR0".repeat(100);
    let bytes = [&b"\x80\x02"[..], &text, b"q\x000", &again, b"N."].concat();
    assert!(import(&bytes).unwrap_err().to_string().contains("bytes"));
}

#[test]
fn damaged_pickles_never_panic() {
    for (name, bytes) in BY_PYTHON {
        for cut in (0..bytes.len()).step_by(7) {
            assert!(import(&bytes[..cut]).is_err(), "{name} cut at {cut}");
        }
        for at in 0..bytes.len() {
            let mut damaged = bytes.to_vec();
            damaged[at] ^= 1 << (at % 8);
            formats::checks::both_ways("scenarionet", &damaged);
        }
    }
}
