//! The map of a city: lanes and the connectors between them, crossings, boundaries, stop signs and the ground.

use super::database::Database;
use super::geometry::Geometry;
use crate::around::Chosen;
use crate::limits::MAX_POLYLINES;
use crate::polyline::{length, ring_area_m2, simplify};
use crate::problem::{ImportWarning, ReadError};
use crate::projection::UtmZone;
use crate::refusals;
use crate::repairs;
use crate::sentences::{self, subject};
use crate::settle::Ids;
use scene::geometry::Extent;
use scene::map::{Area, Boundary, Lane, LaneMap, Neighbor, Points, StopSign, TypedLine};
use scene::{Shared, Vec2};
use std::collections::{HashMap, HashSet};

/// A table that every map has.
pub(super) const PATHS: &str = "baseline_paths";
const LANES: &str = "lanes_polygons";
const CONNECTORS: &str = "lane_connectors";
const BOUNDARIES: &str = "boundaries";
const CROSSINGS: &str = "crosswalks";
const STOPS: &str = "stop_polygons";
/// Tables of drivable areas.
const GROUND: [&str; 4] =
    ["lane_groups_polygons", "intersections", "generic_drivable_areas", "carpark_areas"];
/// Type of stop polygons that represent signs.
const STOP_SIGN: i64 = 1;
/// A stop polygon applies to the lanes that end within it or this close to it, metres.
const STOPS_WITHIN_M: f64 = 2.0;
/// Most stop signs of a part, and most corners of a polygon.
const MOST_STOPS: usize = 500;
const MOST_CORNERS: usize = 32;
/// Range of lane widths, metres.
const WIDTHS_M: (f64, f64) = (1.5, 8.0);
/// Range of speed limits, m/s.
const LIMITS_MPS: std::ops::RangeInclusive<f64> = 0.5..=60.0;
/// Tolerance of simplified lines and areas, and their longest segment, metres.
const KEPT_M: (f64, f64) = (0.02, 40.0);

/// A lane or connector by its number; each table has its own numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum LaneKey {
    Lane(i64),
    Connector(i64),
}

struct LaneFeature {
    key: LaneKey,
    line: Vec<Vec2>,
    width_m: Option<f64>,
    limit_mps: Option<f64>,
    /// Group of adjacent lanes, and the index in it, from the left.
    group: Option<(i64, i64)>,
    /// Boundaries to the left and right.
    sides: [Option<i64>; 2],
    /// Lanes that a connector leads from and to.
    joins: Option<(i64, i64)>,
}

/// A polygon of a table.
struct CityArea {
    id: String,
    rings: Vec<Vec<Vec2>>,
}

/// Features of a city, in metres of its zone.
pub(super) struct CityMap {
    pub zone: UtmZone,
    lanes: Vec<LaneFeature>,
    without_line: usize,
    boundaries: HashMap<i64, Vec<Vec2>>,
    crossings: Vec<CityArea>,
    /// Stop signs by their numbers.
    stops: Vec<(i64, Vec<Vec2>)>,
    ground: Vec<CityArea>,
}

/// The part of a city that a scene contains.
pub(super) struct CityPart {
    pub map: LaneMap,
    /// Ids of lanes in the scene.
    pub ids: HashMap<LaneKey, String>,
    pub warnings: Vec<ImportWarning>,
    /// Lanes that lie elsewhere.
    pub chosen: Chosen,
}

