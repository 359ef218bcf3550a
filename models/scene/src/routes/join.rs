//! Paths beside the lanes: joins onto lanes that lead to a goal, and exits from lanes to a goal beside them.

use super::cubic::{self, Cubic, comfortable_curvature};
use super::start::errors_at;
use super::to_goal::{GoalQuery, GoalRoute, RouteKind};
use super::{EndPose, LaneGraph, LaneHit, Leg, Polyline, Pose, Route, assemble, blend};
use crate::wrap_angle;

/// Greatest length of a join, relative to the motion of least effort.
const LONGEST_JOIN: f64 = 1.25;
/// Nearest and farthest point of the lane path that is joined, metres.
const JOIN_M: (f64, f64) = (3.0, 45.0);
/// Distance between the candidate points, metres.
const JOIN_STEP_M: f64 = 2.0;
/// Most paths traced backwards, and most lanes in each.
const MAX_PATHS: usize = 8;
const MAX_LANES: usize = 9;
/// Most goal lanes from which paths are traced backwards.
const MAX_GOAL_LANES: usize = 4;
/// Sharpest curvature of a join, relative to a comfortable one. Tight U-turns still show where to turn; knots
/// and projection widen them.
const SHARPEST_JOIN: f64 = 6.0;
/// Sharpest curvature to a goal off the lanes, relative to a comfortable one.
const SHARPEST_LEAVING: f64 = 2.0;

/// A path that ends at the goal: lanes in driving order with the arc length at which each begins.
struct LeadIn {
    legs: Vec<Leg>,
    path: Polyline,
}

/// The cheapest path by one cubic from the road user onto lanes that lead to the goal.
pub(super) fn joined(graph: &LaneGraph, query: &GoalQuery, goals: &[LaneHit]) -> Option<GoalRoute> {
    let limit = comfortable_curvature(query.agent_type);
    let far = 1.3 * query.distance_m() + 30.0;
    let mut best: Option<(f64, f64, Cubic, LeadIn)> = None;
    for lead_in in lead_ins(graph, query, goals, far) {
        let Some((cost, s, cubic)) = cheapest_join(&lead_in.path, query.pose, limit) else { continue };
        if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
            best = Some((cost, s, cubic, lead_in));
        }
    }
    let (cost, s, cubic, lead_in) =
        best.filter(|(_, _, cubic, _)| cubic.max_curvature <= SHARPEST_JOIN * limit)?;
    let rest = lead_in.path.slice(s, lead_in.path.length_m());
    let joined_m = cubic.path.length_m();
    let length_m = joined_m + rest.length_m();
    if query.least_effort_m.is_some_and(|least| length_m > LONGEST_JOIN * least) {
        return None;
    }
    let points = cubic.path.points().iter().chain(rest.points().iter().skip(1)).copied();
    let path = Polyline::new(points).resample(1.0);
    let legs = cut_legs(&lead_in.legs, s, joined_m);
    let limits_mps = assemble::limits(graph, &legs, &path);
    let (lateral_m, heading_error_rad) = errors_at(query.pose, path.first());
    let route = Route { legs, path, limits_mps, lateral_m, heading_error_rad, terminal: false };
    Some(GoalRoute { route, kind: RouteKind::Joined, goal_lateral_m: 0.0, cost })
}

/// Legs of the part of a path beyond `s_m`, which now begins `joined_m` along another.
fn cut_legs(legs: &[Leg], s_m: f64, joined_m: f64) -> Vec<Leg> {
    let end = |i: usize| legs.get(i + 1).map_or(f64::INFINITY, |next| next.path_from_m);
    let ahead = legs.iter().enumerate().filter(|(i, _)| end(*i) > s_m);
    let moved = ahead.map(|(_, leg)| {
        let skipped = (s_m - leg.path_from_m).max(0.0);
        let from_m = (leg.from_m + skipped).min(leg.to_m);
        Leg { from_m, path_from_m: joined_m + (leg.path_from_m - s_m).max(0.0), ..*leg }
    });
    moved.collect()
}

