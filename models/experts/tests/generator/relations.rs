//! Goals relative to another agent, resolved from its motion, even if the same call plans it.

use super::crossing::{agent, crossing};
use super::{GENERATOR, ask, run};
use experts::request::Source;
use experts::{Answer, Limiting, ReachReport, React, Request};
use scene::{Agent, AgentType, Future, Goal, GoalRelation, RelativePlace, Scene, State, Vec2};

/// Car 2, behind car 1 in its lane, has a goal at 6 s with a gap to it.
fn behind(gap_m: f64) -> Scene {
    let mut scene = crossing();
    relate(&mut scene.agents[1], "1", RelativePlace::Behind(gap_m));
    scene
}

fn relate(agent: &mut Agent, to: &str, place: RelativePlace) {
    let relation = GoalRelation { to: to.into(), place, slower_mps: 0.0, lanes_left: 0 };
    agent.conditions.goal = Goal { time_s: Some(6.0), ..Goal::default() };
    agent.conditions.relation = Some(relation);
}

fn shown<'a>(answer: &'a Answer, id: &str) -> &'a Future {
    let futures = &answer.samples[0].agents[id];
    &futures.modes[futures.chosen]
}

/// State at 6 s.
fn due(future: &Future) -> State {
    future.states[60 - future.first_step]
}

/// Gap between the boxes of two cars in a row.
fn gap_m(scene: &Scene, ahead: &State, behind: &State) -> f64 {
    let length_m = |i: usize| scene.agents[i].size.length_m;
    (ahead.position() - behind.position()).norm() - 0.5 * (length_m(0) + length_m(1))
}

#[test]
fn a_gap_is_kept_to_a_recorded_motion() {
    let scene = behind(8.0);
    let answer = run(&GENERATOR, ask(scene.clone(), Some(&["2"])));
    let resolved = &answer.resolved["2"];
    assert!(matches!(resolved.reach, ReachReport::Reached { .. }), "{:?}", resolved.reach);
    assert_eq!(resolved.goal.x_m.from, Source::Relation);
    assert_eq!(resolved.goal.time_s.from, Source::User);
    let (ahead, own) = (scene.agents[0].track.at(60).unwrap(), due(shown(&answer, "2")));
    assert!((gap_m(&scene, ahead, &own) - 8.0).abs() < 0.1, "{}", gap_m(&scene, ahead, &own));
    assert!((own.speed_mps() - 8.0).abs() < 0.1);
}

#[test]
fn the_other_one_is_planned_first_and_keeps_its_futures() {
    let mut scene = behind(8.0);
    scene.agents[0].conditions.goal = Goal { position: Some(Vec2::new(30.0, -1.75)), ..Goal::default() };
    let call = |agents: Option<&[&str]>| run(&GENERATOR, ask(scene.clone(), agents));
    let both = call(Some(&["1", "2"]));
    let (ahead, own) = (due(shown(&both, "1")), due(shown(&both, "2")));
    assert!((gap_m(&scene, &ahead, &own) - 8.0).abs() < 0.1, "{}", gap_m(&scene, &ahead, &own));
    // The future of the other agent equals that of a call without the relation.
    let mut apart = scene.clone();
    (apart.agents[1].conditions.relation, apart.agents[1].conditions.goal) = (None, Goal::default());
    let apart = run(&GENERATOR, ask(apart, Some(&["1", "2"])));
    let states = |answer: &Answer| -> Vec<Vec<State>> {
        answer.samples[0].agents["1"].modes.iter().map(|mode| mode.states.clone()).collect()
    };
    assert_eq!(states(&both), states(&apart));
    assert_eq!(both.samples[0].agents["1"].modes.len(), 6);
    assert!(matches!(both.resolved["1"].reach, ReachReport::Reached { .. }));
    // Equal calls give equal bytes, whatever the order of the agents.
    assert!(call(Some(&["1", "2"])).samples == both.samples);
    let mut turned = scene.clone();
    turned.agents.reverse();
    assert!(run(&GENERATOR, ask(turned, Some(&["1", "2"]))).samples == both.samples);
}

