//! The map part of a scene document.

use super::value::{PointDoc, PointsDoc, words};
use crate::problem::{FieldProblem, Problems, ReadError, code};
use scene::map::{Area, Boundary, Lane, LaneType, Neighbor, StopSign, TypedLine};
use scene::{ContentHash, LaneMap};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Words for the type of a road line, in the order of WOMD's numbers.
pub const ROAD_LINE_TYPES: [&str; 9] = [
    "unknown",
    "broken_single_white",
    "solid_single_white",
    "solid_double_white",
    "broken_single_yellow",
    "broken_double_yellow",
    "solid_single_yellow",
    "solid_double_yellow",
    "passing_double_yellow",
];
/// Words for the type of a road edge: WOMD's, in the order of its numbers, then our own.
pub const ROAD_EDGE_TYPES: [&str; 4] = ["unknown", "boundary", "median", "sidewalk"];

fn lane_types(_: &mut SchemaGenerator) -> Schema {
    words(&["undefined", "freeway", "surface_street", "bike_lane", "bus_lane", "sidewalk", "parking"])
}

fn line_types(_: &mut SchemaGenerator) -> Schema {
    words(&ROAD_LINE_TYPES)
}

fn edge_types(_: &mut SchemaGenerator) -> Schema {
    words(&ROAD_EDGE_TYPES)
}

/// A stretch of a lane's side and the line or edge that bounds it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryDoc {
    /// Id of the road line or edge.
    #[serde(rename = "ref")]
    pub line: String,
    /// First point index.
    pub from: u32,
    /// Last point index.
    pub to: u32,
    /// WOMD's boundary type number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<u32>,
}

/// A lane beside this one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NeighborDoc {
    /// Id of the other lane.
    pub lane: String,
    /// First and last point index on this lane.
    #[serde(rename = "self")]
    pub own: [u32; 2],
    /// First and last point index on the other lane.
    pub other: [u32; 2],
    /// Lines between the two, over the other lane's indices.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub boundaries: Vec<BoundaryDoc>,
}

/// One lane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LaneDoc {
    /// Unique among lanes, `[A-Za-z0-9_.:-]{1,64}`.
    pub id: String,
    /// Kind of lane.
    #[serde(rename = "type", default)]
    #[schemars(schema_with = "lane_types")]
    pub lane_type: LaneType,
    /// Centre line in driving direction, at least two points.
    pub points_m: PointsDoc,
    /// Metres; assumed by type when absent.
    #[serde(default)]
    #[schemars(range(min = 0.1, max = 50.0))]
    pub width_m: Option<f64>,
    /// Lines on the left.
    #[serde(default)]
    pub left_boundary: Vec<BoundaryDoc>,
    /// Lines on the right.
    #[serde(default)]
    pub right_boundary: Vec<BoundaryDoc>,
    /// m/s.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub speed_limit_mps: Option<f64>,
    /// Ids of lanes that lead here.
    #[serde(default)]
    pub predecessors: Vec<String>,
    /// Ids of lanes that this one leads to.
    #[serde(default)]
    pub successors: Vec<String>,
    /// Lanes on the left.
    #[serde(default)]
    pub left_neighbors: Vec<NeighborDoc>,
    /// Lanes on the right.
    #[serde(default)]
    pub right_neighbors: Vec<NeighborDoc>,
    /// Leads through a junction between two lanes.
    #[serde(default)]
    pub interpolating: bool,
}

/// A painted line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoadLineDoc {
    /// Unique among road lines.
    pub id: String,
    /// WOMD's name in snake case.
    #[serde(rename = "type", default = "unknown")]
    #[schemars(schema_with = "line_types")]
    pub line_type: String,
    /// In order.
    pub points_m: PointsDoc,
}

/// The end of the road's surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoadEdgeDoc {
    /// Unique among road edges.
    pub id: String,
    /// WOMD's name in snake case, or `sidewalk`.
    #[serde(rename = "type", default = "unknown")]
    #[schemars(schema_with = "edge_types")]
    pub line_type: String,
    /// In order.
    pub points_m: PointsDoc,
}

