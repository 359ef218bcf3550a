//! The generator's guarantees, tested with random weights: they hold whatever the networks return.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use crossing::{agent, crossing};
use experts::{Answer, Cancel, Event, GenerateError, Generator, ReachReport, React, Request, WarningCode};
use scene::map::LaneMap;
use scene::motion::{MotionModel, MotionState, limit_excess};
use scene::preference::{Feedback, Verdict};
use scene::{Agent, AgentType, Future, Goal, Scene, State, Vec2};
use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

#[path = "generator/blocked_lane.rs"]
mod blocked_lane;
#[path = "generator/crossing.rs"]
mod crossing;
#[path = "generator/cut_ins.rs"]
mod cut_ins;
#[path = "generator/driving.rs"]
mod driving;
#[path = "generator/late_arrivals.rs"]
mod late_arrivals;
#[path = "generator/leaks.rs"]
mod leaks;
#[path = "generator/planning.rs"]
mod planning;
#[path = "generator/refining.rs"]
mod refining;
#[path = "generator/relations.rs"]
mod relations;
#[path = "generator/rollouts.rs"]
mod rollouts;
#[path = "generator/taking.rs"]
mod taking;
#[path = "generator/via.rs"]
mod via;
#[path = "generator/walking.rs"]
mod walking;

static GENERATOR: LazyLock<Generator> = LazyLock::new(|| Generator::random(3).unwrap().with_threads(1));

fn run(generator: &Generator, request: Request) -> Answer {
    for event in generator.start(request, Cancel::default()).unwrap() {
        if let Event::Final(answer) = event.unwrap() {
            return answer;
        }
    }
    panic!("no answer");
}

fn ask(scene: Scene, agents: Option<&[&str]>) -> Request {
    let mut request = Request::new(Arc::new(scene));
    request.agents = agents.map(|ids| ids.iter().map(|id| (*id).to_owned()).collect());
    request
}

fn with_goal(mut scene: Scene, id: &str, subset: u8) -> Scene {
    let agent = scene.agents.iter_mut().find(|a| a.id == id).unwrap();
    let end = agent.state_at(85).unwrap();
    agent.conditions.goal = Goal {
        position: (subset & 1 > 0).then(|| end.position()),
        heading_rad: (subset & 2 > 0).then_some(end.heading_rad),
        speed_mps: (subset & 4 > 0).then(|| end.speed_mps()),
        time_s: None,
    };
    scene
}

#[test]
fn neither_threads_nor_order_change_a_byte() {
    let scene = with_goal(crossing(), "1", 5);
    let one = run(&GENERATOR, ask(scene.clone(), None));
    let three = Generator::random(3).unwrap().with_threads(3);
    assert!(one.samples == run(&three, ask(scene.clone(), None)).samples, "threads");
    let mut turned = scene;
    turned.agents.reverse();
    let reversed = run(&GENERATOR, ask(turned, Some(&["1"])));
    let alone = run(&GENERATOR, ask(with_goal(crossing(), "1", 5), Some(&["1"])));
    assert!(reversed.samples == alone.samples, "order");
}

#[test]
fn seeds_repeat_and_differ() {
    let ask_seed = |seed: u64, diversity: f64| {
        let mut request = ask(crossing(), Some(&["1"]));
        request.seed = seed;
        request.diversity = diversity;
        run(&GENERATOR, request).samples
    };
    assert!(ask_seed(1, 1.0) == ask_seed(1, 1.0));
    assert!(ask_seed(1, 1.0) != ask_seed(2, 1.0));
    assert!(ask_seed(1, 0.0) == ask_seed(2, 0.0), "without diversity there is nothing to draw");
}

fn excess(scene: &Scene, id: &str, future: &Future) -> f64 {
    let agent = scene.agent(id).unwrap();
    let start = agent.state_at(0).unwrap();
    let model = MotionModel::new(agent.agent_type, agent.subtype, agent.size, start);
    let states: Vec<MotionState> = std::iter::once(&start)
        .chain(&future.states)
        .map(|s| MotionState { position: s.position(), heading_rad: s.heading_rad, velocity: s.velocity() })
        .collect();
    limit_excess(&model, &states)
}

#[test]
fn limits_hold_and_goals_are_met_in_every_event() {
    for subset in 0..8 {
        let scene = with_goal(with_goal(crossing(), "1", subset), "5", subset);
        let goal = scene.agent("1").unwrap().conditions.goal;
        let mut request = ask(scene.clone(), Some(&["1", "4", "5"]));
        request.diversity = 2.0;
        let mut events = 0;
        let mut call = GENERATOR.start(request, Cancel::default()).unwrap();
        while let Some(event) = call.next() {
            let samples = match event.unwrap() {
                Event::Accepted(_) => continue,
                Event::Draft(_) => vec![call.drafted().unwrap()],
                Event::Final(answer) => answer.samples,
            };
            events += 1;
            for (id, futures) in &samples[0].agents {
                let total: f64 = futures.modes.iter().map(|m| m.probability).sum();
                assert!((total - 1.0).abs() < 1e-9);
                for future in &futures.modes {
                    assert_eq!(future.states.len(), 90);
                    let excess = excess(&scene, id, future);
                    assert!(excess <= 0.0, "{id}: {excess} beyond a limit");
                }
            }
            let end = samples[0].agents["1"].modes[0].states[89];
            if let Some(position) = goal.position {
                assert!((position - end.position()).norm() < 0.1);
            }
            if let Some(heading) = goal.heading_rad {
                assert!(scene::wrap_angle(heading - end.heading_rad).abs() < 0.02);
            }
            if let Some(speed) = goal.speed_mps {
                assert!((speed - end.speed_mps()).abs() < 0.1);
            }
        }
        assert_eq!(events, 7, "initial, five steps, final");
    }
}

