//! Traffic lights and stop signs along the roads of a network.

use super::lanes::Found;
use super::objects;
use super::places::RoadLight;
use super::sections::NetworkFrame;
use crate::lights::{SignalHead, heading_at};
use scene::map::{LaneMap, StopSign};
use scene::{Vec2, geometry::polyline::Polyline};
use std::collections::HashMap;
use xodr::{ControllerId, LaneId, Provenance, RoadNetwork, Signal, SignalId};

/// Type of a stop line in the German catalogue, which the catalogue of OpenDRIVE follows.
pub(super) const STOP_LINE: &str = "294";
/// Types of traffic lights for vehicles and cyclists in the generic catalogue of OpenDRIVE, without the part
/// after a dash.
const LIGHTS: [&str; 8] =
    ["1000001", "1000009", "1000010", "1000011", "1000012", "1000013", "1000014", "1000020"];
/// Type of a pedestrian light.
const WALKERS: &str = "1000002";
/// Types of stop signs: German, Vienna convention, US.
const STOP_SIGNS: [&str; 3] = ["206", "B2a", "R1-1"];
/// A painted line within this distance along the lane from a signal head is its stop line, metres.
const LINE_REACH_M: f64 = 25.0;
/// Greatest distance of a stop line from its lane, metres.
const LINE_WIDTH_M: f64 = 2.5;

/// Whether a signal of this type is a traffic light.
pub(super) fn is_light(kind: Option<&str>) -> bool {
    kind.is_some_and(|kind| LIGHTS.contains(&kind) || kind == WALKERS)
}

/// Whether a signal of this type or name is a stop sign.
pub(super) fn is_stop_sign(kind: Option<&str>, name: Option<&str>) -> bool {
    let named = |name: &str| {
        let letters: String = name.chars().filter(char::is_ascii_alphabetic).collect();
        letters.eq_ignore_ascii_case("stop") || letters.eq_ignore_ascii_case("stopsign")
    };
    kind.is_some_and(|kind| STOP_SIGNS.contains(&kind)) || name.is_some_and(named)
}

/// Signals and stop signs of a map.
#[derive(Debug, Default)]
pub(super) struct LaneControls {
    pub heads: Vec<SignalHead>,
    /// All traffic lights of lanes, with their ids in the file.
    pub lights: Vec<RoadLight>,
    pub signs: Vec<StopSign>,
    /// Number of traffic lights that control no lane of the map.
    pub unused: usize,
}

/// Finds signal heads and stop signs.
pub(super) fn find(
    network: &RoadNetwork,
    provenance: &Provenance,
    frame: &NetworkFrame,
    found: &Found,
    map: &LaneMap,
    mut id: impl FnMut() -> String,
) -> LaneControls {
    let paths: Vec<Polyline> =
        map.lanes.iter().map(|lane| Polyline::new(lane.points.xy.iter().copied())).collect();
    let lines = stop_lines(network, frame, found, &paths);
    let order = controllers(provenance);
    let junctions = junctions(network);
    let names: HashMap<SignalId, &str> =
        provenance.signals.iter().map(|written| (written.signal, written.od_id.as_str())).collect();
    let mut ruled = LaneControls::default();
    let mut taken = vec![false; map.lanes.len()];
    for signal in network.signals().iter().filter(|signal| !signal.invalidated) {
        let lanes = lanes_of(signal, found, map);
        if is_stop_sign(Some(&signal.kind), Some(&signal.name)) {
            let lanes: Vec<String> = lanes.iter().map(|(_, i)| map.lanes[*i].id.clone()).collect();
            if !lanes.is_empty() {
                let position = frame.point(signal.position);
                ruled.signs.push(StopSign { id: id(), position, z_m: None, lanes });
            }
            continue;
        }
        if signal.kind == STOP_LINE || !(signal.dynamic || is_light(Some(&signal.kind))) {
            continue;
        }
        ruled.unused += usize::from(lanes.is_empty());
        for (origin, lane) in lanes {
            if signal.kind == WALKERS {
                continue;
            }
            let path = &paths[lane];
            let stop = stop(signal, frame, path, map.lanes[lane].interpolating, lines.get(&lane));
            let name = names.get(&signal.id).copied().unwrap_or_default().to_owned();
            ruled.lights.push(RoadLight { id: name, lane: map.lanes[lane].id.clone(), stop });
            if std::mem::replace(&mut taken[lane], true) {
                continue;
            }
            let junction =
                junctions.get(&origin).cloned().unwrap_or_else(|| format!("lane {}", map.lanes[lane].id));
            let group = signal.controllers.iter().find_map(|c| order.get(c)).cloned();
            let heading_rad = heading_at(&map.lanes[lane].points.xy, stop);
            ruled.heads.push(SignalHead { lane, stop, heading_rad, junction, group });
        }
    }
    ruled
}

