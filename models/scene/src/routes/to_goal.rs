//! Routes to a goal: forward along lanes, else joined from behind the goal, else leaving the lanes at the
//! end.

use super::ahead::{DISTINCT_M, TRACE_STEP_M};
use super::assemble::{self, Hop};
use super::start::{METRES_PER_RAD, StartLane, errors_at, start_lanes, with_lanes_beside};
use super::{LaneGraph, LaneHit, Pose, Route, join, search};
use crate::{AgentType, Vec2, wrap_angle};

/// Most routes returned.
pub const MAX_GOAL_ROUTES: usize = 3;
/// Greatest distance of a goal from a lane that it lies on, metres.
pub const ON_LANE_M: f64 = 3.0;
/// Greatest distance of a goal from the lane that it is reached from, metres.
const OFF_LANE_M: f64 = 25.0;
/// Greatest difference between a lane's heading and the goal's.
pub(super) const GOAL_TURN_RAD: f64 = std::f64::consts::FRAC_PI_4;
/// A forward route that ends this near to the goal needs no join beside it, metres.
const CLOSE_M: f64 = 1.5;
/// Goals nearer than this are not worth a join, metres.
const NO_JOIN_M: f64 = 5.0;
/// Most goal lanes.
pub const MAX_GOAL_LANES: usize = 6;
/// Most goal lanes if lanes on both sides of the goal count.
const MAX_NEAR_LANES: usize = 24;
/// Metres of path to which a metre of offset between lane and goal is equivalent (`lanes.py`: 1 to 0.05).
const COST_PER_OFFSET: f64 = 20.0;

/// Longest route to search for: factor of the straight distance, and metres in addition.
pub const LONGEST_ROUTE: (f64, f64) = (1.5, 30.0);

/// Query of a search for routes to a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoalQuery {
    /// Pose of the road user.
    pub pose: Pose,
    /// Its speed, m/s.
    pub speed_mps: f64,
    /// Type, which determines the lanes it may use.
    pub agent_type: AgentType,
    /// Position of the goal.
    pub goal: Vec2,
    /// Fixed heading at the goal, radians.
    pub goal_heading_rad: Option<f64>,
    /// Length of the least-effort motion to the goal, metres: joins longer than 1.25 of it are dropped.
    pub least_effort_m: Option<f64>,
}

impl GoalQuery {
    /// Straight distance to the goal, metres.
    pub fn distance_m(&self) -> f64 {
        (self.goal - self.pose.position).norm()
    }

    /// Angle between a lane's heading and the fixed one, radians; zero when the heading is free.
    pub(super) fn goal_turn_rad(&self, heading_rad: f64) -> f64 {
        self.goal_heading_rad.map_or(0.0, |asked| wrap_angle(heading_rad - asked).abs())
    }

    /// Longest route to search for, metres.
    fn longest_m(&self) -> f64 {
        let (times, more_m) = LONGEST_ROUTE;
        times * self.distance_m() + more_m
    }
}

/// How a route reaches the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RouteKind {
    /// Along lanes all the way.
    Forward,
    /// By a cubic from the road user onto the lanes that lead to the goal.
    Joined,
    /// Along lanes, then by a cubic to a goal that is off every lane.
    OffLane,
}

/// A route, and how it reaches the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalRoute {
    /// The route. The path of a forward route ends beside the goal, that of the others at it.
    pub route: Route,
    /// How it reaches the goal.
    pub kind: RouteKind,
    /// Offset of the goal from the end of the path, positive left, metres.
    pub goal_lateral_m: f64,
    /// Rank among routes: metres of path and penalties.
    pub cost: f64,
}

/// Up to [`MAX_GOAL_ROUTES`] distinct routes to the goal, best first. Empty if no sensible route is known;
/// only the motion of least effort remains then.
///
/// Forward routes come first unless all of them end more than 1.5 m beside the goal and a join exists. Goals
/// more than 3 m off every lane are reached from lanes within 25 m.
pub fn routes_to_goal(graph: &LaneGraph, query: &GoalQuery) -> Vec<GoalRoute> {
    let starts = start_lanes(graph, query.pose, query.agent_type);
    let starts = with_lanes_beside(graph, starts, query.agent_type);
    let goals = goal_lanes(graph, query, ON_LANE_M, MAX_GOAL_LANES);
    let mut routes = forward(graph, query, &starts, &goals, query.longest_m());
    let close = |r: &GoalRoute| r.goal_lateral_m.abs() < CLOSE_M;
    let wants_join = !routes.iter().any(close) && query.distance_m() >= NO_JOIN_M;
    if wants_join && let Some(joined) = join::joined(graph, query, &goals) {
        routes.insert(0, joined);
    }
    if routes.is_empty() && goals.is_empty() {
        let near = goal_lanes(graph, query, OFF_LANE_M, MAX_GOAL_LANES);
        let lead_in = forward(graph, query, &starts, &near, query.longest_m());
        routes = lead_in.into_iter().filter_map(|r| join::leaving(r, query)).collect();
    }
    routes.truncate(MAX_GOAL_ROUTES);
    routes
}

