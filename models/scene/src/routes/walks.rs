//! Paths for pedestrians: sidewalks both ways, and crosswalks along their longer axis.

use super::graph::{GraphLane, LaneSource};
use super::links::{NearPoints, connect};
use crate::geometry::polyline::Polyline;
use crate::map::LaneType;
use crate::{LaneMap, Vec2, wrap_angle};

/// Greatest gap between walking paths that are joined, metres.
const WALK_GAP_M: f64 = 2.5;
/// Greatest turn between walking paths that are joined.
const WALK_TURN_RAD: f64 = 120.0 * std::f64::consts::PI / 180.0;

/// Appends the reverse of every sidewalk and both directions of every crosswalk, and joins ends that meet.
pub(super) fn append(map: &LaneMap, lanes: &mut Vec<GraphLane>) {
    let recorded = lanes.len();
    for i in 0..recorded {
        if lanes[i].lane_type == LaneType::Sidewalk {
            let mut lane =
                GraphLane::new(LaneSource::Reversed(i), LaneType::Sidewalk, lanes[i].path.reversed());
            (lane.width_m, lane.speed_limit_mps) = (lanes[i].width_m, lanes[i].speed_limit_mps);
            lanes.push(lane);
        }
    }
    for (i, area) in map.crosswalks.iter().enumerate() {
        if let Some((a, b, width_m)) = long_axis(&area.polygon.xy) {
            for ends in [[a, b], [b, a]] {
                let path = Polyline::new(ends);
                let lane = GraphLane::new(LaneSource::Crosswalk(i), LaneType::Sidewalk, path);
                lanes.push(GraphLane { width_m, ..lane });
            }
        }
    }
    join(lanes);
}

fn join(lanes: &mut [GraphLane]) {
    let walks: Vec<usize> = (0..lanes.len())
        .filter(|i| lanes[*i].lane_type == LaneType::Sidewalk && lanes[*i].path.length_m() > 0.0)
        .collect();
    let starts = NearPoints::new(walks.iter().map(|i| (*i, lanes[*i].path.first().position)), WALK_GAP_M);
    for from in walks {
        let end = lanes[from].path.last();
        for to in starts.near(end.position) {
            let turn = wrap_angle(lanes[to].path.first().heading_rad - end.heading_rad).abs();
            if from != to && turn <= WALK_TURN_RAD {
                connect(lanes, from, to);
            }
        }
    }
}

/// Ends of a ring's longer principal axis and its width across, from the moments of its edges; `None` for a
/// ring without extent.
fn long_axis(ring: &[Vec2]) -> Option<(Vec2, Vec2, f64)> {
    let edges = || ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| (0.5 * (a + b), (b - a).norm()));
    let total: f64 = edges().map(|e| e.1).sum();
    if !(total > 0.5 && total.is_finite()) {
        return None;
    }
    let centre = edges().map(|(middle, length)| middle * length).sum::<Vec2>() / total;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (middle, length) in edges() {
        let d = middle - centre;
        (xx, xy, yy) = (xx + length * d.x * d.x, xy + length * d.x * d.y, yy + length * d.y * d.y);
    }
    // Corners contribute the shape that edge midpoints of a narrow ring lose.
    for p in ring {
        let (d, w) = (p - centre, total / ring.len() as f64);
        (xx, xy, yy) = (xx + w * d.x * d.x, xy + w * d.x * d.y, yy + w * d.y * d.y);
    }
    let axis = crate::geometry::direction(0.5 * (2.0 * xy).atan2(xx - yy));
    let across = Vec2::new(-axis.y, axis.x);
    let extent = |unit: Vec2| {
        let along = ring.iter().map(move |p| (p - centre).dot(&unit));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (along, wide) = (extent(axis), extent(across));
    let middle = centre + across * (0.5 * (wide.0 + wide.1));
    let width = wide.1 - wide.0;
    (along.1 - along.0 > 0.5).then_some((middle + axis * along.0, middle + axis * along.1, width))
}
