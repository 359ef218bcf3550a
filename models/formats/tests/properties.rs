//! Properties over generated scenes and mutated files.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test stops at the first surprise"
)]

use formats::ExportedMotion;
use formats::native::{self, ConditionsDoc};
use formats::womd::{self, Options};
use proptest::prelude::*;
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, Points, StopSign, TypedLine};
use scene::{
    Agent, AgentType, Conditions, Goal, LaneMap, Meta, Origin, Scene, Signal, SignalState, Size, State,
    Subtype, Timing, Track, Vec2,
};
use std::collections::BTreeMap;

const JUNCTION: &[u8] = include_bytes!("fixtures/junction.scene.json");

/// A number that f32 holds too.
fn single(low: f32, high: f32) -> impl Strategy<Value = f64> {
    (low..high).prop_map(f64::from)
}

fn state() -> impl Strategy<Value = State> {
    let plane = (-9e3..9e3f64, -9e3..9e3f64, single(-3.1, 3.1), single(-40.0, 40.0), single(-40.0, 40.0));
    plane.prop_map(|(x_m, y_m, heading_rad, vx_mps, vy_mps)| State { x_m, y_m, heading_rad, vx_mps, vy_mps })
}

fn track(steps: usize) -> impl Strategy<Value = Track> {
    let slots = proptest::collection::vec((proptest::option::weighted(0.8, state()), -50.0..50.0f64), steps);
    (slots, any::<bool>()).prop_map(|(slots, with_z)| {
        let z = slots.iter().map(|(s, z)| if s.is_some() { *z } else { 0.0 }).collect();
        let states: Vec<_> = slots.into_iter().map(|slot| slot.0).collect();
        let z_m = (with_z && states.iter().any(Option::is_some)).then_some(z);
        Track { first_step: 0, states, z_m }
    })
}

fn agent(steps: usize) -> impl Strategy<Value = Agent> {
    let kind = prop_oneof![
        Just(AgentType::Vehicle),
        Just(AgentType::Pedestrian),
        Just(AgentType::Cyclist),
        Just(AgentType::Other)
    ];
    let goal = proptest::option::of((0.0..12.0f64, -3.0..3.0f64));
    (kind, track(steps), single(0.3, 12.0), single(0.3, 3.0), proptest::option::of(single(0.5, 4.0)), goal)
        .prop_map(|(agent_type, track, length_m, width_m, height_m, goal)| {
            let seen = track.states.iter().any(Option::is_some);
            let default = Size::default_for(agent_type, Subtype::Unknown);
            let size = Size { length_m, width_m, height_m };
            // A size is written with the states; without any there is only the default.
            let size = if seen { size } else { Size { height_m: None, ..default } };
            let goal = goal.map_or(Goal::default(), |(speed, heading)| Goal {
                speed_mps: Some(speed),
                heading_rad: Some(heading),
                ..Goal::default()
            });
            Agent {
                id: String::new(),
                agent_type,
                subtype: Subtype::Unknown,
                role: None,
                size,
                track: track.into(),
                conditions: Conditions { goal, ..Conditions::default() },
            }
        })
}

fn points(least: usize) -> impl Strategy<Value = Points> {
    let list = proptest::collection::vec((-9e3..9e3f64, -9e3..9e3f64, -50.0..50.0f64), least..6);
    (list, any::<bool>()).prop_map(|(list, with_z)| Points {
        xy: list.iter().map(|p| Vec2::new(p.0, p.1)).collect(),
        z_m: with_z.then(|| list.iter().map(|p| p.2).collect()),
    })
}

fn lane() -> impl Strategy<Value = Lane> {
    let kind = prop_oneof![
        Just(LaneType::Undefined),
        Just(LaneType::Freeway),
        Just(LaneType::SurfaceStreet),
        Just(LaneType::BikeLane)
    ];
    let mph = proptest::option::of(0..90u32);
    (kind, points(2), mph, any::<bool>(), 0..9usize).prop_map(|(lane_type, points, mph, interpolating, n)| {
        let boundary = Boundary { line: "201".into(), from: n, to: n + 1, kind: Some(n as u32) };
        Lane {
            id: String::new(),
            lane_type,
            points,
            width_m: None,
            left_boundary: vec![boundary.clone()],
            right_boundary: Vec::new(),
            speed_limit_mps: mph.map(|v| f64::from(v) * 0.447_04),
            predecessors: vec!["100".into()],
            successors: vec!["101".into(), "777".into()],
            left_neighbors: vec![Neighbor {
                lane: "101".into(),
                own_range: (0, n),
                other_range: (n, n),
                boundaries: vec![boundary],
            }],
            right_neighbors: Vec::new(),
            interpolating,
        }
    })
}

