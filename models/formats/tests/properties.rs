//! Properties over generated scenes and mutated files.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

mod generated;

use formats::ExportedMotion;
use formats::native::{self, ConditionsDoc};
use formats::womd::{self, Options};
use generated::scene;
use proptest::prelude::*;
use scene::{Conditions, Scene, Vec2};

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

/// Plane positions within a few units in the last place of their source coordinates.
fn close(a: Vec2, b: Vec2) -> bool {
    (a - b).norm() < 1e-9
}

/// Moves positions that differ by rounding alone onto those of `model`.
fn snap(mut scene: Scene, model: &Scene) -> Scene {
    let fix = |p: &mut Vec2, q: &Vec2| {
        if close(*p, *q) {
            *p = *q;
        }
    };
    let mut map = (*scene.map).clone();
    let own = (map.lanes.iter_mut().map(|l| &mut l.points))
        .chain(map.road_lines.iter_mut().map(|l| &mut l.points))
        .chain(map.road_edges.iter_mut().map(|l| &mut l.points))
        .chain(map.crosswalks.iter_mut().map(|l| &mut l.polygon))
        .chain(map.speed_bumps.iter_mut().map(|l| &mut l.polygon))
        .chain(map.driveways.iter_mut().map(|l| &mut l.polygon));
    let wanted = (model.map.lanes.iter().map(|l| &l.points))
        .chain(model.map.road_lines.iter().map(|l| &l.points))
        .chain(model.map.road_edges.iter().map(|l| &l.points))
        .chain(model.map.crosswalks.iter().map(|l| &l.polygon))
        .chain(model.map.speed_bumps.iter().map(|l| &l.polygon))
        .chain(model.map.driveways.iter().map(|l| &l.polygon));
    for (own, wanted) in own.zip(wanted) {
        own.xy.iter_mut().zip(&wanted.xy).for_each(|(p, q)| fix(p, q));
    }
    map.stop_signs.iter_mut().zip(&model.map.stop_signs).for_each(|(s, m)| fix(&mut s.position, &m.position));
    scene.map = map.into();
    for (signal, wanted) in scene.signals.iter_mut().zip(&model.signals) {
        if let (Some(p), Some(q)) = (&mut signal.stop, &wanted.stop) {
            fix(p, q);
        }
    }
    for (agent, wanted) in scene.agents.iter_mut().zip(&model.agents) {
        for (state, wanted) in agent.track.states.iter_mut().zip(&wanted.track.states) {
            if let (Some(s), Some(w)) = (state, wanted)
                && close(s.position(), w.position())
            {
                (s.x_m, s.y_m) = (w.x_m, w.y_m);
            }
        }
    }
    scene
}

fn mutated(bytes: &[u8], edits: &[(usize, u8, u8)]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (at, value, kind) in edits {
        if bytes.is_empty() {
            break;
        }
        let at = at % bytes.len();
        match kind % 4 {
            0 => bytes[at] = *value,
            1 => bytes[at] ^= 1 << (value % 8),
            2 => bytes.insert(at, *value),
            _ => {
                let end = (at + usize::from(*value)).min(bytes.len());
                bytes.drain(at..end);
            }
        }
    }
    bytes
}

fn record_file() -> Vec<u8> {
    let scene = native::read(JUNCTION).unwrap();
    let mut file = Vec::new();
    womd::write(&[&scene], &mut file, false, ExportedMotion::Chosen).unwrap();
    file
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn native_round_trip_is_equal(scene in scene()) {
        let scene = scene.checked().unwrap();
        let again = native::read(&native::write(&scene)).unwrap();
        prop_assert_eq!(scene, again);
    }

    #[test]
    fn womd_round_trip_loses_only_what_it_says(scene in scene(), gzip in any::<bool>()) {
        let scene = scene.checked().unwrap();
        let mut file = Vec::new();
        let losses = womd::write(&[&scene], &mut file, gzip, ExportedMotion::Log).unwrap();
        let codes: Vec<_> = losses.iter().map(|l| l.code).collect();
        let (first, _) = womd::read_all(&file, &Options::default()).remove(0).unwrap();
        let mut expected = scene.clone();
        if codes.contains(&"no-conditions") {
            expected.agents.iter_mut().for_each(|a| a.conditions = Conditions::default());
        }
        let rest: Vec<_> = codes.into_iter().filter(|c| *c != "no-conditions").collect();
        prop_assert_eq!(rest, ["no-licence"]);
        prop_assert_eq!(snap(first.clone(), &expected), expected);
        // What came from a file goes back into one bit for bit.
        let mut file = Vec::new();
        womd::write(&[&first], &mut file, gzip, ExportedMotion::Log).unwrap();
        let (second, _) = womd::read_all(&file, &Options::default()).remove(0).unwrap();
        prop_assert_eq!(first, second);
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = native::read(&bytes);
        let _ = native::from_json::<ConditionsDoc>(&bytes);
        let _ = formats::registry::import(&bytes, "x.json", "auto", &Default::default());
        let unchecked = Options { verify_crc: false, ..Options::default() };
        let _ = womd::read_all(&bytes, &unchecked);
        let mut framed = Vec::new();
        womd::write_record(&mut framed, &bytes).unwrap();
        prop_assert!(womd::read_all(&framed, &Options::default()).iter().all(Result::is_err));
    }

    #[test]
    fn mutated_documents_never_panic(
        edits in proptest::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 1..6),
        token in prop_oneof![Just("null"), Just("-1"), Just("1e308"), Just("[]"), Just("{}"), Just("\"a\"")],
        nth in 0..400usize,
    ) {
        let _ = native::read(&mutated(JUNCTION, &edits));
        // Another value in place of the n-th number: still JSON, mostly not a scene.
        let text = std::str::from_utf8(JUNCTION).unwrap();
        let numbers: Vec<_> = text.match_indices(|c: char| c.is_ascii_digit()).collect();
        let at = numbers[nth % numbers.len()].0;
        let changed = format!("{}{token}{}", &text[..at], &text[at + 1..]);
        if let Err(error) = native::read(changed.as_bytes()) {
            prop_assert!(!error.problems.is_empty());
        }
    }

    #[test]
    fn mutated_sumo_files_never_panic(
        edits in proptest::collection::vec((any::<usize>(), any::<u8>(), any::<u8>()), 1..6),
    ) {
        let net = mutated(include_bytes!("fixtures/street.net.xml"), &edits);
        formats::checks::sumo("sumo-net", &net);
        formats::checks::sumo("sumo-fcd", &mutated(include_bytes!("fixtures/street.fcd.xml"), &edits));
        formats::checks::sumo("sumo-fcd", &mutated(include_bytes!("fixtures/street.fcd.csv"), &edits));
    }

    #[test]
    fn mutated_records_never_panic(
        edits in proptest::collection::vec((12..usize::MAX, any::<u8>(), any::<u8>()), 1..6),
    ) {
        let options = Options { verify_crc: false, ..Options::default() };
        for (scene, _) in womd::read_all(&mutated(&record_file(), &edits), &options).into_iter().flatten() {
            let mut file = Vec::new();
            womd::write(&[&scene], &mut file, false, ExportedMotion::Log).unwrap();
            let (again, _) = womd::read_all(&file, &Options::default()).remove(0).unwrap();
            prop_assert_eq!(scene.agents.len(), again.agents.len());
        }
    }
}
