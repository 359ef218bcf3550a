//! The outline of the carriageway: strips of road are united to one surface, whose edges become road edges.
//!
//! Formats that describe roads lane by lane have no kerbs, and their lanes overlap in junctions. The outline
//! of the union is the road edge.

use crate::polyline::simplify;
use i_overlay::core::edge_data::{EdgeDataMerge, OverlayEdgeData};
use i_overlay::core::edge_overlay::{EdgeOverlay, InputEdge};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::segm::boolean::ShapeCountBoolean;
use scene::geometry::cross;
use scene::geometry::segments::{Segment, SegmentIndex};
use scene::map::{Area, LaneMap, TypedLine};
use scene::{MAX_POLYLINE_POINTS, Vec2};
use std::collections::HashMap;

/// Integer units per metre in which surfaces are united.
const UNITS: f64 = 1_000.0;
/// Length by which strips extend past ends at which the road continues, and past their sides, metres, so that
/// adjacent strips unite.
const BEYOND_END_M: f64 = 0.25;
const BEYOND_SIDE_M: f64 = 0.01;
/// Gaps between the paths through a junction up to this area count as road, square metres.
const GAP_M2: f64 = 200.0;
/// Greatest distance between inner edges that enclose a median, metres.
const MEDIAN_M: f64 = 15.0;
/// Tolerance of simplified lines, and their longest segment, metres.
const KEPT_M: (f64, f64) = (0.02, 20.0);
/// Most points of a line.
const LONGEST: usize = 1_000;
/// Side of the grid squares in which segments that may cross are counted, metres.
const SQUARE_M: f64 = 4.0;
/// Most such pairs in total, and for each segment beyond a few: a grid of 144 junctions has 4.5 million, 25
/// per segment, and one junction of seven arms 50 per segment.
const MOST_PAIRS: u64 = 5_000_000;
const PAIRS_A_PIECE: u64 = 40;
const PAIRS_ANYWAY: u64 = 1_000_000;

/// A stretch of carriageway between two lines that run the same way.
#[derive(Clone, Debug, Default)]
pub(crate) struct Strip {
    /// As many points as `left`.
    pub right: Vec<Vec2>,
    pub left: Vec<Vec2>,
    /// Whether oncoming traffic lies beyond the right and the left line.
    pub inner: [bool; 2],
    /// Whether the road continues at its beginning and its end.
    pub joined: [bool; 2],
    /// Whether it is a path through a junction.
    pub junction: bool,
}

/// Origin of a side of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    Outer,
    Inner,
    /// An end at which the road continues.
    Joined,
    /// An end of the map.
    Open,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Label {
    side: Side,
    junction: bool,
}

impl OverlayEdgeData for Label {
    type Store = ();

    fn merge(both: EdgeDataMerge<ShapeCountBoolean, Self>, (): &mut ()) -> Self {
        let (a, b) = (both.lhs_data, both.rhs_data);
        let rank = |side| match side {
            Side::Inner => 0,
            Side::Outer => 1,
            Side::Joined => 2,
            Side::Open => 3,
        };
        let side = if rank(a.side) <= rank(b.side) { a.side } else { b.side };
        Self { side, junction: a.junction && b.junction }
    }
}

/// Adds the edges of these strips and the ground that they cover to a map. `id` is the prefix of new ids. No
/// edge crosses a line of `ways`. False if the strips overlap too often to be united: then the map gets only
/// its ground.
pub(crate) fn draw(
    map: &mut LaneMap,
    strips: &[Strip],
    ways: &[Vec<Vec2>],
    id: impl FnMut() -> String,
) -> bool {
    draw_rings(map, strips.iter().filter_map(ring).collect(), ways, id)
}

