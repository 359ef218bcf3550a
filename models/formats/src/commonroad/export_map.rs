//! Writes a lane map as lanelets, signs and traffic lights.

use super::words::{INTERSECTION, color, lane_word, marking};
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::numbers::Numbers;
use crate::polyline::offset_right;
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, StopSign};
use scene::{Scene, Signal, Vec2};
use std::collections::{BTreeSet, HashMap};
use std::io;

/// Half the length of a stop line, as a share of the width of its lane.
const HALF: f64 = 0.5;
/// Marking of a side that is a road edge.
const CURB: &str = "curb";

/// Elements of a scenario that a map is written as.
pub(super) struct MapElements<'a> {
    scene: &'a Scene,
    /// Number of steps for which signals are written.
    steps: usize,
    /// Number and last point.
    lanes: HashMap<&'a str, (i64, usize)>,
    /// Markings of lines and edges.
    markings: HashMap<&'a str, &'static str>,
    crosswalks: Vec<(i64, &'a Area)>,
    /// Signs of lanes with a limit, one for each lane: readers look for the lane at which a sign begins, and
    /// a ring of lanes with the same sign has no such lane.
    limits: HashMap<&'a str, i64>,
    /// Signs at which lanes stop.
    stops: Vec<(i64, &'a StopSign)>,
    lights: Vec<(i64, &'a Signal)>,
    /// Indices into `stops` and `lights` of the signs and traffic lights that a lane obeys.
    obeys: HashMap<&'a str, (Vec<usize>, Vec<usize>)>,
}

impl<'a> MapElements<'a> {
    /// Numbers all elements that are drawn and reports the others as losses; signals cover this many steps.
    pub fn of(scene: &'a Scene, steps: usize, ids: &mut Numbers, losses: &mut BTreeSet<Loss>) -> Self {
        let map = &scene.map;
        let number = |lane: &'a Lane| (lane.id.as_str(), (ids.take(&lane.id), lane.points.xy.len() - 1));
        let lanes: HashMap<&str, (i64, usize)> = map.lanes.iter().map(number).collect();
        let lines = map.road_lines.iter().map(|line| (line.id.as_str(), marking(&line.line_type)));
        let markings = map.road_edges.iter().map(|edge| (edge.id.as_str(), CURB)).chain(lines).collect();
        let areas = map.crosswalks.iter().filter(|area| area.polygon.xy.len() > 2);
        let crosswalks: Vec<_> = areas.map(|area| (ids.take(&area.id), area)).collect();
        let known = |id: &String| lanes.contains_key(id.as_str());
        let signs = map.stop_signs.iter().filter(|sign| sign.lanes.iter().any(known));
        let stops: Vec<_> = signs.map(|sign| (ids.take(&sign.id), sign)).collect();
        let limited = map.lanes.iter().filter(|lane| lane.speed_limit_mps.is_some());
        let limits = limited.map(|lane| (lane.id.as_str(), ids.free())).collect();
        let ruled = scene.signals.iter().filter(|signal| known(&signal.lane));
        let lights: Vec<_> = ruled.map(|signal| (ids.free(), signal)).collect();
        let mut obeys: HashMap<&str, (Vec<usize>, Vec<usize>)> = HashMap::new();
        for (i, (_, sign)) in stops.iter().enumerate() {
            sign.lanes.iter().for_each(|lane| obeys.entry(lane).or_default().0.push(i));
        }
        for (i, (_, signal)) in lights.iter().enumerate() {
            obeys.entry(&signal.lane).or_default().1.push(i);
        }
        let drawn = Self { scene, steps, lanes, markings, crosswalks, limits, stops, lights, obeys };
        drawn.tell(losses);
        drawn
    }

    fn tell(&self, losses: &mut BTreeSet<Loss>) {
        let (scene, map) = (self.scene, &self.scene.map);
        let left_out =
            self.crosswalks.len() < map.crosswalks.len() || self.stops.len() < map.stop_signs.len();
        let bumps = !map.speed_bumps.is_empty() || !map.driveways.is_empty();
        let foreign = scene
            .signals
            .iter()
            .flat_map(|signal| &signal.runs)
            .any(|(_, state)| super::words::signal_state(color(*state)) != Some(*state));
        let heights = map.lanes.iter().any(|lane| lane.points.z_m.is_some())
            || map.crosswalks.iter().any(|area| area.polygon.z_m.is_some())
            || scene.signals.iter().any(|signal| signal.stop_z_m.is_some())
            || map.stop_signs.iter().any(|sign| sign.z_m.is_some())
            || scene.agents.iter().any(|agent| agent.track.z_m.is_some())
            || scene.meta.origin.z_m != 0.0;
        let beside = |lane: &Lane| {
            [&lane.left_neighbors, &lane.right_neighbors].into_iter().any(|list| {
                list.len() > 1 || list.first().is_some_and(|neighbor| !self.is_whole(lane, neighbor))
            })
        };
        let sides =
            map.lanes.iter().any(|lane| !lane.left_boundary.is_empty() || !lane.right_boundary.is_empty());
        let lines = !map.road_lines.is_empty() || !map.road_edges.is_empty() || sides;
        let unknown = |lane: &Lane| {
            lane.successors.iter().chain(&lane.predecessors).any(|id| !self.lanes.contains_key(id.as_str()))
        };
        let all = [
            (
                left_out || bumps,
                code::NO_AREAS,
                "speed bumps, driveways, crosswalks without an area, signs of no lane",
            ),
            (!map.drivable.is_empty(), code::NO_DRIVABLE, "drivable areas"),
            (lines, code::NO_LINES, "painted lines and road edges; sides of lanes say how they are marked"),
            (heights, code::NO_Z, "heights"),
            (
                map.lanes.iter().any(beside),
                code::NO_NEIGHBORS,
                "lanes beside others over a part of their length",
            ),
            (map.lanes.iter().any(unknown), code::NO_MAP, "links to lanes that are not in the map"),
            (
                map.lanes.iter().any(|l| l.width_m.is_none()),
                code::NO_LANE_WIDTH,
                "lanes without a width get that of their type",
            ),
            (self.lights.len() < scene.signals.len(), code::NO_SIGNALS, "signals of no lane"),
            (foreign, code::NO_SIGNAL_STATES, "arrows and flashing lights become plain colours"),
        ];
        losses.extend(
            all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)),
        );
    }

    /// Whether a neighbour lies beside the whole length of a lane.
    fn is_whole(&self, lane: &Lane, neighbor: &Neighbor) -> bool {
        let Some((_, last)) = self.lanes.get(neighbor.lane.as_str()) else { return false };
        let covers = |range: (usize, usize), last: usize| range.0 <= last / 8 && range.1 + last / 8 >= last;
        let own = covers(neighbor.own_range, lane.points.xy.len() - 1);
        own && covers(neighbor.other_range, *last) && neighbor.boundaries.is_empty()
    }

    /// Writes lanelets, signs and traffic lights.
    pub fn write(&self, out: &mut Markup) -> io::Result<()> {
        for lane in &self.scene.map.lanes {
            out.check()?;
            self.lane(lane, out);
        }
        for (id, area) in &self.crosswalks {
            crosswalk(*id, area, out);
        }
        for lane in &self.scene.map.lanes {
            let limit = lane.speed_limit_mps.zip(self.limits.get(lane.id.as_str()));
            let Some((limit, id)) = limit else { continue };
            out.open("trafficSign", &[("id", &id.to_string())]);
            out.open("trafficSignElement", &[]);
            out.leaf("trafficSignID", "274");
            out.leaf("additionalValue", limit);
            out.close();
            out.leaf("virtual", true);
            out.close();
        }
        for (id, sign) in &self.stops {
            out.open("trafficSign", &[("id", &id.to_string())]);
            out.open("trafficSignElement", &[]);
            out.leaf("trafficSignID", "206");
            out.close();
            position(sign.position, out);
            out.leaf("virtual", false);
            out.close();
        }
        for (id, signal) in &self.lights {
            light(*id, signal, self.steps, out);
        }
        Ok(())
    }

    fn lane(&self, lane: &Lane, out: &mut Markup) {
        let Some((id, _)) = self.lanes.get(lane.id.as_str()) else { return };
        let points = &lane.points.xy;
        let half_m = lane.width_or_assumed_m() / 2.0;
        out.open("lanelet", &[("id", &id.to_string())]);
        bound("leftBound", &offset_right(points, -half_m), self.marking(&lane.left_boundary), out);
        bound("rightBound", &offset_right(points, half_m), self.marking(&lane.right_boundary), out);
        for (name, list) in [("predecessor", &lane.predecessors), ("successor", &lane.successors)] {
            for (id, _) in list.iter().filter_map(|id| self.lanes.get(id.as_str())) {
                out.empty(name, &[("ref", &id.to_string())]);
            }
        }
        for (name, list) in [("adjacentLeft", &lane.left_neighbors), ("adjacentRight", &lane.right_neighbors)]
        {
            let whole = list.iter().find(|neighbor| self.is_whole(lane, neighbor));
            if let Some((id, _)) = whole.and_then(|neighbor| self.lanes.get(neighbor.lane.as_str())) {
                out.empty(name, &[("ref", &id.to_string()), ("drivingDir", "same")]);
            }
        }
        let obeys = self.obeys.get(lane.id.as_str());
        let lights: Vec<_> = obeys.iter().flat_map(|(_, lights)| lights).map(|i| self.lights[*i]).collect();
        let signs: Vec<i64> = obeys.iter().flat_map(|(signs, _)| signs).map(|i| self.stops[*i].0).collect();
        let stop = lights.iter().find_map(|(_, signal)| signal.stop).or_else(|| {
            // A light without a position on a way through a junction is obeyed where the way begins.
            let end = if lane.interpolating { points.first() } else { points.last() };
            end.copied().filter(|_| !lights.is_empty())
        });
        if let Some(stop) = stop {
            stop_line(stop, points, lane, out);
        }
        out.leaf("laneletType", lane_word(lane.lane_type));
        if lane.interpolating {
            out.leaf("laneletType", INTERSECTION);
        }
        users(lane.lane_type).iter().for_each(|(name, user)| out.leaf(name, user));
        let limit = self.limits.get(lane.id.as_str());
        for id in limit.into_iter().chain(&signs) {
            out.empty("trafficSignRef", &[("ref", &id.to_string())]);
        }
        for (id, _) in lights {
            out.empty("trafficLightRef", &[("ref", &id.to_string())]);
        }
        out.close();
    }

    /// Marking of a side: that of the line that bounds most of it.
    fn marking(&self, boundaries: &[Boundary]) -> Option<&'static str> {
        let longest = boundaries.iter().max_by_key(|boundary| boundary.to.saturating_sub(boundary.from))?;
        self.markings.get(longest.line.as_str()).copied()
    }
}

