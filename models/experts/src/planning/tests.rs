//! Tests of the world at a step and of its anchors, on hand-made scenes.

use super::anchors::{Anchor, PathKind, anchors};
use super::coordinates::MODES;
use super::profile::speed_at;
use super::world::World;
use scene::map::{Lane, LaneMap};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, HORIZON_STEPS, Scene, Start, State, Subtype, Vec2};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// A road eastwards that forks at x = 50: straight on, or a quarter circle of 20 m radius to the left, then
/// north.
fn fork() -> LaneMap {
    let lane = |id: &str, points: Vec<Vec2>, next: &[&str]| Lane {
        speed_limit_mps: Some(14.0),
        width_m: Some(3.5),
        successors: next.iter().map(|s| (*s).to_owned()).collect(),
        ..Lane::street(id, points)
    };
    let line = |from: i32, to: i32, at: fn(f64) -> Vec2| (from..=to).map(|i| at(f64::from(i))).collect();
    let bend = |i: f64| {
        let angle = i / 30.0 * FRAC_PI_2;
        Vec2::new(50.0 + 20.0 * angle.sin(), 20.0 - 20.0 * angle.cos())
    };
    let lanes = vec![
        lane("in", line(-50, 50, |x| Vec2::new(x, 0.0)), &["on", "left"]),
        lane("on", line(50, 250, |x| Vec2::new(x, 0.0)), &[]),
        lane("left", line(0, 30, bend), &["north"]),
        lane("north", line(20, 220, |y| Vec2::new(70.0, y)), &[]),
    ];
    LaneMap { lanes, ..LaneMap::default() }
}

/// An agent at a place on the fork's first road, going east at this speed.
fn east(id: &str, agent_type: AgentType, at: (f64, f64), speed_mps: f64) -> Agent {
    let state = State { x_m: at.0, y_m: at.1, vx_mps: speed_mps, ..State::default() };
    Agent::bare(id, agent_type, Subtype::Unknown, vec![Some(state)])
}

fn scene(agents: Vec<Agent>) -> Scene {
    Scene::bare("fork", fork(), agents)
}

fn world(scene: &Scene) -> World<'_> {
    World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0)
}

fn anchors_of(agent: Agent) -> Vec<Anchor> {
    let scene = scene(vec![agent]);
    let world = world(&scene);
    let who = &world.present[0];
    anchors(&world, who, &world.model(who), &world.target(who))
}

fn to(x: f64, y: f64, speed_mps: Option<f64>, time_s: f64) -> Goal {
    Goal { position: Some(Vec2::new(x, y)), speed_mps, time_s: Some(time_s), ..Goal::default() }
}

#[test]
fn a_world_holds_who_is_there_with_what_the_user_fixed() {
    let mut turned = east("b", AgentType::Vehicle, (0.0, 0.0), 8.0);
    turned.conditions.start = Start { heading_rad: Some(FRAC_PI_2), ..Start::default() };
    turned.conditions.length_m = Some(12.0);
    turned.conditions.agent_type = Some(AgentType::Cyclist);
    let mut moved = east("a", AgentType::Vehicle, (5.0, 0.0), 8.0);
    moved.conditions.start.position = Some(Vec2::new(20.0, 1.0));
    moved.conditions.start.speed_mps = Some(3.0);
    let later = Agent::bare("c", AgentType::Vehicle, Subtype::Car, vec![None, Some(State::default())]);
    let scene = scene(vec![turned, moved, later]);
    let world = world(&scene);
    let ids: Vec<&str> = world.present.iter().map(|p| world.agent(p).id.as_str()).collect();
    assert_eq!(ids, ["a", "b"], "sorted by id, without later arrivals");
    let (a, b) = (&world.present[0], &world.present[1]);
    assert_eq!((a.start.position(), a.start.speed_mps()), (Vec2::new(20.0, 1.0), 3.0));
    assert!(
        (b.start.velocity() - Vec2::new(0.0, 8.0)).norm() < 1e-12,
        "a turned start takes its speed along"
    );
    assert_eq!((b.agent_type, b.size.length_m), (AgentType::Cyclist, 12.0));
    let obstacles = world.obstacles(a.index);
    assert_eq!(obstacles.len(), 1);
    assert!((obstacles[0].speed_mps - 8.0).abs() < 1e-12);
}

#[test]
fn a_target_is_the_goal_in_the_windows_steps() {
    let mut agent = east("1", AgentType::Vehicle, (0.0, 0.0), 8.0);
    agent.conditions.goal = to(40.0, 0.0, Some(5.0), 4.0);
    let scene = scene(vec![agent, east("2", AgentType::Vehicle, (-30.0, 0.0), 8.0)]);
    let world = world(&scene);
    let target = world.target(&world.present[0]);
    assert_eq!((target.step, target.position, target.speed_mps), (40, Some(Vec2::new(40.0, 0.0)), Some(5.0)));
    let free = world.target(&world.present[1]);
    assert!(free.is_free() && free.step == HORIZON_STEPS);
}

