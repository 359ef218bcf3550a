//! Features of hand-made scenes.

use super::agent::{AgentPlan, plan};
use super::block::{Block, described};
use super::tables::{AnchorInputs, Neighbour, Own};
use crate::planning::MODES;
use crate::planning::world::World;
use scene::map::{Lane, LaneMap};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, Scene, Signal, SignalState, State, Subtype, Vec2};
use std::sync::Arc;

/// A value by its name, converted back to its unit.
fn value<B: Block>(row: &[f32], name: &str) -> f64 {
    let features = described::<B>();
    let index = features.iter().position(|f| f.name == name).unwrap_or_else(|| panic!("no input {name}"));
    f64::from(row[index]) * features[index].scale
}

#[track_caller]
fn assert_row<B: Block>(row: &[f32], expected: &[(&str, f64)]) {
    for (name, wanted) in expected {
        let found = value::<B>(row, name);
        assert!((found - wanted).abs() < 1e-3 * wanted.abs().max(1.0), "{name}: {found}, not {wanted}");
    }
}

/// An agent at a place, heading north at `speed_mps`.
fn north(id: &str, agent_type: AgentType, subtype: Subtype, at: (f64, f64), speed_mps: f64) -> Agent {
    let heading_rad = std::f64::consts::FRAC_PI_2;
    let state = State { x_m: at.0, y_m: at.1, heading_rad, vx_mps: 0.0, vy_mps: speed_mps };
    Agent::bare(id, agent_type, subtype, vec![Some(state)])
}

/// A street northwards from y = -50 to a signal at y = 40, through a junction 20 m long, and beyond. A second
/// lane is on its left.
fn street() -> LaneMap {
    let points = |x: f64, from: i32, to: i32| -> Vec<Vec2> {
        (from..=to).map(|y| Vec2::new(x, f64::from(y))).collect()
    };
    let lane = |id: &str, from, to, next: &[&str]| Lane {
        speed_limit_mps: Some(15.0),
        width_m: Some(3.5),
        successors: next.iter().map(|s| (*s).to_owned()).collect(),
        ..Lane::street(id, points(0.0, from, to))
    };
    let through = Lane { interpolating: true, ..lane("through", 40, 60, &["out"]) };
    let right = |id: &str| Lane {
        interpolating: true,
        ..Lane::street(
            id,
            (0..=20).map(|i| Vec2::new(f64::from(i), 40.0 + 0.2 * f64::from(i))).collect::<Vec<_>>(),
        )
    };
    let lanes = vec![
        lane("in", -50, 40, &["through", "right"]),
        through,
        right("right"),
        lane("out", 60, 260, &[]),
        Lane { width_m: Some(3.5), ..Lane::street("beside", points(-3.5, -50, 40)) },
    ];
    LaneMap { lanes, ..LaneMap::default() }
}

fn planned(agents: Vec<Agent>, signals: Vec<Signal>) -> AgentPlan {
    let scene = Scene { signals, ..Scene::bare("street", street(), agents) };
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    let who = world.present.iter().find(|p| world.agent(p).id == "1").unwrap();
    plan(&world, who)
}

fn car(at: (f64, f64), speed_mps: f64) -> Agent {
    north("1", AgentType::Vehicle, Subtype::Car, at, speed_mps)
}

#[test]
fn a_road_user_sees_itself_and_its_goal() {
    let mut me = car((0.5, 0.0), 10.0);
    me.conditions.goal = Goal {
        position: Some(Vec2::new(-3.5, 30.0)),
        heading_rad: Some(std::f64::consts::FRAC_PI_2),
        speed_mps: Some(6.0),
        time_s: Some(5.0),
    };
    let others = [north("2", AgentType::Cyclist, Subtype::Bicycle, (3.0, 5.0), 4.0), car((0.0, 25.0), 0.0)];
    let mut agents = vec![me];
    agents.extend(others.into_iter().enumerate().map(|(i, a)| Agent { id: (i + 2).to_string(), ..a }));
    let own = planned(agents, Vec::new()).features.own;
    assert_row::<Own>(
        &own,
        &[
            ("kind.vehicle", 1.0),
            ("kind.pedestrian", 0.0),
            ("kind.heavy", 0.0),
            ("motorcycle", 0.0),
            ("speed", 10.0),
            ("stands", 0.0),
            ("velocity_ahead", 10.0),
            ("velocity_left", 0.0),
            ("goal_time", 5.0),
            ("goal_position_fixed", 1.0),
            ("goal_heading_fixed", 1.0),
            ("goal_speed_fixed", 1.0),
            ("goal_ahead", 30.0),
            ("goal_left", 4.0),
            ("goal_distance", 916f64.sqrt()),
            ("goal_bearing_cos", 30.0 / 916f64.sqrt()),
            ("goal_pace_change", 916f64.sqrt() / 5.0 - 10.0),
            ("goal_heading_cos", 1.0),
            ("goal_heading_sin", 0.0),
            ("goal_speed", 6.0),
            ("goal_speed_change", -4.0),
            ("on_lane", 1.0),
            ("lane_offset", -0.5),
            ("lane_heading_cos", 1.0),
            ("others_within_10_m", 1.0),
            ("others_within_30_m", 2.0),
        ],
    );
}