fn unknown() -> String {
    "unknown".into()
}

/// A crosswalk, speed bump or driveway.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaDoc {
    /// Unique among areas of the kind.
    pub id: String,
    /// Open ring.
    pub polygon_m: PointsDoc,
}

/// A surface that may be driven on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrivableDoc {
    /// Unique among drivable areas.
    pub id: String,
    /// Open ring.
    pub polygon_m: PointsDoc,
    /// Open rings that are not drivable.
    #[serde(default)]
    pub holes_m: Vec<PointsDoc>,
}

/// A stop sign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopSignDoc {
    /// Unique among stop signs.
    pub id: String,
    /// Where it stands.
    pub position_m: PointDoc,
    /// Ids of lanes that obey it.
    #[serde(default)]
    pub lanes: Vec<String>,
}

/// Everything that does not move.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MapDoc {
    /// Lanes with their links.
    pub lanes: Vec<LaneDoc>,
    /// Painted lines.
    pub road_lines: Vec<RoadLineDoc>,
    /// Ends of the road's surface.
    pub road_edges: Vec<RoadEdgeDoc>,
    /// Crosswalks.
    pub crosswalks: Vec<AreaDoc>,
    /// Speed bumps.
    pub speed_bumps: Vec<AreaDoc>,
    /// Driveways.
    pub driveways: Vec<AreaDoc>,
    /// Stop signs.
    pub stop_signs: Vec<StopSignDoc>,
    /// Surfaces that may be driven on.
    pub drivable: Vec<DrivableDoc>,
}

/// A map, or the hash of one that the reader knows already.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "MapWire", untagged)]
pub enum MapField {
    /// `{"ref":"sha256:HEX"}`.
    Ref(MapRef),
    /// The map itself.
    Inline(MapDoc),
}

impl JsonSchema for MapField {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "MapField".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (by_hash, inline) = (generator.subschema_for::<MapRef>(), generator.subschema_for::<MapDoc>());
        schemars::json_schema!({"description": "A map, or the hash of one.", "anyOf": [by_hash, inline]})
    }
}

/// Names a map by its content.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapRef {
    /// `sha256:` and 64 hex digits, see `scene::LaneMap::hash`.
    #[serde(rename = "ref")]
    #[schemars(regex(pattern = r"^sha256:[0-9a-f]{64}$"))]
    pub hash: String,
}

/// Both forms in one struct, so that a map is read in one pass (serde would buffer an untagged enum).
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct MapWire {
    #[serde(rename = "ref")]
    reference: Option<String>,
    lanes: Vec<LaneDoc>,
    road_lines: Vec<RoadLineDoc>,
    road_edges: Vec<RoadEdgeDoc>,
    crosswalks: Vec<AreaDoc>,
    speed_bumps: Vec<AreaDoc>,
    driveways: Vec<AreaDoc>,
    stop_signs: Vec<StopSignDoc>,
    drivable: Vec<DrivableDoc>,
}

impl TryFrom<MapWire> for MapField {
    type Error = &'static str;

    fn try_from(wire: MapWire) -> Result<Self, &'static str> {
        let map = MapDoc {
            lanes: wire.lanes,
            road_lines: wire.road_lines,
            road_edges: wire.road_edges,
            crosswalks: wire.crosswalks,
            speed_bumps: wire.speed_bumps,
            driveways: wire.driveways,
            stop_signs: wire.stop_signs,
            drivable: wire.drivable,
        };
        match wire.reference {
            None => Ok(Self::Inline(map)),
            Some(hash) if map == MapDoc::default() => Ok(Self::Ref(MapRef { hash })),
            Some(_) => Err("a map has either `ref` or its own members, not both"),
        }
    }
}

