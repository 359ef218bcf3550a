//! Cubic joins between two poses.

use super::{Polyline, Pose};
use crate::{AgentType, wrap_angle};

/// Window over which the curvature of joined paths is measured, metres.
pub(super) const CURVATURE_WINDOW_M: f64 = 2.0;
/// Points on a join.
const POINTS: usize = 41;

/// Curvature of a comfortable join, 1/m: a car's.
pub(super) fn comfortable_curvature(agent_type: AgentType) -> f64 {
    match agent_type {
        AgentType::Vehicle | AgentType::Other => 0.17,
        AgentType::Cyclist => 0.4,
        AgentType::Pedestrian => 1.0,
    }
}

/// A cubic between two poses.
#[derive(Clone, Debug)]
pub(super) struct Cubic {
    pub path: Polyline,
    /// Greatest absolute curvature, 1/m.
    pub max_curvature: f64,
}

/// Hermite cubic with end tangents of `strength` times the distance between its ends.
pub(super) fn cubic(from: Pose, to: Pose, strength: f64) -> Cubic {
    let reach = strength * (to.position - from.position).norm();
    let (start, end) = (reach * from.direction(), reach * to.direction());
    let (mut points, mut max_curvature) = (Vec::with_capacity(POINTS), 0.0_f64);
    for i in 0..POINTS {
        let t = i as f64 / (POINTS - 1) as f64;
        let (t2, t3) = (t * t, t * t * t);
        let (h10, h01, h11) = (t - 2.0 * t2 + t3, 3.0 * t2 - 2.0 * t3, t3 - t2);
        points.push(from.position + h10 * start + h01 * (to.position - from.position) + h11 * end);
        let (d10, d01, d11) = (1.0 - 4.0 * t + 3.0 * t2, 6.0 * t - 6.0 * t2, 3.0 * t2 - 2.0 * t);
        let (c10, c01, c11) = (6.0 * t - 4.0, 6.0 - 12.0 * t, 6.0 * t - 2.0);
        let slope = d10 * start + d01 * (to.position - from.position) + d11 * end;
        let bend = c10 * start + c01 * (to.position - from.position) + c11 * end;
        let speed = slope.norm().max(1e-6);
        max_curvature = max_curvature.max((slope.x * bend.y - slope.y * bend.x).abs() / speed.powi(3));
    }
    Cubic { path: Polyline::new(points), max_curvature }
}

/// Cost of a join: 1.6 for each metre of the cubic and 150 for each 1/m of curvature over `limit`.
pub(super) fn cost(join: &Cubic, limit: f64) -> f64 {
    1.6 * join.path.length_m() + 150.0 * (join.max_curvature - limit).max(0.0)
}

/// Cheapest cubic between two poses. A turn of more than about 100 degrees needs room, so several strengths
/// are tried for it.
pub(super) fn best(from: Pose, to: Pose, limit: f64) -> Cubic {
    if wrap_angle(to.heading_rad - from.heading_rad).abs() < 1.8 {
        return cubic(from, to, 1.0);
    }
    let cheaper = |a: Cubic, b: Cubic| if cost(&b, limit) < cost(&a, limit) { b } else { a };
    [2.0, 3.0].into_iter().map(|strength| cubic(from, to, strength)).fold(cubic(from, to, 1.2), cheaper)
}
