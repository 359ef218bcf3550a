//! Planning window after window: one continuous future each, up to 20 s.

use super::*;

/// A call over several windows.
fn rollout(scene: Scene, agents: Option<&[&str]>, horizon_steps: usize, replan_steps: usize) -> Request {
    Request { horizon_steps, replan_steps: Some(replan_steps), steps: 2, ..ask(scene, agents) }
}

fn chosen<'a>(answer: &'a Answer, id: &str) -> &'a Future {
    let futures = &answer.samples[0].agents[id];
    &futures.modes[futures.chosen]
}

/// Without the two that conflict, so that goals are not given up for others.
fn quiet() -> Scene {
    let mut scene = crossing();
    scene.agents.retain(|a| ["1", "5", "6"].contains(&a.id.as_str()));
    scene
}

fn goal_at(mut scene: Scene, id: &str, goal: Goal) -> Scene {
    scene.agents.iter_mut().find(|a| a.id == id).unwrap().conditions.goal = goal;
    scene
}

#[test]
fn tracks_are_continuous_and_keep_the_limits_over_all_windows() {
    for (horizon, interval) in [(200, 30), (200, 60), (200, 90), (120, 90), (150, 60), (90, 30), (40, 30)] {
        let scene = crossing();
        let mut request = rollout(scene.clone(), None, horizon, interval);
        request.diversity = 2.0;
        let answer = run(&GENERATOR, request);
        assert_eq!(answer.windows, horizon.div_ceil(interval));
        for (id, futures) in &answer.samples[0].agents {
            let at = format!("{id}, {horizon} steps each {interval}");
            let future = &futures.modes[futures.chosen];
            assert_eq!((future.first_step, future.states.len()), (1, horizon), "{at}");
            let excess = excess(&scene, id, future);
            assert!(excess <= 0.0, "{at}: {excess} beyond a limit");
            for w in future.states.windows(2) {
                let moved = (w[1].position() - w[0].position()).norm();
                let mean = 0.5 * (w[0].speed_mps() + w[1].speed_mps());
                assert!((moved - 0.1 * mean).abs() < 0.06, "{at}: {moved} m at {mean} m/s");
                assert!((w[1].speed_mps() - w[0].speed_mps()).abs() < 0.9, "{at}");
                assert!(scene::wrap_angle(w[1].heading_rad - w[0].heading_rad).abs() < 0.36, "{at}");
            }
            for (i, mode) in futures.modes.iter().enumerate() {
                assert_eq!(mode.first_step, 1);
                assert!(i == futures.chosen || mode.states.len() == horizon.min(90), "{at}");
            }
        }
    }
}

#[test]
fn the_first_window_is_the_answer_of_a_single_one() {
    let nine = run(&GENERATOR, Request { steps: 2, ..ask(crossing(), None) });
    let twenty = run(&GENERATOR, rollout(crossing(), None, 200, 90));
    for (id, futures) in &nine.samples[0].agents {
        let first = &futures.modes[futures.chosen].states;
        assert!(chosen(&twenty, id).states[..90] == first[..], "{id}");
    }
}

