//! Ground and directions in which vehicles may drive: an index of a map, built once and shared.

use crate::geometry::Vec2;
use crate::geometry::obb::OrientedBox;
use crate::geometry::segments::{Segment, SegmentIndex, thinned_pieces};
use crate::map::{Area, Lane, LaneMap, LaneType};
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

/// Cap on distances off the road, metres.
pub const FAR_M: f64 = 50.0;
/// Distance before a lane's end at which the road is examined, metres.
const BEFORE_END_M: f64 = 0.05;
/// Length beyond a lane's end at the map's edge over which the ground is unknown, metres: a minute at urban
/// speed.
const BEYOND_MAP_M: f64 = 1000.0;
/// Length of the straight continuation of such a lane if another lane is nearer, metres: nine seconds at 80
/// km/h.
const WAY_OUT_M: f64 = 200.0;
/// Length of the pieces of such a continuation, metres, so that the index holds them in small boxes.
const WAY_OUT_PIECE_M: f64 = 50.0;
/// Points of a line nearer than this to each other define no direction, metres.
const LEAST_PIECE_M: f64 = 0.01;
/// Most lane ends with a continuation, so that time and memory of a map stay in proportion to its points.
const MOST_WAYS_OUT: usize = 1024;
/// Radius of the search for lanes, metres: no lane is more than twice as wide.
const LANE_NEAR_M: f64 = 4.0;
/// Radius beyond which a lane does not describe the ground, metres.
const LANE_REACH_M: f64 = 30.0;
/// Ground this near to an edge that may be crossed counts as road, metres. The same distance applies where
/// only such edges lie between it and a lane: the middle of a wide median.
const AT_EDGE_M: f64 = 3.0;
const BETWEEN_EDGES_M: f64 = 6.0;
/// An edge farther from a box's centre cannot be the one that it crosses, metres.
const UNDER_M: f64 = 12.0;
/// Height of the rows into which polygon sides are sorted, metres.
const ROW_M: f64 = 4.0;

/// Properties of a lane's ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Band {
    half_width_m: f64,
    carries_vehicles: bool,
    /// Leads through a junction, a fork or a merge.
    pub(crate) in_junction: bool,
    /// Speed limit if the map gives one, m/s.
    pub(super) speed_limit_mps: Option<f64>,
    /// Its start and end, if no lane leads there or follows: the road may continue beyond the map.
    open: [Option<Vec2>; 2],
}

/// Index of the ground that vehicles may use. Immutable, so any number of threads may read it, and a cache
/// may keep it by the map's hash.
///
/// The rule depends on what the map has:
/// - drivable areas: the ground inside any of them;
/// - else road edges: ground from which a straight line to the nearest lane centre crosses no edge;
/// - else the lanes' own widths, assumed by type if the source gives none;
/// - driveways count as drivable under the last two. Sidewalk lanes never do.
#[derive(Clone, Debug, Default)]
pub struct Drivable {
    areas: Arc<Polygons>,
    driveways: Arc<Polygons>,
    area_sides: Arc<SegmentIndex>,
    edges: Arc<SegmentIndex>,
    centers: Arc<SegmentIndex>,
    bands: Arc<[Band]>,
    widest_half_m: f64,
    ways_out: Arc<WaysOut>,
    /// Id of each road edge, and whether it bounds a median.
    edge_names: Arc<[(String, bool)]>,
    assumed_width: bool,
    /// Indices of the road edges that may be crossed.
    allowed: Vec<u32>,
}

