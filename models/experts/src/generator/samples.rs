//! What tests of the generator's parts plan for.

use crate::features::agent::{Planned, plan};
use crate::features::world::World;
use scene::map::{Lane, LaneMap};
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Conditions, Goal, Meta, Scene, Size, State, Subtype, Timing, Track, Vec2};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A car at the origin, going east at this speed on a long street.
pub(super) fn car_on_a_street(speed_mps: f64, goal: Goal) -> Planned {
    let street: Vec<Vec2> = (0..=300).map(|i| Vec2::new(f64::from(i) - 50.0, 0.0)).collect();
    let map = LaneMap { lanes: vec![Lane::street("a", street)], ..LaneMap::default() };
    let start = State { vx_mps: speed_mps, ..State::default() };
    let agent = Agent {
        id: "1".into(),
        agent_type: AgentType::Vehicle,
        subtype: Subtype::Car,
        role: None,
        size: Size::default_for(AgentType::Vehicle, Subtype::Car),
        track: Track { first_step: 0, states: vec![Some(start)], z_m: None },
        conditions: Conditions { goal, ..Conditions::default() },
    };
    let scene = Scene {
        id: None,
        name: "street".into(),
        meta: Meta::default(),
        time: Timing { steps: 91, now_step: 0 },
        map: Arc::new(map),
        signals: Vec::new(),
        agents: vec![agent],
        generated: None,
        extra: BTreeMap::new(),
    };
    let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    plan(&world, &world.present[0])
}
