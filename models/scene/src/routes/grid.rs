//! Uniform grid over pieces of polylines, as one sorted array: quick to build, small, no hashing.

use crate::Vec2;
use crate::geometry::polyline::Polyline;

/// Edge of a cell, metres.
const CELL_M: f64 = 10.0;
/// Most cells walked along one piece; only coordinates far outside any scene need more.
const MAX_CHUNKS: f64 = 4_096.0;

/// One piece of one line in one cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    /// Row-major cell key.
    cell: u64,
    line: u32,
    piece: u32,
}

/// Which pieces of which lines pass through which cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid {
    entries: Vec<Entry>,
}

fn cell(coordinate_m: f64) -> i32 {
    // The cast saturates, which is what a far coordinate needs.
    (coordinate_m / CELL_M).floor() as i32
}

fn key(column: i32, row: i32) -> u64 {
    let biased = |i: i32| u64::from((i as u32) ^ 0x8000_0000);
    (biased(row) << 32) | biased(column)
}

impl Grid {
    /// Grid of all pieces of `lines`; a line's number is its place in the iteration.
    pub(super) fn new<'a>(lines: impl Iterator<Item = &'a Polyline>) -> Self {
        let mut entries = Vec::new();
        for (line, path) in lines.enumerate() {
            for (piece, ends) in path.points().windows(2).enumerate() {
                let (line, piece) = (line as u32, piece as u32);
                cells_along(ends[0], ends[1], |cell| entries.push(Entry { cell, line, piece }));
            }
        }
        entries.sort_unstable();
        entries.dedup();
        Self { entries }
    }

    /// Calls `found(line, piece)` for every piece that may come within `radius_m` of `point`; a piece may
    /// be named several times.
    pub(super) fn visit(&self, point: Vec2, radius_m: f64, mut found: impl FnMut(usize, usize)) {
        if !(point.x.is_finite() && point.y.is_finite() && radius_m >= 0.0) {
            return;
        }
        let (left, right) = (cell(point.x - radius_m), cell(point.x + radius_m));
        let (bottom, top) = (cell(point.y - radius_m), cell(point.y + radius_m));
        let mut at = self.entries.partition_point(|e| e.cell < key(left, bottom));
        while let Some(entry) = self.entries.get(at) {
            // Rows without entries are skipped: the next one to look at is that of the next entry.
            let row = ((entry.cell >> 32) as u32 ^ 0x8000_0000) as i32;
            if row > top {
                return;
            }
            let (first, last) = (key(left, row), key(right, row));
            if entry.cell < first {
                at += self.entries[at..].partition_point(|e| e.cell < first);
            } else if entry.cell > last {
                let Some(next) = row.checked_add(1) else { return };
                at += self.entries[at..].partition_point(|e| e.cell < key(left, next));
            } else {
                found(entry.line as usize, entry.piece as usize);
                at += 1;
            }
        }
    }
}

/// Calls `found` with the cells around the piece from `a` to `b`, chunk by chunk.
fn cells_along(a: Vec2, b: Vec2, mut found: impl FnMut(u64)) {
    let chunks = ((b - a).norm() / CELL_M).ceil().clamp(1.0, MAX_CHUNKS);
    let mut from = a;
    for i in 1..=chunks as usize {
        let to = a + (b - a) * (i as f64 / chunks);
        let columns = (cell(from.x.min(to.x)), cell(from.x.max(to.x)));
        let rows = (cell(from.y.min(to.y)), cell(from.y.max(to.y)));
        for row in rows.0..=rows.1 {
            for column in columns.0..=columns.1 {
                found(key(column, row));
            }
        }
        from = to;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_long_pieces_from_their_middle() {
        let lines = [
            Polyline::new([Vec2::new(-500.0, 3.0), Vec2::new(500.0, 3.0)]),
            Polyline::new([Vec2::new(0.0, -300.0), Vec2::new(0.0, -200.0)]),
        ];
        let grid = Grid::new(lines.iter());
        let mut found = Vec::new();
        grid.visit(Vec2::new(17.0, 0.0), 5.0, |line, piece| found.push((line, piece)));
        found.dedup();
        assert_eq!(found, [(0, 0)]);
    }

    #[test]
    fn odd_queries_find_nothing() {
        let lines = [Polyline::new([Vec2::zeros(), Vec2::new(1.0, 0.0)])];
        let grid = Grid::new(lines.iter());
        for (point, radius) in
            [(Vec2::new(f64::NAN, 0.0), 5.0), (Vec2::zeros(), -1.0), (Vec2::zeros(), f64::NAN)]
        {
            grid.visit(point, radius, |_, _| panic!("nothing is near nowhere"));
        }
        let mut count = 0;
        grid.visit(Vec2::zeros(), f64::INFINITY, |_, _| count += 1);
        assert_eq!(count, 1);
    }
}
