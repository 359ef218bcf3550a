//! Verdicts on a future that is not shown hold when the user takes it: the others react to it.

use super::crossing::crossing;
use super::{GENERATOR, ask, run};
use experts::{Answer, React, Request};
use scene::judge::{Fault, FaultKind, Judge};
use scene::score::{Actor, Drivable};
use scene::{Future, Goal, Scene, Vec2};
use std::collections::BTreeSet;

fn asked(scene: Scene) -> Request {
    Request { react: React::Everyone, ..ask(scene, Some(&["1"])) }
}

/// Faults that involve others, rounded to a tenth.
fn with_others<'a>(faults: impl IntoIterator<Item = &'a Fault>) -> BTreeSet<(FaultKind, String, i64)> {
    let found = faults.into_iter().filter_map(|f| Some((f, f.with.clone()?)));
    found.map(|(f, with)| (f.kind, with, (10.0 * f.time_s).round() as i64)).collect()
}

/// The same for a future of the first agent, among the others as in the answer.
fn among(scene: &Scene, answer: &Answer, future: &Future) -> BTreeSet<(FaultKind, String, i64)> {
    let drivable = Drivable::new(&scene.map);
    let judge = Judge::new(&scene.map, &scene.signals, &drivable, 0..91);
    let others: Vec<_> = scene
        .agents
        .iter()
        .filter(|agent| agent.id != "1")
        .map(|agent| match answer.samples[0].agents.get(&agent.id) {
            Some(futures) => Actor::of_future(agent, &futures.modes[futures.chosen], &[]),
            None => Actor::of_log(agent),
        })
        .map(|actor| judge.other(actor))
        .collect();
    with_others(&judge.among(&Actor::of_future(&scene.agents[0], future, &[]), others.iter()))
}

fn who_answers(answer: &Answer) -> BTreeSet<&str> {
    answer.samples[0].agents.keys().map(String::as_str).filter(|id| *id != "1").collect()
}

#[test]
fn a_future_is_judged_by_what_the_others_do_when_it_is_taken() {
    let (mut others_differ, mut faults_differ) = (0, 0);
    for (x_m, y_m) in [(1.75, 40.0), (40.0, -1.75), (1.75, 20.0), (15.0, -1.75), (-1.75, -25.0)] {
        let mut scene = crossing();
        scene.agents[0].conditions.goal = Goal { position: Some(Vec2::new(x_m, y_m)), ..Goal::default() };
        let answer = run(&GENERATOR, asked(scene.clone()));
        for future in &answer.samples[0].agents["1"].modes {
            let mut request = asked(scene.clone());
            request.pinned.insert("1".into(), future.states.clone());
            let taken = run(&GENERATOR, request);
            let said = with_others(&future.about.faults);
            assert_eq!(said, among(&scene, &taken, future), "goal {x_m}, {y_m}");
            others_differ += usize::from(who_answers(&answer) != who_answers(&taken));
            faults_differ += usize::from(said != among(&scene, &answer, future));
        }
    }
    assert!(others_differ > 0 && faults_differ > 0, "others answer all futures alike: this shows nothing");
}