/// Paths traced backwards from the goal lanes along predecessors until they are `far_m` long.
fn lead_ins(graph: &LaneGraph, query: &GoalQuery, goals: &[LaneHit], far_m: f64) -> Vec<LeadIn> {
    let lanes = graph.lanes();
    let mut found = Vec::new();
    for goal in goals.iter().take(MAX_GOAL_LANES) {
        // Chains of (lane, end) backwards from the goal, and their length.
        let mut open = vec![(vec![(goal.lane, goal.s_m)], goal.s_m)];
        while let Some((chain, length)) = open.pop() {
            let Some((lane, _)) = chain.last().copied() else { continue };
            let usable = |p: &&usize| {
                lanes[**p].carries(query.agent_type) && chain.iter().all(|(known, _)| known != *p)
            };
            let before: Vec<usize> = lanes[lane].predecessors.iter().filter(usable).copied().collect();
            if length >= far_m || before.is_empty() || chain.len() >= MAX_LANES {
                found.push(lead_in(graph, query, &chain));
                if found.len() >= MAX_PATHS {
                    return found;
                }
                continue;
            }
            for p in before.into_iter().rev() {
                let own = lanes[p].path.length_m();
                let longer = chain.iter().copied().chain([(p, own)]).collect();
                open.push((longer, length + own));
            }
        }
    }
    found
}

/// Lanes in driving order as a path that ends exactly at the goal.
fn lead_in(graph: &LaneGraph, query: &GoalQuery, backwards: &[(usize, f64)]) -> LeadIn {
    let (mut points, mut legs, mut length) = (Vec::new(), Vec::new(), 0.0);
    for (lane, to_m) in backwards.iter().rev().copied() {
        legs.push(Leg { lane, from_m: 0.0, to_m, path_from_m: length });
        points.extend(graph.lanes()[lane].path.slice(0.0, to_m).points().iter().copied());
        length += to_m;
    }
    let centre = Polyline::new(points).resample(1.0).smoothed(2.0);
    // Leads in at walking pace: the shortest comfortable bend leaves most room for the join.
    let goal = EndPose { position: query.goal, heading_rad: query.goal_heading_rad, speed_mps: 0.0 };
    LeadIn { legs, path: blend::ending_at(&centre, goal, query.agent_type) }
}

/// Cheapest cubic onto `path`: cost with the rest of the path, arc length where it joins, the cubic.
fn cheapest_join(path: &Polyline, from: Pose, limit: f64) -> Option<(f64, f64, Cubic)> {
    let mut best: Option<(f64, f64, Cubic)> = None;
    let tries = (path.length_m() / JOIN_STEP_M) as usize;
    for i in 0..=tries {
        let s = JOIN_STEP_M * i as f64;
        let to = path.sample(s);
        let distance = (to.position - from.position).norm();
        if !(JOIN_M.0..=JOIN_M.1).contains(&distance) {
            continue;
        }
        let rest = path.length_m() - s;
        // The straight line is a lower bound, so candidates that cannot win are skipped.
        if best.as_ref().is_some_and(|(least, ..)| 1.6 * distance + rest >= *least) {
            continue;
        }
        let join = cubic::best(from, to, limit);
        let cost = cubic::cost(&join, limit) + rest;
        if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
            best = Some((cost, s, join));
        }
    }
    best
}

/// The route bent off its lane to a goal beside it; `None` if that needs too sharp a turn.
pub(super) fn leaving(to_lane: GoalRoute, query: &GoalQuery) -> Option<GoalRoute> {
    let limit = comfortable_curvature(query.agent_type);
    let GoalRoute { mut route, cost: to_lane_cost, .. } = to_lane;
    let mut best: Option<(f64, f64, Cubic)> = None;
    let length = route.path.length_m();
    let (mut lead, farthest) = (4.0, (4.0 * (query.goal - route.path.last().position).norm()).max(20.0));
    while lead <= farthest.min(length) {
        let from = route.path.sample(length - lead);
        let chord = query.goal - from.position;
        // With a free heading the path ends like a circle through both.
        let bend = wrap_angle(chord.y.atan2(chord.x) - from.heading_rad);
        let heading = query.goal_heading_rad.unwrap_or(from.heading_rad + 2.0 * bend);
        if chord.norm() > 1.0 && bend.abs() < std::f64::consts::FRAC_PI_2 {
            let join = cubic::best(from, Pose::new(query.goal, heading), limit);
            let cost = cubic::cost(&join, limit) + length - lead;
            if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                best = Some((cost, length - lead, join));
            }
        }
        lead += 2.0;
    }
    let (cost, s, join) = best.filter(|(.., join)| join.max_curvature <= SHARPEST_LEAVING * limit)?;
    let points =
        route.path.slice(0.0, s).points().iter().chain(join.path.points()).copied().collect::<Vec<_>>();
    let longest = route.limits_mps.last().copied().unwrap_or(f64::INFINITY);
    route.path = Polyline::new(points).resample(1.0);
    route.limits_mps.resize(route.path.points().len(), longest);
    Some(GoalRoute { route, kind: RouteKind::OffLane, goal_lateral_m: 0.0, cost: cost.max(to_lane_cost) })
}
