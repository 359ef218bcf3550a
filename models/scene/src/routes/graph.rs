//! The lane graph: lanes as polylines with links, neighbours and a spatial index.

use super::links;
use super::walks;
use crate::geometry::polyline::Polyline;
use crate::geometry::segments::{SegmentIndex, pieces};
use crate::map::{Lane, LaneType};
use crate::score::Drivable;
use crate::{AgentType, LaneMap, Vec2};
use std::collections::HashMap;
use std::sync::Arc;

/// Source of a lane of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneSource {
    /// A lane of the map, in its direction.
    Lane(usize),
    /// A sidewalk of the map, against its direction.
    Reversed(usize),
    /// A crosswalk, along its longer axis, in one of the two directions.
    Crosswalk(usize),
}

/// A neighbouring lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdjacentLane {
    /// The other lane.
    pub lane: usize,
    /// Arc lengths on the own lane between which the two lie side by side, metres.
    pub own_m: (f64, f64),
    /// The same on the other lane, metres; descending if it runs in the opposite direction.
    pub other_m: (f64, f64),
    /// Whether both run in the same direction.
    pub same_direction: bool,
}

impl AdjacentLane {
    /// Arc length on the other lane beside `s_m` on the own one; `None` outside the common part.
    pub fn across(&self, s_m: f64) -> Option<f64> {
        let (from, to) = self.own_m;
        if s_m < from || s_m > to {
            return None;
        }
        let share = if to - from > 1e-6 { (s_m - from) / (to - from) } else { 0.0 };
        Some(self.other_m.0 + share * (self.other_m.1 - self.other_m.0))
    }
}

/// One lane of the graph.
#[derive(Clone, Debug)]
pub struct GraphLane {
    /// Its source.
    pub source: LaneSource,
    /// Lane type; sidewalk for crosswalks.
    pub lane_type: LaneType,
    /// Whether it connects two lanes through a junction.
    pub interpolating: bool,
    /// Centre line; of zero length if the map's lane has none.
    pub path: Polyline,
    /// Width, assumed from the type if the map gives none, metres.
    pub width_m: f64,
    /// Speed limit, assumed from the type if the map gives none, m/s.
    pub speed_limit_mps: f64,
    /// Lanes that follow.
    pub successors: Vec<usize>,
    /// Lanes that lead here.
    pub predecessors: Vec<usize>,
    /// Lanes to the left.
    pub left: Vec<AdjacentLane>,
    /// Lanes to the right.
    pub right: Vec<AdjacentLane>,
    /// Arc length of the place beside this lane's stop sign, metres.
    pub stop_sign_m: Option<f64>,
}

impl GraphLane {
    /// Whether road users of this type use the lane: motor vehicles use lanes that carry vehicles, cyclists
    /// bike lanes and streets, pedestrians sidewalks and crosswalks, others none.
    pub fn carries(&self, agent_type: AgentType) -> bool {
        match agent_type {
            AgentType::Vehicle => self.lane_type.carries_vehicles(),
            AgentType::Cyclist => self.lane_type.carries_cyclists(),
            AgentType::Pedestrian => self.lane_type == LaneType::Sidewalk,
            AgentType::Other => false,
        }
    }

    /// Neighbouring lanes on both sides.
    pub fn beside(&self) -> impl Iterator<Item = &AdjacentLane> {
        self.left.iter().chain(&self.right)
    }

    pub(super) fn new(source: LaneSource, lane_type: LaneType, path: Polyline) -> Self {
        Self {
            source,
            lane_type,
            interpolating: false,
            path,
            width_m: lane_type.assumed_width_m(),
            speed_limit_mps: assumed_speed_limit_mps(lane_type),
            successors: Vec::new(),
            predecessors: Vec::new(),
            left: Vec::new(),
            right: Vec::new(),
            stop_sign_m: None,
        }
    }

