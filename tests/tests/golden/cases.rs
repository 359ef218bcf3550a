//! The calls with golden answers: three demo scenes and a hand-made one; each expert, with and without goals;
//! a long horizon, several samples, a fixed start, a pinned future, a placement.

use dragtraffic_tests::program::root;
use experts::placement::{Amount, PlaceRequest};
use experts::{React, Request};
use scene::{Goal, Scene, Vec2};
use std::sync::Arc;

/// The same scene as in the tests of the generator's promises.
#[path = "../../../models/experts/tests/generator/crossing.rs"]
#[allow(dead_code, reason = "its parts serve the other tests")]
mod crossing;

use crossing::crossing;

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