/// More routes, for a goal to which none of [`routes_to_goal`] is suitable. They are long detours along lanes
/// of up to `longest_m`, and routes along lanes near the goal that are left for it at the end.
pub fn further_routes_to_goal(graph: &LaneGraph, query: &GoalQuery, longest_m: f64) -> Vec<GoalRoute> {
    let starts = start_lanes(graph, query.pose, query.agent_type);
    let starts = with_lanes_beside(graph, starts, query.agent_type);
    let longest_m = longest_m.max(query.longest_m());
    let near = goal_lanes(graph, query, OFF_LANE_M, MAX_NEAR_LANES);
    let (under, beside): (Vec<LaneHit>, Vec<LaneHit>) =
        near.into_iter().partition(|hit| hit.distance_m <= ON_LANE_M);
    let mut routes = forward(graph, query, &starts, &under, longest_m);
    let lead_in = forward(graph, query, &starts, &beside, longest_m);
    routes.extend(lead_in.into_iter().filter_map(|r| join::leaving(r, query)));
    routes
}

/// Lanes within `radius_m` of the goal whose heading there is about the fixed one, the best first.
fn goal_lanes(graph: &LaneGraph, query: &GoalQuery, radius_m: f64, most: usize) -> Vec<LaneHit> {
    let mut hits = graph.nearest_for(query.goal, radius_m, query.agent_type);
    hits.retain(|hit| query.goal_turn_rad(hit.heading_rad) <= GOAL_TURN_RAD);
    let score = |hit: &LaneHit| hit.distance_m + METRES_PER_RAD * query.goal_turn_rad(hit.heading_rad);
    hits.sort_by(|a, b| score(a).total_cmp(&score(b)).then(a.lane.cmp(&b.lane)));
    hits.truncate(most);
    hits
}

/// A forward chain with its rank.
struct RankedChain {
    hops: Vec<Hop>,
    cost: f64,
    goal: LaneHit,
    trace: Vec<Vec2>,
}

/// Distinct forward routes of up to `longest_m` from the starts to the goal lanes, best first.
fn forward(
    graph: &LaneGraph,
    query: &GoalQuery,
    starts: &[StartLane],
    goals: &[LaneHit],
    longest_m: f64,
) -> Vec<GoalRoute> {
    if goals.is_empty() {
        return Vec::new();
    }
    let mut candidates = Vec::new();
    for start in starts {
        let found = search::shortest(graph, start, goals, query.speed_mps, query.agent_type, longest_m);
        candidates.extend(found.into_iter().map(|chain| {
            let goal = goals[chain.goal];
            let turn = METRES_PER_RAD * query.goal_turn_rad(goal.heading_rad);
            let cost = chain.cost + COST_PER_OFFSET * (goal.distance_m + turn) + 2.0 * start.score;
            let trace = assemble::trace(graph, &chain.hops, TRACE_STEP_M);
            RankedChain { hops: chain.hops, cost, goal, trace }
        }));
    }
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut kept: Vec<&RankedChain> = Vec::new();
    let mut routes = Vec::new();
    for candidate in &candidates {
        let same = |k: &&RankedChain| assemble::mean_distance_m(&k.trace, &candidate.trace) < DISTINCT_M;
        if routes.len() >= MAX_GOAL_ROUTES || kept.iter().any(same) {
            continue;
        }
        if let Some(route) = assemble::route(graph, &candidate.hops, query.pose, false) {
            kept.push(candidate);
            let goal_lateral_m = errors_at(Pose::new(query.goal, 0.0), route.path.last()).0;
            let goal_lateral_m = candidate.goal.distance_m.copysign(goal_lateral_m);
            routes.push(GoalRoute { route, kind: RouteKind::Forward, goal_lateral_m, cost: candidate.cost });
        }
    }
    routes
}
