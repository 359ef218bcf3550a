//! The calls whose answers are kept: three demo scenes and a hand-made one; each expert, with and without goals;
//! a long horizon, several samples, a fixed start, a pinned future, a placement.

use dragtraffic_tests::program::root;
use experts::placement::{Amount, PlaceRequest};
use experts::{React, Request};
use scene::map::{Lane, LaneMap};
use scene::{Agent, AgentType, Goal, Scene, State, Subtype, Vec2};
use std::sync::Arc;

/// One call.
pub enum Case {
    /// Of the generator.
    Generate(fn() -> Request),
    /// Of placement.
    Place(fn() -> PlaceRequest),
}

/// File name and call.
pub const CASES: &[(&str, Case)] = &[
    ("vehicle-free", Case::Generate(|| ask(demo("crossing"), &["6"]))),
    (
        "vehicle-goal-reacting",
        Case::Generate(|| Request {
            react: React::Everyone,
            seed: 7,
            ..ask(with_goal(demo("crossing"), "6", to((-40.0, 8.0), None, Some(8.0), 9.0)), &["6"])
        }),
    ),
    ("pedestrian-free", Case::Generate(|| ask(demo("crossing"), &["33", "35"]))),
    (
        "pedestrian-goal",
        Case::Generate(|| {
            ask(with_goal(demo("crossing"), "33", to((13.0, -11.0), Some(0.3), Some(1.2), 8.0)), &["33"])
        }),
    ),
    ("cyclist-free", Case::Generate(|| ask(demo("roundabout"), &["15", "16"]))),
    (
        "cyclist-goal",
        Case::Generate(|| {
            ask(with_goal(demo("roundabout"), "16", to((7.8, -20.0), None, Some(3.0), 8.0)), &["16"])
        }),
    ),
    ("everybody-two-samples", Case::Generate(|| Request { samples: 2, seed: 3, ..all(demo("roundabout")) })),
    (
        "long-horizon",
        Case::Generate(|| Request {
            horizon_steps: 200,
            replan_steps: Some(60),
            react: React::Everyone,
            seed: 1,
            ..ask(with_goal(demo("arterial"), "1", to((120.0, -4.0), None, None, 15.0)), &["1"])
        }),
    ),
    ("hand-made-everybody", Case::Generate(|| Request { start_step: 10, ..all(crossing()) })),
    (
        "hand-made-unreachable",
        Case::Generate(|| {
            ask(with_goal(crossing(), "1", to((150.0, -1.75), Some(0.0), Some(2.0), 6.0)), &["1"])
        }),
    ),
    (
        "hand-made-fixed-start",
        Case::Generate(|| {
            let mut scene = with_goal(crossing(), "3", to((1.75, 60.0), None, None, 9.0));
            let conditions = &mut scene.agents[2].conditions;
            conditions.start.position = Some(Vec2::new(1.75, -30.0));
            conditions.start.speed_mps = Some(5.0);
            conditions.length_m = Some(12.0);
            ask(scene, &["1", "3"])
        }),
    ),
    (
        "hand-made-pinned",
        Case::Generate(|| {
            let scene = crossing();
            let kept = (1..=90).filter_map(|step| scene.agents[0].state_at(step)).collect();
            Request { pinned: [("1".to_owned(), kept)].into(), ..ask(scene, &["1", "3", "4"]) }
        }),
    ),
    (
        "placement",
        Case::Place(|| PlaceRequest {
            amount: Amount::Count(30),
            keep: Some(Default::default()),
            seed: 7,
            ..PlaceRequest::new(Arc::new(demo("crossing")))
        }),
    ),
];

fn demo(name: &str) -> Scene {
    let bytes = std::fs::read(root().join(format!("assets/scenes/demo-{name}.json"))).unwrap();
    formats::native::read(&bytes).unwrap()
}

fn all(scene: Scene) -> Request {
    Request::new(Arc::new(scene))
}

fn ask(scene: Scene, agents: &[&str]) -> Request {
    Request { agents: Some(agents.iter().map(|id| (*id).to_owned()).collect()), ..all(scene) }
}

fn to(at: (f64, f64), heading_rad: Option<f64>, speed_mps: Option<f64>, time_s: f64) -> Goal {
    Goal { position: Some(Vec2::new(at.0, at.1)), heading_rad, speed_mps, time_s: Some(time_s) }
}

fn with_goal(mut scene: Scene, id: &str, goal: Goal) -> Scene {
    scene.agents.iter_mut().find(|a| a.id == id).unwrap().conditions.goal = goal;
    scene
}

/// Two streets that cross, with three cars, a cyclist, a pedestrian and a parked car.
fn crossing() -> Scene {
    use std::f64::consts::FRAC_PI_2;
    let lane = |id: &str, from: (f64, f64), to: (f64, f64), successors: &[&str]| {
        let (from, to) = (Vec2::new(from.0, from.1), Vec2::new(to.0, to.1));
        let n = (to - from).norm().ceil() as usize;
        let points: Vec<Vec2> = (0..=n).map(|i| from + (to - from) * (i as f64 / n as f64)).collect();
        Lane {
            width_m: Some(3.5),
            speed_limit_mps: Some(13.4),
            successors: successors.iter().map(|s| (*s).to_owned()).collect(),
            ..Lane::street(id, points)
        }
    };
    let map = LaneMap {
        lanes: vec![
            lane("w", (-100.0, -1.75), (-8.0, -1.75), &["we", "wn"]),
            lane("we", (-8.0, -1.75), (8.0, -1.75), &["e"]),
            lane("wn", (-8.0, -1.75), (1.75, 8.0), &["n"]),
            lane("e", (8.0, -1.75), (120.0, -1.75), &[]),
            lane("s", (1.75, -100.0), (1.75, -8.0), &["sn"]),
            lane("sn", (1.75, -8.0), (1.75, 8.0), &["n"]),
            lane("n", (1.75, 8.0), (1.75, 120.0), &[]),
        ],
        ..LaneMap::default()
    };
    let agent = |id: &str, agent_type, at: (f64, f64), heading_rad: f64, speed: f64| {
        let ahead = scene::geometry::direction(heading_rad);
        let state = |i: usize| {
            let p = Vec2::new(at.0, at.1) + ahead * (speed * 0.1 * i as f64);
            State { x_m: p.x, y_m: p.y, heading_rad, vx_mps: ahead.x * speed, vy_mps: ahead.y * speed }
        };
        Agent::bare(id, agent_type, Subtype::Unknown, (0..91).map(|i| Some(state(i))).collect())
    };
    let agents = vec![
        agent("1", AgentType::Vehicle, (-40.0, -1.75), 0.0, 8.0),
        agent("2", AgentType::Vehicle, (-60.0, -1.75), 0.0, 9.0),
        agent("3", AgentType::Vehicle, (1.75, -45.0), FRAC_PI_2, 8.0),
        agent("4", AgentType::Cyclist, (1.9, -20.0), FRAC_PI_2, 4.0),
        agent("5", AgentType::Pedestrian, (-12.0, 6.0), -FRAC_PI_2, 1.3),
        agent("6", AgentType::Vehicle, (-30.0, -6.5), 0.0, 0.0),
    ];
    Scene::bare("crossing", map, agents).checked().unwrap()
}
