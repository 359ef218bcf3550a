//! Converts the map features of a Scenario message to a lane map.

use super::ids::UniqueIds;
use super::proto::{
    BoundarySegment, FeatureData, LaneCenter, LaneNeighbor, MapFeature, MapPoint, Polygon, StopSign,
    TypedLine,
};
use crate::problem::ImportWarning;
use crate::sentences::{self, subject};
use crate::units::MPS_PER_MPH;
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, Points, StopSign as Sign, TypedLine as Line};
use scene::map::{ROAD_EDGE_TYPES, ROAD_LINE_TYPES};
use scene::{LaneMap, Vec2};

/// The first point of a feature.
pub(super) fn any_point(feature: &MapFeature) -> Option<MapPoint> {
    match feature.feature_data.as_ref()? {
        FeatureData::Lane(lane) => lane.polyline.first().copied(),
        FeatureData::RoadLine(line) | FeatureData::RoadEdge(line) => line.polyline.first().copied(),
        FeatureData::StopSign(sign) => sign.position,
        FeatureData::Crosswalk(area) | FeatureData::SpeedBump(area) | FeatureData::Driveway(area) => {
            area.polygon.first().copied()
        }
    }
}

/// Ids are unique per kind in a scene, so each kind has its own list.
#[derive(Default)]
struct MapFeatureIds {
    lanes: UniqueIds,
    lines: UniqueIds,
    edges: UniqueIds,
    signs: UniqueIds,
    crosswalks: UniqueIds,
    bumps: UniqueIds,
    driveways: UniqueIds,
}

/// Sorts features into a map, in their order. Features with too few points to be drawn are dropped.
pub(super) fn lane_map(
    features: Vec<MapFeature>,
    origin: Vec2,
    warnings: &mut Vec<ImportWarning>,
) -> LaneMap {
    let mut map = LaneMap::default();
    let mut ids = MapFeatureIds::default();
    let mut dropped = 0;
    for feature in features {
        let number = feature.id.unwrap_or(0);
        match feature.feature_data {
            Some(FeatureData::Lane(data)) if data.polyline.len() >= 2 => {
                map.lanes.push(lane(ids.lanes.take(number), data, origin));
            }
            Some(FeatureData::RoadLine(data)) if !data.polyline.is_empty() => {
                map.road_lines.push(line(ids.lines.take(number), &data, &ROAD_LINE_TYPES, origin));
            }
            Some(FeatureData::RoadEdge(data)) if !data.polyline.is_empty() => {
                let types = ROAD_EDGE_TYPES.get(..3).unwrap_or_default();
                map.road_edges.push(line(ids.edges.take(number), &data, types, origin));
            }
            Some(FeatureData::StopSign(StopSign { lane, position: Some(at) })) => {
                map.stop_signs.push(Sign {
                    id: ids.signs.take(number),
                    position: at.plane() - origin,
                    z_m: at.z,
                    lanes: lane.iter().map(i64::to_string).collect(),
                });
            }
            Some(FeatureData::Crosswalk(data)) if !data.polygon.is_empty() => {
                map.crosswalks.push(area(ids.crosswalks.take(number), &data, origin));
            }
            Some(FeatureData::SpeedBump(data)) if !data.polygon.is_empty() => {
                map.speed_bumps.push(area(ids.bumps.take(number), &data, origin));
            }
            Some(FeatureData::Driveway(data)) if !data.polygon.is_empty() => {
                map.driveways.push(area(ids.driveways.take(number), &data, origin));
            }
            _ => dropped += 1,
        }
    }
    let MapFeatureIds { lanes, lines, edges, signs, crosswalks, bumps, driveways } = &ids;
    for kind in [lanes, lines, edges, signs, crosswalks, bumps, driveways] {
        kind.warn(subject::MAP_FEATURES, warnings);
    }
    if dropped > 0 {
        warnings.push(ImportWarning::new("features-dropped", sentences::features_unread(dropped)));
    }
    map
}

fn points(list: &[MapPoint], origin: Vec2) -> Points {
    let z_m = list.iter().any(|p| p.z.is_some());
    Points {
        xy: list.iter().map(|p| p.plane() - origin).collect(),
        z_m: z_m.then(|| list.iter().map(|p| p.z.unwrap_or(0.0)).collect()),
    }
}

fn line(id: String, data: &TypedLine, types: &[&str], origin: Vec2) -> Line {
    let number = usize::try_from(data.line_type.unwrap_or(0)).unwrap_or(0);
    let line_type = (*types.get(number).unwrap_or(&"unknown")).to_owned();
    Line { id, line_type, points: points(&data.polyline, origin) }
}

fn area(id: String, data: &Polygon, origin: Vec2) -> Area {
    Area { id, polygon: points(&data.polygon, origin), holes: Vec::new() }
}

fn lane(id: String, data: LaneCenter, origin: Vec2) -> Lane {
    let lane_type = match data.lane_type {
        Some(1) => LaneType::Freeway,
        Some(2) => LaneType::SurfaceStreet,
        Some(3) => LaneType::BikeLane,
        _ => LaneType::Undefined,
    };
    let ids = |list: &[i64]| list.iter().map(i64::to_string).collect();
    let neighbors = |list: &[LaneNeighbor]| list.iter().map(neighbor).collect();
    Lane {
        id,
        lane_type,
        points: points(&data.polyline, origin),
        width_m: None,
        left_boundary: data.left_boundaries.iter().map(boundary).collect(),
        right_boundary: data.right_boundaries.iter().map(boundary).collect(),
        speed_limit_mps: data.speed_limit_mph.map(|v| v * MPS_PER_MPH),
        predecessors: ids(&data.entry_lanes),
        successors: ids(&data.exit_lanes),
        left_neighbors: neighbors(&data.left_neighbors),
        right_neighbors: neighbors(&data.right_neighbors),
        interpolating: data.interpolating.unwrap_or(false),
    }
}

fn index(value: Option<i32>) -> usize {
    usize::try_from(value.unwrap_or(0)).unwrap_or(0)
}

fn boundary(segment: &BoundarySegment) -> Boundary {
    Boundary {
        line: segment.boundary_feature_id.unwrap_or(0).to_string(),
        from: index(segment.lane_start_index),
        to: index(segment.lane_end_index),
        kind: segment.boundary_type.and_then(|kind| u32::try_from(kind).ok()),
    }
}

fn neighbor(data: &LaneNeighbor) -> Neighbor {
    Neighbor {
        lane: data.feature_id.unwrap_or(0).to_string(),
        own_range: (index(data.self_start_index), index(data.self_end_index)),
        other_range: (index(data.neighbor_start_index), index(data.neighbor_end_index)),
        boundaries: data.boundaries.iter().map(boundary).collect(),
    }
}
