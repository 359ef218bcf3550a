//! Converts lanes of a network to lanes of a map: their use, and their links.

use super::sections::{MAX_PIECES, Section, SectionLane, dense};
use super::short::Links;
use crate::map_file;
use scene::Vec2;
use scene::map::{Lane, LaneMap, LaneType, Neighbor, Points};
use std::collections::{HashMap, HashSet};
use xodr::{Direction, LaneId, LaneType as Kind, RoadNetwork, RoadType, SpeedLimit};

/// Distance of lane points, metres.
const SPACING_M: f64 = 1.0;
/// Lanes that are narrower everywhere are left out, metres.
const NARROWEST_M: f64 = 0.5;
/// A two-way lane and the next one are linked in the direction in which their ends meet within this distance,
/// metres.
const MEETING_M: f64 = 2.0;
/// Width at which lanes that open or close beside another begin and end, metres.
const OPEN_M: f64 = 2.0;
/// Border lanes up to this width are the paved edge of the road, metres; wider ones lie beside it.
const PAVED_BORDER_M: f64 = 2.0;

/// A lane of the map that comes from a lane of the network.
#[derive(Clone, Debug)]
pub(super) struct NetworkLane {
    /// Index in [`LaneMap::lanes`].
    pub lane: usize,
    /// Whether it runs in the direction of the road.
    pub forward: bool,
    /// Position of each point among the points of the section's lane.
    pub places: Vec<f64>,
}

/// Lanes of the map by lane of the network; a two-way lane gives two.
pub(super) type Found = HashMap<LaneId, Vec<NetworkLane>>;

/// Type of a lane in a scene; `None` if it carries no road users.
fn lane_type(lane: &SectionLane, motorway: bool) -> Option<LaneType> {
    if lane.widest_m() < NARROWEST_M {
        return None;
    }
    let street = if motorway { LaneType::Freeway } else { LaneType::SurfaceStreet };
    match lane.kind {
        Kind::Driving | Kind::Hov | Kind::Entry | Kind::Exit | Kind::OnRamp | Kind::OffRamp => Some(street),
        Kind::ConnectingRamp | Kind::SlipLane | Kind::Bidirectional | Kind::Shared => Some(street),
        Kind::Bus | Kind::Taxi => Some(LaneType::BusLane),
        Kind::Biking => Some(LaneType::BikeLane),
        Kind::Sidewalk => Some(LaneType::Sidewalk),
        Kind::Parking => Some(LaneType::Parking),
        _ => None,
    }
}

/// Whether vehicles drive on the lane.
pub(super) fn carries_vehicles(lane: &SectionLane) -> bool {
    lane_type(lane, false).is_some_and(LaneType::carries_vehicles)
}

/// Whether it is part of the carriageway: cars can reach it from a traffic lane without a kerb.
pub(super) fn is_road(section: &Section, at: usize) -> bool {
    let lane = &section.lanes[at];
    if lane.raised || lane.widest_m() < 0.01 {
        return false;
    }
    match lane.kind {
        Kind::Border => {
            let traffic = |lanes: &[SectionLane]| lanes.iter().any(carries_vehicles);
            let between = traffic(&section.lanes[..at]) && traffic(&section.lanes[at + 1..]);
            lane.widest_m() <= if between { NARROWEST_M } else { PAVED_BORDER_M }
        }
        Kind::Shoulder | Kind::Stop | Kind::Restricted | Kind::RoadWorks | Kind::Tram => true,
        _ => lane_type(lane, false).is_some_and(|kind| kind != LaneType::Sidewalk),
    }
}

/// Draws the lanes of all sections, with their links and neighbours.
pub(super) fn draw(network: &RoadNetwork, sections: &[Section], links: &Links, map: &mut LaneMap) -> Found {
    let mut found = Found::new();
    let mut ids = HashSet::new();
    for section in sections {
        let interpolating = section.junction.is_some();
        for lane in &section.lanes {
            let middle = network.lane(lane.id).map_or(0.0, |lane| lane.center.length() / 2.0);
            let motorway = network.road_type_at(lane.id, middle) == Some(RoadType::Motorway);
            let Some(lane_type) = lane_type(lane, motorway) else { continue };
            let limit = match network.speed_limit_at(lane.id, middle) {
                Some(SpeedLimit::Max(speed)) => Some(told(f64::from(speed)).clamp(0.0, 100.0)),
                _ => None,
            };
            let both: &[bool] = match lane.direction {
                Direction::Forward => &[true],
                Direction::Backward => &[false],
                Direction::Both => &[true, false],
            };
            for &forward in both {
                let (points, places) = points(lane, forward, linked(network, lane));
                let width_m = lane.mean_width_over(&places);
                let drawn = NetworkLane { lane: map.lanes.len(), forward, places };
                map.lanes.push(Lane {
                    lane_type,
                    width_m: Some(told(width_m).clamp(0.1, 50.0)),
                    speed_limit_mps: limit.filter(|_| lane_type != LaneType::Sidewalk),
                    // On a motorway, ramps join and leave without crossing traffic.
                    interpolating: interpolating && lane_type != LaneType::Freeway,
                    ..Lane::street(id_of(section, lane, forward, &mut ids), points)
                });
                found.entry(lane.id).or_default().push(drawn);
            }
        }
        beside(section, &found, map);
    }
    link(network, &found, map);
    link_stated(sections, links, &found, map);
    found
}

