//! A lane map in the structure of SUMO: edges with parallel lanes between junctions, and links through the
//! junctions.

use super::yields::{LinkPriority, rules};
use crate::frame::Frame;
use crate::joints::{Groups, Joints, end_of, join_crossing, start_of};
use crate::polyline::length;
use scene::geometry::direction;
use scene::map::{Lane, LaneMap, LaneType};
use scene::{Scene, Vec2, wrap_angle};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// Shortest lane that is written, metres.
const SHORTEST_M: f64 = 0.01;
/// Greatest offset along the lanes between the ends of lanes of one edge, metres.
const ALIGNED_M: f64 = 3.0;
/// Greatest difference between the lateral distance of adjacent lanes of one edge and half the sum of their
/// widths, metres.
const APART_M: f64 = 1.5;
/// Most links of a junction for which SUMO has right-of-way rules.
const MOST_RULED: usize = 256;

/// Role of a lane in the network.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LaneRole {
    /// A lane of an edge, counted from the right.
    On { edge: usize, index: usize },
    /// Part of a link through a junction.
    Way,
    /// A lane without length, which is not written.
    Lost,
}

/// Parallel lanes between two junctions.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    pub id: String,
    /// Indices of its lanes in the map, from the right.
    pub lanes: Vec<usize>,
    pub from: usize,
    pub to: usize,
}

/// A link from one lane to another.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub from: usize,
    pub to: usize,
    /// The successive lanes through the junction, with the ids of their edges.
    pub via: Vec<(usize, String)>,
    /// Change of direction, radians, positive to the left.
    pub turn_rad: f64,
    /// Whether it passes a stop sign.
    pub stops: bool,
    /// Index of its signal in the list of its junction.
    pub light: Option<usize>,
}

/// A junction of lanes.
#[derive(Clone, Debug, Default)]
pub(super) struct Junction {
    pub id: String,
    /// Lanes that end here.
    pub incoming: Vec<usize>,
    /// Links, in the order of the lanes that end here.
    pub links: Vec<Link>,
    /// Priorities, one per link; empty if the junction has too many links.
    pub rules: Vec<LinkPriority>,
    /// Indices of its signals in the scene.
    pub lights: Vec<usize>,
    /// Outline around the corners of the lanes that end and begin here.
    pub outline: Vec<Vec2>,
    pub middle: Vec2,
}

/// A map in the form in which it is written, in the frame of its source.
pub(super) struct ExportedNetwork<'a> {
    pub map: &'a LaneMap,
    /// Centre lines, one per lane of the map.
    pub lines: Vec<Vec<Vec2>>,
    pub roles: Vec<LaneRole>,
    pub edges: Vec<Edge>,
    pub junctions: Vec<Junction>,
    /// Signals that control no written link.
    pub unruled: Vec<usize>,
}

/// An id in the form that SUMO accepts.
pub(super) fn plain_id(id: &str) -> String {
    id.chars().map(|c| if c.is_ascii_alphanumeric() || "_.-".contains(c) { c } else { '-' }).collect()
}

/// Ids that SUMO accepts, each unique.
#[derive(Default)]
pub(super) struct Names(HashSet<String>);

impl Names {
    pub fn take(&mut self, id: &str) -> String {
        let mut name = plain_id(id);
        while !self.0.insert(name.clone()) {
            name.push('-');
        }
        name
    }
}

fn unit(line: &[Vec2], last: bool) -> Vec2 {
    let pair = if last { line.last_chunk::<2>() } else { line.first_chunk::<2>() };
    pair.and_then(|[a, b]| (b - a).try_normalize(1e-9)).unwrap_or_default()
}

fn heading(line: &[Vec2], last: bool) -> f64 {
    let way = unit(line, last);
    way.y.atan2(way.x)
}

/// A path from one lane to another, by its lanes.
struct Way {
    from: usize,
    to: usize,
    via: Vec<usize>,
}

impl Way {
    /// The lane after the first one.
    fn entered(&self) -> usize {
        self.via.first().copied().unwrap_or(self.to)
    }
}