impl MapField {
    /// The map itself; `resolve` looks a hash up.
    pub(crate) fn into_map(
        self,
        resolve: impl FnOnce(&ContentHash) -> Option<Arc<LaneMap>>,
    ) -> Result<Arc<LaneMap>, ReadError> {
        match self {
            Self::Inline(map) => map.into_map().map(Arc::new),
            Self::Ref(MapRef { hash }) => {
                let found = hash.strip_prefix("sha256:").and_then(ContentHash::from_hex);
                let Some(key) = found else {
                    let detail = "\"sha256:\" and 64 hex digits expected";
                    return Err(FieldProblem::new("/map/ref", code::INVALID_FIELD, detail).into());
                };
                resolve(&key).ok_or_else(|| {
                    let detail = "no map with this hash is known here; send the map itself";
                    FieldProblem::new("/map/ref", code::UNKNOWN_MAP, detail).into()
                })
            }
        }
    }
}

impl MapDoc {
    /// The domain's map. Limits are left to `Scene::checked`.
    ///
    /// # Errors
    /// `invalid-field` for a line type that is not in the list.
    pub fn into_map(self) -> Result<LaneMap, ReadError> {
        let mut problems = Problems::default();
        let mut check = |kind: &str, i: usize, word: &str, list: &[&str]| {
            if !list.contains(&word) {
                let shown: String = word.chars().take(40).collect();
                let detail = format!("\"{shown}\" found, one of {} expected", list.join(", "));
                problems.invalid(format!("/map/{kind}/{i}/type"), detail);
            }
        };
        for (i, line) in self.road_lines.iter().enumerate() {
            check("road_lines", i, &line.line_type, &ROAD_LINE_TYPES);
        }
        for (i, edge) in self.road_edges.iter().enumerate() {
            check("road_edges", i, &edge.line_type, &ROAD_EDGE_TYPES);
        }
        if !problems.0.is_empty() {
            return Err(ReadError::invalid(problems.0));
        }
        let areas = |list: Vec<AreaDoc>| list.into_iter().map(Area::from).collect();
        Ok(LaneMap {
            lanes: self.lanes.into_iter().map(Lane::from).collect(),
            road_lines: self
                .road_lines
                .into_iter()
                .map(|l| TypedLine { id: l.id, line_type: l.line_type, points: l.points_m.0 })
                .collect(),
            road_edges: self
                .road_edges
                .into_iter()
                .map(|l| TypedLine { id: l.id, line_type: l.line_type, points: l.points_m.0 })
                .collect(),
            crosswalks: areas(self.crosswalks),
            speed_bumps: areas(self.speed_bumps),
            driveways: areas(self.driveways),
            stop_signs: self
                .stop_signs
                .into_iter()
                .map(|s| StopSign {
                    id: s.id,
                    position: s.position_m.xy(),
                    z_m: s.position_m.z,
                    lanes: s.lanes,
                })
                .collect(),
            drivable: self
                .drivable
                .into_iter()
                .map(|d| Area {
                    id: d.id,
                    polygon: d.polygon_m.0,
                    holes: d.holes_m.into_iter().map(|h| h.0).collect(),
                })
                .collect(),
        })
    }

    /// The document of a domain map.
    pub fn from_map(map: &LaneMap) -> Self {
        let areas = |list: &[Area]| -> Vec<AreaDoc> {
            list.iter()
                .map(|a| AreaDoc { id: a.id.clone(), polygon_m: PointsDoc(a.polygon.clone()) })
                .collect()
        };
        Self {
            lanes: map.lanes.iter().map(LaneDoc::from).collect(),
            road_lines: map
                .road_lines
                .iter()
                .map(|l| RoadLineDoc {
                    id: l.id.clone(),
                    line_type: l.line_type.clone(),
                    points_m: PointsDoc(l.points.clone()),
                })
                .collect(),
            road_edges: map
                .road_edges
                .iter()
                .map(|l| RoadEdgeDoc {
                    id: l.id.clone(),
                    line_type: l.line_type.clone(),
                    points_m: PointsDoc(l.points.clone()),
                })
                .collect(),
            crosswalks: areas(&map.crosswalks),
            speed_bumps: areas(&map.speed_bumps),
            driveways: areas(&map.driveways),
            stop_signs: map
                .stop_signs
                .iter()
                .map(|s| StopSignDoc {
                    id: s.id.clone(),
                    position_m: PointDoc::new(s.position, s.z_m),
                    lanes: s.lanes.clone(),
                })
                .collect(),
            drivable: map
                .drivable
                .iter()
                .map(|d| DrivableDoc {
                    id: d.id.clone(),
                    polygon_m: PointsDoc(d.polygon.clone()),
                    holes_m: d.holes.iter().cloned().map(PointsDoc).collect(),
                })
                .collect(),
        }
    }
}

fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

impl From<AreaDoc> for Area {
    fn from(doc: AreaDoc) -> Self {
        Self { id: doc.id, polygon: doc.polygon_m.0, holes: Vec::new() }
    }
}

impl From<BoundaryDoc> for Boundary {
    fn from(doc: BoundaryDoc) -> Self {
        Self { line: doc.line, from: doc.from as usize, to: doc.to as usize, kind: doc.kind }
    }
}

impl From<&Boundary> for BoundaryDoc {
    fn from(b: &Boundary) -> Self {
        Self { line: b.line.clone(), from: index(b.from), to: index(b.to), kind: b.kind }
    }
}

impl From<NeighborDoc> for Neighbor {
    fn from(doc: NeighborDoc) -> Self {
        let pair = |[a, b]: [u32; 2]| (a as usize, b as usize);
        Self {
            lane: doc.lane,
            own_range: pair(doc.own),
            other_range: pair(doc.other),
            boundaries: doc.boundaries.into_iter().map(Boundary::from).collect(),
        }
    }
}

impl From<&Neighbor> for NeighborDoc {
    fn from(n: &Neighbor) -> Self {
        let pair = |(a, b): (usize, usize)| [index(a), index(b)];
        Self {
            lane: n.lane.clone(),
            own: pair(n.own_range),
            other: pair(n.other_range),
            boundaries: n.boundaries.iter().map(BoundaryDoc::from).collect(),
        }
    }
}

impl From<LaneDoc> for Lane {
    fn from(doc: LaneDoc) -> Self {
        let boundaries = |list: Vec<BoundaryDoc>| list.into_iter().map(Boundary::from).collect();
        let neighbors = |list: Vec<NeighborDoc>| list.into_iter().map(Neighbor::from).collect();
        Self {
            id: doc.id,
            lane_type: doc.lane_type,
            points: doc.points_m.0,
            width_m: doc.width_m,
            left_boundary: boundaries(doc.left_boundary),
            right_boundary: boundaries(doc.right_boundary),
            speed_limit_mps: doc.speed_limit_mps,
            predecessors: doc.predecessors,
            successors: doc.successors,
            left_neighbors: neighbors(doc.left_neighbors),
            right_neighbors: neighbors(doc.right_neighbors),
            interpolating: doc.interpolating,
        }
    }
}

impl From<&Lane> for LaneDoc {
    fn from(lane: &Lane) -> Self {
        let boundaries = |list: &[Boundary]| list.iter().map(BoundaryDoc::from).collect();
        let neighbors = |list: &[Neighbor]| list.iter().map(NeighborDoc::from).collect();
        Self {
            id: lane.id.clone(),
            lane_type: lane.lane_type,
            points_m: PointsDoc(lane.points.clone()),
            width_m: lane.width_m,
            left_boundary: boundaries(&lane.left_boundary),
            right_boundary: boundaries(&lane.right_boundary),
            speed_limit_mps: lane.speed_limit_mps,
            predecessors: lane.predecessors.clone(),
            successors: lane.successors.clone(),
            left_neighbors: neighbors(&lane.left_neighbors),
            right_neighbors: neighbors(&lane.right_neighbors),
            interpolating: lane.interpolating,
        }
    }
}