impl CityMap {
    /// Reads a map; if it does not name its zone, `zone` is used.
    ///
    /// # Errors
    /// Those of [`Database`], `cannot-represent` for a map without a known projection.
    pub fn read(database: &Database, zone: Option<UtmZone>) -> Result<Self, ReadError> {
        let reader = MapReader::new(database, zone)?;
        let mut lines = HashMap::new();
        let columns = [reader.geometry(PATHS), "lane_fid", "lane_connector_fid"];
        database.rows(PATHS, &columns, |row| {
            let line = reader.geometries(row.bytes(0)).lines.into_iter().next();
            let lane = row.whole(1).map(LaneKey::Lane);
            let key = lane.or_else(|| row.whole(2).map(LaneKey::Connector));
            if let (Some(key), Some(line)) = (key, line.filter(|line| line.len() > 1)) {
                lines.insert(key, line);
            }
        })?;
        let mut city = Self {
            zone: reader.zone,
            lanes: Vec::new(),
            without_line: 0,
            boundaries: HashMap::new(),
            crossings: reader.grounds(CROSSINGS)?,
            stops: reader.stops()?,
            ground: Vec::new(),
        };
        for table in GROUND {
            city.ground.extend(reader.grounds(table)?);
        }
        if database.has(BOUNDARIES) {
            database.rows(BOUNDARIES, &[reader.geometry(BOUNDARIES)], |row| {
                if let Some(line) = reader.geometries(row.bytes(0)).lines.into_iter().next() {
                    city.boundaries.insert(row.id(), line);
                }
            })?;
        }
        let columns = [
            reader.geometry(LANES),
            "speed_limit_mps",
            "lane_group_fid",
            "lane_index",
            "left_boundary_fid",
            "right_boundary_fid",
        ];
        let limit = |value: f64| Some(value).filter(|value| LIMITS_MPS.contains(value));
        database.rows(LANES, &columns, |row| {
            let Some(line) = lines.remove(&LaneKey::Lane(row.id())) else {
                city.without_line += 1;
                return;
            };
            let polygons = reader.geometries(row.bytes(0)).polygons;
            let ring = polygons.first().and_then(|rings| rings.first());
            let width_m = ring.map(|ring| (ring_area_m2(ring) / length(&line)).clamp(WIDTHS_M.0, WIDTHS_M.1));
            city.lanes.push(LaneFeature {
                key: LaneKey::Lane(row.id()),
                line,
                width_m: width_m.map(|width| (width * 1e3).round() / 1e3),
                limit_mps: limit(row.number(1)),
                group: row.whole(2).zip(row.whole(3)),
                sides: [row.whole(4), row.whole(5)],
                joins: None,
            });
        })?;
        if database.has(CONNECTORS) {
            let columns = ["exit_lane_fid", "entry_lane_fid", "speed_limit_mps"];
            database.rows(CONNECTORS, &columns, |row| {
                let Some(line) = lines.remove(&LaneKey::Connector(row.id())) else {
                    city.without_line += 1;
                    return;
                };
                city.lanes.push(LaneFeature {
                    key: LaneKey::Connector(row.id()),
                    line,
                    width_m: None,
                    limit_mps: limit(row.number(2)),
                    group: None,
                    sides: [None, None],
                    joins: row.whole(0).zip(row.whole(1)),
                });
            })?;
        }
        Ok(city)
    }

    /// Extent of all lanes; `None` without any.
    pub fn extent(&self) -> Option<Extent> {
        Extent::about(self.lanes.iter().flat_map(|lane| &lane.line).copied())
    }

