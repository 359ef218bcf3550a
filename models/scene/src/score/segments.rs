//! Straight pieces in a uniform grid: the few that lie near a point, quickly.

use crate::geometry::{Vec2, cross};

/// Side of a grid cell, metres, on maps that are not huge.
const CELL_M: f64 = 8.0;
/// Most cells along one side of the grid.
const MOST_CELLS: f64 = 512.0;
/// Points that lie this near the chord of their neighbours are left out, metres.
const THIN_M: f64 = 0.03;

/// A straight piece that belongs to `owner` (a lane, polygon or edge by index).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub from: Vec2,
    pub to: Vec2,
    pub owner: u32,
}

impl Segment {
    /// Point of the piece nearest to `p`.
    pub fn foot(&self, p: Vec2) -> Vec2 {
        let along = self.to - self.from;
        let length_squared = along.norm_squared();
        let part = if length_squared > 0.0 { (p - self.from).dot(&along) / length_squared } else { 0.0 };
        self.from + along * part.clamp(0.0, 1.0)
    }

    /// The piece crosses the straight line between two points.
    pub fn crosses(&self, p: Vec2, q: Vec2) -> bool {
        let (along, other) = (self.to - self.from, q - p);
        let beside = |base: Vec2, direction: Vec2, point: Vec2| cross(direction, point - base);
        beside(self.from, along, p) * beside(self.from, along, q) < 0.0
            && beside(p, other, self.from) * beside(p, other, self.to) < 0.0
    }
}

/// Pieces of a line with near-straight points left out; closed adds the piece back to the start.
pub(super) fn pieces(points: &[Vec2], closed: bool, owner: u32) -> Vec<Segment> {
    let mut kept = thinned(points);
    if closed {
        kept.extend(points.first().copied());
    }
    kept.windows(2).map(|w| Segment { from: w[0], to: w[1], owner }).filter(|s| s.from != s.to).collect()
}

/// Leaves out points while all of them stay near the chord that replaces them.
fn thinned(points: &[Vec2]) -> Vec<Vec2> {
    let mut kept = Vec::new();
    let mut anchor = 0;
    kept.extend(points.first().copied());
    while anchor + 1 < points.len() {
        let mut end = anchor + 1;
        while end + 1 < points.len() && end - anchor < 40 {
            let chord = Segment { from: points[anchor], to: points[end + 1], owner: 0 };
            if points[anchor + 1..=end].iter().any(|p| (chord.foot(*p) - p).norm() > THIN_M) {
                break;
            }
            end += 1;
        }
        kept.push(points[end]);
        anchor = end;
    }
    kept
}

/// Grid of pieces. Built once a map; read by any number of threads.
#[derive(Clone, Debug, Default)]
pub(super) struct Segments {
    all: Vec<Segment>,
    origin: Vec2,
    cell_m: f64,
    columns: usize,
    rows: usize,
    /// `held[starts[c]..starts[c + 1]]` are the pieces that touch cell `c`.
    starts: Vec<u32>,
    held: Vec<u32>,
}

impl Segments {
    /// Grid over these pieces.
    pub fn new(all: Vec<Segment>) -> Self {
        let mut low = Vec2::repeat(f64::INFINITY);
        let mut high = -low;
        for s in &all {
            low = low.inf(&s.from.inf(&s.to));
            high = high.sup(&s.from.sup(&s.to));
        }
        if all.is_empty() {
            return Self::default();
        }
        let extent = high - low;
        let cell_m = CELL_M.max(extent.max() / MOST_CELLS);
        let count = |length: f64| (length / cell_m) as usize + 1;
        let (columns, rows) = (count(extent.x), count(extent.y));
        let mut grid = Self { all, origin: low, cell_m, columns, rows, starts: Vec::new(), held: Vec::new() };
        grid.fill();
        grid
    }

