//! Remedy for a goal that is reached only off the road or against the traffic: the nearest place that the
//! road reaches in the same time.

use super::targets::due;
use crate::maps::KnownMap;
use crate::planning::profile::Caps;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{ByRoad, Request};
use crate::tuning::fixed::remedies::{BENDS, LEAST_MOVE_M, PACE_MPS, SPEEDING_UP_MPS2, STOPPING_MPS2};
use scene::judge::FaultKind;
use scene::routes::speed::speed_caps;
use scene::routes::{Route, routes_ahead};
use scene::{AgentId, AgentType, STEP_S, Sample};
use std::collections::BTreeMap;

/// Remedies by road user, for each shown future that leaves the road or drives against the traffic to meet
/// its goal.
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
        // Greatest distance that the vehicle covers in this time.
        let longest_m =
            (v0 * seconds + 0.5 * SPEEDING_UP_MPS2 * seconds * seconds).min(PACE_MPS.max(v0) * seconds);
        let nearest_m = v0 * v0 / (2.0 * STOPPING_MPS2);
        let place = |route: Route| {
            let foot = route.path.project(goal);
            let farthest_m = gets_m(&route, v0, seconds);
            let at = route.path.sample(foot.s_m.clamp(nearest_m.min(farthest_m), farthest_m));
            let distance_m = (at.position - goal).norm();
            let (x_m, y_m, heading_rad) = (at.position.x, at.position.y, at.heading_rad);
            ByRoad { x_m, y_m, heading_rad, distance_m }
        };
        let places = routes_ahead(&map.graph, who.pose(), who.agent_type, longest_m).into_iter().map(place);
        let nearest = places.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m))?;
        // The goal itself lies on the road, so another place is no remedy.
        (nearest.distance_m >= LEAST_MOVE_M).then_some(())?;
        Some((agent.id.clone(), nearest))
    };
    world.present.iter().filter(wants).filter_map(found).collect()
}

/// Distance that a vehicle covers along a route in `seconds`, metres.
fn gets_m(route: &Route, start_mps: f64, seconds: f64) -> f64 {
    let caps_mps = speed_caps(&route.path, &[], BENDS);
    let caps = Caps::new(route.path.arc_m(), &caps_mps);
    let (mut along_m, mut speed_mps) = (0.0, start_mps);
    for _ in 0..(seconds / STEP_S).round() as usize {
        let fastest = (speed_mps + SPEEDING_UP_MPS2 * STEP_S).min(PACE_MPS.max(start_mps));
        let then = fastest.min(caps.at(along_m)).max(speed_mps - STOPPING_MPS2 * STEP_S);
        along_m += 0.5 * (speed_mps + then) * STEP_S;
        speed_mps = then;
    }
    along_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;
    use scene::routes::Polyline;

    fn route(points: impl IntoIterator<Item = Vec2>) -> Route {
        let (lateral_m, heading_error_rad, terminal) = (0.0, 0.0, true);
        let path = Polyline::new(points);
        Route { legs: Vec::new(), path, limits_mps: Vec::new(), lateral_m, heading_error_rad, terminal }
    }

    #[test]
    fn round_a_bend_one_gets_less_far() {
        let straight = route((0..300).map(|i| Vec2::new(f64::from(i), 0.0)));
        let ring = route((0..300).map(|i| {
            let turned = f64::from(i) / 17.0;
            Vec2::new(17.0 * turned.sin(), 17.0 * (1.0 - turned.cos()))
        }));
        let far_m = gets_m(&straight, 6.5, 9.0);
        assert!((105.0..115.0).contains(&far_m), "{far_m}");
        // 7 m/s at 3 m/s2 sideways.
        let round_m = gets_m(&ring, 6.5, 9.0);
        assert!((58.0..68.0).contains(&round_m), "{round_m}");
    }
}
