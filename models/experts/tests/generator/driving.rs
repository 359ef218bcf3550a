//! Futures follow good driving practice, with the shipped weights.

use super::run;
use experts::{Engine, Generator, ReachReport, React, Request};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::map::{Lane, LaneMap};
use scene::{Agent, AgentType, Future, Goal, STEP_S, Sample, Scene, Start, State, Subtype, Vec2, wrap_angle};
use std::sync::{Arc, LazyLock};

/// The shipped engine.
pub static SHIPPED: LazyLock<Generator> =
    LazyLock::new(|| Engine::built_in().unwrap().generator.with_threads(1));

/// A car that goes straight on for the whole recording.
fn car(id: &str, x_m: f64, y_m: f64, speed_mps: f64) -> Agent {
    let at = |i: usize| State {
        x_m: x_m + STEP_S * speed_mps * i as f64,
        y_m,
        vx_mps: speed_mps,
        ..State::default()
    };
    Agent::bare(id, AgentType::Vehicle, Subtype::Car, (0..=90).map(|i| Some(at(i))).collect())
}

fn lane(id: &str, y_m: f64) -> Lane {
    Lane::street(id, (0..=400).map(|i| Vec2::new(f64::from(i) - 100.0, y_m)).collect::<Vec<_>>())
}

fn ask(lanes: Vec<Lane>, agents: Vec<Agent>, asked: &[&str]) -> Request {
    let map = LaneMap { lanes, ..LaneMap::default() };
    let mut request = Request::new(Arc::new(Scene::bare("driving", map, agents)));
    request.agents = Some(asked.iter().map(|id| (*id).to_owned()).collect());
    request.react = React::Everyone;
    request
}

/// The shown future of an agent.
pub fn shown<'a>(sample: &'a Sample, id: &str) -> &'a Future {
    let futures = &sample.agents[id];
    &futures.modes[futures.chosen]
}

/// Greatest lateral acceleration between steps 0.2 s apart, m/s2.
fn sideways(future: &Future) -> f64 {
    let turn = |w: &[State]| wrap_angle(w[2].heading_rad - w[0].heading_rad).abs() / (2.0 * STEP_S);
    future.states.windows(3).map(|w| turn(w) * w[1].speed_mps()).fold(0.0, f64::max)
}

/// Greatest change of acceleration, m/s3.
fn jerk(states: &[State]) -> f64 {
    let speed: Vec<f64> = states.iter().map(State::speed_mps).collect();
    let change = |w: &[f64]| (w[2] - 2.0 * w[1] + w[0]).abs() / (STEP_S * STEP_S);
    speed.windows(3).map(change).fold(0.0, f64::max)
}

#[test]
fn bends_on_the_way_to_a_goal_are_slowed_for() {
    // 40 m straight on, a quarter turn to the left, 60 m on.
    for radius in [8.0, 15.0, 30.0] {
        let quarter = std::f64::consts::FRAC_PI_2;
        let arc_m = radius * quarter;
        let at = |s: f64| match s {
            s if s < 40.0 => Vec2::new(s, 0.0),
            s if s < 40.0 + arc_m => {
                let turned = (s - 40.0) / radius;
                Vec2::new(40.0 + radius * turned.sin(), radius * (1.0 - turned.cos()))
            }
            s => Vec2::new(40.0 + radius, radius + s - 40.0 - arc_m),
        };
        let points: Vec<Vec2> = (0..=(100.0 + arc_m) as usize).map(|s| at(s as f64)).collect();
        let mut turning = car("1", 0.0, 0.0, 13.9);
        // An average of 7 m/s leaves time for the bend.
        turning.conditions.goal = Goal { position: Some(at(63.0)), ..Goal::default() };
        let answer = run(&SHIPPED, ask(vec![Lane::street("bend", points)], vec![turning], &["1"]));
        for future in &answer.samples[0].agents["1"].modes {
            assert!(sideways(future) < 3.7, "radius {radius}: {:.1} m/s2", sideways(future));
        }
        assert!(matches!(answer.resolved["1"].reach, ReachReport::Reached { .. }), "radius {radius}");
    }
}

#[test]
fn a_late_arrival_that_cannot_brake_in_time_enters_slower() {
    let mut slow = car("1", 0.0, 0.0, 10.0);
    slow.conditions.goal = Goal { position: Some(Vec2::new(40.0, 0.0)), ..Goal::default() };
    // A second car enters 3 s later, a few metres behind, at 20 m/s.
    let mut late = car("2", 10.0, 0.0, 20.0);
    late.track.first_step = 30;
    late.track.states.truncate(61);
    let (of_slow, of_late) = (slow.clone(), late.clone());
    let answer = run(&SHIPPED, ask(vec![lane("one", 0.0)], vec![slow, late], &["1"]));
    let (first, second) = (shown(&answer.samples[0], "1"), shown(&answer.samples[0], "2"));
    assert_eq!(second.first_step, 30, "its first state is another");
    assert!(second.states[0].speed_mps() < 15.0, "{:?}", second.states[0]);
    assert_eq!(second.states[0].position(), Vec2::new(10.0, 0.0));
    for (i, state) in second.states.iter().enumerate() {
        let before = first.states[second.first_step + i - first.first_step];
        let (a, b) =
            (OrientedBox::of_state(&before, &of_slow.size), OrientedBox::of_state(state, &of_late.size));
        assert!(!overlaps(&a, &b, 0.0), "{} s", (second.first_step + i) as f64 * STEP_S);
    }
}

