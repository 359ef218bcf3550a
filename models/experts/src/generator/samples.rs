//! What tests of the generator's parts plan for.

use crate::features::agent::{AgentPlan, plan};
use crate::planning::world::World;
use scene::map::{Lane, LaneMap};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Goal, Scene, State, Subtype, Vec2};
use std::sync::Arc;

/// A car at the origin, going east at this speed on a long street.
pub(super) fn car_on_a_street(speed_mps: f64, goal: Goal) -> AgentPlan {
    let street: Vec<Vec2> = (0..=300).map(|i| Vec2::new(f64::from(i) - 50.0, 0.0)).collect();
    let map = LaneMap { lanes: vec![Lane::street("a", street)], ..LaneMap::default() };
    let start = State { vx_mps: speed_mps, ..State::default() };
    let mut car = Agent::bare("1", AgentType::Vehicle, Subtype::Car, vec![Some(start)]);
    car.conditions.goal = goal;
    let scene = Scene::bare("street", map, vec![car]);
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    plan(&world, &world.present[0])
}
