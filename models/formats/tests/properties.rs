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

/// Moves positions that differ only by rounding onto those of `model`.
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

/// Drops the steps at both ends of a track at which the road user was not seen.
fn trim(scene: &mut Scene) {
    for agent in &mut scene.agents {
        let track = &mut agent.track;
        let Some(first) = track.states.iter().position(Option::is_some) else { continue };
        track.first_step += first;
        track.states.drain(..first);
        while track.states.last().is_some_and(Option::is_none) {
            track.states.pop();
        }
    }
}

/// Moves numbers that differ by little onto those of `model`.
fn near_enough(mut scene: Scene, model: &Scene, most: f64) -> Scene {
    let fix = |own: &mut f64, wanted: f64| {
        if (*own - wanted).abs() <= most {
            *own = wanted;
        }
    };
    for (agent, wanted) in scene.agents.iter_mut().zip(&model.agents) {
        fix(&mut agent.size.length_m, wanted.size.length_m);
        fix(&mut agent.size.width_m, wanted.size.width_m);
        if let (Some(own), Some(wanted)) = (&mut agent.size.height_m, wanted.size.height_m) {
            fix(own, wanted);
        }
        let track = &mut agent.track;
        for (state, wanted) in track.states.iter_mut().zip(&wanted.track.states) {
            if let (Some(s), Some(w)) = (state, wanted) {
                let pairs = [(&mut s.x_m, w.x_m), (&mut s.y_m, w.y_m), (&mut s.heading_rad, w.heading_rad)];
                pairs.into_iter().for_each(|(own, wanted)| fix(own, wanted));
                fix(&mut s.vx_mps, w.vx_mps);
                fix(&mut s.vy_mps, w.vy_mps);
            }
        }
        if let (Some(own), Some(wanted)) = (&mut track.z_m, &wanted.track.z_m) {
            own.iter_mut().zip(wanted).for_each(|(own, wanted)| fix(own, *wanted));
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
        // An imported scene exports to a file bit for bit.
        let mut file = Vec::new();
        womd::write(&[&first], &mut file, gzip, ExportedMotion::Log).unwrap();
        let (second, _) = womd::read_all(&file, &Options::default()).remove(0).unwrap();
        prop_assert_eq!(first, second);
    }

    #[test]
    fn tables_lose_only_what_they_say(scene in scene(), parquet in any::<bool>(), gzip in any::<bool>()) {
        let scene = scene.checked().unwrap();
        let format = formats::registry::by_id(if parquet { "parquet" } else { "csv" }).unwrap();
        let options = formats::ExportOptions { motion: ExportedMotion::Log, gzip, ..Default::default() };
        let file = format.export(&[&scene], &options).unwrap();
        let codes: Vec<_> = file.losses.iter().map(|l| l.code).collect();
        let (first, warnings) = format.import(&file.bytes, &Default::default()).remove(0).unwrap();
        let mut expected = scene.clone();
        expected.map = Default::default();
        expected.signals.clear();
        expected.agents.iter_mut().for_each(|a| a.conditions = Conditions::default());
        // The two differ only in notes.
        (expected.meta.objects_of_interest, expected.meta.tracks_to_predict) = Default::default();
        let noted = ["no-conditions", "no-map", "no-notes", "no-signals"];
        let all = ["no-conditions", "no-licence", "no-map", "no-notes", "no-roles", "no-signals", "no-timing"];
        let possible = if parquet { &noted[..] } else { &all[..] };
        prop_assert!(codes.iter().all(|code| possible.contains(code)), "{:?}", codes);
        prop_assert!(codes.contains(&"no-map"));
        prop_assert!(warnings.is_empty(), "{:?}", warnings);
        if !parquet {
            expected.agents[0].role = None;
            expected.meta = first.meta.clone();
            expected.time = first.time;
        }
        // Without notes the frame is the table's: places are compared in that of the source.
        let (own, its) = (scene.meta.origin.clone(), first.meta.origin.clone());
        let shift = Vec2::new(own.x_m - its.x_m, own.y_m - its.y_m);
        for agent in &mut expected.agents {
            for state in agent.track.states.iter_mut().flatten() {
                (state.x_m, state.y_m) = (state.x_m + shift.x, state.y_m + shift.y);
            }
        }
        // CSV has millionths.
        let most = if parquet { 1e-9 } else { 2e-6 };
        let fixed = near_enough(first.clone(), &expected, most);
        prop_assert_eq!(fixed, expected);
        // An imported scene exports to a file bit for bit.
        let again = format.export(&[&first], &options).unwrap();
        let (second, _) = format.import(&again.bytes, &Default::default()).remove(0).unwrap();
        prop_assert_eq!(near_enough(second, &first, 1e-9), first);
    }

    #[test]
    fn argoverse_loses_only_what_it_says(scene in scene()) {
        let scene = scene.checked().unwrap();
        let format = formats::registry::by_id("av2").unwrap();
        let options = formats::ExportOptions { motion: ExportedMotion::Log, ..Default::default() };
        let file = format.export(&[&scene], &options).unwrap();
        let (first, warnings) = format.import(&file.bytes, &Default::default()).remove(0).unwrap();
        prop_assert_eq!(warnings.iter().map(|w| w.code).collect::<Vec<_>>(), ["no-map", "sizes-assumed"]);
        let seen = |agent: &&scene::Agent| agent.track.valid_steps().next().is_some();
        let mut expected: Vec<scene::Agent> = scene.agents.iter().filter(seen).cloned().collect();
        let unseen = file.losses.iter().any(|loss| loss.code == "no-unseen");
        prop_assert_eq!(unseen, expected.len() < scene.agents.len());
        prop_assert_eq!(first.time, scene.time);
        prop_assert_eq!(first.meta.licence.as_deref(), scene.meta.licence.as_deref());
        let (own, its) = (&scene.meta.origin, &first.meta.origin);
        for agent in &mut expected {
            agent.conditions = Conditions::default();
            agent.size = scene::Size::default_for(agent.agent_type, agent.subtype);
            if agent.role.is_some() {
                agent.id = "AV".into();
            }
            let track = &mut agent.track;
            track.z_m = None;
            for state in track.states.iter_mut().flatten() {
                (state.x_m, state.y_m) = (state.x_m + own.x_m - its.x_m, state.y_m + own.y_m - its.y_m);
            }
        }
        let mut expected = Scene { agents: expected, ..first.clone() };
        trim(&mut expected);
        prop_assert_eq!(near_enough(first.clone(), &expected, 1e-9), expected);
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
