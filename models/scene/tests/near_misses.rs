//! The choice of futures compares boxes at every third step. It detects nearly all near misses that scores
//! find at every step.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    unused_crate_dependencies,
    missing_docs,
    reason = "a test"
)]

use scene::geometry::direction;
use scene::score::{
    Actor, Drivable, Exclude, PairChoice, ScoreInput, SweptBoxes, Thresholds, dangerous_moments, score,
};
use scene::{Agent, AgentType, LaneMap, STEP_S, State, Subtype};

const STEPS: usize = 91;
/// Steps between boxes of the fast test.
const STRIDE: usize = 3;

/// A car that is at the origin of the map after `after_s`.
fn passing(id: &str, heading_rad: f64, speed_mps: f64, after_s: f64) -> Agent {
    let at = |step: usize| {
        let way = direction(heading_rad);
        let place = way * (speed_mps * (step as f64 * STEP_S - after_s));
        let velocity = way * speed_mps;
        Some(State { x_m: place.x, y_m: place.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y })
    };
    Agent::bare(id, AgentType::Vehicle, Subtype::Car, (0..STEPS).map(at).collect())
}

fn has_near_miss(a: &Agent, b: &Agent) -> bool {
    let map = LaneMap::default();
    let drivable = Drivable::new(&map);
    let made = |agent| Actor { generated: true, log: None, ..Actor::of_log(agent) };
    let input = ScoreInput {
        actors: vec![made(a), made(b)],
        map: &map,
        signals: &[],
        drivable: &drivable,
        steps: 0..STEPS,
        pairs: PairChoice::All,
        exclude: Exclude::Nothing,
        thresholds: Thresholds::default(),
    };
    !score(&input).scene.near_misses.is_empty()
}

fn boxes(agent: &Agent) -> SweptBoxes {
    let steps = (STRIDE..STEPS).step_by(STRIDE);
    let states: Vec<Option<State>> = steps.map(|step| agent.state_at(step)).collect();
    SweptBoxes::of_states(states.iter().map(Option::as_ref), &agent.size)
}

#[test]
fn crossing_cars_that_scores_find_too_near_are_seen_between_two_looks() {
    let (mut found, mut missed) = (0, Vec::new());
    for heading_rad in [0.8, 1.2, 1.57, 2.2] {
        for speed_mps in [3.0, 5.0, 8.0, 12.0] {
            for tenth in 0..60 {
                let a = passing("a", 0.0, 7.0, 4.0 + 0.01 * f64::from(tenth));
                let b = passing("b", heading_rad, speed_mps, 4.4 + 0.04 * f64::from(tenth));
                if has_near_miss(&a, &b) {
                    found += 1;
                    if dangerous_moments(&boxes(&a), &boxes(&b)).next().is_none() {
                        missed.push((heading_rad, speed_mps, tenth));
                    }
                }
            }
        }
    }
    assert!(found > 100, "{found} near misses");
    // The gap between two moments is estimated from its rate at one of them.
    assert!(10 * missed.len() < found, "{} of {found}: {missed:?}", missed.len());
}

#[test]
fn cars_that_pass_with_room_are_no_danger() {
    let far = |after_s: f64| boxes(&passing("b", 1.57, 7.0, after_s));
    let a = boxes(&passing("a", 0.0, 7.0, 4.0));
    assert!(dangerous_moments(&a, &far(4.6)).next().is_some());
    assert!(dangerous_moments(&a, &far(6.5)).next().is_none());
}
