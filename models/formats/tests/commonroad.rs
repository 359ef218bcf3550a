//! CommonRoad scenarios as scenes and back: values by hand, and files that break promises.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::{ExportOptions, ExportedMotion, ImportOptions, Imported, ReadError, registry};
use scene::map::{Lane, LaneMap, LaneType};
use scene::{AgentType, SignalState, Subtype, Vec2};

const STREET: &str = include_str!("../../../fuzz/corpus/commonroad/street.xml");
const OLD: &str = include_str!("../../../fuzz/corpus/commonroad/old.xml");

fn import(text: &str) -> Result<Imported, ReadError> {
    registry::import(text.as_bytes(), "a.xml", "auto", &ImportOptions::default())?.remove(0)
}

fn refused(text: &str) -> String {
    import(text).unwrap_err().problems[0].to_string()
}

fn lane<'a>(map: &'a LaneMap, id: &str) -> &'a Lane {
    map.lanes.iter().find(|lane| lane.id == id).unwrap_or_else(|| panic!("no lane {id}"))
}

#[test]
fn a_street_is_read() {
    let (scene, warnings) = import(STREET).unwrap();
    let codes: Vec<_> = warnings.iter().map(|w| w.code).collect();
    let expected =
        ["goal-interval", "goals-dropped", "sizes-assumed", "occupancy-sets", "shapes-approximated"];
    assert_eq!(codes, [&expected[..], &["elements-dropped"]].concat());
    assert_eq!((scene.name.as_str(), scene.meta.source.as_str()), ("ZAM_Street-1_1_T-1", "drawn"));
    assert_eq!(
        (scene.meta.licence.as_deref(), scene.meta.tags.as_slice()),
        (Some("cc0"), &["urban".to_owned(), "two_lane".into()][..])
    );
    let origin = &scene.meta.origin;
    assert_eq!(
        (origin.x_m, origin.y_m, origin.crs.as_deref()),
        (1000.0, -2000.0, Some("+proj=utm +zone=32"))
    );
    let map = &scene.map;
    let (there, bikes, on) = (lane(map, "1"), lane(map, "2"), lane(map, "4"));
    assert_eq!(there.points.xy, [0.0, 20.0, 50.0].map(|x| Vec2::new(x, -1.5)));
    assert_eq!((there.width_m, bikes.width_m, bikes.lane_type), (Some(3.0), Some(3.5), LaneType::BikeLane));
    assert_eq!((there.speed_limit_mps, on.speed_limit_mps), (Some(13.5), None));
    assert_eq!(
        (there.successors.as_slice(), on.predecessors.as_slice()),
        (&["4".to_owned(), "5".into()][..], &["1".to_owned()][..])
    );
    assert!(on.interpolating && !there.interpolating);
    assert_eq!((there.right_neighbors[0].lane.as_str(), there.left_neighbors.len()), ("2", 0));
    // Traffic uses the way to the left both ways.
    assert_eq!(lane(map, "5.back").points.xy.first(), lane(map, "5").points.xy.last());
    // The centre line and the bicycle lane's line are drawn once each, and bound the lanes on both sides.
    let lines: Vec<_> = map.road_lines.iter().map(|line| line.line_type.as_str()).collect();
    assert_eq!(lines, ["solid_double_white", "broken_single_white"]);
    assert_eq!(lane(map, "3").left_boundary[0].line, there.left_boundary[0].line);
    assert_eq!(bikes.left_boundary[0].line, there.right_boundary[0].line);
    assert_eq!((map.crosswalks[0].id.as_str(), map.crosswalks[0].polygon.xy.len()), ("6", 4));
    assert_eq!(
        (map.stop_signs[0].position, map.stop_signs[0].lanes.as_slice()),
        (Vec2::new(0.0, 4.5), &["3".to_owned()][..])
    );
    assert!(!map.road_edges.is_empty() && !map.drivable.is_empty());
}

#[test]
fn lights_go_through_their_cycles_and_rule_turns() {
    let (scene, _) = import(STREET).unwrap();
    let shown: Vec<_> = scene.signals.iter().map(|s| (s.lane.as_str(), s.stop.unwrap())).collect();
    assert_eq!(shown, [("1", Vec2::new(48.0, -1.5)), ("5", Vec2::new(50.0, -1.5))]);
    let all: Vec<_> = [0, 9, 10, 34, 35, 40].iter().map(|step| scene.signals[0].at(*step)).collect();
    use SignalState::{Caution, Go, Stop};
    assert_eq!(all, [Go, Caution, Stop, Stop, Go, Go]);
    assert_eq!((scene.signals[1].at(29), scene.signals[1].at(30)), (Go, Stop));
}

