//! A standing agent blocks the lane: the vehicle goes around it, or stops before it if there is no room.
//! Beyond a goal it continues along the lane.

use super::crossing::{agent, street};
use super::{GENERATOR, ask, run};
use experts::request::ShownLast;
use experts::{Answer, Limiting, ReachReport, React, Request};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::map::{Lane, LaneMap, TypedLine};
use scene::{AgentType, Future, Goal, Scene, State, Vec2};

/// A car at 8 m/s with a goal on the lane, and one that stands in the lane 35 m ahead.
fn blocked(map: LaneMap, goal_x_m: f64) -> Scene {
    let mut car = agent("1", AgentType::Vehicle, (-40.0, -1.75), 0.0, 8.0);
    car.conditions.goal = Goal { position: Some(Vec2::new(goal_x_m, -1.75)), ..Goal::default() };
    let parked = agent("2", AgentType::Vehicle, (-5.0, -1.75), 0.0, 0.0);
    Scene::bare("blocked", map, vec![car, parked]).checked().unwrap()
}

fn only_the_first(scene: Scene) -> Request {
    Request { react: React::Everyone, ..ask(scene, Some(&["1"])) }
}

fn shown(answer: &Answer) -> &Future {
    let futures = &answer.samples[0].agents["1"];
    &futures.modes[futures.chosen]
}

fn meets(scene: &Scene, future: &Future) -> bool {
    let other = OrientedBox::of_state(&scene.agents[1].state_at(0).unwrap(), &scene.agents[1].size);
    let own = |s: &State| OrientedBox::of_state(s, &scene.agents[0].size);
    future.states.iter().any(|s| overlaps(&own(s), &other, 0.0))
}

/// A line beside the street, at an offset to the left.
fn edge(id: &str, left_m: f64) -> TypedLine {
    let points: Vec<Vec2> = (0..=40).map(|i| Vec2::new(f64::from(i) * 5.0 - 100.0, left_m)).collect();
    TypedLine { id: id.into(), line_type: "boundary".into(), points: points.into() }
}

/// The street with a lane beside it.
fn two_lanes() -> LaneMap {
    let mut map = street();
    let points: Vec<Vec2> = (0..=200).map(|i| Vec2::new(f64::from(i) - 100.0, 1.75)).collect();
    map.lanes.push(Lane { width_m: Some(3.5), ..Lane::street("b", points) });
    map
}

#[test]
fn who_stands_in_the_way_is_driven_round() {
    let scene = blocked(two_lanes(), 30.0);
    let answer = run(&GENERATOR, only_the_first(scene.clone()));
    assert!(matches!(answer.resolved["1"].reach, ReachReport::Reached { .. }));
    assert!(!meets(&scene, shown(&answer)));
    let aside = shown(&answer).states.iter().map(|s| (s.y_m + 1.75).abs()).fold(0.0, f64::max);
    assert!(aside > 1.5, "{aside}");
}

#[test]
fn where_there_is_no_room_one_halts_before_it_and_says_so() {
    let walls = LaneMap { road_edges: vec![edge("l", 0.2), edge("r", -3.7)], ..street() };
    let scene = blocked(walls, 30.0);
    let answer = run(&GENERATOR, only_the_first(scene.clone()));
    let ReachReport::Unreachable { limiting, words, .. } = &answer.resolved["1"].reach else {
        panic!("{:?}", answer.resolved["1"].reach);
    };
    assert_eq!(*limiting, Limiting::Traffic);
    assert!(words.contains("blocks this vehicle"), "{words}");
    assert!(!meets(&scene, shown(&answer)));
    let last = shown(&answer).states.last().unwrap();
    let gap_m = -5.0 - last.x_m - 0.5 * (scene.agents[0].size.length_m + scene.agents[1].size.length_m);
    assert!(last.speed_mps() < 0.5 && (0.0..5.0).contains(&gap_m), "{gap_m} {}", last.speed_mps());
}

