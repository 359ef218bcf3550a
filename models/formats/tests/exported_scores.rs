//! A scene has the same score before export and after import, in every format with a writer. Edits of a road
//! user are kept, or reported as a loss.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use formats::registry::FORMATS;
use formats::{ExportOptions, ImportOptions};
use proptest::prelude::*;
use scene::geometry::direction;
use scene::map::{Lane, TypedLine};
use scene::score::{Drivable, ScoreInput};
use scene::{
    Agent, AgentFutures, AgentType, Conditions, Future, Generated, Goal, LaneMap, Sample, Scene, Signal,
    SignalState, Size, Start, State, Subtype, Timing, Vec2,
};
use serde_json::Value;
use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Differences that rounding to f32 makes.
const ROUNDING: f64 = 1e-3;

/// A motion at constant speed: place, heading, speed.
type Straight = (f64, f64, f64, f64);

fn straight() -> impl Strategy<Value = Straight> {
    let drawn = (-40.0..40.0f64, -8.0..8.0f64, -3.1..3.1f64, 0.0..14.0f64);
    drawn.prop_map(|(x_m, y_m, heading_rad, speed)| (x_m, y_m, off_diagonal(heading_rad), speed))
}

/// At 45 degrees to the lanes rounding decides whether somebody walks along them.
fn off_diagonal(heading_rad: f64) -> f64 {
    let beside_rad = heading_rad.rem_euclid(FRAC_PI_2) - FRAC_PI_4;
    if beside_rad.abs() < 0.02 { heading_rad + 0.04 } else { heading_rad }
}

/// Rounded as answers are, which is how the native form keeps them.
fn states((x_m, y_m, heading_rad, speed): Straight, steps: usize) -> Vec<State> {
    let round = |v: f64, digits: f64| (v * digits).round() / digits;
    let heading_rad = round(heading_rad, 1e4);
    let (vx_mps, vy_mps) = (round(speed * heading_rad.cos(), 1e3), round(speed * heading_rad.sin(), 1e3));
    let at = |i: f64| State {
        x_m: round(x_m + 0.1 * i * vx_mps, 1e3),
        y_m: round(y_m + 0.1 * i * vy_mps, 1e3),
        heading_rad,
        vx_mps,
        vy_mps,
    };
    (0..steps).map(|i| at(i as f64)).collect()
}

fn kind() -> impl Strategy<Value = AgentType> {
    prop_oneof![Just(AgentType::Vehicle), Just(AgentType::Pedestrian), Just(AgentType::Cyclist)]
}

fn conditions() -> impl Strategy<Value = Conditions> {
    let some = proptest::option::of::<std::ops::Range<f64>>;
    let sides = (some(0.5..12.0), some(0.5..2.9));
    let start = (any::<bool>(), some(-3.1..3.1), some(0.0..10.0), straight());
    (proptest::option::of(kind()), sides, start, some(0.0..9.0)).prop_map(
        |(agent_type, (length_m, width_m), (moved, heading_rad, speed_mps, at), goal_mps)| Conditions {
            agent_type,
            length_m,
            width_m,
            start: Start { position: moved.then(|| Vec2::new(at.0, at.1)), heading_rad, speed_mps },
            goal: Goal { speed_mps: goal_mps, ..Goal::default() },
            ..Conditions::default()
        },
    )
}

/// With sizes that a road user of its kind can have.
fn fitting(mut conditions: Conditions, agent_type: AgentType) -> Conditions {
    let (length, width) = match conditions.agent_type.unwrap_or(agent_type) {
        AgentType::Pedestrian => ((0.2, 2.0), (0.2, 2.0)),
        AgentType::Cyclist => ((0.5, 3.5), (0.2, 1.5)),
        _ => ((1.5, 25.0), (0.5, 4.0)),
    };
    conditions.length_m = conditions.length_m.map(|v| v.clamp(length.0, length.1));
    conditions.width_m = conditions.width_m.map(|v| v.clamp(width.0, width.1));
    conditions
}

