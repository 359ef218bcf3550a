//! Tests of walkers at a street with a crosswalk, on a hand-made scene.

use super::anchors::{Anchor, anchors};
use super::crossing::kerb;
use super::world::World;
use scene::map::{Area, Lane, LaneMap, TypedLine};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, HORIZON_STEPS, Scene, Signal, SignalState, State, Subtype, Vec2};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A street of two lanes along x with kerbs at y = 0 and y = 8, and a crosswalk over it from x = 10 to x = 14.
fn street() -> LaneMap {
    let line = |from: f64, to: f64, y: f64| -> Vec<Vec2> {
        (0..=20).map(|i| Vec2::new(from + (to - from) * f64::from(i) / 20.0, y)).collect()
    };
    let lane = |id: &str, points: Vec<Vec2>| Lane { width_m: Some(3.5), ..Lane::street(id, points) };
    let edge = |id: &str, y: f64| TypedLine {
        id: id.into(),
        line_type: "boundary".into(),
        points: line(-100.0, 100.0, y).into(),
    };
    let ring = [(10.0, 0.5), (14.0, 0.5), (14.0, 7.5), (10.0, 7.5)].map(|(x, y)| Vec2::new(x, y));
    LaneMap {
        lanes: vec![lane("east", line(-100.0, 100.0, 2.25)), lane("west", line(100.0, -100.0, 5.75))],
        road_edges: vec![edge("south", 0.0), edge("north", 8.0)],
        crosswalks: vec![Area { id: "walk".into(), polygon: ring.to_vec().into(), holes: Vec::new() }],
        ..LaneMap::default()
    }
}

/// A walker on the southern pavement at x, walking north, with a goal over the street.
fn walker(x: f64, speed_mps: f64, goal: (f64, f64), time_s: f64) -> Agent {
    let state = State { x_m: x, y_m: -2.0, heading_rad: FRAC_PI_2, vy_mps: speed_mps, ..State::default() };
    let mut walker = Agent::bare("1", AgentType::Pedestrian, Subtype::Adult, vec![Some(state)]);
    walker.conditions.goal =
        Goal { position: Some(Vec2::new(goal.0, goal.1)), time_s: Some(time_s), ..Goal::default() };
    walker
}

fn anchors_of(map: LaneMap, agent: Agent) -> Vec<Anchor> {
    let scene = Scene::bare("street", map, vec![agent]);
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = &world.present[0];
    anchors(&world, who, &world.model(who), &world.target(who))
}

/// The x coordinates of a path's places on the lanes.
fn on_lanes(anchor: &Anchor) -> Vec<f64> {
    let places = (0..200).map(|i| anchor.path.position_at(0.1 * f64::from(i)));
    places.filter(|p| (0.5..7.5).contains(&p.y)).map(|p| p.x).collect()
}

#[test]
fn a_goal_over_the_street_is_reached_by_the_crosswalk_where_there_is_time() {
    let found = anchors_of(street(), walker(6.0, 1.5, (8.0, 10.0), 9.0));
    let by_it = |a: &Anchor| on_lanes(a).iter().all(|x| (10.0..=14.0).contains(x));
    assert!(by_it(&found[0]), "{:?}", on_lanes(&found[0]));
    assert!(found.iter().any(|a| !by_it(a)), "straight on is still among the ways");
    for anchor in &found {
        let (there, _) = anchor.place(anchor.base[90], 0.0);
        assert!((there - Vec2::new(8.0, 10.0)).norm() < 0.6, "{there:?}");
        let fastest = (1..=HORIZON_STEPS).map(|i| (anchor.base[i] - anchor.base[i - 1]) / 0.1);
        assert!(fastest.fold(0.0, f64::max) < 2.0);
    }
}