impl Drivable {
    /// Builds the index of a map. Takes some milliseconds for ten thousand points.
    pub fn new(map: &LaneMap) -> Self {
        let lanes = || map.lanes.iter().enumerate().filter(|(_, l)| l.lane_type != LaneType::Sidewalk);
        let centers = lanes().flat_map(|(i, l)| thinned_pieces(&l.points.xy, false, i as u32)).collect();
        let edges = map
            .road_edges
            .iter()
            .zip(0..)
            .flat_map(|(e, i)| thinned_pieces(&e.points.xy, false, i))
            .collect();
        let by_id: HashMap<&str, &Lane> = map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect();
        let has_areas = map.drivable.iter().any(|a| a.polygon.xy.len() >= 3);
        let band = |lane: &Lane| Band {
            half_width_m: 0.5 * lane.width_or_assumed_m(),
            carries_vehicles: lane.lane_type.carries_vehicles(),
            in_junction: lane.interpolating || parts_or_joins(&by_id, lane),
            speed_limit_mps: lane.speed_limit_mps.filter(|v| *v > 0.0),
            open: [
                lane.points.xy.first().copied().filter(|_| lane.predecessors.is_empty()),
                lane.points.xy.last().copied().filter(|_| lane.successors.is_empty()),
            ],
        };
        let edges = SegmentIndex::new(edges);
        let bands: Arc<[Band]> = map.lanes.iter().map(band).collect();
        let ways_out = WaysOut::new(lanes().map(|(i, lane)| (&lane.points.xy[..], bands[i])), &edges);
        Self {
            areas: Arc::new(Polygons::new(&map.drivable)),
            driveways: Arc::new(Polygons::new(&map.driveways)),
            area_sides: Arc::new(SegmentIndex::new(sides(&map.drivable).collect())),
            centers: Arc::new(SegmentIndex::new(centers)),
            ways_out: Arc::new(ways_out),
            widest_half_m: bands.iter().map(|band| band.half_width_m).fold(0.0, f64::max),
            bands,
            edge_names: map.road_edges.iter().map(|e| (e.id.clone(), e.line_type == "median")).collect(),
            assumed_width: !has_areas && edges.is_empty() && lanes().any(|(_, l)| l.width_m.is_none()),
            edges: Arc::new(edges),
            allowed: Vec::new(),
        }
    }