fn map() -> LaneMap {
    let points = |y: f64| vec![Vec2::new(-60.0, y), Vec2::new(60.0, y)];
    let lane = |id: &str, y: f64| Lane::street(id, points(y));
    let edge = |id: &str, y: f64| TypedLine {
        id: id.into(),
        line_type: "boundary".into(),
        points: points(y).into(),
    };
    LaneMap {
        lanes: vec![lane("100", 0.0), lane("101", 3.5)],
        road_edges: vec![edge("301", -2.0), edge("302", 5.5)],
        ..LaneMap::default()
    }
}

/// Road users that interact, some of them edited and generated from a step on.
fn scene() -> impl Strategy<Value = Scene> {
    let one = (kind(), straight(), conditions(), proptest::option::weighted(0.7, straight()));
    (proptest::collection::vec(one, 2..6), 0..12usize, 20..50usize).prop_map(
        |(parts, start, future_steps)| {
            let mut sample = Sample::default();
            let mut agents = Vec::new();
            for (i, (agent_type, log, conditions, future)) in parts.into_iter().enumerate() {
                let id = (i + 1).to_string();
                let log = states(log, 40).into_iter().map(Some).collect();
                let conditions = fitting(conditions, agent_type);
                agents.push(Agent { conditions, ..Agent::bare(&id, agent_type, Subtype::Unknown, log) });
                if let Some(future) = future {
                    let future = Future::bare(1.0, start + 1, states(future, future_steps));
                    sample.agents.insert(id, AgentFutures::of(0, vec![future]));
                }
            }
            let stop = Some(Vec2::new(10.0, 0.0));
            let runs = vec![(0, SignalState::Stop), (20, SignalState::Go)];
            let mut scene = Scene::bare("met", map(), agents);
            scene.time.steps = 40;
            scene.signals.push(Signal { lane: "100".into(), stop, stop_z_m: None, runs });
            scene.generated = Some(Generated { samples: vec![sample], ..Generated::default() });
            scene
        },
    )
}

/// The scene as a writer of speed and heading stores it. Rounding turns velocities off their headings by less
/// than writers declare, but that can decide whether two grazing boxes touch.
fn along_headings(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let recorded = scene.agents.iter_mut().flat_map(|agent| agent.track.states.iter_mut().flatten());
    recorded.for_each(set_along_heading);
    if let Some(generated) = &mut scene.generated {
        let of_agents = generated.samples.iter_mut().flat_map(|sample| sample.agents.values_mut());
        let modes = of_agents.flat_map(|futures| &mut futures.modes);
        modes.flat_map(|mode| &mut mode.states).for_each(set_along_heading);
    }
    scene
}

fn set_along_heading(state: &mut State) {
    let velocity = direction(state.heading_rad) * state.speed_mps();
    (state.vx_mps, state.vy_mps) = (velocity.x, velocity.y);
}

/// The score as JSON, without what the declared losses take away, its places in the source's frame.
fn scored(scene: &Scene, time: &Timing, steps: &std::ops::Range<usize>, losses: &[&str]) -> Value {
    let mut scene = scene.clone();
    if losses.contains(&"no-timing") {
        scene.time = *time;
    }
    if losses.contains(&"no-conditions") {
        for agent in &mut scene.agents {
            agent.conditions.goal = Goal::default();
            // Where a future becomes the recording, its start is part of the track.
            if !losses.contains(&"no-generated") {
                agent.conditions.start = Start::default();
            }
        }
    }
    if losses.contains(&"no-ids") {
        let numbered = scene.agents.iter_mut().zip(1..);
        numbered.for_each(|(agent, number)| agent.id = number.to_string());
    }
    let drivable = Drivable::new(&scene.map);
    let mut input = ScoreInput::of_scene(&scene, &drivable);
    input.steps = steps.clone();
    let tracks: Vec<_> = input.actors.iter().map(|actor| actor.track.clone().into_owned()).collect();
    for (actor, track) in input.actors.iter_mut().zip(&tracks) {
        if losses.contains(&"no-generated") {
            (actor.generated, actor.reference, actor.modes) = (false, None, &[]);
            (actor.log, actor.track) = (Some(track), Cow::Borrowed(track));
        }
        if losses.contains(&"no-sizes") {
            actor.size = Size::default_for(actor.agent_type, Subtype::Unknown);
        }
    }
    let mut value = serde_json::to_value(scene::score::score(&input)).unwrap();
    // Without equal lanes or ground, figures that depend on them are not compared.
    let ground = ["no-map", "no-lane-type", "no-lane-graph", "no-drivable", "no-lines"];
    if losses.iter().any(|code| ground.contains(code)) {
        let [shares, roads, rules] = [
            ["offroad_max_m", "offroad_share", "wrong_way_share"],
            ["off_road", "wrong_way", "over_median"],
            ["off_map", "on_carriageway", "speeding"],
        ];
        for figure in [shares, roads, rules].concat().into_iter().chain(["askew"]) {
            let agents = value["agents"].as_object_mut().into_iter().flat_map(|agents| agents.values_mut());
            let mut judged: Vec<&mut Value> = agents.collect();
            judged
                .iter_mut()
                .filter_map(|one| one.as_object_mut())
                .for_each(|figures| drop(figures.remove(figure)));
            value["scene"].as_object_mut().map(|figures| figures.remove(figure));
        }
    }
    if losses.contains(&"no-signals") || losses.contains(&"no-map") {
        value["scene"].as_object_mut().map(|figures| figures.remove("red_lights"));
    }
    place(&mut value, Vec2::new(scene.meta.origin.x_m, scene.meta.origin.y_m));
    value
}

