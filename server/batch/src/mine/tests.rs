use super::{MinedEvent, MinedTag, mine};
use scene::map::{Lane, Neighbor};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, LaneMap, STEP_S, Scene, Signal, SignalState, State, Subtype, Vec2};

const STEPS: usize = 91;

fn agent(id: &str, kind: AgentType, at: impl Fn(f64) -> (f64, f64)) -> Agent {
    let state = |step: usize| {
        let time_s = step as f64 * STEP_S;
        let ((x_m, y_m), (x, y)) = (at(time_s), at(time_s + STEP_S));
        let (vx_mps, vy_mps) = ((x - x_m) / STEP_S, (y - y_m) / STEP_S);
        let heading_rad = if vx_mps.hypot(vy_mps) > 0.1 { vy_mps.atan2(vx_mps) } else { 0.0 };
        Some(State { x_m, y_m, heading_rad, vx_mps, vy_mps })
    };
    Agent::bare(id, kind, Subtype::Unknown, (0..STEPS).map(state).collect())
}

/// Two lanes to the east, side by side.
fn street() -> LaneMap {
    let lane = |id: &str, y: f64| Lane::street(id, vec![Vec2::new(-100.0, y), Vec2::new(300.0, y)]);
    let beside = |id: &str| {
        vec![Neighbor { lane: id.into(), own_range: (0, 1), other_range: (0, 1), boundaries: Vec::new() }]
    };
    let right = Lane { left_neighbors: beside("left"), ..lane("right", 0.0) };
    let left = Lane { right_neighbors: beside("right"), ..lane("left", 3.5) };
    LaneMap { lanes: vec![right, left], ..LaneMap::default() }
}

fn events(agents: Vec<Agent>) -> Vec<MinedEvent> {
    let scene = Scene::bare("", street(), agents);
    let graph = LaneGraph::new(&scene.map);
    mine(&scene, &graph, graph.ground())
}

fn tags(events: &[MinedEvent]) -> Vec<(MinedTag, &str, Option<&str>)> {
    events.iter().map(|event| (event.tag, event.actor.as_str(), event.other.as_deref())).collect()
}

/// From the left lane into the right one, from 3 to 6 s.
fn changes(t: f64, ahead_m: f64) -> (f64, f64) {
    let share = ((t - 3.0) / 3.0).clamp(0.0, 1.0);
    (ahead_m + 10.0 * t, 3.5 * (0.5 + 0.5 * (share * std::f64::consts::PI).cos()))
}

#[test]
fn a_change_of_lane_is_a_cut_in_where_one_follows_closely() {
    use AgentType::Vehicle;
    let alone = events(vec![agent("a", Vehicle, |t| changes(t, 0.0))]);
    assert_eq!(tags(&alone), [(MinedTag::LaneChange, "a", None)]);
    assert!((alone[0].time_s - 4.5).abs() < 0.6 && (alone[0].value.unwrap() - 10.0).abs() < 0.3, "{alone:?}");
    // 12 m behind, 7.3 m between the two: 0.73 s.
    let close = events(vec![
        agent("a", Vehicle, |t| changes(t, 0.0)),
        agent("b", Vehicle, |t| (10.0 * t - 12.0, 0.0)),
    ]);
    assert_eq!(tags(&close), [(MinedTag::CutIn, "a", Some("b")), (MinedTag::LaneChange, "a", None)]);
    assert!((close[0].value.unwrap() - 0.73).abs() < 0.05, "{close:?}");
    let far = events(vec![
        agent("a", Vehicle, |t| changes(t, 0.0)),
        agent("b", Vehicle, |t| (10.0 * t - 40.0, 0.0)),
    ]);
    assert_eq!(tags(&far), [(MinedTag::LaneChange, "a", None)]);
    // Swaying by one metre is no lane change.
    let sway = events(vec![agent("a", Vehicle, |t| (10.0 * t, (t * 0.7).sin()))]);
    assert_eq!(tags(&sway), []);
}

