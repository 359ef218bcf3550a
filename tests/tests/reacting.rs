//! An agent changes its motion only for a cause: answers of the shipped weights to drags in the demo scenes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed test panics")]

use dragtraffic_tests::program::root;
use experts::{Answer, Cancel, Engine, Event, React, Request};
use scene::geometry::direction;
use scene::score::{SweptBoxes, overlap};
use scene::{AgentFutures, AgentType, Future, Generated, Goal, Sample, Scene, State};
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

static ENGINE: LazyLock<Engine> = LazyLock::new(|| Engine::built_in().unwrap());

const DEMOS: [&str; 5] = ["crossing", "roundabout", "arterial", "motorway", "residential"];

fn demo(name: &str) -> Scene {
    let bytes = std::fs::read(root().join(format!("assets/scenes/demo-{name}.json"))).unwrap();
    formats::native::read(&bytes).unwrap()
}

fn answer(request: Request) -> Answer {
    for event in ENGINE.generator.start(request, Cancel::default()).unwrap() {
        if let Event::Final(answer) = event.unwrap() {
            return answer;
        }
    }
    panic!("no answer");
}

/// A request that drags one road user; all others may react.
fn dragged(mut scene: Scene, id: &str, goal: Goal) -> Request {
    scene.agents.iter_mut().find(|a| a.id == id).unwrap().conditions.goal = goal;
    Request { agents: Some([id.to_owned()].into()), react: React::Everyone, ..Request::new(Arc::new(scene)) }
}

/// Moving road users of a scene, each with its last state.
fn moving(scene: &Scene) -> Vec<(String, State)> {
    let ends = scene.agents.iter().filter(|a| a.kind() != AgentType::Other).filter_map(|a| {
        let (first, last) = (a.state_at(0)?, a.state_at(90)?);
        ((last.position() - first.position()).norm() > 10.0).then(|| (a.id.clone(), last))
    });
    ends.collect()
}

/// Boxes at each third step: of a future, otherwise of the scene.
fn boxes(scene: &Scene, id: &str, future: Option<&Future>) -> SweptBoxes {
    let agent = scene.agent(id).unwrap();
    let states: Vec<Option<State>> = (3..=90)
        .step_by(3)
        .map(|step: usize| match future {
            Some(f) => step.checked_sub(f.first_step).and_then(|i| f.states.get(i)).copied(),
            None => agent.state_at(step),
        })
        .collect();
    SweptBoxes::of_states(states.iter().map(Option::as_ref), &agent.size)
}

fn chosen(futures: &AgentFutures) -> &Future {
    &futures.modes[futures.chosen]
}

/// Checks that every changed agent except the dragged one has a cause that would meet its former motion. Each
/// chain of causes must end at the dragged one. Returns the number of changed agents.
fn have_causes(scene: &Scene, asked: &str, sample: &Sample, what: &str) -> usize {
    for (id, futures) in sample.agents.iter().filter(|(id, _)| *id != asked) {
        let reaction = futures.reaction.as_ref().unwrap_or_else(|| panic!("{what}: {id} has no cause"));
        let kept = scene.generated.as_ref().and_then(|g| g.chosen_future(id));
        let cause = &sample.agents[&reaction.cause];
        let meets =
            overlap(&boxes(scene, id, kept), &boxes(scene, &reaction.cause, Some(chosen(cause)))).close;
        assert!(meets, "{what}: {id} would not have met {}", reaction.cause);
        let mut at = id.clone();
        for _ in 0..=sample.agents.len() {
            if at == asked {
                break;
            }
            at = sample.agents[&at].reaction.as_ref().unwrap().cause.clone();
        }
        assert_eq!(at, asked, "{what}: {id}");
        let future = chosen(futures);
        let first = scene.agent(id).unwrap().track.valid_steps().next().unwrap();
        assert_eq!(future.first_step, first + 1, "{what}: {id} begins where it is there");
    }
    sample.agents.len() - 1
}