#[test]
fn goals_of_later_windows_are_met() {
    // Two seconds after a seam, right after one, in the middle, at the very end.
    for (time_s, x_m, speed_mps) in
        [(11.0, 45.0, 8.0), (9.1, 30.0, 7.0), (15.0, 80.0, 9.0), (20.0, 60.0, 0.0)]
    {
        for interval in [30, 60, 90] {
            for subset in 1..8u8 {
                let goal = Goal {
                    position: (subset & 1 > 0).then(|| Vec2::new(x_m, -1.75)),
                    heading_rad: (subset & 2 > 0).then_some(0.0),
                    speed_mps: (subset & 4 > 0).then_some(speed_mps),
                    time_s: Some(time_s),
                };
                let scene = goal_at(quiet(), "1", goal);
                let answer = run(&GENERATOR, rollout(scene.clone(), Some(&["1"]), 200, interval));
                let at = format!("{time_s} s each {interval}, subset {subset:03b}");
                let future = chosen(&answer, "1");
                let end = future.states[(time_s * 10.0_f64).round() as usize - 1];
                let missed = goal.position.map_or(0.0, |p| (p - end.position()).norm());
                assert!(missed < 0.1, "{at}: {missed} m");
                let turned = goal.heading_rad.map_or(0.0, |h| scene::wrap_angle(h - end.heading_rad).abs());
                assert!(turned < 0.02, "{at}: {turned} rad");
                let faster = goal.speed_mps.map_or(0.0, |v| (v - end.speed_mps()).abs());
                assert!(faster < 0.1, "{at}: {faster} m/s");
                assert!(excess(&scene, "1", future) <= 0.0, "{at}");
                let resolved = &answer.resolved["1"];
                assert!(matches!(resolved.reach, ReachReport::Reached { .. }), "{at}: {:?}", resolved.reach);
                assert_eq!(resolved.goal.time_s.value, time_s);
                // A goal with only a heading gets a subgoal only when little time is left for it.
                let told = resolved.intermediate.iter().map(|i| i.window);
                assert!(subset == 2 || told.eq(0..resolved.intermediate.len()), "{at}");
                assert!(subset == 2 || !resolved.intermediate.is_empty(), "{at}");
            }
        }
    }
}

#[test]
fn on_foot_too_goals_of_later_windows_are_met() {
    for time_s in [12.0, 20.0] {
        let goal = Goal { position: Some(Vec2::new(-9.0, -9.0)), time_s: Some(time_s), ..Goal::default() };
        let scene = goal_at(quiet(), "5", goal);
        let answer = run(&GENERATOR, rollout(scene.clone(), Some(&["5"]), 200, 60));
        let future = chosen(&answer, "5");
        let end = future.states[(time_s * 10.0) as usize - 1];
        assert!((end.position() - Vec2::new(-9.0, -9.0)).norm() < 0.1, "{time_s}");
        assert!(excess(&scene, "5", future) <= 0.0);
    }
}

#[test]
fn a_goal_without_a_time_is_due_at_the_end() {
    for horizon in [50, 130] {
        let goal = Goal { position: Some(Vec2::new(0.0, -1.75)), ..Goal::default() };
        let answer = run(&GENERATOR, rollout(goal_at(quiet(), "1", goal), Some(&["1"]), horizon, 90));
        let future = chosen(&answer, "1");
        assert_eq!(future.states.len(), horizon);
        let end = future.states.last().unwrap();
        assert!((end.position() - Vec2::new(0.0, -1.75)).norm() < 0.1, "{horizon}: {end:?}");
        assert!((answer.resolved["1"].goal.time_s.value - 0.1 * horizon as f64).abs() < 1e-9);
    }
}

#[test]
fn what_no_window_can_reach_is_said() {
    let goal = Goal { position: Some(Vec2::new(115.0, -1.75)), time_s: Some(9.5), ..Goal::default() };
    let scene = goal_at(quiet(), "1", Goal { speed_mps: Some(0.0), ..goal });
    let far =
        goal_at(quiet(), "1", Goal { time_s: Some(10.0), position: Some(Vec2::new(900.0, -1.75)), ..goal });
    for scene in [scene, far] {
        let answer = run(&GENERATOR, rollout(scene.clone(), Some(&["1"]), 200, 90));
        let future = chosen(&answer, "1");
        assert_eq!(future.states.len(), 200);
        assert!(excess(&scene, "1", future) <= 0.0);
        if let ReachReport::Unreachable { words, .. } = &answer.resolved["1"].reach {
            assert!(words.starts_with("From 9.0 s on: "), "{words}");
            assert!(answer.warnings.iter().any(|w| w.code == WarningCode::GoalUnreachable));
        }
    }
}

#[test]
fn parked_cars_stay_parked_through_all_windows() {
    for interval in [30, 90] {
        let answer = run(&GENERATOR, rollout(crossing(), None, 200, interval));
        let start = crossing().agent("6").unwrap().state_at(0).unwrap();
        for state in &chosen(&answer, "6").states {
            assert_eq!((state.x_m, state.y_m, state.heading_rad), (start.x_m, start.y_m, start.heading_rad));
        }
    }
}

