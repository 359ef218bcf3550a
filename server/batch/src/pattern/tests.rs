use super::document::RoadPattern;
use super::place::PatternPlace;
use super::search::PatternSearch;
use super::shipped;
use scene::map::{Area, Lane, LaneType, Points};
use scene::random::Key;
use scene::routes::LaneGraph;
use scene::{LaneMap, Scene, Vec2};
use std::collections::BTreeSet;

fn line(points: &[(f64, f64)]) -> Points {
    Points::from(points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect::<Vec<_>>())
}

fn lane(id: &str, points: &[(f64, f64)], after: &[&str]) -> Lane {
    let successors = after.iter().map(|id| (*id).to_owned()).collect();
    Lane { successors, ..Lane::street(id, line(points)) }
}

/// A quarter circle to the left.
fn left_turn(from: (f64, f64), radius_m: f64) -> Vec<(f64, f64)> {
    let angle = |i: i32| f64::from(i) * std::f64::consts::FRAC_PI_2 / 12.0;
    (0..=12)
        .map(|i| (from.0 + radius_m * angle(i).sin(), from.1 + radius_m * (1.0 - angle(i).cos())))
        .collect()
}

/// A junction: eastbound and westbound lanes 3.5 m apart, a left turn from the east to the north, a road from
/// the south, and a crosswalk over the northern exit.
fn junction() -> LaneMap {
    let turn = Lane { interpolating: true, ..lane("left", &left_turn((0.0, 0.0), 12.0), &["north"]) };
    let through = Lane { interpolating: true, ..lane("through", &[(0.0, 0.0), (30.0, 0.0)], &["east"]) };
    LaneMap {
        lanes: vec![
            lane("in", &[(-150.0, 0.0), (0.0, 0.0)], &["left", "through"]),
            turn,
            through,
            lane("east", &[(30.0, 0.0), (200.0, 0.0)], &[]),
            lane("north", &[(12.0, 12.0), (12.0, 120.0)], &[]),
            lane("west", &[(200.0, 3.5), (-150.0, 3.5)], &[]),
            lane("south", &[(20.0, -100.0), (20.0, -2.0)], &["up"]),
            Lane { interpolating: true, ..lane("up", &[(20.0, -2.0), (20.0, 15.0)], &[]) },
        ],
        crosswalks: vec![Area {
            id: "walk".into(),
            polygon: line(&[(6.0, 14.0), (18.0, 14.0), (18.0, 17.0), (6.0, 17.0)]),
            holes: Vec::new(),
        }],
        ..LaneMap::default()
    }
}

fn places(pattern: &RoadPattern, map: LaneMap) -> Vec<PatternPlace> {
    let scene = Scene::bare("", map, Vec::new());
    let graph = LaneGraph::new(&scene.map);
    let search = PatternSearch::new(pattern, &scene, &graph);
    let found = search.all();
    for place in &found {
        assert_eq!(search.find(&place.id).unwrap().position, place.position);
    }
    found
}

fn ids(name: &str, map: LaneMap) -> Vec<String> {
    places(shipped::named(name).unwrap(), map).into_iter().map(|place| place.id).collect()
}

#[test]
fn a_left_turn_is_found_where_it_crosses_the_oncoming_lane() {
    let found = places(shipped::named("CCFtap").unwrap(), junction());
    assert_eq!(found.len(), 1, "{found:?}");
    let place = &found[0];
    assert!(place.id.starts_with("left@") && place.id.ends_with("xwest"), "{}", place.id);
    assert!((place.position.y - 3.5).abs() < 0.1, "{:?}", place.position);
    let pattern = shipped::named("CCFtap").unwrap();
    let agents = place.cast(pattern, &pattern.standard(), 10).unwrap();
    let (vut, target) = (&agents[0], &agents[1]);
    let start = vut.track.at(10).unwrap();
    assert!((start.speed_mps() - 15.0 / 3.6).abs() < 1e-9 && start.x_m < 0.0, "{start:?}");
    let oncoming = target.track.at(10).unwrap();
    // 45 km/h for 4 s, and exactly at the place then.
    assert!((oncoming.x_m - place.position.x - 50.0).abs() < 0.1, "{oncoming:?}");
    let goal = target.conditions.goal;
    assert!((goal.position.unwrap() - place.position).norm() < 0.1, "{goal:?}");
    assert_eq!(goal.time_s, Some(5.0));
    assert_eq!((vut.role.as_deref(), vut.conditions.via.len()), (Some("ego"), 2));
}

