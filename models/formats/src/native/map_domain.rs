//! Converts map documents to the domain's lane map and back.

use super::map::{
    AreaDoc, BoundaryDoc, DrivableDoc, LaneDoc, MapDoc, MapField, MapRef, NeighborDoc, RoadEdgeDoc,
    RoadLineDoc, StopSignDoc,
};
use super::value::{PointDoc, PointsDoc};
use crate::limits::MAX_POLYLINES;
use crate::problem::{FieldProblem, Problems, ReadError, code};
use crate::refusals::{self, shown, wanted, what};
use scene::map::{Area, Boundary, Lane, Neighbor, StopSign, TypedLine};
use scene::sentences::wanted::ID_CHARACTERS;
use scene::{ContentHash, LaneMap, Shared};
use std::collections::HashSet;

impl MapField {
    /// The map itself; `resolve` returns the map of a hash.
    pub(crate) fn into_map(
        self,
        resolve: impl FnOnce(&ContentHash) -> Option<Shared<LaneMap>>,
    ) -> Result<Shared<LaneMap>, ReadError> {
        match self {
            Self::Inline(map) => map.into_map().map(Shared::from),
            Self::Ref(MapRef { hash }) => {
                let found = hash.strip_prefix("sha256:").and_then(ContentHash::from_hex);
                let Some(key) = found else {
                    let message = refusals::expected(wanted::HEX);
                    return Err(FieldProblem::new("/map/ref", code::INVALID_FIELD, message).into());
                };
                resolve(&key).ok_or_else(|| {
                    FieldProblem::new("/map/ref", code::UNKNOWN_MAP, refusals::unknown_map()).into()
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
                let message = refusals::found_one_of(&shown(word), &list.join(", "));
                problems.invalid(format!("/map/{kind}/{i}/type"), message);
            }
        };
        for (i, line) in self.road_lines.iter().enumerate() {
            check("road_lines", i, &line.line_type, &scene::map::ROAD_LINE_TYPES);
        }
        for (i, edge) in self.road_edges.iter().enumerate() {
            check("road_edges", i, &edge.line_type, &scene::map::ROAD_EDGE_TYPES);
        }
        self.check_counts(&mut problems);
        self.check_sign_ids(&mut problems);
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

    /// Lists are cut one past the limit while they are parsed, so a longer one must not pass.
    fn check_counts(&self, problems: &mut Problems) {
        let counts = [
            ("lanes", self.lanes.len()),
            ("road_lines", self.road_lines.len()),
            ("road_edges", self.road_edges.len()),
            ("crosswalks", self.crosswalks.len()),
            ("speed_bumps", self.speed_bumps.len()),
            ("driveways", self.driveways.len()),
            ("stop_signs", self.stop_signs.len()),
            ("drivable", self.drivable.len()),
        ];
        for (kind, _) in counts.into_iter().filter(|(_, count)| *count > MAX_POLYLINES) {
            let message = refusals::more_than(MAX_POLYLINES, what::ENTRIES);
            problems.push(FieldProblem::new(format!("/map/{kind}"), code::MAP_TOO_LARGE, message));
        }
    }

    /// Checks ids of stop signs, which `Scene::checked` does not check.
    fn check_sign_ids(&self, problems: &mut Problems) {
        let mut seen = HashSet::new();
        for (i, sign) in self.stop_signs.iter().enumerate() {
            let legal = |c: char| c.is_ascii_alphanumeric() || "_.:-".contains(c);
            let pointer = format!("/map/stop_signs/{i}/id");
            if sign.id.is_empty() || sign.id.len() > 64 || !sign.id.chars().all(legal) {
                problems.invalid(pointer, refusals::expected(ID_CHARACTERS));
            } else if !seen.insert(&sign.id) {
                let message = refusals::appears_twice(what::ID, &sign.id);
                problems.push(FieldProblem::new(pointer, code::DUPLICATE, message));
            }
        }
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
