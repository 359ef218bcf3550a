//! Where road users can be: short cells of lanes, kerbs, crosswalks and pavements, each with the few
//! facts about its surroundings that say how often somebody is there.

use super::region::{Region, in_ring};
use super::stops::{Ahead, Lights};
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::geometry::{cross, direction};
use scene::map::LaneType;
use scene::routes::graph::{GraphLane, LaneGraph, LaneSource};
use scene::routes::{LaneHit, Polyline};
use scene::{AgentType, Scene, Vec2};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// Length of a cell, metres, on maps that are not huge.
const CELL_M: f64 = 5.0;
/// Most cells; larger maps get longer ones.
const MAX_CELLS: f64 = 40_000.0;
/// Longest look from a lane to the kerb, metres.
const KERB_LOOK_M: f64 = 12.0;
/// A road edge farther from any lane borders nothing that people walk along, metres.
const EDGE_REACH_M: f64 = 15.0;
/// A look to the side that ends on another lane's band meets no kerb, metres beyond the own border.
const NEXT_LANE_M: f64 = 1.2;
/// Facts of a cell.
pub(super) const FACTS: usize = 6;
/// Place of the gap to the leader among a lane cell's facts.
pub(super) const LEADER: usize = 5;
/// Upper bounds of the classes of distance to the leader, centre to centre, metres.
const LEADER_M: [f64; 7] = [7.0, 10.0, 14.0, 20.0, 30.0, 40.0, f64::INFINITY];
/// Farthest leader that counts, metres.
const LEADER_REACH_M: f64 = 40.0;

/// Sort of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SiteKind {
    /// On a lane, driving or waiting.
    Lane,
    /// Parked between a lane and the kerb, or beside a lane without one.
    Kerb,
    /// On a crosswalk.
    Crosswalk,
    /// On the pavement along a road edge, or on a sidewalk lane.
    Pavement,
    /// Parked in a driveway.
    Driveway,
}

impl SiteKind {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Lane, Self::Kerb, Self::Crosswalk, Self::Pavement, Self::Driveway];

    /// How many classes each fact has.
    pub(super) fn classes(self) -> &'static [usize] {
        match self {
            Self::Lane => const { &[8, 7, Ahead::CLASSES, 5, 9, 2 * (LEADER_M.len() + 1)] },
            Self::Kerb => &[7, 2, 7, 4, 8],
            Self::Crosswalk => &[2],
            Self::Pavement => &[4, 5, 7, 2],
            Self::Driveway => &[],
        }
    }
}

/// One cell.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) kind: SiteKind,
    /// Graph lane; of a pavement without lane the road edge; of a driveway its index.
    pub(super) line: usize,
    /// A pavement that is a sidewalk lane.
    pub(super) on_lane: bool,
    pub(super) from_m: f64,
    pub(super) to_m: f64,
    pub(super) center: Vec2,
    /// Kerbs: +1 left of the lane, -1 right. Pavements along an edge: the side away from the road.
    pub(super) side: f64,
    /// Kerbs: from the lane's border to the kerb, metres; infinite without one.
    pub(super) free_m: f64,
    pub(super) facts: [u8; FACTS],
    pub(super) ahead: Ahead,
}

impl Site {
    /// What its rate is multiplied by: metres, or one for a driveway.
    pub(super) fn extent(&self) -> f64 {
        if self.kind == SiteKind::Driveway { 1.0 } else { self.to_m - self.from_m }
    }
}

/// All cells of a scene at one moment.
pub(super) struct Sites<'a> {
    pub(super) scene: &'a Scene,
    pub(super) graph: &'a LaneGraph,
    pub(super) lights: Lights,
    /// Road edges as lines.
    pub(super) edges: Vec<Polyline>,
    pub(super) all: Vec<Site>,
    /// By graph lane: the cells of kind lane, of which the first may not be the lane's own first.
    by_lane: HashMap<usize, LaneCells>,
}

struct LaneCells {
    sites: Range<usize>,
    first_cell: usize,
    cells: usize,
}

fn class(value: f64, bounds: &[f64]) -> u8 {
    bounds.iter().filter(|b| value >= **b).count() as u8
}

