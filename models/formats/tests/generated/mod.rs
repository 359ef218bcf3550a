//! Scenes drawn for properties.

use proptest::prelude::*;
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, Points, StopSign, TypedLine};
use scene::{
    Agent, AgentType, Conditions, Goal, LaneMap, Meta, Origin, Scene, Signal, SignalState, Size, State,
    Subtype, Timing, Track, Vec2,
};
use std::collections::BTreeMap;

/// A number that f32 holds too. Drawn as f64: proptest's sampler of f32 ranges panics in one of some 10⁷ draws.
fn single(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|number| f64::from(number as f32))
}

/// A state that moves along its heading, up to 0.5 rad beside it: readers tell by it whether headings are degrees.
fn state() -> impl Strategy<Value = State> {
    let plane = (-4e3..4e3f64, -4e3..4e3f64, single(-3.1, 3.1), 0.0..40.0f64, -0.5..0.5f64);
    plane.prop_map(|(x_m, y_m, heading_rad, speed_mps, aside_rad)| {
        let (speed_mps, way) = (speed_mps as f32, (heading_rad + aside_rad) as f32);
        let (vx_mps, vy_mps) = ((speed_mps * way.cos()).into(), (speed_mps * way.sin()).into());
        State { x_m, y_m, heading_rad, vx_mps, vy_mps }
    })
}

fn track(steps: usize) -> impl Strategy<Value = Track> {
    let slots = proptest::collection::vec((proptest::option::weighted(0.8, state()), -50.0..50.0f64), steps);
    (slots, any::<bool>()).prop_map(|(slots, with_z)| {
        let z = slots.iter().map(|(s, z)| if s.is_some() { *z } else { 0.0 }).collect();
        let states: Vec<_> = slots.into_iter().map(|slot| slot.0).collect();
        let z_m = (with_z && states.iter().any(Option::is_some)).then_some(z);
        Track { first_step: 0, states, z_m }
    })
}

fn agent(steps: usize) -> impl Strategy<Value = Agent> {
    let kind = prop_oneof![
        Just(AgentType::Vehicle),
        Just(AgentType::Pedestrian),
        Just(AgentType::Cyclist),
        Just(AgentType::Other)
    ];
    let goal = proptest::option::of((0.0..12.0f64, -3.0..3.0f64));
    (kind, track(steps), single(0.3, 12.0), single(0.3, 3.0), proptest::option::of(single(0.5, 4.0)), goal)
        .prop_map(|(agent_type, track, length_m, width_m, height_m, goal)| {
            let seen = track.states.iter().any(Option::is_some);
            let default = Size::default_for(agent_type, Subtype::Unknown);
            let size = Size { length_m, width_m, height_m };
            // A size is written with the states; without any there is only the default.
            let size = if seen { size } else { Size { height_m: None, ..default } };
            let goal = goal.map_or(Goal::default(), |(speed, heading)| Goal {
                speed_mps: Some(speed),
                heading_rad: Some(heading),
                ..Goal::default()
            });
            Agent {
                id: String::new(),
                agent_type,
                subtype: Subtype::Unknown,
                role: None,
                size,
                track: track.into(),
                conditions: Conditions { goal, ..Conditions::default() },
            }
        })
}

fn points(least: usize) -> impl Strategy<Value = Points> {
    let list = proptest::collection::vec((-5e3..5e3f64, -5e3..5e3f64, -50.0..50.0f64), least..6);
    (list, any::<bool>()).prop_map(|(list, with_z)| Points {
        xy: list.iter().map(|p| Vec2::new(p.0, p.1)).collect(),
        z_m: with_z.then(|| list.iter().map(|p| p.2).collect()),
    })
}

/// Lines that nowhere turn back, as lanes are.
fn way() -> impl Strategy<Value = Points> {
    let steps = proptest::collection::vec((0.5..300.0f64, -0.8..0.8f64, -50.0..50.0f64), 1..6);
    let start = (-4e3..4e3f64, -4e3..4e3f64, -3.1..3.1f64, -50.0..50.0f64);
    (start, steps, any::<bool>()).prop_map(|((x, y, mut heading, z), steps, with_z)| {
        let (mut xy, mut heights) = (vec![Vec2::new(x, y)], vec![z]);
        for (length, turn, z) in steps {
            heading += turn;
            let last = xy[xy.len() - 1];
            xy.push(last + scene::geometry::direction(heading) * length);
            heights.push(z);
        }
        Points { xy, z_m: with_z.then_some(heights) }
    })
}

