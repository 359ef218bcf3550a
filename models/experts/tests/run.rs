//! The guarantees of a run: the others react, keep their limits, enter and leave, and equal runs give equal
//! bytes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use experts::run::{DepartureReason, SnapshotError};
use experts::{Cancel, EgoState, Engine, Generator, Run, RunError, RunSettings};
use formats::native;
use scene::judge::FaultKind;
use scene::limits::Limits;
use scene::map::{Lane, LaneMap};
use scene::routes::{LaneGraph, Pose, best_route_ahead};
use scene::{Agent, AgentType, Goal, Scene, State, Subtype, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{Arc, LazyLock};

static ENGINE: LazyLock<Generator> = LazyLock::new(|| Engine::built_in().unwrap().generator.with_threads(1));

fn example(name: &str) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.json"));
    let doc = native::read_doc(&std::fs::read(path).unwrap()).unwrap();
    Arc::new(doc.into_scene(|_| None).unwrap())
}

/// A street of two lanes to the east, 600 m long, with cars at these places and speeds: id, x, lane, speed.
fn street(cars: &[(&str, f64, usize, f64)]) -> Scene {
    let lane = |id: &str, y_m: f64| {
        let points: Vec<Vec2> = (0..=600).map(|i| Vec2::new(f64::from(i), y_m)).collect();
        Lane::street(id, points)
    };
    let map = LaneMap { lanes: vec![lane("right", 0.0), lane("left", 3.5)], ..LaneMap::default() };
    let car = |(id, x_m, lane, speed): &(&str, f64, usize, f64)| {
        let state = State { x_m: *x_m, y_m: 3.5 * *lane as f64, vx_mps: *speed, ..State::default() };
        Agent::bare(*id, AgentType::Vehicle, Subtype::Car, vec![Some(state)])
    };
    Scene::bare("street", map, cars.iter().map(car).collect())
}

fn begun(scene: &Arc<Scene>, egos: &[&str]) -> Run {
    begun_with(scene, egos, RunSettings::default())
}

fn begun_with(scene: &Arc<Scene>, egos: &[&str], settings: RunSettings) -> Run {
    let egos: Vec<String> = egos.iter().map(|id| (*id).to_owned()).collect();
    Run::new(Arc::clone(scene), &egos, settings, &ENGINE, &Cancel::default()).unwrap()
}

fn step(run: &mut Run, egos: &[EgoState]) -> experts::run::RunStep {
    run.step(&ENGINE, egos, &Cancel::default()).unwrap()
}

/// A car going east that brakes at this rate from `from_s` on.
fn braking(x_m: f64, speed_mps: f64, brake_mps2: f64, from_s: f64, t: f64) -> State {
    let late = (t - from_s).clamp(0.0, speed_mps / brake_mps2);
    let (x_m, vx_mps) = (x_m + speed_mps * t.min(from_s + late), speed_mps - brake_mps2 * late);
    State { x_m: x_m - 0.5 * brake_mps2 * late * late, vx_mps, ..State::default() }
}

#[test]
fn a_minute_of_a_crossing_is_smooth_and_without_collisions() {
    let scene = example("demo-crossing");
    let mut run = begun(&scene, &[]);
    let mut before = run.present().states;
    let (mut entered, mut left) = (0, 0);
    for _ in 0..600 {
        let step = step(&mut run, &[]);
        for (id, now) in &step.states {
            let Some((_, was)) = before.iter().find(|(other, _)| other == id) else { continue };
            let agent = scene.agent(id).unwrap();
            let limits = Limits::of(agent.kind(), agent.subtype, agent.size.length_m);
            // In a bend the box centre swings out, so the speed along the heading counts for vehicles.
            let along = |s: &State| match agent.kind() {
                AgentType::Pedestrian => s.speed_mps(),
                _ => s.velocity().dot(&scene::geometry::direction(s.heading_rad)),
            };
            let rate_mps2 = (along(now) - along(was)) / 0.1;
            let turned = scene::wrap_angle(now.heading_rad - was.heading_rad).abs() / 0.1;
            let aside_mps2 = turned * now.speed_mps();
            let at = format!("{id} at {:.1} s, {was:?} to {now:?}", step.time_s);
            assert!(
                (-limits.brake_mps2 - 0.5..=limits.accel_mps2 + 0.5).contains(&rate_mps2),
                "{rate_mps2} {at}"
            );
            assert!(
                agent.kind() == AgentType::Pedestrian || aside_mps2 <= limits.lateral_mps2 + 0.5,
                "{aside_mps2} {at}"
            );
            let moved_m = (now.position() - was.position()).norm();
            assert!(moved_m <= 0.1 * was.speed_mps().max(now.speed_mps()) + 0.1, "{id}: {moved_m} m");
        }
        let met = step.faults.iter().find(|f| f.fault.kind == FaultKind::Collision);
        assert!(met.is_none(), "{met:?}");
        entered += step.entered.len();
        left += step.left.len();
        before = step.states;
    }
    assert!(entered >= 3 && left >= 3, "{entered} came in, {left} left");
    assert_eq!((run.number(), (run.time_s() * 10.0).round()), (600, 600.0));
}

