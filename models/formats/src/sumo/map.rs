//! Converts a SUMO network to a lane map.

use super::kerb::{self, Borders, JunctionArea};
use super::medians;
use super::narrow::NarrowRoads;
use super::net::{EdgeFunction, LaneKind, NARROWEST_LANE_M, Net};
use crate::polyline::{length, offset_right, resample, simplify};
use scene::Vec2;
use scene::map::{Area, Lane, LaneMap, LaneType, Neighbor, StopSign};
use std::cell::Cell;
use std::collections::HashMap;

/// Spacing of lane points, metres: on roads and within junctions.
pub(super) const SPACING_M: (f64, f64) = (2.0, 1.0);
/// Most segments of a lane; those of longer lanes are longer.
pub(super) const MAX_PIECES: f64 = 4_000.0;
/// Most comparisons between left borders: five times as many as a large town needs. A network with overlaps
/// everywhere would need their square.
const MOST_LEFT_CHECKS: u64 = 50_000_000;

/// Content of a network's lane map besides traffic lanes.
#[derive(Clone, Copy, Debug)]
pub struct MapOptions {
    /// Sidewalks as lanes.
    pub sidewalks: bool,
    /// Strips closed to traffic as parking lanes.
    pub parking: bool,
}

/// A signal of the network: the feature that it controls, and the source of its states.
#[derive(Clone, Debug)]
pub struct SignalPlace {
    /// Id of the lane or crosswalk in the map.
    pub feature: String,
    /// Signal program.
    pub program: String,
    /// Link index within the program.
    pub link: usize,
    /// Stop position.
    pub stop: Vec2,
}

/// A network's map. Ids are integers, unique over all kinds of features.
#[derive(Clone, Debug, Default)]
pub struct NetMap {
    /// Map in the network's frame.
    pub map: LaneMap,
    /// Signals of the map's lanes and crosswalks.
    pub signals: Vec<SignalPlace>,
    /// Number of narrow two-way roads, whose lanes share the middle of the road.
    pub narrow: usize,
}

/// Draws a network's map.
pub fn lane_map(net: &Net, options: MapOptions) -> NetMap {
    let links = net.lanes.iter().enumerate().flat_map(|(i, l)| l.successors.iter().map(move |s| (*s, i)));
    let before = links.filter(|(lane, from)| lane != from).collect();
    let mut builder = Builder {
        net,
        out: NetMap::default(),
        next_id: net.lanes.len(),
        tapers: tapers(net),
        narrow: NarrowRoads::of(net),
        before,
        left_checks: Cell::new(MOST_LEFT_CHECKS),
    };
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
    medians::close(&mut builder.out.map, |_| false);
    builder.out.narrow = builder.narrow.count();
    builder.out
}

pub(super) struct Builder<'a> {
    pub(super) net: &'a Net,
    pub(super) out: NetMap,
    next_id: usize,
    /// For lanes within a node at which one edge only continues as another: lane before, lane after.
    pub(super) tapers: HashMap<usize, (usize, usize)>,
    pub(super) narrow: NarrowRoads,
    /// For lanes within a junction, a lane that leads into it.
    before: HashMap<usize, usize>,
    /// Number of comparisons of left borders that are left.
    pub(super) left_checks: Cell<u64>,
}