fn limit_class(limit_mps: f64) -> u8 {
    class(limit_mps, &[6.5, 10.0, 12.5, 15.0, 19.0, 26.0])
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

impl<'a> Sites<'a> {
    /// Cells whose centre may lie in the region, with the facts that hold at `step`.
    pub(super) fn new(scene: &'a Scene, graph: &'a LaneGraph, step: usize, region: &Region) -> Self {
        let map = &scene.map;
        let edges: Vec<Polyline> =
            map.road_edges.iter().map(|e| Polyline::new(e.points.xy.iter().copied())).collect();
        let lanes_m: f64 = graph.lanes().iter().map(|l| l.path.length_m()).sum();
        let edges_m: f64 = edges.iter().map(Polyline::length_m).sum();
        let cell_m = CELL_M.max((2.0 * lanes_m + edges_m) / MAX_CELLS);
        let lights = Lights::new(scene, graph, step);
        let mut sites = Self { scene, graph, lights, edges, all: Vec::new(), by_lane: HashMap::new() };
        sites.lanes(cell_m, region);
        sites.kerbs(region);
        sites.crosswalks(cell_m, region);
        sites.pavements(cell_m, region);
        sites.driveways(region);
        sites
    }

    /// The line a cell lies on; `None` for driveways.
    pub(super) fn path(&self, site: &Site) -> Option<&Polyline> {
        match site.kind {
            SiteKind::Driveway => None,
            SiteKind::Pavement if !site.on_lane => self.edges.get(site.line),
            _ => self.graph.lanes().get(site.line).map(|l| &l.path),
        }
    }

    fn lanes(&mut self, cell_m: f64, region: &Region) {
        let graph = self.graph;
        for (index, lane) in graph.lanes().iter().enumerate().filter(|(_, l)| drives(l)) {
            let length_m = lane.path.length_m();
            if length_m < 0.5 {
                continue;
            }
            let cells = (length_m / cell_m).ceil().max(1.0) as usize;
            let size = length_m / cells as f64;
            let centers: Vec<Vec2> =
                (0..cells).map(|i| lane.path.sample((i as f64 + 0.5) * size).position).collect();
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
                let bend = lane.path.curvature_at(s, 6.0).abs();
                let facts = [
                    lane_class(lane),
                    limit_class(lane.speed_limit_mps),
                    ahead.class() as u8,
                    class(bend, &[0.005, 0.02, 0.06, 0.12]),
                    3 * sides[0] + sides[1],
                    0,
                ];
                self.all.push(Site {
                    kind: SiteKind::Lane,
                    line: index,
                    on_lane: true,
                    from_m: i as f64 * size,
                    to_m: (i + 1) as f64 * size,
                    center: centers[i],
                    side: 0.0,
                    free_m: 0.0,
                    facts,
                    ahead,
                });
            }
            let sites = begin..self.all.len();
            self.by_lane.insert(index, LaneCells { sites, first_cell: first, cells });
        }
    }

    /// Strips between lanes and kerbs. Junctions and freeways have none, nor have maps without road edges:
    /// nothing says there where the road ends.
    fn kerbs(&mut self, region: &Region) {
        if self.edges.is_empty() {
            return;
        }
        let edges = (0..).zip(&self.scene.map.road_edges);
        let index = SegmentIndex::new(edges.flat_map(|(i, edge)| pieces(&edge.points.xy, i)).collect());
        let mut found = Vec::new();
        for site in self.all.iter().filter(|s| s.kind == SiteKind::Lane) {
            let lane = &self.graph.lanes()[site.line];
            if lane.interpolating || lane.lane_type == LaneType::Freeway {
                continue;
            }
            let s = 0.5 * (site.from_m + site.to_m);
            let way = direction(lane.path.sample(s).heading_rad);
            let half_m = 0.5 * lane.width_m;
            for side in [1.0, -1.0] {
                let across = Vec2::new(-way.y, way.x) * side;
                let beyond = site.center + across * (half_m + NEXT_LANE_M);
                if !region.may_hold(beyond, KERB_LOOK_M) || self.on_other_lane(beyond, site.line) {
                    continue;
                }
                let edge_m = index.ray_m(site.center, across, KERB_LOOK_M);
                let free_m = edge_m.map_or(f64::INFINITY, |m| m - half_m);
                let facts = [
                    class(free_m, &[0.5, 1.5, 2.5, 3.5, 5.0, 8.0]),
                    u8::from(side > 0.0),
                    limit_class(lane.speed_limit_mps),
                    class(site.ahead.stop_m(), &[10.0, 20.0, 40.0]),
                    lane_class(lane),
                    0,
                ];
                found.push(Site {
                    kind: SiteKind::Kerb,
                    side,
                    free_m,
                    facts,
                    center: beyond,
                    ..site.clone()
                });
            }
        }
        self.all.extend(found);
    }

    /// The point lies on the band of a lane other than `but` that traffic uses.
    fn on_other_lane(&self, point: Vec2, but: usize) -> bool {
        let hits = self.graph.nearest_lanes(point, 4.0, |i, lane| i != but && drives(lane));
        // The lane's own continuation lies along it, not beside it: its foot is its end.
        hits.iter().any(|h| {
            let lane = &self.graph.lanes()[h.lane];
            let inside = h.s_m > 0.01 && h.s_m < lane.path.length_m() - 0.01;
            inside && h.distance_m < 0.5 * lane.width_m
        })
    }

    fn crosswalks(&mut self, cell_m: f64, region: &Region) {
        let mut seen = HashSet::new();
        for (index, lane) in self.graph.lanes().iter().enumerate() {
            let LaneSource::Crosswalk(area) = lane.source else { continue };
            // Each crosswalk is there twice, once for each way.
            if !seen.insert(area) {
                continue;
            }
            let length_m = lane.path.length_m();
            for (from_m, to_m) in cuts(length_m, cell_m) {
                let s = 0.5 * (from_m + to_m);
                let near_end = s < 0.25 * length_m || s > 0.75 * length_m;
                self.push_walk(SiteKind::Crosswalk, index, true, from_m, to_m, region, |_, _| {
                    Some((1.0, [u8::from(near_end), 0, 0, 0, 0, 0]))
                });
            }
        }
    }

    /// Sidewalk lanes; on maps without any, the outer sides of road edges.
    fn pavements(&mut self, cell_m: f64, region: &Region) {
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
                self.push_walk(SiteKind::Pavement, index, true, from_m, to_m, region, |graph, center| {
                    let hit = graph.nearest_for(center, EDGE_REACH_M, AgentType::Vehicle).into_iter().next();
                    // The kerb lies some two metres nearer to the road than a sidewalk's middle.
                    Some((1.0, pavement_facts(graph, center, hit.as_ref(), 2.0, false)))
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
                self.push_walk(SiteKind::Pavement, index, false, from_m, to_m, region, |graph, center| {
                    let hit =
                        graph.nearest_for(center, EDGE_REACH_M, AgentType::Vehicle).into_iter().next()?;
                    let foot = graph.lanes()[hit.lane].path.sample(hit.s_m).position;
                    let outwards = -1f64.copysign(cross(direction(heading_rad), foot - center));
                    Some((outwards, pavement_facts(graph, center, Some(&hit), 0.0, median)))
                });
            }
        }
    }

    fn push_walk(
        &mut self,
        kind: SiteKind,
        line: usize,
        on_lane: bool,
        from_m: f64,
        to_m: f64,
        region: &Region,
        facts: impl Fn(&LaneGraph, Vec2) -> Option<(f64, [u8; FACTS])>,
    ) {
        let path = if on_lane { &self.graph.lanes()[line].path } else { &self.edges[line] };
        let center = path.sample(0.5 * (from_m + to_m)).position;
        if !region.may_hold(center, to_m - from_m + 6.0) {
            return;
        }
        if let Some((side, facts)) = facts(self.graph, center) {
            let ahead = Ahead::Nothing;
            self.all.push(Site {
                kind,
                line,
                on_lane,
                from_m,
                to_m,
                center,
                side,
                free_m: 0.0,
                facts,
                ahead,
            });
        }
    }

    fn driveways(&mut self, region: &Region) {
        for (line, area) in self.scene.map.driveways.iter().enumerate() {
            let ring = &area.polygon.xy;
            if ring.len() < 3 {
                continue;
            }
            let center = ring.iter().sum::<Vec2>() / ring.len() as f64;
            if region.may_hold(center, 20.0) {
                let ahead = Ahead::Nothing;
                self.all.push(Site {
                    kind: SiteKind::Driveway,
                    line,
                    on_lane: false,
                    from_m: 0.0,
                    to_m: 0.0,
                    center,
                    side: 0.0,
                    free_m: 0.0,
                    facts: [0; FACTS],
                    ahead,
                });
            }
        }
    }

    /// The cell at arc length `s_m` of a lane.
    pub(super) fn lane_site(&self, lane: usize, s_m: f64) -> Option<usize> {
        let held = self.by_lane.get(&lane)?;
        let length_m = self.graph.lanes()[lane].path.length_m();
        let cell = ((s_m / length_m * held.cells as f64) as usize).min(held.cells - 1);
        let at = held.sites.start + cell.checked_sub(held.first_cell)?;
        held.sites.contains(&at).then_some(at)
    }

    /// Kilometres of lane for motor vehicles in the region, junctions left out.
    pub(super) fn lane_km(&self, region: &Region) -> f64 {
        let counted = self.all.iter().filter(|s| {
            let lane = &self.graph.lanes()[s.line.min(self.graph.lanes().len() - 1)];
            s.kind == SiteKind::Lane
                && lane.carries(AgentType::Vehicle)
                && !lane.interpolating
                && region.contains(s.center)
        });
        counted.map(Site::extent).sum::<f64>() / 1000.0
    }

    /// Calls `found` with the cells behind the place at `s_m` of a lane and their distance to it, metres,
    /// up to [`LEADER_REACH_M`], along all lanes that lead there.
    pub(super) fn behind(&self, lane: usize, s_m: f64, mut found: impl FnMut(usize, f64)) {
        let mut todo = vec![(lane, s_m, 0.0)];
        let mut seen = HashSet::new();
        while let Some((lane, s_m, travelled_m)) = todo.pop() {
            if !seen.insert(lane) || seen.len() > 32 {
                continue;
            }
            if let Some(held) = self.by_lane.get(&lane) {
                for at in held.sites.clone().rev() {
                    let site = &self.all[at];
                    let gap_m = travelled_m + s_m - 0.5 * (site.from_m + site.to_m);
                    // The own cell is not behind.
                    if site.to_m <= s_m && (0.0..LEADER_REACH_M).contains(&gap_m) {
                        found(at, gap_m);
                    }
                }
            }
            if travelled_m + s_m < LEADER_REACH_M {
                for before in &self.graph.lanes()[lane].predecessors {
                    todo.push((*before, self.graph.lanes()[*before].path.length_m(), travelled_m + s_m));
                }
            }
        }
    }

    /// The driveway that holds a point.
    pub(super) fn driveway_at(&self, point: Vec2) -> Option<usize> {
        let of_driveways =
            self.all.iter().enumerate().rev().take_while(|(_, s)| s.kind == SiteKind::Driveway);
        let mut holding = of_driveways
            .filter(|(_, s)| (s.center - point).norm() < 40.0)
            .filter(|(_, s)| in_ring(&self.scene.map.driveways[s.line].polygon.xy, point));
        holding.next().map(|(at, _)| at)
    }
}

