//! The map of a location: `log_map_archive_*.json`.

use crate::problem::{ImportWarning, ReadError};
use crate::sentences;
use crate::source::{Source, without_mark};
use crate::surface;
use crate::unpack::{self, Bounds};
use crate::{bounds, polyline};
use scene::geometry::Extent;
use scene::map::{Area, Boundary, Lane, LaneMap, LaneType, Neighbor, ROAD_LINE_TYPES, TypedLine};
use scene::{MAX_COORDINATE_M, Vec2};
use serde::Deserialize;
use std::collections::{BTreeMap, HashMap};
use std::io::Read;

/// Most bytes of a decompressed map: the largest of the data set has two MiB.
const MAX_BYTES: u64 = 16 << 20;
/// Distance between points of a centre line, metres.
const SPACING_M: f64 = 2.0;
/// Lanes are extended by this length beyond their ends when edges of the ground are searched, metres: the
/// ground is cut off at the end of the map, and that cut is no kerb.
const BEYOND_M: f64 = 2.0;
/// Lines whose ends are at most this far apart count as the same line, metres.
const SAME_M: f64 = 0.05;

#[derive(Clone, Copy, Deserialize)]
struct Point {
    x: f64,
    y: f64,
}

#[derive(Deserialize)]
struct Segment {
    id: i64,
    #[serde(default)]
    is_intersection: bool,
    #[serde(default)]
    lane_type: String,
    #[serde(default)]
    centerline: Vec<Point>,
    left_lane_boundary: Vec<Point>,
    right_lane_boundary: Vec<Point>,
    #[serde(default)]
    left_lane_mark_type: Option<String>,
    #[serde(default)]
    right_lane_mark_type: Option<String>,
    #[serde(default)]
    left_neighbor_id: Option<i64>,
    #[serde(default)]
    right_neighbor_id: Option<i64>,
    #[serde(default)]
    predecessors: Vec<i64>,
    #[serde(default)]
    successors: Vec<i64>,
}

#[derive(Deserialize)]
struct Crossing {
    id: i64,
    edge1: Vec<Point>,
    edge2: Vec<Point>,
}

#[derive(Deserialize)]
struct Ground {
    area_boundary: Vec<Point>,
}

/// A map in the form of its file.
#[derive(Deserialize)]
pub(super) struct Place {
    #[serde(default)]
    lane_segments: BTreeMap<String, Segment>,
    #[serde(default)]
    pedestrian_crossings: BTreeMap<String, Crossing>,
    #[serde(default)]
    drivable_areas: BTreeMap<String, Ground>,
}

/// Reads a map, plain or compressed with gzip.
///
/// # Errors
/// Those of the file, `malformed-json`.
pub(super) fn read(file: &dyn Source) -> Result<Place, ReadError> {
    let mut bytes = Vec::new();
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let input = input.and_then(|mut input| input.read_to_end(&mut bytes));
    input.map_err(|error| unpack::fault(&error, 0))?;
    serde_json::from_slice(without_mark(&bytes))
        .map_err(|error| ReadError::malformed_json(&error, error.to_string()))
}

fn about(points: &[Point], origin: Vec2) -> Vec<Vec2> {
    let mut line: Vec<Vec2> = points.iter().map(|p| Vec2::new(p.x, p.y) - origin).collect();
    line.dedup();
    line
}

/// The word for a painted line; nothing where there is none.
fn line_type(mark: Option<&str>) -> Option<&'static str> {
    Some(match mark? {
        "DASHED_WHITE" => "broken_single_white",
        "DASHED_YELLOW" => "broken_single_yellow",
        "SOLID_WHITE" | "SOLID_BLUE" => "solid_single_white",
        "SOLID_YELLOW" => "solid_single_yellow",
        "DOUBLE_SOLID_WHITE" | "DOUBLE_DASH_WHITE" | "SOLID_DASH_WHITE" | "DASH_SOLID_WHITE" => {
            "solid_double_white"
        }
        "DOUBLE_SOLID_YELLOW" => "solid_double_yellow",
        "DOUBLE_DASH_YELLOW" => "broken_double_yellow",
        "SOLID_DASH_YELLOW" | "DASH_SOLID_YELLOW" => "passing_double_yellow",
        "UNKNOWN" => "unknown",
        _ => return None,
    })
}

