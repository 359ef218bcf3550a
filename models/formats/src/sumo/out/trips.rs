//! Routes of road users in a network (`rou.xml`), for SUMO to drive with its own models: types, departures,
//! edges.

use super::net::limit_mps;
use super::network::{ExportedNetwork, LaneRole};
use super::recording::ExportedAgent;
use crate::markup::{Markup, decimal};
use crate::written::{BoundedFile, FileBounds};
use scene::geometry::wrap_angle;
use scene::routes::{LaneGraph, LaneHit};
use scene::{AgentType, STEP_S, Scene, State};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::io;

/// Lanes farther from a road user than this are not its own, metres.
const NEAR_M: f64 = 4.0;
/// Lanes at a greater angle to its heading are not its own, radians.
const ALONG_RAD: f64 = 1.0;
/// Penalty, as a distance, for a lane adjacent to the lane of the previous step, and for any other lane,
/// metres.
const CHANGED_M: (f64, f64) = (0.7, 2.0);
/// Most edges between two edges on which the road user is seen.
const MOST_BETWEEN: usize = 6;
/// Default maximum speed of a type, m/s; raised if the road user is seen faster: motor vehicles, others.
const FASTEST_MPS: (f64, f64) = (50.0, 14.0);

/// A road user's departure and route.
struct Trip<'a> {
    user: &'a ExportedAgent<'a>,
    depart: usize,
    /// Arc length of SUMO's reference point along the lane, metres.
    at_m: f64,
    lane: usize,
    state: State,
    edges: Vec<usize>,
}