fn users(lane_type: LaneType) -> &'static [(&'static str, &'static str)] {
    match lane_type {
        LaneType::Sidewalk => &[("userBidirectional", "pedestrian")],
        LaneType::BikeLane => &[("userOneWay", "bicycle")],
        LaneType::BusLane => &[("userOneWay", "bus"), ("userOneWay", "bicycle")],
        LaneType::Freeway => &[("userOneWay", "vehicle")],
        LaneType::Undefined | LaneType::SurfaceStreet => {
            &[("userOneWay", "vehicle"), ("userOneWay", "bicycle")]
        }
        LaneType::Parking => &[],
    }
}

fn point(p: Vec2, out: &mut Markup) {
    out.open("point", &[]);
    out.leaf("x", decimal(p.x));
    out.leaf("y", decimal(p.y));
    out.close();
}

/// A point as a position.
pub(super) fn position(p: Vec2, out: &mut Markup) {
    out.open("position", &[]);
    point(p, out);
    out.close();
}

fn bound(name: &'static str, points: &[Vec2], marking: Option<&str>, out: &mut Markup) {
    out.open(name, &[]);
    points.iter().for_each(|p| point(*p, out));
    if let Some(marking) = marking {
        out.leaf("lineMarking", marking);
    }
    out.close();
}

