//! Road edges in a grid: where a straight look from a lane meets the kerb.

use scene::geometry::cross;
use scene::{LaneMap, Vec2};
use std::collections::HashMap;

/// Side of a grid cell, metres.
const CELL_M: f64 = 8.0;
/// Most pieces kept; maps with longer edges get longer pieces.
const MAX_PIECES: f64 = 300_000.0;

/// Straight pieces of all road edges, each in the cell of its middle.
pub(super) struct EdgeIndex {
    cells: HashMap<(i32, i32), Vec<(Vec2, Vec2)>>,
    /// Greatest half length of a piece, metres.
    half_m: f64,
}

fn cell(p: Vec2) -> (i32, i32) {
    ((p.x / CELL_M).floor() as i32, (p.y / CELL_M).floor() as i32)
}

impl EdgeIndex {
    pub(super) fn new(map: &LaneMap) -> Self {
        let sides = || map.road_edges.iter().flat_map(|e| e.points.xy.windows(2)).map(|w| (w[0], w[1]));
        let total_m: f64 = sides().map(|(a, b)| (b - a).norm()).sum();
        let piece_m = CELL_M.max(total_m / MAX_PIECES);
        let mut cells: HashMap<(i32, i32), Vec<(Vec2, Vec2)>> = HashMap::new();
        for (a, b) in sides() {
            let count = ((b - a).norm() / piece_m).ceil().max(1.0) as usize;
            let at = |i: usize| a + (b - a) * (i as f64 / count as f64);
            for i in 0..count {
                cells.entry(cell(0.5 * (at(i) + at(i + 1)))).or_default().push((at(i), at(i + 1)));
            }
        }
        Self { cells, half_m: 0.5 * piece_m }
    }

    /// Distance from `from` to the first edge along the unit vector `way`, at most `most_m`; metres.
    pub(super) fn ray_m(&self, from: Vec2, way: Vec2, most_m: f64) -> Option<f64> {
        let to = from + way * most_m;
        let reach = Vec2::repeat(self.half_m);
        let (low, high) = (cell(from.inf(&to) - reach), cell(from.sup(&to) + reach));
        let mut nearest: Option<f64> = None;
        for column in low.0..=high.0 {
            for row in low.1..=high.1 {
                for (a, b) in self.cells.get(&(column, row)).into_iter().flatten() {
                    let (d, side) = (way * most_m, b - a);
                    let turn = cross(d, side);
                    if turn.abs() < 1e-12 {
                        continue;
                    }
                    let (along, across) = (cross(a - from, side) / turn, cross(a - from, d) / turn);
                    if (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across) {
                        let met = along * most_m;
                        nearest = Some(nearest.map_or(met, |n: f64| n.min(met)));
                    }
                }
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::TypedLine;

    #[test]
    fn a_look_meets_the_nearest_edge() {
        let edge = |y: f64| TypedLine {
            id: y.to_string(),
            line_type: "boundary".into(),
            points: vec![Vec2::new(-50.0, y), Vec2::new(50.0, y)].into(),
        };
        let map = LaneMap { road_edges: vec![edge(4.0), edge(6.0), edge(-30.0)], ..LaneMap::default() };
        let index = EdgeIndex::new(&map);
        let look = |x: f64, y: f64| index.ray_m(Vec2::new(x, 0.0), Vec2::new(0.0, y), 12.0);
        assert_eq!(look(17.3, 1.0), Some(4.0));
        assert_eq!(look(17.3, -1.0), None);
        assert_eq!(look(60.0, 1.0), None);
    }
}
