//! Painted lines and edges of the carriageway: what separates lanes, directions and the sidewalk.

use super::kerb::{Borders, Corner, JunctionArea};
use super::map::Builder;
use super::net::LaneKind;
use crate::polyline::{offset_right, resample, simplify, tangents};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::TypedLine;
use std::cell::Cell;

/// Left borders nearer than this to those of oncoming traffic are one painted line, metres.
const TOUCHING_M: f64 = 0.6;
/// Left borders up to this far from those of oncoming traffic enclose a median, metres.
const MEDIAN_M: f64 = 15.0;

impl Builder<'_> {
    fn line(&mut self, line_type: &str, points: Vec<Vec2>) {
        if points.len() > 1 {
            let (id, points) = (self.id(), simplify(&points, 0.03, 20.0).into());
            self.out.map.road_lines.push(TypedLine { id, line_type: line_type.to_owned(), points });
        }
    }

    fn edge(&mut self, line_type: &str, points: Vec<Vec2>) {
        if points.len() > 1 {
            let (id, points) = (self.id(), simplify(&points, 0.02, 20.0).into());
            self.out.map.road_edges.push(TypedLine { id, line_type: line_type.to_owned(), points });
        }
    }

    /// Painted lines between lanes of one direction.
    pub(super) fn lane_lines(&mut self, all: &[Borders]) {
        for borders in all {
            let edge = &self.net.edges[borders.edge];
            let inner: Vec<usize> = edge
                .lanes
                .iter()
                .copied()
                .filter(|&l| self.net.lanes[l].kind != LaneKind::Sidewalk)
                .collect();
            for pair in inner.windows(2) {
                let (a, b) = (&self.net.lanes[pair[0]], &self.net.lanes[pair[1]]);
                let both = a.kind == LaneKind::Vehicle && b.kind == LaneKind::Vehicle;
                let line_type = if both { "broken_single_white" } else { "solid_single_white" };
                self.line(line_type, offset_right(&a.shape, -a.width_m / 2.0));
            }
        }
    }

    /// Painted lines where a turn lane opens: beside each lane that has one to its left.
    pub(super) fn taper_lines(&mut self) {
        let net = self.net;
        let mut inner: Vec<(usize, usize)> = self.tapers.iter().map(|(l, ends)| (ends.0, *l)).collect();
        inner.sort_unstable();
        for pair in inner.windows(2) {
            let ((before, lane), (next_before, next)) = (pair[0], pair[1]);
            if net.lanes[before].edge != net.lanes[next_before].edge || before == next_before {
                continue;
            }
            let both = [lane, next].iter().all(|&l| net.lanes[l].kind == LaneKind::Vehicle);
            let line_type = if both { "broken_single_white" } else { "solid_single_white" };
            self.line(line_type, offset_right(&net.lanes[lane].shape, -net.lanes[lane].width_m / 2.0));
        }
    }

    /// Right borders, and left borders by what lies beyond them: oncoming traffic, a median, nothing.
    pub(super) fn edges(&mut self, all: &[Borders]) {
        let extents = extents(all);
        for (b, borders) in all.iter().enumerate() {
            let lot = self.is_lot(borders.edge);
            if !lot {
                self.edge("boundary", borders.right.clone());
            }
            let line = resample(&borders.left, 2.0);
            let ways = tangents(&line);
            let sides: Vec<LeftSide> = line
                .iter()
                .zip(&ways)
                .map(|(p, way)| left_side(*p, *way, Some(b), all, &extents, &self.left_checks))
                .collect();
            let mut from = 0;
            for to in 1..=sides.len() {
                if to < sides.len() && sides[to].kind() == sides[from].kind() {
                    continue;
                }
                let piece = line[from..(to + 1).min(line.len())].to_vec();
                match sides[from] {
                    LeftSide::Oncoming(other) if other < b => {}
                    // Nothing is painted in the middle of a road that is one lane wide.
                    LeftSide::Oncoming(other) if self.narrow.share(borders.edge, all[other].edge) => {}
                    LeftSide::Oncoming(_) => {
                        let quiet = self.net.edges[borders.edge].road_type == "residential" || lot;
                        let line = if quiet { "broken_single_yellow" } else { "solid_double_yellow" };
                        self.line(line, piece);
                    }
                    LeftSide::Median => self.edge("median", piece),
                    LeftSide::Open => self.edge("boundary", piece),
                }
                from = to;
            }
        }
    }

    pub(super) fn corners(&mut self, all: &[Borders], junctions: &[JunctionArea]) {
        let extents = extents(all);
        for junction in junctions {
            // At a node with two arms the road continues, and so does its median or centre line.
            for Corner { points, from, to, turn_rad } in &junction.corners {
                let mixed = self.is_lot(from.0) != self.is_lot(to.0);
                let merging = turn_rad.abs() > 2.4;
                let both_lots = self.is_lot(from.0) && self.is_lot(to.0);
                if mixed || both_lots || merging {
                    continue;
                }
                // A corner from the right border of an inbound edge to the right border of an outbound edge
                // is a kerb. The reverse is the left side of the road between two one-way edges.
                let (first, last) = (points[0], points[points.len() - 1]);
                if from.1 || !to.1 || junction.arms > 2 {
                    self.edge("boundary", points.clone());
                    continue;
                }
                let way = (first - last) / (first - last).norm().max(1e-9);
                match left_side((first + last) / 2.0, way, None, all, &extents, &self.left_checks) {
                    LeftSide::Oncoming(other) if self.narrow.has(all[other].edge) => {}
                    LeftSide::Oncoming(_) => self.line("solid_double_yellow", points.clone()),
                    LeftSide::Median => self.edge("median", points.clone()),
                    LeftSide::Open => self.edge("boundary", points.clone()),
                }
            }
        }
    }
}