/// All paths through junctions, between lanes that are not part of such a path. A lane is part of one if it leads
/// through a junction from exactly one lane to exactly one other.
fn ways(map: &LaneMap, joints: &Joints, lost: impl Fn(usize) -> bool) -> Vec<Way> {
    let single = |i: usize| match (&joints.ins[i][..], &joints.outs[i][..]) {
        ([from], [to]) if map.lanes[i].interpolating && !lost(i) => Some((*from, *to)),
        _ => None,
    };
    let mut taken = vec![false; map.lanes.len()];
    let mut ways = Vec::new();
    for start in 0..map.lanes.len() {
        let Some((from, mut to)) = single(start).filter(|(from, _)| single(*from).is_none()) else {
            continue;
        };
        let mut via = vec![start];
        while let Some((_, next)) = single(to) {
            via.push(to);
            to = next;
        }
        if from != to && !lost(from) && !lost(to) {
            via.iter().for_each(|lane| taken[*lane] = true);
            ways.push(Way { from, to, via });
        }
    }
    let stands = |lane: usize| !lost(lane) && !taken[lane];
    let plain = joints.links.iter().filter(|(a, b)| stands(*a) && stands(*b));
    ways.extend(plain.map(|(from, to)| Way { from: *from, to: *to, via: Vec::new() }));
    ways
}

impl<'a> ExportedNetwork<'a> {
    pub fn of(scene: &'a Scene) -> Self {
        let map: &LaneMap = &scene.map;
        let frame = Frame::of(&scene.meta.origin);
        let placed = |lane: &Lane| {
            let mut line: Vec<Vec2> = lane.points.xy.iter().map(|p| frame.place(*p)).collect();
            line.dedup_by(|a, b| (*a - *b).norm() < 1e-5);
            line
        };
        let lines: Vec<Vec<Vec2>> = map.lanes.iter().map(placed).collect();
        let joints = Joints::of(map);
        let lost = |i: usize| length(&lines[i]) < SHORTEST_M;
        let ways = ways(map, &joints, lost);
        let mut roles = vec![LaneRole::Lost; map.lanes.len()];
        for lane in ways.iter().flat_map(|way| &way.via) {
            roles[*lane] = LaneRole::Way;
        }
        let mut names = Names::default();
        let mut edges = Vec::new();
        let is_way: Vec<bool> = roles.iter().map(|role| *role == LaneRole::Way).collect();
        for lanes in abreast(map, &lines, &joints, |i| !lost(i) && !is_way[i]) {
            let Some(first) = lanes.first().and_then(|lane| map.lanes.get(*lane)) else { continue };
            for (index, lane) in lanes.iter().enumerate() {
                roles[*lane] = LaneRole::On { edge: edges.len(), index };
            }
            edges.push(Edge { id: names.take(&first.id), lanes, from: 0, to: 0 });
        }
        let mut network = Self { map, lines, roles, edges, junctions: Vec::new(), unruled: Vec::new() };
        network.meet(ways);
        network.lights(scene, &joints);
        network.rules();
        network.outlines();
        network
    }

    /// The edge of a lane, and the lane's index in it; `None` for a lane without an edge.
    pub fn place(&self, lane: usize) -> Option<(&Edge, usize)> {
        match self.roles.get(lane) {
            Some(LaneRole::On { edge, index }) => Some((self.edges.get(*edge)?, *index)),
            _ => None,
        }
    }

    /// Joins ends of lanes to junctions, and turns paths from lane to lane into links through these.
    fn meet(&mut self, ways: Vec<Way>) {
        let mut groups = Groups::of(self.roles.len());
        for pair in self.edges.iter().flat_map(|edge| edge.lanes.windows(2)) {
            groups.join(end_of(pair[0]), end_of(pair[1]));
            groups.join(start_of(pair[0]), start_of(pair[1]));
        }
        for way in &ways {
            groups.join(end_of(way.from), start_of(way.to));
        }
        let lines =
            ways.iter().flat_map(|way| way.via.iter().map(|lane| (&self.lines[*lane][..], end_of(way.from))));
        let lines: Vec<(&[Vec2], usize)> = lines.collect();
        join_crossing(&lines, &mut groups);
        let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
        let mut junctions: Vec<Junction> = Vec::new();
        let mut at = |end: usize| {
            *numbers.entry(groups.root(end)).or_insert_with(|| {
                junctions.push(Junction { id: format!("J{}", junctions.len()), ..Junction::default() });
                junctions.len() - 1
            })
        };
        for edge in &mut self.edges {
            let Some(first) = edge.lanes.first() else { continue };
            (edge.from, edge.to) = (at(start_of(*first)), at(end_of(*first)));
        }
        for edge in &self.edges {
            junctions[edge.to].incoming.extend(&edge.lanes);
        }
        self.junctions = junctions;
        self.link(ways);
    }

