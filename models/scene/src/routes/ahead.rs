//! Routes ahead of a road user that has no goal.

use super::assemble::{self, Hop};
use super::start::{StartLane, start_lanes, with_lanes_beside};
use super::{LaneGraph, Pose, Route, search};
use crate::{AgentType, Vec2, wrap_angle};
use std::collections::VecDeque;

/// Most routes returned.
pub const MAX_ROUTES: usize = 6;
/// Two routes with a smaller mean distance are the same, metres.
pub(super) const DISTINCT_M: f64 = 2.0;
/// Distance between the points at which routes are compared, metres.
pub(super) const TRACE_STEP_M: f64 = 4.0;
/// Most lanes in one chain.
const MAX_HOPS: usize = 64;
/// Most chains from one start lane.
const MAX_CHAINS: usize = 16;
/// Most lanes visited from one start lane.
const MAX_VISITS: usize = 512;

/// Length to look ahead, metres: 9 s at 1.15 times the speed (at least 4 m/s) plus 15 m.
pub fn route_length_m(speed_mps: f64) -> f64 {
    9.0 * 1.15 * speed_mps.max(4.0) + 15.0
}

/// A chain of lanes from a start.
struct Chain {
    hops: Vec<Hop>,
    length_m: f64,
    terminal: bool,
    /// Rank: weighted sum of start score, missing share of the length, and turning.
    rank: f64,
    trace: Vec<Vec2>,
}

/// Up to [`MAX_ROUTES`] routes of `length_m` (see [`route_length_m`]) along the lane graph, from the lanes
/// under the road user and those directly beside them. Empty if it is on no lane that it may use.
///
/// The first is the best continuation of the best start lane, each further one the farthest from those
/// before it. Deterministic.
pub fn routes_ahead(graph: &LaneGraph, pose: Pose, agent_type: AgentType, length_m: f64) -> Vec<Route> {
    each_route_ahead(graph, pose, agent_type, length_m).collect()
}

/// The first of [`routes_ahead`], without computing the others.
pub fn best_route_ahead(
    graph: &LaneGraph,
    pose: Pose,
    agent_type: AgentType,
    length_m: f64,
) -> Option<Route> {
    each_route_ahead(graph, pose, agent_type, length_m).next()
}

fn each_route_ahead(
    graph: &LaneGraph,
    pose: Pose,
    agent_type: AgentType,
    length_m: f64,
) -> impl Iterator<Item = Route> {
    let starts = with_lanes_beside(graph, start_lanes(graph, pose, agent_type), agent_type);
    let mut chains: Vec<Chain> = Vec::new();
    for start in &starts {
        let new = chains_from(graph, start, agent_type, length_m);
        // A chain that joins an earlier one in its middle adds nothing.
        let known = |hops: &[Hop]| chains.iter().any(|c| ends_with(&c.hops, hops));
        let new: Vec<Chain> = new.into_iter().filter(|c| !known(&c.hops)).collect();
        chains.extend(new);
    }
    chains.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    let kept = farthest_first(&chains);
    kept.into_iter().filter_map(move |i| assemble::route(graph, &chains[i].hops, pose, chains[i].terminal))
}

fn ends_with(longer: &[Hop], hops: &[Hop]) -> bool {
    let Some(skip) = longer.len().checked_sub(hops.len()).filter(|skip| *skip > 0) else { return false };
    longer[skip..].iter().zip(hops).all(|(a, b)| a.lane == b.lane)
}

