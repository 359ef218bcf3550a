//! Lane maps: centre lines with their links, painted lines, edges, crosswalks and the like.

use crate::Vec2;
use crate::geometry::segments::Segment;
use serde::{Deserialize, Serialize};

/// A line or ring of points, metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Points {
    /// Corners in order.
    pub xy: Vec<Vec2>,
    /// Heights, parallel to `xy`, if the source has them.
    pub z_m: Option<Vec<f64>>,
}

impl From<Vec<Vec2>> for Points {
    fn from(xy: Vec<Vec2>) -> Self {
        Self { xy, z_m: None }
    }
}

/// Kind of a lane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum LaneType {
    #[default]
    Undefined,
    Freeway,
    SurfaceStreet,
    BikeLane,
    BusLane,
    Sidewalk,
    Parking,
}

impl LaneType {
    /// Width assumed if a lane gives none, metres.
    pub fn assumed_width_m(self) -> f64 {
        match self {
            Self::BikeLane => 1.8,
            Self::Sidewalk => 2.5,
            _ => 3.5,
        }
    }

    /// Whether motor vehicles drive here.
    pub fn carries_vehicles(self) -> bool {
        matches!(self, Self::Undefined | Self::Freeway | Self::SurfaceStreet | Self::BusLane)
    }

    /// Whether cyclists ride here.
    pub fn carries_cyclists(self) -> bool {
        matches!(self, Self::Undefined | Self::SurfaceStreet | Self::BikeLane | Self::BusLane)
    }
}

/// A stretch of a lane's side that is bounded by a road line or edge.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Boundary {
    /// Id of the road line or edge.
    pub line: String,
    /// First index of the lane's points that it bounds.
    pub from: usize,
    /// Last index of the lane's points that it bounds.
    pub to: usize,
    /// WOMD's boundary type number, kept for export.
    pub kind: Option<u32>,
}

/// A neighbouring lane, over ranges of point indices of both lanes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Neighbor {
    /// Id of the other lane.
    pub lane: String,
    /// First and last point index on this lane.
    pub own_range: (usize, usize),
    /// First and last point index on the other lane.
    pub other_range: (usize, usize),
    /// Lines between the two, with indices of the *other* lane as in the source.
    pub boundaries: Vec<Boundary>,
}

/// One lane.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Lane {
    pub id: String,
    pub lane_type: LaneType,
    /// Centre line in driving direction, at least two points.
    pub points: Points,
    pub width_m: Option<f64>,
    pub left_boundary: Vec<Boundary>,
    pub right_boundary: Vec<Boundary>,
    pub speed_limit_mps: Option<f64>,
    pub predecessors: Vec<String>,
    pub successors: Vec<String>,
    pub left_neighbors: Vec<Neighbor>,
    pub right_neighbors: Vec<Neighbor>,
    /// Whether it connects two lanes through a junction.
    pub interpolating: bool,
}

impl Lane {
    /// A street of which only the centre line is known.
    pub fn street(id: impl Into<String>, points: impl Into<Points>) -> Self {
        Self {
            id: id.into(),
            lane_type: LaneType::SurfaceStreet,
            points: points.into(),
            width_m: None,
            left_boundary: Vec::new(),
            right_boundary: Vec::new(),
            speed_limit_mps: None,
            predecessors: Vec::new(),
            successors: Vec::new(),
            left_neighbors: Vec::new(),
            right_neighbors: Vec::new(),
            interpolating: false,
        }
    }

    /// Width; assumed from the type if the source gives none, metres.
    pub fn width_or_assumed_m(&self) -> f64 {
        self.width_m.unwrap_or_else(|| self.lane_type.assumed_width_m())
    }
}

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

/// A line with a type in the source's words (WOMD's names in snake case).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct TypedLine {
    pub id: String,
    /// Such as `broken_single_white`, `boundary`, `median`, `sidewalk`.
    pub line_type: String,
    pub points: Points,
}

/// A closed area: crosswalk, speed bump, driveway.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Area {
    pub id: String,
    /// Open ring.
    pub polygon: Points,
    /// Holes, each an open ring; only drivable areas have them.
    pub holes: Vec<Points>,
}