#[test]
fn road_users_reach_where_their_recordings_end_and_do_nothing_wrong() {
    let (mut sent, mut reached) = (0, 0);
    for name in ["demo-crossing", "demo-motorway"] {
        let mut scene = Scene::clone(&example(name));
        let mut asked = BTreeSet::new();
        for agent in scene.agents.iter_mut().filter(|a| a.kind() != AgentType::Other) {
            let ends = agent.track.last_valid_step().filter(|_| agent.track.at(0).is_some());
            let Some(end) = ends.filter(|end| *end > 80 && agent.track.extent_m() > 2.0) else { continue };
            let position = agent.track.at(end).map(State::position);
            agent.conditions.goal = Goal { position, time_s: Some(0.1 * end as f64), ..Goal::default() };
            asked.insert(agent.id.clone());
        }
        let mut run = begun(&Arc::new(scene), &[]);
        let (mut arrived, mut at_fault) = (BTreeSet::new(), BTreeSet::new());
        for _ in 0..100 {
            let step = step(&mut run, &[]);
            let left = step.left.into_iter().filter(|d| d.reason == DepartureReason::Arrived);
            arrived.extend(left.map(|d| d.agent));
            at_fault.extend(step.faults.into_iter().map(|f| f.agent));
        }
        sent += asked.len();
        reached += asked.iter().filter(|id| arrived.contains(*id) && !at_fault.contains(*id)).count();
    }
    // All of them when this was written.
    assert!(sent > 40 && reached + 2 >= sent, "{reached} of {sent}");
}

#[test]
fn a_planner_of_twenty_lines_drives_among_others_who_do_not_run_into_it() {
    let scene = example("demo-crossing");
    let graph = LaneGraph::new(&scene.map);
    // The moving car with the longest path ahead.
    let moving = scene.agents.iter().filter(|a| a.kind() == AgentType::Vehicle);
    let moving = moving.filter_map(|a| Some((a, a.state_at(0).filter(|s| s.speed_mps() > 4.0)?)));
    let ego = moving.min_by(|a, b| a.0.id.cmp(&b.0.id)).map(|(a, _)| a.id.clone()).unwrap();
    let mut run = begun(&scene, &[&ego]);
    let first = run.state(&ego).unwrap();
    let pose = Pose::new(first.position(), first.heading_rad);
    let path = best_route_ahead(&graph, pose, AgentType::Vehicle, 400.0).unwrap().path;
    let (mut s_m, mut speed) = (path.project(first.position()).s_m, first.speed_mps());
    for _ in 0..200 {
        // IDM behind the nearest road user on the same lane.
        let (mut gap_m, mut ahead_mps) = (f64::INFINITY, 0.0);
        for (id, other) in run.present().states {
            let at = path.project(other.position());
            if id != ego && at.lateral_m.abs() < 1.8 && at.s_m > s_m && at.s_m - s_m - 4.8 < gap_m {
                (gap_m, ahead_mps) = (at.s_m - s_m - 4.8, other.speed_mps());
            }
        }
        let wanted = 2.0 + (speed * 1.5 + speed * (speed - ahead_mps) / (2.0 * 3.0_f64.sqrt())).max(0.0);
        let rate = 1.5 * (1.0 - (speed / 10.0).powi(4) - (wanted / gap_m.max(0.1)).powi(2));
        let then = (speed + 0.1 * rate.clamp(-6.0, 1.5)).max(0.0);
        s_m += 0.05 * (speed + then);
        speed = then;
        let at = path.sample(s_m);
        let velocity = scene::geometry::direction(at.heading_rad) * speed;
        let state = State {
            x_m: at.position.x,
            y_m: at.position.y,
            heading_rad: at.heading_rad,
            vx_mps: velocity.x,
            vy_mps: velocity.y,
        };
        let step = step(&mut run, &[EgoState::new(&ego, state)]);
        let theirs = step.faults.iter().find(|f| f.fault.kind == FaultKind::Collision && f.agent != ego);
        assert!(theirs.is_none(), "{theirs:?}");
    }
}

