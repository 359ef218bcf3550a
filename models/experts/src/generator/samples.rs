//! Sample plans for tests of the generator's parts.

use crate::features::agent::{AgentPlan, plan};
use crate::planning::world::World;
use scene::map::{Lane, LaneMap};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, Scene, State, Subtype, Vec2};
use std::sync::Arc;

/// A car at the origin, going east at this speed on a long street.
pub(super) fn car_on_a_street(speed_mps: f64, goal: Goal) -> AgentPlan {
    let start = State { vx_mps: speed_mps, ..State::default() };
    let mut car = Agent::bare("1", AgentType::Vehicle, Subtype::Car, vec![Some(start)]);
    car.conditions.goal = goal;
    on_a_street(car)
}

/// A walker on the way to the same street, 6 m from its middle.
pub(super) fn walker_beside_a_street(speed_mps: f64) -> AgentPlan {
    let heading_rad = std::f64::consts::FRAC_PI_2;
    let start = State { y_m: -6.0, heading_rad, vy_mps: speed_mps, ..State::default() };
    on_a_street(Agent::bare("1", AgentType::Pedestrian, Subtype::Adult, vec![Some(start)]))
}

fn on_a_street(agent: Agent) -> AgentPlan {
    let street: Vec<Vec2> = (0..=300).map(|i| Vec2::new(f64::from(i) - 50.0, 0.0)).collect();
    let map = LaneMap { lanes: vec![Lane::street("a", street)], ..LaneMap::default() };
    let scene = Scene::bare("street", map, vec![agent]);
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    plan(&world, &world.present[0])
}