    /// The chosen part of the city, about an origin.
    pub fn part(&self, origin: Vec2, mut chosen: Chosen) -> CityPart {
        let (mut ids, mut map) = (Ids::default(), LaneMap::default());
        let placed = |line: &[Vec2]| -> Vec<Vec2> {
            let line: Vec<Vec2> = line.iter().map(|p| p - origin).collect();
            if line.len() > 2 { simplify(&line, KEPT_M.0, KEPT_M.1) } else { line }
        };
        let mut lanes: HashMap<LaneKey, String> = HashMap::new();
        let mut kept = Vec::new();
        for lane in &self.lanes {
            if !chosen.takes(&lane.line) {
                chosen.left_out += 1;
                continue;
            }
            let number = match lane.key {
                LaneKey::Lane(number) | LaneKey::Connector(number) => number,
            };
            let id = ids.take(&number.to_string());
            lanes.insert(lane.key, id.clone());
            map.lanes.push(Lane {
                width_m: lane.width_m,
                speed_limit_mps: lane.limit_mps,
                interpolating: lane.joins.is_some(),
                ..Lane::street(id, placed(&lane.line))
            });
            kept.push(lane);
        }
        link(&mut map, &kept, &lanes);
        // Things beside the lanes are chosen without being counted.
        let mut beside = chosen.clone();
        let mut lines = HashMap::new();
        for (lane, feature) in map.lanes.iter_mut().zip(&kept) {
            let last = lane.points.xy.len() - 1;
            for (side, list) in feature.sides.iter().zip([&mut lane.left_boundary, &mut lane.right_boundary])
            {
                let Some((number, line)) =
                    side.and_then(|number| Some((number, self.boundaries.get(&number)?)))
                else {
                    continue;
                };
                let id = lines.entry(number).or_insert_with(|| {
                    let id = ids.take(&format!("boundary-{number}"));
                    // The map has the sides of lanes, but not their paint.
                    let (line_type, points) = ("unknown".to_owned(), placed(line).into());
                    map.road_lines.push(TypedLine { id: id.clone(), line_type, points });
                    id
                });
                list.push(Boundary { line: id.clone(), from: 0, to: last, kind: None });
            }
        }
        let mut areas = |list: &[CityArea]| -> Vec<Area> {
            let reached =
                list.iter().filter(|area| area.rings.first().is_some_and(|ring| beside.takes(ring)));
            let area = |area: &CityArea| {
                let mut rings = area.rings.iter().map(|ring| placed(ring)).filter(|ring| ring.len() > 2);
                let polygon = rings.next()?.into();
                Some(Area { id: ids.take(&area.id), polygon, holes: rings.map(Points::from).collect() })
            };
            reached.filter_map(area).collect()
        };
        map.crosswalks = areas(&self.crossings);
        map.drivable = areas(&self.ground);
        let stops = self.stops.iter().filter(|(_, ring)| beside.takes(ring)).take(MOST_STOPS);
        // A map of more lanes than a scene holds is refused.
        for (number, ring) in stops.filter(|_| kept.len() <= MAX_POLYLINES) {
            map.stop_signs
                .extend(stop_sign(&kept, &lanes, ring, origin, || ids.take(&format!("stop-{number}"))));
        }
        let mut warnings = Vec::new();
        let message = || sentences::lanes_without_line(self.without_line);
        warnings.extend((self.without_line > 0).then(|| ImportWarning::new("lanes-dropped", message())));
        warnings.extend(ids.warning(subject::MAP_FEATURES));
        let mut map = Shared::from(map);
        warnings.extend(repairs::drop_far_links(&mut map));
        CityPart { map: LaneMap::clone(&map), ids: lanes, warnings, chosen }
    }
}

/// The sign of a stop polygon: where the lanes that lead into it end.
fn stop_sign(
    kept: &[&LaneFeature],
    lanes: &HashMap<LaneKey, String>,
    stop: &[Vec2],
    origin: Vec2,
    id: impl FnOnce() -> String,
) -> Option<StopSign> {
    let area = Area { id: String::new(), polygon: stop.to_vec().into(), holes: Vec::new() };
    let of_lane = |lane: &&&LaneFeature| {
        let end = lane.line.last().filter(|_| lane.joins.is_none());
        end.is_some_and(|end| area.is_near(*end, STOPS_WITHIN_M))
    };
    let stopped: Vec<&&LaneFeature> = kept.iter().filter(of_lane).collect();
    let position = *stopped.first()?.line.last()? - origin;
    let lanes = stopped.iter().filter_map(|lane| lanes.get(&lane.key).cloned()).collect();
    Some(StopSign { id: id(), position, z_m: None, lanes })
}