#[test]
fn each_feature_is_found_where_it_is_and_nowhere_else() {
    let turned = ids("CPTA", junction());
    assert!(
        turned.len() == 1 && turned[0].starts_with("north@") && turned[0].ends_with("xwalk"),
        "{turned:?}"
    );
    let crossing: BTreeSet<String> =
        ids("CCCscp", junction()).iter().map(|id| id.split('@').next().unwrap().to_owned()).collect();
    assert!(crossing.contains("through") && crossing.contains("up"), "{crossing:?}");
    assert!(!crossing.contains("left"), "a turn is not straight: {crossing:?}");
    assert_eq!(
        ids("ALKS-cut-in", junction()),
        Vec::<String>::new(),
        "nobody drives beside in the same direction"
    );
    let oncoming = ids("CCFhol", junction());
    assert!(oncoming.iter().any(|id| id.starts_with("west@")), "{oncoming:?}");
    assert_eq!(ids("merge", junction()), Vec::<String>::new());
    assert_eq!(ids("roundabout-entry", junction()), Vec::<String>::new());
    let short = LaneMap { lanes: vec![lane("a", &[(0.0, 0.0), (40.0, 0.0)], &[])], ..LaneMap::default() };
    assert_eq!(ids("CCRs", short), Vec::<String>::new());
    let walkway = Lane { lane_type: LaneType::Sidewalk, ..lane("a", &[(0.0, 0.0), (400.0, 0.0)], &[]) };
    assert_eq!(ids("CCRs", LaneMap { lanes: vec![walkway], ..LaneMap::default() }), Vec::<String>::new());
}

#[test]
fn a_roundabout_is_entered_from_outside() {
    let arc = |from: f64, to: f64| -> Vec<(f64, f64)> {
        let at = |i: i32| from + (to - from) * f64::from(i) / 20.0;
        (0..=20).map(|i| (20.0 * at(i).cos(), 20.0 * at(i).sin())).collect()
    };
    let pi = std::f64::consts::PI;
    let map = LaneMap {
        lanes: vec![
            lane("first", &arc(0.0, pi), &["second"]),
            lane("second", &arc(pi, 2.0 * pi), &["first"]),
            lane("entry", &[(20.0, -60.0), (20.0, 0.0)], &["first"]),
        ],
        ..LaneMap::default()
    };
    assert_eq!(ids("roundabout-entry", map.clone()), ["entry@60.0xsecond"]);
    // From the ring, the other lane is a merge and not an entry.
    let merges = ids("merge", map);
    assert!(merges.iter().all(|id| id.starts_with("entry@")), "{merges:?}");
}

#[test]
fn numbers_follow_the_parameters_and_say_what_does_not_fit() {
    let pattern = shipped::named("CCRb").unwrap();
    let road = LaneMap { lanes: vec![lane("a", &[(0.0, 0.0), (300.0, 0.0)], &[])], ..LaneMap::default() };
    let place = places(pattern, road).remove(0);
    let cast = |name: &str, value: f64| place.cast(pattern, &[(name.to_owned(), value)].into(), 0);
    let agents = cast("gap_m", 40.0).unwrap();
    let (vut, target) = (agents[0].track.at(0).unwrap(), agents[1].track.at(0).unwrap());
    assert!((target.x_m - vut.x_m - 40.0 - agents[0].size.length_m).abs() < 1e-9);
    let goal = agents[1].conditions.goal;
    // From 50 km/h at 6 m/s2: 2.3 s.
    assert_eq!((goal.time_s, goal.speed_mps), (Some(2.3), Some(0.0)));
    assert!(cast("vut_kmh", 80.0).unwrap()[0].track.at(0).unwrap().speed_mps() > 22.0);
    let late = cast("braking_mps2", 1.0).unwrap_err();
    assert!(late.contains("target is due after 13.9 s"), "{late}");
    assert!(cast("gap_m", 500.0).unwrap_err().contains("the way of target has no"));
}

