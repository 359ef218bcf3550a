//! Cuts a map into cells and computes their features.

use super::{CellKind, Cells, FEATURES, LaneCells, MapCell, class};
use crate::placement::region::Region;
use crate::placement::stop_lines::LineAhead;
use crate::tuning::placing::cells::{
    BEND_OVER_M, BENDS_PER_M, CROSSWALK_REACH_M, CROSSWALKS_M, EDGE_REACH_M, KERB_LOOK_M, KERB_ROOM_M,
    LANE_REACH_M, LANES_M, LIMITS_MPS, NEAR_END, NEXT_LANE_M, STOPS_M, UNKNOWN_LIMIT_MPS,
};
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::geometry::{cross, direction};
use scene::map::LaneType;
use scene::routes::LaneHit;
use scene::routes::graph::{GraphLane, LaneGraph, LaneSource};
use scene::{AgentType, Vec2};
use std::collections::HashSet;

/// A stretch of a lane, or of a road edge, that people walk along.
struct WalkStretch {
    kind: CellKind,
    /// Index of the lane or of the road edge.
    line: usize,
    on_lane: bool,
    from_m: f64,
    to_m: f64,
}

fn limit_class(limit_mps: f64) -> u8 {
    class(limit_mps, &LIMITS_MPS)
}

fn lane_class(lane: &GraphLane) -> u8 {
    let kind = match lane.lane_type {
        LaneType::Freeway => 0,
        LaneType::SurfaceStreet | LaneType::BusLane => 1,
        LaneType::BikeLane => 3,
        _ => 2,
    };
    kind + 4 * u8::from(lane.interpolating)
}

/// Lanes in the same direction on one side of the place at `s_m`, at most two.
fn beside(graph: &LaneGraph, lane: usize, s_m: f64, left: bool) -> u8 {
    let (mut at, mut s, mut count) = (lane, s_m, 0);
    while count < 2 {
        let here = &graph.lanes()[at];
        let list = if left { &here.left } else { &here.right };
        let vehicles = |l: usize| graph.lanes()[l].lane_type.carries_vehicles();
        let next = list.iter().filter(|b| b.same_direction && vehicles(b.lane));
        let Some((lane, across)) = next.filter_map(|b| Some((b.lane, b.across(s)?))).next() else { break };
        (at, s, count) = (lane, across, count + 1);
    }
    count
}

fn drives(lane: &GraphLane) -> bool {
    lane.carries(AgentType::Vehicle) || lane.carries(AgentType::Cyclist)
}

