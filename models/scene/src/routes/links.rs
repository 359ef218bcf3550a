//! Links and neighbours of lanes: as recorded, or rebuilt from the geometry if the record has none.

use super::graph::{AdjacentLane, GraphLane, LaneGraph};
use crate::map::{Lane, LaneType, Neighbor};
use crate::{LaneMap, Vec2, wrap_angle};
use std::collections::HashMap;

/// Greatest gap over which a missing link is rebuilt, metres.
const LINK_GAP_M: f64 = 0.6;
/// Most ends that are joined at one place: a junction has up to a dozen.
const MOST_TOGETHER: usize = 64;
/// Greatest change of heading over a rebuilt link.
const LINK_TURN_RAD: f64 = 30.0 * std::f64::consts::PI / 180.0;
/// Greatest difference of heading between lanes side by side.
const SIDE_TURN_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Distance between the places at which neighbours are searched, metres.
const SIDE_STEP_M: f64 = 10.0;
/// Limits of lanes found in these searches: per place (streets have 2 to 6), extra for the junctions of a
/// small map, and in total.
const FOUND_A_PLACE: usize = 16;
const FOUND_ANYWAY: usize = 200_000;
const MOST_FOUND: usize = 800_000;
/// Limit of lane pieces examined in these searches: ten times what a large town needs.
const MOST_LOOKED: usize = 40_000_000;

/// Adds the link from lane `from` to lane `to` once.
pub(super) fn connect(lanes: &mut [GraphLane], from: usize, to: usize) {
    if !lanes[from].successors.contains(&to) {
        lanes[from].successors.push(to);
    }
    if !lanes[to].predecessors.contains(&from) {
        lanes[to].predecessors.push(from);
    }
}

/// Links of the map. A link recorded by one of two lanes holds for both; unknown ids are ignored.
pub(super) fn record(map: &LaneMap, by_id: &HashMap<&str, usize>, lanes: &mut [GraphLane]) {
    for (i, lane) in map.lanes.iter().enumerate() {
        for next in lane.successors.iter().filter_map(|id| by_id.get(id.as_str())) {
            connect(lanes, i, *next);
        }
        for before in lane.predecessors.iter().filter_map(|id| by_id.get(id.as_str())) {
            connect(lanes, *before, i);
        }
    }
}

/// Joins lanes without any successor to the starts at their end, and lanes without any predecessor to the
/// ends at their start.
pub(super) fn rebuild(lanes: &mut [GraphLane]) {
    let usable: Vec<usize> = (0..lanes.len()).filter(|i| lanes[*i].path.length_m() > 0.0).collect();
    let starts = NearPoints::new(usable.iter().map(|i| (*i, lanes[*i].path.first().position)), LINK_GAP_M);
    let open_ends: Vec<usize> = usable.iter().copied().filter(|i| lanes[*i].successors.is_empty()).collect();
    let open_starts: Vec<usize> =
        usable.iter().copied().filter(|i| lanes[*i].predecessors.is_empty()).collect();
    let ends = NearPoints::new(usable.iter().map(|i| (*i, lanes[*i].path.last().position)), LINK_GAP_M);
    for from in open_ends {
        for to in starts.near(lanes[from].path.last().position) {
            connect_if_smooth(lanes, from, to);
        }
    }
    for to in open_starts {
        for from in ends.near(lanes[to].path.first().position) {
            connect_if_smooth(lanes, from, to);
        }
    }
}

fn connect_if_smooth(lanes: &mut [GraphLane], from: usize, to: usize) {
    let turn = wrap_angle(lanes[to].path.first().heading_rad - lanes[from].path.last().heading_rad);
    if from != to && turn.abs() <= LINK_TURN_RAD && same_users(&lanes[from], &lanes[to]) {
        connect(lanes, from, to);
    }
}

/// Whether some type of road user may use both.
fn same_users(a: &GraphLane, b: &GraphLane) -> bool {
    let vehicles = a.lane_type.carries_vehicles() && b.lane_type.carries_vehicles();
    let cyclists = a.lane_type.carries_cyclists() && b.lane_type.carries_cyclists();
    vehicles || cyclists || a.lane_type == b.lane_type
}

