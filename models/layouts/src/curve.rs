//! Lines: joins between two poses, arcs, parallels.

use scene::Vec2;
use scene::geometry::{cross, direction};
use scene::wrap_angle;
use std::f64::consts::FRAC_PI_2;

/// Change of direction between consecutive points of a curve, radians.
const STEP_RAD: f64 = 0.05;
/// Longest segment of a straight line, metres.
const PIECE_M: f64 = 10.0;
/// A bend begins more gently than an arc by this factor, and is tighter in its middle, because drivers steer
/// gradually.
const EASE: f64 = 1.12;
/// Directions nearer than this are the same, radians.
const STRAIGHT_RAD: f64 = 0.03;

/// A place with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub at: Vec2,
    pub heading_rad: f64,
}

impl Pose {
    pub fn way(self) -> Vec2 {
        direction(self.heading_rad)
    }
}

pub fn left_of(way: Vec2) -> Vec2 {
    Vec2::new(-way.y, way.x)
}

/// A line between two poses that keeps their directions. If two straight lines with a bend between them
/// suffice, the bend is as wide as there is room, but no wider than `radius_m`.
pub fn join(from: Pose, to: Pose, radius_m: f64) -> Vec<Vec2> {
    let gap = to.at - from.at;
    if gap.norm() < 1e-6 {
        return vec![from.at, to.at];
    }
    let turn = wrap_angle(to.heading_rad - from.heading_rad);
    let (d, e) = (from.way(), to.way());
    let det = cross(d, e);
    let aside = cross(d, gap).abs();
    if turn.abs() < STRAIGHT_RAD && aside < 1e-3 * gap.norm() && gap.dot(&d) > 0.0 {
        return straight(from.at, to.at);
    }
    if turn.abs() > STRAIGHT_RAD && turn.abs() < 2.9 {
        let (s, t) = (cross(gap, e) / det, cross(gap, d) / det);
        let room = s.min(-t);
        if room > 0.3 && s.max(-t) < 20.0 * room {
            let apex = from.at + d * s;
            let half = (turn.abs() / 2.0).tan();
            let reach = (radius_m * half).clamp(0.3, room);
            let (a, b) = (apex - d * reach, apex + e * reach);
            let handle = EASE * reach * (4.0 / 3.0) * (turn.abs() / 4.0).tan() / half;
            let handle = handle.min(reach);
            let mut line = straight(from.at, a);
            line.pop();
            line.extend(bezier([a, a + d * handle, b - e * handle, b], turn.abs()));
            line.pop();
            line.extend(straight(b, to.at));
            return tidy(line);
        }
    }
    // Otherwise: the gentlest of some cubics with different strengths.
    let mut best: Option<(f64, Vec<Vec2>)> = None;
    for strength in [0.34, 0.45, 0.6, 0.8, 1.1] {
        let handle = strength * gap.norm();
        let control = [from.at, from.at + d * handle, to.at - e * handle, to.at];
        let line = bezier(control, turn.abs().max(FRAC_PI_2));
        let bend = curvature(&line);
        if best.as_ref().is_none_or(|(least, _)| bend < *least) {
            best = Some((bend, line));
        }
    }
    tidy(best.map(|(_, line)| line).unwrap_or_default())
}

/// A straight line between two points in segments of limited length.
pub fn straight(a: Vec2, b: Vec2) -> Vec<Vec2> {
    let pieces = ((b - a).norm() / PIECE_M).ceil().clamp(1.0, 200.0) as usize;
    (0..=pieces).map(|i| a + (b - a) * (i as f64 / pieces as f64)).collect()
}

fn bezier(p: [Vec2; 4], turn_rad: f64) -> Vec<Vec2> {
    let count = (turn_rad / STEP_RAD).ceil().clamp(6.0, 80.0) as usize;
    let point = |i: usize| {
        let t = i as f64 / count as f64;
        let u = 1.0 - t;
        p[0] * (u * u * u) + p[1] * (3.0 * u * u * t) + p[2] * (3.0 * u * t * t) + p[3] * (t * t * t)
    };
    (0..=count).map(point).collect()
}