impl Place {
    /// Extent of lanes and ground; `None` without any.
    pub fn extent(&self) -> Option<Extent> {
        let lanes = self.lane_segments.values().flat_map(|lane| &lane.left_lane_boundary);
        let ground = self.drivable_areas.values().flat_map(|area| &area.area_boundary);
        Extent::about(lanes.chain(ground).map(|p| Vec2::new(p.x, p.y)))
    }

    /// The map with a point of it as the origin.
    pub fn lane_map(&self, origin: Vec2) -> (LaneMap, Vec<ImportWarning>) {
        let mut map = LaneMap::default();
        let mut broken = 0;
        let mut segments = Vec::new();
        for segment in self.lane_segments.values() {
            match lane(segment, origin) {
                Some(lane) => {
                    map.lanes.push(lane);
                    segments.push(segment);
                }
                None => broken += 1,
            }
        }
        link(&segments, &mut map);
        paint(&segments, origin, &mut map);
        for crossing in self.pedestrian_crossings.values() {
            let (near, mut far) = (about(&crossing.edge1, origin), about(&crossing.edge2, origin));
            // The edges usually run the same way: one is reversed, so that the ring does not cross itself.
            let ends = (near.last(), far.first(), far.last());
            if let (Some(end), Some(first), Some(last)) = ends
                && (first - end).norm() > (last - end).norm()
            {
                far.reverse();
            }
            let ring: Vec<Vec2> = near.into_iter().chain(far).collect();
            if ring.len() > 2 {
                let id = crossing.id.to_string();
                map.crosswalks.push(Area { id, polygon: ring.into(), holes: Vec::new() });
            }
        }
        let (whole, far) = self.ground(origin, &mut map);
        bounds::by_edges(&mut map);
        let mut warnings = Vec::new();
        let unusable = || ImportWarning::new("lanes-dropped", sentences::lane_segments_unusable(broken));
        warnings.extend((broken > 0).then(unusable));
        warnings.extend((!whole).then(|| ImportWarning::new("edges-dropped", sentences::crossing_areas())));
        let far_areas =
            || ImportWarning::new("areas-dropped", sentences::areas_too_far(far, MAX_COORDINATE_M));
        warnings.extend((far > 0).then(far_areas));
        (map, warnings)
    }

    /// Adds the ground and its edges; returns whether edges were found, and how many areas exceed the limits
    /// of a scene.
    fn ground(&self, origin: Vec2, map: &mut LaneMap) -> (bool, usize) {
        let near = |line: &Vec<Vec2>| line.iter().all(|p| p.amax() <= MAX_COORDINATE_M);
        let mut areas: Vec<Vec<Vec2>> =
            self.drivable_areas.values().map(|area| about(&area.area_boundary, origin)).collect();
        areas.retain(near);
        let ways = map.lanes.iter().map(|lane| beyond(&lane.points.xy));
        let ways: Vec<Vec<Vec2>> = ways.filter(near).collect();
        let mut next = 0;
        let whole = surface::draw_areas(map, &areas, &ways, || {
            next += 1;
            format!("e{next}")
        });
        (whole, self.drivable_areas.len() - areas.len())
    }
}

/// A line extended a little at both ends.
fn beyond(line: &[Vec2]) -> Vec<Vec2> {
    let [first, second, ..] = line else { return line.to_vec() };
    let [.., before, last] = line else { return line.to_vec() };
    let unit = |v: Vec2| v / v.norm().max(1e-9);
    let (start, end) = (first - unit(second - first) * BEYOND_M, last + unit(last - before) * BEYOND_M);
    std::iter::once(start).chain(line.iter().copied()).chain(std::iter::once(end)).collect()
}

fn lane(segment: &Segment, origin: Vec2) -> Option<Lane> {
    let (left, right) =
        (about(&segment.left_lane_boundary, origin), about(&segment.right_lane_boundary, origin));
    if left.len() < 2 || right.len() < 2 {
        return None;
    }
    let longest = polyline::length(&left).max(polyline::length(&right));
    let count = (longest / SPACING_M).ceil().clamp(1.0, 1_000.0) as usize;
    let along = |line: &[Vec2]| -> Vec<Vec2> {
        let lengths = polyline::arc_lengths(line);
        let total = lengths.last().copied().unwrap_or(0.0);
        (0..=count).map(|i| polyline::point_at(line, &lengths, total * i as f64 / count as f64)).collect()
    };
    let sides: Vec<(Vec2, Vec2)> = along(&left).into_iter().zip(along(&right)).collect();
    let width_m = sides.iter().map(|(l, r)| (l - r).norm()).sum::<f64>() / sides.len() as f64;
    let mut points = about(&segment.centerline, origin);
    if points.len() < 2 {
        points = sides.iter().map(|(l, r)| (l + r) / 2.0).collect();
        points.dedup();
    }
    let lane_type = match segment.lane_type.as_str() {
        "BIKE" => LaneType::BikeLane,
        "BUS" => LaneType::BusLane,
        _ => LaneType::SurfaceStreet,
    };
    (points.len() > 1 && width_m.is_finite()).then(|| Lane {
        lane_type,
        width_m: Some(((width_m * 1e3).round() / 1e3).clamp(0.1, 50.0)),
        interpolating: segment.is_intersection,
        ..Lane::street(segment.id.to_string(), points)
    })
}