    /// The same ground for an agent that may cross these road edges, given by id. They bound nothing, and
    /// ground next to them counts as road.
    pub fn allowing(&self, edges: &[String]) -> Cow<'_, Self> {
        if edges.is_empty() {
            return Cow::Borrowed(self);
        }
        let named = self.edge_names.iter().zip(0..).filter(|((id, _), _)| edges.contains(id));
        Cow::Owned(Self { allowed: named.map(|(_, i)| i).collect(), ..self.clone() })
    }

    fn bounds(&self, edge: &Segment) -> bool {
        self.allowed.is_empty() || !self.allowed.contains(&edge.owner)
    }

    /// Whether a point lies between edges that may be crossed, or directly at one.
    pub fn is_beside_allowed(&self, point: Vec2) -> bool {
        self.is_at_allowed(point, BETWEEN_EDGES_M)
    }

    /// Whether an edge that may be crossed is this near.
    fn is_at_allowed(&self, point: Vec2, reach_m: f64) -> bool {
        let allowed = |edge: &&Segment| self.allowed.contains(&edge.owner);
        let within = |edge: &Segment| (edge.foot(point) - point).norm() <= reach_m;
        !self.allowed.is_empty() && self.edges.near(point, reach_m).filter(allowed).any(within)
    }

    /// Approximate bytes of memory that queries have added as caches.
    pub fn kept_bytes(&self) -> usize {
        [&self.area_sides, &self.edges, &self.centers].iter().map(|index| index.listed_bytes()).sum()
    }

    /// Whether off-road figures depend on lane widths that were assumed by type.
    pub fn assumed_width(&self) -> bool {
        self.assumed_width
    }

    /// Whether the map does not define where to drive.
    pub fn is_unknown(&self) -> bool {
        self.area_sides.is_empty() && self.centers.is_empty()
    }

    /// Whether the map has areas or road edges, not only lane widths.
    pub fn is_bounded(&self) -> bool {
        !self.area_sides.is_empty() || !self.edges.is_empty()
    }

    /// Distance of a point off the road, metres: zero on it, at most [`FAR_M`]. `None` if the map does not
    /// define it, as beyond a place where a lane leaves the map.
    pub fn outside_m(&self, point: Vec2) -> Option<f64> {
        let outside_m = self.outside_known_m(point).filter(|m| *m == 0.0 || !self.is_beyond_map(point))?;
        Some(if outside_m > 0.0 && self.is_at_allowed(point, AT_EDGE_M) { 0.0 } else { outside_m })
    }

    /// Whether a point lies beyond the end of a lane that nothing follows or precedes. One case is the
    /// nearest lane: the point is within its width, ahead of its end rather than beside it, or on its road if
    /// that continued. The other is any such lane: the point is within its width if it continued straight and
    /// no road edge closes it.
    pub fn is_beyond_map(&self, point: Vec2) -> bool {
        self.beyond_end(point)
            .is_some_and(|b| b.ahead_m > 0.5 * b.away_m || self.is_straight_on(point, &b, b.half_width_m))
            || self.ways_out.lead_over(point)
    }

    /// The position of a point ahead of the open end of its nearest lane.
    fn beyond_end(&self, point: Vec2) -> Option<BeyondEnd> {
        let (piece, foot, away_m) = self.centers.nearest(point, BEYOND_MAP_M)?;
        let band = self.bands.get(piece.owner as usize)?;
        let way = (piece.to - piece.from).normalize();
        [-way, way].into_iter().zip(band.open).find_map(|(out, end)| {
            let is_end = end.is_some_and(|end| (end - foot).norm() < 1e-6);
            let ahead_m = out.dot(&(point - foot));
            let (half_width_m, away_m) = (band.half_width_m, away_m);
            (is_end && ahead_m > 0.0).then_some(BeyondEnd { out, ahead_m, away_m, half_width_m })
        })
    }

    /// Whether the point is within this distance of the lane, or on the road, if these continued.
    fn is_straight_on(&self, point: Vec2, beyond: &BeyondEnd, beside_lane_m: f64) -> bool {
        let &BeyondEnd { out, ahead_m, away_m, .. } = beyond;
        let beside_m = (away_m.powi(2) - ahead_m.powi(2)).max(0.0).sqrt();
        let on_road = || self.outside_known_m(point - out * (ahead_m + BEFORE_END_M)) == Some(0.0);
        beside_m <= beside_lane_m || on_road()
    }

    /// Distance of a point from the nearest lane's middle, metres; `None` beyond `reach_m`.
    pub fn lane_away_m(&self, point: Vec2, reach_m: f64) -> Option<f64> {
        self.centers.nearest(point, reach_m).map(|found| found.2)
    }

    /// Distance of a point from the lanes, metres, beyond the end of the map's roads. There, no lane, edge or
    /// area is within `reach_m`, nor would the nearest lane be if it continued straight. `None` elsewhere.
    pub fn off_map_m(&self, point: Vec2, reach_m: f64) -> Option<f64> {
        let is_near = [&self.centers, &self.edges, &self.area_sides]
            .into_iter()
            .any(|index| index.nearest(point, reach_m).is_some());
        if is_near || self.outside_known_m(point).is_none_or(|m| m == 0.0) {
            return None;
        }
        let beyond = self.beyond_end(point)?;
        let leads_off = beyond.ahead_m > 0.5 * beyond.away_m && !self.is_straight_on(point, &beyond, reach_m);
        leads_off.then_some(beyond.away_m)
    }

    fn outside_known_m(&self, point: Vec2) -> Option<f64> {
        if !self.area_sides.is_empty() {
            let inside = self.areas.contain(point);
            return Some(if inside { 0.0 } else { distance(&self.area_sides, point) });
        }
        if self.centers.is_empty() {
            return None;
        }
        if self.driveways.contain(point) {
            return Some(0.0);
        }
        Some(if self.edges.is_empty() { self.beside_lanes_m(point) } else { self.beyond_edges_m(point) })
    }

    /// Largest distance of a box's corner off the road, metres; `None` if the map does not define it.
    pub fn box_outside_m(&self, outline: &OrientedBox) -> Option<f64> {
        let center = self.outside_m(outline.center())?;
        let (bounds, edges) = (&self.area_sides, self.area_sides.is_empty());
        let bounds = if edges { &self.edges } else { bounds };
        // The centre is on the road and no boundary lies in the box, so the whole box is on the road.
        let bounded = !bounds.is_empty();
        let cut = |s: &Segment| (!edges || self.bounds(s)) && outline.meets_segment(s.from, s.to);
        if center == 0.0 && bounded && !bounds.near(outline.center(), outline.radius_m()).any(cut) {
            return Some(0.0);
        }
        let corners = outline.corners().map(|c| self.outside_m(c).unwrap_or(0.0));
        Some(corners.into_iter().fold(0.0, f64::max))
    }

    /// Whether the nearest road edge within `reach_m` of a point bounds a median.
    pub fn is_median(&self, point: Vec2, reach_m: f64) -> bool {
        let nearest = self.edges.nearest(point, reach_m);
        nearest.is_some_and(|(edge, ..)| self.edge_names.get(edge.owner as usize).is_some_and(|e| e.1))
    }

    /// The id of the road edge under a box, else of the nearest one. Edges farther than [`UNDER_M`] from its
    /// centre and those that may be crossed do not count.
    pub fn edge_under(&self, outline: &OrientedBox) -> Option<&str> {
        let center = outline.center();
        let away = |s: &Segment| {
            let beside = if outline.meets_segment(s.from, s.to) { 0.0 } else { UNDER_M };
            beside + (s.foot(center) - center).norm()
        };
        let near = self.edges.near(center, UNDER_M).filter(|s| self.bounds(s)).map(|s| (away(s), s.owner));
        let (_, edge) = near.filter(|(m, _)| *m <= 2.0 * UNDER_M).min_by(|a, b| a.0.total_cmp(&b.0))?;
        self.edge_names.get(edge as usize).map(|e| e.0.as_str())
    }

    /// Distance of a point off the road, metres, and its gradient (a unit vector); `None` on the road and if
    /// the map does not define it.
    pub fn beyond(&self, point: Vec2) -> Option<(f64, Vec2)> {
        let outside_m = self.outside_m(point).filter(|m| *m > 0.0)?;
        let foot = if !self.area_sides.is_empty() {
            self.area_sides.nearest(point, FAR_M)?.1
        } else if !self.edges.is_empty() {
            self.edges.nearest(point, FAR_M)?.1
        } else {
            let beside = |lane: &&Segment| {
                let half = self.bands.get(lane.owner as usize).map_or(0.0, |b| b.half_width_m);
                (lane.foot(point) - point).norm() - half
            };
            let lanes = self.centers.near(point, outside_m + LANE_REACH_M);
            lanes.min_by(|a, b| beside(a).total_cmp(&beside(b)))?.foot(point)
        };
        let away = point - foot;
        (away.norm() > 1e-9).then(|| (outside_m, away / away.norm()))
    }

    /// Distance beyond the side of the nearest lane.
    fn beside_lanes_m(&self, point: Vec2) -> f64 {
        let mut least = FAR_M;
        for radius in [4.0, FAR_M] {
            self.centers.outwards(point, radius, |_, lane| {
                let half = self.bands.get(lane.owner as usize).map_or(0.0, |b| b.half_width_m);
                least = least.min((lane.foot(point) - point).norm() - half);
                // Within a lane the distance is zero, however far from its side.
                if least <= 0.0 { f64::NEG_INFINITY } else { least + self.widest_half_m }
            });
            if least <= 0.0 {
                return 0.0;
            }
        }
        least
    }

    /// Distance beyond the road edge that lies between a point and its nearest lane.
    fn beyond_edges_m(&self, point: Vec2) -> f64 {
        let Some((_, foot, away)) = self.centers.nearest(point, LANE_REACH_M) else {
            return distance(&self.edges, point);
        };
        let middle = 0.5 * (point + foot);
        let mut crossed =
            self.edges.near(middle, 0.5 * away).filter(|edge| edge.crosses(point, foot)).peekable();
        if crossed.peek().is_none() {
            return 0.0;
        }
        // Ground between edges that may be crossed may be driven on too, but not all the land behind one.
        if crossed.all(|edge| !self.bounds(edge)) && self.is_beside_allowed(point) {
            return 0.0;
        }
        distance(&self.edges, point)
    }

    /// Whether the straight line between two points leaves the road over an edge, even if the ground beyond
    /// is the other side of a median without width. Edges across the mouth of a driveway do not count.
    pub fn crosses_an_edge(&self, from: Vec2, to: Vec2) -> bool {
        let middle = 0.5 * (from + to);
        let radius_m = 0.5 * (to - from).norm();
        let crossed = |edge: &Segment| self.bounds(edge) && edge.crosses(from, to);
        self.edges.near(middle, radius_m).any(crossed)
            && !self.driveways.contain(middle)
            && !self.is_at_allowed(middle, AT_EDGE_M)
    }

    /// Whether driving in direction `forward` (a unit vector) is against the traffic. It is if vehicle lanes
    /// are at `point` and all differ from it by more than 120 degrees. `None` off the lanes.
    pub fn is_wrong_way(&self, point: Vec2, forward: Vec2) -> Option<bool> {
        let mut lanes = self.vehicle_lanes(point).peekable();
        lanes.peek()?;
        Some(lanes.all(|(lane, _)| {
            let along = lane.to - lane.from;
            along.dot(&forward) < -0.5 * along.norm()
        }))
    }

    /// Pieces of the vehicle lanes whose width contains a point.
    pub(crate) fn vehicle_lanes(&self, point: Vec2) -> impl Iterator<Item = (&Segment, &Band)> {
        let lanes = self.centers.near(point, LANE_NEAR_M);
        lanes.filter_map(move |lane| {
            let band = self.bands.get(lane.owner as usize).filter(|b| b.carries_vehicles)?;
            ((lane.foot(point) - point).norm() <= band.half_width_m).then_some((lane, band))
        })
    }

    /// Whether a driveway covers this point.
    pub(super) fn is_driveway(&self, point: Vec2) -> bool {
        self.driveways.contain(point)
    }
}

