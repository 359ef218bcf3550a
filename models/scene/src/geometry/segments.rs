//! Straight pieces of lines in a uniform grid, for fast queries of the pieces near a point. The only spatial
//! index of lanes, road edges and areas.
//!
//! The grid is one sorted array of occupied cells, with a table of where each cell begins. It is fast to
//! build and small, and needs no hashing. If a few pieces lie far from all others, there is no table, and
//! cells are found by binary search.

use super::fine_cells::{FineCells, Square};
use super::{Vec2, cross};
use std::sync::{Arc, OnceLock};

/// Side of a grid cell, metres.
const CELL_M: f64 = 8.0;
/// Most parts into which a piece is cut to find its cells; only coordinates far outside any scene need more.
const MOST_STRETCHES: f64 = 4_096.0;
/// Points within this distance of the chord of their neighbours are left out, metres.
const THIN_M: f64 = 0.03;

/// A straight piece of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Start point.
    pub from: Vec2,
    /// End point.
    pub to: Vec2,
    /// Index of its line: a lane, polygon or edge.
    pub owner: u32,
    /// Number of the piece within its line, from 0.
    pub piece: u32,
}

impl Segment {
    /// Point of the piece nearest to `p`.
    pub fn foot(&self, p: Vec2) -> Vec2 {
        let along = self.to - self.from;
        let length_squared = along.norm_squared();
        let part = if length_squared > 0.0 { (p - self.from).dot(&along) / length_squared } else { 0.0 };
        self.from + along * part.clamp(0.0, 1.0)
    }

    /// Whether the piece crosses the segment between two points.
    pub fn crosses(&self, p: Vec2, q: Vec2) -> bool {
        let (along, other) = (self.to - self.from, q - p);
        let beside = |base: Vec2, direction: Vec2, point: Vec2| cross(direction, point - base);
        beside(self.from, along, p) * beside(self.from, along, q) < 0.0
            && beside(p, other, self.from) * beside(p, other, self.to) < 0.0
    }
}

/// All pieces of a line.
pub fn pieces(points: &[Vec2], owner: u32) -> impl Iterator<Item = Segment> {
    let number = move |(piece, ends): (usize, &[Vec2])| {
        let piece = u32::try_from(piece).unwrap_or(u32::MAX);
        Segment { from: ends[0], to: ends[1], owner, piece }
    };
    points.windows(2).enumerate().map(number)
}

/// Pieces of a line without its nearly collinear points; `closed` adds the piece back to the start.
pub fn thinned_pieces(points: &[Vec2], closed: bool, owner: u32) -> Vec<Segment> {
    let mut kept = thinned(points);
    if closed {
        kept.extend(points.first().copied());
    }
    pieces(&kept, owner).filter(|s| s.from != s.to).collect()
}

