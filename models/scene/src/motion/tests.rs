use super::*;
use crate::{AgentType, HORIZON_STEPS, Size, State, Subtype};
use proptest::prelude::*;
use proptest::strategy::ValueTree;

fn model(agent_type: AgentType, speed: f64) -> MotionModel {
    let start = State { x_m: 3.0, y_m: -2.0, heading_rad: 0.7, ..State::default() };
    let v = direction(start.heading_rad) * speed;
    let start = State { vx_mps: v.x, vy_mps: v.y, ..start };
    MotionModel::new(agent_type, Subtype::Unknown, Size::default_for(agent_type, Subtype::Unknown), start)
}

fn agent_type() -> impl Strategy<Value = AgentType> {
    prop_oneof![Just(AgentType::Vehicle), Just(AgentType::Pedestrian), Just(AgentType::Cyclist)]
}

fn knots() -> impl Strategy<Value = Knots> {
    (prop::array::uniform10(-9.0..6.0), prop::array::uniform10(-0.4..0.4))
        .prop_map(|(first, second)| Knots { first, second })
}

/// A target that some motion of the model within its limits certainly meets.
fn reachable(model: &MotionModel, knots: &Knots, step: usize, subset: u8) -> Target {
    let state = model.rollout(knots)[step];
    Target {
        step,
        position: (subset & 1 > 0).then_some(state.position),
        heading_rad: (subset & 2 > 0).then_some(state.heading_rad),
        speed_mps: (subset & 4 > 0).then_some(state.speed_mps()),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn rollouts_never_break_a_limit(kind in agent_type(), v in 0.0..25.0f64, u in knots()) {
        let v = if kind == AgentType::Pedestrian { v * 0.15 } else { v };
        let model = model(kind, v);
        let trajectory = model.rollout(&u);
        prop_assert!(limit_excess(&model, &trajectory) <= 0.0, "breach {}", limit_excess(&model, &trajectory));
        prop_assert_eq!(trajectory.len(), HORIZON_STEPS + 1);
    }

    #[test]
    fn reverse_never_goes_forwards(u in knots()) {
        let model = model(AgentType::Vehicle, 0.0).in_gear(Gear::Reverse);
        let trajectory = model.rollout(&u);
        prop_assert!(limit_excess(&model, &trajectory) <= 0.0);
        for w in trajectory.windows(2) {
            let along = (w[1].position - w[0].position).dot(&direction(w[0].heading_rad));
            // Off-tracking may move the box centre ahead by millimetres while it swings.
            prop_assert!(along <= 0.02, "{along}");
        }
    }
}

#[test]
fn jacobian_matches_finite_differences() {
    for (kind, v) in [(AgentType::Vehicle, 8.0), (AgentType::Cyclist, 4.0)] {
        let model = model(kind, v);
        let u = Knots {
            first: [0.3, -0.4, 0.5, 0.2, -0.7, 0.1, 0.6, -0.2, 0.0, 0.4],
            second: [0.01, 0.02, -0.03, 0.01, 0.04, -0.02, 0.01, 0.0, 0.02, -0.01],
        };
        let at = [37, 90];
        let exact = drive::sensitivities(&model, &u, &at);
        for c in 0..CONTROLS {
            let h = 1e-6;
            let nudge = |sign: f64| {
                let mut k = u;
                if c < KNOTS {
                    k.first[c] += sign * h
                } else {
                    k.second[c - KNOTS] += sign * h
                }
                drive::sensitivities(&model, &k, &at)
            };
            let (plus, minus) = (nudge(1.0), nudge(-1.0));
            for (i, e) in exact.iter().enumerate() {
                for row in 0..3 {
                    let numeric = (plus[i].value[row] - minus[i].value[row]) / (2.0 * h);
                    let error = (numeric - e.jacobian[row][c]).abs();
                    assert!(
                        error < 1e-4 * (1.0 + numeric.abs()),
                        "{row} {c}: {numeric} {}",
                        e.jacobian[row][c]
                    );
                }
            }
        }
    }
}

/// Random knots of the size that occurs in traffic.
fn gentle(kind: AgentType) -> impl Strategy<Value = Knots> {
    let second = if kind == AgentType::Pedestrian { 0.8 } else { 0.05 };
    let (lo, hi) = if kind == AgentType::Pedestrian { (0.2, 2.0) } else { (-1.2, 1.2) };
    (prop::array::uniform10(lo..hi), prop::array::uniform10(-second..second))
        .prop_map(|(first, second)| Knots { first, second })
}

fn success_rate(kind: AgentType, speed: f64, subset: u8) -> f64 {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let (mut met, n) = (0, 120);
    for i in 0..n {
        let u = gentle(kind).new_tree(&mut runner).expect("tree").current();
        let model = model(kind, speed);
        let target = reachable(&model, &model.legal(&u), [90, 60, 35][i % 3], subset);
        let answer = project(&model, &model.coasting(), &target, None);
        assert!(limit_excess(&model, &answer.trajectory) <= 0.0);
        let residuals = TargetError::of(&answer.trajectory[target.step], &target);
        assert_eq!(answer.reach.is_reached(), residuals.is_met());
        met += usize::from(answer.reach.is_reached());
    }
    met as f64 / f64::from(n as u32)
}

#[test]
fn projection_reaches_what_is_reachable_for_every_subset() {
    for kind in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
        for subset in 1..8u8 {
            let speed = if kind == AgentType::Pedestrian { 1.3 } else { 7.0 };
            let rate = success_rate(kind, speed, subset);
            println!("{kind:?} subset {subset:03b}: {rate:.3}");
            assert!(rate >= 0.96, "{kind:?} subset {subset:03b}: {rate}");
        }
    }
}