/// A point ahead of the open end of its nearest lane.
struct BeyondEnd {
    /// Direction of the lane's continuation, a unit vector.
    out: Vec2,
    /// Metres along it.
    ahead_m: f64,
    /// Metres from the lane's end.
    away_m: f64,
    half_width_m: f64,
}

/// Straight continuations of lane ends that no lane precedes or follows, up to the first road edge.
#[derive(Clone, Debug, Default)]
struct WaysOut {
    /// Half the width of each lane, metres.
    half_widths_m: Vec<f64>,
    /// The continuations in pieces; the owner is the lane's index in the list.
    pieces: SegmentIndex,
}

impl WaysOut {
    /// The continuations of vehicle lanes, at most [`MOST_WAYS_OUT`].
    fn new<'a>(lanes: impl Iterator<Item = (&'a [Vec2], Band)>, edges: &SegmentIndex) -> Self {
        let (mut half_widths_m, mut pieces) = (Vec::new(), Vec::new());
        let open = lanes.filter(|(_, band)| band.carries_vehicles).flat_map(|(points, band)| {
            let [first, last] = band.open;
            let first = first.and_then(|end| Some((end, out_of(points.iter(), end)?)));
            let last = last.and_then(|end| Some((end, out_of(points.iter().rev(), end)?)));
            [first, last].into_iter().flatten().map(move |(end, out)| (end, out, band.half_width_m))
        });
        for ((end, out, half_width_m), owner) in open.take(MOST_WAYS_OUT).zip(0..) {
            half_widths_m.push(half_width_m);
            let length_m = edges.ray_m(end, out, WAY_OUT_M).unwrap_or(WAY_OUT_M);
            let count = (length_m / WAY_OUT_PIECE_M).ceil() as u32;
            let at = |k: u32| end + out * length_m.min(WAY_OUT_PIECE_M * f64::from(k));
            pieces.extend((0..count).map(|k| Segment { from: at(k), to: at(k + 1), owner, piece: k }));
        }
        Self { half_widths_m, pieces: SegmentIndex::new(pieces) }
    }

    /// Whether the point lies within the width of a continuation.
    fn lead_over(&self, point: Vec2) -> bool {
        self.pieces.near(point, LANE_NEAR_M).any(|piece| {
            let half_width_m = self.half_widths_m.get(piece.owner as usize);
            half_width_m.is_some_and(|half_width_m| (piece.foot(point) - point).norm() <= *half_width_m)
        })
    }
}