/// An id such as `12.0.-1`: road, section and lane, and [`map_file::AGAINST`] for the opposite direction of a
/// two-way lane.
fn id_of(section: &Section, lane: &SectionLane, forward: bool, ids: &mut HashSet<String>) -> String {
    let legal = |c: char| if c.is_ascii_alphanumeric() || "_.:-".contains(c) { c } else { '_' };
    let road: String = section.road.chars().take(36).map(legal).collect();
    let against = if !forward && lane.direction == Direction::Both { map_file::AGAINST } else { "" };
    let mut id = format!("{road}.{}.{}{against}", section.number, lane.number);
    while !ids.insert(id.clone()) {
        id.push('_');
    }
    id
}

/// Rounds to the precision of the network's single-precision numbers.
fn told(v: f64) -> f64 {
    (v * 1e4).round() / 1e4
}

/// Whether a lane is linked at its beginning and at its end along the road.
fn linked(network: &RoadNetwork, lane: &SectionLane) -> [bool; 2] {
    let Some(found) = network.lane(lane.id) else { return [true; 2] };
    let (before, after) = (!found.predecessors.is_empty(), !found.successors.is_empty());
    match lane.direction {
        Direction::Forward => [before, after],
        Direction::Backward => [after, before],
        Direction::Both => [true; 2],
    }
}

/// Points of a lane, and their positions among those of the section. An end without a link begins where the
/// lane is wide enough for use. `linked` refers to both ends.
fn points(lane: &SectionLane, forward: bool, linked: [bool; 2]) -> (Points, Vec<f64>) {
    let length_m = crate::polyline::length(&lane.center);
    let mut line = dense(&lane.center, &lane.tangents, SPACING_M.max(length_m / MAX_PIECES as f64));
    let width = |&(_, i, share): &(Vec2, usize, f64)| {
        let at = |k: usize| lane.widths_m.get(k).copied().unwrap_or_default();
        at(i) + (at(i + 1) - at(i)) * share
    };
    let wide = |place: &(Vec2, usize, f64)| width(place) >= OPEN_M.min(0.8 * lane.widest_m());
    let first = if linked[0] { 0 } else { line.iter().position(wide).unwrap_or(0) };
    let last = if linked[1] { None } else { line.iter().rposition(wide) }.unwrap_or(line.len() - 1);
    if last > first {
        line.truncate(last + 1);
        line.drain(..first);
    }
    if !forward {
        line.reverse();
    }
    let height = |&(_, i, share): &(Vec2, usize, f64)| {
        let at = |k: usize| lane.z_m.get(k).copied().unwrap_or_default();
        told(at(i) + (at(i + 1) - at(i)) * share)
    };
    let high = lane.z_m.iter().any(|z| *z != 0.0);
    let z_m = high.then(|| line.iter().map(height).collect());
    let places = line.iter().map(|(_, i, share)| *i as f64 + share).collect();
    (Points { xy: line.into_iter().map(|(p, ..)| p.map(told)).collect(), z_m }, places)
}

/// Links adjacent lanes of a section with the same direction.
fn beside(section: &Section, found: &Found, map: &mut LaneMap) {
    if section.junction.is_some() {
        return;
    }
    for pair in section.lanes.windows(2) {
        let [Some(right), Some(left)] = [&pair[0], &pair[1]].map(|lane| found.get(&lane.id)) else {
            continue;
        };
        for (a, b) in right.iter().flat_map(|a| left.iter().map(move |b| (a, b))) {
            let travelled = |drawn: &NetworkLane| {
                let kind = map.lanes[drawn.lane].lane_type;
                kind.carries_vehicles() || kind.carries_cyclists()
            };
            if a.forward != b.forward || !travelled(a) || !travelled(b) {
                continue;
            }
            let (on_left, on_right) = if a.forward { (b, a) } else { (a, b) };
            let (Some(left_range), Some(right_range)) =
                (common(on_left, on_right), common(on_right, on_left))
            else {
                continue;
            };
            let neighbor = |other: &NetworkLane, own_range, other_range| Neighbor {
                lane: map.lanes[other.lane].id.clone(),
                own_range,
                other_range,
                boundaries: Vec::new(),
            };
            let left_one = neighbor(on_left, right_range, left_range);
            let right_one = neighbor(on_right, left_range, right_range);
            map.lanes[on_right.lane].left_neighbors.push(left_one);
            map.lanes[on_left.lane].right_neighbors.push(right_one);
        }
    }
}