fn stop_line(stop: Vec2, points: &[Vec2], lane: &Lane, out: &mut Markup) {
    let heading = crate::lights::heading_at(points, stop);
    let across = Vec2::new(-heading.sin(), heading.cos()) * (HALF * lane.width_or_assumed_m());
    out.open("stopLine", &[]);
    point(stop + across, out);
    point(stop - across, out);
    out.leaf("lineMarking", "solid");
    out.close();
}

/// An area as a lanelet along its longer sides.
fn crosswalk(id: i64, area: &Area, out: &mut Markup) {
    let mut ring = area.polygon.xy.clone();
    if let [a, b, c, _] = ring.as_slice()
        && (b - a).norm() < (c - b).norm()
    {
        ring.rotate_left(1);
    }
    let (right, back) = ring.split_at(ring.len().div_ceil(2));
    let mut left: Vec<Vec2> = back.iter().rev().copied().collect();
    left.extend(left.last().copied().filter(|_| left.len() < right.len()));
    out.open("lanelet", &[("id", &id.to_string())]);
    bound("leftBound", &left, None, out);
    bound("rightBound", right, None, out);
    out.leaf("laneletType", "crosswalk");
    out.leaf("userBidirectional", "pedestrian");
    out.close();
}

/// Signal states until the last goal, as a cycle of the same length.
fn light(id: i64, signal: &Signal, steps: usize, out: &mut Markup) {
    out.open("trafficLight", &[("id", &id.to_string())]);
    out.open("cycle", &[]);
    let mut element = |duration: usize, color: &str| {
        if duration > 0 {
            out.open("cycleElement", &[]);
            out.leaf("duration", duration);
            out.leaf("color", color);
            out.close();
        }
    };
    element(signal.runs.first().map_or(steps.max(1), |(first, _)| *first), "inactive");
    for (i, (first, state)) in signal.runs.iter().enumerate() {
        let end = signal.runs.get(i + 1).map_or(steps, |(next, _)| *next);
        element(end.saturating_sub(*first), color(*state));
    }
    out.close();
    if let Some(stop) = signal.stop {
        position(stop, out);
    }
    out.leaf("direction", "all");
    out.leaf("active", true);
    out.close();
}
