//! Centre lines of lanes: sequences of paths with three pieces, each an arc or straight.

use scene::Vec2;
use scene::geometry::direction;
use serde::Deserialize;

/// Spacing of points along a line, metres.
const SPACING_M: f64 = 1.0;
/// Greatest length of a piece, metres, and most points of a line.
const LONGEST_M: f64 = 2_000.0;
const MAX_POINTS: usize = 20_000;

/// A path of three pieces.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct ArcPath {
    /// x, y and heading.
    start_pose: [f64; 3],
    /// Pieces: `L` to the left, `R` to the right, `S` straight.
    shape: String,
    /// Radius of all arcs, metres.
    radius: f64,
    segment_length: [f64; 3],
}

/// Points of a sequence of paths, about 1 m apart; `None` if a number is not finite, a piece is too long, or
/// there are too many points.
pub(super) fn points(paths: &[ArcPath]) -> Option<Vec<Vec2>> {
    let mut line: Vec<Vec2> = Vec::new();
    for path in paths {
        let [x, y, mut heading] = path.start_pose;
        let mut at = Vec2::new(x, y);
        push(&mut line, at);
        for (piece, length_m) in path.shape.chars().zip(path.segment_length) {
            let curvature = match piece {
                'L' => 1.0 / path.radius,
                'R' => -1.0 / path.radius,
                'S' => 0.0,
                _ => return None,
            };
            let can_be = [at.x, at.y, heading, curvature].iter().all(|v| v.is_finite());
            if !can_be || !(0.0..=LONGEST_M).contains(&length_m) {
                return None;
            }
            let steps = (length_m / SPACING_M).ceil().max(1.0);
            let (from, begins) = (at, heading);
            for i in 1..=steps as usize {
                let along_m = length_m * i as f64 / steps;
                // The direction of an arc's chord is the mean of the headings at its ends.
                let half = curvature * along_m / 2.0;
                let chord_m = if half.abs() < 1e-9 { along_m } else { along_m * half.sin() / half };
                at = from + direction(begins + half) * chord_m;
                push(&mut line, at);
            }
            heading = begins + curvature * length_m;
        }
        if line.len() > MAX_POINTS {
            return None;
        }
    }
    (line.len() > 1).then_some(line)
}

fn push(line: &mut Vec<Vec2>, p: Vec2) {
    if line.last().is_none_or(|last| (last - p).norm() > 0.05) {
        line.push(p);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_end_where_their_turn_does() {
        let quarter = std::f64::consts::FRAC_PI_2 * 20.0;
        let path = ArcPath {
            start_pose: [5.0, 1.0, 0.0],
            shape: "SLS".into(),
            radius: 20.0,
            segment_length: [10.0, quarter, 4.0],
        };
        let line = points(std::slice::from_ref(&path)).unwrap();
        let end = line.last().unwrap();
        assert!((end - Vec2::new(35.0, 25.0)).norm() < 1e-9, "{end}");
        assert!(line.windows(2).all(|w| (w[1] - w[0]).norm() < 1.01));
        let broken = |change: fn(&mut ArcPath)| {
            let mut path = path.clone();
            change(&mut path);
            points(&[path]).is_none()
        };
        assert!(broken(|path| path.radius = 0.0) && broken(|path| path.segment_length[1] = 1e9));
        assert!(broken(|path| path.shape = "LXL".into()) && points(&[]).is_none());
    }
}
