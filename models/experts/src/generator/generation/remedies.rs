//! The way out of a goal that is reached only over what nobody drives over: the nearest place that the road leads to
//! in the same time.

use super::targets::due;
use crate::generator::KnownMap;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{ByRoad, Request};
use scene::judge::FaultKind;
use scene::routes::routes_ahead;
use scene::{AgentId, AgentType, STEP_S, Sample};
use std::collections::BTreeMap;

/// What a driver makes of the time without hurry: speeding up, m/s2, to a pace, m/s.
const SPEEDING_UP_MPS2: f64 = 1.5;
const PACE_MPS: f64 = 13.9;
/// Who brakes harder than this does not stop gently, m/s2.
const STOPPING_MPS2: f64 = 3.0;

/// A place nearer to the goal than this is the goal, metres.
const LEAST_MOVE_M: f64 = 1.0;

/// By road user whose shown future leaves the road or drives against the traffic to meet its goal.
pub(super) fn by_road(
    request: &Request,
    world: &World<'_>,
    map: &KnownMap,
    sample: &Sample,
) -> BTreeMap<AgentId, ByRoad> {
    let leaves = |kind| matches!(kind, FaultKind::OverMedian | FaultKind::OffRoad | FaultKind::WrongWay);
    let wants = |who: &&AgentAtStart| {
        let futures = sample.agents.get(&world.agent(who).id);
        let shown = futures.and_then(|f| f.modes.get(f.chosen));
        who.agent_type == AgentType::Vehicle
            && shown.is_some_and(|f| f.about.faults.iter().any(|fault| leaves(fault.kind)))
    };
    let found = |who: &AgentAtStart| {
        let agent = &request.scene.agents[who.index];
        let goal = agent.conditions.goal.position?;
        let seconds = due(request, who.index).max(1) as f64 * STEP_S;
        let v0 = who.start.speed_mps();
        let farthest_m =
            (v0 * seconds + 0.5 * SPEEDING_UP_MPS2 * seconds * seconds).min(PACE_MPS.max(v0) * seconds);
        let nearest_m = v0 * v0 / (2.0 * STOPPING_MPS2);
        let place = |route: scene::routes::Route| {
            let foot = route.path.project(goal);
            let at = route.path.sample(foot.s_m.clamp(nearest_m.min(farthest_m), farthest_m));
            let distance_m = (at.position - goal).norm();
            let (x_m, y_m, heading_rad) = (at.position.x, at.position.y, at.heading_rad);
            ByRoad { x_m, y_m, heading_rad, distance_m }
        };
        let places = routes_ahead(&map.graph, who.pose(), who.agent_type, farthest_m).into_iter().map(place);
        let nearest = places.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m))?;
        // The goal itself lies on the road: another place is no way out.
        (nearest.distance_m >= LEAST_MOVE_M).then_some(())?;
        Some((agent.id.clone(), nearest))
    };
    world.present.iter().filter(wants).filter_map(found).collect()
}
