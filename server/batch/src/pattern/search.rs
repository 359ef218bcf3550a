//! Search for the places of a map where a pattern fits.

use super::crossing::{LaneCrossing, crossings};
use super::document::{LaneSide, OtherSide, PatternWay, RoadFeature, RoadNeeds, RoadPattern, RoadTurn};
use super::place::PatternPlace;
use super::ring::is_ring;
use super::way::LaneWay;
use scene::routes::{GraphLane, LaneGraph, LaneSource, Pose};
use scene::{AgentType, Scene, wrap_angle};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::f64::consts::FRAC_PI_2;

/// Distance before and after a place over which a turn is measured, metres.
const TURN_M: (f64, f64) = (25.0, 5.0);
/// Change of heading below which a path is straight, radians: 20 degrees.
const STRAIGHT_RAD: f64 = 0.349;
/// Change of heading above which a path turns, radians: 35 degrees.
const TURN_RAD: f64 = 0.611;
/// Distance before a place in which a bend is searched, metres.
const BEND_M: f64 = 60.0;
/// Headings that differ by more are opposite, radians: 135 degrees.
const OPPOSITE_RAD: f64 = 2.356;
/// Greatest distance before a place of the end of a signal's lane that controls it, metres.
const SIGNAL_M: f64 = 60.0;
/// Range of the distance to an oncoming lane, metres.
const ONCOMING_M: (f64, f64) = (2.0, 8.0);
/// Distance before a merge at which the direction of the other path is measured, metres.
const MERGE_M: f64 = 15.0;
/// Most predecessors of a lane that are considered.
const MOST_BEFORE: usize = 8;

/// Finds the places of one map.
pub struct PatternSearch<'a> {
    pattern: &'a RoadPattern,
    scene: &'a Scene,
    graph: &'a LaneGraph,
    /// Lanes with a signal.
    signals: HashSet<usize>,
    standard: BTreeMap<String, f64>,
}

impl<'a> PatternSearch<'a> {
    /// A search on the map of a scene, with its graph.
    pub fn new(pattern: &'a RoadPattern, scene: &'a Scene, graph: &'a LaneGraph) -> Self {
        let signals = scene.signals.iter().filter_map(|signal| graph.lane_index(&signal.lane)).collect();
        Self { pattern, scene, graph, signals, standard: pattern.standard() }
    }

    /// Number of lanes for motor vehicles.
    pub fn lanes(&self) -> usize {
        self.graph.lanes().iter().filter(|lane| lane.carries(AgentType::Vehicle)).count()
    }

    /// All places, in the order of the lanes.
    pub fn all(&self) -> Vec<PatternPlace> {
        (0..self.scene.map.lanes.len()).flat_map(|lane| self.on_lane(lane)).collect()
    }

    /// The place with this id.
    pub fn find(&self, id: &str) -> Option<PatternPlace> {
        let (lane, _) = id.split_once('@')?;
        self.on_lane(self.graph.lane_index(lane)?).into_iter().find(|place| place.id == id)
    }

    /// The places of one lane, each id once.
    fn on_lane(&self, lane: usize) -> Vec<PatternPlace> {
        let own = &self.graph.lanes()[lane];
        // For lanes with equal ids, the graph knows only the first one.
        let is_first = self.graph.lane_index(&self.scene.map.lanes[lane].id) == Some(lane);
        if !is_first || !own.carries(AgentType::Vehicle) || own.path.length_m() <= 0.0 || !self.has_limit(own)
        {
            return Vec::new();
        }
        let found: Vec<PatternPlace> = match self.needs().feature {
            RoadFeature::Lane => self.of_lane(lane).into_iter().collect(),
            RoadFeature::Crosswalk => {
                let walks = |lane: &GraphLane| matches!(lane.source, LaneSource::Crosswalk(_));
                // Both directions over a crosswalk are lanes of the graph; the one from the right represents
                // both.
                let crossed = crossings(self.graph, lane, walks).into_iter().filter(|at| at.turn_rad > 0.0);
                crossed.filter_map(|at| self.of_crosswalk(lane, &at)).collect()
            }
            RoadFeature::Crossing => {
                let drives = |lane: &GraphLane| lane.carries(AgentType::Vehicle);
                let crossed = crossings(self.graph, lane, drives);
                crossed.iter().filter_map(|at| self.of_crossing(lane, at)).collect()
            }
            RoadFeature::Merge | RoadFeature::RoundaboutEntry => self.of_merges(lane),
        };
        let mut ids = BTreeSet::new();
        let casts = |place: &PatternPlace| place.cast(self.pattern, &self.standard, 0).is_ok();
        found.into_iter().filter(|place| casts(place) && ids.insert(place.id.clone())).collect()
    }

