//! Shortest chains of lanes between places on lanes.

use super::assemble::Hop;
use super::graph::AdjacentLane;
use super::start::StartLane;
use super::{GraphLane, LaneGraph, LaneHit};
use crate::AgentType;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Penalty of a lane change in addition to its length, metres.
const CHANGE_COST_M: f64 = 8.0;
/// Shortest lane change, metres, and its duration, seconds: the lateral acceleration of drivers mostly stays
/// within 1.6 m/s2.
const CHANGE_M: f64 = 10.0;
const CHANGE_S: f64 = 3.5;
/// Lanes that run side by side for less than this share of a change are not changed between.
const LEAST_CHANGE: f64 = 0.4;
/// Most lanes settled in one search.
const MAX_SETTLED: usize = 4_096;

/// A lane with the place at which it is entered: its beginning, or a place on it (by a start or a change).
#[derive(Clone, Copy, Debug)]
struct Entered {
    hop: Hop,
    /// Length and penalties up to `hop.from_m`, metres.
    cost: f64,
    /// Index of the previous state among the settled ones, and where its lane is left.
    before: Option<(usize, f64)>,
}

/// Heap entry: cheapest first, then lowest lane index, so that equal costs are settled in a fixed order.
#[derive(Clone, Copy, Debug)]
struct Open(Entered);

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (&self.0, &other.0);
        b.cost
            .total_cmp(&a.cost)
            .then(b.hop.lane.cmp(&a.hop.lane))
            .then(b.hop.from_m.total_cmp(&a.hop.from_m))
    }
}

/// A chain that reaches a goal lane.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub hops: Vec<Hop>,
    /// Length and penalties of lane changes, metres.
    pub cost: f64,
    /// Index among the goals.
    pub goal: usize,
}

/// Cheapest chain from `start` to each of `goals` that is reached within `limit_m`, by Dijkstra's search
/// over lanes with lane changes.
pub(super) fn shortest(
    graph: &LaneGraph,
    start: &StartLane,
    goals: &[LaneHit],
    speed_mps: f64,
    agent_type: AgentType,
    limit_m: f64,
) -> Vec<Found> {
    let lanes = graph.lanes();
    let change_m = (CHANGE_S * speed_mps).max(CHANGE_M);
    let first = Hop::along(start.lane, start.s_m, lanes[start.lane].path.length_m());
    // A start beside the lane first changes onto it. An immediate change away from the own lane is covered by
    // the start beside it.
    let on_lane_m = start.s_m + if start.beside { change_m } else { 0.0 };
    let leaves_at_once = |left_m: f64| !start.beside && left_m < start.s_m + 1.0;
    let mut heap = BinaryHeap::from([Open(Entered { hop: first, cost: 0.0, before: None })]);
    let mut settled: Vec<Entered> = Vec::new();
    let mut done = vec![[false; 2]; lanes.len()];
    let mut best: Vec<Option<(f64, usize)>> = vec![None; goals.len()];
    while let Some(Open(state)) = heap.pop() {
        let Hop { lane, from_m, to_m, .. } = state.hop;
        if state.cost > limit_m || settled.len() >= MAX_SETTLED {
            break;
        }
        // The start's own lane may be entered again from its beginning.
        let inside = usize::from(from_m > 0.0);
        if std::mem::replace(&mut done[lane][inside], true) {
            continue;
        }
        let at = settled.len();
        settled.push(state);
        for (goal, slot) in goals.iter().zip(&mut best) {
            let cost = state.cost + goal.s_m - from_m;
            let ahead = goal.lane == lane && goal.s_m >= from_m + state.hop.change_m;
            if ahead && cost <= limit_m && slot.is_none_or(|(least, _)| cost < least) {
                *slot = Some((cost, at));
            }
        }
        let (length, cost) = (to_m - from_m, state.cost);
        for next in lanes[lane].successors.iter().filter(|n| lanes[**n].carries(agent_type)) {
            let left_over_m = (state.hop.change_m - length).max(0.0);
            let hop = Hop { change_m: left_over_m, ..Hop::along(*next, 0.0, lanes[*next].path.length_m()) };
            heap.push(Open(Entered { hop, cost: cost + length, before: Some((at, to_m)) }));
        }
        for beside in lanes[lane].beside().filter(|b| b.same_direction && lanes[b.lane].carries(agent_type)) {
            let first = state.before.is_none();
            let settled_m = if first { on_lane_m } else { from_m + state.hop.change_m };
            if let Some((left_m, hop)) = change(graph, settled_m, beside, change_m)
                && !(first && leaves_at_once(left_m))
            {
                let cost = cost + left_m - from_m + CHANGE_COST_M;
                heap.push(Open(Entered { hop, cost, before: Some((at, left_m)) }));
            }
        }
    }
    let found = best.iter().enumerate().filter_map(|(goal, reached)| {
        let (cost, at) = (*reached)?;
        Some(Found { hops: chain(&settled, at, goals[goal].s_m), cost, goal })
    });
    found.collect()
}