/// All chains from one start, breadth first and bounded. A lane occurs twice only if there is no other
/// continuation. A lane that ends is left before its end for a neighbouring lane that continues.
fn chains_from(graph: &LaneGraph, start: &StartLane, agent_type: AgentType, length_m: f64) -> Vec<Chain> {
    let lanes = graph.lanes();
    let first = Hop::along(start.lane, start.s_m, lanes[start.lane].path.length_m());
    let mut open = VecDeque::from([(first.length_m(), vec![first])]);
    let (mut done, mut visits) = (Vec::new(), 0);
    while let Some((length, hops)) = open.pop_front() {
        visits += 1;
        if done.len() >= MAX_CHAINS || visits > MAX_VISITS {
            break;
        }
        let Some(last) = hops.last() else { continue };
        let lane = last.lane;
        let mut next: Vec<usize> =
            lanes[lane].successors.iter().copied().filter(|n| lanes[*n].carries(agent_type)).collect();
        if length < length_m && next.is_empty() {
            let ways_on: Vec<Vec<Hop>> = lanes[lane]
                .beside()
                .filter(|b| b.same_direction && lanes[b.lane].carries(agent_type))
                .filter(|b| hops.iter().all(|h| h.lane != b.lane))
                .filter_map(|b| search::change_before_end(graph, last, b))
                .map(|(left_m, onto)| {
                    before_last(&hops).chain([Hop { to_m: left_m, ..*last }, onto]).collect()
                })
                .collect();
            if !ways_on.is_empty() && hops.len() < MAX_HOPS {
                open.extend(ways_on.into_iter().map(|hops| (hops.iter().map(Hop::length_m).sum(), hops)));
                continue;
            }
        }
        if length >= length_m || next.is_empty() || hops.len() >= MAX_HOPS {
            done.push(chain(graph, start, hops, length, length_m));
            continue;
        }
        let left_over_m = (last.change_m - last.length_m()).max(0.0);
        if next.iter().any(|n| hops.iter().all(|h| h.lane != *n)) {
            next.retain(|n| hops.iter().all(|h| h.lane != *n));
        }
        for n in next {
            let hop = Hop { change_m: left_over_m, ..Hop::along(n, 0.0, lanes[n].path.length_m()) };
            let hops: Vec<Hop> = hops.iter().copied().chain([hop]).collect();
            open.push_back((length + hop.length_m(), hops));
        }
    }
    done
}

fn before_last(hops: &[Hop]) -> impl Iterator<Item = Hop> {
    hops.iter().take(hops.len().saturating_sub(1)).copied()
}

fn chain(graph: &LaneGraph, start: &StartLane, mut hops: Vec<Hop>, length: f64, asked: f64) -> Chain {
    let over = length - asked;
    if let Some(last) = hops.last_mut() {
        last.to_m = (last.to_m - over.max(0.0)).max(last.from_m);
    }
    let turning: f64 = hops.iter().map(|hop| turning_rad(graph, hop)).sum();
    let trace = assemble::trace(graph, &hops, TRACE_STEP_M);
    // The start's score has the largest weight, then missing length, then straightness.
    let short = (-over).max(0.0) / asked.max(1.0);
    let rank = 1e3 * start.score.min(1e3) + 100.0 * short + turning;
    Chain { hops, length_m: length.min(asked), terminal: over < 0.0, rank, trace }
}

fn turning_rad(graph: &LaneGraph, hop: &Hop) -> f64 {
    let path = &graph.lanes()[hop.lane].path;
    wrap_angle(path.heading_at(hop.to_m) - path.heading_at(hop.from_m)).abs()
}

/// Indices of the first chain and then, repeatedly, of the chain farthest from all selected ones, as long as
/// it is distinct.
fn farthest_first(chains: &[Chain]) -> Vec<usize> {
    let Some(first) = chains.iter().position(|c| c.length_m > 0.5) else { return Vec::new() };
    let mut kept = vec![first];
    let to = |i: usize, j: usize| assemble::mean_distance_m(&chains[i].trace, &chains[j].trace);
    let mut nearest: Vec<f64> = (0..chains.len()).map(|i| to(i, first)).collect();
    while kept.len() < MAX_ROUTES {
        let usable = (0..chains.len()).filter(|i| chains[*i].length_m > 0.5 && nearest[*i] >= DISTINCT_M);
        // Among equally far chains, the better ranked wins.
        let Some(next) = usable.reduce(|a, b| if nearest[b] > nearest[a] + 1e-9 { b } else { a }) else {
            break;
        };
        kept.push(next);
        for i in 0..chains.len() {
            nearest[i] = nearest[i].min(to(i, next));
        }
    }
    kept
}