impl Cells<'_> {
    pub(super) fn lanes(&mut self, cell_m: f64, region: &Region) {
        let graph = self.graph;
        for (index, lane) in graph.lanes().iter().enumerate().filter(|(_, l)| drives(l)) {
            let length_m = lane.path.length_m();
            if length_m < 0.5 {
                continue;
            }
            let count = (length_m / cell_m).ceil().max(1.0) as usize;
            let size = length_m / count as f64;
            let centers: Vec<Vec2> =
                (0..count).map(|i| lane.path.position_at((i as f64 + 0.5) * size)).collect();
            let held = |p: &Vec2| region.may_hold(*p, size);
            let (Some(first), Some(last)) = (centers.iter().position(held), centers.iter().rposition(held))
            else {
                continue;
            };
            let begin = self.all.len();
            for i in first..=last {
                let s = (i as f64 + 0.5) * size;
                let ahead = self.lights.ahead(graph, index, s);
                let sides = [true, false].map(|left| beside(graph, index, s, left));
                let bend = lane.path.curvature_at(s, BEND_OVER_M).abs();
                let features = [
                    lane_class(lane),
                    limit_class(lane.speed_limit_mps),
                    ahead.class() as u8,
                    class(bend, &BENDS_PER_M),
                    3 * sides[0] + sides[1],
                    0,
                ];
                self.all.push(MapCell {
                    kind: CellKind::Lane,
                    line: index,
                    on_lane: true,
                    from_m: i as f64 * size,
                    to_m: (i + 1) as f64 * size,
                    center: centers[i],
                    side: 0.0,
                    free_m: 0.0,
                    features,
                    ahead,
                });
            }
            let held = begin..self.all.len();
            self.by_lane.insert(index, LaneCells { held, first, count });
        }
    }

    /// Strips between lanes and kerbs. Junctions and freeways have none. Maps without road edges have none
    /// either, because they do not define where the road ends.
    pub(super) fn kerbs(&mut self, region: &Region) {
        if self.edges.is_empty() {
            return;
        }
        let edges = (0..).zip(&self.scene.map.road_edges);
        let index = SegmentIndex::new(edges.flat_map(|(i, edge)| pieces(&edge.points.xy, i)).collect());
        let mut found = Vec::new();
        for cell in self.all.iter().filter(|s| s.kind == CellKind::Lane) {
            let lane = &self.graph.lanes()[cell.line];
            if lane.interpolating || lane.lane_type == LaneType::Freeway {
                continue;
            }
            let s = 0.5 * (cell.from_m + cell.to_m);
            let way = direction(lane.path.sample(s).heading_rad);
            let half_m = 0.5 * lane.width_m;
            for side in [1.0, -1.0] {
                let across = Vec2::new(-way.y, way.x) * side;
                let beyond = cell.center + across * (half_m + NEXT_LANE_M);
                if !region.may_hold(beyond, KERB_LOOK_M) || self.on_other_lane(beyond, cell.line) {
                    continue;
                }
                let edge_m = index.ray_m(cell.center, across, KERB_LOOK_M);
                let free_m = edge_m.map_or(f64::INFINITY, |m| m - half_m);
                let features = [
                    class(free_m, &KERB_ROOM_M),
                    u8::from(side > 0.0),
                    limit_class(lane.speed_limit_mps),
                    class(cell.ahead.stop_m(), &STOPS_M),
                    lane_class(lane),
                    0,
                ];
                found.push(MapCell {
                    kind: CellKind::Kerb,
                    side,
                    free_m,
                    features,
                    center: beyond,
                    ..cell.clone()
                });
            }
        }
        self.all.extend(found);
    }

    /// Whether the point lies on the band of a used lane other than `but`.
    fn on_other_lane(&self, point: Vec2, but: usize) -> bool {
        let hits = self.graph.nearest_lanes(point, LANE_REACH_M, |i, lane| i != but && drives(lane));
        // A point on the lane's own continuation projects to the continuation's end: it lies along it, not
        // beside it.
        hits.iter().any(|h| {
            let lane = &self.graph.lanes()[h.lane];
            let inside = h.s_m > 0.01 && h.s_m < lane.path.length_m() - 0.01;
            inside && h.distance_m < 0.5 * lane.width_m
        })
    }

    pub(super) fn crosswalks(&mut self, cell_m: f64, region: &Region) {
        let mut seen = HashSet::new();
        for (index, lane) in self.graph.lanes().iter().enumerate() {
            let LaneSource::Crosswalk(area) = lane.source else { continue };
            // Each crosswalk occurs twice, once per direction.
            if !seen.insert(area) {
                continue;
            }
            let length_m = lane.path.length_m();
            for (from_m, to_m) in cuts(length_m, cell_m) {
                let s = 0.5 * (from_m + to_m);
                let near_end = s < NEAR_END * length_m || s > (1.0 - NEAR_END) * length_m;
                let walk =
                    WalkStretch { kind: CellKind::Crosswalk, line: index, on_lane: true, from_m, to_m };
                self.push_walk(walk, region, |_, _| Some((1.0, [u8::from(near_end), 0, 0, 0, 0, 0])));
            }
        }
    }

    /// Sidewalk lanes; on maps without any, the outer sides of road edges.
    pub(super) fn pavements(&mut self, cell_m: f64, region: &Region) {
        let walks: Vec<usize> = self
            .graph
            .lanes()
            .iter()
            .enumerate()
            .filter(|(_, l)| l.lane_type == LaneType::Sidewalk && matches!(l.source, LaneSource::Lane(_)))
            .map(|(i, _)| i)
            .collect();
        for &index in &walks {
            let length_m = self.graph.lanes()[index].path.length_m();
            for (from_m, to_m) in cuts(length_m, cell_m) {
                let walk = WalkStretch { kind: CellKind::Pavement, line: index, on_lane: true, from_m, to_m };
                self.push_walk(walk, region, |graph, center| {
                    let hit = graph.nearest_for(center, EDGE_REACH_M, AgentType::Vehicle).into_iter().next();
                    // The kerb is about 2 m nearer to the road than the middle of a sidewalk.
                    Some((1.0, pavement_features(graph, center, hit.as_ref(), 2.0, false)))
                });
            }
        }
        if !walks.is_empty() {
            return;
        }
        for index in 0..self.edges.len() {
            let median = self.scene.map.road_edges[index].line_type == "median";
            for (from_m, to_m) in cuts(self.edges[index].length_m(), cell_m) {
                let heading_rad = self.edges[index].sample(0.5 * (from_m + to_m)).heading_rad;
                let walk =
                    WalkStretch { kind: CellKind::Pavement, line: index, on_lane: false, from_m, to_m };
                self.push_walk(walk, region, |graph, center| {
                    let hit =
                        graph.nearest_for(center, EDGE_REACH_M, AgentType::Vehicle).into_iter().next()?;
                    let lane = &graph.lanes()[hit.lane];
                    if lane.lane_type == LaneType::Freeway {
                        return None;
                    }
                    let foot = lane.path.position_at(hit.s_m);
                    let outwards = -1f64.copysign(cross(direction(heading_rad), foot - center));
                    Some((outwards, pavement_features(graph, center, Some(&hit), 0.0, median)))
                });
            }
        }
    }

    fn push_walk(
        &mut self,
        walk: WalkStretch,
        region: &Region,
        features: impl Fn(&LaneGraph, Vec2) -> Option<(f64, [u8; FEATURES])>,
    ) {
        let WalkStretch { kind, line, on_lane, from_m, to_m } = walk;
        let path = if on_lane { &self.graph.lanes()[line].path } else { &self.edges[line] };
        let center = path.position_at(0.5 * (from_m + to_m));
        if !region.may_hold(center, to_m - from_m + 6.0) {
            return;
        }
        if let Some((side, features)) = features(self.graph, center) {
            let ahead = LineAhead::Nothing;
            self.all.push(MapCell {
                kind,
                line,
                on_lane,
                from_m,
                to_m,
                center,
                side,
                free_m: 0.0,
                features,
                ahead,
            });
        }
    }

    pub(super) fn driveways(&mut self, region: &Region) {
        for (line, area) in self.scene.map.driveways.iter().enumerate() {
            let ring = &area.polygon.xy;
            if ring.len() < 3 {
                continue;
            }
            let center = ring.iter().sum::<Vec2>() / ring.len() as f64;
            if region.may_hold(center, 20.0) {
                let ahead = LineAhead::Nothing;
                self.all.push(MapCell {
                    kind: CellKind::Driveway,
                    line,
                    on_lane: false,
                    from_m: 0.0,
                    to_m: 0.0,
                    center,
                    side: 0.0,
                    free_m: 0.0,
                    features: [0; FEATURES],
                    ahead,
                });
            }
        }
    }
}

