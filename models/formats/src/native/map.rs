//! The map part of a scene document.

use super::value::{PointDoc, PointsDoc, id, words};
use crate::limits::MAX_POLYLINES;
use crate::lists::{bounded, capped};
use scene::map::LaneType;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize};

/// One more than the limit of a map, so that longer lists are refused however long they are.
const LINES: usize = MAX_POLYLINES + 1;
/// Most links, neighbours or boundaries of one lane.
const LINKS: usize = 4_096;

fn lane_types(_: &mut SchemaGenerator) -> Schema {
    words(&["undefined", "freeway", "surface_street", "bike_lane", "bus_lane", "sidewalk", "parking"])
}

fn line_types(_: &mut SchemaGenerator) -> Schema {
    words(&scene::map::ROAD_LINE_TYPES)
}

fn edge_types(_: &mut SchemaGenerator) -> Schema {
    words(&scene::map::ROAD_EDGE_TYPES)
}

/// A section of a lane's side, with the road line or edge that bounds it.
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
    /// Id, unique among lanes, `[A-Za-z0-9_.:-]{1,64}`.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// Kind of lane.
    #[serde(rename = "type", default)]
    #[schemars(schema_with = "lane_types")]
    pub lane_type: LaneType,
    /// Centre line in driving direction, at least two points.
    #[schemars(extend("minItems" = 2))]
    pub points_m: PointsDoc,
    /// Width, metres; assumed by type when absent.
    #[serde(default)]
    #[schemars(range(min = 0.1, max = 50.0))]
    pub width_m: Option<f64>,
    /// Lines on the left.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub left_boundary: Vec<BoundaryDoc>,
    /// Lines on the right.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub right_boundary: Vec<BoundaryDoc>,
    /// m/s.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub speed_limit_mps: Option<f64>,
    /// Ids of lanes that lead to this one.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub predecessors: Vec<String>,
    /// Ids of lanes that this one leads to.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub successors: Vec<String>,
    /// Lanes on the left.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub left_neighbors: Vec<NeighborDoc>,
    /// Lanes on the right.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub right_neighbors: Vec<NeighborDoc>,
    /// Whether it connects two lanes through a junction.
    #[serde(default)]
    pub interpolating: bool,
}

/// A painted line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoadLineDoc {
    /// Id, unique among road lines.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// WOMD's name in snake case.
    #[serde(rename = "type", default = "unknown")]
    #[schemars(schema_with = "line_types")]
    pub line_type: String,
    /// Points in order.
    #[schemars(extend("minItems" = 1))]
    pub points_m: PointsDoc,
}

/// An edge of the road surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoadEdgeDoc {
    /// Id, unique among road edges.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// WOMD's name in snake case, or `sidewalk`.
    #[serde(rename = "type", default = "unknown")]
    #[schemars(schema_with = "edge_types")]
    pub line_type: String,
    /// Points in order.
    #[schemars(extend("minItems" = 1))]
    pub points_m: PointsDoc,
}

fn unknown() -> String {
    "unknown".into()
}

/// A crosswalk, speed bump or driveway.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaDoc {
    /// Id, unique among areas of the kind.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// Open ring.
    #[schemars(extend("minItems" = 1))]
    pub polygon_m: PointsDoc,
}

/// A drivable surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrivableDoc {
    /// Id, unique among drivable areas.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// Open ring.
    #[schemars(extend("minItems" = 1))]
    pub polygon_m: PointsDoc,
    /// Open rings that are not drivable.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub holes_m: Vec<PointsDoc>,
}

/// A stop sign.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopSignDoc {
    /// Id, unique among stop signs.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// Position of the sign.
    pub position_m: PointDoc,
    /// Ids of lanes that obey it.
    #[serde(default, deserialize_with = "bounded::<_, _, LINKS>")]
    pub lanes: Vec<String>,
}

/// The map of a scene: lanes, lines, edges, areas and stop signs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MapDoc {
    /// Lanes with their links.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub lanes: Vec<LaneDoc>,
    /// Painted lines.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub road_lines: Vec<RoadLineDoc>,
    /// Edges of the road surface.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub road_edges: Vec<RoadEdgeDoc>,
    /// Crosswalks.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub crosswalks: Vec<AreaDoc>,
    /// Speed bumps.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub speed_bumps: Vec<AreaDoc>,
    /// Driveways.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub driveways: Vec<AreaDoc>,
    /// Stop signs.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub stop_signs: Vec<StopSignDoc>,
    /// Drivable surfaces.
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    pub drivable: Vec<DrivableDoc>,
}

/// A map, or the hash of a map that the reader already has.
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

/// Reference to a map by its content hash.
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
    #[serde(rename = "ref", deserialize_with = "given")]
    reference: Option<String>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    lanes: Vec<LaneDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    road_lines: Vec<RoadLineDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    road_edges: Vec<RoadEdgeDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    crosswalks: Vec<AreaDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    speed_bumps: Vec<AreaDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    driveways: Vec<AreaDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    stop_signs: Vec<StopSignDoc>,
    #[serde(deserialize_with = "capped::<_, _, LINES>")]
    drivable: Vec<DrivableDoc>,
}

/// A present member is not null: null must not become an empty map.
fn given<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
    String::deserialize(deserializer).map(Some)
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
