//! Arms: where roads enter a map, or a drawn region of it. Lanes are grouped by heading and distance, so that
//! a road is one arm, independent of names in the file.

use super::driving::{SpeedRange, allowed_mps};
use super::region::Region;
use super::stop_lines::{ShownLights, straightest};
use crate::tuning::placing::arms::{
    BEHIND_M, BESIDE_REACH_M, FREE_SHARE, LONGEST_M, RAGGED_M, SAME_ROAD_M, SAME_ROAD_RAD, SHORTEST_M,
};
use scene::map::LaneType;
use scene::routes::graph::{GraphLane, LaneGraph};
use scene::routes::{Polyline, Pose};
use scene::{AgentType, Vec2, wrap_angle};
use std::collections::HashSet;
use std::f64::consts::{FRAC_PI_4, PI};

/// Distance between the samples at which a lane is tested for entering a region, metres.
const LOOK_STEP_M: f64 = 2.0;
const MOST_LEGS: usize = 200;
/// Distance between the samples of travel time, metres.
const TIME_STEP_M: f64 = 2.0;

/// A lane by which an arm enters the map or the region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmLane {
    /// Index into the graph's lanes.
    pub lane: usize,
    /// Arc length of the entry, metres.
    pub s_m: f64,
    /// The map begins there, so later arrivals appear at this place.
    pub at_map_edge: bool,
}

/// A place where a road enters.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// The compass point from which it comes, with a number if several arms share it: `north-east-2`.
    pub id: String,
    /// Middle of its lanes at the entry, metres.
    pub position: Vec2,
    /// Driving direction at the entry, radians.
    pub heading_rad: f64,
    /// Its lanes, from right to left.
    pub lanes: Vec<ArmLane>,
}

fn drives(lane: &GraphLane) -> bool {
    lane.carries(AgentType::Vehicle) && lane.path.length_m() > 0.5
}