#[test]
fn neither_threads_nor_order_change_a_byte_of_a_rollout() {
    let mut request = rollout(with_goal(crossing(), "1", 5), None, 150, 60);
    request.samples = 2;
    let one = run(&GENERATOR, request.clone());
    assert!(one.samples == run(&GENERATOR, request.clone()).samples, "repeated");
    let three = Generator::random(3).unwrap().with_threads(3);
    assert!(one.samples == run(&three, request.clone()).samples, "threads");
    let mut turned = with_goal(crossing(), "1", 5);
    turned.agents.reverse();
    let turned = run(&GENERATOR, Request { scene: Arc::new(turned), ..request });
    assert!(one.samples[0].agents["1"] == turned.samples[0].agents["1"], "order");
    assert_eq!(one.samples.len(), 2);
    assert!(one.samples[0] != one.samples[1], "samples have their own noise");
    for futures in one.samples[1].agents.values() {
        assert_eq!(futures.modes[futures.chosen].states.len(), 150);
    }
}

#[test]
fn events_name_their_window_and_begin_where_it_begins() {
    let mut windows = Vec::new();
    let mut call = GENERATOR.start(rollout(crossing(), None, 200, 90), Cancel::default()).unwrap();
    while let Some(event) = call.next() {
        match event.unwrap() {
            Event::Accepted(accepted) => assert_eq!(accepted.windows, 3),
            Event::Draft(draft) => {
                windows.push((draft.window, draft.step));
                for future in call.drafted().unwrap().agents.values().flat_map(|f| &f.modes) {
                    assert_eq!(future.first_step, 1 + 90 * draft.window);
                    assert_eq!(future.states.len(), if draft.window < 2 { 90 } else { 20 });
                }
            }
            Event::Final(answer) => assert_eq!(answer.windows, 3),
        }
    }
    let expected: Vec<(usize, usize)> = (0..3).flat_map(|w| (0..3).map(move |s| (w, s))).collect();
    assert_eq!(windows, expected);
}

#[test]
fn a_cancelled_rollout_stops_between_windows() {
    let cancel = Cancel::default();
    let mut call = GENERATOR.start(rollout(crossing(), None, 200, 30), cancel.clone()).unwrap();
    let second = call.find(|e| matches!(e, Ok(Event::Draft(d)) if d.window == 1));
    assert!(second.is_some());
    cancel.cancel();
    assert_eq!(call.next(), Some(Err(GenerateError::Cancelled)));
    assert_eq!(call.next(), None);
}

#[test]
fn who_is_kept_goes_straight_on_where_the_log_ends_and_that_is_said() {
    let answer = run(&GENERATOR, rollout(crossing(), Some(&["1"]), 150, 60));
    let told: Vec<&str> = answer
        .warnings
        .iter()
        .filter(|w| w.code == WarningCode::Extrapolated)
        .filter_map(|w| w.agent.as_deref())
        .collect();
    assert_eq!(told, ["2", "3", "4", "5"], "all that move; the parked car stays where it is");
    assert!(!answer.samples[0].agents.contains_key("2"));
    let nine = run(&GENERATOR, rollout(crossing(), Some(&["1"]), 90, 30));
    assert!(nine.warnings.iter().all(|w| w.code != WarningCode::Extrapolated), "the log lasts as long");
}