#[test]
fn what_cannot_be_reached_is_said_with_the_nearest_state() {
    let mut scene = crossing();
    scene.agents[0].conditions.goal =
        Goal { position: Some(Vec2::new(118.0, -1.75)), time_s: Some(4.0), ..Goal::default() };
    let answer = run(&GENERATOR, ask(scene, Some(&["1"])));
    let ReachReport::Unreachable { nearest, words, .. } = &answer.resolved["1"].reach else {
        panic!("158 m in 4 s were reached")
    };
    assert!(words.starts_with("Too far for 4.0 s"), "{words}");
    assert!(nearest.x_m > -20.0 && nearest.x_m < 40.0);
    assert!(answer.warnings.iter().any(|w| w.code == WarningCode::GoalUnreachable));
}

#[test]
fn parked_cars_keep_their_pose_to_the_last_bit() {
    let answer = run(&GENERATOR, ask(crossing(), None));
    let start = crossing().agent("6").unwrap().state_at(0).unwrap();
    let futures = &answer.samples[0].agents["6"];
    for state in &futures.modes[futures.chosen].states {
        assert_eq!((state.x_m, state.y_m, state.heading_rad), (start.x_m, start.y_m, start.heading_rad));
    }
}

#[test]
fn others_react_or_keep_what_they_do() {
    let mut scene = crossing();
    // A goal that makes car 1 turn left, in front of car 3.
    scene.agents[0].conditions.goal = Goal { position: Some(Vec2::new(1.75, 40.0)), ..Goal::default() };
    let mut request = ask(scene, Some(&["1"]));
    request.react = React::Everyone;
    let answer = run(&GENERATOR, request);
    let changed: BTreeSet<&str> = answer.samples[0].agents.keys().map(String::as_str).collect();
    assert!(changed.contains("1"));
    assert!(!changed.contains("6"), "a parked car has no reason to react");
}

#[test]
fn a_cancelled_call_stops() {
    let cancel = Cancel::default();
    let mut call = GENERATOR.start(ask(crossing(), None), cancel.clone()).unwrap();
    assert!(call.next().unwrap().is_ok());
    assert!(call.next().unwrap().is_ok());
    cancel.cancel();
    assert_eq!(call.next(), Some(Err(GenerateError::Cancelled)));
    assert_eq!(call.next(), None);
}

#[test]
fn unknown_road_users_are_refused() {
    let error = GENERATOR.start(ask(crossing(), Some(&["77"])), Cancel::default()).err();
    assert_eq!(error, Some(GenerateError::UnknownAgent("77".into())));
}

#[test]
fn a_small_move_of_the_goal_moves_the_answer_by_centimetres() {
    let goal = |x: f64| {
        let mut scene = crossing();
        scene.agents[0].conditions.goal = Goal { position: Some(Vec2::new(x, -1.9)), ..Goal::default() };
        let mut request = ask(scene, Some(&["1"]));
        // Without obstacles, because clearing an overlap would move the future by more than centimetres.
        request.stages.background_in_the_way = false;
        let answer = run(&GENERATOR, request);
        // Identified by its anchor, because probabilities of other modes may change their order.
        let modes = &answer.samples[0].agents["1"].modes;
        modes.iter().find(|m| m.anchor == Some(0)).unwrap().clone()
    };
    let mut last = goal(30.0);
    for i in 1..=12 {
        let next = goal(30.0 + 0.05 * f64::from(i));
        let moved = last.states.iter().zip(&next.states);
        let moved = moved.map(|(a, b)| (a.position() - b.position()).norm()).fold(0.0, f64::max);
        assert!(moved < 0.4, "{moved} m for 5 cm");
        last = next;
    }
}

#[test]
fn a_round_leaves_the_cards_of_a_wide_draw() {
    let request = || ask(crossing(), Some(&["1"])).round(Feedback::default());
    let answer = run(&GENERATOR, request());
    let round = answer.round.as_ref().unwrap();
    let futures = &answer.samples[0].agents["1"];
    assert_eq!((answer.samples.len(), futures.modes.len(), futures.chosen), (1, round.cards.len(), 0));
    assert!(
        futures.modes.len() > 1 && futures.modes.windows(2).all(|w| w[0].probability >= w[1].probability)
    );
    assert_eq!(run(&GENERATOR, request()).samples, answer.samples);
    // The rejected card is not among the next ones.
    let rejected = &round.cards[0];
    let places = rejected
        .places
        .iter()
        .map(|(id, at)| (id.clone(), at.iter().map(|[x, y]| Vec2::new(*x, *y)).collect()));
    let said = scene::preference::JudgedCard {
        features: rejected.features.clone(),
        verdict: Verdict::Reject,
        why: None,
        places: places.collect(),
    };
    let next = ask(crossing(), Some(&["1"])).round(Feedback { answers: vec![said], ..Feedback::default() });
    let next = run(&GENERATOR, next).round.unwrap();
    assert!(next.cards.iter().all(|card| card.places != rejected.places));
    // With several road users each sample is a card.
    let both = run(&GENERATOR, ask(crossing(), Some(&["1", "2"])).round(Feedback::default()));
    assert_eq!(both.samples.len(), both.round.unwrap().cards.len());
    assert!(both.samples.iter().all(|sample| sample.agents.len() == 2));
}