/// The same for areas that are known as polygons, which touch and may overlap.
pub(crate) fn draw_areas(
    map: &mut LaneMap,
    areas: &[Vec<Vec2>],
    ways: &[Vec<Vec2>],
    id: impl FnMut() -> String,
) -> bool {
    let label = Label { side: Side::Outer, junction: false };
    let ring = |area: &Vec<Vec2>| -> Vec<(Vec2, Label)> {
        let twice_m2: f64 = (0..area.len()).map(|i| cross(area[i], area[(i + 1) % area.len()])).sum();
        let corners = area.iter().map(|p| (*p, label));
        if twice_m2 < 0.0 { corners.rev().collect() } else { corners.collect() }
    };
    draw_rings(map, areas.iter().filter(|area| area.len() > 2).map(ring).collect(), ways, id)
}

fn draw_rings(
    map: &mut LaneMap,
    rings: Vec<Vec<(Vec2, Label)>>,
    ways: &[Vec<Vec2>],
    id: impl FnMut() -> String,
) -> bool {
    let mut drawing = Drawing { map, id };
    let (pairs, pieces) = pairs(&rings);
    if pairs > (PAIRS_ANYWAY + PAIRS_A_PIECE * pieces).min(MOST_PAIRS) {
        drawing.strips(&rings);
        return false;
    }
    let mut overlay = EdgeOverlay::<i32, Label>::new(rings.iter().map(Vec::len).sum());
    for ring in &rings {
        let corners: Vec<_> = ring.iter().map(|(p, label)| (units(*p), *label)).collect();
        for (i, (a, data)) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()].0;
            if *a != b {
                overlay.add_edge(InputEdge { a: *a, b, data: *data }, ShapeType::Subject);
            }
        }
    }
    let mut edges = Vec::new();
    let mut whole = true;
    let mut fillings = Vec::new();
    for shape in overlay.build_vector_shapes(OverlayRule::Subject, FillRule::NonZero) {
        let mut contours = shape.into_iter().map(|contour| -> Vec<(Vec2, Label)> {
            contour.iter().map(|edge| (metres(edge.a), edge.data)).collect()
        });
        let Some(outer) = contours.next() else { continue };
        let (gaps, holes): (Vec<_>, Vec<_>) = contours.partition(|hole| is_gap(hole));
        let ring = |contour: &Vec<(Vec2, Label)>| -> Vec<Vec2> {
            let points: Vec<Vec2> = contour.iter().map(|(p, _)| *p).collect();
            simplify(&points, KEPT_M.0, KEPT_M.1)
        };
        let (polygon, inner): (Vec<Vec2>, Vec<_>) = (ring(&outer), holes.iter().map(ring).collect());
        whole &= std::iter::once(&polygon).chain(&inner).all(|ring| ring.len() <= MAX_POLYLINE_POINTS);
        fillings.push((polygon, inner, gaps.iter().map(ring).collect::<Vec<_>>()));
        edges.push(outer);
        edges.extend(holes);
    }
    if whole {
        fillings.into_iter().for_each(|(polygon, holes, _)| drawing.area(polygon, holes));
    } else {
        drawing.strips(&rings);
        let gaps = fillings.into_iter().flat_map(|(_, _, gaps)| gaps);
        gaps.for_each(|gap| drawing.area(gap, Vec::new()));
    }
    drawing.edges(&edges, ways);
    true
}

fn units(p: Vec2) -> IntPoint<i32> {
    // Saturates: the limits of the map are checked elsewhere.
    IntPoint::new((p.x * UNITS).round() as i32, (p.y * UNITS).round() as i32)
}

fn metres(p: IntPoint<i32>) -> Vec2 {
    Vec2::new(f64::from(p.x), f64::from(p.y)) / UNITS
}