    fn needs(&self) -> &RoadNeeds {
        &self.pattern.road
    }

    fn has_limit(&self, lane: &GraphLane) -> bool {
        let kmh = lane.speed_limit_mps * 3.6;
        self.needs().limit_kmh.is_none_or(|(least, most)| kmh > least - 1.0 && kmh < most + 1.0)
    }

    /// The place in the middle of a lane.
    fn of_lane(&self, lane: usize) -> Option<PatternPlace> {
        let own = &self.graph.lanes()[lane];
        let s_m = 0.5 * own.path.length_m();
        if own.interpolating {
            return None;
        }
        let way = self.own_way(lane, s_m)?;
        let here = way.pose(0.0);
        let mut place = self.place(lane, s_m, None, way);
        self.add_across(&mut place, here, here.heading_rad + FRAC_PI_2);
        self.add_neighbor(&mut place, lane, s_m)?;
        Some(place)
    }

    fn of_crosswalk(&self, lane: usize, at: &LaneCrossing) -> Option<PatternPlace> {
        let LaneSource::Crosswalk(area) = self.graph.lanes()[at.other].source else { return None };
        let way = self.own_way(lane, at.own_m)?;
        let here = way.pose(0.0);
        let name = &self.scene.map.crosswalks.get(area)?.id;
        let mut place = self.place(lane, at.own_m, Some(name), way);
        self.add_across(&mut place, here, here.heading_rad + at.turn_rad);
        self.add_neighbor(&mut place, lane, at.own_m)?;
        Some(place)
    }

    fn of_crossing(&self, lane: usize, at: &LaneCrossing) -> Option<PatternPlace> {
        let way = self.own_way(lane, at.own_m)?;
        let other = LaneWay::along(self.graph, at.other, at.other_m, None);
        let apart = |way: &LaneWay| way.pose(-TURN_M.0).heading_rad;
        let turn_rad = wrap_angle(apart(&other) - apart(&way));
        let side = match turn_rad {
            turn if turn.abs() > OPPOSITE_RAD => Some(OtherSide::Oncoming),
            turn if turn > TURN_RAD => Some(OtherSide::Right),
            turn if turn < -TURN_RAD => Some(OtherSide::Left),
            _ => None,
        };
        let is_straight = other.turn_rad(-TURN_M.0, TURN_M.0).abs() < STRAIGHT_RAD;
        let fits = is_straight && self.needs().from.is_none_or(|from| side == Some(from));
        fits.then_some(())?;
        let name = &self.scene.map.lanes.get(at.other)?.id;
        let mut place = self.place(lane, at.own_m, Some(name), way);
        place.ways.insert(PatternWay::Other, other);
        Some(place)
    }

    /// The places where other lanes merge with this one.
    fn of_merges(&self, lane: usize) -> Vec<PatternPlace> {
        let lanes = self.graph.lanes();
        let mut found = Vec::new();
        for next in lanes[lane].successors.iter().filter(|next| lanes[**next].carries(AgentType::Vehicle)) {
            for other in lanes[*next].predecessors.iter().take(MOST_BEFORE) {
                let drives = *other != lane && lanes[*other].carries(AgentType::Vehicle);
                found.extend(drives.then(|| self.of_merge(lane, *next, *other)).flatten());
            }
        }
        found
    }

    fn of_merge(&self, lane: usize, next: usize, other: usize) -> Option<PatternPlace> {
        if self.needs().feature == RoadFeature::RoundaboutEntry
            && (!is_ring(self.graph, next, other) || is_ring(self.graph, next, lane))
        {
            return None;
        }
        // The place is the beginning of the common lane.
        let way = self.checked(LaneWay::along(self.graph, next, 0.0, Some(lane)))?;
        let joined = LaneWay::along(self.graph, next, 0.0, Some(other));
        let here = way.pose(-MERGE_M);
        let beside = joined.pose(-MERGE_M).position - here.position;
        let is_left = scene::geometry::cross(here.direction(), beside) > 0.0;
        let side = if is_left { OtherSide::Left } else { OtherSide::Right };
        self.needs().from.is_none_or(|from| from == side).then_some(())?;
        let name = &self.scene.map.lanes.get(other)?.id;
        let mut place = self.place(lane, self.graph.lanes()[lane].path.length_m(), Some(name), way);
        place.ways.insert(PatternWay::Other, joined);
        Some(place)
    }

