//! Lanelets: their use, and the middle line between their two sides.

use crate::polyline::{arc_lengths, length, point_at};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::LaneType;

/// Distance between points of a middle line, metres.
const SPACING_M: f64 = 1.0;
/// Most pieces of a centre line.
const MAX_PIECES: f64 = 4_000.0;

/// Use of a lanelet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LaneletKind {
    Lane(LaneType),
    Crosswalk,
}

/// Points a metre apart halfway between two sides that run the same way, and the mean width.
pub(crate) fn middle(left: &[Vec2], right: &[Vec2]) -> (Vec<Vec2>, f64) {
    let lengths = [arc_lengths(left), arc_lengths(right)];
    let totals = [length(left), length(right)];
    let pieces = (totals[0].max(totals[1]) / SPACING_M).ceil().clamp(1.0, MAX_PIECES) as usize;
    let mut sides = Vec::with_capacity(pieces + 1);
    let points = (0..=pieces).map(|i| {
        let share = i as f64 / pieces as f64;
        let (l, r) =
            (point_at(left, &lengths[0], totals[0] * share), point_at(right, &lengths[1], totals[1] * share));
        sides.push(l - r);
        ((l + r) / 2.0).map(|v| (v * 1e4).round() / 1e4)
    });
    let points: Vec<Vec2> = points.collect();
    // Measured across the lane: opposite points of a lane that widens or bends may be offset along it.
    let across = |(i, side): (usize, &Vec2)| {
        let way = points[(i + 1).min(pieces)] - points[i.saturating_sub(1)];
        cross(way, *side).abs() / way.norm().max(1e-9)
    };
    let width_m = sides.iter().enumerate().map(across).sum::<f64>() / sides.len() as f64;
    (points, width_m)
}

/// The middle points of two sides with as many points, and the mean width across the segments.
pub(crate) fn halfway(left: &[Vec2], right: &[Vec2]) -> (Vec<Vec2>, f64) {
    let points: Vec<Vec2> = left.iter().zip(right).map(|(l, r)| (l + r) / 2.0).collect();
    let (mut area, mut total) = (0.0, 0.0);
    for (i, ends) in points.windows(2).enumerate() {
        let way = ends[1] - ends[0];
        let across = |k: usize| cross(way, left[k] - right[k]).abs();
        area += (across(i) + across(i + 1)) / 2.0;
        total += way.norm();
    }
    (points, area / f64::max(total, 1e-9))
}

/// Both sides with as many points, right then left: the points of both, at the same shares of their lengths.
pub(crate) fn matched(left: &[Vec2], right: &[Vec2]) -> (Vec<Vec2>, Vec<Vec2>) {
    let lengths = [arc_lengths(left), arc_lengths(right)];
    let totals = [length(left), length(right)];
    let mut shares: Vec<f64> = lengths
        .iter()
        .zip(totals)
        .flat_map(|(all, total)| all.iter().map(move |s| s / total.max(1e-9)))
        .collect();
    shares.sort_by(f64::total_cmp);
    shares.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let side = |k: usize, line: &[Vec2]| {
        shares.iter().map(|share| point_at(line, &lengths[k], totals[k] * share)).collect()
    };
    (side(1, right), side(0, left))
}