fn pavement_features(
    graph: &LaneGraph,
    center: Vec2,
    lane: Option<&LaneHit>,
    kerb_m: f64,
    median: bool,
) -> [u8; FEATURES] {
    let crosswalk = |_: usize, l: &GraphLane| matches!(l.source, LaneSource::Crosswalk(_));
    let crossing_m = graph
        .nearest_lanes(center, CROSSWALK_REACH_M, crosswalk)
        .first()
        .map_or(f64::INFINITY, |h| h.distance_m);
    let lane_m = lane.map_or(f64::INFINITY, |h| h.distance_m - kerb_m);
    let limit = lane.map_or(UNKNOWN_LIMIT_MPS, |h| graph.lanes()[h.lane].speed_limit_mps);
    [class(crossing_m, &CROSSWALKS_M), class(lane_m, &LANES_M), limit_class(limit), u8::from(median), 0, 0]
}

/// Equal pieces of a line of at most `cell_m`; none for a line without length.
fn cuts(length_m: f64, cell_m: f64) -> impl Iterator<Item = (f64, f64)> {
    let count = if length_m < 0.5 { 0 } else { (length_m / cell_m).ceil() as usize };
    let size = length_m / count.max(1) as f64;
    (0..count).map(move |i| (i as f64 * size, (i + 1) as f64 * size))
}
