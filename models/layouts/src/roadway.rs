//! A road along a line: lanes of both directions, cycle lanes, strips for parked cars, paint, a median.

use crate::curve::{self, tidy};
use crate::draft::MapDraft;
use scene::Vec2;
use scene::geometry::direction;
use scene::map::LaneType;
use std::f64::consts::PI;

/// A narrower median is painted, not raised, metres.
const RAISED_M: f64 = 0.8;
/// Paved width between the outer lane and the kerb, metres.
pub const GAP_M: f64 = 0.4;
/// Distance between a raised median and the lanes, metres.
const GUTTER_M: f64 = 0.2;
/// Solid lines separate lanes over this length before a stop line, metres.
pub const SOLID_M: f64 = 20.0;

/// Cross-section of a road.
#[derive(Clone, Debug)]
pub struct Profile {
    /// Lanes along the line (right of it) and against it (left of it).
    pub lanes: [usize; 2],
    pub lane_m: f64,
    pub cycle_m: f64,
    pub parking_m: f64,
    pub median_m: f64,
    pub limit_kmh: f64,
}

/// Lanes of one side, from the middle of the road to the kerb.
#[derive(Clone, Debug, Default)]
pub struct Side {
    pub lanes: Vec<usize>,
    pub cycle: Option<usize>,
}

impl Side {
    pub fn all(&self) -> Vec<usize> {
        self.lanes.iter().copied().chain(self.cycle).collect()
    }
}

/// A road that is drawn.
#[derive(Clone, Debug)]
pub struct Roadway {
    pub right: Side,
    pub left: Side,
}

/// A road to draw.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    pub id: &'a str,
    pub profile: &'a Profile,
    /// The line.
    pub axis: &'a [Vec2],
    /// Width of the median at each point of the line, metres.
    pub median_m: &'a [f64],
    /// The median is raised up to this distance from the beginning, metres.
    pub raised_m: f64,
    /// Whether traffic against the line has a stop line at its beginning, and traffic along it at its end.
    pub stops: [bool; 2],
}

impl Profile {
    /// Distance from the line to the kerb to the right (0) and left (1), with the median at its nominal
    /// width, metres.
    pub fn half_m(&self, side: usize) -> f64 {
        self.kerb_m(side, self.median_m)
    }

    pub fn kerb_m(&self, side: usize, median_m: f64) -> f64 {
        let lanes = self.lanes[side];
        if lanes == 0 {
            return GAP_M;
        }
        self.middle_m(median_m) / 2.0 + lanes as f64 * self.lane_m + self.cycle_m + self.parking_m + GAP_M
    }

    /// Width of the median; a one-way road has none.
    pub fn middle_m(&self, median_m: f64) -> f64 {
        if self.lanes.contains(&0) { 0.0 } else { median_m }
    }
}

