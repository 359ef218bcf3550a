//! Converts a lane map to map features.

use super::proto::{
    BoundarySegment, FeatureData, LaneCenter, LaneNeighbor, MapFeature, MapPoint, Polygon, StopSign,
    TypedLine,
};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use crate::units::mph;
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, Points};
use scene::map::{ROAD_EDGE_TYPES, ROAD_LINE_TYPES};
use scene::{LaneMap, Vec2};
use std::collections::{BTreeMap, BTreeSet};

/// First number for features with non-numeric ids.
const FIRST_FREE: i64 = 1_000_000_000;

/// Kinds of features. Ids are unique per kind in a scene, but over all kinds in a Scenario message.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum IdSpace {
    Lane,
    Line,
    Edge,
    Sign,
    Crosswalk,
    Bump,
    Driveway,
}

/// Numbers of map features, each used once.
pub(super) struct MapIds(BTreeMap<(IdSpace, String), i64>);

fn own_number(id: &str) -> Option<i64> {
    id.parse::<i64>().ok().filter(|n| n.to_string() == id)
}

impl MapIds {
    /// Keeps ids that are numbers and not yet used, numbers the others.
    pub(super) fn new(map: &LaneMap, losses: &mut Vec<Loss>) -> Self {
        fn tag<T>(
            kind: IdSpace,
            list: &[T],
            id: fn(&T) -> &String,
        ) -> impl Iterator<Item = (IdSpace, &String)> {
            list.iter().map(move |item| (kind, id(item)))
        }
        let all: Vec<(IdSpace, &String)> = tag(IdSpace::Lane, &map.lanes, |l| &l.id)
            .chain(tag(IdSpace::Line, &map.road_lines, |l| &l.id))
            .chain(tag(IdSpace::Edge, &map.road_edges, |l| &l.id))
            .chain(tag(IdSpace::Sign, &map.stop_signs, |s| &s.id))
            .chain(tag(IdSpace::Crosswalk, &map.crosswalks, |a| &a.id))
            .chain(tag(IdSpace::Bump, &map.speed_bumps, |a| &a.id))
            .chain(tag(IdSpace::Driveway, &map.driveways, |a| &a.id))
            .collect();
        let own: BTreeSet<i64> = all.iter().filter_map(|(_, id)| own_number(id)).collect();
        let mut free = (FIRST_FREE..).filter(|n| !own.contains(n));
        let mut used = BTreeSet::new();
        let mut ids = BTreeMap::new();
        let mut renumbered = false;
        for (kind, id) in all {
            let number = own_number(id).filter(|n| used.insert(*n)).or_else(|| {
                renumbered = true;
                free.next()
            });
            ids.insert((kind, id.clone()), number.unwrap_or(-1));
        }
        if renumbered {
            losses.push(Loss::new(
                code::IDS_RENUMBERED,
                "map ids that are no numbers or not unique got new ones",
            ));
        }
        Self(ids)
    }

    fn of(&self, kind: IdSpace, id: &str) -> Option<i64> {
        self.0.get(&(kind, id.to_owned())).copied()
    }

    /// Number of a lane, also of one that the map lacks (kept when it is a number, else -1).
    pub(super) fn lane(&self, id: &str) -> i64 {
        self.of(IdSpace::Lane, id).or_else(|| own_number(id)).unwrap_or(-1)
    }

    /// Number of a road line or edge that bounds a lane.
    fn boundary(&self, id: &str) -> i64 {
        let found = self.of(IdSpace::Line, id).or_else(|| self.of(IdSpace::Edge, id));
        found.or_else(|| own_number(id)).unwrap_or(-1)
    }
}

/// All features, kind by kind.
pub(super) fn features(map: &LaneMap, frame: Frame, ids: &MapIds, losses: &mut Vec<Loss>) -> Vec<MapFeature> {
    let mut list = Vec::new();
    let mut push = |kind, id: &str, data| {
        list.push(MapFeature { id: ids.of(kind, id), feature_data: Some(data) });
    };
    for lane in &map.lanes {
        push(IdSpace::Lane, &lane.id, FeatureData::Lane(lane_center(lane, frame, ids)));
    }
    for line in &map.road_lines {
        let line_type = word_number(&line.line_type, &ROAD_LINE_TYPES);
        push(
            IdSpace::Line,
            &line.id,
            FeatureData::RoadLine(TypedLine { line_type, polyline: points(&line.points, frame) }),
        );
    }
    for line in &map.road_edges {
        let line_type = word_number(&line.line_type, ROAD_EDGE_TYPES.get(..3).unwrap_or_default());
        push(
            IdSpace::Edge,
            &line.id,
            FeatureData::RoadEdge(TypedLine { line_type, polyline: points(&line.points, frame) }),
        );
    }
    for sign in &map.stop_signs {
        let lane = sign.lanes.iter().map(|id| ids.lane(id)).collect();
        let position = Some(map_point(frame, sign.position, sign.z_m));
        push(IdSpace::Sign, &sign.id, FeatureData::StopSign(StopSign { lane, position }));
    }
    let polygon = |area: &Area| Polygon { polygon: points(&area.polygon, frame) };
    for area in &map.crosswalks {
        push(IdSpace::Crosswalk, &area.id, FeatureData::Crosswalk(polygon(area)));
    }
    for area in &map.speed_bumps {
        push(IdSpace::Bump, &area.id, FeatureData::SpeedBump(polygon(area)));
    }
    for area in &map.driveways {
        push(IdSpace::Driveway, &area.id, FeatureData::Driveway(polygon(area)));
    }
    map_losses(map, losses);
    list
}

