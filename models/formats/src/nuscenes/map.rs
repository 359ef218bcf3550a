//! The map expansion: lanes with their connections, crosswalks, dividers and drivable areas.

use super::arcs::{self, ArcPath};
use crate::polyline::{length, ring_area_m2, simplify};
use crate::problem::{ImportWarning, ReadError};
use crate::repairs;
use crate::sentences::{self, subject};
use crate::settle::Ids;
use crate::source::without_mark;
use scene::Shared;
use scene::Vec2;
use scene::map::{Area, Lane, LaneMap, LaneType, Points, TypedLine};
use serde::Deserialize;
use std::collections::HashMap;

/// Range of lane widths, metres.
const WIDTHS_M: (f64, f64) = (1.5, 8.0);
/// Tolerance of simplified lines and areas, and greatest length of their pieces, metres.
const KEPT_M: (f64, f64) = (0.02, 40.0);

#[derive(Deserialize)]
struct NodeRow {
    token: String,
    x: f64,
    y: f64,
}

#[derive(Deserialize)]
struct HoleRow {
    #[serde(default)]
    node_tokens: Vec<String>,
}

#[derive(Deserialize)]
struct PolygonRow {
    token: String,
    #[serde(default)]
    exterior_node_tokens: Vec<String>,
    #[serde(default)]
    holes: Vec<HoleRow>,
}

#[derive(Deserialize)]
struct LineRow {
    token: String,
    #[serde(default)]
    node_tokens: Vec<String>,
}

/// A lane, a crosswalk or a drivable area.
#[derive(Deserialize)]
struct AreaRow {
    token: String,
    polygon_token: Option<String>,
    #[serde(default)]
    polygon_tokens: Vec<String>,
    lane_type: Option<String>,
}

#[derive(Deserialize)]
struct DividerRow {
    token: String,
    #[serde(default)]
    line_token: String,
}

#[derive(Default, Deserialize)]
struct LinksRow {
    #[serde(default)]
    incoming: Vec<String>,
    #[serde(default)]
    outgoing: Vec<String>,
}

/// A map expansion.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Expansion {
    node: Vec<NodeRow>,
    polygon: Vec<PolygonRow>,
    line: Vec<LineRow>,
    lane: Vec<AreaRow>,
    lane_connector: Vec<AreaRow>,
    ped_crossing: Vec<AreaRow>,
    drivable_area: Vec<AreaRow>,
    road_divider: Vec<DividerRow>,
    lane_divider: Vec<DividerRow>,
    connectivity: HashMap<String, LinksRow>,
    arcline_path_3: HashMap<String, Vec<ArcPath>>,
}

impl Expansion {
    /// # Errors
    /// `malformed-json` with the file.
    pub fn read(bytes: &[u8], name: &str) -> Result<Self, ReadError> {
        serde_json::from_slice(without_mark(bytes))
            .map_err(|error| ReadError::malformed_json(&error, error.to_string()).under(&format!("/{name}")))
    }