/// A strip as a slightly enlarged ring, counter-clockwise; each corner has the label of the segment that
/// follows.
fn ring(strip: &Strip) -> Option<Vec<(Vec2, Label)>> {
    let count = strip.right.len().min(strip.left.len());
    if count < 2 {
        return None;
    }
    let unit = |v: Vec2| v / v.norm().max(1e-9);
    let (mut right, mut left) = (strip.right[..count].to_vec(), strip.left[..count].to_vec());
    for (r, l) in right.iter_mut().zip(&mut left) {
        let out = unit(*r - *l) * BEYOND_SIDE_M;
        (*r, *l) = (*r + out, *l - out);
    }
    for (end, before, joined) in [(0, 1, strip.joined[0]), (count - 1, count - 2, strip.joined[1])] {
        if joined {
            let way = unit(right[end] + left[end] - right[before] - left[before]) * BEYOND_END_M;
            right[end] += way;
            left[end] += way;
        }
    }
    let label = |side| Label { side, junction: strip.junction };
    let line = |inner: bool| label(if inner { Side::Inner } else { Side::Outer });
    let cap = |joined: bool| label(if joined { Side::Joined } else { Side::Open });
    let mut ring: Vec<(Vec2, Label)> = right.iter().map(|p| (*p, line(strip.inner[0]))).collect();
    ring[count - 1].1 = cap(strip.joined[1]);
    ring.extend(left.iter().rev().map(|p| (*p, line(strip.inner[1]))));
    ring[2 * count - 1].1 = cap(strip.joined[0]);
    Some(ring)
}

/// Number of pairs of pieces in the same grid square, an estimate of the crossings, and number of pieces.
fn pairs(rings: &[Vec<(Vec2, Label)>]) -> (u64, u64) {
    let mut squares: HashMap<(i64, i64), u64> = HashMap::new();
    let mut pieces = 0;
    for ring in rings {
        for (i, (a, _)) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()].0;
            let stretches = ((b - a).norm() / SQUARE_M).ceil().clamp(1.0, 10_000.0) as u64;
            pieces += stretches;
            if pieces > MOST_PAIRS / 8 {
                return (u64::MAX, pieces);
            }
            for k in 0..stretches {
                let p = a + (b - a) * ((k as f64 + 0.5) / stretches as f64);
                *squares.entry(((p.x / SQUARE_M) as i64, (p.y / SQUARE_M) as i64)).or_default() += 1;
            }
        }
    }
    (squares.values().map(|count| count * count).sum(), pieces)
}

/// Whether a hole lies between paths through a junction, so that cars do drive on it.
fn is_gap(hole: &[(Vec2, Label)]) -> bool {
    let (mut area_m2, mut length_m, mut within_m) = (0.0, 0.0, 0.0);
    for (i, (a, label)) in hole.iter().enumerate() {
        let b = hole[(i + 1) % hole.len()].0;
        area_m2 += cross(*a, b) / 2.0;
        length_m += (b - a).norm();
        if label.junction || matches!(label.side, Side::Joined | Side::Open) {
            within_m += (b - a).norm();
        }
    }
    area_m2.abs() < GAP_M2 && within_m > 0.8 * length_m
}

struct Drawing<'a, F> {
    map: &'a mut LaneMap,
    id: F,
}

impl<F: FnMut() -> String> Drawing<'_, F> {
    fn area(&mut self, polygon: Vec<Vec2>, holes: Vec<Vec<Vec2>>) {
        let polygon = fitting(polygon);
        if polygon.len() > 2 {
            let holes =
                holes.into_iter().map(fitting).filter(|hole| hole.len() > 2).map(Into::into).collect();
            self.map.drivable.push(Area { id: (self.id)(), polygon: polygon.into(), holes });
        }
    }

    /// Adds the strips without uniting them.
    fn strips(&mut self, rings: &[Vec<(Vec2, Label)>]) {
        for ring in rings {
            let points: Vec<Vec2> = ring.iter().map(|(p, _)| *p).collect();
            self.area(simplify(&points, KEPT_M.0, KEPT_M.1), Vec::new());
        }
    }

    /// Road edges from `contours`, which have the surface on their left.
    fn edges(&mut self, contours: &[Vec<(Vec2, Label)>], ways: &[Vec<Vec2>]) {
        let ways = SegmentIndex::new(
            ways.iter().zip(0..).flat_map(|(way, i)| scene::geometry::segments::pieces(way, i)).collect(),
        );
        let inner = |contour: &Vec<(Vec2, Label)>| -> Vec<Segment> {
            let pieces = pieces_of(contour).filter(|(_, label)| label.side == Side::Inner);
            pieces.map(|((from, to), _)| Segment { from, to, owner: 0, piece: 0 }).collect()
        };
        let facing = SegmentIndex::new(contours.iter().flat_map(inner).collect());
        for contour in contours {
            let kinds: Vec<Option<bool>> =
                pieces_of(contour).map(|((a, b), label)| kind_of(a, b, label, &ways, &facing)).collect();
            self.runs(contour, &kinds);
        }
    }

    /// Draws stretches of one kind (median or not) of a contour.
    fn runs(&mut self, contour: &[(Vec2, Label)], kinds: &[Option<bool>]) {
        let count = contour.len();
        // Not in the middle of a stretch, unless all of it is one stretch.
        let start = (0..count).find(|i| kinds[*i] != kinds[(i + count - 1) % count]).unwrap_or(0);
        let mut line: Vec<Vec2> = Vec::new();
        for step in 0..=count {
            let (i, before) = ((start + step) % count, (start + step + count - 1) % count);
            let ends = step == count || (step > 0 && kinds[i] != kinds[before]) || line.len() >= LONGEST;
            if ends && step > 0 {
                if let (Some(median), false) = (kinds[before], line.is_empty()) {
                    line.push(contour[i].0);
                    let line_type = if median { "median" } else { "boundary" }.to_owned();
                    let points = simplify(&line, KEPT_M.0, KEPT_M.1).into();
                    self.map.road_edges.push(TypedLine { id: (self.id)(), line_type, points });
                }
                line.clear();
            }
            if step < count && kinds[i].is_some() {
                line.push(contour[i].0);
            }
        }
    }
}