/// Links lanes through their connectors, and lanes of a group side by side.
fn link(map: &mut LaneMap, kept: &[&LaneFeature], ids: &HashMap<LaneKey, String>) {
    let at: HashMap<LaneKey, usize> = kept.iter().enumerate().map(|(i, lane)| (lane.key, i)).collect();
    let mut links: HashSet<(usize, usize)> = HashSet::new();
    let mut places: HashMap<(i64, i64), usize> = HashMap::new();
    for (i, lane) in kept.iter().enumerate() {
        if let Some((from, to)) = lane.joins {
            links.extend(at.get(&LaneKey::Lane(from)).map(|from| (*from, i)));
            links.extend(at.get(&LaneKey::Lane(to)).map(|to| (i, *to)));
        }
        if let Some(place) = lane.group {
            places.insert(place, i);
        }
    }
    let mut links: Vec<(usize, usize)> = links.into_iter().collect();
    links.sort_unstable();
    let name = |i: usize| kept.get(i).and_then(|lane| ids.get(&lane.key)).cloned().unwrap_or_default();
    for (from, to) in links {
        map.lanes[from].successors.push(name(to));
        map.lanes[to].predecessors.push(name(from));
    }
    for (i, lane) in kept.iter().enumerate() {
        let Some((group, index)) = lane.group else { continue };
        let whole = |i: usize| (0, map.lanes[i].points.xy.len() - 1);
        let beside = |index: Option<i64>| {
            let other = *places.get(&(group, index?)).filter(|other| **other != i)?;
            let (own_range, other_range) = (whole(i), whole(other));
            Some(Neighbor { lane: name(other), own_range, other_range, boundaries: Vec::new() })
        };
        let (left, right) = (beside(index.checked_sub(1)), beside(index.checked_add(1)));
        map.lanes[i].left_neighbors.extend(left);
        map.lanes[i].right_neighbors.extend(right);
    }
}

/// Reads the features of the tables.
struct MapReader<'a> {
    database: &'a Database,
    /// Columns of geometries, and whether these are in degrees.
    geometries: HashMap<String, String>,
    degrees: bool,
    zone: UtmZone,
}

impl<'a> MapReader<'a> {
    fn new(database: &'a Database, zone: Option<UtmZone>) -> Result<Self, ReadError> {
        let mut geometries = HashMap::new();
        let mut degrees = false;
        database.rows("gpkg_geometry_columns", &["table_name", "column_name", "srs_id"], |row| {
            degrees |= row.whole(2) == Some(4326);
            geometries.insert(row.text(0), row.text(1));
        })?;
        let mut said = None;
        if database.has("meta") {
            database.rows("meta", &["key", "value"], |row| {
                if row.text(0) == "projectedCoordSystem" {
                    said =
                        row.text(1).rsplit(':').next().and_then(|code| UtmZone::of_epsg(code.parse().ok()?));
                }
            })?;
        }
        let unknown = || ReadError::other_content(refusals::no_projection("projectedCoordSystem"));
        Ok(Self { database, geometries, degrees, zone: said.or(zone).ok_or_else(unknown)? })
    }

    /// Column of the geometry of a table.
    fn geometry(&self, table: &str) -> &str {
        self.geometries.get(table).map_or("geom", String::as_str)
    }

    /// A geometry in metres.
    fn geometries(&self, blob: &[u8]) -> Geometry {
        let mut geometry = Geometry::of(blob).unwrap_or_default();
        let lines = geometry.lines.iter_mut().chain(geometry.polygons.iter_mut().flatten());
        for line in lines.filter(|_| self.degrees) {
            line.iter_mut().for_each(|p| *p = self.zone.metres(p.y, p.x));
            line.retain(|p| p.x.is_finite() && p.y.is_finite());
        }
        geometry
    }

    /// The polygons of a table, if it exists.
    fn grounds(&self, table: &str) -> Result<Vec<CityArea>, ReadError> {
        let mut list = Vec::new();
        if self.database.has(table) {
            self.database.rows(table, &[self.geometry(table)], |row| {
                for (i, rings) in self.geometries(row.bytes(0)).polygons.into_iter().enumerate() {
                    let part = if i > 0 { format!(".{i}") } else { String::new() };
                    list.push(CityArea { id: format!("{table}-{}{part}", row.id()), rings });
                }
            })?;
        }
        Ok(list)
    }

    fn stops(&self) -> Result<Vec<(i64, Vec<Vec2>)>, ReadError> {
        let mut list = Vec::new();
        if self.database.has(STOPS) {
            self.database.rows(STOPS, &[self.geometry(STOPS), "stop_polygon_type_fid"], |row| {
                let polygons = self.geometries(row.bytes(0)).polygons;
                let rings = polygons.into_iter().filter_map(|rings| rings.into_iter().next());
                let few = |ring: &Vec<Vec2>| (3..=MOST_CORNERS).contains(&ring.len());
                let signs = rings.filter(|ring| row.whole(1) == Some(STOP_SIGN) && few(ring));
                list.extend(signs.map(|ring| (row.id(), ring)));
            })?;
        }
        Ok(list)
    }
}
