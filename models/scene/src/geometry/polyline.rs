//! Polylines by arc length: sampling, projection, slices, curvature.

use super::{Vec2, cross, direction, wrap_angle};
use std::sync::OnceLock;

/// Points closer than this to the one before are the same point, metres.
const SAME_POINT_M: f64 = 0.01;

/// Number of points probed before the search for the foot of a point.
const PROBES: usize = 12;

/// Tolerance for rounding when pieces are skipped, metres.
const SLACK_M: f64 = 1e-6;

/// Greatest turn between the middle of an end piece and its inner vertex on a smooth line, radians.
const MAX_SMOOTH_TURN_RAD: f64 = 0.15;

/// A position and a heading, scene frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Position, metres.
    pub position: Vec2,
    /// Counter-clockwise from +x.
    pub heading_rad: f64,
}

impl Pose {
    /// Pose at `position` that looks along `heading_rad`.
    pub fn new(position: Vec2, heading_rad: f64) -> Self {
        Self { position, heading_rad }
    }

    /// Pose from the three numbers.
    pub fn xyh(x_m: f64, y_m: f64, heading_rad: f64) -> Self {
        Self::new(Vec2::new(x_m, y_m), heading_rad)
    }

    /// Unit vector along the heading.
    pub fn direction(&self) -> Vec2 {
        direction(self.heading_rad)
    }
}

/// Foot of a point on a [`Polyline`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Foot {
    /// Arc length of the foot, metres.
    pub s_m: f64,
    /// Signed offset, positive to the left of the line, metres. Before the start and beyond the end it
    /// is measured from the straight continuation, so it may be smaller than the distance.
    pub lateral_m: f64,
    /// Distance to the foot, metres.
    pub distance_m: f64,
    /// Heading of the line at the foot, radians.
    pub heading_rad: f64,
}

/// A line of points with its cumulative arc length and a heading that is continuous along it.
///
/// Repeated points are dropped, so every piece has a length; a line of one point has length zero and
/// heading zero. Never empty: no points at all become the origin.
#[derive(Clone, Debug)]
pub struct Polyline {
    points: Vec<Vec2>,
    /// Arc length of each point, metres.
    arc: Vec<f64>,
    /// See [`Polyline::headings_rad`]; computed on first use, because most lines are intermediate results.
    headings: OnceLock<Vec<f64>>,
}

/// Compares the points, from which everything else follows.
impl PartialEq for Polyline {
    fn eq(&self, other: &Self) -> bool {
        self.points == other.points
    }
}

impl Default for Polyline {
    fn default() -> Self {
        Self::new([])
    }
}

impl Polyline {
    /// Line through `points`. Points that are not finite or repeat the one before are dropped; the last
    /// point is kept exactly.
    pub fn new(points: impl IntoIterator<Item = Vec2>) -> Self {
        let mut kept: Vec<Vec2> = Vec::new();
        for p in points.into_iter().filter(|p| p.x.is_finite() && p.y.is_finite()) {
            match kept.last() {
                Some(last) if (p - last).norm_squared() < SAME_POINT_M * SAME_POINT_M => {
                    // Keeping the newer of two close points keeps the end exact.
                    if let (2.., Some(last)) = (kept.len(), kept.last_mut()) {
                        *last = p;
                    }
                }
                _ => kept.push(p),
            }
        }
        if kept.is_empty() {
            kept.push(Vec2::zeros());
        }
        Self::from_distinct(kept)
    }

    fn from_distinct(points: Vec<Vec2>) -> Self {
        let mut arc = Vec::with_capacity(points.len());
        let mut s = 0.0;
        arc.push(s);
        for pair in points.windows(2) {
            s += (pair[1] - pair[0]).norm();
            arc.push(s);
        }
        Self { points, arc, headings: OnceLock::new() }
    }

    fn work_out_headings(&self) -> Vec<f64> {
        let mut headings = Vec::with_capacity(self.points.len());
        let (mut last_length, mut last_heading) = (0.0, 0.0);
        for (i, pair) in self.points.windows(2).enumerate() {
            let step = pair[1] - pair[0];
            let length = step.norm();
            let mut heading = step.y.atan2(step.x);
            if i == 0 {
                headings.push(heading);
            } else {
                heading = last_heading + wrap_angle(heading - last_heading);
                // Tangent of the circle through three points.
                let weight = last_length / (last_length + length);
                headings.push(last_heading + weight * (heading - last_heading));
            }
            (last_length, last_heading) = (length, heading);
        }
        headings.push(last_heading);
        self.turn_ends(&mut headings);
        headings
    }