/// Points by square, for searches near a place.
pub(super) struct NearPoints {
    /// Places with their indices, by square.
    squares: HashMap<(i64, i64), Vec<(Vec2, usize)>>,
    /// Radius of every search, and side of the squares, metres.
    radius_m: f64,
}

impl NearPoints {
    pub(super) fn new(points: impl Iterator<Item = (usize, Vec2)>, radius_m: f64) -> Self {
        let mut near = Self { squares: HashMap::new(), radius_m };
        for (i, point) in points {
            near.squares.entry(near.square(point)).or_default().push((point, i));
        }
        near
    }

    fn square(&self, point: Vec2) -> (i64, i64) {
        ((point.x / self.radius_m).floor() as i64, (point.y / self.radius_m).floor() as i64)
    }

    /// Indices of the points within the radius of `point`, by ascending x; empty if they are too many to be
    /// meaningful.
    pub(super) fn near(&self, point: Vec2) -> Vec<usize> {
        let (column, row) = self.square(point);
        let beside = |at: i64| at.saturating_sub(1)..=at.saturating_add(1);
        let around = beside(column).flat_map(|c| beside(row).map(move |r| (c, r)));
        let close = around.filter_map(|square| self.squares.get(&square)).flatten();
        let within = close.filter(|(p, _)| (p.x - point.x).hypot(p.y - point.y) <= self.radius_m);
        let mut found: Vec<(f64, usize)> = within.take(MOST_TOGETHER + 1).map(|(p, i)| (p.x, *i)).collect();
        if found.len() > MOST_TOGETHER {
            return Vec::new();
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, i)| i).collect()
    }
}

/// Sets left and right neighbours of all lanes: as recorded, or from the geometry if the map records none.
/// Stops once it is cancelled.
pub(super) fn sides(map: &LaneMap, graph: &mut LaneGraph, is_cancelled: &dyn Fn() -> bool) {
    if map.lanes.iter().all(|l| l.left_neighbors.is_empty() && l.right_neighbors.is_empty()) {
        rebuild_sides(graph, is_cancelled);
        return;
    }
    let arcs: Vec<Vec<f64>> = map.lanes.iter().map(point_arcs).collect();
    for (i, lane) in map.lanes.iter().enumerate() {
        if is_cancelled() {
            return;
        }
        let left = lane.left_neighbors.iter().filter_map(|n| recorded(graph, &arcs, i, n)).collect();
        let right = lane.right_neighbors.iter().filter_map(|n| recorded(graph, &arcs, i, n)).collect();
        let lane = &mut graph.lanes_mut()[i];
        (lane.left, lane.right) = (left, right);
    }
}

/// Arc length of each recorded point of a lane; neighbours are recorded by point index.
fn point_arcs(lane: &Lane) -> Vec<f64> {
    let mut s = 0.0;
    let steps = lane.points.xy.windows(2).map(|p| (p[1] - p[0]).norm());
    let after = steps.map(|step| {
        s += step;
        s
    });
    std::iter::once(0.0).chain(after).collect()
}

fn recorded(graph: &LaneGraph, arcs: &[Vec<f64>], own: usize, neighbor: &Neighbor) -> Option<AdjacentLane> {
    let other = graph.lane_index(&neighbor.lane).filter(|other| *other != own)?;
    let lengths = |lane: usize, range: (usize, usize)| {
        let arc = arcs.get(lane)?;
        let last = *arc.last()?;
        let at = |i: usize| arc.get(i).copied().unwrap_or(last);
        Some((at(range.0), at(range.1)))
    };
    let (own_m, other_m) = (lengths(own, neighbor.own_range)?, lengths(other, neighbor.other_range)?);
    let own_m = (own_m.0.min(own_m.1), own_m.0.max(own_m.1));
    let here = graph.lanes()[own].path.sample(0.5 * (own_m.0 + own_m.1));
    let there = graph.lanes()[other].path.project(here.position);
    let same_direction = wrap_angle(there.heading_rad - here.heading_rad).abs() < 1.0;
    let (low, high) = (other_m.0.min(other_m.1), other_m.0.max(other_m.1));
    let other_m = if same_direction { (low, high) } else { (high, low) };
    Some(AdjacentLane { lane: other, own_m, other_m, same_direction })
}

