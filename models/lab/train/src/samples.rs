//! Hand-made road users and scenes for tests.

use scene::map::Lane;
use scene::{Agent, AgentType, Future, LaneMap, STEP_S, Scene, State, Subtype, Vec2};

/// A state of eastward motion.
pub fn east(x_m: f64, y_m: f64, speed_mps: f64) -> State {
    State { x_m, y_m, heading_rad: 0.0, vx_mps: speed_mps, vy_mps: 0.0 }
}

/// A car that drives east from (0, 0) for this many steps.
pub fn log(id: &str, speed_mps: f64, steps: usize) -> Agent {
    let states = (0..steps).map(|i| Some(east(speed_mps * STEP_S * i as f64, 0.0, speed_mps)));
    Agent::bare(id, AgentType::Vehicle, Subtype::Car, states.collect())
}

/// The same car moved.
pub fn shifted(mut agent: Agent, x_m: f64, y_m: f64) -> Agent {
    for state in agent.track.states.iter_mut().flatten() {
        (state.x_m, state.y_m) = (state.x_m + x_m, state.y_m + y_m);
    }
    agent
}

/// A future east from (0, left) at constant speed.
pub fn straight(probability: f64, speed_mps: f64, left_m: f64) -> Future {
    let states = (1..=90).map(|i| east(speed_mps * STEP_S * f64::from(i), left_m, speed_mps));
    Future::bare(probability, 1, states.collect())
}

/// Road users on two straight lanes east.
pub fn scene(agents: Vec<Agent>) -> Scene {
    let lane = |id: &str, y: f64| {
        let points = (0..=30).map(|i| Vec2::new(f64::from(i) * 10.0 - 50.0, y)).collect::<Vec<_>>();
        Lane { speed_limit_mps: Some(13.4), ..Lane::street(id, points) }
    };
    let map = LaneMap { lanes: vec![lane("a", 0.0), lane("b", 3.5)], ..LaneMap::default() };
    Scene::bare("road", map, agents)
}