/// Leaves out points as long as all of them stay near the chord that replaces them.
fn thinned(points: &[Vec2]) -> Vec<Vec2> {
    let mut kept = Vec::new();
    let mut anchor = 0;
    kept.extend(points.first().copied());
    while anchor + 1 < points.len() {
        let mut end = anchor + 1;
        while end + 1 < points.len() && end - anchor < 40 {
            let chord = Segment { from: points[anchor], to: points[end + 1], owner: 0, piece: 0 };
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

/// Limit of table cells per entry of the array, and independently of it.
const CELLS_AN_ENTRY: usize = 16;
const CELLS_ANYWAY: usize = 4_096;
/// Radius that usually contains the nearest piece, metres.
const NEAREST_M: f64 = 2.0;
/// Greatest distance of a piece outside the cells in which it is listed, by rounding, metres.
const ROUNDING_M: f64 = 1e-6;
/// Reach, metres, and greatest length of the lists of candidates for the nearest piece.
const LISTED_M: f64 = 1_000.0;
const MOST_LISTED: usize = 64;

/// Grid of pieces. Built once per map; read by any number of threads.
#[derive(Clone, Debug, Default)]
pub struct SegmentIndex {
    all: Vec<Segment>,
    /// Cells by row from south to north, each with the index of a piece that passes through it.
    cells: Vec<(u64, u32)>,
    table: Option<CellTable>,
    /// For each fine cell, the candidates for the nearest piece to any point in it. Empty if they are far or
    /// many.
    likely: OnceLock<Arc<FineCells>>,
}

/// Start of each cell of a rectangle of cells in the array.
#[derive(Clone, Debug)]
struct CellTable {
    left: i32,
    bottom: i32,
    columns: usize,
    rows: usize,
    /// By row, then column; one more for the end.
    first: Vec<u32>,
}

impl CellTable {
    /// The table of sorted cells; `None` if they are sparse in their rectangle.
    fn of(cells: &[(u64, u32)]) -> Option<Self> {
        let (low, high) = (cells.first()?.0, cells.last()?.0);
        let left = cells.iter().map(|c| column_of(c.0)).min()?;
        let right = cells.iter().map(|c| column_of(c.0)).max()?;
        let (bottom, top) = (row_of(low), row_of(high));
        let count = |from: i32, to: i32| usize::try_from(i64::from(to) - i64::from(from) + 1).ok();
        let (columns, rows) = (count(left, right)?, count(bottom, top)?);
        let most = CELLS_AN_ENTRY * cells.len() + CELLS_ANYWAY;
        let all = columns.checked_mul(rows).filter(|all| *all <= most)?;
        let mut first = vec![0_u32; all + 1];
        let place = |key: u64| {
            let (row, column) = (i64::from(row_of(key)), i64::from(column_of(key)));
            ((row - i64::from(bottom)) as usize) * columns + (column - i64::from(left)) as usize
        };
        for (cell, _) in cells {
            first[place(*cell) + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        Some(Self { left, bottom, columns, rows, first })
    }

    /// Entries of the columns `left` to `right` of a row.
    fn entries(&self, row: i32, left: i32, right: i32) -> std::ops::Range<usize> {
        let at = |i: i32, from: i32, count: usize| (i64::from(i) - i64::from(from)).clamp(-1, count as i64);
        let row = at(row, self.bottom, self.rows);
        let (left, right) = (at(left, self.left, self.columns), at(right, self.left, self.columns));
        let (left, right) = (left.max(0), right.min(self.columns as i64 - 1));
        if row < 0 || row >= self.rows as i64 || left > right {
            return 0..0;
        }
        let base = row as usize * self.columns;
        self.first[base + left as usize] as usize..self.first[base + right as usize + 1] as usize
    }

    /// The given rows, clipped to the rectangle.
    fn rows(&self, bottom: i32, top: i32) -> (i32, i32) {
        let last = i64::from(self.bottom) + self.rows as i64 - 1;
        (bottom.max(self.bottom), i64::from(top).min(last) as i32)
    }
}

impl SegmentIndex {
    /// Grid over these pieces.
    pub fn new(all: Vec<Segment>) -> Self {
        let mut cells = Vec::with_capacity(2 * all.len());
        for (number, segment) in (0..u32::MAX).zip(&all) {
            cells_along(segment, |cell| cells.push((cell, number)));
        }
        cells.sort_unstable();
        cells.dedup();
        let table = CellTable::of(&cells);
        Self { all, cells, table, likely: OnceLock::new() }
    }

    /// No pieces.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Pieces that may come within `radius_m` of `point`; some occur twice, some are farther. Empty if the
    /// point or radius is NaN.
    pub fn near(&self, point: Vec2, radius_m: f64) -> impl Iterator<Item = &Segment> {
        self.around(point, radius_m).map(|(_, number)| &self.all[number as usize])
    }

    fn around(&self, point: Vec2, radius_m: f64) -> Within<'_> {
        let reach = Vec2::repeat(radius_m);
        self.within(point - reach, point + reach)
    }

    /// Cells of pieces that may enter the rectangle between two corners; some occur twice, some do not enter
    /// it.
    fn within(&self, low: Vec2, high: Vec2) -> Within<'_> {
        let empty = low.x.is_nan() || low.y.is_nan() || !(low.x <= high.x && low.y <= high.y);
        let (left, right) = (cell(low.x), cell(high.x));
        let (bottom, top) = (cell(low.y), cell(high.y));
        let mut within = Within { index: self, entries: 0..0, left, right, row: bottom, top };
        if empty {
            (within.row, within.top) = (0, -1);
        } else if let Some(table) = &self.table {
            (within.row, within.top) = table.rows(bottom, top);
        }
        within
    }

    /// Nearest piece within `most_m`, with its foot and distance; the first wins ties.
    pub fn nearest(&self, point: Vec2, most_m: f64) -> Option<(&Segment, Vec2, f64)> {
        match self.likely_nearest(point) {
            Some(likely) => self.nearest_of(likely.iter().copied(), point).filter(|found| found.2 <= most_m),
            None => self.nearest_by_search(point, most_m),
        }
    }

    fn nearest_of(&self, numbers: impl Iterator<Item = u32>, point: Vec2) -> Option<(&Segment, Vec2, f64)> {
        let mut best: Option<(u32, Vec2, f64)> = None;
        for number in numbers {
            let foot = self.all[number as usize].foot(point);
            let distance = (foot - point).norm();
            if best.is_none_or(|b| distance < b.2 || (distance == b.2 && number < b.0)) {
                best = Some((number, foot, distance));
            }
        }
        best.map(|(number, foot, distance)| (&self.all[number as usize], foot, distance))
    }

    /// The nearest piece, by a search with growing radius.
    fn nearest_by_search(&self, point: Vec2, most_m: f64) -> Option<(&Segment, Vec2, f64)> {
        let mut radius = NEAREST_M.min(most_m);
        loop {
            let mut best: Option<(u32, Vec2, f64)> = None;
            self.outwards(point, radius, |number, segment| {
                let foot = segment.foot(point);
                let distance = (foot - point).norm();
                if best.is_none_or(|b| distance < b.2 || (distance == b.2 && number < b.0)) {
                    best = Some((number, foot, distance));
                }
                best.map_or(f64::INFINITY, |b| b.2)
            });
            if let Some((number, foot, distance)) = best.filter(|found| found.2 <= radius) {
                return Some((&self.all[number as usize], foot, distance));
            }
            if radius >= most_m {
                return None;
            }
            radius = (2.0 * radius).min(most_m);
        }
    }

    /// Calls `look` with the pieces that may come within `radius_m` of `point`, nearest cells first. Some
    /// occur twice, some are farther. `look` returns the distance beyond which it wants no more pieces, so
    /// that many distant pieces cost no more than their nearest cells.
    pub fn outwards(&self, point: Vec2, radius_m: f64, mut look: impl FnMut(u32, &Segment) -> f64) {
        let reach = Vec2::repeat(radius_m);
        let mut rows = self.within(point - reach, point + reach);
        let mut cells: Vec<(f64, std::ops::Range<usize>)> = Vec::new();
        while rows.next_row() {
            let mut row = std::mem::take(&mut rows.entries);
            while let Some((cell, _)) = self.cells.get(row.start).filter(|_| !row.is_empty()) {
                let end = row.start + self.cells[row.clone()].partition_point(|other| other.0 <= *cell);
                cells.push((least_m(*cell, point), row.start..end));
                row.start = end;
            }
        }
        cells.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.start.cmp(&b.1.start)));
        let mut most_m = f64::INFINITY;
        for (least_m, entries) in cells {
            if least_m > most_m {
                break;
            }
            for (_, number) in &self.cells[entries] {
                most_m = look(*number, &self.all[*number as usize]);
            }
        }
    }

    /// Indices of the candidates for the nearest piece to a point; `None` if a search has to find it.
    fn likely_nearest(&self, point: Vec2) -> Option<&[u32]> {
        let table = self.table.as_ref()?;
        let lists = self.likely.get_or_init(|| {
            Arc::new(FineCells::new(CELL_M, [table.left, table.bottom], table.columns, table.rows))
        });
        lists.list(point, |square| self.likely_in(square)).filter(|likely| !likely.is_empty())
    }

    /// Indices of the candidates for the nearest piece to any point of a square. From its centre, a candidate
    /// is farther than the nearest piece by at most the diagonal.
    fn likely_in(&self, Square { centre, side_m }: Square) -> Box<[u32]> {
        let Some((.., least_m)) = self.nearest_by_search(centre, LISTED_M) else { return Box::default() };
        let reach_m = least_m + 1.5 * side_m;
        let is_likely = |number: &u32| (self.all[*number as usize].foot(centre) - centre).norm() <= reach_m;
        let mut likely: Vec<u32> = self.around(centre, reach_m).map(|c| c.1).filter(is_likely).collect();
        likely.sort_unstable();
        likely.dedup();
        if likely.len() > MOST_LISTED { Box::default() } else { likely.into() }
    }

    /// Approximate bytes of memory of the lists of candidates.
    pub(crate) fn listed_bytes(&self) -> usize {
        self.likely.get().map_or(0, |lists| lists.bytes())
    }

    /// Distance from `from` along the unit vector `way` to the first piece on it, at most `most_m`, metres.
    pub fn ray_m(&self, from: Vec2, way: Vec2, most_m: f64) -> Option<f64> {
        let to = from + way * most_m;
        let ray = to - from;
        let met = |segment: &Segment| {
            let side = segment.to - segment.from;
            let turn = cross(ray, side);
            if turn.abs() < 1e-12 {
                return None;
            }
            let along = cross(segment.from - from, side) / turn;
            let across = cross(segment.from - from, ray) / turn;
            ((0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across)).then_some(along * most_m)
        };
        let passed = self.within(from.inf(&to), from.sup(&to)).map(|(_, number)| &self.all[number as usize]);
        passed.filter_map(met).min_by(f64::total_cmp)
    }
}

/// Cells with pieces in a rectangle, and the index of each piece.
struct Within<'a> {
    index: &'a SegmentIndex,
    /// Remaining entries of the row before `row`.
    entries: std::ops::Range<usize>,
    left: i32,
    right: i32,
    row: i32,
    top: i32,
}

