//! Tests of paths along the road and of signals on them, on hand-made scenes.

use super::anchors::{Anchor, PathKind, anchors};
use super::coordinates::MODES;
use super::legal::broken_m;
use super::lights::{Waiting, gates};
use super::profile::{Caps, Progress, cruising};
use super::world::World;
use scene::geometry::direction;
use scene::map::{Lane, LaneMap, TypedLine};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, HORIZON_STEPS, Scene, Signal, SignalState, State, Subtype, Vec2};
use std::f64::consts::PI;
use std::sync::Arc;

/// A car at the origin, going east at this speed.
fn car(speed_mps: f64, goal: Goal) -> Agent {
    let state = State { vx_mps: speed_mps, ..State::default() };
    let mut car = Agent::bare("1", AgentType::Vehicle, Subtype::Car, vec![Some(state)]);
    car.conditions.goal = goal;
    car
}

fn to(x: f64, y: f64, time_s: f64) -> Goal {
    Goal { position: Some(Vec2::new(x, y)), time_s: Some(time_s), ..Goal::default() }
}

fn lane(id: &str, points: Vec<Vec2>, next: &[&str]) -> Lane {
    let successors = next.iter().map(|s| (*s).to_owned()).collect();
    Lane { width_m: Some(3.5), speed_limit_mps: Some(14.0), successors, ..Lane::street(id, points) }
}

fn straight(from: f64, to: f64, y: f64) -> Vec<Vec2> {
    let n = (to - from).abs() as usize;
    (0..=n).map(|i| Vec2::new(from + (to - from) * i as f64 / n as f64, y)).collect()
}

/// Two carriageways with a median between them that has a gap at x = 60, with or without a turning lane
/// there.
fn carriageways(turning: bool) -> LaneMap {
    let edge = |id: &str, from: f64, to: f64, y: f64| TypedLine {
        id: id.into(),
        line_type: "median".into(),
        points: straight(from, to, y).into(),
    };
    let bend = (0..=20).map(|i| Vec2::new(60.0, 6.0) + 6.0 * direction(PI * (f64::from(i) / 20.0 - 0.5)));
    let mut lanes = vec![
        lane("east", straight(-50.0, 60.0, 0.0), &["on"]),
        lane("on", straight(60.0, 250.0, 0.0), &[]),
        lane("west", straight(250.0, 60.0, 12.0), &["back"]),
        lane("back", straight(60.0, -50.0, 12.0), &[]),
    ];
    if turning {
        lanes[0].successors.push("turn".into());
        lanes.push(lane("turn", bend.collect(), &["back"]));
    }
    let gap = if turning { (50.0, 75.0) } else { (50.0, 50.0) };
    let sides = [2.0, 10.0].into_iter().enumerate();
    let medians = sides.flat_map(|(i, y)| {
        [edge(&format!("a{i}"), -50.0, gap.0, y), edge(&format!("b{i}"), gap.1, 250.0, y)]
    });
    let outer = [edge("right", -50.0, 250.0, -2.0), edge("left", -50.0, 250.0, 14.0)];
    LaneMap { lanes, road_edges: medians.chain(outer).collect(), ..LaneMap::default() }
}

fn anchors_on(map: LaneMap, agent: Agent) -> (Vec<Anchor>, Vec<f64>) {
    let scene = Scene::bare("road", map, vec![agent]);
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = &world.present[0];
    let target = world.target(who);
    let found = anchors(&world, who, &world.model(who), &target);
    let goal = target.position.unwrap();
    let ground = world.ground(who);
    let broken = |a: &Anchor| broken_m(&ground, who, &a.path, a.path.project(goal).s_m);
    let broken = found.iter().map(broken).collect();
    (found, broken)
}

#[test]
fn a_goal_behind_a_median_is_reached_through_its_gap() {
    let (found, broken) = anchors_on(carriageways(true), car(10.0, to(40.0, 12.0, 9.0)));
    assert_eq!(found.len(), MODES);
    assert!(broken.iter().all(|m| *m < 2.0), "{broken:?}");
    for anchor in &found {
        assert_eq!(anchor.kind, PathKind::Route);
        let (there, _) = anchor.place(anchor.base[HORIZON_STEPS], 0.0);
        assert!((there - Vec2::new(40.0, 12.0)).norm() < 1.0, "{there:?}");
    }
}

#[test]
fn a_goal_that_only_a_way_over_the_median_reaches_is_still_reached() {
    let (found, broken) = anchors_on(carriageways(false), car(10.0, to(80.0, 12.0, 9.0)));
    assert_eq!(found.len(), MODES);
    assert!(broken.iter().all(|m| *m > 5.0), "{broken:?}");
    for anchor in &found {
        let (there, _) = anchor.place(anchor.base[HORIZON_STEPS], 0.0);
        assert!((there - Vec2::new(80.0, 12.0)).norm() < 1.0, "{there:?}");
    }
}

#[test]
fn the_way_over_a_median_that_may_be_crossed_comes_first() {
    let over = |allowed: &[&str], turning: bool, goal: Goal| {
        let mut agent = car(10.0, goal);
        agent.conditions.may_cross = allowed.iter().map(|id| (*id).to_owned()).collect();
        anchors_on(carriageways(turning), agent)
    };
    let (_, broken) = over(&["a0", "a1", "b0", "b1"], false, to(80.0, 12.0, 9.0));
    assert_eq!(broken, [0.0; MODES], "over the median where nothing but that leads there");
    // With permission to cross the edge it does not need the U-turn far ahead.
    let (by_the_gap, _) = over(&[], true, to(40.0, 12.0, 9.0));
    let (over_it, broken) = over(&["a0", "a1"], true, to(40.0, 12.0, 9.0));
    assert_eq!(by_the_gap[0].kind, PathKind::Route);
    assert!(over_it[0].kind != PathKind::Route && broken[0] < 2.0, "{:?} {broken:?}", over_it[0].kind);
    assert!(over_it[0].path.length_m() < by_the_gap[0].path.length_m());
    // Permission for another edge does not help.
    let (found, _) = over(&["right"], true, to(40.0, 12.0, 9.0));
    assert_eq!(found[0].kind, PathKind::Route);
}