#[test]
fn those_behind_brake_when_an_ego_brakes_without_a_word() {
    let mut scene = street(&[("ego", 100.0, 0, 14.0), ("near", 78.0, 0, 14.0), ("far", 56.0, 0, 14.0)]);
    // With a second lane they would pass it.
    scene.map.lanes.truncate(1);
    let scene = Arc::new(scene);
    let mut run = begun(&scene, &["ego"]);
    let mut causes = Vec::new();
    for i in 1..=80 {
        let ego = EgoState::new("ego", braking(100.0, 14.0, 6.0, 1.0, 0.1 * f64::from(i)));
        let step = step(&mut run, &[ego]);
        assert!(step.faults.is_empty(), "{:?}", step.faults);
        causes.extend(step.changes.into_iter().map(|c| (c.agent, c.reaction.cause)));
    }
    assert!(causes.contains(&("near".into(), "ego".into())), "{causes:?}");
    for id in ["near", "far"] {
        assert!(run.state(id).unwrap().speed_mps() < 1.0, "{id}: {:?}", run.state(id));
    }
}

#[test]
fn a_cut_in_that_nobody_announced_makes_room_for_itself() {
    let scene = Arc::new(street(&[("ego", 115.0, 1, 11.0), ("behind", 100.0, 0, 14.0)]));
    let mut run = begun(&scene, &["ego"]);
    let mut slowest_mps: f64 = 14.0;
    for i in 1..=80 {
        let t = 0.1 * f64::from(i);
        // Moves aside within two seconds, from half a second on.
        let share = ((t - 0.5) / 2.0).clamp(0.0, 1.0);
        let y_m = 3.5 * (1.0 - share * share * (3.0 - 2.0 * share));
        let vy_mps = if share > 0.0 && share < 1.0 { -3.5 * 3.0 * share * (1.0 - share) } else { 0.0 };
        let state =
            State { x_m: 115.0 + 11.0 * t, y_m, heading_rad: vy_mps.atan2(11.0), vx_mps: 11.0, vy_mps };
        let step = step(&mut run, &[EgoState::new("ego", state)]);
        assert!(step.faults.is_empty(), "{:?}", step.faults);
        slowest_mps = slowest_mps.min(run.state("behind").unwrap().speed_mps());
    }
    assert!(slowest_mps < 11.2, "{slowest_mps} m/s");
    assert!(run.state("behind").unwrap().x_m < run.state("ego").unwrap().x_m - 5.0);
}

#[test]
fn a_plan_that_is_announced_is_answered_before_it_is_driven_and_a_peek_changes_nothing() {
    let scene = Arc::new(street(&[("ego", 100.0, 0, 12.0), ("behind", 80.0, 0, 12.0)]));
    let mut run = begun(&scene, &["ego"]);
    let plan: Vec<State> = (1..=90).map(|i| braking(100.0, 12.0, 4.0, 0.5, 0.1 * f64::from(i))).collect();
    let before = run.snapshot();
    let peek = |plan: &[State]| {
        let plans = BTreeMap::from([("ego".to_owned(), plan.to_vec())]);
        run.peek(&ENGINE, &plans, &Cancel::default()).unwrap()
    };
    let (stops, goes) = (peek(&plan), peek(&[]));
    assert!(run.snapshot() == before);
    let cause =
        |p: &experts::run::RunPeek| p.changes.first().map(|c| (c.agent.clone(), c.reaction.cause.clone()));
    assert_eq!(cause(&stops), Some(("behind".into(), "ego".into())));
    assert_eq!((cause(&goes), stops.futures["behind"].len()), (None, 90));
    assert!(stops.futures["behind"][89].speed_mps() < 0.5 && goes.futures["behind"][89].speed_mps() > 6.0);
    assert!(stops.faults.is_empty(), "{:?}", stops.faults);
    // If it is announced, the others react in the first step.
    let told = EgoState { id: "ego".into(), state: plan[0], plan: plan[1..].to_vec() };
    let step = step(&mut run, &[told]);
    assert_eq!(step.changes.first().map(|c| c.reaction.cause.as_str()), Some("ego"));
}