#[test]
fn obstacles_and_the_problem_are_road_users() {
    let (scene, _) = import(STREET).unwrap();
    assert_eq!((scene.time.steps, scene.time.now_step), (41, 0));
    let agent = |id: &str| scene.agent(id).unwrap_or_else(|| panic!("no road user {id}"));
    let ego = agent("50");
    assert_eq!(
        (ego.role.as_deref(), ego.agent_type, ego.track.at(0).unwrap().vx_mps),
        (Some("ego"), AgentType::Vehicle, 8.0)
    );
    let goal = &ego.conditions.goal;
    // Straight on at its speed it would be at 30 m; the lane that it must reach begins at 50 m.
    assert_eq!(
        (goal.position, goal.speed_mps, goal.time_s),
        (Some(Vec2::new(50.0, -1.5)), Some(5.0), Some(3.5))
    );
    assert!((goal.heading_rad.unwrap() + 0.05).abs() < 1e-12);
    let truck = agent("41");
    assert_eq!((truck.subtype, truck.size.length_m, truck.size.width_m), (Subtype::Truck, 9.0, 2.5));
    assert_eq!(truck.track.valid_steps().collect::<Vec<_>>(), [0, 1, 2, 3, 5, 6]);
    let walker = agent("42");
    let state = walker.track.at(2).unwrap();
    assert_eq!((walker.agent_type, walker.size.length_m), (AgentType::Pedestrian, 0.8));
    assert!(state.vx_mps.abs() < 1e-6 && (state.vy_mps - 1.5).abs() < 1e-6);
    let parked = agent("40");
    assert_eq!((parked.track.valid_steps().count(), parked.track.at(9).unwrap().x_m), (41, 31.0));
    assert!((parked.track.at(9).unwrap().heading_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
    let uncertain = agent("43");
    assert_eq!((uncertain.size.length_m, uncertain.track.valid_steps().count()), (4.0, 1));
}

#[test]
fn the_older_version_is_read_and_its_steps_become_tenths() {
    let (scene, warnings) = import(OLD).unwrap();
    let codes: Vec<_> = warnings.iter().map(|w| w.code).collect();
    assert_eq!(codes, ["time-resampled", "goal-interval", "uncertain-states"]);
    assert_eq!(scene.meta.tags, ["highway", "critical"]);
    assert_eq!(lane(&scene.map, "1").speed_limit_mps, Some(27.78));
    // Obstacle and problem have one id: it is one road user, with a motion and a goal.
    let [agent] = scene.agents.as_slice() else { panic!("{:?}", scene.agents) };
    assert_eq!((agent.role.as_deref(), agent.size.length_m), (Some("ego"), 4.5));
    let xs: Vec<f64> = agent.track.states.iter().flatten().map(|state| state.x_m).collect();
    assert_eq!(xs, [1.0, 2.0, 3.0]);
    assert_eq!(
        (agent.conditions.goal.position, agent.conditions.goal.time_s),
        (Some(Vec2::new(40.0, 1.75)), Some(4.0))
    );
}

#[test]
fn a_scenario_far_from_its_origin_is_moved() {
    let shifted = OLD.split("<x>").map(|part| match part.split_once("</x>") {
        Some((x, rest)) => format!("{}</x>{rest}", x.parse::<f64>().unwrap() + 691_000.0),
        None => part.to_owned(),
    });
    let (scene, _) = import(&shifted.collect::<Vec<_>>().join("<x>")).unwrap();
    assert_eq!((scene.meta.origin.x_m, scene.meta.origin.y_m), (691_025.0, 0.0));
    assert_eq!(lane(&scene.map, "1").points.xy[0], Vec2::new(-25.0, -1.75));
    assert_eq!(scene.agents[0].track.at(0).unwrap().x_m, -24.0);
}

#[test]
fn refusals_say_what_and_where() {
    let of = |from: &str, to: &str| refused(&STREET.replacen(from, to, 1));
    assert_eq!(
        of("2020a", "2024b"),
        "cannot-represent at \"\": \"commonRoadVersion=2024b\" found, one of 2018b, 2020a expected"
    );
    assert!(of("timeStepSize=\"0.1\"", "timeStepSize=\"0\"").contains("0.001 to 10 s expected"));
    assert!(of("<x>20</x>", "<x>wide</x>").contains("line 6: \"wide\" found in <x>, a number expected"));
    assert!(of("<x>20</x>", "<x>1e300</x>").contains("at most 1e8 m expected"));
    assert!(of("<rightBound>", "<right>").contains("</rightBound> found, </right> expected"));
    assert!(of("<x>20</x>", "<x>70000</x>").contains("a map reaches"));
    assert!(of("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", "<!DOCTYPE a>").contains("format-unknown"));
    assert!(of("<time><exact>0</exact></time>", "").contains("<initialState> has no <time>"));
}

#[test]
fn what_is_written_is_read_again() {
    let (scene, _) = import(STREET).unwrap();
    let format = registry::by_id("commonroad").unwrap();
    let options = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
    let file = format.export(&[&scene], &options).unwrap();
    let text = String::from_utf8(file.bytes.clone()).unwrap();
    assert!(
        text.contains("benchmarkID=\"ZAM_Street-1_1_T-1\"") && text.contains("source=\"drawn; licence cc0\"")
    );
    let (again, _) = format.import(&file.bytes, &ImportOptions::default()).remove(0).unwrap();
    assert_eq!(again.meta, scene.meta);
    assert_eq!(again.signals.len(), scene.signals.len());
    assert_eq!(again.map.stop_signs, scene.map.stop_signs);
    assert_eq!(again.agents.len(), scene.agents.len());
    let goals = [&scene, &again].map(|scene| scene.agent("50").unwrap().conditions.goal);
    assert_eq!(goals[0], goals[1]);
    // A scene without a lane is none that the format has a place for.
    let mut bare = scene.clone();
    bare.map = LaneMap::default().into();
    assert!(format.export(&[&bare], &options).unwrap_err().to_string().contains("needs at least one lane"));
}