#[test]
fn without_a_goal_both_ways_of_a_fork_get_anchors_with_rising_timings() {
    let found = anchors_of(east("1", AgentType::Vehicle, (10.0, 0.0), 10.0));
    assert_eq!(found.len(), MODES);
    assert!(found.iter().all(|a| a.kind == PathKind::Route));
    let ends: BTreeSet<bool> = found.iter().map(|a| a.path.last().position.y > 20.0).collect();
    assert_eq!(ends.len(), 2, "straight on and to the left");
    for pair in found.windows(2).filter(|pair| pair[0].path_identity() == pair[1].path_identity()) {
        assert!(pair[0].base[HORIZON_STEPS] < pair[1].base[HORIZON_STEPS], "from slow to fast");
    }
    for anchor in &found {
        assert!(anchor.base.windows(2).all(|w| w[0] <= w[1]) && anchor.base[0] == 0.0);
        assert!((speed_at(&anchor.base, 1) - 10.0).abs() < 1.0, "it leaves at the speed of the start");
    }
}

#[test]
fn a_goal_on_the_lanes_is_met_along_them_in_time() {
    for (speed_mps, time_s) in [(None, 9.0), (Some(8.0), 8.8)] {
        let mut agent = east("1", AgentType::Vehicle, (0.0, 0.0), 9.0);
        agent.conditions.goal = to(70.0, 40.0, speed_mps, time_s);
        let found = anchors_of(agent);
        assert_eq!((found.len(), found[0].kind), (MODES, PathKind::Route));
        let step = (time_s * 10.0) as usize;
        let (there, heading_rad) = found[0].place(found[0].base[step], 0.0);
        assert!((there - Vec2::new(70.0, 40.0)).norm() < 1.0, "{there:?}");
        assert!((heading_rad - FRAC_PI_2).abs() < 0.1, "{heading_rad}");
        if let Some(speed_mps) = speed_mps {
            assert!((speed_at(&found[0].base, step) - speed_mps).abs() < 0.6);
        }
    }
}

#[test]
fn anchors_keep_their_names_while_a_goal_moves_a_little() {
    let names = |x: f64| {
        let mut agent = east("1", AgentType::Vehicle, (0.0, 0.0), 9.0);
        agent.conditions.goal = to(x, 0.0, None, 9.0);
        anchors_of(agent).iter().map(|a| a.identity).collect::<Vec<_>>()
    };
    assert_eq!(names(80.0), names(80.05));
}

#[test]
fn who_stands_leaves_as_late_as_an_easy_start_allows() {
    let mut agent = east("1", AgentType::Vehicle, (0.0, 0.0), 0.0);
    agent.conditions.goal = to(10.0, 0.0, None, 9.0);
    let base = anchors_of(agent)[0].base;
    assert!(base[30] < 0.05 && (base[90] - 10.0).abs() < 0.3, "{} {}", base[30], base[90]);
}

#[test]
fn people_walk_straight_and_go_the_smooth_way_to_a_goal() {
    let walker = || east("1", AgentType::Pedestrian, (0.0, 6.0), 1.4);
    let free = anchors_of(walker());
    assert_eq!((free.len(), free[0].kind), (MODES, PathKind::Straight));
    let mut asked = walker();
    asked.conditions.goal = to(8.0, 9.0, None, 7.0);
    let found = anchors_of(asked);
    assert!(found.iter().all(|a| a.kind == PathKind::LeastEffort));
    let (there, _) = found[0].place(found[0].base[70], 0.0);
    assert!((there - Vec2::new(8.0, 9.0)).norm() < 0.2, "{there:?}");
}

#[test]
fn coordinates_are_the_inverse_of_places() {
    let anchor = &anchors_of(east("1", AgentType::Vehicle, (10.0, 0.0), 10.0))[5];
    for (along, across) in [(3.0, 0.5), (35.0, -1.2), (60.0, 2.0), (anchor.path.length_m() + 4.0, 0.7)] {
        let (point, _) = anchor.place(along, across);
        let (a, b) = anchor.coordinates(point, along);
        assert!((a - along).abs() < 0.15 && (b - across).abs() < 0.15, "{along} {across}: {a} {b}");
    }
}

#[test]
fn off_every_lane_a_car_has_straight_and_bent_ways() {
    let scene =
        Scene::bare("nowhere", LaneMap::default(), vec![east("1", AgentType::Vehicle, (0.0, 0.0), 8.0)]);
    let world = world(&scene);
    let who = &world.present[0];
    let found = anchors(&world, who, &world.model(who), &world.target(who));
    assert!(found.len() == MODES && found.iter().all(|a| a.kind == PathKind::Straight && a.route.is_none()));
    let sides: BTreeSet<i32> = found.iter().map(|a| (a.path.last().position.y / 5.0) as i32).collect();
    assert!(sides.len() >= 3, "{sides:?}");
}
