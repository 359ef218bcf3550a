//! A SUMO network as a lane map.

use super::kerb::{self, Borders, Corner, JunctionArea};
use super::net::{EdgeFunction, LaneKind, Net};
use super::polyline::{length, offset_right, resample, simplify, tangents};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::{Area, Lane, LaneMap, LaneType, Neighbor, StopSign, TypedLine};
use std::collections::HashMap;

/// Spacing of lane points, metres: on roads and within junctions.
const SPACING_M: (f64, f64) = (2.0, 1.0);
/// Left borders nearer than this to those of oncoming traffic are one painted line, metres.
const TOUCHING_M: f64 = 0.6;
/// Left borders up to this far from those of oncoming traffic enclose a median, metres.
const MEDIAN_M: f64 = 15.0;

/// What a lane map of a network carries besides traffic lanes.
#[derive(Clone, Copy, Debug)]
pub struct MapOptions {
    /// Sidewalks as lanes.
    pub sidewalks: bool,
    /// Strips closed to traffic as parking lanes.
    pub parking: bool,
}

/// A signal of the network: which feature it rules and where its states are found.
#[derive(Clone, Debug)]
pub struct SignalPlace {
    /// Id of the lane or crosswalk in the map.
    pub feature: String,
    /// Signal program.
    pub program: String,
    /// Link index within the program.
    pub link: usize,
    /// Where to stop.
    pub stop: Vec2,
}

/// A network's map. Ids are whole numbers, unique over all kinds of features.
#[derive(Clone, Debug, Default)]
pub struct NetMap {
    /// In the network's frame.
    pub map: LaneMap,
    /// Signals of the map's lanes and crosswalks.
    pub signals: Vec<SignalPlace>,
}

/// Draws a network's map.
pub fn lane_map(net: &Net, options: MapOptions) -> NetMap {
    let mut builder = Builder { net, out: NetMap::default(), next_id: net.lanes.len(), tapers: tapers(net) };
    builder.lanes(options);
    builder.crosswalks();
    builder.signs();
    let all = kerb::borders(net);
    let junctions = kerb::junctions(net, &all);
    builder.lane_lines(&all);
    builder.taper_lines();
    builder.edges(&all);
    builder.corners(&all, &junctions);
    if options.sidewalks {
        builder.sidewalk_corners(&junctions);
    }
    builder.drivable(&all, &junctions);
    builder.out
}

struct Builder<'a> {
    net: &'a Net,
    out: NetMap,
    next_id: usize,
    /// For lanes within a node where one edge merely goes on as another: lane before, lane after.
    tapers: HashMap<usize, (usize, usize)>,
}

/// Lanes within nodes where nobody crosses: from the only edge into a node to the only edge out of it.
fn tapers(net: &Net) -> HashMap<usize, (usize, usize)> {
    let mut ends: HashMap<&str, (usize, usize)> = HashMap::new();
    for edge in net.edges.iter().filter(|e| e.function == EdgeFunction::Normal) {
        ends.entry(&edge.to).or_default().0 += 1;
        ends.entry(&edge.from).or_default().1 += 1;
    }
    let mut found = HashMap::new();
    for (before, lane) in net.lanes.iter().enumerate() {
        let edge = net.edge_of(before);
        // Nor does anybody cross on a motorway, where ramps join or leave.
        if ends.get(edge.to.as_str()) != Some(&(1, 1)) && !edge.road_type.contains("motorway") {
            continue;
        }
        let travelled = |kind| matches!(kind, LaneKind::Vehicle | LaneKind::Bike | LaneKind::Bus);
        for &inner in lane.successors.iter().filter(|&&l| travelled(net.lanes[l].kind)) {
            if let [after] = net.lanes[inner].successors[..] {
                found.insert(inner, (before, after));
            }
        }
    }
    found
}

fn lane_id(lane: usize) -> String {
    (lane + 1).to_string()
}

