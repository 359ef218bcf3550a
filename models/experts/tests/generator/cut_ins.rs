//! Cut-ins on the roads of an example, with the shipped weights: who is behind stays in its lane and brakes.

use super::driving::{SHIPPED, shown};
use super::run;
use experts::{React, Request};
use formats::native;
use scene::map::LaneMap;
use scene::routes::{LaneGraph, Polyline, best_route_ahead};
use scene::{Agent, AgentType, Goal, STEP_S, Scene, Start, State, Subtype, Vec2};
use std::path::Path;
use std::sync::Arc;

/// How the motion of the agents is given.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Given {
    /// A recording of 9 s along the lane.
    Recording,
    /// One state.
    OneState,
    /// One state, and the same start as a condition.
    TypedStart,
}

/// Place of the first car along its lane, metres.
const FROM_M: f64 = 10.0;
/// Length of a car, metres.
const CAR_M: f64 = 4.6;
/// When the cut-in is done, seconds.
const DUE_S: f64 = 5.0;

fn map(example: &str) -> LaneMap {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{example}.json"));
    let doc = native::read_doc(&std::fs::read(path).unwrap()).unwrap();
    (*doc.into_scene(|_| None).unwrap().map).clone()
}

/// The middle of the road from the start of a lane on.
fn way(map: &LaneMap, graph: &LaneGraph, lane: &str) -> Polyline {
    let lane = map.lanes.iter().find(|l| l.id == lane).unwrap();
    let start = Polyline::new(lane.points.xy.iter().copied()).first();
    best_route_ahead(graph, start, AgentType::Vehicle, 350.0).unwrap().path
}

fn state(way: &Polyline, along_m: f64, speed_mps: f64) -> State {
    let pose = way.sample(along_m);
    let ahead = pose.direction() * speed_mps;
    let (position, heading_rad) = (pose.position, pose.heading_rad);
    State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: ahead.x, vy_mps: ahead.y }
}

fn car(id: &str, way: &Polyline, along_m: f64, speed_mps: f64, given: Given) -> Agent {
    let steps = if given == Given::Recording { 90 } else { 0 };
    let at = |i: usize| state(way, along_m + speed_mps * STEP_S * i as f64, speed_mps);
    let states = (0..=steps).map(|i| Some(at(i))).collect();
    let mut car = Agent::bare(id, AgentType::Vehicle, Subtype::Car, states);
    if given == Given::TypedStart {
        let start = at(0);
        car.conditions.start = Start {
            position: Some(start.position()),
            heading_rad: Some(start.heading_rad),
            speed_mps: Some(speed_mps),
        };
    }
    car
}

/// Asserts that the car on lane `own` brakes in its lane where one on `other` cuts in this far ahead and this
/// much slower.
fn brakes_in_its_lane(map: &LaneMap, (own, other): (&str, &str), speed_mps: f64, cases: &[(f64, f64)]) {
    let graph = LaneGraph::new(map);
    let (mine, theirs) = (way(map, &graph, own), way(map, &graph, other));
    for given in [Given::Recording, Given::OneState, Given::TypedStart] {
        for (gap_m, slower_mps) in cases {
            let (slow_mps, ahead_m) = (speed_mps - slower_mps, FROM_M + CAR_M + gap_m);
            let behind = car("1", &mine, FROM_M, speed_mps, given);
            let mut cuts_in = car("2", &theirs, ahead_m, slow_mps, given);
            let goal: Vec2 = mine.sample(ahead_m + DUE_S * slow_mps).position;
            cuts_in.conditions.goal = Goal {
                position: Some(goal),
                speed_mps: Some(slow_mps),
                time_s: Some(DUE_S),
                heading_rad: None,
            };
            let mut request =
                Request::new(Arc::new(Scene::bare("cut in", map.clone(), vec![behind, cuts_in])));
            request.agents = Some(std::iter::once("2".to_owned()).collect());
            request.react = React::Everyone;
            let answer = run(&SHIPPED, request);
            let sample = &answer.samples[0];
            let case = format!("lane {own}, {given:?}, gap {gap_m} m, {slower_mps} m/s slower");
            assert!(sample.agents.get("1").is_some_and(|a| a.reaction.is_some()), "{case}: no reaction");
            let states = &shown(sample, "1").states;
            let aside = |s: &State| mine.project(s.position()).lateral_m.abs();
            let aside_m = states.iter().map(aside).fold(0.0, f64::max);
            let slowest = states.iter().map(State::speed_mps).fold(f64::INFINITY, f64::min);
            assert!(aside_m < 0.8, "{case}: {aside_m:.2} m from the middle of its lane");
            assert!(slowest < speed_mps - 1.0, "{case}: {slowest:.1} m/s");
        }
    }
}

#[test]
fn an_agent_that_is_cut_in_upon_on_an_arterial_road_brakes_in_its_lane() {
    let map = map("demo-arterial");
    let cases = [(10.0, 2.5), (20.0, 5.0), (20.0, 7.5), (30.0, 7.5)];
    brakes_in_its_lane(&map, ("152", "153"), 17.8, &cases);
    brakes_in_its_lane(&map, ("181", "180"), 17.8, &cases);
}

#[test]
fn an_agent_that_is_cut_in_upon_on_a_motorway_brakes_in_its_lane() {
    let map = map("demo-motorway");
    let cases = [(10.0, 2.5), (20.0, 5.0), (30.0, 7.5)];
    brakes_in_its_lane(&map, ("46", "47"), 26.8, &cases);
    brakes_in_its_lane(&map, ("49", "48"), 26.8, &cases);
}

#[test]
fn an_agent_restores_its_headway_to_one_that_cuts_in_at_its_own_speed() {
    let map = map("demo-arterial");
    brakes_in_its_lane(&map, ("152", "153"), 17.8, &[(5.0, 0.0), (10.0, 0.0)]);
}
