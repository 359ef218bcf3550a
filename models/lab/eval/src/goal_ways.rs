//! Whether a road user can reach a goal along the road in time, and whether the goal is free.

use super::{Case, Site};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::limits::Limits;
use scene::routes::{GoalQuery, Pose, Route, RouteKind, routes_to_goal};
use scene::score::Thresholds;
use scene::{Goal, STEP_S};

/// Share of the motion limits that a path may use to count as feasible in time, because there are bends.
const PRESSED_SHARE: f64 = 0.8;

/// Distance between the points of a path at which its greatest speed is computed, metres.
const SPACING_M: f64 = 1.0;
/// Length over which bends are measured, metres.
const BEND_M: f64 = 4.0;

/// How a route along the traffic leads to a goal; the best path counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum InTime {
    /// No route leads there in time, or the road has no room there.
    No,
    /// Within the motion limits.
    Pressed,
    /// Also without a speed fault: no speeding, harsh braking or harsh steering in bends.
    Lawful,
}

/// How a route along the traffic leads to the goal in time, if the road has room for the vehicle there.
pub(super) fn in_time(site: &Site<'_>, case: &Case, goal: &Goal) -> InTime {
    let Some(position) = goal.position else { return InTime::No };
    let size = site.log(case).size;
    let lane = site.graph.nearest_for(position, 3.0, case.agent_type).into_iter().next();
    let place = lane
        .map(|lane| OrientedBox::new(position, 0.5 * size.length_m, 0.5 * size.width_m, lane.heading_rad));
    if place.and_then(|place| site.drivable.box_outside_m(&place)).is_none_or(|outside| outside > 0.15) {
        return InTime::No;
    }
    let query = GoalQuery {
        pose: Pose::new(case.start.position(), case.start.heading_rad),
        speed_mps: case.start.speed_mps(),
        agent_type: case.agent_type,
        goal: position,
        goal_heading_rad: goal.heading_rad,
        least_effort_m: None,
    };
    let routes = routes_to_goal(&site.graph, &query);
    let ways = routes.iter().filter(|r| r.kind == RouteKind::Forward && r.goal_lateral_m.abs() < 1.5);
    let how = |route: &Route| {
        if !is_in_time(site, case, route.path.length_m()) {
            InTime::No
        } else if is_lawful(site, case, route) {
            InTime::Lawful
        } else {
            InTime::Pressed
        }
    };
    ways.map(|r| how(&r.route)).max().unwrap_or(InTime::No)
}

/// Whether a path of this length can be driven until the goal is due: it is neither too long nor too short
/// for braking.
fn is_in_time(site: &Site<'_>, case: &Case, length_m: f64) -> bool {
    let limits = limits(site, case);
    let (v0, seconds) = (case.start.speed_mps(), case.goal_step as f64 * STEP_S);
    let accel = limits.accel_mps2;
    let speeding_s = seconds.min((limits.speed_mps - v0).max(0.0) / accel);
    let most_m = v0 * seconds + accel * speeding_s * (seconds - 0.5 * speeding_s);
    let least_m = braked_m(v0, seconds, limits.brake_mps2);
    (least_m / PRESSED_SHARE..=PRESSED_SHARE * most_m).contains(&length_m)
}

/// Whether that is possible without a speed fault: below the speeds that count as speeding, also in bends,
/// and with moderate braking.
fn is_lawful(site: &Site<'_>, case: &Case, route: &Route) -> bool {
    let thresholds = Thresholds::default();
    let (v0, seconds) = (case.start.speed_mps(), case.goal_step as f64 * STEP_S);
    let (path, length_m) = (&route.path, route.path.length_m());
    let brake = thresholds.harsh_brake_mps2;
    let count = (length_m / SPACING_M).ceil().max(1.0) as usize;
    let at_m = |i: usize| length_m * i as f64 / count as f64;
    let most_mps = |i: usize| {
        let bend = path.curvature_at(at_m(i), BEND_M).abs();
        let point = (route.limits_mps.len().saturating_sub(1) as f64 * at_m(i) / length_m.max(1e-6)) as usize;
        let limit = route.limits_mps.get(point).copied().unwrap_or(f64::INFINITY);
        let limit = limit * (1.0 + thresholds.speeding_share) + thresholds.speeding_mps;
        limit.min((thresholds.harsh_lateral_mps2 / bend.max(1e-6)).sqrt())
    };
    let mut most: Vec<f64> = (0..=count).map(most_mps).collect();
    let step_m = length_m / count as f64;
    for i in (0..count).rev() {
        most[i] = most[i].min((most[i + 1].powi(2) + 2.0 * brake * step_m).sqrt());
    }
    let accel = PRESSED_SHARE * limits(site, case).accel_mps2;
    let (mut speed, mut least_s) = (v0, 0.0);
    for most in &most[1..] {
        // A road user that is too fast at the start slows down.
        let slowed = (speed * speed - 2.0 * brake * step_m).max(0.0).sqrt();
        let next = (speed * speed + 2.0 * accel * step_m).sqrt().min(most.max(slowed));
        least_s += step_m / (0.5 * (speed + next)).max(0.1);
        speed = next;
    }
    least_s <= seconds && braked_m(v0, seconds, brake) <= length_m
}

/// Distance of a vehicle that brakes at this rate, metres.
fn braked_m(v0: f64, seconds: f64, brake_mps2: f64) -> f64 {
    let braking_s = seconds.min(v0 / brake_mps2);
    v0 * braking_s - 0.5 * brake_mps2 * braking_s * braking_s
}

fn limits(site: &Site<'_>, case: &Case) -> Limits {
    let log = site.log(case);
    Limits::of(case.agent_type, log.subtype, log.size.length_m)
}

/// Whether no logged road user occupies the goal when it is due. A free heading is that of the lane there,
/// else that of the straight line from the start.
pub(super) fn is_free(site: &Site<'_>, case: &Case, goal: &Goal) -> bool {
    let Some(position) = goal.position else { return false };
    let size = site.log(case).size;
    let lane = site.graph.nearest_for(position, 3.0, case.agent_type).into_iter().next();
    let chord = position - case.start.position();
    let heading_rad = lane.map_or(chord.y.atan2(chord.x), |lane| lane.heading_rad);
    let heading_rad = goal.heading_rad.unwrap_or(heading_rad);
    let place = OrientedBox::new(position, 0.5 * size.length_m, 0.5 * size.width_m, heading_rad);
    let there = |agent: &scene::Agent| {
        let state = agent.state_at(case.goal_step)?;
        Some(overlaps(&place, &OrientedBox::of_state(&state, &agent.size), 0.0))
    };
    let mut others = site.scene.agents.iter().enumerate().filter(|(i, _)| *i != case.agent);
    !others.any(|(_, agent)| there(agent) == Some(true))
}