#[test]
fn a_way_by_the_road_that_takes_too_long_does_not_serve() {
    let (_, broken) = anchors_on(carriageways(true), car(10.0, to(20.0, 12.0, 4.0)));
    assert!(broken[0] > 5.0, "{broken:?}");
}

/// A street with a signal at x = 40 that is red until this many steps have passed.
fn lit(agent: Agent, green: usize) -> Scene {
    let lanes = vec![
        lane("in", straight(-50.0, 40.0, 0.0), &["through"]),
        Lane { interpolating: true, ..lane("through", straight(40.0, 60.0, 0.0), &["out"]) },
        lane("out", straight(60.0, 250.0, 0.0), &[]),
    ];
    let runs = vec![(0, SignalState::Stop), (green, SignalState::Go)];
    let stop = Some(Vec2::new(40.0, 0.0));
    let signal = Signal { lane: "through".into(), stop, stop_z_m: None, runs };
    let map = LaneMap { lanes, ..LaneMap::default() };
    Scene { signals: vec![signal], ..Scene::bare("light", map, vec![agent]) }
}

/// Progress of an anchor's base, or of continuing at 10 m/s, that obeys the signal; `None` if the wanted
/// progress obeys it already.
fn waiting(scene: &Scene) -> Option<Progress> {
    let world = World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = &world.present[0];
    let (model, target) = (world.model(who), world.target(who));
    let anchor = anchors(&world, who, &model, &target).remove(0);
    let gates = gates(&world, who, &anchor.path);
    let waiting = Waiting {
        gates: &gates,
        v0: model.start_speed_mps(),
        limits: &model.limits,
        target: &target,
        caps: Caps::new(anchor.path.arc_m(), &anchor.caps_mps),
        easy_mps2: 1.1,
    };
    let free = Caps::new(&[0.0], &[f64::INFINITY]);
    let wanted = if target.position.is_some() { anchor.base } else { cruising(10.0, 10.0, &free) };
    waiting.obeying(&wanted)
}

/// Progress of the box centre at which the front is at the line, metres.
const AT_LINE_M: f64 = 40.0 - 2.4;

#[test]
fn who_comes_to_a_red_light_stands_at_the_line_until_it_is_green() {
    let held = waiting(&lit(car(10.0, Goal::default()), 70)).unwrap();
    assert!(held[..=70].iter().all(|m| *m < AT_LINE_M), "{}", held[70]);
    assert!(held[69] > AT_LINE_M - 3.0 && held[69] - held[60] < 0.1, "it stands near the line");
    assert!(held[HORIZON_STEPS] > AT_LINE_M, "and goes on");
    let braking = held.windows(3).map(|w| (2.0 * w[1] - w[0] - w[2]) / 0.01).fold(0.0, f64::max);
    assert!(braking < 4.0, "{braking}");
    let never = waiting(&lit(car(10.0, Goal::default()), 500)).unwrap();
    assert!(never[HORIZON_STEPS] < AT_LINE_M);
}

#[test]
fn who_cannot_stop_or_comes_at_green_goes_on() {
    assert!(waiting(&lit(car(10.0, Goal::default()), 20)).is_none(), "green by then");
    assert!(waiting(&lit(car(19.0, Goal::default()), 500)).is_none(), "4.8 m/s2 would be needed");
}

#[test]
fn a_goal_behind_a_red_light_is_waited_for_where_the_time_allows() {
    let held = waiting(&lit(car(10.0, to(70.0, 0.0, 9.0)), 45)).unwrap();
    assert!(held[..=45].iter().all(|m| *m < AT_LINE_M), "{}", held[45]);
    assert!((held[HORIZON_STEPS] - 70.0).abs() < 0.3, "{}", held[HORIZON_STEPS]);
    assert!(waiting(&lit(car(10.0, to(70.0, 0.0, 9.0)), 85)).is_none(), "half a second is too little");
}

#[test]
fn who_stands_at_a_red_light_sets_off_when_it_turns_green() {
    let mut first = car(0.0, Goal::default());
    let mut second = first.clone();
    second.id = "2".into();
    for (agent, x_m) in [(&mut first, 36.5), (&mut second, 29.0)] {
        agent.track.states[0].as_mut().unwrap().x_m = x_m;
    }
    let scene = Scene { agents: vec![first.clone(), second], ..lit(first, 30) };
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let leaves = world.present.iter().map(|who| {
        let (model, target) = (world.model(who), world.target(who));
        let anchor = anchors(&world, who, &model, &target).remove(0);
        let gates = gates(&world, who, &anchor.path);
        let caps = Caps::new(anchor.path.arc_m(), &anchor.caps_mps);
        let waiting =
            Waiting { gates: &gates, v0: 0.0, limits: &model.limits, target: &target, caps, easy_mps2: 1.1 };
        let out = waiting.setting_off(&[0.0; HORIZON_STEPS + 1]).unwrap();
        assert!(out[HORIZON_STEPS] > 10.0, "{}", out[HORIZON_STEPS]);
        out.iter().position(|m| *m > 0.01).unwrap()
    });
    let leaves: Vec<usize> = leaves.collect();
    assert!((40..45).contains(&leaves[0]) && (50..58).contains(&leaves[1]), "{leaves:?}");
}