/// Lanes a lane's width apart with the same heading are neighbours. If too many lanes overlap for that to be
/// meaningful, none has neighbours.
fn rebuild_sides(graph: &mut LaneGraph, is_cancelled: &dyn Fn() -> bool) {
    let own = |(i, lane): (usize, &GraphLane)| (lane.lane_type != LaneType::Sidewalk).then_some(i);
    let own: Vec<usize> = graph.lanes().iter().enumerate().filter_map(own).collect();
    let places: usize = own.iter().map(|i| 1 + side_pieces(&graph.lanes()[*i])).sum();
    let found = (FOUND_ANYWAY + FOUND_A_PLACE * places).min(MOST_FOUND);
    let mut budget = SearchBudget { found, looked: MOST_LOOKED };
    let found: Option<Vec<_>> =
        own.iter().map(|i| sides_of(graph, *i, &mut budget).filter(|_| !is_cancelled())).collect();
    for (i, (left, right)) in own.into_iter().zip(found.unwrap_or_default()) {
        let lane = &mut graph.lanes_mut()[i];
        (lane.left, lane.right) = (left, right);
    }
}

/// Remaining lanes that may be found, and lane pieces that may be examined.
struct SearchBudget {
    found: usize,
    looked: usize,
}

/// Number of intervals between the places at which a lane's neighbours are searched.
fn side_pieces(lane: &GraphLane) -> usize {
    (lane.path.length_m() / SIDE_STEP_M).ceil().clamp(1.0, 1e4) as usize
}

/// Neighbours on the left and right; empty once the budget is used up.
fn sides_of(
    graph: &LaneGraph,
    own: usize,
    budget: &mut SearchBudget,
) -> Option<(Vec<AdjacentLane>, Vec<AdjacentLane>)> {
    let lane = &graph.lanes()[own];
    let (mut left, mut right): (Vec<AdjacentLane>, Vec<AdjacentLane>) = (Vec::new(), Vec::new());
    let pieces = side_pieces(lane);
    for k in 0..=pieces {
        let s = lane.path.length_m() * k as f64 / pieces as f64;
        let here = lane.path.sample(s);
        let radius = 0.7 * (lane.width_m + 3.5);
        let others = |i: usize, l: &GraphLane| i != own && same_users(lane, l);
        let (hits, looked) = graph.nearest_counted(here.position, radius, others);
        budget.found = budget.found.checked_sub(hits.len())?;
        budget.looked = budget.looked.checked_sub(looked)?;
        for hit in hits {
            let apart = hit.lateral_m.abs() / (0.5 * (lane.width_m + graph.lanes()[hit.lane].width_m));
            let turn = wrap_angle(hit.heading_rad - here.heading_rad).abs();
            let abreast = (hit.distance_m - hit.lateral_m.abs()).abs() < 0.5;
            if !(0.6..=1.4).contains(&apart) || turn > SIDE_TURN_RAD || !abreast {
                continue;
            }
            // The point lies to the right of the other lane, so that lane is on our left.
            let side = if hit.lateral_m < 0.0 { &mut left } else { &mut right };
            match side.iter_mut().find(|b| b.lane == hit.lane) {
                Some(b) => (b.own_m.1, b.other_m.1) = (s, hit.s_m.max(b.other_m.1)),
                None => side.push(AdjacentLane {
                    lane: hit.lane,
                    own_m: (s, s),
                    other_m: (hit.s_m, hit.s_m),
                    same_direction: true,
                }),
            }
        }
    }
    for side in [&mut left, &mut right] {
        side.retain(|b| b.own_m.1 > b.own_m.0);
    }
    Some((left, right))
}