#[test]
fn who_has_no_goal_waits_in_its_lane_and_not_in_the_one_of_those_who_come() {
    let points: Vec<Vec2> = (0..=200).map(|i| Vec2::new(100.0 - f64::from(i), 1.75)).collect();
    let mut map = LaneMap { road_edges: vec![edge("l", 3.6), edge("r", -3.6)], ..street() };
    map.lanes.push(Lane { width_m: Some(3.5), ..Lane::street("b", points) });
    // Cars of a queue with these gaps.
    for (gap_m, speed_mps) in [(12.0, 4.0), (14.0, 6.0), (18.0, 8.0), (25.0, 10.0), (30.0, 12.0)] {
        let car =
            |id: &str, x_m: f64, speed_mps: f64| agent(id, AgentType::Vehicle, (x_m, -1.75), 0.0, speed_mps);
        let cars =
            vec![car("1", -60.0, speed_mps), car("2", -60.0 + gap_m, 0.0), car("3", -52.0 + gap_m, 0.0)];
        let scene = Scene::bare("queue", map.clone(), cars).checked().unwrap();
        let answer = run(&GENERATOR, only_the_first(scene.clone()));
        let over_m = shown(&answer).states.iter().map(|s| s.y_m).fold(f64::MIN, f64::max);
        assert!(!meets(&scene, shown(&answer)), "{gap_m}");
        assert!(over_m < 0.0, "{gap_m}: {over_m}");
    }
}

#[test]
fn a_goal_on_an_agent_that_stands_is_stopped_short_of_and_the_collision_is_among_the_six() {
    let scene = blocked(street(), -6.0);
    let answer = run(&GENERATOR, only_the_first(scene.clone()));
    let ReachReport::Unreachable { with, .. } = &answer.resolved["1"].reach else { panic!("reached") };
    assert_eq!(with.as_deref(), Some("2"));
    assert!(!meets(&scene, shown(&answer)));
    assert!(answer.samples[0].agents["1"].modes.iter().any(|future| meets(&scene, future)));
}

#[test]
fn the_way_round_stays_while_the_goal_moves_by_little() {
    let scene = blocked(two_lanes(), 30.0);
    let first = run(&GENERATOR, only_the_first(scene.clone()));
    let states = &shown(&first).states;
    let places = states.iter().skip(4).step_by(5).map(State::position).collect();
    for x_m in [30.05, 29.95] {
        let mut again = only_the_first(blocked(two_lanes(), x_m));
        again.shown =
            [("1".to_owned(), ShownLast { anchor: shown(&first).anchor, places: Vec::clone(&places) })]
                .into_iter()
                .collect();
        let again = run(&GENERATOR, again);
        let apart =
            states.iter().zip(&shown(&again).states).map(|(a, b)| (a.position() - b.position()).norm());
        let most_m = apart.fold(0.0, f64::max);
        assert!(most_m < 0.6, "{most_m}");
    }
}

#[test]
fn beyond_a_goal_the_way_goes_on_along_the_lane() {
    // Straight on to the origin, then a quarter circle of 30 m radius to the left, then north.
    let straight = (0..100).map(|i| Vec2::new(f64::from(i) - 100.0, 0.0));
    let bend = (0..=47).map(|i| {
        let turned = f64::from(i) / 30.0;
        Vec2::new(30.0 * turned.sin(), 30.0 - 30.0 * turned.cos())
    });
    let end = Vec2::new(30.0, 30.0);
    let north = (1..100).map(|i| end + Vec2::new(0.0, f64::from(i)));
    let points: Vec<Vec2> = straight.chain(bend).chain(north).collect();
    let lane = Lane { width_m: Some(3.5), ..Lane::street("a", points.clone()) };
    let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
    let mut car = agent("1", AgentType::Vehicle, (-30.0, 0.0), 0.0, 10.0);
    car.conditions.goal = Goal { position: Some(Vec2::new(-2.0, 0.0)), time_s: Some(3.0), ..Goal::default() };
    let scene = Scene::bare("bend", map, vec![car]).checked().unwrap();
    let answer = run(&GENERATOR, ask(scene, Some(&["1"])));
    for future in &answer.samples[0].agents["1"].modes {
        let off = |s: &State| points.iter().map(|p| (p - s.position()).norm()).fold(f64::INFINITY, f64::min);
        let farthest_m = future.states.iter().map(off).fold(0.0, f64::max);
        assert!(farthest_m < 2.0, "{farthest_m}");
        assert!(future.states.last().unwrap().y_m > 15.0);
    }
}