fn place(value: &mut Value, origin: Vec2) {
    match value {
        Value::Object(members) => {
            for (name, member) in members.iter_mut() {
                match (name.as_str(), member.as_f64()) {
                    ("x_m", Some(x)) => *member = (x + origin.x).into(),
                    ("y_m", Some(y)) => *member = (y + origin.y).into(),
                    _ => place(member, origin),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|member| place(member, origin)),
        _ => {}
    }
}

/// Differences between two values beyond rounding.
fn difference(a: &Value, b: &Value, at: &str) -> Option<String> {
    let unlike = || Some(format!("{at}: {a} before, {b} after"));
    match (a, b) {
        (Value::Object(p), Value::Object(q)) if p.len() == q.len() => {
            p.iter().find_map(|(name, v)| difference(v, q.get(name)?, &format!("{at}/{name}")))
        }
        (Value::Array(p), Value::Array(q)) if p.len() == q.len() => {
            p.iter().zip(q).enumerate().find_map(|(i, (v, w))| difference(v, w, &format!("{at}/{i}")))
        }
        (Value::Number(p), Value::Number(q)) => {
            let (p, q) = (p.as_f64().unwrap(), q.as_f64().unwrap());
            if (p - q).abs() > ROUNDING * (1.0 + p.abs()) { unlike() } else { None }
        }
        _ if a == b => None,
        _ => unlike(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_scored_is_what_is_exported(scene in scene()) {
        let scene = scene.checked().unwrap();
        let options = ImportOptions { join_identities: false, ..ImportOptions::default() };
        for format in FORMATS.iter().filter(|format| format.info().export && format.info().import) {
            let id = format.info().id;
            let exported = format.export(&[&scene], &ExportOptions::default()).unwrap();
            let codes: Vec<&str> = exported.losses.iter().map(|loss| loss.code).collect();
            let undeclared = codes.iter().find(|code| !format.info().loses.contains(code));
            prop_assert!(undeclared.is_none(), "{id} does not declare {undeclared:?}");
            // Scenes without any motion left cannot be scored.
            if codes.contains(&"no-road-users") || codes.contains(&"single-ego") {
                continue;
            }
            let (back, _) = format.import(&exported.bytes, &options).remove(0).unwrap();
            // Its speeds follow from positions, and drawn states have others; `openscenario_in.rs` compares positions.
            if id == "openscenario" {
                continue;
            }
            let drivable = Drivable::new(&scene.map);
            let steps = ScoreInput::of_scene(&scene, &drivable).steps;
            let scored = |scene_seen: &Scene| scored(scene_seen, &scene.time, &steps, &codes);
            let after = scored(&back);
            let different = difference(&scored(&scene), &after, "")
                .filter(|_| difference(&scored(&along_headings(&scene)), &after, "").is_some());
            prop_assert!(different.is_none(), "{id}, losses {codes:?}: {}", different.unwrap());
        }
    }
}
