//! Road users that enter later: one whose place is taken then stays out, and names the cause.

use super::crossing::{agent, street};
use super::{GENERATOR, ask, run};
use experts::{React, Request};
use scene::judge::ReactionKind;
use scene::score::{Drivable, ScoreInput, score};
use scene::{Agent, AgentType, Scene, State};

/// On the street from a step on, at this place and speed.
fn late(id: &str, first_step: usize, x_m: f64, speed_mps: f64) -> Agent {
    let mut late = agent(id, AgentType::Vehicle, (x_m, -1.75), 0.0, speed_mps);
    let at = |i: usize| {
        let x_m = x_m + 0.1 * speed_mps * i as f64;
        Some(State { x_m, y_m: -1.75, vx_mps: speed_mps, ..State::default() })
    };
    late.track.first_step = first_step;
    late.track.states = (0..91 - first_step).map(at).collect();
    late
}

/// A standing car, one that is recorded again in its place, one that enters at speed right before it, and one
/// with room.
fn scene() -> Scene {
    let stands = agent("stands", AgentType::Vehicle, (0.0, -1.75), 0.0, 0.0);
    let others = [late("again", 20, 0.4, 0.0), late("fast", 40, -4.8, 15.0), late("room", 30, 40.0, 4.0)];
    let agents = std::iter::once(stands).chain(others).collect();
    Scene::bare("late", street(), agents).checked().unwrap()
}

fn collisions(scene: &Scene, sample: &scene::Sample) -> usize {
    let drivable = Drivable::new(&scene.map);
    score(&ScoreInput::of_sample(scene, Some(sample), &drivable)).scene.collisions.len()
}

#[test]
fn a_road_user_whose_place_is_taken_does_not_come_in() {
    let scene = scene();
    for horizon_steps in [90, 180] {
        let request = Request { react: React::Everyone, horizon_steps, ..ask(scene.clone(), None) };
        let answer = run(&GENERATOR, request);
        let sample = &answer.samples[0];
        for (id, step) in [("again", 20), ("fast", 40)] {
            let futures = &sample.agents[id];
            let reaction = futures.reaction.as_ref().unwrap();
            assert_eq!((reaction.kind, reaction.cause.as_str()), (ReactionKind::StaysOut, "stands"), "{id}");
            assert!((reaction.time_s - 0.1 * f64::from(step)).abs() < 1e-9, "{id}: {}", reaction.time_s);
            assert!(futures.modes.len() == 1 && futures.modes[0].states.is_empty(), "{id}");
            // Absent from the start on.
            let shown = scene.agent(id).unwrap().shown(futures.modes.first());
            assert_eq!((0..91).filter_map(|step| shown.track.at(step)).count(), 0, "{id}");
        }
        let room = sample.agents.get("room");
        assert!(room.is_none_or(|f| f.reaction.as_ref().is_none_or(|r| r.kind != ReactionKind::StaysOut)));
        assert_eq!(collisions(&scene, sample), 0, "{horizon_steps} steps");
    }
}

#[test]
fn nobody_stays_out_where_nobody_may_react() {
    let scene = scene();
    let answer = run(&GENERATOR, Request { react: React::Nobody, ..ask(scene.clone(), None) });
    assert!(!answer.samples[0].agents.contains_key("again"));
    assert!(collisions(&scene, &answer.samples[0]) > 0);
}