    fn of_map(index: usize, lane: &Lane) -> Self {
        let path = Polyline::new(lane.points.xy.iter().copied());
        let assumed = Self::new(LaneSource::Lane(index), lane.lane_type, path);
        Self {
            interpolating: lane.interpolating,
            width_m: lane.width_or_assumed_m(),
            speed_limit_mps: lane.speed_limit_mps.filter(|v| *v > 0.0).unwrap_or(assumed.speed_limit_mps),
            ..assumed
        }
    }
}

/// Speed limit if the map gives none: 30 mph in streets, 65 mph on freeways (the most frequent in WOMD).
pub fn assumed_speed_limit_mps(lane_type: LaneType) -> f64 {
    match lane_type {
        LaneType::Freeway => 29.0,
        LaneType::Undefined | LaneType::SurfaceStreet | LaneType::BusLane => 13.4,
        LaneType::BikeLane => 8.0,
        LaneType::Parking => 4.0,
        LaneType::Sidewalk => 2.0,
    }
}

/// Lanes, links and spatial index of one map. Immutable; build it once per map and share it.
#[derive(Clone, Debug, Default)]
pub struct LaneGraph {
    lanes: Vec<GraphLane>,
    by_id: HashMap<String, usize>,
    index: SegmentIndex,
    ground: Arc<Drivable>,
}

/// A lane near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneHit {
    /// Index into [`LaneGraph::lanes`].
    pub lane: usize,
    /// Arc length of the foot, metres.
    pub s_m: f64,
    /// Signed offset of the point, positive left, metres; beyond the lane's ends it is measured from the
    /// straight continuation.
    pub lateral_m: f64,
    /// Distance to the foot, metres.
    pub distance_m: f64,
    /// Lane heading at the foot, radians.
    pub heading_rad: f64,
}

impl LaneGraph {
    /// Graph of a map. Recorded links are resolved and made mutual. Missing links are rebuilt where a lane
    /// ends within 0.6 m and 30 degrees of another's start. Neighbours are as recorded or, if the map has
    /// none at all, from the geometry.
    pub fn new(map: &LaneMap) -> Self {
        Self::unless(map, &|| false).unwrap_or_default()
    }

    /// As [`Self::new`]; `None` once the work is cancelled.
    pub fn unless(map: &LaneMap, is_cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let (by_id, mut lanes) = Self::recorded(map);
        links::rebuild(&mut lanes);
        walks::append(map, &mut lanes);
        for sign in &map.stop_signs {
            for lane in sign.lanes.iter().filter_map(|id| by_id.get(id.as_str())) {
                let s = lanes[*lane].path.project(sign.position).s_m;
                lanes[*lane].stop_sign_m = Some(s);
            }
        }
        let by_id = by_id.into_iter().map(|(id, i)| (id.to_owned(), i)).collect();
        let numbered = (0..).zip(&lanes);
        let index = SegmentIndex::new(numbered.flat_map(|(i, lane)| pieces(lane.path.points(), i)).collect());
        if is_cancelled() {
            return None;
        }
        let ground = Arc::new(Drivable::new(map));
        let mut graph = Self { lanes, by_id, index, ground };
        links::sides(map, &mut graph, is_cancelled);
        (!is_cancelled()).then_some(graph)
    }

    /// Links that the map lacks and the graph rebuilds from the geometry, as indices into [`LaneMap::lanes`]
    /// of the previous and the next lane.
    pub fn rebuilt_links(map: &LaneMap) -> Vec<(usize, usize)> {
        let (_, mut lanes) = Self::recorded(map);
        let recorded: Vec<usize> = lanes.iter().map(|lane| lane.successors.len()).collect();
        links::rebuild(&mut lanes);
        // Rebuilt links follow the recorded ones.
        let rebuilt = lanes.iter().zip(recorded).enumerate();
        rebuilt.flat_map(|(i, (lane, from))| lane.successors[from..].iter().map(move |to| (i, *to))).collect()
    }