#[test]
fn a_kept_future_that_ends_is_planned_on() {
    let mut scene = crossing();
    let nine = run(&GENERATOR, ask(scene.clone(), Some(&["2"])));
    let picked = (nine.samples[0].agents["2"].chosen + 1) % 6;
    let mut sample = nine.samples[0].clone();
    sample.agents.get_mut("2").unwrap().chosen = picked;
    let kept = sample.agents["2"].modes[picked].states.clone();
    scene.generated = Some(scene::Generated { samples: vec![sample], ..scene::Generated::default() });
    for interval in [30, 90] {
        let answer = run(&GENERATOR, rollout(scene.clone(), Some(&["1"]), 200, interval));
        let on = chosen(&answer, "2");
        assert_eq!((on.first_step, on.states.len()), (1, 200));
        assert!(on.states[..90] == kept[..], "what was picked is kept as it is");
        assert!(excess(&scene, "2", on) <= 0.0);
        assert!(answer.warnings.iter().all(|w| w.agent.as_deref() != Some("2")));
        assert!(!answer.samples[0].agents.contains_key("3"), "a log is kept, not planned on");
    }
}

#[test]
fn who_comes_in_later_plans_on_where_the_log_ends() {
    let mut scene = crossing();
    let mut late = agent("7", AgentType::Vehicle, (-90.0, -1.75), 0.0, 7.0);
    late.track.first_step = 40;
    late.track.states.truncate(51);
    let log: Vec<State> = late.track.states.iter().copied().flatten().collect();
    scene.agents.push(late);
    let answer = run(&GENERATOR, rollout(scene.clone(), None, 200, 90));
    let future = chosen(&answer, "7");
    assert_eq!((future.first_step, future.states.len()), (41, 160));
    assert!(future.states[..50] == log[1..], "the log as far as it goes");
    assert!(answer.warnings.iter().all(|w| w.code != WarningCode::Extrapolated));
    let kept = run(&GENERATOR, rollout(scene, Some(&["1"]), 200, 90));
    assert!(!kept.samples[0].agents.contains_key("7"));
    assert!(kept.warnings.iter().any(|w| w.agent.as_deref() == Some("7")));
}

#[test]
fn reacting_road_users_have_one_track_from_the_start_too() {
    let goal = Goal { position: Some(Vec2::new(1.75, 40.0)), time_s: Some(9.0), ..Goal::default() };
    let scene = goal_at(crossing(), "1", goal);
    let mut request = rollout(scene.clone(), Some(&["1"]), 200, 30);
    request.react = React::Everyone;
    let answer = run(&GENERATOR, request);
    assert!(answer.samples[0].agents.len() > 1, "an agent reacts within 20 s");
    for (id, futures) in &answer.samples[0].agents {
        let future = &futures.modes[futures.chosen];
        assert_eq!((future.first_step, future.states.len()), (1, 200), "{id}");
        assert!(excess(&scene, id, future) <= 0.0, "{id}");
        assert!(answer.resolved.contains_key(id));
    }
}

#[test]
fn with_nobody_asked_everybody_goes_on_past_the_end_of_what_is_known() {
    for (horizon, interval) in [(150, 90), (200, 30)] {
        let scene = crossing();
        let mut request = rollout(scene.clone(), Some(&[]), horizon, interval);
        request.react = React::Everyone;
        let answer = run(&GENERATOR, request);
        let mut longer = 0;
        for (id, futures) in &answer.samples[0].agents {
            let future = &futures.modes[futures.chosen];
            let track = &scene.agent(id).unwrap().track;
            let at = |i: usize| track.at(future.first_step + i).copied();
            let known = (0..future.states.len()).take_while(|i| at(*i).is_some()).count();
            if futures.reaction.is_none() {
                assert!((0..known).all(|i| at(i) == Some(future.states[i])), "{id} keeps its log");
            }
            assert_eq!(future.first_step + future.states.len(), horizon + 1, "{id}");
            longer += usize::from(known < future.states.len());
        }
        assert!(longer > 2, "{longer} go on");
    }
}

#[test]
fn a_start_inside_the_recording_works_the_same() {
    let mut request = rollout(crossing(), Some(&["1", "2"]), 200, 90);
    request.start_step = 20;
    let answer = run(&GENERATOR, request);
    let future = chosen(&answer, "1");
    assert_eq!((future.first_step, future.states.len()), (21, 200));
    let start = crossing().agent("1").unwrap().state_at(20).unwrap();
    assert!((future.states[0].position() - start.position()).norm() < 1.0);
}
