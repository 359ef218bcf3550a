//! Distance to the nearest road edge.

use scene::geometry::segments::{SegmentIndex, pieces};
use scene::{LaneMap, Vec2};

/// Greatest distance that is searched, metres.
pub(super) const FAR_M: f64 = 40.0;

/// All road edges and the sides of drivable areas.
pub(super) struct RoadEdges(SegmentIndex);

impl RoadEdges {
    pub(super) fn new(map: &LaneMap) -> Self {
        let lines = map.road_edges.iter().map(|e| e.points.xy.to_vec());
        let rings = map.drivable.iter().map(|a| {
            let ring = &a.polygon.xy;
            ring.iter().chain(ring.first()).copied().collect()
        });
        let lines: Vec<Vec<Vec2>> = lines.chain(rings).collect();
        Self(SegmentIndex::new((0..).zip(&lines).flat_map(|(i, line)| pieces(line, i)).collect()))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Distance from a point to the nearest edge, at most [`FAR_M`], metres.
    pub(super) fn distance_m(&self, p: Vec2) -> f64 {
        self.0.nearest(p, FAR_M).map_or(FAR_M, |found| found.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::TypedLine;

    #[test]
    fn nearest_edge_in_any_cell() {
        let edge = |y: f64| TypedLine {
            id: format!("{y}"),
            line_type: "boundary".into(),
            points: vec![Vec2::new(-100.0, y), Vec2::new(100.0, y)].into(),
        };
        let edges =
            RoadEdges::new(&LaneMap { road_edges: vec![edge(-4.0), edge(31.0)], ..LaneMap::default() });
        assert!((edges.distance_m(Vec2::new(3.0, 0.0)) - 4.0).abs() < 1e-9);
        assert!((edges.distance_m(Vec2::new(3.0, 20.0)) - 11.0).abs() < 1e-9);
        assert!((edges.distance_m(Vec2::new(3.0, 500.0)) - FAR_M).abs() < 1e-9);
        assert!(RoadEdges::new(&LaneMap::default()).is_empty());
    }
}