/// The outward direction at an end of a line, a unit vector; `points` begin there.
fn out_of<'a>(mut points: impl Iterator<Item = &'a Vec2>, end: Vec2) -> Option<Vec2> {
    points.find_map(|point| (end - point).try_normalize(LEAST_PIECE_M))
}

/// Whether another lane shares the predecessor or the successor of this one: few maps mark the lanes that
/// lead through junctions.
fn parts_or_joins(by_id: &HashMap<&str, &Lane>, lane: &Lane) -> bool {
    let lane_of = |id: &String| by_id.get(id.as_str());
    lane.predecessors.iter().filter_map(lane_of).any(|before| before.successors.len() > 1)
        || lane.successors.iter().filter_map(lane_of).any(|next| next.predecessors.len() > 1)
}

fn distance(to: &SegmentIndex, point: Vec2) -> f64 {
    to.nearest(point, FAR_M).map_or(FAR_M, |found| found.2)
}

fn sides(areas: &[Area]) -> impl Iterator<Item = Segment> + '_ {
    let rings = |area: &Area| {
        let outer = std::iter::once(&area.polygon);
        outer.chain(&area.holes).map(|r| r.xy.clone()).collect::<Vec<_>>()
    };
    areas.iter().enumerate().flat_map(move |(i, area)| {
        rings(area).into_iter().flat_map(move |ring| thinned_pieces(&ring, true, i as u32))
    })
}