/// A ring with no more points than a map allows: finer ones are simplified as far as necessary.
fn fitting(ring: Vec<Vec2>) -> Vec<Vec2> {
    let mut kept = ring;
    let mut off_m = KEPT_M.0;
    while kept.len() > MAX_POLYLINE_POINTS {
        let before = kept.len();
        off_m *= 2.0;
        kept = simplify(&kept, off_m, f64::INFINITY);
        if kept.len() == before {
            kept = kept.iter().copied().step_by(2).collect();
        }
    }
    kept
}

fn pieces_of(contour: &[(Vec2, Label)]) -> impl Iterator<Item = ((Vec2, Vec2), Label)> + '_ {
    (0..contour.len()).map(|i| ((contour[i].0, contour[(i + 1) % contour.len()].0), contour[i].1))
}

/// Whether a segment bounds a median; `None` if it is no edge.
fn kind_of(a: Vec2, b: Vec2, label: Label, ways: &SegmentIndex, facing: &SegmentIndex) -> Option<bool> {
    let (middle, half_m) = ((a + b) / 2.0, (b - a).norm() / 2.0);
    let crossed = ways.near(middle, half_m + 1.0).any(|way| way.crosses(a, b));
    if label.side == Side::Open || crossed {
        return None;
    }
    let way = (b - a) / (b - a).norm().max(1e-9);
    let across = |other: &Segment| {
        let foot = other.foot(middle);
        let (gap_m, along) = ((foot - middle).norm(), other.to - other.from);
        // The other edge lies beyond this one, runs the other way, and has the road on its far side.
        gap_m < MEDIAN_M && cross(way, foot - middle) < 0.0 && along.dot(&way) < -0.7 * along.norm()
    };
    Some(label.side == Side::Inner && facing.near(middle, MEDIAN_M).any(across))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(from: Vec2, to: Vec2, width_m: f64) -> Strip {
        let way = (to - from).normalize();
        let side = Vec2::new(-way.y, way.x) * (width_m / 2.0);
        let line =
            |offset: Vec2| (0..=20).map(|i| from + (to - from) * (f64::from(i) / 20.0) + offset).collect();
        Strip { right: line(-side), left: line(side), joined: [false; 2], ..Strip::default() }
    }

    fn drawn(strips: &[Strip], ways: &[Vec<Vec2>]) -> LaneMap {
        let mut map = LaneMap::default();
        let mut next = 0;
        assert!(draw(&mut map, strips, ways, || {
            next += 1;
            next.to_string()
        }));
        map
    }

    fn length(map: &LaneMap) -> f64 {
        map.road_edges.iter().map(|edge| crate::polyline::length(&edge.points.xy)).sum()
    }

    #[test]
    fn rings_have_no_more_points_than_a_map_may_have() {
        let jagged = |count: usize, deep_m: f64| -> Vec<Vec2> {
            (0..count).map(|i| Vec2::new(i as f64, if i % 2 == 0 { 0.0 } else { deep_m })).collect()
        };
        for (count, deep_m) in [(4_097, 0.03), (10_000, 5.0), (20_000, 1e6)] {
            let ring = fitting(jagged(count, deep_m));
            assert!((3..=MAX_POLYLINE_POINTS).contains(&ring.len()), "{}", ring.len());
        }
        let small = jagged(4_096, 0.0);
        assert_eq!(fitting(small.clone()), small, "one that fits stays as it is");
    }

    #[test]
    fn a_road_has_two_edges_and_open_ends() {
        let map = drawn(&[straight(Vec2::zeros(), Vec2::new(100.0, 0.0), 7.0)], &[]);
        assert_eq!(map.road_edges.len(), 2);
        assert!((length(&map) - 200.0).abs() < 0.1);
        let on_side = |p: &Vec2| (p.y.abs() - 3.5).abs() < 0.02;
        assert!(map.road_edges.iter().all(|edge| edge.points.xy.iter().all(on_side)));
        assert_eq!(map.drivable.len(), 1);
    }

    #[test]
    fn roads_that_go_on_have_no_edge_between_them() {
        let mut near = straight(Vec2::zeros(), Vec2::new(50.0, 0.0), 7.0);
        let mut far = straight(Vec2::new(50.002, 0.0), Vec2::new(100.0, 0.0), 7.0);
        (near.joined, far.joined) = ([false, true], [true, false]);
        let map = drawn(&[near, far], &[]);
        assert!((length(&map) - 200.0).abs() < 0.1, "{:?}", map.road_edges);
    }

    #[test]
    fn ways_through_a_junction_are_one_surface() {
        let mut along = straight(Vec2::new(-20.0, 0.0), Vec2::new(20.0, 0.0), 6.0);
        let mut over = straight(Vec2::new(0.0, -20.0), Vec2::new(0.0, 20.0), 6.0);
        (along.junction, over.junction) = (true, true);
        let way = vec![Vec2::new(-20.0, 0.0), Vec2::new(20.0, 0.0)];
        let map = drawn(&[along, over], std::slice::from_ref(&way));
        assert!((length(&map) - 8.0 * 17.0).abs() < 0.2);
        let crossed = |edge: &TypedLine| {
            edge.points
                .xy
                .windows(2)
                .any(|w| Segment { from: way[0], to: way[1], owner: 0, piece: 0 }.crosses(w[0], w[1]))
        };
        assert!(!map.road_edges.iter().any(crossed));
    }

    #[test]
    fn inner_edges_that_face_each_other_enclose_a_median() {
        let mut there = straight(Vec2::new(0.0, -5.0), Vec2::new(100.0, -5.0), 6.0);
        let mut back = straight(Vec2::new(100.0, 5.0), Vec2::new(0.0, 5.0), 6.0);
        (there.inner, back.inner) = ([false, true], [false, true]);
        let map = drawn(&[there.clone(), back], &[]);
        let medians: Vec<_> = map.road_edges.iter().filter(|edge| edge.line_type == "median").collect();
        assert_eq!(medians.len(), 2);
        assert!(medians.iter().all(|edge| edge.points.xy.iter().all(|p| (p.y.abs() - 2.0).abs() < 0.02)));
        assert!(drawn(&[there], &[]).road_edges.iter().all(|edge| edge.line_type == "boundary"));
    }

    #[test]
    fn what_is_tangled_gives_ground_alone() {
        let fan = |i: i32| straight(Vec2::zeros(), Vec2::new(80.0, f64::from(i) * 1e-3), 6.0);
        let strips: Vec<Strip> = (0..600).map(fan).collect();
        let mut map = LaneMap::default();
        assert!(!draw(&mut map, &strips, &[], String::new));
        assert_eq!((map.road_edges.len(), map.drivable.len()), (0, 600));
    }
}