impl Builder<'_> {
    fn id(&mut self) -> String {
        self.next_id += 1;
        self.next_id.to_string()
    }

    fn is_lot(&self, edge: usize) -> bool {
        self.net.edges[edge].road_type == "lot"
    }

    fn lane_type(&self, lane: usize) -> Option<LaneType> {
        let internal = self.net.edge_of(lane).function == EdgeFunction::Internal;
        match self.net.lanes[lane].kind {
            LaneKind::Vehicle if internal => {
                let leads_in = |l: &usize| self.net.lanes[*l].successors.contains(&lane);
                let before = (0..self.net.lanes.len()).find(leads_in).filter(|l| *l != lane);
                let freeway = before.is_some_and(|l| self.net.edge_of(l).road_type.contains("motorway"));
                Some(if freeway { LaneType::Freeway } else { LaneType::SurfaceStreet })
            }
            LaneKind::Vehicle if self.net.edge_of(lane).road_type.contains("motorway") => {
                Some(LaneType::Freeway)
            }
            LaneKind::Vehicle => Some(LaneType::SurfaceStreet),
            LaneKind::Bike => Some(LaneType::BikeLane),
            LaneKind::Bus => Some(LaneType::BusLane),
            LaneKind::Sidewalk => Some(LaneType::Sidewalk),
            LaneKind::Closed if !internal => Some(LaneType::Parking),
            _ => None,
        }
    }

    fn lanes(&mut self, options: MapOptions) {
        let net = self.net;
        let kept = |kind: Option<LaneType>| match kind {
            Some(LaneType::Sidewalk) => options.sidewalks,
            Some(LaneType::Parking) => options.parking,
            other => other.is_some(),
        };
        let types: Vec<Option<LaneType>> =
            (0..net.lanes.len()).map(|l| self.lane_type(l).filter(|t| kept(Some(*t)))).collect();
        let mut predecessors = vec![Vec::new(); net.lanes.len()];
        for (i, lane) in net.lanes.iter().enumerate() {
            for &next in lane.successors.iter().filter(|&&n| types[i].is_some() && types[n].is_some()) {
                predecessors[next].push(lane_id(i));
            }
        }
        for (i, lane) in net.lanes.iter().enumerate() {
            let Some(lane_type) = types[i].filter(|_| lane.shape.len() > 1) else { continue };
            let internal = net.edge_of(i).function == EdgeFunction::Internal;
            let step = if internal { SPACING_M.1 } else { SPACING_M.0 };
            let drives = |t: LaneType| t.carries_vehicles() || t.carries_cyclists();
            let travelled = drives(lane_type);
            let points =
                if travelled { resample(&lane.shape, step) } else { simplify(&lane.shape, 0.03, 20.0) };
            let next = lane.successors.iter().filter(|&&n| types[n].is_some()).map(|&n| lane_id(n)).collect();
            let beside = |other: Option<usize>| -> Vec<Neighbor> {
                let other = other.and_then(|index| net.edge_of(i).lanes.get(index).copied());
                let other = other.filter(|&o| !internal && travelled && types[o].is_some_and(drives));
                let count = |l: usize| (length(&net.lanes[l].shape) / step).round();
                other
                    .map(|o| Neighbor {
                        lane: lane_id(o),
                        own_range: (0, points.len() - 1),
                        other_range: (0, count(o).max(1.0) as usize),
                        boundaries: Vec::new(),
                    })
                    .into_iter()
                    .collect()
            };
            let lane = Lane {
                id: lane_id(i),
                lane_type,
                left_neighbors: beside(Some(lane.index + 1)),
                right_neighbors: beside(lane.index.checked_sub(1)),
                points: points.into(),
                width_m: Some(lane.width_m),
                left_boundary: Vec::new(),
                right_boundary: Vec::new(),
                speed_limit_mps: travelled.then_some(lane.speed_mps),
                predecessors: predecessors[i].clone(),
                successors: next,
                interpolating: internal && !self.tapers.contains_key(&i),
            };
            self.out.map.lanes.push(lane);
            if let (Some((program, link)), true) = (&net.lanes[i].signal, travelled) {
                let place = SignalPlace {
                    feature: lane_id(i),
                    program: program.clone(),
                    link: *link,
                    stop: net.lanes[i].shape[0],
                };
                self.out.signals.push(place);
            }
        }
    }

    fn crosswalks(&mut self) {
        for (i, lane) in self.net.lanes.iter().enumerate() {
            if lane.kind != LaneKind::Crossing || lane.shape.len() < 2 {
                continue;
            }
            let mut ring = offset_right(&lane.shape, lane.width_m / 2.0);
            ring.extend(offset_right(&lane.shape, -lane.width_m / 2.0).iter().rev());
            self.out.map.crosswalks.push(area(lane_id(i), ring));
            if let Some((program, link)) = &lane.signal {
                let place = SignalPlace {
                    feature: lane_id(i),
                    program: program.clone(),
                    link: *link,
                    stop: lane.shape[0],
                };
                self.out.signals.push(place);
            }
        }
    }

    fn signs(&mut self) {
        let net = self.net;
        for edge in &net.edges {
            let through: Vec<usize> = net
                .lanes_of(edge, LaneKind::Vehicle)
                .flat_map(|l| net.lanes[l].successors.iter().copied())
                .filter(|&l| net.lanes[l].stops)
                .collect();
            let Some(&right) = edge.lanes.first().filter(|_| !through.is_empty()) else { continue };
            let lane = &net.lanes[right];
            let border = offset_right(&lane.shape, lane.width_m / 2.0 + 0.4);
            let Some(&position) = border.last() else { continue };
            let id = self.id();
            let lanes = through.into_iter().map(lane_id).collect();
            self.out.map.stop_signs.push(StopSign { id, position, z_m: None, lanes });
        }
    }

    fn line(&mut self, line_type: &str, points: Vec<Vec2>) {
        if points.len() > 1 {
            let (id, points) = (self.id(), simplify(&points, 0.03, 20.0).into());
            self.out.map.road_lines.push(TypedLine { id, line_type: line_type.to_owned(), points });
        }
    }

    fn edge(&mut self, line_type: &str, points: Vec<Vec2>) {
        if points.len() > 1 {
            let (id, points) = (self.id(), simplify(&points, 0.02, 20.0).into());
            self.out.map.road_edges.push(TypedLine { id, line_type: line_type.to_owned(), points });
        }
    }

    /// Painted lines between lanes of one direction.
    fn lane_lines(&mut self, all: &[Borders]) {
        for borders in all {
            let edge = &self.net.edges[borders.edge];
            let inner: Vec<usize> = edge
                .lanes
                .iter()
                .copied()
                .filter(|&l| self.net.lanes[l].kind != LaneKind::Sidewalk)
                .collect();
            for pair in inner.windows(2) {
                let (a, b) = (&self.net.lanes[pair[0]], &self.net.lanes[pair[1]]);
                let both = a.kind == LaneKind::Vehicle && b.kind == LaneKind::Vehicle;
                let line_type = if both { "broken_single_white" } else { "solid_single_white" };
                self.line(line_type, offset_right(&a.shape, -a.width_m / 2.0));
            }
        }
    }

    /// Painted lines where a turn lane opens: beside each lane that has one to its left.
    fn taper_lines(&mut self) {
        let net = self.net;
        let mut inner: Vec<(usize, usize)> = self.tapers.iter().map(|(l, ends)| (ends.0, *l)).collect();
        inner.sort_unstable();
        for pair in inner.windows(2) {
            let ((before, lane), (next_before, next)) = (pair[0], pair[1]);
            if net.lanes[before].edge != net.lanes[next_before].edge || before == next_before {
                continue;
            }
            let both = [lane, next].iter().all(|&l| net.lanes[l].kind == LaneKind::Vehicle);
            let line_type = if both { "broken_single_white" } else { "solid_single_white" };
            self.line(line_type, offset_right(&net.lanes[lane].shape, -net.lanes[lane].width_m / 2.0));
        }
    }

    /// Right borders, and left borders by what lies beyond them: oncoming traffic, a median, nothing.
    fn edges(&mut self, all: &[Borders]) {
        let extents = extents(all);
        for (b, borders) in all.iter().enumerate() {
            let lot = self.is_lot(borders.edge);
            if !lot {
                self.edge("boundary", borders.right.clone());
            }
            let line = resample(&borders.left, 2.0);
            let ways = tangents(&line);
            let sides: Vec<LeftSide> =
                line.iter().zip(&ways).map(|(p, way)| left_side(*p, *way, Some(b), all, &extents)).collect();
            let mut from = 0;
            for to in 1..=sides.len() {
                if to < sides.len() && sides[to].kind() == sides[from].kind() {
                    continue;
                }
                let piece = line[from..(to + 1).min(line.len())].to_vec();
                match sides[from] {
                    LeftSide::Oncoming(other) if other < b => {}
                    LeftSide::Oncoming(_) => {
                        let quiet = self.net.edges[borders.edge].road_type == "residential" || lot;
                        let line = if quiet { "broken_single_yellow" } else { "solid_double_yellow" };
                        self.line(line, piece);
                    }
                    LeftSide::Median => self.edge("median", piece),
                    LeftSide::Open => self.edge("boundary", piece),
                }
                from = to;
            }
        }
    }

    fn corners(&mut self, all: &[Borders], junctions: &[JunctionArea]) {
        let extents = extents(all);
        for junction in junctions {
            // Where only two arms meet, the road goes on: its median or middle line goes on too.
            for Corner { points, from, to, turn_rad } in &junction.corners {
                let mixed = self.is_lot(from.0) != self.is_lot(to.0);
                let merging = turn_rad.abs() > 2.4;
                let both_lots = self.is_lot(from.0) && self.is_lot(to.0);
                if mixed || both_lots || merging {
                    continue;
                }
                // From the right border of a lane inwards to a right border outwards is a kerb; the other
                // way round is the left side of a stretch between two one-way edges.
                let (first, last) = (points[0], points[points.len() - 1]);
                if from.1 || !to.1 || junction.arms > 2 {
                    self.edge("boundary", points.clone());
                    continue;
                }
                let way = (first - last) / (first - last).norm().max(1e-9);
                match left_side((first + last) / 2.0, way, None, all, &extents) {
                    LeftSide::Oncoming(_) => self.line("solid_double_yellow", points.clone()),
                    LeftSide::Median => self.edge("median", points.clone()),
                    LeftSide::Open => self.edge("boundary", points.clone()),
                }
            }
        }
    }

    /// Sidewalks go on round the corners, at their distance from the kerb.
    fn sidewalk_corners(&mut self, junctions: &[JunctionArea]) {
        let net = self.net;
        let sidewalk = |edge: usize| net.lanes_of(&net.edges[edge], LaneKind::Sidewalk).next();
        for corner in junctions.iter().flat_map(|j| &j.corners) {
            if !corner.from.1 || corner.to.1 || corner.turn_rad > 2.4 {
                continue;
            }
            let (Some(a), Some(b)) = (sidewalk(corner.from.0), sidewalk(corner.to.0)) else { continue };
            let (from, to) = (&net.lanes[a], &net.lanes[b]);
            let (n, width_m) = (from.shape.len(), from.width_m.min(to.width_m));
            if n < 2 || to.shape.len() < 2 {
                continue;
            }
            let way = |v: Vec2| v / v.norm().max(1e-9);
            let (d, e) = (way(from.shape[n - 1] - from.shape[n - 2]), way(to.shape[1] - to.shape[0]));
            let points = kerb::corner(from.shape[n - 1], d, to.shape[0], e, (7.5 - width_m / 2.0).max(2.0));
            let id = self.id();
            let lane = Lane {
                id: id.clone(),
                lane_type: LaneType::Sidewalk,
                points: points.into(),
                width_m: Some(width_m),
                left_boundary: Vec::new(),
                right_boundary: Vec::new(),
                speed_limit_mps: None,
                predecessors: vec![lane_id(a)],
                successors: vec![lane_id(b)],
                left_neighbors: Vec::new(),
                right_neighbors: Vec::new(),
                interpolating: true,
            };
            for other in &mut self.out.map.lanes {
                if other.id == lane.predecessors[0] {
                    other.successors.push(id.clone());
                } else if other.id == lane.successors[0] {
                    other.predecessors.push(id.clone());
                }
            }
            self.out.map.lanes.push(lane);
        }
    }

    fn drivable(&mut self, all: &[Borders], junctions: &[JunctionArea]) {
        for borders in all {
            let mut ring = simplify(&borders.right, 0.02, 30.0);
            ring.extend(simplify(&borders.left, 0.02, 30.0).iter().rev());
            let id = self.id();
            self.out.map.drivable.push(area(id, ring));
        }
        for junction in junctions {
            let id = self.id();
            self.out.map.drivable.push(area(id, junction.ring.clone()));
        }
    }
}