#[test]
fn an_agent_that_is_cut_in_upon_brakes_in_its_lane() {
    brakes_in_its_lane(Start::default());
}

#[test]
fn an_agent_with_a_typed_start_that_is_cut_in_upon_brakes_in_its_lane() {
    brakes_in_its_lane(Start {
        position: Some(Vec2::zeros()),
        heading_rad: Some(0.0),
        speed_mps: Some(13.9),
    });
}

/// Asserts that the car behind a cut-in brakes in its lane, with this start.
fn brakes_in_its_lane(start: Start) {
    for (gap_m, slower_mps) in [(5.0, 2.5), (10.0, 2.5), (10.0, 5.0), (20.0, 5.0), (20.0, 7.5), (30.0, 7.5)] {
        let (mut behind, speed_mps) = (car("1", 0.0, 0.0, 13.9), 13.9 - slower_mps);
        behind.conditions.start = start;
        let mut cuts_in = car("2", gap_m + 4.6, -3.25, speed_mps);
        let goal = Vec2::new(gap_m + 4.6 + 4.0 * speed_mps, 0.0);
        cuts_in.conditions.goal =
            Goal { position: Some(goal), speed_mps: Some(speed_mps), time_s: Some(4.0), heading_rad: None };
        let lanes = vec![lane("left", 0.0), lane("right", -3.25)];
        let answer = run(&SHIPPED, ask(lanes, vec![behind, cuts_in], &["2"]));
        let sample = &answer.samples[0];
        let (one, two) = (&shown(sample, "1").states, &shown(sample, "2").states);
        let case = format!("gap {gap_m} m, {slower_mps} m/s slower");
        assert!(sample.agents["1"].reaction.is_some(), "{case}");
        assert!(one.iter().all(|s| s.y_m.abs() < 0.3), "{case}: leaves its lane");
        let slowest = one.iter().map(State::speed_mps).fold(f64::INFINITY, f64::min);
        assert!(slowest < 13.0, "{case}: {slowest} m/s");
        let gap = |(a, b): (&State, &State)| {
            let (ahead, aside) = ((b.x_m - a.x_m).abs() - 4.6, (b.y_m - a.y_m).abs() - 1.9);
            ahead.max(aside)
        };
        let gap_m = one.iter().zip(two).map(gap).fold(f64::INFINITY, f64::min);
        assert!(gap_m > 0.9, "{case}: {gap_m} m");
        assert!(jerk(one) < 15.0, "{case}: {} m/s3", jerk(one));
    }
}

#[test]
fn a_queue_moves_off_one_after_the_other_and_what_is_parked_stays() {
    // The first one rolls; another stands beside the lane.
    let queue = [("1", 0.0, 0.1), ("2", -7.0, 0.0), ("3", -14.0, 0.0)];
    let mut agents: Vec<Agent> = queue.map(|(id, x_m, speed_mps)| car(id, x_m, 0.0, speed_mps)).into();
    agents.push(car("4", 10.0, -2.2, 0.0));
    let answer = run(&SHIPPED, ask(vec![lane("a", 0.0)], agents, &["1", "2", "3", "4"]));
    let sample = &answer.samples[0];
    let leaves = |id: &str| {
        let states = &shown(sample, id).states;
        states.iter().position(|s| (s.x_m - states[0].x_m).abs() > 0.5)
    };
    let [first, second, third] = ["1", "2", "3"].map(|id| leaves(id).unwrap());
    assert!(first < second && second < third, "{first}, {second}, {third}");
    assert_eq!(leaves("4"), None);
}

#[test]
fn a_column_brakes_one_after_the_other_behind_what_stands() {
    let ahead = car("ahead", 60.0, 0.0, 0.0);
    let column = (0..5).map(|i| car(&format!("c{i}"), -15.0 * f64::from(i), 0.0, 12.0));
    let agents: Vec<Agent> = std::iter::once(ahead).chain(column).collect();
    let (size, ids) = (agents[0].size, agents.iter().map(|agent| agent.id.to_string()).collect::<Vec<_>>());
    let asked: Vec<&str> = ids.iter().map(String::as_str).collect();
    let answer = run(&SHIPPED, ask(vec![lane("a", 0.0)], agents, &asked));
    let outlines = |id: &str| {
        let states = &shown(&answer.samples[0], id).states;
        states.iter().map(|state| OrientedBox::of_state(state, &size)).collect::<Vec<_>>()
    };
    for pair in asked.windows(2) {
        let (front, rear) = (outlines(pair[0]), outlines(pair[1]));
        let touch = front.iter().zip(&rear).position(|(f, r)| overlaps(f, r, 0.0));
        assert!(touch.is_none(), "{} runs into {} after {touch:?} steps", pair[1], pair[0]);
    }
}

#[test]
fn thresholds_of_a_call_change_no_motion() {
    let shown_by = |harsh_brake_mps2: f64| {
        let mut dragged = car("1", 0.0, 0.0, 12.0);
        dragged.conditions.goal = Goal { position: Some(Vec2::new(60.0, 0.0)), ..Goal::default() };
        let mut request = ask(vec![lane("a", 0.0)], vec![dragged, car("2", 30.0, 0.0, 4.0)], &["1"]);
        request.thresholds.harsh_brake_mps2 = harsh_brake_mps2;
        let answer = run(&SHIPPED, request);
        shown(&answer.samples[0], "1").states.clone()
    };
    assert!(shown_by(0.1) == shown_by(4.0));
}