/// Lanes of the map that a signal controls, with those of the network.
fn lanes_of(signal: &Signal, found: &Found, map: &LaneMap) -> Vec<(LaneId, usize)> {
    let drawn =
        signal.lanes.iter().flat_map(|id| found.get(id).into_iter().flatten().map(|drawn| (*id, drawn.lane)));
    let ruled = |(_, i): &(LaneId, usize)| {
        let kind = map.lanes[*i].lane_type;
        kind.carries_vehicles() || kind.carries_cyclists()
    };
    drawn.filter(ruled).collect()
}

/// Stop position of a lane: its painted stop line, else the position of the signal. A signal for a connecting
/// road stops traffic at the road's beginning.
fn stop(
    signal: &Signal,
    frame: &NetworkFrame,
    path: &Polyline,
    through: bool,
    lines: Option<&Vec<f64>>,
) -> Vec2 {
    if through {
        return path.first().position;
    }
    let points = signal.applies_at.iter().map(|p| path.project(frame.point(*p)));
    let foot = points.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m)).map_or(0.0, |foot| foot.s_m);
    let near = lines.into_iter().flatten().filter(|s| (**s - foot).abs() < LINE_REACH_M);
    let line = near.min_by(|a, b| (**a - foot).abs().total_cmp(&(**b - foot).abs()));
    path.position_at(*line.unwrap_or(&foot))
}

/// Arc lengths of the painted stop lines by lane index, metres.
fn stop_lines(
    network: &RoadNetwork,
    frame: &NetworkFrame,
    found: &Found,
    paths: &[Polyline],
) -> HashMap<usize, Vec<f64>> {
    let mut lines: HashMap<usize, Vec<f64>> = HashMap::new();
    let signs = network.signals().iter().filter(|signal| signal.kind == STOP_LINE);
    let signs = signs.flat_map(|signal| {
        signal.applies_at.iter().map(|p| (frame.point(*p), signal.lanes.as_slice(), f64::INFINITY))
    });
    let painted = objects::stop_lines(network, frame).map(|(p, lanes)| (p, lanes, LINE_WIDTH_M));
    for (point, lanes, reach_m) in signs.chain(painted) {
        for drawn in lanes.iter().filter_map(|id| found.get(id)).flatten() {
            let foot = paths[drawn.lane].project(point);
            if foot.distance_m < reach_m {
                lines.entry(drawn.lane).or_default().push(foot.s_m);
            }
        }
    }
    lines
}

/// Position of each controller in the cycle of its junction.
fn controllers(provenance: &Provenance) -> HashMap<ControllerId, (u32, String)> {
    let place = |c: &xodr::ControllerProvenance| {
        let sequence = c.junctions.iter().filter_map(|j| j.sequence).min().unwrap_or(0);
        (c.controller, (sequence, c.od_id.clone()))
    };
    provenance.controllers.iter().map(place).collect()
}

/// The junction that a lane crosses, otherwise the one to which it leads.
fn junctions(network: &RoadNetwork) -> HashMap<LaneId, String> {
    let of = |id: LaneId| network.road(network.road_lane(id)?.road)?.junction().map(str::to_owned);
    let mut found: HashMap<LaneId, String> = HashMap::new();
    for lane in network.lanes() {
        let ahead = || lane.successors.iter().find_map(|next| of(*next));
        if let Some(junction) = of(lane.id).or_else(ahead) {
            found.insert(lane.id, junction);
        }
    }
    found
}