impl Area {
    /// Whether the point lies inside the outer ring, or at most `beside_m` from it.
    pub fn is_near(&self, point: Vec2, beside_m: f64) -> bool {
        let ring = &self.polygon.xy;
        let mut inside = false;
        let mut beside = false;
        for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let side = Segment { from: *from, to: *to, owner: 0, piece: 0 };
            beside |= (side.foot(point) - point).norm() <= beside_m;
            let spans = (from.y > point.y) != (to.y > point.y);
            inside ^= spans && point.x < from.x + (to.x - from.x) * (point.y - from.y) / (to.y - from.y);
        }
        inside || beside
    }
}

/// A stop sign and the lanes that obey it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct StopSign {
    pub id: String,
    pub position: Vec2,
    pub z_m: Option<f64>,
    pub lanes: Vec<String>,
}

/// The map of a scene: lanes, lines, edges, areas and stop signs. Scenes share it ([`crate::Shared`]).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct LaneMap {
    pub lanes: Vec<Lane>,
    pub road_lines: Vec<TypedLine>,
    pub road_edges: Vec<TypedLine>,
    pub crosswalks: Vec<Area>,
    pub speed_bumps: Vec<Area>,
    pub driveways: Vec<Area>,
    pub stop_signs: Vec<StopSign>,
    pub drivable: Vec<Area>,
}

impl LaneMap {
    /// Position of a lane in [`LaneMap::lanes`].
    pub fn lane_index(&self, id: &str) -> Option<usize> {
        self.lanes.iter().position(|l| l.id == id)
    }

    /// All its lines and areas, each with whether it is closed.
    pub fn outlines(&self) -> impl Iterator<Item = (&[Vec2], bool)> {
        let lines = self.road_lines.iter().chain(&self.road_edges).map(|line| &line.points);
        let open = self.lanes.iter().map(|lane| &lane.points).chain(lines).map(|line| (&*line.xy, false));
        let rings = self.areas().flat_map(|area| std::iter::once(&area.polygon).chain(&area.holes));
        open.chain(rings.map(|ring| (&*ring.xy, true)))
    }

    /// All its areas of every kind.
    pub fn areas(&self) -> impl Iterator<Item = &Area> {
        [&self.crosswalks, &self.speed_bumps, &self.driveways, &self.drivable].into_iter().flatten()
    }

    /// The mirror image: y negated, left and right swapped. Right-hand traffic becomes left-hand traffic.
    pub fn mirrored(&self) -> Self {
        let point = |p: Vec2| Vec2::new(p.x, -p.y);
        let points = |line: &Points| Points {
            xy: line.xy.iter().copied().map(point).collect(),
            z_m: line.z_m.clone(),
        };
        let lines = |list: &[TypedLine]| {
            list.iter().map(|l| TypedLine { points: points(&l.points), ..l.clone() }).collect()
        };
        let areas = |list: &[Area]| {
            let area = |a: &Area| Area {
                id: a.id.clone(),
                polygon: points(&a.polygon),
                holes: a.holes.iter().map(points).collect(),
            };
            list.iter().map(area).collect()
        };
        let lane = |l: &Lane| Lane {
            points: points(&l.points),
            left_boundary: l.right_boundary.clone(),
            right_boundary: l.left_boundary.clone(),
            left_neighbors: l.right_neighbors.clone(),
            right_neighbors: l.left_neighbors.clone(),
            ..l.clone()
        };
        let sign = |s: &StopSign| StopSign { position: point(s.position), ..s.clone() };
        Self {
            lanes: self.lanes.iter().map(lane).collect(),
            road_lines: lines(&self.road_lines),
            road_edges: lines(&self.road_edges),
            crosswalks: areas(&self.crosswalks),
            speed_bumps: areas(&self.speed_bumps),
            driveways: areas(&self.driveways),
            stop_signs: self.stop_signs.iter().map(sign).collect(),
            drivable: areas(&self.drivable),
        }
    }
}