#[test]
fn what_is_out_of_reach_is_reported_with_its_limit() {
    let model = model(AgentType::Vehicle, 10.0);
    let ahead = |d: f64| model.start.position() + direction(model.start.heading_rad) * d;
    let cases = [
        (Target { step: 40, position: Some(ahead(200.0)), ..Target::default() }, Limiting::Speed),
        (Target { step: 40, position: Some(ahead(90.0)), ..Target::default() }, Limiting::Acceleration),
        (Target { step: 90, position: Some(ahead(3.0)), ..Target::default() }, Limiting::Braking),
        (Target { step: 10, speed_mps: Some(30.0), ..Target::default() }, Limiting::Acceleration),
    ];
    for (target, wanted) in cases {
        let answer = project(&model, &model.coasting(), &target, None);
        match answer.reach {
            Reach::Unreachable { limiting, residuals, nearest, .. } => {
                assert_eq!(limiting, wanted);
                assert!(!residuals.is_met());
                assert_eq!(nearest, answer.trajectory[target.step]);
            }
            Reach::Reached(r) => panic!("reached {target:?} with {r:?}"),
        }
    }
}

#[test]
fn a_small_move_of_the_goal_moves_the_answer_little() {
    let model = model(AgentType::Vehicle, 8.0);
    let base = model.to_scene(Vec2::new(55.0, 22.0));
    let ask = |p: Vec2| Target { step: 90, position: Some(p), ..Target::default() };
    let mut last = project(&model, &model.coasting(), &ask(base), None);
    for i in 1..=100 {
        let moved = base + Vec2::new(0.05 * f64::from(i), 0.03 * f64::from(i));
        let next = project(&model, &model.coasting(), &ask(moved), Some(&last.knots));
        let far = last.trajectory.iter().zip(&next.trajectory);
        let far = far.map(|(a, b)| (a.position - b.position).norm()).fold(0.0, f64::max);
        assert!(far < 0.25, "step {i}: answer moved {far} m for a 6 cm move of the goal");
        last = next;
    }
}

#[test]
fn fit_then_rollout_finds_the_track_again() {
    for kind in [AgentType::Vehicle, AgentType::Cyclist, AgentType::Pedestrian] {
        let mut runner = proptest::test_runner::TestRunner::deterministic();
        for _ in 0..50 {
            let u = gentle(kind).new_tree(&mut runner).expect("tree").current();
            let model = model(kind, if kind == AgentType::Pedestrian { 1.2 } else { 6.0 });
            let truth = model.rollout(&u);
            let samples: Vec<_> = (1..=18)
                .map(|i| Sampled {
                    step: 5 * i,
                    position: truth[5 * i].position,
                    heading_rad: truth[5 * i].heading_rad,
                })
                .collect();
            let back = model.rollout(&fit(&model, &samples, Smoothing::WISHED));
            let error: f64 = truth.iter().zip(&back).map(|(a, b)| (a.position - b.position).norm()).sum();
            assert!(error / 91.0 < 0.12, "{kind:?}: {}", error / 91.0);
        }
    }
}