/// Change to a neighbouring lane as soon as the two run side by side beyond `from_m`: where the lane is left,
/// and the next hop.
fn change(graph: &LaneGraph, from_m: f64, beside: &AdjacentLane, change_m: f64) -> Option<(f64, Hop)> {
    let left_m = from_m.max(beside.own_m.0);
    let from_m = beside.across(left_m)?;
    let lane = &graph.lanes()[beside.lane];
    let to_m = lane.path.length_m();
    let room = (beside.own_m.1 - left_m).min(to_m - from_m);
    // Lanes are recorded in short pieces, so a change may continue in the next one.
    let most_m = if lane.successors.is_empty() { room } else { f64::INFINITY };
    let hop = Hop { lane: beside.lane, from_m, to_m, change_m: change_m.min(most_m), follows: false };
    (room >= LEAST_CHANGE * change_m).then_some((left_m, hop))
}

/// Change from the last lane of a chain, which ends, to a neighbouring lane that continues: where the lane is
/// left, and the next hop. If there is room, it is complete half its length before the end.
pub(super) fn change_before_end(graph: &LaneGraph, last: &Hop, beside: &AdjacentLane) -> Option<(f64, Hop)> {
    let lanes = graph.lanes();
    if !goes_on(graph, beside) {
        return None;
    }
    let change_m = unhurried_change_m(&lanes[last.lane]);
    let earliest_m = beside.own_m.0.max(last.from_m + last.change_m);
    let left_m = (beside.own_m.1 - 1.5 * change_m).max(earliest_m);
    let room_m = beside.own_m.1 - left_m;
    let from_m = beside.across(left_m)?;
    let to_m = lanes[beside.lane].path.length_m();
    let hop = Hop { lane: beside.lane, from_m, to_m, change_m: change_m.min(room_m), follows: false };
    (room_m >= CHANGE_M).then_some((left_m, hop))
}

/// Whether the neighbouring lane continues where the own lane ends.
fn goes_on(graph: &LaneGraph, beside: &AdjacentLane) -> bool {
    let lane = &graph.lanes()[beside.lane];
    !lane.successors.is_empty() || lane.path.length_m() > beside.other_m.1 + CHANGE_M
}

/// Length of a lane change at a lane's speed limit, metres.
fn unhurried_change_m(lane: &GraphLane) -> f64 {
    (CHANGE_S * lane.speed_limit_mps).max(CHANGE_M)
}

impl LaneGraph {
    /// Arc length up to which drivers on a lane that ends have begun to change to a neighbouring lane that
    /// continues, metres. `None` if the lane continues, or no neighbour does.
    pub fn leaves_before_m(&self, lane: usize, agent_type: AgentType) -> Option<f64> {
        let own = self.lanes().get(lane).filter(|own| own.successors.is_empty())?;
        let leads_on = |b: &&AdjacentLane| {
            b.same_direction && self.lanes()[b.lane].carries(agent_type) && goes_on(self, b)
        };
        let last_m = own.beside().filter(leads_on).map(|b| b.own_m.1).reduce(f64::max)?;
        Some(last_m - unhurried_change_m(own))
    }
}

/// Hops from the start to settled state `at`, ending at `goal_s_m` of its lane.
fn chain(settled: &[Entered], at: usize, goal_s_m: f64) -> Vec<Hop> {
    let (mut hops, mut next) = (Vec::new(), Some((at, goal_s_m)));
    while let Some((at, to_m)) = next {
        let Some(state) = settled.get(at) else { break };
        hops.push(Hop { to_m, ..state.hop });
        next = state.before;
    }
    hops.reverse();
    hops
}