    fn link(&mut self, ways: Vec<Way>) {
        let mut by_lane: HashMap<usize, Vec<Way>> = HashMap::new();
        for way in ways {
            by_lane.entry(way.from).or_default().push(way);
        }
        let signs: HashSet<&str> =
            self.map.stop_signs.iter().flat_map(|sign| &sign.lanes).map(String::as_str).collect();
        let stops = |lane: usize| self.map.lanes.get(lane).is_some_and(|lane| signs.contains(&*lane.id));
        for junction in &mut self.junctions {
            let links = junction.incoming.iter().filter_map(|from| by_lane.get(from)).map(Vec::len).sum();
            junction.links.reserve_exact(links);
            for from in &junction.incoming {
                let turn = |way: &Way| {
                    wrap_angle(heading(&self.lines[way.to], false) - heading(&self.lines[way.from], true))
                };
                let mut own = by_lane.remove(from).unwrap_or_default();
                // From the right, the order of SUMO.
                own.sort_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.to.cmp(&b.to)).then(a.via.cmp(&b.via)));
                for way in own {
                    let (turn_rad, number) = (turn(&way), junction.links.len());
                    let stops = stops(way.entered());
                    let name = |(part, lane): (usize, usize)| match part {
                        0 => (lane, format!(":{}_{number}", junction.id)),
                        _ => (lane, format!(":{}_{number}.{part}", junction.id)),
                    };
                    let via = way.via.into_iter().enumerate().map(name).collect();
                    junction.links.push(Link { from: *from, to: way.to, via, turn_rad, stops, light: None });
                }
            }
        }
    }

    /// Assigns signals to links: signals control paths through junctions, and lanes that are entered without
    /// such a path.
    fn lights(&mut self, scene: &Scene, joints: &Joints) {
        let mut ruling: HashMap<usize, usize> = HashMap::new();
        for (i, signal) in scene.signals.iter().enumerate() {
            // Signals of pavements belong to crosswalks, which are not written.
            let driven = |lane: &usize| {
                let kind = self.map.lanes[*lane].lane_type;
                kind.carries_vehicles() || kind.carries_cyclists()
            };
            let lane = scene.map.lane_index(&signal.lane).filter(driven);
            let lane = lane.filter(|lane| match self.roles.get(*lane) {
                // Traffic never stops within a junction, after the first part of a link.
                Some(LaneRole::Way) => {
                    let ins = joints.ins.get(*lane).map_or(&[][..], Vec::as_slice);
                    ins.iter().all(|lane| matches!(self.roles[*lane], LaneRole::On { .. }))
                }
                // A signal behind a junction does not control the links into it.
                Some(LaneRole::On { .. }) => {
                    let ins = joints.ins.get(*lane).map_or(&[][..], Vec::as_slice);
                    !ins.is_empty() && ins.iter().all(|lane| matches!(self.roles[*lane], LaneRole::On { .. }))
                }
                _ => false,
            });
            match lane {
                Some(lane) if !ruling.contains_key(&lane) => {
                    ruling.insert(lane, i);
                }
                _ => self.unruled.push(i),
            }
        }
        for junction in &mut self.junctions {
            for link in &mut junction.links {
                let lane = link.via.first().map_or(link.to, |(lane, _)| *lane);
                let Some(signal) = ruling.get(&lane) else { continue };
                if !junction.lights.contains(signal) {
                    junction.lights.push(*signal);
                }
                link.light = junction.lights.iter().position(|light| light == signal);
            }
        }
    }

    fn rules(&mut self) {
        for junction in &mut self.junctions {
            if junction.links.len() > MOST_RULED {
                self.unruled.append(&mut junction.lights);
                junction.links.iter_mut().for_each(|link| link.light = None);
            } else {
                junction.rules = rules(&junction.links, &self.lines);
            }
        }
    }

    fn outlines(&mut self) {
        let mut corners: Vec<Vec<Vec2>> = vec![Vec::new(); self.junctions.len()];
        let mut middles: Vec<(Vec2, f64)> = vec![(Vec2::zeros(), 0.0); self.junctions.len()];
        for edge in &self.edges {
            for lane in &edge.lanes {
                let line = &self.lines[*lane];
                let half_m = self.map.lanes[*lane].width_or_assumed_m() / 2.0;
                for (junction, last) in [(edge.from, false), (edge.to, true)] {
                    let Some(end) = (if last { line.last() } else { line.first() }) else { continue };
                    let across = direction(heading(line, last) + std::f64::consts::FRAC_PI_2) * half_m;
                    corners[junction].extend([end + across, end - across]);
                    middles[junction].0 += end;
                    middles[junction].1 += 1.0;
                }
            }
        }
        for ((junction, points), (sum, count)) in self.junctions.iter_mut().zip(corners).zip(middles) {
            junction.middle = sum / f64::max(count, 1.0);
            junction.outline = hull(points);
        }
    }
}

