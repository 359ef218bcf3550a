//! Distance to the nearest road edge, from a grid of the edges' pieces.

use scene::{LaneMap, Vec2};
use std::collections::HashMap;

/// Side of a cell, metres.
const CELL_M: f64 = 10.0;
/// Nothing farther is looked for, metres.
pub(super) const FAR_M: f64 = 40.0;
/// Pieces are cut to this, so that each lies in few cells, metres.
const PIECE_M: f64 = 5.0;

/// Pieces of all road edges (and of the sides of drivable areas) by cell.
pub(super) struct RoadEdges {
    cells: HashMap<(i64, i64), Vec<(Vec2, Vec2)>>,
}

fn cell(p: Vec2) -> (i64, i64) {
    ((p.x / CELL_M).floor() as i64, (p.y / CELL_M).floor() as i64)
}

impl RoadEdges {
    pub(super) fn new(map: &LaneMap) -> Self {
        let mut cells: HashMap<(i64, i64), Vec<(Vec2, Vec2)>> = HashMap::new();
        let lines = map.road_edges.iter().map(|e| e.points.xy.clone());
        let rings = map.drivable.iter().map(|a| {
            let ring = &a.polygon.xy;
            ring.iter().chain(ring.first()).copied().collect::<Vec<_>>()
        });
        for line in lines.chain(rings) {
            for pair in line.windows(2) {
                let parts = ((pair[1] - pair[0]).norm() / PIECE_M).ceil().max(1.0) as usize;
                let at = |i: usize| pair[0] + (pair[1] - pair[0]) * (i as f64 / parts as f64);
                for i in 0..parts {
                    let (a, b) = (at(i), at(i + 1));
                    cells.entry(cell(a)).or_default().push((a, b));
                    if cell(b) != cell(a) {
                        cells.entry(cell(b)).or_default().push((a, b));
                    }
                }
            }
        }
        Self { cells }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Metres from a point to the nearest edge, at most 40.
    pub(super) fn distance_m(&self, p: Vec2) -> f64 {
        let (x, y) = cell(p);
        let mut least = FAR_M;
        let rings = (FAR_M / CELL_M) as i64;
        for ring in 0..=rings {
            // Cells of this ring are at least so far away.
            if (ring - 1) as f64 * CELL_M > least {
                break;
            }
            for dx in -ring..=ring {
                let whole = dx.abs() == ring;
                let step = if whole { 1 } else { (2 * ring).max(1) };
                for dy in (-ring..=ring).step_by(step as usize) {
                    for (a, b) in self.cells.get(&(x + dx, y + dy)).into_iter().flatten() {
                        least = least.min(to_piece(p, *a, *b));
                    }
                }
            }
        }
        least
    }
}

fn to_piece(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let along = b - a;
    let t = (p - a).dot(&along) / along.norm_squared().max(1e-12);
    (a + along * t.clamp(0.0, 1.0) - p).norm()
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