/// An arc about a centre, from one angle to another (greater: counter-clockwise).
pub fn arc(centre: Vec2, radius_m: f64, from_rad: f64, to_rad: f64) -> Vec<Vec2> {
    let count = ((to_rad - from_rad).abs() / STEP_RAD).ceil().clamp(2.0, 400.0) as usize;
    let point =
        |i: usize| centre + direction(from_rad + (to_rad - from_rad) * (i as f64 / count as f64)) * radius_m;
    (0..=count).map(point).collect()
}

/// The line without coinciding points.
pub fn tidy(mut line: Vec<Vec2>) -> Vec<Vec2> {
    let last = line.last().copied();
    line.dedup_by(|b, a| (*b - *a).norm() < 0.02);
    // The last point stays where it is.
    if let (Some(last), Some(end)) = (last, line.last_mut()) {
        *end = last;
    }
    line
}

/// Greatest curvature at the points of a line, 1/m; very short segments are left out.
pub fn curvature(line: &[Vec2]) -> f64 {
    let bend = |w: &[Vec2]| {
        let (a, b) = (w[1] - w[0], w[2] - w[1]);
        let turn = cross(a, b).atan2(a.dot(&b)).abs();
        let length = 0.5 * (a.norm() + b.norm());
        if length > 0.05 { turn / length } else { 0.0 }
    };
    line.windows(3).map(bend).fold(0.0, f64::max)
}

/// Change of direction over a whole line, radians.
pub fn turn(line: &[Vec2]) -> f64 {
    line.windows(3).map(|w| cross(w[1] - w[0], w[2] - w[1]).atan2((w[1] - w[0]).dot(&(w[2] - w[1])))).sum()
}

/// Parallel line at an offset to the left (negative: right), mitred.
pub fn parallel(line: &[Vec2], left_m: f64) -> Vec<Vec2> {
    let unit = |v: Vec2| v / v.norm().max(1e-9);
    let last = line.len().saturating_sub(1);
    (0..line.len())
        .map(|i| {
            let before = unit(line[i.max(1).min(last)] - line[i.max(1).min(last) - usize::from(last > 0)]);
            let after = unit(line[(i + 1).min(last)] - line[i.min(last.saturating_sub(1))]);
            let way = unit(before + after);
            let stretch = 1.0 / way.dot(&after).max(0.5);
            line[i] + left_of(way) * (left_m * stretch)
        })
        .collect()
}

/// Length of a line, metres.
pub fn length(line: &[Vec2]) -> f64 {
    line.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(x: f64, y: f64, degrees: f64) -> Pose {
        Pose { at: Vec2::new(x, y), heading_rad: degrees.to_radians() }
    }

    #[test]
    fn a_turn_is_as_wide_as_asked() {
        let line = join(pose(-20.0, 0.0, 0.0), pose(0.0, 20.0, 90.0), 10.0);
        assert_eq!((line[0], line[line.len() - 1]), (Vec2::new(-20.0, 0.0), Vec2::new(0.0, 20.0)));
        let radius = 1.0 / curvature(&line);
        assert!((7.5..=10.5).contains(&radius), "{radius}");
        assert!((turn(&line) - FRAC_PI_2).abs() < 0.05);
    }

    #[test]
    fn poses_in_a_line_are_joined_straight_and_others_smoothly() {
        let line = join(pose(0.0, 0.0, 0.0), pose(25.0, 0.0, 0.0), 10.0);
        assert!(line.iter().all(|p| p.y.abs() < 1e-9));
        let aside = join(pose(0.0, 0.0, 0.0), pose(25.0, 3.0, 0.0), 10.0);
        assert!(aside.windows(2).all(|w| w[1].x > w[0].x && w[1].y >= w[0].y - 1e-9));
        let back = join(pose(0.0, 0.0, 0.0), pose(0.0, 8.0, 180.0), 10.0);
        assert!(curvature(&back).is_finite() && back.len() > 5);
    }

    #[test]
    fn a_parallel_keeps_its_distance() {
        let ring = arc(Vec2::zeros(), 10.0, 0.0, 3.0);
        assert!(parallel(&ring, 2.0).iter().all(|p| (p.norm() - 8.0).abs() < 0.02));
        assert!((length(&ring) - 30.0).abs() < 0.05);
        assert!(parallel(&[Vec2::zeros()], 1.0).len() == 1);
    }
}