    /// Continues the bend of smooth, evenly spaced lines to their ends. There the first and last pieces are
    /// off by half the turn of one piece.
    fn turn_ends(&self, headings: &mut [f64]) {
        let n = headings.len();
        if n < 4 {
            return;
        }
        let even = |s: &[f64]| s[1] - s[0] < 1.5 * (s[2] - s[1]) && s[2] - s[1] < 3.0;
        let start = headings[0] - headings[1];
        if even(&self.arc[..3]) && start.abs() < MAX_SMOOTH_TURN_RAD {
            headings[0] += start;
        }
        let end = headings[n - 1] - headings[n - 2];
        let back = [0.0, self.arc[n - 1] - self.arc[n - 2], self.arc[n - 1] - self.arc[n - 3]];
        if even(&back) && end.abs() < MAX_SMOOTH_TURN_RAD {
            headings[n - 1] += end;
        }
    }

    /// The points.
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Arc length of each point, ascending from zero, metres.
    pub fn arc_m(&self) -> &[f64] {
        &self.arc
    }

    /// Heading at each point, unwrapped (neighbours differ by less than pi), radians.
    pub fn headings_rad(&self) -> &[f64] {
        self.headings.get_or_init(|| self.work_out_headings())
    }

    /// Whole length, metres.
    pub fn length_m(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// First point.
    pub fn first(&self) -> Pose {
        self.sample(0.0)
    }

    /// Last point.
    pub fn last(&self) -> Pose {
        self.sample(self.length_m())
    }

    /// Index of the piece that holds arc length `s`, and the share of it before `s` (0 to 1).
    fn locate(&self, s: f64) -> (usize, f64) {
        if self.points.len() < 2 || s.is_nan() {
            return (0, 0.0);
        }
        // Most lines are evenly spaced, so the piece is at the share of the length or next to it.
        let pieces = self.points.len() - 1;
        let guess = (s / self.length_m() * pieces as f64) as usize;
        let holds = |i: usize| i + 1 < pieces && self.arc[i] <= s && s < self.arc[i + 1];
        let near = [guess, guess + 1, guess.saturating_sub(1)].into_iter().find(|i| holds(*i));
        let i = near.unwrap_or_else(|| self.arc.partition_point(|a| *a <= s).clamp(1, pieces) - 1);
        (i, ((s - self.arc[i]) / (self.arc[i + 1] - self.arc[i])).clamp(0.0, 1.0))
    }

    /// Pose at arc length `s_m`, held at the ends.
    pub fn sample(&self, s_m: f64) -> Pose {
        let place = self.locate(s_m);
        Pose::new(self.position_in(place), wrap_angle(self.heading_in(place)))
    }

    /// Position at arc length `s_m`, held at the ends; [`Polyline::sample`] without the heading.
    pub fn position_at(&self, s_m: f64) -> Vec2 {
        self.position_in(self.locate(s_m))
    }

    fn position_in(&self, (i, t): (usize, f64)) -> Vec2 {
        let j = (i + 1).min(self.points.len() - 1);
        // Vertices are met to the last bit.
        if t >= 1.0 { self.points[j] } else { self.points[i] + t * (self.points[j] - self.points[i]) }
    }

    fn heading_in(&self, (i, t): (usize, f64)) -> f64 {
        let headings = self.headings_rad();
        let j = (i + 1).min(headings.len() - 1);
        headings[i] + t * (headings[j] - headings[i])
    }

    /// Pose at arc length `s_m`; before the start and beyond the end the line continues straight.
    pub fn extrapolate(&self, s_m: f64) -> Pose {
        let pose = self.sample(s_m);
        let beyond = s_m - s_m.clamp(0.0, self.length_m());
        Pose::new(pose.position + beyond * pose.direction(), pose.heading_rad)
    }

    /// Unwrapped heading at arc length `s_m`, held at the ends, radians.
    pub fn heading_at(&self, s_m: f64) -> f64 {
        self.heading_in(self.locate(s_m))
    }

    /// Curvature at arc length `s_m` as the change of heading over `window_m` around it, 1/m, positive
    /// to the left. Near the ends the window is cut.
    pub fn curvature_at(&self, s_m: f64, window_m: f64) -> f64 {
        let from = (s_m - 0.5 * window_m).max(0.0);
        let to = (s_m + 0.5 * window_m).min(self.length_m());
        if to - from < 1e-6 { 0.0 } else { (self.heading_at(to) - self.heading_at(from)) / (to - from) }
    }

    /// Curvature at every point, see [`Polyline::curvature_at`].
    pub fn curvatures(&self, window_m: f64) -> Vec<f64> {
        self.arc.iter().map(|s| self.curvature_at(*s, window_m)).collect()
    }

    /// Greatest absolute curvature at the points from `from_m` to `to_m`.
    pub fn max_curvature(&self, from_m: f64, to_m: f64, window_m: f64) -> f64 {
        let inside = self.arc.iter().filter(|s| (from_m..=to_m).contains(*s));
        inside.map(|s| self.curvature_at(*s, window_m).abs()).fold(0.0, f64::max)
    }

    /// Foot of `point` on the whole line.
    pub fn project(&self, point: Vec2) -> Foot {
        self.project_between(point, 0.0, f64::INFINITY)
    }

    /// Foot of `point` on the part from `from_m` to `to_m`; for lines that come near themselves again.
    pub fn project_between(&self, point: Vec2, from_m: f64, to_m: f64) -> Foot {
        let from = self.arc.partition_point(|s| *s < from_m);
        // A few probed points bound the distance of the foot.
        let stride = (self.points.len() / PROBES).max(1);
        let probed = self.arc.iter().zip(&self.points).skip(from).step_by(stride);
        let probed = probed.take_while(|(s, _)| **s <= to_m).map(|(_, p)| (p - point).norm_squared());
        let most_m = if stride > 1 { probed.fold(f64::INFINITY, f64::min).sqrt() } else { f64::INFINITY };
        match self.nearest(point, from_m, to_m, most_m) {
            Some((piece, s_m)) => self.foot_at(piece, s_m.clamp(from_m, to_m.max(from_m)), point),
            None => self.foot_at(self.locate(from_m).0, from_m.clamp(0.0, self.length_m()), point),
        }
    }

    /// Foot of `point` on the whole line; `None` if it is farther than `within_m`. Fast for lines that are
    /// far from most query points, because it reads few of their pieces.
    pub fn project_within(&self, point: Vec2, within_m: f64) -> Option<Foot> {
        let (piece, s_m) = self.nearest(point, 0.0, f64::INFINITY, within_m)?;
        Some(self.foot_at(piece, s_m, point)).filter(|foot| foot.distance_m <= within_m)
    }

    /// Piece and arc length of the foot of `point` on the part from `from_m` to `to_m`; the first one wins
    /// ties. A foot farther than `within_m` may be missed.
    fn nearest(&self, point: Vec2, from_m: f64, to_m: f64, within_m: f64) -> Option<(usize, f64)> {
        let (mut best, mut best_d2, mut bound_m) = (None, f64::INFINITY, within_m + SLACK_M);
        let mut i = self.arc.iter().skip(1).take_while(|s| **s < from_m).count();
        while i + 1 < self.points.len() && self.arc[i] <= to_m {
            let (t, d2) = foot_on_piece(self.points[i], self.points[i + 1], point);
            if d2 < best_d2 {
                (best, best_d2) = (Some((i, self.arc[i] + t * (self.arc[i + 1] - self.arc[i]))), d2);
                bound_m = bound_m.min(d2.sqrt() + SLACK_M);
            }
            i += 1;
            // No point within that distance along the line is nearer, so the search skips pieces that cannot
            // contain the foot.
            let away2 = (self.points[i] - point).norm_squared();
            if away2 > bound_m * bound_m {
                let clear_m = self.arc[i] + away2.sqrt() - bound_m;
                while i + 1 < self.points.len() && self.arc[i + 1] < clear_m {
                    i += 1;
                }
            }
        }
        best
    }

    /// Foot of `point` on piece `piece` at arc length `s_m`.
    pub(crate) fn foot_at(&self, piece: usize, s_m: f64, point: Vec2) -> Foot {
        let Pose { position: foot, heading_rad } = self.sample(s_m);
        let away = point - foot;
        let distance_m = away.norm();
        let along = match (self.points.get(piece), self.points.get(piece + 1)) {
            (Some(a), Some(b)) => (b - a).normalize(),
            _ => direction(heading_rad),
        };
        let side = cross(along, away);
        let inside = s_m > 0.0 && s_m < self.length_m();
        let lateral_m = if inside { distance_m.copysign(side) } else { side };
        Foot { s_m, lateral_m, distance_m, heading_rad }
    }

    /// Foot of `point` on piece `piece`: arc length and squared distance.
    pub(crate) fn foot_on(&self, piece: usize, point: Vec2) -> (f64, f64) {
        let (Some(a), Some(b)) = (self.points.get(piece), self.points.get(piece + 1)) else {
            return (0.0, f64::INFINITY);
        };
        let (t, d2) = foot_on_piece(*a, *b, point);
        (self.arc[piece] + t * (self.arc[piece + 1] - self.arc[piece]), d2)
    }

    /// The part from `from_m` to `to_m` (held at the ends), with exact end points.
    pub fn slice(&self, from_m: f64, to_m: f64) -> Self {
        let (from, to) = (from_m.clamp(0.0, self.length_m()), to_m.clamp(0.0, self.length_m()));
        let inner = self.arc.iter().zip(&self.points).filter(|(s, _)| **s > from && **s < to);
        let inner = inner.map(|(_, p)| *p);
        let ends = (self.position_at(from), self.position_at(to.max(from)));
        Self::new([ends.0].into_iter().chain(inner).chain([ends.1]))
    }

    /// Points at equal distances of at most `step_m`; both ends stay exact.
    pub fn resample(&self, step_m: f64) -> Self {
        let length = self.length_m();
        if length < SAME_POINT_M {
            return self.clone();
        }
        let pieces = (length / step_m.max(SAME_POINT_M) - 1e-9).ceil().clamp(1.0, 1e6) as usize;
        Self::new((0..=pieces).map(|i| self.position_at(length * (i as f64 / pieces as f64))))
    }

    /// Moving average over a window of `2 half_m` around each point. The window narrows towards the ends, so
    /// that they do not move. Rounds off the kinks between lanes; meant for evenly spaced lines.
    pub fn smoothed(&self, half_m: f64) -> Self {
        let n = self.points.len();
        let spacing = self.length_m() / n.saturating_sub(1).max(1) as f64;
        let half = if spacing > 0.0 { (half_m / spacing).round() as usize } else { 0 };
        if half == 0 || n < 3 {
            return self.clone();
        }
        let mean = |i: usize| {
            let h = half.min(i).min(n - 1 - i);
            self.points[i - h..=i + h].iter().sum::<Vec2>() / (2 * h + 1) as f64
        };
        Self::new((0..n).map(mean))
    }

    /// The line in the other direction.
    pub fn reversed(&self) -> Self {
        Self::new(self.points.iter().rev().copied())
    }
}

/// Foot of `point` on the piece from `a` to `b`: share of the piece (0 to 1) and squared distance.
fn foot_on_piece(a: Vec2, b: Vec2, point: Vec2) -> (f64, f64) {
    let piece = b - a;
    let t = ((point - a).dot(&piece) / piece.norm_squared().max(1e-12)).clamp(0.0, 1.0);
    (t, (point - a - t * piece).norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn v(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    fn circle(radius: f64) -> Polyline {
        Polyline::new((0..=60).map(|i| radius * direction(0.05 * f64::from(i))))
    }

    #[test]
    fn samples_and_projects() {
        let line = Polyline::new([v(0.0, 0.0), v(10.0, 0.0), v(10.0, 0.0), v(10.0, 10.0)]);
        assert_eq!(line.points().len(), 3);
        assert_eq!(line.length_m(), 20.0);
        assert_eq!(line.position_at(15.0), v(10.0, 5.0));
        assert_eq!(line.position_at(99.0), v(10.0, 10.0));
        assert!((line.extrapolate(23.0).position - v(10.0, 13.0)).norm() < 1e-9);
        let foot = line.project(v(4.0, -2.0));
        assert_eq!((foot.s_m, foot.lateral_m, foot.distance_m), (4.0, -2.0, 2.0));
        assert_eq!(line.project(v(8.0, 6.0)).lateral_m, 2.0);
        let beyond = line.project(v(9.0, 14.0));
        assert!((beyond.lateral_m - 1.0).abs() < 1e-9 && beyond.distance_m > 4.0 && beyond.s_m == 20.0);
        assert_eq!(line.project_between(v(4.0, -2.0), 10.0, 20.0).s_m, 10.0);
    }

    #[test]
    fn circles_have_their_curvature_and_tangents() {
        let line = circle(20.0);
        for s in [0.5, 10.0, 30.0, line.length_m() - 0.5] {
            assert!((line.curvature_at(s, 3.0) - 0.05).abs() < 1e-3);
        }
        assert!((line.first().heading_rad - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
        assert!((line.max_curvature(0.0, 1e3, 2.0) - 0.05).abs() < 1e-3);
        assert!((line.reversed().curvature_at(10.0, 3.0) + 0.05).abs() < 1e-3);
    }

    #[test]
    fn cuts_and_resamples_exactly() {
        let line = circle(20.0);
        let part = line.slice(3.3, 17.7);
        assert!((part.length_m() - 14.4).abs() < 1e-6);
        assert_eq!(part.first().position, line.position_at(3.3));
        let even = line.resample(1.0);
        assert_eq!(even.last().position, line.last().position);
        let steps = even.points().windows(2).map(|p| (p[1] - p[0]).norm());
        assert!(steps.into_iter().all(|d| d <= 1.0 && d > 0.9));
        assert_eq!(even.smoothed(2.0).first().position, line.first().position);
    }

    #[test]
    fn nothing_and_one_point_are_lines_too() {
        for line in [Polyline::default(), Polyline::new([v(3.0, 4.0); 5]), Polyline::new([v(f64::NAN, 0.0)])]
        {
            assert_eq!((line.points().len(), line.length_m()), (1, 0.0));
            assert_eq!(line.position_at(5.0), line.points()[0]);
            assert!(line.project(v(1.0, 1.0)).distance_m.is_finite());
            assert_eq!(line.curvatures(2.0), [0.0]);
            assert_eq!(line.resample(1.0), line);
            assert_eq!(line.slice(-1.0, 3.0).length_m(), 0.0);
            assert_eq!(line.smoothed(2.0), line.reversed());
        }
    }

    proptest! {
        #[test]
        fn the_foot_is_the_nearest_point(
            corners in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 1..12),
            x in -60.0..60.0_f64, y in -60.0..60.0_f64, share in 0.0..1.0_f64,
        ) {
            let line = Polyline::new(corners.into_iter().map(|(x, y)| v(x, y)));
            let foot = line.project(v(x, y));
            prop_assert!((line.position_at(foot.s_m) - v(x, y)).norm() - foot.distance_m < 1e-6);
            let other = line.position_at(share * line.length_m());
            prop_assert!((other - v(x, y)).norm() >= foot.distance_m - 1e-6);
            prop_assert!(foot.lateral_m.abs() <= foot.distance_m + 1e-9);
        }

        /// Skipping pieces finds the same foot as testing all of them, bit for bit.
        #[test]
        fn no_foot_is_passed_over(
            corners in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 2..12),
            step in 0.3..5.0_f64, x in -60.0..60.0_f64, y in -60.0..60.0_f64,
            shares in (0.0..1.0_f64, 0.0..1.0_f64), within_m in 0.0..40.0_f64,
        ) {
            let point = v(x, y);
            let line = Polyline::new(corners.into_iter().map(|(x, y)| v(x, y))).resample(step);
            let of_all = |from_m: f64, to_m: f64| {
                let part = |i: &usize| line.arc[i + 1] >= from_m && line.arc[*i] <= to_m;
                let feet = (0..line.points.len() - 1).filter(part).map(|i| (i, line.foot_on(i, point)));
                let (piece, (s_m, _)) = feet.reduce(|a, b| if b.1.1 < a.1.1 { b } else { a }).unwrap();
                line.foot_at(piece, s_m.clamp(from_m, to_m), point)
            };
            let whole = of_all(0.0, f64::INFINITY);
            prop_assert_eq!(line.project(point), whole);
            let piece = line.arc.partition_point(|s| *s <= whole.s_m).clamp(1, line.points.len() - 1) - 1;
            prop_assert_eq!(line.locate(whole.s_m).0, piece);
            let (from_m, to_m) = (shares.0 * line.length_m(), shares.1 * line.length_m());
            if from_m <= to_m {
                prop_assert_eq!(line.project_between(point, from_m, to_m), of_all(from_m, to_m));
            }
            let within = (whole.distance_m <= within_m).then_some(whole);
            prop_assert_eq!(line.project_within(point, within_m), within);
        }

        #[test]
        fn samples_lie_on_the_line_in_order(
            corners in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 2..12),
            step in 0.3..5.0_f64,
        ) {
            let line = Polyline::new(corners.into_iter().map(|(x, y)| v(x, y)));
            let even = line.resample(step);
            prop_assert_eq!(even.last().position, line.last().position);
            prop_assert!(even.length_m() <= line.length_m() + 1e-6);
            for pair in even.points().windows(2) {
                // Samples that meet at the tip of a spike count as one.
                prop_assert!((pair[1] - pair[0]).norm() <= step + SAME_POINT_M);
            }
            prop_assert!(line.arc_m().windows(2).all(|s| s[1] > s[0]));
            prop_assert!(line.headings_rad().windows(2).all(|h| (h[1] - h[0]).abs() < 2.0 * std::f64::consts::PI));
        }
    }
}
