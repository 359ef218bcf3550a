//! Share of vehicles' states that are off the road.

use super::Site;
use super::stats::Value;
use super::together::STRIDE;
use scene::geometry::obb::OrientedBox;
use scene::{AgentType, HORIZON_STEPS, State};

/// Distance from every lane above which a vehicle is off the road, metres.
const OFF_LANES_M: f64 = 2.5;
/// Distance of a corner beyond a road edge above which it is past it, metres.
const PAST_EDGE_M: f64 = 0.1;

/// Steps that a vehicle spends off the road, of every third step at which its log is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OffRoad {
    /// Steps evaluated.
    pub steps: f64,
    /// Evaluated steps more than 2.5 m off every lane.
    pub off_lanes: f64,
    /// Steps evaluated where the map has edges.
    pub edge_steps: f64,
    /// Evaluated steps with a corner past a road edge.
    pub past_edges: f64,
}

impl OffRoad {
    /// Counts the states at steps 1 ..= 90 of an agent of the scene; zero for all types except vehicles.
    pub fn of(site: &Site<'_>, agent: usize, states: &[State]) -> Self {
        let mut out = Self::default();
        let agent = &site.scene.agents[agent];
        if agent.agent_type != AgentType::Vehicle {
            return out;
        }
        let has_edges = !site.scene.map.road_edges.is_empty() || !site.scene.map.drivable.is_empty();
        let known = (1..=HORIZON_STEPS).filter(|step| step % STRIDE == 0 && agent.track.at(*step).is_some());
        for state in known.filter_map(|step| states.get(step - 1)) {
            let lanes = site.graph.nearest_for(state.position(), OFF_LANES_M, AgentType::Vehicle);
            out.steps += 1.0;
            out.off_lanes += f64::from(u8::from(lanes.is_empty()));
            let outline = OrientedBox::of_state(state, &agent.size);
            if has_edges && let Some(outside_m) = site.drivable.box_outside_m(&outline) {
                out.edge_steps += 1.0;
                out.past_edges += f64::from(u8::from(outside_m > PAST_EDGE_M));
            }
        }
        out
    }

    /// Adds another's steps.
    pub fn add(&mut self, other: &Self) {
        self.steps += other.steps;
        self.off_lanes += other.off_lanes;
        self.edge_steps += other.edge_steps;
        self.past_edges += other.past_edges;
    }

    /// Shares away from every lane and past an edge, for the scene of this index.
    pub fn shares(&self, site: usize) -> [Value; 2] {
        [Value::share(site, self.off_lanes, self.steps), Value::share(site, self.past_edges, self.edge_steps)]
    }
}