#[test]
fn what_is_free_or_absent_says_so() {
    let walker = north("1", AgentType::Pedestrian, Subtype::Adult, (-60.0, 0.0), 0.1);
    let own = planned(vec![walker], Vec::new()).features.own;
    assert_row::<Own>(
        &own,
        &[
            ("kind.vehicle", 0.0),
            ("kind.pedestrian", 1.0),
            ("stands", 1.0),
            ("goal_time", 9.0),
            ("goal_position_fixed", 0.0),
            ("goal_distance", 0.0),
            ("goal_heading_cos", 0.0),
            ("goal_speed_change", 0.0),
            ("on_lane", 0.0),
            ("lane_offset", 3.0),
            ("others_within_30_m", 0.0),
        ],
    );
}

#[test]
fn neighbours_come_in_their_frame_nearest_first() {
    let mut truck = north("2", AgentType::Vehicle, Subtype::Truck, (4.0, -20.0), 8.0);
    truck.conditions.goal = Goal { position: Some(Vec2::new(4.0, 40.0)), ..Goal::default() };
    let bicycle = north("3", AgentType::Cyclist, Subtype::Bicycle, (3.0, 6.0), 0.0);
    let seen = planned(vec![car((0.0, 0.0), 10.0), truck, bicycle], Vec::new()).features.neighbours;
    assert_eq!(seen.len(), 2);
    assert_row::<Neighbour>(
        &seen[0],
        &[
            ("ahead", 6.0),
            ("left", -3.0),
            ("distance", 45f64.sqrt()),
            ("heading_cos", 1.0),
            ("speed", 0.0),
            ("stands", 1.0),
            ("kind.cyclist", 1.0),
            ("goal_fixed", 0.0),
            ("goal_speed", -1.0),
        ],
    );
    assert_row::<Neighbour>(
        &seen[1],
        &[
            ("ahead", -20.0),
            ("left", -4.0),
            ("velocity_ahead", 8.0),
            ("stands", 0.0),
            ("kind.heavy", 1.0),
            ("goal_fixed", 1.0),
            ("goal_ahead", 40.0),
            ("goal_left", -4.0),
        ],
    );
}

#[test]
fn an_anchor_sees_what_lies_ahead_on_it() {
    let stop = Signal {
        lane: "through".into(),
        stop: Some(Vec2::new(0.0, 40.0)),
        stop_z_m: None,
        runs: vec![(0, SignalState::Stop)],
    };
    let queue = [("2", 35.0, 0.0), ("3", 25.0, 0.2)]
        .map(|(id, y, speed)| north(id, AgentType::Vehicle, Subtype::Car, (0.0, y), speed));
    let mut agents = vec![car((0.0, 0.0), 8.0)];
    agents.extend(queue);
    let features = planned(agents, vec![stop]).features;
    let straight_on = |row: &&[f32; super::ANCHOR]| {
        value::<AnchorInputs>(*row, "origin.route") > 0.5
            && value::<AnchorInputs>(*row, "path.7.left").abs() < 0.5
    };
    let row = features.anchors.iter().find(straight_on).unwrap();
    let gap_m = 25.0 - 4.88;
    assert_row::<AnchorInputs>(
        row,
        &[
            ("leader", 1.0),
            ("leader_speed", 0.2),
            ("light.known", 1.0),
            ("light.stop", 1.0),
            ("light.go", 0.0),
            ("light_distance", 40.0),
            ("stop_sign", 0.0),
            ("crossing", 0.0),
            ("speed_limit", 15.0),
            ("second_leader", 1.0),
            ("queue", 2.0),
            ("junction", 1.0),
            ("junction_from", 40.0),
            ("junction_to", 60.0),
            ("junction_turn", 0.0),
            ("junction_ways", 2.0),
            ("lanes_left", 1.0),
            ("lanes_right", 0.0),
            ("lanes_oncoming", 0.0),
        ],
    );
    let gap = value::<AnchorInputs>(row, "leader_gap");
    assert!((gap - gap_m).abs() < 1.0, "a box's length short of 25 m: {gap}");
    let second = value::<AnchorInputs>(row, "second_gap");
    assert!((second - gap - 10.0).abs() < 0.1, "{second}");
}

#[test]
fn an_empty_road_has_nothing_ahead_and_slots_count_timings() {
    let features = planned(vec![car((0.0, 100.0), 12.0)], Vec::new()).features;
    for (slot, row) in features.anchors.iter().enumerate() {
        assert_row::<AnchorInputs>(
            row,
            &[
                ("leader", 0.0),
                ("leader_gap", 100.0),
                ("light.known", 0.0),
                ("light_distance", 100.0),
                ("light_reached", 12.0),
                ("crossing_lead", 9.0),
                ("junction", 0.0),
                ("junction_reached", 12.0),
                ("path.0.heading_cos", 1.0),
            ],
        );
        for other in 0..MODES {
            let expected = f64::from(u8::from(other == slot));
            assert_row::<AnchorInputs>(row, &[(&format!("slot.{other}"), expected)]);
        }
        let timings = value::<AnchorInputs>(row, "timings");
        let timing = value::<AnchorInputs>(row, "timing") * timings - 0.5;
        assert!(timing > -0.01 && timing < timings - 0.99, "timing {timing} of {timings}");
    }
}