/// The convex hull of points, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<Vec2>) -> Vec<Vec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = &Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && scene::geometry::cross(b - a, p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut ring = chain(&mut points.iter());
    ring.extend(chain(&mut points.iter().rev()));
    ring
}

/// Groups of lanes that are parallel from end to end, each from the right.
fn abreast(
    map: &LaneMap,
    lines: &[Vec<Vec2>],
    joints: &Joints,
    stands: impl Fn(usize) -> bool,
) -> Vec<Vec<usize>> {
    let places: HashMap<&str, usize> =
        map.lanes.iter().enumerate().map(|(i, lane)| (lane.id.as_str(), i)).collect();
    let mut left: HashMap<usize, usize> = HashMap::new();
    let mut is_left: BTreeSet<usize> = BTreeSet::new();
    for (i, lane) in map.lanes.iter().enumerate().filter(|(i, _)| stands(*i)) {
        let whole = |(from, to): (usize, usize), lane: &Lane| from <= 1 && to + 2 >= lane.points.xy.len();
        let found = lane.left_neighbors.iter().find_map(|beside| {
            let other = *places.get(beside.lane.as_str()).filter(|other| **other != i)?;
            let its = &map.lanes[other];
            let fits = stands(other)
                && !is_left.contains(&other)
                && whole(beside.own_range, lane)
                && whole(beside.other_range, its)
                && is_motorway(lane) == is_motorway(its)
                && !joints.links.contains(&(i, other))
                && !joints.links.contains(&(other, i))
                && are_beside([lane, its], [&lines[i], &lines[other]]);
            fits.then_some(other)
        });
        if let Some(other) = found {
            left.insert(i, other);
            is_left.insert(other);
        }
    }
    let mut taken = vec![false; map.lanes.len()];
    let mut lists = Vec::new();
    // A cycle of lanes, each to the left of the previous one, may begin with any of them.
    let first = (0..map.lanes.len()).filter(|i| !is_left.contains(i));
    for start in first.chain(0..map.lanes.len()).filter(|i| stands(*i)) {
        let (mut list, mut next) = (Vec::new(), Some(start));
        while let Some(lane) = next.filter(|lane| !taken[*lane]) {
            taken[lane] = true;
            list.push(lane);
            next = left.get(&lane).copied();
        }
        if !list.is_empty() {
            lists.push(list);
        }
    }
    lists
}

pub(super) fn is_motorway(lane: &Lane) -> bool {
    lane.lane_type == LaneType::Freeway
}

/// Whether both ends of the second lane lie beside those of the first, to the left.
fn are_beside(lanes: [&Lane; 2], lines: [&[Vec2]; 2]) -> bool {
    let [a, b] = lines;
    let wide_m = (lanes[0].width_or_assumed_m() + lanes[1].width_or_assumed_m()) / 2.0;
    [false, true].into_iter().all(|last| {
        let ends = [a, b].map(|line| if last { line.last() } else { line.first() });
        let [Some(own), Some(other)] = ends else { return false };
        let offset = scene::geometry::rotate(other - own, -heading(a, last));
        offset.x.abs() < ALIGNED_M && (offset.y - wide_m).abs() < APART_M
    })
}
