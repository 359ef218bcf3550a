//! Round trips of scenes through a format: only declared losses may differ.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod generated;

use formats::{ExportOptions, ExportedMotion, ImportOptions, registry};
use proptest::prelude::*;
use scene::map::{Lane, Points};
use scene::{Agent, Scene, SignalState, State, Subtype, Vec2};
use std::collections::BTreeSet;

/// A scene after a round trip, and its declared losses.
fn through(format: &str, scene: &Scene) -> (Scene, BTreeSet<&'static str>) {
    let format = registry::by_id(format).unwrap();
    let options = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
    let file = format.export(&[scene], &options).unwrap();
    assert_eq!(registry::sniff(&file.bytes, "").map(|found| found.info().id), Some(format.info().id));
    let list = format.import(&file.bytes, &ImportOptions::default());
    let (again, _) = list.into_iter().next().unwrap().unwrap();
    (again, file.losses.iter().map(|loss| loss.code).collect())
}

/// A point of the scene in the frame of the source.
fn placed(scene: &Scene, p: Vec2) -> Vec2 {
    let origin = &scene.meta.origin;
    scene::geometry::rotate(p, origin.rotation_rad) + Vec2::new(origin.x_m, origin.y_m)
}

fn close(a: f64, b: f64, off: f64) -> bool {
    (a - b).abs() <= off
}

fn same_state(scenes: [&Scene; 2], states: [&State; 2], off: f64) -> bool {
    let place = |i: usize| placed(scenes[i], states[i].position());
    (place(0) - place(1)).norm() <= off
        && scene::wrap_angle(states[0].heading_rad - states[1].heading_rad).abs() <= off
        && (states[0].velocity() - states[1].velocity()).norm() <= off
}

/// Rings are the same from whichever corner on.
fn same_ring(scenes: [&Scene; 2], a: &[Vec2], b: &[Vec2], off: f64) -> bool {
    let place =
        |i: usize, ring: &[Vec2]| -> Vec<Vec2> { ring.iter().map(|p| placed(scenes[i], *p)).collect() };
    let (a, b) = (place(0, a), place(1, b));
    a.len() == b.len()
        && (0..a.len()).any(|k| (0..a.len()).all(|i| (a[i] - b[(i + k) % b.len()]).norm() <= off))
}

fn same_lanes(scenes: [&Scene; 2], off: f64) {
    let [before, after] = scenes;
    assert_eq!(before.map.lanes.len(), after.map.lanes.len());
    for (a, b) in before.map.lanes.iter().zip(&after.map.lanes) {
        assert_eq!(a.points.xy.len(), b.points.xy.len(), "lane {}", a.id);
        for (p, q) in a.points.xy.iter().zip(&b.points.xy) {
            let apart = (placed(before, *p) - placed(after, *q)).norm();
            assert!(apart <= off, "lane {}: {apart} m", a.id);
        }
        assert_eq!(a.lane_type, b.lane_type, "lane {}", a.id);
    }
}

