//! Which road edges bound which lanes, derived from their positions.

use scene::Vec2;
use scene::geometry::cross;
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::map::{Boundary, LaneMap};

/// An edge within this distance of a lane's side bounds it, metres.
const NEAR_M: f64 = 0.3;

/// Assigns road edges to lanes that have no line at a side.
pub(crate) fn by_edges(map: &mut LaneMap) {
    let edges = map.road_edges.iter().zip(0..).flat_map(|(edge, i)| pieces(&edge.points.xy, i)).collect();
    let index = SegmentIndex::new(edges);
    let ids: Vec<String> = map.road_edges.iter().map(|edge| edge.id.clone()).collect();
    for lane in map.lanes.iter_mut().filter(|lane| lane.lane_type.carries_vehicles()) {
        let half_m = lane.width_or_assumed_m() / 2.0;
        let points = &lane.points.xy;
        let sides = [(1.0, &mut lane.left_boundary), (-1.0, &mut lane.right_boundary)];
        for (sign, boundaries) in sides.into_iter().filter(|(_, boundaries)| boundaries.is_empty()) {
            for i in 0..points.len() {
                let way = points[(i + 1).min(points.len() - 1)] - points[i.saturating_sub(1)];
                let side = Vec2::new(-way.y, way.x) * (sign * half_m / way.norm().max(1e-9));
                let beside = points[i] + side;
                let near = index.near(beside, NEAR_M).filter(|edge| {
                    let along = edge.to - edge.from;
                    (edge.foot(beside) - beside).norm() < NEAR_M
                        && cross(along, way).abs() < 0.3 * along.norm() * way.norm()
                });
                let Some(owner) = near.map(|edge| edge.owner).min() else { continue };
                let Some(id) = ids.get(owner as usize) else { continue };
                match boundaries.last_mut() {
                    Some(last) if last.line == *id && last.to + 1 == i => last.to = i,
                    _ => boundaries.push(Boundary { line: id.clone(), from: i, to: i, kind: Some(0) }),
                }
            }
        }
    }
}