/// Links lanes that follow each other or lie side by side. The file has links to lanes that it does not
/// contain, and many links that only one of the two lanes has.
fn link(segments: &[&Segment], map: &mut LaneMap) {
    let index: HashMap<i64, usize> = segments.iter().enumerate().map(|(i, s)| (s.id, i)).collect();
    let add = |list: &mut Vec<String>, id: i64| {
        let id = id.to_string();
        if !list.contains(&id) {
            list.push(id);
        }
    };
    for (i, segment) in segments.iter().enumerate() {
        for (next, at) in segment.successors.iter().filter_map(|id| Some((*id, *index.get(id)?))) {
            add(&mut map.lanes[i].successors, next);
            add(&mut map.lanes[at].predecessors, segment.id);
        }
        for (before, at) in segment.predecessors.iter().filter_map(|id| Some((*id, *index.get(id)?))) {
            add(&mut map.lanes[i].predecessors, before);
            add(&mut map.lanes[at].successors, segment.id);
        }
        let beside = |other: Option<i64>| -> Vec<Neighbor> {
            let Some(&other) = other.and_then(|id| index.get(&id)).filter(|other| **other != i) else {
                return Vec::new();
            };
            let (own, its) = (&map.lanes[i].points.xy, &map.lanes[other].points.xy);
            let way = |line: &[Vec2]| line[line.len() - 1] - line[0];
            // The neighbour may be a lane of oncoming traffic.
            if way(own).dot(&way(its)) <= 0.0 {
                return Vec::new();
            }
            vec![Neighbor {
                lane: map.lanes[other].id.clone(),
                own_range: (0, own.len() - 1),
                other_range: (0, its.len() - 1),
                boundaries: Vec::new(),
            }]
        };
        let (left, right) = (beside(segment.left_neighbor_id), beside(segment.right_neighbor_id));
        let lane = &mut map.lanes[i];
        (lane.left_neighbors, lane.right_neighbors) = (left, right);
    }
}

/// Draws the painted sides of lanes, each once, and links them to the lanes that they bound.
fn paint(segments: &[&Segment], origin: Vec2, map: &mut LaneMap) {
    // A line is the side of two lanes: it is identified by its ends, in either order.
    let mut drawn: HashMap<[(i64, i64); 2], String> = HashMap::new();
    for (i, segment) in segments.iter().enumerate() {
        let sides = [
            (&segment.left_lane_boundary, &segment.left_lane_mark_type),
            (&segment.right_lane_boundary, &segment.right_lane_mark_type),
        ];
        for (side, (points, mark)) in sides.into_iter().enumerate() {
            let (points, Some(line_type)) = (about(points, origin), line_type(mark.as_deref())) else {
                continue;
            };
            let (Some(first), Some(last)) = (points.first(), points.last()) else { continue };
            let cell = |p: &Vec2| ((p.x / SAME_M).round() as i64, (p.y / SAME_M).round() as i64);
            let mut ends = [cell(first), cell(last)];
            ends.sort_unstable();
            let lane = &mut map.lanes[i];
            let id = drawn.entry(ends).or_insert_with(|| {
                let id = format!("{}.{}", lane.id, if side == 0 { "l" } else { "r" });
                let line = TypedLine { id: id.clone(), line_type: line_type.into(), points: points.into() };
                map.road_lines.push(line);
                id
            });
            let kind = ROAD_LINE_TYPES.iter().position(|word| *word == line_type);
            let kind = kind.and_then(|kind| u32::try_from(kind).ok());
            let to = lane.points.xy.len() - 1;
            let boundary = Boundary { line: id.clone(), from: 0, to, kind };
            if side == 0 { &mut lane.left_boundary } else { &mut lane.right_boundary }.push(boundary);
        }
    }
}