/// All arms of a map, or of a region of it, sorted by name.
pub fn arms(graph: &LaneGraph, region: &Region) -> Vec<Arm> {
    let mut entries: Vec<(ArmLane, Pose)> = Vec::new();
    for (index, lane) in graph.lanes().iter().enumerate().filter(|(_, l)| drives(l) && !l.interpolating) {
        for (s_m, at_map_edge) in comes_in(graph, index, region) {
            entries.push((ArmLane { lane: index, s_m, at_map_edge }, lane.path.sample(s_m)));
        }
    }
    // Only buses use a bus lane; it counts if a road has no other lane.
    let groups = grouped(&entries).into_iter().map(|group| {
        let common = |at: &&usize| graph.lanes()[entries[**at].0.lane].lane_type != LaneType::BusLane;
        let kept: Vec<usize> = group.iter().filter(common).copied().collect();
        if kept.is_empty() { group } else { kept }
    });
    let mut all: Vec<Arm> = groups.map(|group| arm(&entries, group)).collect();
    all.sort_by(|a, b| {
        let place = |arm: &Arm| (compass(arm.heading_rad), arm.position.x, arm.position.y);
        let (a, b) = (place(a), place(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    });
    let points: Vec<usize> = all.iter().map(|arm| compass(arm.heading_rad)).collect();
    for (i, arm) in all.iter_mut().enumerate() {
        let word = COMPASS[points[i]];
        let several = points.iter().filter(|p| **p == points[i]).count() > 1;
        let number = 1 + points[..i].iter().filter(|p| **p == points[i]).count();
        arm.id = if several { format!("{word}-{number}") } else { word.to_owned() };
    }
    all
}

const COMPASS: [&str; 8] =
    ["east", "north-east", "north", "north-west", "west", "south-west", "south", "south-east"];

/// The compass point from which an agent with this heading comes.
fn compass(heading_rad: f64) -> usize {
    ((wrap_angle(heading_rad + PI) / FRAC_PI_4).round() as i64).rem_euclid(8) as usize
}

/// Places at which a lane enters the region, and whether the map begins there.
fn comes_in(graph: &LaneGraph, index: usize, region: &Region) -> Vec<(f64, bool)> {
    let lane = &graph.lanes()[index];
    let length_m = lane.path.length_m();
    let mut found = Vec::new();
    if length_m >= SHORTEST_M && region.contains(lane.path.position_at(0.0)) {
        let mut before =
            lane.predecessors.iter().map(|p| &graph.lanes()[*p]).filter(|l| drives(l)).peekable();
        if before.peek().is_none() {
            if !opens_beside(graph, index) {
                found.push((0.0, true));
            }
        } else if before.all(|l| l.interpolating && !region.contains(l.path.position_at(0.0))) {
            // The region cuts through the junction that precedes this lane.
            found.push((0.0, false));
        }
    }
    if matches!(region, Region::Everywhere)
        || !region.may_hold(lane.path.position_at(0.5 * length_m), length_m)
    {
        return found;
    }
    let count = (length_m / LOOK_STEP_M).ceil().clamp(1.0, 2_000.0) as usize;
    let at = |i: usize| length_m * i as f64 / count as f64;
    let inside = |s: f64| region.contains(lane.path.position_at(s));
    let mut was = inside(0.0);
    for i in 1..=count {
        let is = inside(at(i));
        if is && !was {
            let (mut out, mut within) = (at(i - 1), at(i));
            for _ in 0..12 {
                let middle = 0.5 * (out + within);
                if inside(middle) { within = middle } else { out = middle }
            }
            found.push((within, false));
        }
        was = is;
    }
    found
}

/// Whether a lane, such as a turning lane, begins beside another lane of its road that comes from farther
/// back.
fn opens_beside(graph: &LaneGraph, index: usize) -> bool {
    let lane = &graph.lanes()[index];
    let start = lane.path.sample(0.0);
    let behind = start.position - start.direction() * BEHIND_M;
    let hits = graph.nearest_lanes(behind, BESIDE_REACH_M, |i, l| i != index && drives(l));
    hits.iter().any(|hit| {
        let other = &graph.lanes()[hit.lane];
        let near = hit.distance_m < 0.5 * (other.width_m + lane.width_m) + 0.5;
        let along = wrap_angle(hit.heading_rad - start.heading_rad).abs() < FRAC_PI_4;
        let passes = hit.s_m > 0.01 && hit.s_m < other.path.length_m() - 0.01;
        let begins_too = hit.s_m < RAGGED_M && other.predecessors.is_empty();
        near && along && passes && !begins_too
    })
}

/// Entries grouped by road, as indices. Neighbouring entries are joined one after the other.
fn grouped(entries: &[(ArmLane, Pose)]) -> Vec<Vec<usize>> {
    let together = |a: &Pose, b: &Pose| {
        let (apart, way) = (b.position - a.position, a.direction());
        let (along, across) = (apart.dot(&way).abs(), scene::geometry::cross(way, apart).abs());
        let turn = wrap_angle(a.heading_rad - b.heading_rad).abs();
        turn < SAME_ROAD_RAD && across < SAME_ROAD_M.0 && along < SAME_ROAD_M.1
    };
    let mut left: Vec<usize> = (0..entries.len()).collect();
    let mut groups = Vec::new();
    while let Some(first) = left.first().copied() {
        left.remove(0);
        let mut group = vec![first];
        let mut next = 0;
        while let Some(at) = group.get(next).copied() {
            let (near, far) = left.iter().partition(|i| together(&entries[at].1, &entries[**i].1));
            group.extend::<Vec<usize>>(near);
            left = far;
            next += 1;
        }
        groups.push(group);
    }
    groups
}

fn arm(entries: &[(ArmLane, Pose)], mut group: Vec<usize>) -> Arm {
    let count = group.len() as f64;
    let position = group.iter().map(|i| entries[*i].1.position).sum::<Vec2>() / count;
    let way = group.iter().map(|i| entries[*i].1.direction()).sum::<Vec2>();
    let left = Vec2::new(-way.y, way.x);
    let across = |i: &usize| (entries[*i].1.position - position).dot(&left);
    group.sort_by(|a, b| across(a).total_cmp(&across(b)).then(a.cmp(b)));
    let lanes = group.iter().map(|i| entries[*i].0).collect();
    Arm { id: String::new(), position, heading_rad: way.y.atan2(way.x), lanes }
}

/// A stretch of lane on the path of an arm.
#[derive(Clone, Copy, Debug)]
struct ArmLeg {
    lane: usize,
    from_m: f64,
    /// Arc length of the path at which the stretch begins, metres.
    at_m: f64,
}

/// The path from one lane of an arm to its end line. That is the first junction, or the place where the road
/// leaves the map or joins another.
pub(super) struct ArmPath {
    legs: Vec<ArmLeg>,
    pub(super) path: Polyline,
    /// Seconds of free travel from the beginning of the path, every [`TIME_STEP_M`].
    times_s: Vec<f64>,
    /// Speeds at these places, m/s.
    speeds_mps: Vec<f64>,
}

impl ArmPath {
    /// The path that begins at an entry.
    pub(super) fn of(
        graph: &LaneGraph,
        lights: &ShownLights,
        entry: ArmLane,
        speeds: Option<SpeedRange>,
    ) -> Self {
        let mut legs = vec![ArmLeg { lane: entry.lane, from_m: entry.s_m, at_m: 0.0 }];
        let mut points: Vec<Vec2> = Vec::new();
        let mut seen = HashSet::from([entry.lane]);
        let (mut at, mut from_m, mut length_m) = (entry.lane, entry.s_m, 0.0);
        loop {
            let lane = &graph.lanes()[at];
            let sign_m = lane.stop_sign_m.filter(|s| *s > from_m);
            let until_m = sign_m.unwrap_or(lane.path.length_m());
            points.extend(lane.path.slice(from_m, until_m).points());
            length_m += until_m - from_m;
            let next = straightest(graph, at).filter(|_| sign_m.is_none() && length_m < LONGEST_M);
            let Some(next) = next.filter(|next| goes_on(graph, lights, at, *next)) else { break };
            if !seen.insert(next) || legs.len() >= MOST_LEGS {
                break;
            }
            (at, from_m) = (next, 0.0);
            legs.push(ArmLeg { lane: at, from_m, at_m: length_m });
        }
        let path = Polyline::new(points);
        let mut way = Self { legs, path, times_s: Vec::new(), speeds_mps: Vec::new() };
        way.take_times(graph, speeds);
        way
    }

    fn take_times(&mut self, graph: &LaneGraph, speeds: Option<SpeedRange>) {
        let count = (self.path.length_m() / TIME_STEP_M).ceil() as usize;
        let mut time_s = 0.0;
        for i in 0..=count {
            let (lane, s_m) = self.lane_at(i as f64 * TIME_STEP_M);
            let s_m = s_m.min(graph.lanes()[lane].path.length_m());
            let free_mps = FREE_SHARE * allowed_mps(graph, lane, s_m, AgentType::Vehicle);
            let speed_mps =
                speeds.map_or(free_mps, |range| free_mps.clamp(range.min_mps, range.max_mps)).max(1.0);
            if let Some(before) = self.speeds_mps.last() {
                time_s += 2.0 * TIME_STEP_M / (before + speed_mps);
            }
            self.times_s.push(time_s);
            self.speeds_mps.push(speed_mps);
        }
    }

    /// Lowest speed of free traffic, m/s.
    pub(super) fn slowest_mps(&self) -> f64 {
        self.speeds_mps.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The lane at a place of the path, and the arc length on that lane, metres.
    pub(super) fn lane_at(&self, at_m: f64) -> (usize, f64) {
        let after = self.legs.partition_point(|leg| leg.at_m <= at_m);
        let leg = &self.legs[after.saturating_sub(1)];
        (leg.lane, leg.from_m + (at_m - leg.at_m).max(0.0))
    }

    /// Lanes of the path, each with the arc length of the path at which the lane itself would begin, metres.
    pub(super) fn legs(&self) -> impl Iterator<Item = (usize, f64)> {
        self.legs.iter().map(|leg| (leg.lane, leg.at_m - leg.from_m))
    }

    /// Lanes of the path.
    pub(super) fn lanes(&self) -> impl Iterator<Item = usize> {
        self.legs.iter().map(|leg| leg.lane)
    }

    /// Last lane of the path.
    pub(super) fn last_lane(&self) -> usize {
        self.legs[self.legs.len() - 1].lane
    }

    pub(super) fn length_m(&self) -> f64 {
        self.path.length_m()
    }

    /// Duration of free travel from the beginning to the end line, seconds.
    pub(super) fn seconds(&self) -> f64 {
        let full_m = TIME_STEP_M * (self.times_s.len() - 1) as f64;
        let over_m = full_m - self.length_m();
        self.times_s[self.times_s.len() - 1] - over_m / self.speeds_mps[self.speeds_mps.len() - 1]
    }

    /// Place of free traffic this many seconds after it entered, metres.
    pub(super) fn after_s(&self, seconds: f64) -> f64 {
        let i = self.times_s.partition_point(|t| *t <= seconds).clamp(1, self.times_s.len()) - 1;
        let over_s = seconds - self.times_s[i];
        (i as f64 * TIME_STEP_M + over_s * self.speeds_mps[i]).min(self.length_m())
    }

    /// Speed of free traffic at a place, m/s.
    pub(super) fn free_mps(&self, at_m: f64) -> f64 {
        let i = (at_m / TIME_STEP_M).max(0.0) as usize;
        self.speeds_mps[i.min(self.speeds_mps.len() - 1)]
    }
}

/// Whether the road continues from one lane to the next without a junction, a fork, a signal or a merging
/// lane with priority.
fn goes_on(graph: &LaneGraph, lights: &ShownLights, at: usize, next: usize) -> bool {
    let (lane, then) = (&graph.lanes()[at], &graph.lanes()[next]);
    let junction = lane.successors.iter().any(|s| graph.lanes()[*s].interpolating || lights.rules(*s));
    let parts = lane.successors.len() > 1 && lane.lane_type != LaneType::Freeway;
    if junction || parts || lights.rules(at) || !drives(then) {
        return false;
    }
    let turn = |from: usize| {
        let path = &graph.lanes()[from].path;
        wrap_angle(path.heading_at(path.length_m()) - then.path.heading_at(0.0)).abs()
    };
    let straighter =
        then.predecessors.iter().copied().min_by(|a, b| turn(*a).total_cmp(&turn(*b)).then(a.cmp(b)));
    straighter.is_none_or(|first| first == at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Lane, LaneMap};
    use scene::{Scene, Signal, SignalState};

    fn lane(id: &str, from: (f64, f64), to: (f64, f64)) -> Lane {
        let at = |i: u32| {
            let share = f64::from(i) / 20.0;
            Vec2::new(from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
        };
        Lane::street(id, (0..=20).map(at).collect::<Vec<Vec2>>())
    }

    /// A road from west to east with a turning lane that opens 40 m on, and one from the north.
    fn map() -> LaneMap {
        let mut lanes = vec![
            lane("a", (-100.0, 0.0), (-20.0, 0.0)),
            lane("b", (-98.0, -3.5), (-20.0, -3.5)),
            lane("turn", (-60.0, 3.5), (-20.0, 3.5)),
            lane("mid", (-20.0, 0.0), (20.0, 0.0)),
            lane("out", (20.0, 0.0), (100.0, 0.0)),
            lane("down", (-3.0, 90.0), (-3.0, 20.0)),
        ];
        lanes[3].interpolating = true;
        lanes[0].successors = vec!["mid".into()];
        lanes[3].successors = vec!["out".into()];
        LaneMap { lanes, ..LaneMap::default() }
    }

    #[test]
    fn a_road_is_one_arm_and_a_turning_lane_none() {
        let graph = LaneGraph::new(&map());
        let found = arms(&graph, &Region::Everywhere);
        let told: Vec<(&str, Vec<usize>)> =
            found.iter().map(|a| (a.id.as_str(), a.lanes.iter().map(|l| l.lane).collect())).collect();
        assert_eq!(told, [("north", vec![5]), ("west", vec![1, 0])]);
        assert!(found.iter().all(|a| a.lanes.iter().all(|l| l.at_map_edge)));
        assert!((found[1].position - Vec2::new(-99.0, -1.75)).norm() < 1e-6);
    }

    #[test]
    fn a_region_has_arms_of_its_own() {
        let graph = LaneGraph::new(&map());
        let region = Region::Circle { center: Vec2::new(-40.0, 0.0), radius_m: 30.0 };
        let found = arms(&graph, &region);
        assert_eq!(found.len(), 1, "{found:?}");
        // The turning lane opens inside the region; turning vehicles enter by the lane beside it.
        assert_eq!((found[0].id.as_str(), found[0].lanes.len()), ("west", 2));
        for entry in &found[0].lanes {
            let place = graph.lanes()[entry.lane].path.position_at(entry.s_m);
            assert!(((place - Vec2::new(-40.0, 0.0)).norm() - 30.0).abs() < 0.01 && !entry.at_map_edge);
        }
    }

    #[test]
    fn a_way_ends_at_the_junction_and_takes_its_time() {
        let scene = Scene::bare("", map(), Vec::new());
        let graph = LaneGraph::new(&scene.map);
        let lights = ShownLights::new(&scene, &graph, 0);
        let way = ArmPath::of(&graph, &lights, ArmLane { lane: 0, s_m: 0.0, at_map_edge: true }, None);
        assert!((way.length_m() - 80.0).abs() < 1e-6);
        let free_mps = FREE_SHARE * graph.lanes()[0].speed_limit_mps;
        assert!((way.seconds() - 80.0 / free_mps).abs() < 1e-6);
        assert!((way.after_s(2.0) - 2.0 * free_mps).abs() < 1e-6);
        let slow = Some(SpeedRange { min_mps: 0.0, max_mps: 4.0 });
        let way = ArmPath::of(&graph, &lights, ArmLane { lane: 0, s_m: 0.0, at_map_edge: true }, slow);
        assert!((way.seconds() - 20.0).abs() < 1e-6);
        // A signal in the middle of a road is an end line too.
        let mut lit = scene.clone();
        lit.signals =
            vec![Signal { lane: "out".into(), stop: None, stop_z_m: None, runs: vec![(0, SignalState::Go)] }];
        let lights = ShownLights::new(&lit, &graph, 0);
        let way = ArmPath::of(&graph, &lights, ArmLane { lane: 3, s_m: 0.0, at_map_edge: false }, None);
        assert!((way.length_m() - 40.0).abs() < 1e-6);
    }
}