impl Plan<'_> {
    fn offset(&self, side: usize, beyond_m: f64) -> Vec<Vec2> {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let middle = |i: usize| self.profile.middle_m(self.median_m[i]) / 2.0;
        let even = self.median_m.windows(2).all(|w| (w[0] - w[1]).abs() < 1e-9);
        if even {
            return curve::parallel(self.axis, sign * (middle(0) + beyond_m));
        }
        let out = curve::parallel(self.axis, 1.0);
        (0..self.axis.len())
            .map(|i| self.axis[i] + (out[i] - self.axis[i]) * (sign * (middle(i) + beyond_m)))
            .collect()
    }

    /// The kerb beside the lanes along the line (0) or against it (1), in the direction of the line.
    pub fn kerb(&self, side: usize) -> Vec<Vec2> {
        let profile = self.profile;
        if profile.lanes[side] == 0 {
            return self.offset(side, GAP_M);
        }
        self.offset(side, profile.kerb_m(side, 0.0))
    }

    /// Draws lanes and paint. The caller draws the kerbs.
    pub fn draw(&self, draft: &mut MapDraft) -> Roadway {
        let [right, left] = [0, 1].map(|side| self.side(draft, side));
        self.middle(draft, &right, &left);
        Roadway { right, left }
    }

    /// The line in the direction of traffic of a side.
    fn driven(side: usize, mut line: Vec<Vec2>) -> Vec<Vec2> {
        if side == 1 {
            line.reverse();
        }
        line
    }

    fn side(&self, draft: &mut MapDraft, side: usize) -> Side {
        let profile = self.profile;
        let count = profile.lanes[side];
        if count == 0 {
            return Side::default();
        }
        let word = if side == 0 { "out" } else { "in" };
        let mut out = Side::default();
        for i in 0..count {
            let line = Self::driven(side, self.offset(side, (i as f64 + 0.5) * profile.lane_m));
            let id = format!("{}.{word}{}", self.id, i + 1);
            out.lanes.push(draft.lane(id, LaneType::SurfaceStreet, line, profile.lane_m, profile.limit_kmh));
        }
        let mut at_m = count as f64 * profile.lane_m;
        for i in 1..count {
            let line = self.offset(side, i as f64 * profile.lane_m);
            let painted = self.between(draft, side, line);
            draft.beside(out.lanes[i - 1], out.lanes[i]);
            draft.bound(out.lanes[i - 1], false, &painted);
            draft.bound(out.lanes[i], true, &painted);
        }
        if profile.cycle_m > 0.0 {
            let line = Self::driven(side, self.offset(side, at_m + profile.cycle_m / 2.0));
            let id = format!("{}.{word}-cycle", self.id);
            let limit_kmh = profile.limit_kmh.min(25.0);
            let cycle = draft.lane(id, LaneType::BikeLane, line, profile.cycle_m, limit_kmh);
            let painted = self.offset(side, at_m);
            let painted = draft.line("solid_single_white", Self::driven(side, painted));
            draft.beside(out.lanes[count - 1], cycle);
            draft.bound(out.lanes[count - 1], false, &painted);
            draft.bound(cycle, true, &painted);
            out.cycle = Some(cycle);
            at_m += profile.cycle_m;
        }
        if profile.parking_m > 0.0 {
            let line = Self::driven(side, self.offset(side, at_m + profile.parking_m / 2.0));
            let id = format!("{}.{word}-parking", self.id);
            draft.lane(id, LaneType::Parking, line, profile.parking_m, 0.0);
            let painted = self.offset(side, at_m);
            draft.line("solid_single_white", Self::driven(side, painted));
        }
        out
    }

    /// Paint between two lanes of a side: broken, and solid before a stop line.
    fn between(&self, draft: &mut MapDraft, side: usize, line: Vec<Vec2>) -> String {
        let mut line = Self::driven(side, line);
        let stops = if side == 0 { self.stops[1] } else { self.stops[0] };
        let length_m = curve::length(&line);
        if stops && length_m > SOLID_M + 5.0 {
            let last = split(&mut line, length_m - SOLID_M);
            draft.line("solid_single_white", last);
        }
        draft.line("broken_single_white", line)
    }

    fn middle(&self, draft: &mut MapDraft, right: &Side, left: &Side) {
        let (Some(first_right), Some(first_left)) = (right.lanes.first(), left.lanes.first()) else { return };
        let (first_right, first_left) = (*first_right, *first_left);
        let widest = self.median_m.iter().copied().fold(0.0, f64::max);
        if widest < 0.05 {
            let lanes = right.lanes.len() + left.lanes.len();
            let mut line = self.axis.to_vec();
            let id = if lanes > 2 {
                draft.line("solid_double_yellow", line)
            } else {
                for (stops, at_end) in [(self.stops[0], false), (self.stops[1], true)] {
                    let length_m = curve::length(&line);
                    if !stops || length_m < SOLID_M + 5.0 {
                        continue;
                    }
                    let cut = if at_end { length_m - SOLID_M } else { SOLID_M };
                    let mut rest = split(&mut line, cut);
                    if !at_end {
                        std::mem::swap(&mut line, &mut rest);
                    }
                    draft.line("solid_single_yellow", rest);
                }
                draft.line("broken_single_yellow", line)
            };
            draft.bound(first_right, true, &id);
            draft.bound(first_left, true, &id);
            return;
        }
        for (side, lane) in [(0, first_right), (1, first_left)] {
            let id = draft.line("solid_single_yellow", Self::driven(side, self.offset(side, 0.0)));
            draft.bound(lane, true, &id);
        }
        if let Some(ring) = self.island() {
            draft.island(ring);
        }
    }

    /// The raised median, counter-clockwise, with round ends; square at the edge of the map.
    fn island(&self) -> Option<Vec<Vec2>> {
        let mut at_m = 0.0;
        let mut kept = Vec::new();
        for (i, p) in self.axis.iter().enumerate() {
            at_m += if i > 0 { (p - self.axis[i - 1]).norm() } else { 0.0 };
            let half_m = self.median_m[i] / 2.0 - GUTTER_M;
            if at_m > self.raised_m || half_m < RAISED_M / 2.0 - GUTTER_M {
                break;
            }
            kept.push((*p, half_m));
        }
        if kept.len() < 2 {
            return None;
        }
        let whole = kept.len() == self.axis.len();
        let points: Vec<Vec2> = kept.iter().map(|(p, _)| *p).collect();
        let out = curve::parallel(&points, 1.0);
        let side = |sign: f64| -> Vec<Vec2> {
            (0..points.len()).map(|i| points[i] + (out[i] - points[i]) * (sign * kept[i].1)).collect()
        };
        let (mut right, left) = (side(-1.0), side(1.0));
        let round = |at: Vec2, half_m: f64, from: Vec2| -> Vec<Vec2> {
            let start = (from - at).y.atan2((from - at).x);
            (1..8).map(|k| at + direction(start + PI * f64::from(k) / 8.0) * half_m).collect()
        };
        let last = points.len() - 1;
        let mut ring = Vec::new();
        ring.append(&mut right);
        if whole && !self.stops[1] {
            // Just inside the edge of the map, so that the island stays a hole in the ground.
            let back = (points[last - 1] - points[last]).normalize() * 0.05;
            let count = ring.len();
            ring[count - 1] += back;
            ring.push(left[last] + back);
        } else {
            ring.extend(round(points[last], kept[last].1, ring[ring.len() - 1]));
            ring.push(left[last]);
        }
        ring.extend(left[..last].iter().rev());
        if self.stops[0] || self.raised_m.is_finite() {
            ring.extend(round(points[0], kept[0].1, left[0]));
        } else {
            let ahead = (points[1] - points[0]).normalize() * 0.05;
            let count = ring.len();
            ring[count - 1] += ahead;
            ring[0] += ahead;
        }
        Some(tidy(ring))
    }
}

/// Cuts a line at a distance from its beginning; returns the rest.
fn split(line: &mut Vec<Vec2>, at_m: f64) -> Vec<Vec2> {
    let mut s = 0.0;
    for i in 1..line.len() {
        let piece = (line[i] - line[i - 1]).norm();
        if s + piece >= at_m {
            let p = line[i - 1] + (line[i] - line[i - 1]) * ((at_m - s) / piece.max(1e-9)).clamp(0.0, 1.0);
            let mut rest = vec![p];
            rest.extend(line.drain(i..));
            line.push(p);
            return tidy(rest);
        }
        s += piece;
    }
    Vec::new()
}