#[test]
fn road_users_come_in_where_there_is_room_and_leave_where_the_road_or_their_way_ends() {
    let mut scene = street(&[("goes", 540.0, 0, 12.0), ("arrives", 100.0, 1, 10.0), ("stands", 2.0, 0, 0.0)]);
    let goal = Goal { position: Some(Vec2::new(150.0, 3.5)), time_s: Some(5.0), ..Goal::default() };
    scene.agents[1].conditions.goal = goal;
    let late = |id: &str, y_m: f64| {
        let at = State { x_m: 5.0, y_m, vx_mps: 10.0, ..State::default() };
        let mut agent = Agent::bare(id, AgentType::Vehicle, Subtype::Car, vec![Some(at); 3]);
        agent.track.first_step = 20;
        agent
    };
    scene.agents.extend([late("late", 3.5), late("blocked", 0.0)]);
    scene.time.steps = 91;
    let scene = Arc::new(scene);
    let mut run = begun(&scene, &[]);
    let (mut entered, mut left) = (Vec::new(), Vec::new());
    for i in 1..=90 {
        let step = step(&mut run, &[]);
        entered.extend(step.entered.into_iter().map(|id| (id, i)));
        left.extend(step.left.into_iter().map(|d| (d.agent, d.reason)));
        assert!(step.faults.is_empty(), "{:?}", step.faults);
    }
    // One enters at its time, one once the car in its place has moved off.
    assert_eq!(entered.first(), Some(&("late".to_owned(), 20)));
    let blocked = entered.get(1).filter(|(id, _)| id == "blocked");
    assert!(blocked.is_some_and(|(_, step)| *step > 30), "{entered:?}");
    left.sort_by(|a, b| a.0.cmp(&b.0));
    let expected = [("arrives", DepartureReason::Arrived), ("goes", DepartureReason::LeftTheMap)];
    assert_eq!(left, expected.map(|(id, why)| (id.to_owned(), why)));
    assert!(run.state("goes").is_none() && run.state("stands").is_some());
}

#[test]
fn equal_runs_give_equal_bytes_over_threads_after_restore_and_in_branches() {
    let scene = example("demo-roundabout");
    let two = Engine::built_in().unwrap().generator.with_threads(2);
    let settings = RunSettings { seed: 5, ..RunSettings::default() };
    let mut one = begun_with(&scene, &[], settings);
    let mut other = Run::new(scene.clone(), &[], settings, &two, &Cancel::default()).unwrap();
    for i in 0..40 {
        // At every second moment, twenty in all.
        if i % 2 == 1 {
            let bytes = other.snapshot();
            other = Run::restore(scene.clone(), &bytes).unwrap();
            assert!(other.snapshot() == bytes);
        }
        let mut branch = one.clone();
        let (a, b) = (step(&mut one, &[]), other.step(&two, &[], &Cancel::default()).unwrap());
        assert!(a == b && one.snapshot() == other.snapshot(), "step {i}");
        if i % 16 == 7 {
            step(&mut branch, &[]);
            assert!(branch.snapshot() == one.snapshot());
        }
    }
    let another = begun_with(&scene, &[], RunSettings { seed: 6, ..settings });
    assert!(another.snapshot() != begun_with(&scene, &[], settings).snapshot());
}

#[test]
fn a_full_street_begins_in_parts_and_goes_on() {
    // More than can plan at once, close enough to react to each other.
    let cars: Vec<(String, f64, usize, f64)> = (0..70)
        .map(|i| (i.to_string(), 15.0 + 14.0 * f64::from(i / 2), i as usize % 2, 5.0 + f64::from(i % 5)))
        .collect();
    let cars: Vec<(&str, f64, usize, f64)> =
        cars.iter().map(|(id, x_m, lane, speed)| (id.as_str(), *x_m, *lane, *speed)).collect();
    let scene = Arc::new(street(&cars));
    let mut run = begun(&scene, &[]);
    for _ in 0..30 {
        let step = step(&mut run, &[]);
        let met = step.faults.iter().find(|f| f.fault.kind == FaultKind::Collision);
        assert!(met.is_none(), "{met:?}");
    }
    assert_eq!(Run::restore(scene, &run.snapshot()).unwrap().snapshot(), run.snapshot());
}