/// Writes the trips. Returns the number of road users without one.
pub(super) fn write(
    scene: &Scene,
    network: &ExportedNetwork<'_>,
    written: &[ExportedAgent<'_>],
    bounds: FileBounds,
) -> io::Result<(BoundedFile, usize)> {
    let Some(graph) = LaneGraph::unless(&scene.map, &|| bounds.check(0).is_err()) else {
        return Err(io::ErrorKind::ConnectionAborted.into());
    };
    let ways = Ways::of(network);
    let mut trips: Vec<Trip<'_>> =
        written.iter().filter_map(|user| trip(network, &graph, &ways, user)).collect();
    // SUMO requires trips in order of departure.
    trips.sort_by_key(|trip| trip.depart);
    let mut out = Markup::new(bounds);
    out.open("routes", &[]);
    types(&trips, &mut out);
    for trip in &trips {
        write_trip(network, trip, &mut out);
    }
    out.close();
    Ok((out.finish()?, written.len() - trips.len()))
}

fn types(trips: &[Trip<'_>], out: &mut Markup) {
    let mut fastest: BTreeMap<&str, (f64, &Trip<'_>)> = BTreeMap::new();
    for trip in trips {
        let usual =
            if trip.user.shown.agent_type == AgentType::Vehicle { FASTEST_MPS.0 } else { FASTEST_MPS.1 };
        let entry = fastest.entry(&trip.user.kind.id).or_insert((usual, trip));
        entry.0 = entry.0.max(trip.state.speed_mps() + 1.0);
    }
    for (id, (speed_mps, trip)) in fastest {
        let (kind, size) = (&trip.user.kind, trip.user.shown.size);
        let (length, width, speed) = (decimal(size.length_m), decimal(size.width_m), decimal(speed_mps));
        let height = size.height_m.map(decimal);
        let mut attributes =
            vec![("id", id), ("vClass", kind.class), ("length", &*length), ("width", &*width)];
        attributes.extend(height.as_deref().map(|height| ("height", height)));
        if !kind.person {
            attributes.push(("maxSpeed", &*speed));
        }
        out.empty("vType", &attributes);
    }
}

fn write_trip(network: &ExportedNetwork<'_>, trip: &Trip<'_>, out: &mut Markup) {
    let Some((_, index)) = network.place(trip.lane) else { return };
    let ids: Vec<&str> = trip.edges.iter().map(|edge| network.edges[*edge].id.as_str()).collect();
    let edges = ids.join(" ");
    let (depart, at) = (decimal(trip.depart as f64 * STEP_S), decimal(trip.at_m));
    let (id, kind) = (&*trip.user.name, &*trip.user.kind.id);
    if trip.user.kind.person {
        out.open("person", &[("id", id), ("type", kind), ("depart", &depart), ("departPos", &at)]);
        out.empty("walk", &[("edges", &edges)]);
        out.close();
        return;
    }
    let speed_mps = trip.state.speed_mps();
    let (lane, speed) = (index.to_string(), decimal(speed_mps));
    // SUMO refuses a departure speed above the limit times the speed factor.
    let factor = (speed_mps / limit_mps(&network.map.lanes[trip.lane]).max(0.1) * 1.01).max(1.0);
    let factor = decimal(factor);
    out.open(
        "vehicle",
        &[
            ("id", id),
            ("type", kind),
            ("depart", &depart),
            ("departLane", &lane),
            ("departPos", &at),
            ("departSpeed", &speed),
            ("speedFactor", &factor),
            // Vehicles start at their recorded states, even at a red signal or close to each other.
            ("insertionChecks", "none"),
        ],
    );
    out.empty("route", &[("edges", &edges)]);
    out.close();
}

/// The trip of a road user; `None` if it is on no edge.
fn trip<'a>(
    network: &ExportedNetwork<'_>,
    graph: &LaneGraph,
    ways: &Ways,
    user: &'a ExportedAgent<'a>,
) -> Option<Trip<'a>> {
    let track = &user.shown.track;
    let mut first = None;
    let mut edges: Vec<usize> = Vec::new();
    let mut before = None;
    for step in track.valid_steps() {
        let Some(state) = track.at(step) else { continue };
        let Some(hit) = lane_of(network, graph, user, state, before) else { continue };
        before = Some(hit.lane);
        let Some(LaneRole::On { edge, .. }) = network.roles.get(hit.lane) else { continue };
        first.get_or_insert((step, hit, *state));
        if edges.last() == Some(edge) {
            continue;
        }
        match edges.last() {
            None => edges.push(*edge),
            // Pedestrians get only their first sidewalk: SUMO chooses the path to the next.
            Some(_) if user.kind.person => break,
            Some(last) => match ways.between(*last, *edge) {
                Some(more) => edges.extend(more),
                None => break,
            },
        }
    }
    let (depart, hit, state) = first?;
    let length_m = crate::polyline::length(&network.lines[hit.lane]);
    let at_m = (hit.s_m + user.ahead_m()).clamp(0.0, length_m);
    Some(Trip { user, depart, at_m, lane: hit.lane, state, edges })
}

fn lane_of(
    network: &ExportedNetwork<'_>,
    graph: &LaneGraph,
    user: &ExportedAgent<'_>,
    state: &State,
    before: Option<usize>,
) -> Option<LaneHit> {
    let on_foot = user.kind.person;
    let along = |hit: &LaneHit| on_foot || wrap_angle(hit.heading_rad - state.heading_rad).abs() < ALONG_RAD;
    let away_m = |hit: &LaneHit| {
        let Some(before) = before.filter(|before| *before != hit.lane) else { return hit.distance_m };
        let lane = &graph.lanes()[before];
        let further_m = match () {
            () if lane.successors.contains(&hit.lane) => 0.0,
            () if lane.beside().any(|beside| beside.lane == hit.lane) => CHANGED_M.0,
            () => CHANGED_M.1,
        };
        hit.distance_m + further_m
    };
    let hits = graph.nearest_for(state.position(), NEAR_M, user.shown.agent_type);
    let written = |hit: &LaneHit| network.roles.get(hit.lane).is_some_and(|role| *role != LaneRole::Lost);
    hits.into_iter().filter(|hit| written(hit) && along(hit)).min_by(|a, b| away_m(a).total_cmp(&away_m(b)))
}

/// The edges that follow each edge.
struct Ways(BTreeMap<usize, BTreeSet<usize>>);

impl Ways {
    fn of(network: &ExportedNetwork<'_>) -> Self {
        let mut ways: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        let edge = |lane: usize| match network.roles.get(lane) {
            Some(LaneRole::On { edge, .. }) => Some(*edge),
            _ => None,
        };
        for link in network.junctions.iter().flat_map(|junction| &junction.links) {
            if let (Some(from), Some(to)) = (edge(link.from), edge(link.to)) {
                ways.entry(from).or_default().insert(to);
            }
        }
        Self(ways)
    }

    /// The shortest sequence of edges, by number, after one edge and up to another.
    fn between(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let mut came: BTreeMap<usize, usize> = BTreeMap::new();
        let mut open = VecDeque::from([(from, 0)]);
        while let Some((edge, steps)) = open.pop_front() {
            for next in self.0.get(&edge).into_iter().flatten() {
                if came.contains_key(next) {
                    continue;
                }
                came.insert(*next, edge);
                if *next == to {
                    let mut way = vec![to];
                    let mut at = edge;
                    while at != from {
                        way.push(at);
                        at = *came.get(&at)?;
                    }
                    way.reverse();
                    return Some(way);
                }
                if steps < MOST_BETWEEN {
                    open.push_back((*next, steps + 1));
                }
            }
        }
        None
    }
}