#[test]
fn a_walker_behind_a_parked_car_is_hidden() {
    let car = || agent("car", AgentType::Vehicle, |t| (10.0 * t - 50.0, 0.0));
    // Crosses at the origin, 5 s after the start; the car is there 1 s later.
    let walker = || agent("walker", AgentType::Pedestrian, |t| (14.0, 1.5 * t - 7.5));
    let parked = || agent("parked", AgentType::Vehicle, |_| (8.0, -3.0));
    let open = events(vec![car(), walker()]);
    assert!(tags(&open).contains(&(MinedTag::CloseCrossing, "car", Some("walker"))), "{open:?}");
    assert!(open.iter().all(|event| event.tag != MinedTag::HiddenWalker), "{open:?}");
    let hidden = events(vec![car(), walker(), parked()]);
    let found = hidden.iter().find(|event| event.tag == MinedTag::HiddenWalker).unwrap();
    assert!(found.value.unwrap() > 1.0, "{found:?}");
}

#[test]
fn boxes_that_shake_or_overlap_from_the_start_are_no_events() {
    use AgentType::{Pedestrian, Vehicle};
    // A walker beside a parked car, whose box overlaps it by half a metre, and one that walks into the car.
    let car = || agent("car", Vehicle, |_| (0.0, -6.0));
    let beside = events(vec![car(), agent("walker", Pedestrian, |t| (0.02 * t, -5.3))]);
    assert!(beside.iter().all(|event| event.tag != MinedTag::Collision), "{beside:?}");
    let into = events(vec![car(), agent("walker", Pedestrian, |t| (0.0, 2.0 - 1.5 * t))]);
    assert!(tags(&into).iter().any(|(tag, ..)| *tag == MinedTag::Collision), "{into:?}");
    // Back and forth by 0.4 m ten times a second, and at 3 m/s.
    let shakes = |t: f64| (40.0, -6.0 + if (t * 10.0).round() as i64 % 2 == 0 { 0.0 } else { 0.4 });
    let shaking = events(vec![agent("walker", Pedestrian, shakes)]);
    assert!(shaking.iter().all(|event| event.tag != MinedTag::Running), "{shaking:?}");
    let running = events(vec![agent("walker", Pedestrian, |t| (3.0 * t, -6.0))]);
    assert_eq!(running.iter().filter(|event| event.tag == MinedTag::Running).count(), 1, "{running:?}");
}

#[test]
fn a_light_that_turns_soon_after_lagged() {
    let red = |until: usize| {
        let signal = Signal {
            lane: "right".into(),
            stop: Some(Vec2::new(30.0, 0.0)),
            stop_z_m: None,
            runs: vec![(0, SignalState::Stop), (until, SignalState::Go)],
        };
        let mut scene = Scene::bare("", street(), vec![agent("a", AgentType::Vehicle, |t| (10.0 * t, 0.0))]);
        scene.signals = vec![signal];
        let graph = LaneGraph::new(&scene.map);
        let found = mine(&scene, &graph, graph.ground());
        found.iter().filter(|event| event.tag == MinedTag::RedLight).count()
    };
    // The front crosses after less than 3 s.
    assert_eq!([red(45), red(90)], [0, 1]);
}

#[test]
fn braking_turning_round_and_standing_are_told_apart() {
    // From 15 m/s at 6 m/s2.
    let brakes = |t: f64| {
        let braked_s = (t - 2.0).clamp(0.0, 2.5);
        (15.0 * (t - 2.0).min(0.0) + 15.0 * braked_s - 3.0 * braked_s * braked_s, 0.0)
    };
    let braking = events(vec![agent("a", AgentType::Vehicle, brakes)]);
    assert_eq!(tags(&braking), [(MinedTag::HardBraking, "a", None)]);
    assert!((braking[0].value.unwrap() - 6.0).abs() < 0.3, "{braking:?}");
    let round = |t: f64| {
        let angle = std::f64::consts::PI * ((t - 2.0) / 5.0).clamp(0.0, 1.0);
        let (before_m, after_m) = ((t - 2.0).min(0.0) * 4.0, (t - 7.0).max(0.0) * 4.0);
        (before_m + 6.4 * angle.sin() - after_m, 6.4 * (1.0 - angle.cos()))
    };
    let turned = events(vec![agent("a", AgentType::Vehicle, round)]);
    let turns: Vec<_> = turned.iter().filter(|event| event.tag == MinedTag::UTurn).collect();
    assert_eq!(turns.len(), 1, "{turned:?}");
    assert!((turns[0].time_s - 4.5).abs() < 0.3, "{turns:?}");
    assert_eq!(tags(&events(vec![agent("a", AgentType::Vehicle, |_| (0.0, 0.0))])), []);
}