#[derive(Clone, Copy)]
enum LeftSide {
    /// The left border at this index is the same line.
    Oncoming(usize),
    Median,
    Open,
}

impl LeftSide {
    fn kind(self) -> (u8, usize) {
        match self {
            Self::Oncoming(other) => (0, other),
            Self::Median => (1, 0),
            Self::Open => (2, 0),
        }
    }
}

/// Corners of the bounding boxes of left borders, enlarged by the greatest width of a median.
fn extents(all: &[Borders]) -> Vec<(Vec2, Vec2)> {
    let margin = Vec2::repeat(MEDIAN_M);
    let fold = |b: &Borders, pick: fn(f64, f64) -> f64| {
        b.left.iter().skip(1).fold(b.left[0], |a, p| Vec2::new(pick(a.x, p.x), pick(a.y, p.y)))
    };
    all.iter().map(|b| (fold(b, f64::min) - margin, fold(b, f64::max) + margin)).collect()
}

/// What lies to the left of point `p` on a left border with direction `way`. `checks` is the number of
/// comparisons left; at zero, nothing lies there.
fn left_side(
    p: Vec2,
    way: Vec2,
    own: Option<usize>,
    all: &[Borders],
    extents: &[(Vec2, Vec2)],
    checks: &Cell<u64>,
) -> LeftSide {
    let mut best = (MEDIAN_M, None);
    for (b, other) in all.iter().enumerate().filter(|(b, _)| Some(*b) != own) {
        let (low, high) = extents[b];
        if p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y {
            continue;
        }
        let cost = other.left.len() as u64;
        if checks.get() < cost {
            return LeftSide::Open;
        }
        checks.set(checks.get() - cost);
        for w in other.left.windows(2) {
            let along = w[1] - w[0];
            let share = ((p - w[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
            let foot = w[0] + along * share;
            let gap = (foot - p).norm();
            // Beyond the left border, and the other way round.
            let beyond = gap < TOUCHING_M || cross(way, foot - p) > 0.0;
            if gap < best.0 && beyond && along.dot(&way) < -0.7 * along.norm() {
                best = (gap, Some(b));
            }
        }
    }
    match best {
        (gap, Some(b)) if gap < TOUCHING_M => LeftSide::Oncoming(b),
        (_, Some(_)) => LeftSide::Median,
        _ => LeftSide::Open,
    }
}