    /// The first path through a place of a lane that satisfies the pattern.
    fn own_way(&self, lane: usize, s_m: f64) -> Option<LaneWay> {
        let lanes = self.graph.lanes();
        let along = |before: Option<usize>| self.checked(LaneWay::along(self.graph, lane, s_m, before));
        let others = || {
            let before = lanes[lane].predecessors.iter().copied().take(MOST_BEFORE);
            before.filter(|before| lanes[*before].carries(AgentType::Vehicle))
        };
        along(None).or_else(|| others().find_map(|before| along(Some(before))))
    }

    /// The path, if it satisfies the pattern.
    fn checked(&self, way: LaneWay) -> Option<LaneWay> {
        let needs = self.needs();
        let (before_m, after_m) = way.room_m();
        let has_room = before_m >= needs.before_m && after_m >= needs.after_m;
        let turn_rad = way.turn_rad(-TURN_M.0, TURN_M.1);
        let turns = match needs.turn {
            None => true,
            Some(RoadTurn::Straight) if needs.feature == RoadFeature::Lane => {
                way.bend_rad(-needs.before_m, needs.after_m) < STRAIGHT_RAD
            }
            Some(RoadTurn::Straight) => turn_rad.abs() < STRAIGHT_RAD,
            Some(RoadTurn::Left) => turn_rad > TURN_RAD,
            Some(RoadTurn::Right) => turn_rad < -TURN_RAD,
        };
        let bends = || way.bend_rad(-BEND_M.min(before_m), 0.0) > STRAIGHT_RAD;
        let is_controlled = || way.lanes.iter().any(|(lane, m)| *m < SIGNAL_M && self.signals.contains(lane));
        let fits = has_room
            && turns
            && needs.bend.is_none_or(|bend| bend == bends())
            && needs.signal.is_none_or(|signal| signal == is_controlled());
        fits.then_some(way)
    }

    fn place(&self, lane: usize, s_m: f64, other: Option<&str>, way: LaneWay) -> PatternPlace {
        let name = &self.scene.map.lanes[lane].id;
        let crossed = other.map_or_else(String::new, |other| format!("x{other}"));
        PatternPlace {
            id: format!("{name}@{s_m:.1}{crossed}"),
            lane: name.clone(),
            s_m,
            position: way.pose(0.0).position,
            ways: BTreeMap::from([(PatternWay::Against, way.reversed()), (PatternWay::Own, way)]),
        }
    }

    fn add_across(&self, place: &mut PatternPlace, here: Pose, heading_rad: f64) {
        let across = |heading_rad: f64| LaneWay::across(Pose::new(here.position, heading_rad));
        place.ways.insert(PatternWay::FromRight, across(heading_rad));
        place.ways.insert(PatternWay::FromLeft, across(heading_rad + std::f64::consts::PI));
    }

    /// Adds the neighbouring lane that the pattern needs; `None` if it does not exist.
    fn add_neighbor(&self, place: &mut PatternPlace, lane: usize, s_m: f64) -> Option<()> {
        let own = &self.graph.lanes()[lane];
        let here = own.path.sample(s_m);
        let Some(side) = self.needs().neighbor else { return Some(()) };
        let is_open = |to: scene::Vec2| !self.graph.ground().crosses_an_edge(here.position, to);
        let (way, other, at_m) = match side {
            LaneSide::Left | LaneSide::Right => {
                let (way, beside) = match side {
                    LaneSide::Left => (PatternWay::Left, &own.left),
                    _ => (PatternWay::Right, &own.right),
                };
                let beside = beside.iter().filter(|beside| beside.same_direction);
                let mut beside = beside.filter_map(|beside| Some((beside.lane, beside.across(s_m)?)));
                let (other, at_m) = beside.find(|(other, at_m)| {
                    let other = &self.graph.lanes()[*other];
                    other.carries(AgentType::Vehicle) && is_open(other.path.position_at(*at_m))
                })?;
                (way, other, at_m)
            }
            LaneSide::Oncoming => {
                let drives =
                    |_: usize, lane: &GraphLane| lane.carries(AgentType::Vehicle) && !lane.interpolating;
                let near = self.graph.nearest_lanes(here.position, ONCOMING_M.1, drives).into_iter();
                let hit = near.into_iter().find(|hit| {
                    let foot = self.graph.lanes()[hit.lane].path.position_at(hit.s_m);
                    hit.distance_m >= ONCOMING_M.0
                        && wrap_angle(hit.heading_rad - here.heading_rad).abs() > OPPOSITE_RAD
                        && is_open(foot)
                })?;
                (PatternWay::Oncoming, hit.lane, hit.s_m)
            }
        };
        place.ways.insert(way, LaneWay::along(self.graph, other, at_m, None));
        Some(())
    }
}
