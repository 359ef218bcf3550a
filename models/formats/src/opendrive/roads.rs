//! Converts lanes to roads of one lane each, and places where several meet to junctions.
//!
//! A lane that leads through a junction between two others is a connecting road. If lanes diverge or merge
//! without one, the first metre of the entered lane becomes a connecting road for each lane that enters it.

use crate::joints::{Groups, Joints, end_of, join_crossing, start_of};
use crate::polyline::{arc_lengths, length, part, simplify};
use scene::Vec2;
use scene::map::{Lane, LaneMap};
use std::collections::{BTreeMap, BTreeSet};

/// Length of a connecting road that is cut off a lane, metres, and its greatest share of the lane.
const CUT_M: f64 = 1.0;
const CUT_SHARE: f64 = 0.25;
/// Greatest distance by which an end of a way through a junction is moved to meet the lane, metres.
const BENT_M: f64 = 2.0;
/// Tolerance of reference lines against centre lines, and their longest segment, metres.
const KEPT_M: (f64, f64) = (0.02, 1_000.0);

/// Target of a road's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RoadLink {
    /// The other end of that road.
    Road(usize),
    Junction(usize),
}

/// A road of one lane.
#[derive(Clone, Debug)]
pub(super) struct Road<'a> {
    /// Lane with type, width and limit.
    pub lane: &'a Lane,
    pub points: Vec<Vec2>,
    /// The reference line, where it has fewer points.
    simplified: Option<Vec<Vec2>>,
    /// The junction that it leads through.
    pub junction: Option<usize>,
    pub predecessor: Option<RoadLink>,
    pub successor: Option<RoadLink>,
}

impl Road<'_> {
    /// The reference line.
    pub fn line(&self) -> &[Vec2] {
        self.simplified.as_deref().unwrap_or(&self.points)
    }
}

/// Roads by number; those of the lanes come first, in their order.
#[derive(Clone, Debug, Default)]
pub(super) struct Roads<'a> {
    pub roads: Vec<Road<'a>>,
    /// Connecting roads of each junction.
    pub junctions: BTreeMap<usize, Vec<usize>>,
    /// Number of beginnings of lanes that became separate roads.
    pub cut: usize,
}

/// Links between lanes, by the form in which they are written.
struct LaneLinks {
    links: BTreeSet<(usize, usize)>,
    /// Lanes that are connecting roads, with the lanes that they connect: one before, one after, neither of
    /// them a connecting road.
    connectors: BTreeMap<usize, (usize, usize)>,
    /// Lanes whose beginnings are cut off.
    cut: BTreeSet<usize>,
}

impl LaneLinks {
    fn of(map: &LaneMap) -> Self {
        let Joints { links, ins, outs } = Joints::of(map);
        let mut connectors: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
        for (i, lane) in map.lanes.iter().enumerate() {
            if let (true, [from], [to]) = (lane.interpolating, &ins[i][..], &outs[i][..])
                && from != to
                && !connectors.contains_key(from)
                && !map.lanes[*to].interpolating
            {
                connectors.insert(i, (*from, *to));
            }
        }
        // If one connection enters a lane through its cut beginning, every connection does.
        loop {
            let plain = |a: usize, b: usize| outs[a].len() == 1 && ins[b].len() == 1;
            let bare = |a: &usize, b: &usize| !connectors.contains_key(a) && !connectors.contains_key(b);
            let cut: BTreeSet<usize> =
                links.iter().filter(|(a, b)| bare(a, b) && !plain(*a, *b)).map(|(_, b)| *b).collect();
            let before = connectors.len();
            connectors.retain(|_, (_, to)| !cut.contains(to));
            if connectors.len() == before {
                return Self { links, connectors, cut };
            }
        }
    }
}