impl Within<'_> {
    /// Advances to the next row; false if there is none.
    fn next_row(&mut self) -> bool {
        let Self { index, left, right, .. } = *self;
        if self.row > self.top {
            return false;
        }
        if let Some(table) = &index.table {
            self.entries = table.entries(self.row, left, right);
        } else {
            let cells = &index.cells;
            let from = cells.partition_point(|c| c.0 < key(left, self.row));
            // Rows without cells are skipped.
            match cells.get(from).map(|c| row_of(c.0)) {
                Some(row) if row <= self.top => self.row = row,
                _ => return false,
            }
            let from = from + cells[from..].partition_point(|c| c.0 < key(left, self.row));
            self.entries = from..from + cells[from..].partition_point(|c| c.0 <= key(right, self.row));
        }
        match self.row.checked_add(1) {
            Some(next) => self.row = next,
            None => self.top = i32::MIN,
        }
        true
    }
}

impl Iterator for Within<'_> {
    type Item = (u64, u32);

    fn next(&mut self) -> Option<(u64, u32)> {
        loop {
            if let Some(at) = self.entries.next() {
                return self.index.cells.get(at).copied();
            }
            if !self.next_row() {
                return None;
            }
        }
    }
}

fn cell(coordinate_m: f64) -> i32 {
    // The cast saturates, which is right for far coordinates.
    (coordinate_m / CELL_M).floor() as i32
}