/// Lanes within nodes without crossing traffic: from the only edge into a node to the only edge out of it.
fn tapers(net: &Net) -> HashMap<usize, (usize, usize)> {
    let mut ends: HashMap<&str, (usize, usize)> = HashMap::new();
    for edge in net.edges.iter().filter(|e| e.function == EdgeFunction::Normal) {
        ends.entry(&edge.to).or_default().0 += 1;
        ends.entry(&edge.from).or_default().1 += 1;
    }
    let mut found = HashMap::new();
    for (before, lane) in net.lanes.iter().enumerate() {
        let edge = net.edge_of(before);
        // Ramps join and leave a motorway without crossing traffic.
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

/// Id in the map of a network's lane, by its index.
pub fn lane_id(lane: usize) -> String {
    (lane + 1).to_string()
}

impl Builder<'_> {
    pub(super) fn id(&mut self) -> String {
        self.next_id += 1;
        self.next_id.to_string()
    }

    pub(super) fn is_lot(&self, edge: usize) -> bool {
        self.net.edges[edge].road_type == "lot"
    }

    fn lane_type(&self, lane: usize) -> Option<LaneType> {
        let internal = self.net.edge_of(lane).function == EdgeFunction::Internal;
        let is_strip = !internal && self.net.lanes[lane].width_m >= NARROWEST_LANE_M;
        match self.net.lanes[lane].kind {
            LaneKind::Vehicle if internal => {
                let before = self.before.get(&lane);
                let freeway = before.is_some_and(|l| self.net.edge_of(*l).road_type.contains("motorway"));
                Some(if freeway { LaneType::Freeway } else { LaneType::SurfaceStreet })
            }
            LaneKind::Vehicle if self.net.edge_of(lane).road_type.contains("motorway") => {
                Some(LaneType::Freeway)
            }
            LaneKind::Vehicle => Some(LaneType::SurfaceStreet),
            LaneKind::Bike => Some(LaneType::BikeLane),
            LaneKind::Bus => Some(LaneType::BusLane),
            LaneKind::Sidewalk => Some(LaneType::Sidewalk),
            LaneKind::Closed if is_strip => Some(LaneType::Parking),
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
        let lines = self.narrow.lines(net);
        for (i, lane) in net.lanes.iter().enumerate() {
            let Some(lane_type) = types[i].filter(|_| lane.shape.len() > 1) else { continue };
            let internal = net.edge_of(i).function == EdgeFunction::Internal;
            let spacing = if internal { SPACING_M.1 } else { SPACING_M.0 };
            let step_of = |l: usize| spacing.max(length(&lines[l]) / MAX_PIECES);
            let step = step_of(i);
            let drives = |t: LaneType| t.carries_vehicles() || t.carries_cyclists();
            let travelled = drives(lane_type);
            let points = if travelled { resample(&lines[i], step) } else { simplify(&lines[i], 0.03, 20.0) };
            let next = lane.successors.iter().filter(|&&n| types[n].is_some()).map(|&n| lane_id(n)).collect();
            let beside = |other: Option<usize>| -> Vec<Neighbor> {
                let other = other.and_then(|index| net.edge_of(i).lanes.get(index).copied());
                let other = other.filter(|&o| !internal && travelled && types[o].is_some_and(drives));
                let count = |l: usize| (length(&lines[l]) / step_of(l)).round();
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
                width_m: Some(self.narrow.width_m(net, i)),
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
                    stop: lines[i][0],
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

    /// Sidewalks continue round the corners, at their distance from the kerb.
    fn sidewalk_corners(&mut self, junctions: &[JunctionArea]) {
        let net = self.net;
        let sidewalk = |edge: usize| net.lanes_of(&net.edges[edge], LaneKind::Sidewalk).next();
        for corner in junctions.iter().flat_map(|j| &j.corners) {
            if !corner.from.1 || corner.to.1 || corner.turn_rad > 2.4 {
                continue;
            }
            let (Some(a), Some(b)) = (sidewalk(corner.from.0), sidewalk(corner.to.0)) else { continue };
            let (from, to) = (&net.lanes[a], &net.lanes[b]);
            // Some networks already contain the path round the corner.
            let is_way = |lane: &usize| {
                net.lanes[*lane].kind == LaneKind::Sidewalk
                    && net.edge_of(*lane).function == EdgeFunction::Internal
            };
            if from.successors.iter().any(is_way) {
                continue;
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A two-way street that ends at a signal, with a sidewalk on one side.
    const STREET: &str = r#"<net>
      <edge id=":c_0" function="internal">
        <lane id=":c_0_0" index="0" speed="6.5" length="10" width="3" shape="0,-1.5 10,-1.5"/></edge>
      <edge id=":c_c0" function="crossing">
        <lane id=":c_c0_0" index="0" allow="pedestrian" speed="1" length="8" width="4" shape="2,-4 2,4"/></edge>
      <edge id="in" from="w" to="c">
        <lane id="in_0" index="0" allow="pedestrian" speed="2" length="50" width="2" shape="-50,-4 0,-4"/>
        <lane id="in_1" index="1" speed="13.9" length="50" width="3" shape="-50,-1.5 0,-1.5"/></edge>
      <edge id="out" from="c" to="e">
        <lane id="out_0" index="0" speed="13.9" length="50" width="3" shape="10,-1.5 60,-1.5"/></edge>
      <edge id="back" from="c" to="w">
        <lane id="back_0" index="0" speed="13.9" length="50" width="3" shape="0,1.5 -50,1.5"/></edge>
      <junction id="c" type="traffic_light" x="5" y="0"/>
      <connection from="in" to="out" fromLane="1" toLane="0" via=":c_0_0" tl="c" linkIndex="0" state="o"/>
      <connection from=":c_0" to="out" fromLane="0" toLane="0"/></net>"#;

    #[test]
    fn a_street_becomes_a_map() {
        let net = Net::read(STREET).unwrap();
        let NetMap { map, signals, .. } = lane_map(&net, MapOptions { sidewalks: true, parking: true });
        let types: Vec<LaneType> = map.lanes.iter().map(|l| l.lane_type).collect();
        use LaneType::{Sidewalk, SurfaceStreet};
        assert_eq!(types, [SurfaceStreet, Sidewalk, SurfaceStreet, SurfaceStreet, SurfaceStreet]);
        let inner = &map.lanes[0];
        assert!(inner.interpolating);
        assert_eq!((inner.predecessors.len(), inner.successors.len()), (1, 1));
        assert_eq!(map.lanes[2].successors, std::slice::from_ref(&inner.id));
        assert_eq!((signals.len(), signals[0].feature.as_str()), (1, inner.id.as_str()));
        assert_eq!(map.crosswalks[0].polygon.xy.len(), 4);
        // Oncoming lanes touch: one painted line between them, drawn once.
        let middle: Vec<_> = map.road_lines.iter().filter(|l| l.line_type == "solid_double_yellow").collect();
        assert_eq!(middle.len(), 1);
        assert!(middle[0].points.xy.iter().all(|p| p.y.abs() < 1e-9));
        let kerb = |y: f64| map.road_edges.iter().any(|e| e.points.xy.iter().all(|p| (p.y - y).abs() < 1e-9));
        assert!(kerb(-3.0) && kerb(3.0));
        assert!(map.drivable.len() >= 3);
    }

    #[test]
    fn sidewalks_are_left_out_on_demand() {
        let net = Net::read(STREET).unwrap();
        let map = lane_map(&net, MapOptions { sidewalks: false, parking: false }).map;
        assert!(map.lanes.iter().all(|l| l.lane_type != LaneType::Sidewalk));
        assert_eq!(map.lanes.len(), 4);
    }
}