/// Class of a cell's distance to the leader; twice as many, for queues apart from flowing traffic.
pub(super) fn leader_class(gap_m: f64, queues: bool) -> u8 {
    let gap = if gap_m.is_finite() { class(gap_m, &LEADER_M) } else { LEADER_M.len() as u8 };
    gap + (LEADER_M.len() as u8 + 1) * u8::from(queues)
}

fn pavement_facts(
    graph: &LaneGraph,
    center: Vec2,
    lane: Option<&LaneHit>,
    kerb_m: f64,
    median: bool,
) -> [u8; FACTS] {
    let crosswalk = |_: usize, l: &GraphLane| matches!(l.source, LaneSource::Crosswalk(_));
    let crossing_m =
        graph.nearest_lanes(center, 30.0, crosswalk).first().map_or(f64::INFINITY, |h| h.distance_m);
    let lane_m = lane.map_or(f64::INFINITY, |h| h.distance_m - kerb_m);
    let limit = lane.map_or(13.4, |h| graph.lanes()[h.lane].speed_limit_mps);
    [
        class(crossing_m, &[4.0, 12.0, 30.0]),
        class(lane_m, &[2.5, 4.0, 6.0, 9.0]),
        limit_class(limit),
        u8::from(median),
        0,
        0,
    ]
}

/// Even pieces of a line of at most `cell_m`; none of a line without length.
fn cuts(length_m: f64, cell_m: f64) -> impl Iterator<Item = (f64, f64)> {
    let cells = if length_m < 0.5 { 0 } else { (length_m / cell_m).ceil() as usize };
    let size = length_m / cells.max(1) as f64;
    (0..cells).map(move |i| (i as f64 * size, (i + 1) as f64 * size))
}