/// Sides of polygons sorted into rows by y, so that a point is tested against few of them.
#[derive(Clone, Debug, Default)]
struct Polygons {
    low_y: f64,
    /// Sides with the index of their polygon, by row, then polygon.
    rows: Vec<Vec<Segment>>,
}

impl Polygons {
    fn new(areas: &[Area]) -> Self {
        let all: Vec<Segment> = sides(areas).collect();
        let ys = || all.iter().flat_map(|s| [s.from.y, s.to.y]);
        let (low_y, high_y) = (ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max));
        if all.is_empty() {
            return Self::default();
        }
        let row = |y: f64| ((y - low_y) / ROW_M) as usize;
        let mut rows = vec![Vec::new(); row(high_y) + 1];
        for side in &all {
            for slot in &mut rows[row(side.from.y.min(side.to.y))..=row(side.from.y.max(side.to.y))] {
                slot.push(*side);
            }
        }
        Self { low_y, rows }
    }

    /// Whether any polygon contains the point: even-odd rule, so a hole is outside its polygon.
    fn contain(&self, p: Vec2) -> bool {
        let row = (p.y - self.low_y) / ROW_M;
        if row < 0.0 {
            return false;
        }
        let Some(sides) = self.rows.get(row as usize) else { return false };
        let to_the_right = |s: &Segment| {
            let spans = (s.from.y > p.y) != (s.to.y > p.y);
            spans && p.x < s.from.x + (s.to.x - s.from.x) * (p.y - s.from.y) / (s.to.y - s.from.y)
        };
        sides
            .chunk_by(|a, b| a.owner == b.owner)
            .any(|polygon| polygon.iter().filter(|s| to_the_right(s)).count() % 2 == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{area, edge, lane};
    use super::*;
    use crate::map::TypedLine;

    fn at(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    #[test]
    fn may_be_shared() {
        fn shared<T: Send + Sync>() {}
        shared::<Drivable>();
        assert!(Drivable::default().is_unknown());
        assert_eq!(Drivable::default().outside_m(at(0.0, 0.0)), None);
    }

    #[test]
    fn areas_with_holes() {
        let mut square = area(&[(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)]);
        square.holes = vec![area(&[(10.0, 10.0), (20.0, 10.0), (20.0, 20.0), (10.0, 20.0)]).polygon];
        let next = area(&[(40.0, 0.0), (60.0, 0.0), (60.0, 40.0), (40.0, 40.0)]);
        let index = Drivable::new(&LaneMap { drivable: vec![square, next], ..LaneMap::default() });
        assert_eq!(index.outside_m(at(5.0, 5.0)), Some(0.0));
        assert_eq!(index.outside_m(at(12.0, 15.0)), Some(2.0));
        assert_eq!(index.outside_m(at(-3.0, 44.0)), Some(5.0));
        // A box over the seam of two areas is on the road.
        assert_eq!(index.box_outside_m(&OrientedBox::new(at(40.0, 30.0), 2.0, 1.0, 0.3)), Some(0.0));
        let over = OrientedBox::new(at(59.0, 30.0), 2.0, 1.0, 0.0);
        assert!((index.box_outside_m(&over).unwrap() - 1.0).abs() < 1e-9);
        assert!(!index.assumed_width());
    }

    #[test]
    fn a_box_that_leaves_the_map_by_the_end_of_its_lane_is_not_off_the_road() {
        let road = area(&[(0.0, -2.0), (100.0, -2.0), (100.0, 2.0), (0.0, 2.0)]);
        let east = lane("east", &[(0.0, 0.0), (100.0, 0.0)]);
        let index = Drivable::new(&LaneMap { lanes: vec![east], drivable: vec![road], ..LaneMap::default() });
        let outside_m = |x: f64, y: f64| index.box_outside_m(&OrientedBox::new(at(x, y), 2.3, 0.9, 0.0));
        assert_eq!(
            outside_m(98.0, 0.7),
            Some(0.0),
            "its front corners are beside the end of the lane's middle"
        );
        assert_eq!((outside_m(103.0, 0.7), outside_m(900.0, 0.7)), (None, None));
        assert!(outside_m(98.0, 2.0).unwrap() > 0.8, "over the kerb is over the kerb, at the end too");
        // A wide road with a corner at its end that is far from the middle of the lane.
        let wide = area(&[(0.0, -2.0), (100.0, -2.0), (100.0, 5.0), (0.0, 5.0)]);
        let east = lane("east", &[(0.0, 0.0), (100.0, 0.0)]);
        let index = Drivable::new(&LaneMap { lanes: vec![east], drivable: vec![wide], ..LaneMap::default() });
        let outside_m = |y: f64| index.box_outside_m(&OrientedBox::new(at(98.2, y), 2.3, 0.9, 0.0));
        assert_eq!(outside_m(3.5), Some(0.0));
        assert!(outside_m(5.0).unwrap() > 0.4);
    }

    #[test]
    fn a_way_out_of_the_map_may_pass_near_another_road() {
        // On the continuation of the first road, the second road is nearer than the first one's end.
        let lanes =
            || vec![lane("east", &[(0.0, 0.0), (100.0, 0.0)]), lane("other", &[(0.0, 30.0), (300.0, 30.0)])];
        let open = Drivable::new(&LaneMap { lanes: lanes(), ..LaneMap::default() });
        assert!(open.is_beyond_map(at(180.0, 1.0)) && open.outside_m(at(180.0, 1.0)).is_none());
        assert!(!open.is_beyond_map(at(180.0, 8.0)));
        assert!(open.outside_m(at(180.0, 8.0)).unwrap() > 10.0, "beside the way out");
        let wall = edge(&[(120.0, -5.0), (120.0, 5.0)]);
        let closed = Drivable::new(&LaneMap { lanes: lanes(), road_edges: vec![wall], ..LaneMap::default() });
        assert!(!closed.is_beyond_map(at(180.0, 1.0)) && open.is_beyond_map(at(110.0, 1.0)));
    }

    #[test]
    fn lane_widths_and_directions() {
        let mut east = lane("east", &[(0.0, 0.0), (50.0, 0.0), (100.0, 0.0)]);
        let west = lane("west", &[(100.0, 3.5), (0.0, 3.5)]);
        let index = Drivable::new(&LaneMap { lanes: vec![east.clone(), west], ..LaneMap::default() });
        assert!(index.assumed_width());
        assert_eq!(index.outside_m(at(50.0, -1.7)), Some(0.0));
        assert!((index.outside_m(at(50.0, -3.75)).unwrap() - 2.0).abs() < 1e-9);
        assert!((index.outside_m(at(50.0, 25.25)).unwrap() - 20.0).abs() < 1e-9);
        assert_eq!(index.outside_m(at(50.0, 500.0)), Some(FAR_M));
        // Beyond the place where a lane leaves the map the ground is unknown.
        assert_eq!((index.outside_m(at(130.0, 3.0)), index.outside_m(at(190.0, 3.0))), (None, None));
        assert!((index.outside_m(at(100.5, 25.25)).unwrap() - 20.0).abs() < 0.1, "beside its end");
        assert_eq!(index.is_wrong_way(at(20.0, 0.0), at(1.0, 0.0)), Some(false));
        assert_eq!(index.is_wrong_way(at(20.0, 0.0), at(-1.0, 0.0)), Some(true));
        assert_eq!(index.is_wrong_way(at(20.0, 3.5), at(-1.0, 0.0)), Some(false));
        assert_eq!(index.is_wrong_way(at(20.0, 0.0), at(0.0, 1.0)), Some(false));
        assert_eq!(index.is_wrong_way(at(20.0, -9.0), at(1.0, 0.0)), None);
        east.width_m = Some(3.0);
        let index = Drivable::new(&LaneMap { lanes: vec![east], ..LaneMap::default() });
        assert!(!index.assumed_width());
        assert!((index.outside_m(at(50.0, 1.7)).unwrap() - 0.2).abs() < 1e-9);
    }

    #[test]
    fn road_edges_beat_lane_widths() {
        let map = LaneMap {
            lanes: vec![lane("east", &[(0.0, 0.0), (100.0, 0.0)])],
            road_edges: vec![edge(&[(0.0, -6.0), (100.0, -6.0)]), edge(&[(0.0, 2.0), (100.0, 2.0)])],
            driveways: vec![area(&[(40.0, -12.0), (50.0, -12.0), (50.0, -5.0), (40.0, -5.0)])],
            ..LaneMap::default()
        };
        let index = Drivable::new(&map);
        // The wide shoulder is road, the ground behind the edge is not, the driveway is.
        assert_eq!(index.outside_m(at(20.0, -5.0)), Some(0.0));
        assert_eq!(index.outside_m(at(20.0, -8.0)), Some(2.0));
        assert_eq!(index.outside_m(at(45.0, -8.0)), Some(0.0));
        assert_eq!(index.outside_m(at(20.0, 5.0)), Some(3.0));
        assert!(index.crosses_an_edge(at(20.0, 1.0), at(21.0, 3.0)));
        assert!(!index.crosses_an_edge(at(20.0, -1.0), at(90.0, 1.0)));
        assert!(!index.crosses_an_edge(at(45.0, -5.0), at(45.0, -7.0)), "into the driveway");
        assert!(!index.assumed_width());
    }

    #[test]
    fn an_edge_that_may_be_driven_over_bounds_nothing_and_the_land_behind_it_stays_land() {
        let named = |id: &str, y: f64| TypedLine { id: id.into(), ..edge(&[(0.0, y), (100.0, y)]) };
        let map = LaneMap {
            lanes: vec![
                lane("east", &[(0.0, 0.0), (100.0, 0.0)]),
                lane("west", &[(100.0, 14.0), (0.0, 14.0)]),
            ],
            road_edges: vec![named("right", -2.0), named("near", 2.0), named("far", 12.0)],
            ..LaneMap::default()
        };
        let all = Drivable::new(&map);
        let car = OrientedBox::new(at(50.0, 2.5), 2.3, 1.0, 0.0);
        assert_eq!(all.edge_under(&car), Some("near"));
        let one = all.allowing(&["near".into()]);
        assert_eq!((all.outside_m(at(50.0, 4.0)), one.outside_m(at(50.0, 4.0))), (Some(2.0), Some(0.0)));
        assert_eq!(one.box_outside_m(&car), Some(0.0));
        assert!(all.crosses_an_edge(at(50.0, 1.0), at(50.0, 3.0)));
        assert!(!one.crosses_an_edge(at(50.0, 1.0), at(50.0, 3.0)));
        // The other side of the median, and the kerb, are unchanged.
        assert!(
            one.outside_m(at(50.0, 9.0)).unwrap() > 2.0
                && one.crosses_an_edge(at(50.0, 11.0), at(50.0, 13.0))
        );
        assert_eq!(one.outside_m(at(50.0, -4.0)), Some(2.0));
        assert_eq!(one.edge_under(&car), Some("right"), "the nearest of those that bound");
        let both = all.allowing(&["near".into(), "far".into()]);
        assert!((-1..=15).all(|y| both.outside_m(at(50.0, f64::from(y))) == Some(0.0)));
        let kerb = all.allowing(&["right".into()]);
        assert_eq!(kerb.outside_m(at(50.0, -4.0)), Some(0.0));
        assert!(kerb.outside_m(at(50.0, -12.0)).unwrap() > 9.0);
    }
}
