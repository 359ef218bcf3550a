//! Recorded data after the start must not reach an answer, unless the user fixed it.
//!
//! Claimed, bit for bit, for every subset of the goal's fields and of the start's:
//! 1. Features and anchors of a road user depend on nothing logged after the start, neither its own nor
//!    another's, except the stated conditions.
//! 2. The answer for regenerated road users does not change with their own log after the start.
//! 3. When all are regenerated it does not change with any other's log either, in one window or several.
//!
//! Not claimed: verdicts on futures (faults that the recording also shows are not reported); *kept* road
//! users are obstacles with their kept motion; signals keep the program of the scene.

use super::*;
use ::scene::judge::About;
use ::scene::routes::LaneGraph;
use experts::features::agent::plan;
use experts::planning::world::World;

/// Moves every recorded state after the first step elsewhere.
fn other_future(mut scene: Scene, who: impl Fn(&Agent) -> bool) -> Scene {
    for agent in scene.agents.iter_mut().filter(|a| who(a)) {
        for state in agent.track.states.iter_mut().skip(1).flatten() {
            state.x_m += 17.0;
            state.y_m -= 9.0;
            state.heading_rad += 0.5;
            state.vx_mps *= 0.3;
        }
    }
    scene
}

/// Moves the start slightly, in the fields that the bits of `subset` name.
fn with_start(mut scene: Scene, id: &str, subset: u8) -> Scene {
    let agent = scene.agents.iter_mut().find(|a| a.id == id).unwrap();
    let start = agent.state_at(0).unwrap();
    agent.conditions.start = scene::Start {
        position: (subset & 1 > 0).then(|| start.position() + Vec2::new(1.5, 0.4)),
        heading_rad: (subset & 2 > 0).then_some(start.heading_rad + 0.1),
        speed_mps: (subset & 4 > 0).then(|| 0.8 * start.speed_mps()),
    };
    scene
}

/// All features of all agents, as text that distinguishes any two numbers.
fn features(scene: &Scene) -> String {
    let map = Arc::new(LaneGraph::new(&scene.map));
    let world = World::new(scene, map, 0);
    let planned = world.present.iter().map(|who| {
        let planned = plan(&world, who);
        format!("{:?} {:?} {:?}", planned.features, planned.anchors, planned.target)
    });
    planned.collect()
}

/// Two refinement steps are enough to mix all inputs.
fn quick(scene: Scene, agents: Option<&[&str]>) -> Request {
    Request { steps: 2, ..ask(scene, agents) }
}

#[test]
fn features_know_nothing_after_the_start() {
    for id in ["1", "4", "5"] {
        for goal in 0..8 {
            for start in 0..8 {
                let honest = with_start(with_goal(crossing(), id, goal), id, start);
                let changed = other_future(honest.clone(), |_| true);
                assert!(features(&honest) == features(&changed), "{id}: goal {goal:03b}, start {start:03b}");
            }
        }
    }
}

/// An answer's motions, without the verdicts on them.
fn answered(request: Request) -> Answer {
    let mut answer = run(&GENERATOR, request);
    let futures = answer.samples.iter_mut().flat_map(|s| s.agents.values_mut());
    futures.flat_map(|f| &mut f.modes).for_each(|future| future.about = About::default());
    answer.resolved.values_mut().for_each(|resolved| resolved.by_road = None);
    answer
}

#[test]
fn nothing_after_the_start_leaks_into_an_answer() {
    for id in ["1", "4", "5"] {
        for goal in 0..8 {
            // Each start subset is met, and each goal subset without a start too.
            for start in [0, goal, 7 - goal] {
                let honest = with_start(with_goal(crossing(), id, goal), id, start);
                let changed = other_future(honest.clone(), |a| a.id == id);
                let a = answered(quick(honest, Some(&[id])));
                let b = answered(quick(changed, Some(&[id])));
                assert!(a.samples == b.samples, "{id}: goal {goal:03b}, start {start:03b}");
                assert!(a.resolved == b.resolved, "{id}: goal {goal:03b}, start {start:03b}");
            }
        }
    }
}

#[test]
fn futures_of_others_do_not_leak_when_all_are_generated() {
    for goal in 0..8 {
        for start in [0, 7 - goal] {
            let honest = with_start(with_goal(crossing(), "1", goal), "1", start);
            let answer = answered(quick(honest.clone(), None));
            // One by one, so that two changes cannot cancel each other; then all at once.
            for other in ["2", "3", "6"] {
                let changed = other_future(honest.clone(), |a| a.id == other);
                let changed = answered(quick(changed, None));
                assert!(answer.samples == changed.samples, "{other}: goal {goal:03b}, start {start:03b}");
            }
            let changed = other_future(honest, |_| true);
            let changed = answered(quick(changed, None));
            assert!(answer.samples == changed.samples, "all: goal {goal:03b}, start {start:03b}");
        }
    }
}

#[test]
fn later_windows_know_no_more_of_the_log() {
    let ask = |scene: Scene| Request { horizon_steps: 200, replan_steps: Some(60), ..quick(scene, None) };
    for goal in [0, 5, 7] {
        let mut honest = with_start(with_goal(crossing(), "1", goal), "1", goal);
        honest.agents[0].conditions.goal.time_s = Some(14.0);
        let changed = other_future(honest.clone(), |_| true);
        let (a, b) = (answered(ask(honest)), answered(ask(changed)));
        assert!(a.samples == b.samples, "goal {goal:03b}");
        assert!(a.resolved == b.resolved, "goal {goal:03b}");
    }
}
