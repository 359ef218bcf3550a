//! Keeps pedestrians away from the kerb. In the simulation, pedestrians against the flow walk along the kerb;
//! real ones keep half a metre away.

use super::DT_S;
use super::filters::{gaussian, gradient, interpolate};
use super::tracks::Cleaned;
use scene::Vec2;
use scene::geometry::{cross, direction};
use scene::map::TypedLine;

/// Distance that pedestrians keep from the kerb, metres.
const KEPT_M: f64 = 0.7;
/// Pedestrians that walk along the road up to this far beside the kerb belong on the sidewalk, metres.
const ASTRAY_M: f64 = 0.9;
/// Steps between two searches for the kerb.
const EVERY: usize = 4;

/// Right borders of carriageways, to find the nearest one.
pub struct Kerbs<'a> {
    lines: Vec<(&'a [Vec2], Vec2, Vec2)>,
}

impl<'a> Kerbs<'a> {
    /// The boundaries among a map's road edges.
    pub fn new(edges: &'a [TypedLine]) -> Self {
        let extent = |line: &'a TypedLine| {
            let points = line.points.xy.as_slice();
            let first = *points.first()?;
            let low = points.iter().fold(first, |a, p| a.inf(p)) - Vec2::repeat(1.0);
            let high = points.iter().fold(first, |a, p| a.sup(p)) + Vec2::repeat(1.0);
            Some((points, low, high))
        };
        Self { lines: edges.iter().filter(|e| e.line_type == "boundary").filter_map(extent).collect() }
    }

    /// Distance and direction by which a pedestrian at `p` with direction `way` must step aside.
    fn push(&self, p: Vec2, way: Vec2) -> Vec2 {
        let mut nearest = (ASTRAY_M, Vec2::zeros());
        for (points, low, high) in &self.lines {
            if p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y {
                continue;
            }
            for w in points.windows(2) {
                let along = (w[1] - w[0]) / (w[1] - w[0]).norm().max(1e-9);
                let s = (p - w[0]).dot(&along).clamp(0.0, (w[1] - w[0]).norm());
                let gap = (p - w[0] - along * s).norm();
                // Crossing pedestrians are not moved.
                if gap < nearest.0 && along.dot(&way).abs() > 0.8 {
                    let right = Vec2::new(along.y, -along.x);
                    let beside = -cross(along, p - w[0]);
                    nearest = (gap, right * (KEPT_M - beside).max(0.0));
                }
            }
        }
        nearest.1
    }

    /// Moves a track smoothly away from the kerb.
    pub fn keep_off(&self, track: &mut Cleaned) {
        let n = track.states.len();
        let places: Vec<usize> = (0..n).step_by(EVERY).collect();
        let pushes: Vec<Vec2> = places
            .iter()
            .map(|&i| self.push(track.states[i].position(), direction(track.states[i].heading_rad)))
            .collect();
        if pushes.iter().all(|p| *p == Vec2::zeros()) {
            return;
        }
        let times: Vec<f64> = places.iter().map(|&i| i as f64).collect();
        let smooth = |pick: fn(&Vec2) -> f64| -> Vec<f64> {
            let coarse: Vec<f64> = pushes.iter().map(pick).collect();
            let coarse = gaussian(&coarse, 3.0);
            let fine: Vec<f64> = (0..n).map(|i| interpolate(&times, &coarse, i as f64)).collect();
            gaussian(&fine, 3.0)
        };
        let (x, y) = (smooth(|p| p.x), smooth(|p| p.y));
        let (vx, vy) = (gradient(&x, DT_S), gradient(&y, DT_S));
        for (i, state) in track.states.iter_mut().enumerate() {
            state.x_m += x[i];
            state.y_m += y[i];
            state.vx_mps += vx[i];
            state.vy_mps += vy[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::State;

    #[test]
    fn walkers_keep_their_distance_and_crossing_ones_their_way() {
        let kerb = [TypedLine {
            id: "1".into(),
            line_type: "boundary".into(),
            points: vec![Vec2::new(-50.0, 0.0), Vec2::new(50.0, 0.0)].into(),
        }];
        let kerbs = Kerbs::new(&kerb);
        let walk = |y: f64, heading_rad: f64| {
            let state = |i: i32| State { x_m: 0.1 * f64::from(i), y_m: y, heading_rad, ..State::default() };
            Cleaned { first: 0, states: (0..100).map(state).collect(), jumps: Vec::new() }
        };
        let mut along = walk(-0.2, 3.1);
        kerbs.keep_off(&mut along);
        assert!(along.states.iter().all(|s| (s.y_m + 0.7).abs() < 0.01));
        let mut across = walk(-0.2, 1.5);
        kerbs.keep_off(&mut across);
        assert!(across.states.iter().all(|s| s.y_m == -0.2));
    }
}