fn area(id: String, ring: Vec<Vec2>) -> Area {
    Area { id, polygon: ring.into(), holes: Vec::new() }
}

#[derive(Clone, Copy)]
enum LeftSide {
    /// The border at this index touches.
    Oncoming(usize),
    Median,
    Open,
}

impl LeftSide {
    fn kind(self) -> (u8, usize) {
        match self {
            Self::Oncoming(other) => (0, other),
            Self::Median => (1, 0),
            Self::Open => (2, 0),
        }
    }
}

/// Corners of the upright boxes about left borders, grown by what counts as a median.
fn extents(all: &[Borders]) -> Vec<(Vec2, Vec2)> {
    let margin = Vec2::repeat(MEDIAN_M);
    let fold = |b: &Borders, pick: fn(f64, f64) -> f64| {
        b.left.iter().skip(1).fold(b.left[0], |a, p| Vec2::new(pick(a.x, p.x), pick(a.y, p.y)))
    };
    all.iter().map(|b| (fold(b, f64::min) - margin, fold(b, f64::max) + margin)).collect()
}

/// What lies to the left of the point `p` of a left border that goes along `way`.
fn left_side(p: Vec2, way: Vec2, own: Option<usize>, all: &[Borders], extents: &[(Vec2, Vec2)]) -> LeftSide {
    let mut best = (MEDIAN_M, None);
    for (b, other) in all.iter().enumerate().filter(|(b, _)| Some(*b) != own) {
        let (low, high) = extents[b];
        if p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y {
            continue;
        }
        for w in other.left.windows(2) {
            let along = w[1] - w[0];
            let share = ((p - w[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
            let foot = w[0] + along * share;
            let gap = (foot - p).norm();
            // Beyond the left border, and the other way round.
            let beyond = gap < TOUCHING_M || cross(way, foot - p) > 0.0;
            if gap < best.0 && beyond && along.dot(&way) < -0.7 * along.norm() {
                best = (gap, Some(b));
            }
        }
    }
    match best {
        (gap, Some(b)) if gap < TOUCHING_M => LeftSide::Oncoming(b),
        (_, Some(_)) => LeftSide::Median,
        _ => LeftSide::Open,
    }
}