#[test]
fn steps_of_other_lengths_come_to_the_same_time() {
    let scene = Arc::new(street(&[("a", 100.0, 0, 10.0)]));
    for step_ms in [50, 130, 500] {
        let mut run = begun_with(&scene, &[], RunSettings { step_ms, ..RunSettings::default() });
        let steps = 3_000 / step_ms;
        for _ in 0..steps {
            step(&mut run, &[]);
        }
        assert!((run.time_s() - f64::from(steps * step_ms) / 1e3).abs() < 1e-9);
        let x_m = run.state("a").unwrap().x_m;
        assert!((110.0..150.0).contains(&x_m), "{step_ms} ms: {x_m}");
    }
}

#[test]
fn what_is_no_step_is_refused_and_changes_nothing() {
    let scene = Arc::new(street(&[("ego", 100.0, 0, 10.0), ("a", 60.0, 0, 10.0)]));
    let started = |egos: &[&str], settings| {
        let egos: Vec<String> = egos.iter().map(|id| (*id).to_owned()).collect();
        Run::new(scene.clone(), &egos, settings, &ENGINE, &Cancel::default()).map(drop)
    };
    let usual = RunSettings::default();
    assert_eq!(started(&["x"], usual), Err(RunError::UnknownAgent("x".into())));
    assert_eq!(started(&["a", "a"], usual), Err(RunError::EgoTwice("a".into())));
    assert!(matches!(
        started(&[], RunSettings { step_ms: 20, ..usual }),
        Err(RunError::OutOfRange { what: "step_ms", least: 50, most: 500, got: 20 })
    ));
    let mut run = begun(&scene, &["ego"]);
    let before = run.snapshot();
    let ego = EgoState::new("ego", State { x_m: 101.0, vx_mps: 10.0, ..State::default() });
    let mut refused = |egos: &[EgoState]| run.step(&ENGINE, egos, &Cancel::default()).unwrap_err();
    assert_eq!(refused(&[]), RunError::EgoMissing("ego".into()));
    assert_eq!(refused(&[ego.clone(), ego.clone()]), RunError::EgoTwice("ego".into()));
    assert_eq!(refused(&[EgoState { id: "a".into(), ..ego.clone() }]), RunError::NotAnEgo("a".into()));
    let nowhere = EgoState::new("ego", State { x_m: f64::NAN, ..State::default() });
    assert_eq!(refused(&[nowhere]), RunError::NoState { agent: "ego".into(), at: 0 });
    let long = EgoState { plan: vec![ego.state; 91], ..ego.clone() };
    assert!(matches!(refused(&[long]), RunError::PlanTooLong { found: 91, most: 90, .. }));
    let stop = Cancel::default();
    stop.cancel();
    assert!(matches!(run.step(&ENGINE, &[ego], &stop), Err(RunError::Generate(_))));
    assert!(run.snapshot() == before);
}

#[test]
fn bytes_that_are_no_snapshot_are_refused_with_their_place() {
    let scene = Arc::new(street(&[("ego", 100.0, 0, 10.0), ("a", 60.0, 0, 10.0)]));
    let mut run = begun(&scene, &["ego"]);
    step(&mut run, &[EgoState::new("ego", braking(100.0, 10.0, 1.0, 0.0, 0.1))]);
    let bytes = run.snapshot();
    let read = |bytes: &[u8]| Run::restore(scene.clone(), bytes).map(|run| run.snapshot());
    let refused = |error: SnapshotError| Err(RunError::Snapshot(error));
    assert!(read(&bytes).unwrap() == bytes);
    assert_eq!(read(b"no"), refused(SnapshotError::NoSnapshot));
    assert_eq!(read(&[&bytes[..7], &[9], &bytes[8..]].concat()), refused(SnapshotError::Version(9)));
    assert_eq!(read(&[&bytes[..], &[0]].concat()), refused(SnapshotError::GoesOn(bytes.len())));
    for end in (8..bytes.len()).step_by(7) {
        assert_eq!(read(&bytes[..end]), refused(SnapshotError::Ends(end)), "{end}");
    }
    let other = Arc::new(street(&[("ego", 100.0, 0, 10.0), ("a", 61.0, 0, 10.0)]));
    assert_eq!(Run::restore(other, &bytes).map(drop), refused(SnapshotError::OtherScene).map(drop));
    // Every byte is changed: the result is either refused, or reads and writes back unchanged.
    for at in 40..bytes.len() {
        let mut broken = bytes.clone();
        broken[at] ^= 0xff;
        if let Ok(again) = read(&broken) {
            assert!(again == broken, "{at}");
        }
    }
}