#[test]
fn without_the_time_or_a_crosswalk_near_it_goes_straight() {
    let straight = |map: LaneMap, agent: Agent| {
        let found = anchors_of(map, agent);
        let identity = found[0].path_identity();
        assert!(found.iter().all(|a| a.path_identity() == identity));
        on_lanes(&found[0]).iter().all(|x| (5.5..8.5).contains(x))
    };
    assert!(straight(street(), walker(6.0, 1.5, (8.0, 10.0), 7.0)), "no time for the crosswalk");
    assert!(straight(LaneMap { crosswalks: Vec::new(), ..street() }, walker(6.0, 1.5, (8.0, 10.0), 9.0)));
    assert!(straight(street(), walker(6.0, 1.2, (7.0, 5.0), 9.0)), "a goal on the street itself");
    let far = walker(-30.0, 1.4, (-30.0, 10.0), 9.0);
    assert!(on_lanes(&anchors_of(street(), far)[0]).iter().all(|x| (-31.0..-29.0).contains(x)));
}

#[test]
fn whoever_walks_on_the_crosswalk_as_it_is_walks_on() {
    let found = anchors_of(street(), walker(12.0, 1.4, (12.0, 10.0), 9.0));
    assert!(on_lanes(&found[0]).iter().all(|x| (11.5..12.5).contains(x)));
    let identity = found[0].path_identity();
    assert!(found.iter().all(|a| a.path_identity() == identity));
}

/// The eastern lane has green until this step.
fn lit(agent: Agent, red_from: usize) -> Scene {
    let runs = vec![(0, SignalState::Go), (red_from, SignalState::Stop)];
    let stop = Some(Vec2::new(8.0, 2.25));
    let signal = Signal { lane: "east".into(), stop, stop_z_m: None, runs };
    Scene { signals: vec![signal], ..Scene::bare("street", street(), vec![agent]) }
}

/// Progress that waits for the lanes, and the line at which it waits.
fn waiting(scene: &Scene) -> (Option<[f64; HORIZON_STEPS + 1]>, f64) {
    let world = World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = &world.present[0];
    let (model, target) = (world.model(who), world.target(who));
    let anchor = anchors(&world, who, &model, &target).remove(0);
    let kerb = kerb(&world, who, &anchor.path).unwrap();
    let held = kerb.waiting(&anchor.base, model.start_speed_mps(), target.step);
    (held, kerb.line_m)
}

#[test]
fn at_a_crosswalk_whose_lanes_have_green_it_waits_at_the_kerb_and_goes_when_they_are_stopped() {
    let goal = (12.0, 9.0);
    let (held, line_m) = waiting(&lit(walker(12.0, 1.3, goal, 9.0), 25));
    let held = held.unwrap();
    assert!((1.0..2.0).contains(&line_m), "before the kerb at 2 m: {line_m}");
    assert!(held[..=25].iter().all(|m| *m <= line_m + 0.05), "{}", held[25]);
    assert!(held[24] > line_m - 0.4 && held[35] > line_m, "at the kerb, then off: {} {}", held[24], held[35]);
    assert!((held[90] - 11.0).abs() < 0.1, "{}", held[90]);
    assert!((1..=90).all(|i| held[i] - held[i - 1] < 0.181), "the pedestrian walks, without running");
}

#[test]
fn nobody_waits_for_lanes_that_are_stopped_or_when_the_time_is_too_short_or_on_the_street() {
    let goal = (12.0, 9.0);
    assert_eq!(waiting(&lit(walker(12.0, 1.3, goal, 9.0), 8)).0, None, "stopped by the time it is there");
    assert_eq!(waiting(&lit(walker(12.0, 1.3, goal, 9.0), 60)).0, None, "three seconds are too few");
    assert_eq!(waiting(&lit(walker(12.0, 1.3, goal, 9.0), 500)).0, None, "no stop of the lanes is known");
    let mut aside = walker(-20.0, 1.3, (-20.0, 9.0), 9.0);
    assert_eq!(waiting(&lit(aside.clone(), 25)).0, None, "no crosswalk there");
    aside.track.states[0].as_mut().unwrap().y_m = 3.0;
    let scene = Scene::bare("street", street(), vec![aside]);
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = &world.present[0];
    let anchor = anchors(&world, who, &world.model(who), &world.target(who)).remove(0);
    assert_eq!(kerb(&world, who, &anchor.path), None, "a pedestrian on the street walks on");
}