/// First and last point of a lane with another one beside it.
fn common(own: &NetworkLane, other: &NetworkLane) -> Option<(usize, usize)> {
    let ends = [other.places.first()?, other.places.last()?];
    let (low, high) = (ends[0].min(*ends[1]) - 1e-6, ends[0].max(*ends[1]) + 1e-6);
    let mut within = own.places.iter().enumerate().filter(|(_, place)| **place >= low && **place <= high);
    let first = within.next()?.0;
    Some((first, within.next_back()?.0))
}

/// Links of the network, between the lanes that the map has.
fn link(network: &RoadNetwork, found: &Found, map: &mut LaneMap) {
    let mut links = HashSet::new();
    for (lane, drawn) in network.lanes().iter().filter_map(|lane| Some((lane, found.get(&lane.id)?))) {
        for next in lane.successors.iter().filter_map(|next| found.get(next)) {
            // Only for two-way lanes, the direction of the continuation must be found.
            let sure = drawn.len() == 1 && next.len() == 1;
            // Pavements have no direction: a link of two that begin or end together is for pedestrians.
            let walked = |list: &[NetworkLane]| {
                list.iter().all(|drawn| map.lanes[drawn.lane].lane_type == LaneType::Sidewalk)
            };
            let sure = sure && !(walked(drawn) && walked(next));
            for (from, to) in drawn.iter().flat_map(|from| next.iter().map(move |to| (from.lane, to.lane))) {
                let ends = [map.lanes[from].points.xy.last(), map.lanes[to].points.xy.first()];
                let meet = matches!(ends, [Some(end), Some(start)] if (end - start).norm() < MEETING_M);
                // A lane is linked to itself if it closes a ring.
                let sure = sure && from != to;
                if (sure || meet) && links.insert((from, to)) {
                    let [before, after] = [from, to].map(|i| map.lanes[i].id.clone());
                    map.lanes[from].successors.push(after);
                    map.lanes[to].predecessors.push(before);
                }
            }
        }
    }
}

/// Adds links that the file has on one side only, if the lanes meet. The crate reads a `<laneLink>` only as
/// the way into the junction, and a lane's link only as the way out of that lane. Both apply in both
/// directions, and some files name the wrong end of a road.
fn link_stated(sections: &[Section], links: &Links, found: &Found, map: &mut LaneMap) {
    // Lanes of all sections by road, section and number, and of those at both ends of each road by road and number.
    let mut within: HashMap<(&str, usize, i32), LaneId> = HashMap::new();
    let mut ends: HashMap<(&str, i32), Vec<LaneId>> = HashMap::new();
    let is_end = |i: usize| {
        let road = |i: usize| sections.get(i).map(|section| section.road.as_str());
        road(i) != i.checked_sub(1).and_then(road) || road(i) != road(i + 1)
    };
    for (i, section) in sections.iter().enumerate() {
        for lane in &section.lanes {
            within.insert((section.road.as_str(), section.number, lane.number), lane.id);
            if is_end(i) {
                ends.entry((section.road.as_str(), lane.number)).or_default().push(lane.id);
            }
        }
    }
    let at_ends = links.stated().into_iter().map(|pair| {
        let of = |end| ends.get(&end).map_or(&[][..], Vec::as_slice);
        [of(pair.0), of(pair.1)]
    });
    let inside = links.stated_within().into_iter().map(|(road, pair)| {
        pair.map(|(section, lane)| within.get(&(road, section, lane)).map_or(&[][..], std::slice::from_ref))
    });
    for pair in at_ends.chain(inside) {
        let [one, other] = pair.map(|ids| -> Vec<usize> {
            ids.iter().filter_map(|id| found.get(id)).flatten().map(|drawn| drawn.lane).collect()
        });
        let both = one.iter().flat_map(|a| other.iter().flat_map(move |b| [(*a, *b), (*b, *a)]));
        for (from, to) in both {
            let open = map.lanes[from].successors.is_empty() || map.lanes[to].predecessors.is_empty();
            let walked = [from, to].iter().all(|lane| map.lanes[*lane].lane_type == LaneType::Sidewalk);
            if from != to && open && !walked && leads_on(map, from, to) {
                let [before, after] = [from, to].map(|i| map.lanes[i].id.clone());
                map.lanes[from].successors.push(after);
                map.lanes[to].predecessors.push(before);
            }
        }
    }
}

/// Whether a lane begins at the end of another one, in about the same direction.
fn leads_on(map: &LaneMap, from: usize, to: usize) -> bool {
    let ([.., before, end], [start, after, ..]) =
        (&map.lanes[from].points.xy[..], &map.lanes[to].points.xy[..])
    else {
        return false;
    };
    (start - end).norm() < MEETING_M && (end - before).dot(&(after - start)) > 0.0
}