fn lane() -> impl Strategy<Value = Lane> {
    let kind = prop_oneof![
        Just(LaneType::Undefined),
        Just(LaneType::Freeway),
        Just(LaneType::SurfaceStreet),
        Just(LaneType::BikeLane)
    ];
    let mph = proptest::option::of(0..90u32);
    (kind, way(), mph, any::<bool>(), 0..9usize).prop_map(|(lane_type, points, mph, interpolating, n)| {
        let boundary = Boundary { line: "201".into(), from: n, to: n + 1, kind: Some(n as u32) };
        Lane {
            id: String::new(),
            lane_type,
            points,
            width_m: None,
            left_boundary: vec![boundary.clone()],
            right_boundary: Vec::new(),
            speed_limit_mps: mph.map(|v| f64::from(v) * 0.447_04),
            predecessors: vec!["100".into()],
            successors: vec!["101".into(), "777".into()],
            left_neighbors: vec![Neighbor {
                lane: "101".into(),
                own_range: (0, n),
                other_range: (n, n),
                boundaries: vec![boundary],
            }],
            right_neighbors: Vec::new(),
            interpolating,
        }
    })
}

fn signal(steps: usize) -> impl Strategy<Value = Signal> {
    let states = proptest::collection::vec(0..9usize, steps);
    let stop = proptest::option::of((-5e3..5e3f64, -5e3..5e3f64, proptest::option::of(-5.0..5.0f64)));
    (states, stop).prop_map(|(states, stop)| {
        let all = [
            SignalState::Unknown,
            SignalState::ArrowStop,
            SignalState::ArrowCaution,
            SignalState::ArrowGo,
            SignalState::Stop,
            SignalState::Caution,
            SignalState::Go,
            SignalState::FlashingStop,
            SignalState::FlashingCaution,
        ];
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for (step, number) in states.into_iter().enumerate() {
            if runs.last().is_none_or(|run| run.1 != all[number]) {
                runs.push((step, all[number]));
            }
        }
        Signal {
            lane: String::new(),
            stop: stop.map(|s| Vec2::new(s.0, s.1)),
            stop_z_m: stop.and_then(|s| s.2),
            runs,
        }
    })
}

/// Scenes that the record format can carry but for their conditions; the ego stands at the origin.
pub fn scene() -> impl Strategy<Value = Scene> {
    (1..12usize).prop_flat_map(|steps| {
        let parts = (
            proptest::collection::vec(agent(steps), 1..6),
            proptest::collection::vec(lane(), 1..4),
            proptest::collection::vec(points(1), 5),
            proptest::collection::vec(signal(steps), 0..3),
            (0..steps, (-9e4..9e4f64, -9e4..9e4f64), state()),
        );
        parts.prop_map(move |(mut agents, mut lanes, lines, mut signals, (now_step, origin, ego))| {
            for (i, agent) in agents.iter_mut().enumerate() {
                agent.id = (i * 3 + 1).to_string();
            }
            let ego_state = State { x_m: 0.0, y_m: 0.0, ..ego };
            agents[0].role = Some("ego".into());
            if agents[0].track.states.iter().all(Option::is_none) {
                agents[0].size.height_m = Some(1.5);
                agents[0].track.z_m = None;
            }
            agents[0].track.states[now_step] = Some(ego_state);
            agents[0].size.length_m = 4.5;
            agents[0].size.width_m = 2.0;
            for (i, lane) in lanes.iter_mut().enumerate() {
                lane.id = (100 + i).to_string();
            }
            for (i, signal) in signals.iter_mut().enumerate() {
                signal.lane = (100 + i).to_string();
            }
            let line = |id: &str, line_type: &str, points: &Points| TypedLine {
                id: id.into(),
                line_type: line_type.into(),
                points: points.clone(),
            };
            let area = |id: &str, polygon: &Points| Area {
                id: id.into(),
                polygon: polygon.clone(),
                holes: Vec::new(),
            };
            let map = LaneMap {
                lanes,
                road_lines: vec![line("201", "passing_double_yellow", &lines[0])],
                road_edges: vec![line("301", "median", &lines[1])],
                crosswalks: vec![area("401", &lines[2])],
                speed_bumps: vec![area("402", &lines[3])],
                driveways: vec![area("403", &lines[4])],
                stop_signs: vec![StopSign {
                    id: "501".into(),
                    position: Vec2::new(1.0, 2.0),
                    z_m: None,
                    lanes: vec!["100".into()],
                }],
                drivable: Vec::new(),
            };
            let meta = Meta {
                source: "synthetic".into(),
                source_id: Some("synth-1".into()),
                licence: Some("cc0".into()),
                origin: Origin { x_m: origin.0, y_m: origin.1, ..Origin::default() },
                objects_of_interest: vec!["1".into()],
                tracks_to_predict: vec![("1".into(), 2)],
                ..Meta::default()
            };
            Scene {
                id: None,
                name: "synth-1".into(),
                meta,
                time: Timing { steps, now_step },
                map: map.into(),
                signals,
                agents,
                generated: None,
                extra: BTreeMap::new(),
            }
        })
    })
}