fn map_losses(map: &LaneMap, losses: &mut Vec<Loss>) {
    if !map.drivable.is_empty() {
        losses.push(Loss::new(code::NO_DRIVABLE, "drivable areas"));
    }
    if map.lanes.iter().any(|l| l.width_m.is_some()) {
        losses.push(Loss::new(code::NO_LANE_WIDTH, "widths of lanes"));
    }
    let foreign = |t| matches!(t, LaneType::BusLane | LaneType::Sidewalk | LaneType::Parking);
    let foreign_edge = map.road_edges.iter().any(|e| e.line_type == "sidewalk");
    if foreign_edge || map.lanes.iter().any(|l| foreign(l.lane_type)) {
        losses.push(Loss::new(code::NO_LANE_TYPE, "bus lanes, sidewalks and parking become untyped"));
    }
}

fn word_number(word: &str, words: &[&str]) -> Option<i32> {
    i32::try_from(words.iter().position(|w| *w == word).unwrap_or(0)).ok()
}

pub(super) fn map_point(frame: Frame, p: Vec2, z_m: Option<f64>) -> MapPoint {
    let p = frame.place(p);
    MapPoint { x: Some(p.x), y: Some(p.y), z: z_m.map(|z| frame.height(z)) }
}

fn points(points: &Points, frame: Frame) -> Vec<MapPoint> {
    let height = |i: usize| points.z_m.as_ref().and_then(|z| z.get(i)).copied();
    points.xy.iter().enumerate().map(|(i, p)| map_point(frame, *p, height(i))).collect()
}

fn lane_center(lane: &Lane, frame: Frame, ids: &MapIds) -> LaneCenter {
    let lane_type = match lane.lane_type {
        LaneType::Freeway => 1,
        LaneType::SurfaceStreet => 2,
        LaneType::BikeLane => 3,
        LaneType::Undefined | LaneType::BusLane | LaneType::Sidewalk | LaneType::Parking => 0,
    };
    let numbers = |list: &[String]| list.iter().map(|id| ids.lane(id)).collect();
    let neighbors = |list: &[Neighbor]| list.iter().map(|n| lane_neighbor(n, ids)).collect();
    let boundaries = |list: &[Boundary]| list.iter().map(|b| boundary_segment(b, ids)).collect();
    LaneCenter {
        speed_limit_mph: lane.speed_limit_mps.map(mph),
        lane_type: Some(lane_type),
        interpolating: Some(lane.interpolating),
        polyline: points(&lane.points, frame),
        entry_lanes: numbers(&lane.predecessors),
        exit_lanes: numbers(&lane.successors),
        left_neighbors: neighbors(&lane.left_neighbors),
        right_neighbors: neighbors(&lane.right_neighbors),
        left_boundaries: boundaries(&lane.left_boundary),
        right_boundaries: boundaries(&lane.right_boundary),
    }
}

fn index(value: usize) -> Option<i32> {
    Some(i32::try_from(value).unwrap_or(i32::MAX))
}

fn boundary_segment(boundary: &Boundary, ids: &MapIds) -> BoundarySegment {
    BoundarySegment {
        lane_start_index: index(boundary.from),
        lane_end_index: index(boundary.to),
        boundary_feature_id: Some(ids.boundary(&boundary.line)),
        boundary_type: boundary.kind.and_then(|kind| i32::try_from(kind).ok()),
    }
}

fn lane_neighbor(neighbor: &Neighbor, ids: &MapIds) -> LaneNeighbor {
    LaneNeighbor {
        feature_id: Some(ids.lane(&neighbor.lane)),
        self_start_index: index(neighbor.own_range.0),
        self_end_index: index(neighbor.own_range.1),
        neighbor_start_index: index(neighbor.other_range.0),
        neighbor_end_index: index(neighbor.other_range.1),
        boundaries: neighbor.boundaries.iter().map(|b| boundary_segment(b, ids)).collect(),
    }
}