/// Orders cells by row, then by column.
fn key(column: i32, row: i32) -> u64 {
    let biased = |i: i32| u64::from((i as u32) ^ 0x8000_0000);
    (biased(row) << 32) | biased(column)
}

/// Lower bound of the distance from a point to a cell, metres, with a margin for rounding.
fn least_m(cell: u64, point: Vec2) -> f64 {
    let beyond = |coordinate_m: f64, number: i32| {
        let low_m = f64::from(number) * CELL_M;
        (low_m - coordinate_m).max(coordinate_m - low_m - CELL_M).max(0.0)
    };
    beyond(point.x, column_of(cell)).hypot(beyond(point.y, row_of(cell))) - ROUNDING_M
}

fn row_of(key: u64) -> i32 {
    ((key >> 32) as u32 ^ 0x8000_0000) as i32
}

fn column_of(key: u64) -> i32 {
    (key as u32 ^ 0x8000_0000) as i32
}

/// Calls `found` with the cells around a piece, part by part.
pub(super) fn cells_along(segment: &Segment, mut found: impl FnMut(u64)) {
    let (a, b) = (segment.from, segment.to);
    let stretches = ((b - a).norm() / CELL_M).ceil().clamp(1.0, MOST_STRETCHES);
    let mut from = a;
    for i in 1..=stretches as usize {
        let to = a + (b - a) * (i as f64 / stretches);
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
    use proptest::prelude::*;

    #[test]
    fn straight_points_are_left_out() {
        let line: Vec<Vec2> = (0..=20).map(|i| Vec2::new(i as f64 * 0.5, 0.0)).collect();
        assert_eq!(thinned_pieces(&line, false, 3).len(), 1);
        assert_eq!(pieces(&line, 3).map(|s| s.piece).max(), Some(19));
        let ring = [Vec2::zeros(), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0)];
        assert_eq!(thinned_pieces(&ring, true, 0).len(), 3);
        assert!(thinned_pieces(&[], true, 0).is_empty() && thinned_pieces(&ring[..1], true, 0).is_empty());
    }

    fn piece(from: Vec2, to: Vec2) -> Segment {
        Segment { from, to, owner: 0, piece: 0 }
    }

    #[test]
    fn long_pieces_are_found_from_their_middle() {
        let far = piece(Vec2::new(0.0, -300.0), Vec2::new(0.0, -200.0));
        let index = SegmentIndex::new(vec![piece(Vec2::new(-500.0, 3.0), Vec2::new(500.0, 3.0)), far]);
        let found = index.nearest(Vec2::new(17.0, 0.0), 5.0).unwrap();
        assert_eq!((found.0.to.x, found.1), (500.0, Vec2::new(17.0, 3.0)));
        assert!(index.nearest(Vec2::new(17.0, -100.0), 50.0).is_none());
    }

    #[test]
    fn odd_questions_find_nothing() {
        let index = SegmentIndex::new(vec![piece(Vec2::zeros(), Vec2::new(1.0, 0.0))]);
        for (point, radius) in
            [(Vec2::new(f64::NAN, 0.0), 5.0), (Vec2::zeros(), -1.0), (Vec2::zeros(), f64::NAN)]
        {
            assert_eq!(index.near(point, radius).count(), 0);
        }
        assert_eq!(index.near(Vec2::zeros(), f64::INFINITY).count(), 1);
        assert!(SegmentIndex::default().nearest(Vec2::zeros(), 5.0).is_none());
        let most = crate::MAX_COORDINATE_M;
        let across = SegmentIndex::new(vec![piece(Vec2::repeat(-most), Vec2::repeat(most))]);
        assert!(across.cells.len() < 1_000_000, "bounded, however long a piece is: {}", across.cells.len());
    }

    #[test]
    fn a_ray_meets_the_nearest_piece() {
        let edge = |y: f64| piece(Vec2::new(-50.0, y), Vec2::new(50.0, y));
        let index = SegmentIndex::new(vec![edge(4.0), edge(6.0), edge(-30.0)]);
        let look = |x: f64, y: f64| index.ray_m(Vec2::new(x, 0.0), Vec2::new(0.0, y), 12.0);
        assert_eq!(look(17.3, 1.0), Some(4.0));
        assert_eq!((look(17.3, -1.0), look(60.0, 1.0)), (None, None));
    }

    #[test]
    fn a_crowd_far_away_costs_its_nearest_cells_alone() {
        // Pieces of 80 m across a square, 100 in each row of cells.
        let across = |i: usize| {
            let y = 80.0 * i as f64 / 1_000.0;
            piece(Vec2::new(0.0, y), Vec2::new(79.0, y))
        };
        let index = SegmentIndex::new((0..1_000).map(across).collect());
        for point in
            [Vec2::new(500.0, 40.0), Vec2::new(-500.0, 40.0), Vec2::new(40.0, 500.0), Vec2::new(40.0, -500.0)]
        {
            let (mut looked, mut least_m) = (0, f64::INFINITY);
            index.outwards(point, 1_000.0, |_, segment| {
                looked += 1;
                least_m = least_m.min((segment.foot(point) - point).norm());
                least_m
            });
            assert!(looked <= 1_100, "{looked} of {} looked at", index.cells.len());
            assert_eq!(index.nearest_by_search(point, 1_000.0).unwrap().2, least_m);
        }
    }

    proptest! {
        #[test]
        fn nearest_agrees_with_looking_at_all(
            ends in prop::collection::vec((-60.0..60.0, -60.0..60.0, -20.0..20.0, -20.0..20.0), 1..40),
            x in -90.0..90.0, y in -90.0..90.0,
        ) {
            let all: Vec<Segment> = ends.iter().map(|&(x, y, dx, dy)| {
                piece(Vec2::new(x, y), Vec2::new(x + dx, y + dy))
            }).collect();
            let p = Vec2::new(x, y);
            let least = all.iter().map(|s| (s.foot(p) - p).norm()).fold(f64::INFINITY, f64::min);
            let first = all.iter().position(|s| (s.foot(p) - p).norm() == least).unwrap();
            let grid = SegmentIndex::new(all.clone());
            for _ in 0..2 {
                let (found, _, distance) = grid.nearest(p, 400.0).unwrap();
                prop_assert_eq!((*found, distance), (all[first], least));
            }
            prop_assert!(least == 0.0 || grid.nearest(p, 0.99 * least).is_none());
        }
    }
}