fn plain(state: SignalState) -> SignalState {
    use SignalState::*;
    match state {
        Unknown => Unknown,
        ArrowStop | Stop | FlashingStop => Stop,
        ArrowCaution | Caution | FlashingCaution => Caution,
        ArrowGo | Go => Go,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn scenarionet_loses_only_what_it_says(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("scenarionet", &scene);
        let expected = ["geometry-approximated", "no-conditions", "no-z"];
        prop_assert!(codes.iter().all(|code| expected.contains(code)) && codes.contains("geometry-approximated"), "{:?}", codes);
        // A place of 9 km in single precision.
        let off = 1e-3;
        same_lanes([&scene, &again], off);
        for (a, b) in scene.map.lanes.iter().zip(&again.map.lanes) {
            let plain = |lane: &Lane| Lane { points: Points::default(), speed_limit_mps: None, ..lane.clone() };
            prop_assert_eq!(plain(a), plain(b));
            prop_assert!(close(a.speed_limit_mps.unwrap_or(-1.0), b.speed_limit_mps.unwrap_or(-1.0), 1e-9));
        }
        same_features([&scene, &again], off);
        same_signals([&scene, &again], off)?;
        same_agents([&scene, &again], off, true)?;
        prop_assert_eq!(&scene.meta.licence, &again.meta.licence);
        prop_assert_eq!((&scene.name, &scene.meta.source, &scene.meta.source_id), (&again.name, &again.meta.source, &again.meta.source_id));
        prop_assert_eq!((&scene.meta.objects_of_interest, &scene.meta.tracks_to_predict), (&again.meta.objects_of_interest, &again.meta.tracks_to_predict));
        prop_assert_eq!(scene.time, again.time);
    }

    #[test]
    fn gpudrive_loses_only_what_it_says(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("gpudrive", &scene);
        let expected = ["no-lane-graph", "no-speed-limits", "no-conditions", "no-z", "no-licence", "no-timing", "no-signals"];
        prop_assert!(codes.iter().all(|code| expected.contains(code)) && codes.contains("no-lane-graph"), "{:?}", codes);
        let off = 1e-7;
        same_lanes([&scene, &again], off);
        for (a, b) in scene.map.lanes.iter().zip(&again.map.lanes) {
            prop_assert_eq!((&a.id, b.speed_limit_mps), (&b.id, None));
        }
        same_features([&scene, &again], off);
        same_signals([&scene, &again], off)?;
        same_agents([&scene, &again], off, true)?;
        prop_assert_eq!((&scene.name, &scene.meta.source_id), (&again.name, &again.meta.source_id));
        prop_assert_eq!((&scene.meta.objects_of_interest, &scene.meta.tracks_to_predict), (&again.meta.objects_of_interest, &again.meta.tracks_to_predict));
        prop_assert_eq!(scene.time.steps, again.time.steps);
    }

    #[test]
    fn nocturne_loses_only_what_it_says(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("nocturne", &scene);
        for code in ["no-ids", "no-lane-graph", "no-lane-type", "no-licence", "no-roles"] {
            prop_assert!(codes.contains(code), "{}: {:?}", code, codes);
        }
        let off = 1e-7;
        prop_assert_eq!(scene.map.lanes.len(), again.map.lanes.len());
        same_agents([&scene, &again], off, false)?;
    }

    #[test]
    fn commonroad_loses_only_what_it_says(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("commonroad", &scene);
        let lost = |code: &str| codes.contains(code);
        prop_assert!(lost("single-ego") && lost("no-lines") && lost("no-areas") && lost("no-map") && lost("no-lane-width"));
        prop_assert!(!lost("ids-renumbered") && !lost("no-licence"));
        let unruled = scene.signals.iter().any(|signal| scene.map.lane_index(&signal.lane).is_none());
        prop_assert_eq!(lost("no-signals"), unruled);
        // Millionths of a metre in the file; the middle of two sides of it.
        let off = 2e-6;
        same_lanes([&scene, &again], off);
        for (a, b) in scene.map.lanes.iter().zip(&again.map.lanes) {
            prop_assert_eq!(&a.id, &b.id);
            prop_assert!(close(a.width_or_assumed_m(), b.width_m.unwrap(), 1.1e-3));
            prop_assert_eq!((a.speed_limit_mps, a.interpolating), (b.speed_limit_mps, b.interpolating));
            let known = |ids: &[String]| -> BTreeSet<String> {
                let leads = |id: &&String| scene.map.lane_index(id).is_some_and(|i| meet(a, &scene.map.lanes[i], 3.0));
                ids.iter().filter(leads).filter(|id| **id != a.id).cloned().collect()
            };
            prop_assert!(known(&a.successors).is_subset(&b.successors.iter().cloned().collect()));
        }
        let rings = scene.map.crosswalks.iter().filter(|area| area.polygon.xy.len() > 2);
        for (a, b) in rings.zip(&again.map.crosswalks) {
            prop_assert!(same_ring([&scene, &again], &a.polygon.xy, &b.polygon.xy, off), "{:?} {:?}", a, b);
        }
        for (a, b) in scene.map.stop_signs.iter().zip(&again.map.stop_signs) {
            prop_assert_eq!((&a.id, &a.lanes), (&b.id, &b.lanes));
            prop_assert!((placed(&scene, a.position) - placed(&again, b.position)).norm() < off);
        }
        prop_assert_eq!(scene.signals.iter().filter(|s| scene.map.lane_index(&s.lane).is_some()).count(), again.signals.len());
        for signal in &again.signals {
            let own = scene.signals.iter().find(|own| own.lane == signal.lane).unwrap();
            for step in 0..again.time.steps.min(scene.time.steps) {
                prop_assert_eq!(plain(own.at(step)), signal.at(step));
            }
            if let (Some(p), Some(q)) = (own.stop, signal.stop) {
                prop_assert!((placed(&scene, p) - placed(&again, q)).norm() < off);
            }
        }
        prop_assert_eq!(&scene.meta.licence, &again.meta.licence);
        for agent in &scene.agents {
            let seen: Vec<usize> = agent.track.valid_steps().collect();
            let Some(other) = again.agent(&agent.id) else {
                prop_assert!(seen.is_empty() && lost("no-validity-gaps"));
                continue;
            };
            prop_assert_eq!(agent.role.as_deref(), other.role.as_deref());
            if agent.role.is_some() {
                let goal = (agent.conditions.goal, other.conditions.goal);
                prop_assert!(goal.0.is_free() || close(goal.0.speed_mps.unwrap(), goal.1.speed_mps.unwrap(), off));
                let state = other.track.states[0].unwrap();
                prop_assert!(same_state([&scene, &again], [agent.track.at(seen[0]).unwrap(), &state], off));
                continue;
            }
            same_motion(&scene, &again, (agent, other), off);
            prop_assert!(seen.windows(2).all(|w| w[1] == w[0] + 1) && seen.len() > 1 || lost("no-validity-gaps"));
            prop_assert_eq!(agent.agent_type, other.agent_type);
            prop_assert!(close(agent.size.length_m, other.size.length_m, off));
            prop_assert!(agent.subtype == other.subtype || (other.subtype == Subtype::Car && lost("no-subtype")));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn recordings_of_sumo_lose_only_what_they_say(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("sumo-fcd", &scene);
        let expected = [
            "no-conditions", "no-licence", "no-map", "no-notes", "no-roles", "no-signals", "no-subtype", "no-timing",
            "no-unseen", "no-velocity", "no-z",
        ];
        prop_assert!(codes.iter().all(|code| expected.contains(code)), "{:?}", codes);
        recorded([&scene, &again], &codes)?;
        prop_assert_eq!(again.map.lanes.len(), 0);
    }

    #[test]
    fn networks_of_sumo_lose_only_what_they_say(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("sumo-net", &scene);
        prop_assert!(codes.contains("no-road-users") && again.agents.is_empty());
        networked([&scene, &again], &codes, "sumo-net")?;
    }

    #[test]
    fn folders_of_sumo_lose_only_what_they_say(scene in generated::scene()) {
        let scene = scene.checked().unwrap();
        let (again, codes) = through("sumo", &scene);
        prop_assert!(!codes.contains("no-road-users"));
        recorded([&scene, &again], &codes)?;
        networked([&scene, &again], &codes, "sumo")?;
    }
}

/// Motion as SUMO records it: every seen road user, velocities along headings.
fn recorded(scenes: [&Scene; 2], codes: &BTreeSet<&str>) -> Result<(), TestCaseError> {
    let [before, after] = scenes;
    // Millionths of metres and of degrees in the file.
    let off = 2e-6;
    let seen = |agent: &&Agent| agent.track.valid_steps().next().is_some();
    let seen: Vec<&Agent> = before.agents.iter().filter(seen).collect();
    prop_assert_eq!(seen.len(), after.agents.len());
    prop_assert_eq!(codes.contains("no-unseen"), seen.len() < before.agents.len());
    prop_assert_eq!(before.time.steps, after.time.steps);
    prop_assert!(before.time.now_step == after.time.now_step || codes.contains("no-timing"));
    for a in seen {
        let b = after.agent(&a.id).unwrap();
        prop_assert_eq!(a.agent_type, b.agent_type);
        prop_assert!(a.subtype == b.subtype || codes.contains("no-subtype"));
        prop_assert!(
            close(a.size.length_m, b.size.length_m, off) && close(a.size.width_m, b.size.width_m, off)
        );
        prop_assert_eq!(a.size.height_m.is_some(), b.size.height_m.is_some());
        prop_assert_eq!(a.track.valid_steps().collect::<Vec<_>>(), b.track.valid_steps().collect::<Vec<_>>());
        for step in a.track.valid_steps() {
            let (p, q) = (a.track.at(step).unwrap(), b.track.at(step).unwrap());
            prop_assert!((placed(before, p.position()) - placed(after, q.position())).norm() <= off);
            prop_assert!(scene::wrap_angle(p.heading_rad - q.heading_rad).abs() <= off);
            prop_assert!(close(p.speed_mps(), q.speed_mps(), off));
            let same = (p.velocity() - q.velocity()).norm() <= 0.02;
            prop_assert!(same || codes.contains("no-velocity"));
        }
    }
    Ok(())
}

/// The second lane begins where the first one ends.
fn meet(a: &Lane, b: &Lane, within_m: f64) -> bool {
    a.points.xy.last().zip(b.points.xy.first()).is_some_and(|(end, start)| (end - start).norm() < within_m)
}

/// Lanes are where the writer placed them, have the same successors, and keep their signals.
fn networked(scenes: [&Scene; 2], codes: &BTreeSet<&str>, format: &str) -> Result<(), TestCaseError> {
    let [before, after] = scenes;
    let options = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
    let losses = registry::by_id(format).unwrap().export(&[before], &options).unwrap().losses;
    let said = losses.iter().find(|loss| loss.code == "geometry-approximated").unwrap();
    let off: f64 = said.detail.split(' ').find_map(|word| word.parse().ok()).unwrap();
    let off = off + 1e-3;
    let line = |scene: &Scene, lane: &Lane| -> Vec<Vec2> {
        lane.points.xy.iter().map(|p| placed(scene, *p)).collect()
    };
    let is_back = |lane: &Lane, back: &Lane| {
        let (own, its) = (line(before, lane), line(after, back));
        let end = |at: usize| (own[(own.len() - 1) * at] - its[(its.len() - 1) * at]).norm() < 1e-4;
        end(0) && end(1) && own.iter().all(|p| formats::polyline::distance_to(&its, *p) <= off)
    };
    prop_assert!(after.map.lanes.len() >= before.map.lanes.len());
    let mut back = std::collections::BTreeMap::new();
    for lane in &before.map.lanes {
        let found = after.map.lanes.iter().find(|back| is_back(lane, back));
        prop_assert!(found.is_some(), "lane {} is not within {} m", lane.id, off);
        back.insert(lane.id.clone(), found.unwrap());
    }
    for lane in &before.map.lanes {
        let again = back[&lane.id];
        prop_assert!(close(lane.width_or_assumed_m(), again.width_m.unwrap(), 1e-5));
        let limit = again.speed_limit_mps.unwrap();
        prop_assert!(
            lane.speed_limit_mps.map_or(codes.contains("no-speed-limits"), |own| close(own, limit, 1e-5))
        );
        prop_assert!(lane.lane_type == again.lane_type || codes.contains("no-lane-type"));
        prop_assert!(lane.interpolating == again.interpolating || codes.contains("no-lane-graph"));
        // Across a gap the reader draws a way, or none.
        let leads = |other: &Lane| {
            other.id != lane.id
                && meet(lane, other, 0.4)
                && (lane.successors.contains(&other.id) || other.predecessors.contains(&lane.id))
        };
        let own: BTreeSet<&str> = before
            .map
            .lanes
            .iter()
            .filter(|other| leads(other))
            .map(|other| back[&other.id].id.as_str())
            .collect();
        let near =
            |id: &&String| after.map.lanes.iter().any(|other| other.id == **id && meet(again, other, 0.4));
        let is_drawn = |id: &&String| back.values().any(|lane| lane.id == **id);
        let its = again.successors.iter().filter(near).filter(is_drawn);
        let its: BTreeSet<&str> = its.map(String::as_str).collect();
        prop_assert_eq!(own, its, "lane {}", lane.id);
    }
    let mut lights = 0;
    for signal in &before.signals {
        let Some(lane) = back.get(&signal.lane) else { continue };
        let Some(again) = after.signals.iter().find(|again| again.lane == lane.id) else { continue };
        lights += 1;
        for step in 0..before.time.steps {
            let (own, its) = (signal.at(step), again.at(step));
            prop_assert!(own == its || (codes.contains("no-signal-states") && plain(own) == plain(its)));
        }
    }
    prop_assert_eq!(lights < before.signals.len(), codes.contains("no-signals"));
    // A way that the reader draws across a gap may have the signal of the lane before it.
    let own = after.signals.iter().filter(|signal| back.values().any(|lane| lane.id == signal.lane));
    prop_assert_eq!(lights, own.count());
    Ok(())
}

/// Every state is still present.
fn same_motion(before: &Scene, after: &Scene, (a, b): (&Agent, &Agent), off: f64) {
    for step in a.track.valid_steps() {
        let states = (a.track.at(step), b.track.at(step));
        let (Some(p), Some(q)) = states else { panic!("{}: nothing at step {step}", a.id) };
        assert!(same_state([before, after], [p, q], off), "{}: {p:?} {q:?}", a.id);
    }
}

/// Lines, edges and areas are the same, in the frame of the source.
fn same_features(scenes: [&Scene; 2], off: f64) {
    let lines = |scene: &Scene| -> Vec<(String, String, Vec<Vec2>)> {
        let map = &scene.map;
        let lines = map.road_lines.iter().chain(&map.road_edges);
        let lines = lines.map(|line| (line.id.clone(), line.line_type.clone(), &line.points));
        let areas = map.crosswalks.iter().chain(&map.speed_bumps).chain(&map.driveways);
        let all = lines.chain(areas.map(|area| (area.id.clone(), String::new(), &area.polygon)));
        all.map(|(id, kind, points)| (id, kind, points.xy.iter().map(|p| placed(scene, *p)).collect()))
            .collect()
    };
    let [before, after] = scenes.map(lines);
    assert_eq!(before.len(), after.len());
    for (a, b) in before.iter().zip(&after) {
        assert_eq!((&a.0, &a.1, a.2.len()), (&b.0, &b.1, b.2.len()));
        assert!(a.2.iter().zip(&b.2).all(|(p, q)| (p - q).norm() <= off), "{}", a.0);
    }
}

/// Signals show the same, at the same places.
fn same_signals(scenes: [&Scene; 2], off: f64) -> Result<(), TestCaseError> {
    let [before, after] = scenes;
    let known = before.signals.iter().filter(|signal| before.map.lane_index(&signal.lane).is_some());
    for (a, b) in known.zip(&after.signals) {
        prop_assert_eq!(&a.lane, &b.lane);
        for step in 0..before.time.steps {
            prop_assert_eq!(a.at(step), b.at(step));
        }
        prop_assert_eq!(a.stop.is_some(), b.stop.is_some());
        if let (Some(p), Some(q)) = (a.stop, b.stop) {
            prop_assert!((placed(before, p) - placed(after, q)).norm() <= off);
        }
    }
    Ok(())
}

/// Road users are the same, in their order, where they were seen and where not.
fn same_agents(scenes: [&Scene; 2], off: f64, named: bool) -> Result<(), TestCaseError> {
    let [before, after] = scenes;
    prop_assert_eq!(before.agents.len(), after.agents.len());
    for (a, b) in before.agents.iter().zip(&after.agents) {
        prop_assert_eq!((a.agent_type, a.subtype), (b.agent_type, b.subtype));
        if named {
            prop_assert_eq!((&a.id, &a.role), (&b.id, &b.role));
        }
        prop_assert_eq!(a.track.valid_steps().collect::<Vec<_>>(), b.track.valid_steps().collect::<Vec<_>>());
        if a.track.valid_steps().next().is_some() {
            prop_assert!(
                close(a.size.length_m, b.size.length_m, off) && close(a.size.width_m, b.size.width_m, off)
            );
        }
        same_motion(before, after, (a, b), off);
    }
    Ok(())
}