    /// The map, with its origin at a position of the file.
    pub fn map(&self, origin: Vec2) -> (LaneMap, Vec<ImportWarning>) {
        let place = |node: &NodeRow| Vec2::new(node.x, node.y) - origin;
        let nodes: HashMap<&str, Vec2> = (self.node.iter())
            .filter(|node| node.x.is_finite() && node.y.is_finite())
            .map(|node| (node.token.as_str(), place(node)))
            .collect();
        let line = |tokens: &[String]| -> Vec<Vec2> {
            let points: Vec<Vec2> =
                tokens.iter().filter_map(|token| nodes.get(token.as_str()).copied()).collect();
            if points.len() > 2 { simplify(&points, KEPT_M.0, KEPT_M.1) } else { points }
        };
        let polygons: HashMap<&str, &PolygonRow> =
            self.polygon.iter().map(|row| (row.token.as_str(), row)).collect();
        let lines: HashMap<&str, &LineRow> = self.line.iter().map(|row| (row.token.as_str(), row)).collect();
        let (mut ids, mut dropped) = (Ids::default(), 0);
        let mut map = LaneMap::default();
        let mut lanes: HashMap<&str, String> = HashMap::new();
        let all = self.lane.iter().map(|row| (row, false));
        for (row, connects) in all.chain(self.lane_connector.iter().map(|row| (row, true))) {
            let path = self.arcline_path_3.get(&row.token).and_then(|paths| arcs::points(paths));
            let Some(mut points) = path.filter(|_| !lanes.contains_key(row.token.as_str())) else {
                dropped += 1;
                continue;
            };
            points.iter_mut().for_each(|p| *p -= origin);
            let ring = row.polygon_token.as_deref().and_then(|token| polygons.get(token));
            let ring = ring.map(|row| line(&row.exterior_node_tokens)).filter(|ring| ring.len() > 2);
            let width_m =
                ring.map(|ring| (ring_area_m2(&ring) / length(&points)).clamp(WIDTHS_M.0, WIDTHS_M.1));
            let rides = row.lane_type.as_deref().is_some_and(|kind| kind.eq_ignore_ascii_case("BIKE"));
            let id = ids.take(&row.token);
            lanes.insert(&row.token, id.clone());
            map.lanes.push(Lane {
                lane_type: if rides { LaneType::BikeLane } else { LaneType::SurfaceStreet },
                width_m: width_m.map(|width| (width * 1e3).round() / 1e3),
                interpolating: connects,
                ..Lane::street(id, points)
            });
        }
        self.link(&mut map, &lanes);
        for row in &self.ped_crossing {
            let ring = row.polygon_token.as_deref().and_then(|token| polygons.get(token));
            let ring = ring.map(|row| line(&row.exterior_node_tokens)).filter(|ring| ring.len() > 2);
            let area =
                |ring: Vec<Vec2>| Area { id: ids.take(&row.token), polygon: ring.into(), holes: Vec::new() };
            map.crosswalks.extend(ring.map(area));
        }
        for row in &self.drivable_area {
            for polygon in row.polygon_tokens.iter().filter_map(|token| polygons.get(token.as_str())) {
                let ring = line(&polygon.exterior_node_tokens);
                if ring.len() < 3 {
                    continue;
                }
                let holes = polygon.holes.iter().map(|hole| line(&hole.node_tokens));
                let holes: Vec<Points> = holes.filter(|hole| hole.len() > 2).map(Points::from).collect();
                map.drivable.push(Area { id: ids.take(&polygon.token), polygon: ring.into(), holes });
            }
        }
        for row in self.road_divider.iter().chain(&self.lane_divider) {
            let points = lines.get(row.line_token.as_str()).map(|row| line(&row.node_tokens));
            let Some(points) = points.filter(|points| points.len() > 1) else { continue };
            // The expansion has the positions of dividers, not their kind of paint.
            let line_type = "unknown".to_owned();
            map.road_lines.push(TypedLine { id: ids.take(&row.token), line_type, points: points.into() });
        }
        let mut warnings = Vec::new();
        let message = || sentences::lanes_without_line(dropped);
        warnings.extend((dropped > 0).then(|| ImportWarning::new("lanes-dropped", message())));
        warnings.extend(ids.warning(subject::MAP_FEATURES));
        let mut map = Shared::from(map);
        warnings.extend(repairs::drop_far_links(&mut map));
        (LaneMap::clone(&map), warnings)
    }

    fn link(&self, map: &mut LaneMap, ids: &HashMap<&str, String>) {
        let mut tokens: Vec<(&str, &String)> = ids.iter().map(|(token, id)| (*token, id)).collect();
        tokens.sort_unstable();
        let by_id: HashMap<String, usize> =
            map.lanes.iter().enumerate().map(|(i, lane)| (lane.id.clone(), i)).collect();
        let mut links: Vec<(usize, usize)> = Vec::new();
        for (token, id) in tokens {
            let Some(row) = self.connectivity.get(token) else { continue };
            let at = |token: &String| by_id.get(ids.get(token.as_str())?).copied();
            let Some(own) = by_id.get(id).copied() else { continue };
            links.extend(row.outgoing.iter().filter_map(at).map(|next| (own, next)));
            links.extend(row.incoming.iter().filter_map(at).map(|before| (before, own)));
        }
        links.sort_unstable();
        links.dedup();
        for (from, to) in links {
            let [before, after] = [from, to].map(|i| map.lanes[i].id.clone());
            map.lanes[from].successors.push(after);
            map.lanes[to].predecessors.push(before);
        }
    }
}
