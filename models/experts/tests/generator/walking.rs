//! Pedestrians at a street.

use super::crossing::{agent, street};
use super::{GENERATOR, ask, run};
use scene::{AgentType, Goal, Scene, Signal, SignalState, Vec2};
use std::f64::consts::FRAC_PI_2;

/// Steps at which a pedestrian that walks north is on the street, from y = -3.5 to 0.
fn on_street(scene: Scene) -> Vec<usize> {
    let futures = run(&GENERATOR, ask(scene, Some(&["1"]))).samples.remove(0).agents.remove("1").unwrap();
    let states = &futures.modes[futures.chosen].states;
    (0..states.len()).filter(|i| (-3.5..0.0).contains(&states[*i].y_m)).collect()
}

#[test]
fn nobody_steps_out_before_a_fast_car() {
    let walker = agent("1", AgentType::Pedestrian, (0.0, -7.0), FRAC_PI_2, 1.4);
    let alone = on_street(Scene::bare("street", street(), vec![walker.clone()]));
    assert!(alone.iter().any(|i| (25..45).contains(i)), "it would be there with the car: {alone:?}");
    let car = agent("2", AgentType::Vehicle, (-45.0, -1.75), 0.0, 12.0);
    let found = on_street(Scene::bare("street", street(), vec![walker, car]));
    assert!(found.iter().all(|i| !(20..40).contains(i)), "{found:?}");
}

#[test]
fn a_walker_whose_crosswalk_has_red_waits_at_the_kerb_and_is_still_in_time() {
    let mut walker = agent("1", AgentType::Pedestrian, (0.0, -6.5), FRAC_PI_2, 1.3);
    let goal = Vec2::new(0.0, 2.5);
    walker.conditions.goal = Goal { position: Some(goal), time_s: Some(9.0), ..Goal::default() };
    let lit = |red_from: usize| Signal {
        lane: "a".into(),
        stop: Some(Vec2::new(-4.0, -1.75)),
        stop_z_m: None,
        runs: vec![(0, SignalState::Go), (red_from, SignalState::Stop)],
    };
    let of = |red_from: usize| {
        let scene = Scene::bare("street", street(), vec![walker.clone()]);
        on_street(Scene { signals: vec![lit(red_from)], ..scene })
    };
    let (free, waits) = (of(1), of(35));
    assert!(free[0] < 32, "{free:?}");
    assert!((34..50).contains(&waits[0]) && waits.len() < 40, "{waits:?}");
}