/// The roads of a map.
pub(super) fn roads(map: &LaneMap) -> Roads<'_> {
    let LaneLinks { links, connectors, cut } = LaneLinks::of(map);
    let mut groups = Groups::of(map.lanes.len());
    let road = |lane| Road {
        lane,
        points: Vec::new(),
        simplified: None,
        junction: None,
        predecessor: None,
        successor: None,
    };
    let mut all: Vec<Road<'_>> = map.lanes.iter().map(road).collect();
    for (i, road) in all.iter_mut().enumerate() {
        let points = &map.lanes[i].points.xy;
        road.points =
            if cut.contains(&i) { part(points, cut_m(points), length(points)) } else { points.clone() };
    }
    for (i, (from, to)) in &connectors {
        let ends = (map.lanes[*from].points.xy.last(), map.lanes[*to].points.xy.first());
        if let (Some(begin), Some(end)) = ends {
            bend(&mut all[*i].points, *begin, *end);
        }
    }
    // Connecting roads, with the lanes that they connect.
    let mut connecting: Vec<(usize, usize, usize)> =
        connectors.iter().map(|(road, (from, to))| (*road, *from, *to)).collect();
    let cut_off = links.iter().filter(|(_, b)| cut.contains(b)).count();
    connecting.reserve_exact(cut_off);
    all.reserve_exact(cut_off);
    for (a, b) in links {
        let (a, b) = (&a, &b);
        if connectors.contains_key(a) || connectors.contains_key(b) {
            continue;
        }
        if cut.contains(b) {
            let lane = &map.lanes[*b];
            connecting.push((all.len(), *a, *b));
            let mut points = part(&lane.points.xy, 0.0, cut_m(&lane.points.xy));
            // If the lanes have a small gap, the connector bridges it.
            if let (Some(first), Some(end)) = (points.first_mut(), map.lanes[*a].points.xy.last()) {
                *first = *end;
            }
            all.push(Road { points, ..road(lane) });
        } else {
            all[*a].successor = Some(RoadLink::Road(*b));
            all[*b].predecessor = Some(RoadLink::Road(*a));
        }
    }
    for road in &mut all {
        let line = simplify(&road.points, KEPT_M.0, KEPT_M.1);
        road.simplified = (line.len() < road.points.len()).then_some(line);
    }
    for (_, from, to) in &connecting {
        groups.join(end_of(*from), start_of(*to));
    }
    let ways: Vec<(&[Vec2], usize)> =
        connecting.iter().map(|(road, from, _)| (&all[*road].points[..], end_of(*from))).collect();
    join_crossing(&ways, &mut groups);
    let mut junctions: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, from, to) in &connecting {
        let junction = groups.root(end_of(*from));
        junctions.entry(junction).or_default().push(*i);
        let road = &mut all[*i];
        road.junction = Some(junction);
        (road.predecessor, road.successor) = (Some(RoadLink::Road(*from)), Some(RoadLink::Road(*to)));
        all[*from].successor = Some(RoadLink::Junction(junction));
        all[*to].predecessor = Some(RoadLink::Junction(junction));
    }
    Roads { roads: all, junctions, cut: cut.len() }
}

/// Moves a way so that it begins and ends at these positions, if they are near: points near an end move more.
fn bend(points: &mut [Vec2], begin: Vec2, end: Vec2) {
    let (Some(first), Some(last)) = (points.first().copied(), points.last().copied()) else { return };
    let (before, after) = (begin - first, end - last);
    if before.norm().max(after.norm()) > BENT_M {
        return;
    }
    let along = arc_lengths(points);
    let total = along.last().copied().unwrap_or_default().max(f64::MIN_POSITIVE);
    for (p, s) in points.iter_mut().zip(along) {
        let share = s / total;
        // Flat at both ends, so that headings there are preserved.
        let share = share * share * (3.0 - 2.0 * share);
        *p += (1.0 - share) * before + share * after;
    }
}

fn cut_m(points: &[Vec2]) -> f64 {
    CUT_M.min(CUT_SHARE * length(points))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_bent_to_where_lanes_go_on() {
        let mut points: Vec<Vec2> = (0..=8).map(|i| Vec2::new(f64::from(i), 0.0)).collect();
        let far = points.clone();
        bend(&mut points, Vec2::new(0.0, 0.0), Vec2::new(8.0, 0.75));
        assert_eq!((points[0], points[8], points[4].y), (Vec2::zeros(), Vec2::new(8.0, 0.75), 0.375));
        let mut apart = far.clone();
        bend(&mut apart, Vec2::zeros(), Vec2::new(8.0, 5.0));
        assert_eq!(apart, far);
    }
}