fn signal(steps: usize) -> impl Strategy<Value = Signal> {
    let states = proptest::collection::vec(0..9usize, steps);
    let stop = proptest::option::of((-9e3..9e3f64, -9e3..9e3f64, proptest::option::of(-5.0..5.0f64)));
    (states, stop).prop_map(|(states, stop)| {
        let all = [
            SignalState::Unknown,
            SignalState::ArrowStop,
            SignalState::ArrowCaution,
            SignalState::ArrowGo,
            SignalState::Stop,
            SignalState::Caution,
            SignalState::Go,
            SignalState::FlashingStop,
            SignalState::FlashingCaution,
        ];
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for (step, number) in states.into_iter().enumerate() {
            if runs.last().is_none_or(|run| run.1 != all[number]) {
                runs.push((step, all[number]));
            }
        }
        Signal {
            lane: String::new(),
            stop: stop.map(|s| Vec2::new(s.0, s.1)),
            stop_z_m: stop.and_then(|s| s.2),
            runs,
        }
    })
}

/// Scenes that the record format can carry but for their conditions; the ego stands at the origin.
fn scene() -> impl Strategy<Value = Scene> {
    (1..12usize).prop_flat_map(|steps| {
        let parts = (
            proptest::collection::vec(agent(steps), 1..6),
            proptest::collection::vec(lane(), 1..4),
            proptest::collection::vec(points(1), 5),
            proptest::collection::vec(signal(steps), 0..3),
            (0..steps, (-9e4..9e4f64, -9e4..9e4f64), state()),
        );
        parts.prop_map(move |(mut agents, mut lanes, lines, mut signals, (now_step, origin, ego))| {
            for (i, agent) in agents.iter_mut().enumerate() {
                agent.id = (i * 3 + 1).to_string();
            }
            let ego_state = State { x_m: 0.0, y_m: 0.0, ..ego };
            agents[0].role = Some("ego".into());
            if agents[0].track.states.iter().all(Option::is_none) {
                agents[0].size.height_m = Some(1.5);
                agents[0].track.z_m = None;
            }
            agents[0].track.states[now_step] = Some(ego_state);
            agents[0].size.length_m = 4.5;
            agents[0].size.width_m = 2.0;
            for (i, lane) in lanes.iter_mut().enumerate() {
                lane.id = (100 + i).to_string();
            }
            for (i, signal) in signals.iter_mut().enumerate() {
                signal.lane = (100 + i).to_string();
            }
            let line = |id: &str, line_type: &str, points: &Points| TypedLine {
                id: id.into(),
                line_type: line_type.into(),
                points: points.clone(),
            };
            let area = |id: &str, polygon: &Points| Area {
                id: id.into(),
                polygon: polygon.clone(),
                holes: Vec::new(),
            };
            let map = LaneMap {
                lanes,
                road_lines: vec![line("201", "passing_double_yellow", &lines[0])],
                road_edges: vec![line("301", "median", &lines[1])],
                crosswalks: vec![area("401", &lines[2])],
                speed_bumps: vec![area("402", &lines[3])],
                driveways: vec![area("403", &lines[4])],
                stop_signs: vec![StopSign {
                    id: "501".into(),
                    position: Vec2::new(1.0, 2.0),
                    z_m: None,
                    lanes: vec!["100".into()],
                }],
                drivable: Vec::new(),
            };
            let meta = Meta {
                source: "synthetic".into(),
                source_id: Some("synth-1".into()),
                licence: Some("cc0".into()),
                origin: Origin { x_m: origin.0, y_m: origin.1, ..Origin::default() },
                objects_of_interest: vec!["1".into()],
                tracks_to_predict: vec![("1".into(), 2)],
                ..Meta::default()
            };
            Scene {
                id: None,
                name: "synth-1".into(),
                meta,
                time: Timing { steps, now_step },
                map: map.into(),
                signals,
                agents,
                generated: None,
                extra: BTreeMap::new(),
            }
        })
    })
}

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

/// Leaves out steps at either end of a track at which nobody saw the road user.
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
        // What came from a file goes back into one bit for bit.
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
        // What is known of notes alone is all that the two differ in.
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
        // What came from a file goes back into one bit for bit.
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
        let warned: Vec<_> = warnings.iter().map(|w| w.code).collect();
        prop_assert_eq!(warned, ["no-map", "sizes-assumed"]);
        let seen = |agent: &&Agent| agent.track.valid_steps().next().is_some();
        let mut expected: Vec<Agent> = scene.agents.iter().filter(seen).cloned().collect();
        let unseen = file.losses.iter().any(|loss| loss.code == "no-unseen");
        prop_assert_eq!(unseen, expected.len() < scene.agents.len());
        prop_assert_eq!(first.time, scene.time);
        prop_assert_eq!(first.meta.licence.as_deref(), scene.meta.licence.as_deref());
        let (own, its) = (&scene.meta.origin, &first.meta.origin);
        for agent in &mut expected {
            agent.conditions = Conditions::default();
            agent.size = Size::default_for(agent.agent_type, agent.subtype);
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