    fn fill(&mut self) {
        let mut cells: Vec<Vec<u32>> = vec![Vec::new(); self.columns * self.rows];
        for (i, s) in self.all.iter().enumerate() {
            let middle = 0.5 * (s.from + s.to);
            let half = 0.5 * (s.to - s.from).abs();
            for cell in self.cells(middle, half) {
                // A long slanted piece skips the cells of its rectangle that it does not enter.
                let (column, row) = (cell % self.columns, cell / self.columns);
                let center = self.origin + Vec2::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell_m;
                if (s.foot(center) - center).norm() <= 0.7072 * self.cell_m {
                    cells[cell].push(i as u32);
                }
            }
        }
        self.starts = std::iter::once(0)
            .chain(cells.iter().scan(0, |sum, c| {
                *sum += c.len() as u32;
                Some(*sum)
            }))
            .collect();
        self.held = cells.concat();
    }

    /// Cells that a rectangle touches.
    fn cells(&self, middle: Vec2, half: Vec2) -> impl Iterator<Item = usize> + use<> {
        let cell = |v: f64, most: usize| (v / self.cell_m).floor().clamp(-1.0, most as f64);
        let (low, high) = (middle - half - self.origin, middle + half - self.origin);
        let range = |from: f64, to: f64, most: usize| {
            let (from, to) = (cell(from, most), cell(to, most));
            // Wholly outside gives an empty range.
            (from.max(0.0) as usize)..((to + 1.0).min(most as f64) as usize)
        };
        let (across, up) = (range(low.x, high.x, self.columns), range(low.y, high.y, self.rows));
        let columns = self.columns;
        up.flat_map(move |row| across.clone().map(move |column| row * columns + column))
    }

    /// No pieces.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Pieces that may come within `radius_m` of `point` (some come twice, some are farther).
    pub fn near(&self, point: Vec2, radius_m: f64) -> impl Iterator<Item = &Segment> {
        let cells = (!self.all.is_empty()).then(|| self.cells(point, Vec2::repeat(radius_m)));
        cells.into_iter().flatten().flat_map(|cell| {
            let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            self.held[range].iter().map(|&i| &self.all[i as usize])
        })
    }

    /// Nearest piece within `most_m`, with its foot and distance.
    pub fn nearest(&self, point: Vec2, most_m: f64) -> Option<(&Segment, Vec2, f64)> {
        let mut radius = CELL_M.min(most_m);
        loop {
            let measured = self.near(point, radius).map(|s| {
                let foot = s.foot(point);
                (s, foot, (foot - point).norm())
            });
            let best = measured.min_by(|a, b| a.2.total_cmp(&b.2));
            if let Some(found) = best.filter(|b| b.2 <= radius) {
                return Some(found);
            }
            if radius >= most_m {
                return None;
            }
            radius = (2.0 * radius).min(most_m);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn straight_points_are_left_out() {
        let line: Vec<Vec2> = (0..=20).map(|i| Vec2::new(i as f64 * 0.5, 0.0)).collect();
        assert_eq!(pieces(&line, false, 3).len(), 1);
        let ring = [Vec2::zeros(), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        assert_eq!(pieces(&ring, true, 0).len(), 3);
        assert!(pieces(&[], true, 0).is_empty() && pieces(&ring[..1], true, 0).is_empty());
    }

    proptest! {
        #[test]
        fn nearest_agrees_with_looking_at_all(
            ends in prop::collection::vec((-60.0..60.0, -60.0..60.0, -20.0..20.0, -20.0..20.0), 1..40),
            x in -90.0..90.0, y in -90.0..90.0,
        ) {
            let all: Vec<Segment> = ends.iter().map(|&(x, y, dx, dy)| {
                Segment { from: Vec2::new(x, y), to: Vec2::new(x + dx, y + dy), owner: 0 }
            }).collect();
            let p = Vec2::new(x, y);
            let least = all.iter().map(|s| (s.foot(p) - p).norm()).fold(f64::INFINITY, f64::min);
            let grid = Segments::new(all);
            let found = grid.nearest(p, 400.0).unwrap();
            prop_assert!((found.2 - least).abs() < 1e-9);
        }
    }
}
