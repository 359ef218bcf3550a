//! Polylines: arc length, resampling, parts, parallel lines.

use scene::Vec2;
use scene::geometry::cross;

/// Arc length at each point, starting with zero.
pub fn arc_lengths(points: &[Vec2]) -> Vec<f64> {
    let mut total = 0.0;
    let mut lengths = Vec::with_capacity(points.len());
    for (i, p) in points.iter().enumerate() {
        if i > 0 {
            total += (p - points[i - 1]).norm();
        }
        lengths.push(total);
    }
    lengths
}

/// Length of the whole line.
pub fn length(points: &[Vec2]) -> f64 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

/// Area within a ring, square metres.
pub fn ring_area_m2(ring: &[Vec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| cross(*a, *b)).sum::<f64>().abs() / 2.0
}

/// Point at arc length `s`, which is clamped to the line. The origin for an empty line.
pub fn point_at(points: &[Vec2], lengths: &[f64], s: f64) -> Vec2 {
    let Some(&last) = points.last() else { return Vec2::zeros() };
    let i = lengths.partition_point(|&l| l <= s);
    if i == 0 {
        return points[0];
    }
    if i >= points.len() {
        return last;
    }
    let span = lengths[i] - lengths[i - 1];
    let share = if span > 1e-9 { (s - lengths[i - 1]) / span } else { 0.0 };
    points[i - 1] + (points[i] - points[i - 1]) * share
}

/// Equally spaced points, about `step` apart, both ends kept.
pub fn resample(points: &[Vec2], step: f64) -> Vec<Vec2> {
    let lengths = arc_lengths(points);
    let total = lengths.last().copied().unwrap_or(0.0);
    if total < 1e-6 {
        return points.to_vec();
    }
    let n = (total / step).round().max(1.0) as usize;
    (0..=n).map(|i| point_at(points, &lengths, total * i as f64 / n as f64)).collect()
}

/// The part between two arc lengths, both clamped to the line.
pub fn part(points: &[Vec2], from: f64, to: f64) -> Vec<Vec2> {
    let lengths = arc_lengths(points);
    let to = to.min(lengths.last().copied().unwrap_or(0.0));
    let inner =
        points.iter().zip(&lengths).filter(|(_, l)| **l > from + 0.3 && **l < to - 0.3).map(|(p, _)| *p);
    std::iter::once(point_at(points, &lengths, from))
        .chain(inner)
        .chain(std::iter::once(point_at(points, &lengths, to)))
        .collect()
}

/// Unit tangent at each point, by central differences.
pub fn tangents(points: &[Vec2]) -> Vec<Vec2> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let d = points[(i + 1).min(n - 1)] - points[i.saturating_sub(1)];
            d / d.norm().max(1e-9)
        })
        .collect()
}

/// Parallel line `distance` to the right (negative: to the left), mitred at corners.
pub fn offset_right(points: &[Vec2], distance: f64) -> Vec<Vec2> {
    let n = points.len();
    let segment = |i: usize| {
        let d = points[i + 1] - points[i];
        d / d.norm().max(1e-9)
    };
    (0..n)
        .map(|i| {
            if n < 2 {
                return points[i];
            }
            let before = segment(i.clamp(1, n - 1) - 1);
            let after = segment(i.min(n - 2));
            let sum = before + after;
            let tangent = if sum.norm() > 1e-6 { sum / sum.norm() } else { after };
            // A mitre keeps the distance to both neighbours; bounded at sharp corners.
            let stretch = 1.0 / tangent.dot(&after).max(0.6);
            points[i] + Vec2::new(tangent.y, -tangent.x) * (distance * stretch)
        })
        .collect()
}

/// Intersection of the line at `p` along `d` with the line at `q` along `e`: distances along both; `None` if
/// they are nearly parallel.
pub fn meeting(p: Vec2, d: Vec2, q: Vec2, e: Vec2) -> Option<(f64, f64)> {
    let det = cross(d, e);
    (det.abs() > 0.05).then(|| (cross(q - p, e) / det, cross(q - p, d) / det))
}

/// Smallest distance from `p` to the line.
pub fn distance_to(points: &[Vec2], p: Vec2) -> f64 {
    points.windows(2).map(|w| (foot(w, p) - p).norm()).fold(f64::INFINITY, f64::min)
}

/// Point of the line that is nearest to `p`; `p` itself for a line without pieces.
pub fn nearest(points: &[Vec2], p: Vec2) -> Vec2 {
    let feet = points.windows(2).map(|w| foot(w, p));
    feet.min_by(|a, b| (a - p).norm().total_cmp(&(b - p).norm())).unwrap_or(p)
}

fn foot(ends: &[Vec2], p: Vec2) -> Vec2 {
    let d = ends[1] - ends[0];
    let share = ((p - ends[0]).dot(&d) / d.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    ends[0] + d * share
}

/// True when `p` lies inside the ring.
pub fn contains(ring: &[Vec2], p: Vec2) -> bool {
    let mut inside = false;
    let mut previous = ring.len().wrapping_sub(1);
    for (i, a) in ring.iter().enumerate() {
        let b = ring[previous];
        if (a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x {
            inside = !inside;
        }
        previous = i;
    }
    inside
}

/// Most points that [`simplify`] drops in a row, so that time does not grow with their square.
const LONGEST_RUN: usize = 256;

/// Drops points that lie within `tolerance` of the line without them, keeping gaps under `longest`.
pub fn simplify(points: &[Vec2], tolerance: f64, longest: f64) -> Vec<Vec2> {
    let mut kept: Vec<Vec2> = Vec::new();
    let mut anchor = 0;
    for (i, p) in points.iter().enumerate() {
        if i == 0 {
            kept.push(*p);
            continue;
        }
        let chord = [points[anchor], *p];
        let straight = || points[anchor + 1..i].iter().all(|q| distance_to(&chord, *q) <= tolerance);
        let short = (p - points[anchor]).norm() <= longest && i - anchor <= LONGEST_RUN;
        if !(short && straight()) && i - 1 > anchor {
            anchor = i - 1;
            kept.push(points[anchor]);
        }
    }
    if points.len() > 1 {
        kept.push(points[points.len() - 1]);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent() -> Vec<Vec2> {
        vec![Vec2::new(0.0, 0.0), Vec2::new(10.0, 0.0), Vec2::new(10.0, 10.0)]
    }

    #[test]
    fn resample_keeps_ends_and_spacing() {
        let line = resample(&bent(), 1.0);
        assert_eq!(line.len(), 21);
        assert_eq!(line[20], Vec2::new(10.0, 10.0));
        assert!(line.windows(2).all(|w| ((w[1] - w[0]).norm() - 1.0).abs() < 1e-9));
    }

    #[test]
    fn offset_keeps_its_distance() {
        let right = offset_right(&bent(), 2.0);
        assert!((right[0] - Vec2::new(0.0, -2.0)).norm() < 1e-9);
        assert!((right[1] - Vec2::new(12.0, -2.0)).norm() < 1e-9);
        assert!((right[2] - Vec2::new(12.0, 10.0)).norm() < 1e-9);
    }

    #[test]
    fn part_and_simplify() {
        let middle = part(&bent(), 5.0, 15.0);
        assert_eq!(middle, vec![Vec2::new(5.0, 0.0), Vec2::new(10.0, 0.0), Vec2::new(10.0, 5.0)]);
        assert_eq!(simplify(&resample(&bent(), 0.5), 0.01, 100.0), bent());
        assert!(contains(&bent(), Vec2::new(9.0, 2.0)) && !contains(&bent(), Vec2::new(1.0, 5.0)));
    }
}