#[test]
fn faults_have_their_place() {
    let text = |users: &str| {
        format!(
            "name = 'a'\ntitle = 't'\nroad = {{ feature = 'lane' }}\nparameters = {{ v_kmh = {{ value = 3, range = [1, 9] }} }}\n{users}"
        )
    };
    let user = "[[users]]\nid = 'x'\ntype = 'vehicle'\nat_m = 0\n";
    assert!(RoadPattern::parse(&text(user)).is_ok());
    for (more, expected) in [
        ("at_s = 3", "users[0]: exactly one of at_m, at_s and ahead_of"),
        ("speed_kmh = 'v_kmp'", "users[0].speed_kmh: no parameter is v_kmp (did you mean v_kmh?)"),
        ("speed_kph = 3", "users[0].speed_kph: unknown field `speed_kph`"),
        ("goal = { at_m = 3 }", "users[0].goal: exactly one of time_s and braking_mps2"),
        (
            "goal = { time_s = 3, relation = { to = 'x', ahead_m = 3 } }",
            "users[0].goal.relation.to: no other",
        ),
        ("[[users]]\nid = 'y'\ntype = 'vehicle'\nahead_of = 'z'\ngap_m = 1", "users[1].ahead_of: no earlier"),
        ("[[users]]\nid = 'x'\ntype = 'vehicle'\nat_m = 1", "users[1].id: "),
    ] {
        let faults = RoadPattern::parse(&text(&format!("{user}{more}"))).unwrap_err();
        assert!(faults[0].to_string().starts_with(expected), "{more}: {faults:?}");
    }
    let wide =
        RoadPattern::parse("name = 'a'\ntitle = ''\nroad = { feature = 'lane', before_m = 900 }\nusers = []");
    assert_eq!(wide.unwrap_err().len(), 2);
}

/// A map of random lanes of any shape and with any links.
fn random_map(seed: u64) -> LaneMap {
    let mut draw = Key::default().words(&["pattern tests"]).number(seed).stream();
    let count = 1 + (draw.unit() * 30.0) as usize;
    let mut lanes = Vec::new();
    for i in 0..count {
        let (mut x, mut y) = (draw.between(-60.0, 60.0), draw.between(-60.0, 60.0));
        let points = (0..1 + (draw.unit() * 9.0) as usize).map(|_| {
            // Points may repeat.
            let step = if draw.unit() < 0.1 { 0.0 } else { 25.0 };
            (x, y) = (x + draw.between(-step, step), y + draw.between(-step, step));
            (x, y)
        });
        let points: Vec<(f64, f64)> = points.collect();
        let mut lane = lane(&format!("{}", i / 2 * 2), &points, &[]);
        let mut other = || format!("{}", (draw.unit() * count as f64 * 1.2) as usize);
        lane.successors = (0..3).map(|_| other()).collect();
        lane.predecessors = (0..2).map(|_| other()).collect();
        lane.interpolating = i % 3 == 0;
        lanes.push(lane);
    }
    let corner = |i: usize| ((i as f64 * 7.0) % 40.0 - 20.0, (i as f64 * 11.0) % 30.0 - 15.0);
    let ring: Vec<(f64, f64)> = (0..count % 7).map(corner).collect();
    let crosswalks = vec![Area { id: "c".into(), polygon: line(&ring), holes: Vec::new() }];
    LaneMap { lanes, crosswalks, ..LaneMap::default() }
}

#[test]
fn no_map_makes_it_panic_and_every_place_is_found_again() {
    for seed in 0..60 {
        let map = random_map(seed);
        for pattern in shipped::all() {
            places(pattern, map.clone());
        }
    }
}

/// Copies of a junction side by side.
fn town(copies: usize) -> LaneMap {
    let mut all = LaneMap::default();
    for copy in 0..copies {
        let shift = Vec2::new(500.0 * (copy % 8) as f64, 400.0 * (copy / 8) as f64);
        let mut map = junction();
        let moved = |points: &mut Points| points.xy.iter_mut().for_each(|p| *p += shift);
        map.lanes.iter_mut().for_each(|lane| {
            moved(&mut lane.points);
            lane.id = format!("{}-{copy}", lane.id);
            lane.successors.iter_mut().for_each(|id| *id = format!("{id}-{copy}"));
        });
        map.crosswalks.iter_mut().for_each(|area| moved(&mut area.polygon));
        all.lanes.extend(map.lanes);
        all.crosswalks.extend(map.crosswalks);
    }
    all
}

#[test]
fn the_work_grows_with_the_lanes() {
    let spent = |copies: usize| {
        let scene = Scene::bare("", town(copies), Vec::new());
        let graph = LaneGraph::new(&scene.map);
        let began = std::time::Instant::now();
        let found: usize = shipped::all()
            .iter()
            .map(|pattern| PatternSearch::new(pattern, &scene, &graph).all().len())
            .sum();
        (found, began.elapsed().as_secs_f64())
    };
    let (few, short) = spent(8);
    let (many, long) = spent(64);
    assert_eq!(many, few * 8);
    // Eight times the lanes; quadratic growth would take 64 times as long.
    assert!(long < 24.0 * short.max(1e-3), "{short} s and {long} s");
}