#[test]
fn whoever_changes_has_a_cause_and_nobody_else_is_in_the_answer() {
    let mut changed = 0;
    for name in DEMOS {
        let scene = demo(name);
        for (k, (id, end)) in moving(&scene).into_iter().enumerate().step_by(3) {
            let ways = [(12.0, 0.0), (-12.0, 0.0), (0.0, 3.5), (0.0, -3.5)];
            let (along, across) = ways[(k / 3) % ways.len()];
            let ahead = direction(end.heading_rad);
            let left = direction(end.heading_rad + std::f64::consts::FRAC_PI_2);
            let goal =
                Goal { position: Some(end.position() + ahead * along + left * across), ..Goal::default() };
            let answer = answer(dragged(scene.clone(), &id, goal));
            changed += have_causes(&scene, &id, &answer.samples[0], &format!("{name}, {id}"));
        }
    }
    assert!(changed > 3, "{changed} answered");
}

/// The scene in which a road user keeps one of its futures.
fn keeping(mut scene: Scene, id: &str, futures: AgentFutures) -> Scene {
    let sample = Sample { agents: BTreeMap::from([(id.to_owned(), futures)]), ..Sample::default() };
    scene.generated = Some(Generated { samples: vec![sample], ..Generated::default() });
    scene
}

#[test]
fn picking_another_future_changes_those_alone_that_it_meets() {
    let scene = demo("crossing");
    let free = Request { agents: Some(["8".to_owned()].into()), ..Request::new(Arc::new(scene.clone())) };
    let futures = answer(free).samples[0].agents["8"].clone();
    for picked in 0..futures.modes.len() {
        let states = futures.modes[picked].states.clone();
        let request = dragged(scene.clone(), "8", Goal::default());
        let answer = answer(Request { pinned: [("8".to_owned(), states)].into(), ..request });
        // The kept future is given, so it is not part of the answer.
        let mut sample = answer.samples[0].clone();
        let kept = AgentFutures { chosen: picked, ..futures.clone() };
        assert!(!sample.agents.contains_key("8"));
        sample.agents.insert("8".to_owned(), kept);
        have_causes(&scene, "8", &sample, &format!("future {picked}"));
    }
}

#[test]
fn what_was_answered_before_is_kept_unless_something_new_is_in_the_way() {
    let scene = demo("crossing");
    let (id, end) = moving(&scene).swap_remove(0);
    let goal = Goal { position: Some(end.position() - direction(end.heading_rad) * 15.0), ..Goal::default() };
    let first = answer(dragged(scene.clone(), &id, goal));
    let kept = keeping(scene, &id, first.samples[0].agents[&id].clone());
    for (other, end) in moving(&kept).into_iter().filter(|(other, _)| *other != id).step_by(4) {
        let goal =
            Goal { position: Some(end.position() + direction(end.heading_rad) * 5.0), ..Goal::default() };
        let answer = answer(dragged(kept.clone(), &other, goal));
        for (who, futures) in answer.samples[0].agents.iter().filter(|(who, _)| **who != other) {
            assert!(futures.reaction.is_some(), "{other}: {who} has no cause");
        }
    }
}

#[test]
fn who_comes_in_later_brakes_for_what_stands_in_its_way() {
    let mut scene = demo("motorway");
    // A road user that drives on, and is first seen far behind the place where another one stops.
    let (id, _) = moving(&scene).into_iter().find(|(_, end)| end.speed_mps() > 15.0).unwrap();
    let log = scene.agent(&id).unwrap().track.clone();
    let size = scene.agent(&id).unwrap().size;
    let mut late = scene.agent(&id).unwrap().clone();
    late.id = "late".into();
    late.track.states = log.states.iter().take(61).copied().collect();
    late.track.first_step = 30;
    late.size = size;
    scene.agents.push(late);
    // The middle of its path: as far as it gets by braking evenly to a stop.
    let half_way = scene.agent(&id).unwrap().state_at(45).unwrap();
    let stops = Goal { position: Some(half_way.position()), speed_mps: Some(0.0), ..Goal::default() };
    let answer = answer(dragged(scene.clone(), &id, stops));
    let sample = &answer.samples[0];
    have_causes(&scene, &id, sample, "late");
    let late = sample.agents.get("late").unwrap();
    assert_eq!(chosen(late).first_step, 31);
    let meets = overlap(
        &boxes(&scene, "late", Some(chosen(late))),
        &boxes(&scene, &id, Some(chosen(&sample.agents[&id]))),
    );
    assert!(!meets.overlaps, "it would have met {id}");
}