#[test]
fn who_may_react_keeps_its_relation_to_a_regenerated_agent() {
    let scene = behind(8.0);
    let answer = run(&GENERATOR, Request { react: React::Everyone, ..ask(scene.clone(), Some(&["1"])) });
    let (ahead, own) = (due(shown(&answer, "1")), due(shown(&answer, "2")));
    assert!((gap_m(&scene, &ahead, &own) - 8.0).abs() < 0.1, "{}", gap_m(&scene, &ahead, &own));
    let alone = run(&GENERATOR, ask(scene, Some(&["1"])));
    assert!(!alone.samples[0].agents.contains_key("2"));
}

#[test]
fn relations_are_placed_one_after_the_other() {
    let mut scene = behind(8.0);
    // Straight on: in a turn the gap along the lane is longer than the straight line.
    scene.agents[0].conditions.goal = Goal { position: Some(Vec2::new(30.0, -1.75)), ..Goal::default() };
    let mut third = agent("7", AgentType::Vehicle, (-75.0, -1.75), 0.0, 9.0);
    relate(&mut third, "2", RelativePlace::Behind(6.0));
    scene.agents.push(third);
    let answer = run(&GENERATOR, ask(scene.clone(), Some(&["1", "2", "7"])));
    let (second, last) = (due(shown(&answer, "2")), due(shown(&answer, "7")));
    let lengths_m = 0.5 * (scene.agents[1].size.length_m + scene.agents[6].size.length_m);
    let gap_m = (second.position() - last.position()).norm() - lengths_m;
    assert!((gap_m - 6.0).abs() < 0.1, "{gap_m}");
}

#[test]
fn beyond_a_window_the_relation_holds_too() {
    let mut scene = behind(10.0);
    scene.agents[1].conditions.goal.time_s = Some(12.0);
    let request = Request { horizon_steps: 150, ..ask(scene.clone(), Some(&["1", "2"])) };
    let answer = run(&GENERATOR, request);
    let at = |id: &str| shown(&answer, id).states[120 - shown(&answer, id).first_step];
    let gap_m = gap_m(&scene, &at("1"), &at("2"));
    assert!((gap_m - 10.0).abs() < 0.5, "{gap_m} {:?}", answer.resolved["2"].reach);
}

#[test]
fn a_relation_without_a_place_says_why() {
    let mut scene = behind(8.0);
    scene.agents[1].conditions.relation.as_mut().unwrap().lanes_left = 1;
    let answer = run(&GENERATOR, ask(scene, Some(&["2"])));
    let ReachReport::Unreachable { limiting, words, message, with, .. } = &answer.resolved["2"].reach else {
        panic!("{:?}", answer.resolved["2"].reach);
    };
    assert_eq!((*limiting, message.code), (Limiting::Relation, "relation-no-lane-left"));
    assert_eq!(
        (words.as_str(), with.as_deref()),
        ("Lane 1 to the left of road user 1 does not exist at 6.0 s.", Some("1"))
    );
    assert!(answer.warnings.iter().any(|warning| warning.message.code == "relation-no-lane-left"));
}

#[test]
fn a_place_is_reached_after_another_one_has_passed_it() {
    let mut scene = crossing();
    relate(&mut scene.agents[1], "1", RelativePlace::After(1.5));
    scene.agents[1].conditions.goal = Goal { position: Some(Vec2::new(4.0, -1.75)), ..Goal::default() };
    let answer = run(&GENERATOR, ask(scene, Some(&["2"])));
    // Car 1 comes from -40 m at 8 m/s.
    assert_eq!(answer.resolved["2"].goal.time_s.value, 7.0);
    assert_eq!(answer.resolved["2"].goal.time_s.from, Source::Relation);
    let own = shown(&answer, "2").states[70 - shown(&answer, "2").first_step];
    assert!((own.position() - Vec2::new(4.0, -1.75)).norm() < 0.1, "{own:?}");
}