    /// The lanes of a map with their recorded links, and their indices by id.
    fn recorded(map: &LaneMap) -> (HashMap<&str, usize>, Vec<GraphLane>) {
        let by_id: HashMap<&str, usize> =
            map.lanes.iter().enumerate().rev().map(|(i, lane)| (lane.id.as_str(), i)).collect();
        let mut lanes: Vec<_> = map.lanes.iter().enumerate().map(|(i, l)| GraphLane::of_map(i, l)).collect();
        links::record(map, &by_id, &mut lanes);
        (by_id, lanes)
    }

    /// All lanes: first [`LaneMap::lanes`] in order, then paths for pedestrians.
    pub fn lanes(&self) -> &[GraphLane] {
        &self.lanes
    }

    /// Where vehicles may drive on the same map.
    pub fn ground(&self) -> &Arc<Drivable> {
        &self.ground
    }

    pub(super) fn lanes_mut(&mut self) -> &mut [GraphLane] {
        &mut self.lanes
    }

    /// Index in [`LaneGraph::lanes`] of the map's lane with this id.
    pub fn lane_index(&self, id: &str) -> Option<usize> {
        self.by_id.get(id).copied()
    }

    /// Lanes within `radius_m` of `point` for which `keep` holds, nearest first, each once.
    pub fn nearest_lanes(
        &self,
        point: Vec2,
        radius_m: f64,
        keep: impl Fn(usize, &GraphLane) -> bool,
    ) -> Vec<LaneHit> {
        self.nearest_counted(point, radius_m, keep).0
    }

    /// As [`Self::nearest_lanes`], with the number of pieces that were examined.
    pub(super) fn nearest_counted(
        &self,
        point: Vec2,
        radius_m: f64,
        keep: impl Fn(usize, &GraphLane) -> bool,
    ) -> (Vec<LaneHit>, usize) {
        let mut looked = 0;
        let mut feet: Vec<(usize, f64, usize, f64)> = Vec::new();
        for segment in self.index.near(point, radius_m) {
            looked += 1;
            let (lane, piece) = (segment.owner as usize, segment.piece as usize);
            let (s, d2) = self.lanes[lane].path.foot_on(piece, point);
            if d2 > radius_m * radius_m {
                continue;
            }
            // The pieces of a lane are consecutive, so comparing with the last foot removes most duplicates.
            if let Some(last) = feet.last_mut().filter(|last| last.0 == lane) {
                if d2.total_cmp(&last.1).then(piece.cmp(&last.2)).is_lt() {
                    *last = (lane, d2, piece, s);
                }
            } else if keep(lane, &self.lanes[lane]) {
                feet.push((lane, d2, piece, s));
            }
        }
        feet.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        feet.dedup_by_key(|foot| foot.0);
        let hit = |(lane, _, piece, s): (usize, f64, usize, f64)| {
            let foot = self.lanes[lane].path.foot_at(piece, s, point);
            LaneHit {
                lane,
                s_m: s,
                lateral_m: foot.lateral_m,
                distance_m: foot.distance_m,
                heading_rad: foot.heading_rad,
            }
        };
        let mut hits: Vec<LaneHit> = feet.into_iter().map(hit).collect();
        hits.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m).then(a.lane.cmp(&b.lane)));
        (hits, looked)
    }

    /// Whether a lane that `agent_type` may use is within `radius_m` of `point`.
    pub fn has_lane_for(&self, point: Vec2, radius_m: f64, agent_type: AgentType) -> bool {
        self.index.near(point, radius_m).any(|segment| {
            let lane = &self.lanes[segment.owner as usize];
            lane.carries(agent_type)
                && lane.path.foot_on(segment.piece as usize, point).1 <= radius_m * radius_m
        })
    }

    /// Lanes within `radius_m` of `point` that `agent_type` may use, nearest first.
    pub fn nearest_for(&self, point: Vec2, radius_m: f64, agent_type: AgentType) -> Vec<LaneHit> {
        self.nearest_lanes(point, radius_m, |_, lane| lane.carries(agent_type))
    }
}
