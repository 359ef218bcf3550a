//! Via points: every future passes them if possible within the limits, and missed ones are reported.

use super::*;
use scene::judge::FaultKind;
use scene::via::passings;
use scene::{Passing, Via};

fn via(x: f64, y: f64, tolerance_m: f64, time_s: Option<f64>) -> Via {
    Via { position: Vec2::new(x, y), tolerance_m, time_s }
}

/// A scene with only this road user, with these via points and this goal at the end.
fn asked(id: &str, vias: &[Via], goal: Option<(f64, f64)>) -> Scene {
    let mut scene = crossing();
    scene.agents.retain(|a| a.id == id);
    scene.agents[0].conditions.via = vias.to_vec();
    scene.agents[0].conditions.goal.position = goal.map(|(x, y)| Vec2::new(x, y));
    scene
}

/// How each future of the answer passes each via point.
fn passed(scene: &Scene, answer: &Answer) -> Vec<Vec<Passing>> {
    let agent = &scene.agents[0];
    let start = agent.state_at(0).unwrap();
    let all = |future: &Future| {
        let states: Vec<State> = std::iter::once(start).chain(future.states.iter().copied()).collect();
        passings(&agent.conditions.via, 0.0, &states)
    };
    answer.samples[0].agents[&agent.id].modes.iter().map(all).collect()
}

fn all_pass(scene: &Scene, answer: &Answer, what: &str) {
    let agent = &scene.agents[0];
    for (future, passed) in answer.samples[0].agents[&agent.id].modes.iter().zip(passed(scene, answer)) {
        for (via, passing) in agent.conditions.via.iter().zip(&passed) {
            assert!(via.is_passed(passing), "{what}: {passing:?} of {via:?}");
        }
        let excess = excess(scene, &agent.id, future);
        assert!(excess <= 0.0, "{what}: {excess} beyond a limit");
        assert!(future.about.faults.iter().all(|f| f.kind != FaultKind::ViaMissed), "{what}");
    }
    let resolved = &answer.resolved[&agent.id];
    assert_eq!(resolved.via.len(), agent.conditions.via.len());
    assert!(resolved.via.iter().all(|via| via.passed), "{what}: {:?}", resolved.via);
}

/// Id, via points, and goal.
type Case<'a> = (&'a str, &'a [Via], Option<(f64, f64)>);

#[test]
fn all_futures_pass_where_a_lane_leads_there() {
    // Straight on, around the corner, across, on foot.
    let cases: [Case<'_>; 8] = [
        ("1", &[via(0.0, -1.75, 0.5, None)], Some((40.0, -1.75))),
        ("1", &[via(-20.0, -1.75, 0.5, None), via(20.0, -2.25, 0.5, None)], Some((50.0, -1.75))),
        ("1", &[via(1.75, 20.0, 0.5, None)], None),
        ("1", &[via(1.75, 14.0, 0.5, None)], Some((1.75, 32.0))),
        ("4", &[via(1.75, 0.0, 0.5, None)], Some((1.75, 20.0))),
        ("4", &[via(1.2, -5.0, 0.5, None)], None),
        ("5", &[via(-10.0, 0.0, 0.5, None)], Some((-12.0, -6.0))),
        ("5", &[via(-13.5, 1.0, 0.5, None)], None),
    ];
    for (id, vias, goal) in cases {
        let scene = asked(id, vias, goal);
        for diversity in [0.0, 1.0, 2.0] {
            let request = Request { diversity, seed: 5, ..ask(scene.clone(), None) };
            let answer = run(&GENERATOR, request);
            all_pass(&scene, &answer, &format!("{id} {vias:?} {goal:?} at {diversity}"));
            if let Some((x, y)) = goal {
                let ends = answer.samples[0].agents[id].modes.iter().map(|m| m.states[89].position());
                ends.for_each(|end| assert!((end - Vec2::new(x, y)).norm() < 0.1, "{id}: {end:?}"));
            }
        }
    }
}

#[test]
fn a_time_is_kept() {
    // At a constant pace it is there after 5 s.
    for (time_s, goal) in [(4.0, Some((40.0, -1.75))), (6.5, Some((30.0, -1.75))), (6.0, None), (3.5, None)] {
        let vias = [via(0.0, -1.75, 1.0, Some(time_s))];
        let scene = asked("1", &vias, goal);
        let answer = run(&GENERATOR, ask(scene.clone(), None));
        all_pass(&scene, &answer, &format!("{time_s} {goal:?}"));
    }
}

#[test]
fn what_is_missed_is_said() {
    // Beside the car, where no vehicle can turn that far; and farther than it gets.
    for (x, y, time_s) in [(-38.0, 8.0, None), (80.0, -1.75, Some(2.0))] {
        let vias = [via(x, y, 1.0, time_s)];
        let scene = asked("1", &vias, Some((30.0, -1.75)));
        let answer = run(&GENERATOR, ask(scene.clone(), None));
        let resolved = answer.resolved["1"].via[0];
        assert!(!resolved.passed && resolved.distance_m > 1.0, "{resolved:?}");
        let futures = &answer.samples[0].agents["1"];
        let chosen = &futures.modes[futures.chosen];
        let fault = chosen.about.faults.iter().find(|f| f.kind == FaultKind::ViaMissed).unwrap();
        assert!((fault.extent.unwrap() - resolved.distance_m).abs() < 0.01, "{fault:?} {resolved:?}");
        assert!(answer.warnings.iter().any(|w| w.code == WarningCode::ViaMissed));
    }
}

#[test]
fn via_points_hold_over_several_windows() {
    for interval in [30, 60, 90] {
        for (vias, goal, time_s) in [
            (
                vec![via(-10.0, -1.75, 1.0, None), via(50.0, -1.75, 1.0, None)],
                Some((90.0, -1.75)),
                Some(18.0),
            ),
            (vec![via(60.0, -1.75, 1.0, Some(14.0))], None, None),
            (vec![via(1.75, 30.0, 1.0, None)], Some((1.75, 70.0)), Some(16.0)),
        ] {
            let mut scene = asked("1", &vias, goal);
            scene.agents[0].conditions.goal.time_s = time_s;
            let request = Request {
                horizon_steps: 200,
                replan_steps: Some(interval),
                steps: 2,
                ..ask(scene.clone(), None)
            };
            let answer = run(&GENERATOR, request);
            let resolved = &answer.resolved["1"];
            assert!(resolved.via.iter().all(|v| v.passed), "{interval} {goal:?}: {:?}", resolved.via);
            assert!(
                goal.is_none() || matches!(resolved.reach, ReachReport::Reached { .. }),
                "{interval} {goal:?}: {:?}",
                resolved.reach
            );
        }
    }
}

#[test]
fn without_via_points_nothing_changes_and_with_them_it_repeats() {
    let vias = [via(0.0, -2.0, 1.0, Some(5.0))];
    let scene = asked("1", &vias, Some((30.0, -1.75)));
    let twice = [(); 2].map(|()| run(&GENERATOR, ask(scene.clone(), None)).samples);
    assert!(twice[0] == twice[1]);
    assert!(answer_of_nobody_led().resolved["1"].via.is_empty());
}

fn answer_of_nobody_led() -> Answer {
    run(&GENERATOR, ask(asked("1", &[], Some((30.0, -1.75))), None))
}
