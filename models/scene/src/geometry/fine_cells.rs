//! A short list of numbers for each fine cell of a rectangle of cells. A list is computed at the first query
//! in its cell and kept for later ones.

use super::Vec2;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Fine cells along a side of a cell.
const FINE: usize = 4;
/// Limit of cells with stored fine cells: 360 m by 360 m in cells of 8 m.
const MOST_KEPT: usize = 2_048;
/// Numbers per list that the estimate of bytes assumes, close to the usual length.
const USUAL: usize = 12;

type Lists = [OnceLock<Box<[u32]>>; FINE * FINE];

/// A square, given by its centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square {
    pub(super) centre: Vec2,
    pub(super) side_m: f64,
}

/// The lists of a rectangle of cells; any number of threads may read and fill them.
#[derive(Debug)]
pub(super) struct FineCells {
    cell_m: f64,
    /// Column and row of the first cell.
    first: [i32; 2],
    columns: usize,
    rows: usize,
    cells: Box<[OnceLock<Box<Lists>>]>,
    /// Number of cells that may still be filled.
    left: AtomicUsize,
}

impl FineCells {
    /// An empty table of `columns` by `rows` cells with this side length, from a column and row on.
    pub(super) fn new(cell_m: f64, first: [i32; 2], columns: usize, rows: usize) -> Self {
        let cells = (0..columns * rows).map(|_| OnceLock::new()).collect();
        Self { cell_m, first, columns, rows, cells, left: AtomicUsize::new(MOST_KEPT) }
    }

    /// The list of the fine cell that contains a point; `make` computes it on first use. `None` outside the
    /// rectangle, and once too many cells are filled.
    pub(super) fn list(&self, point: Vec2, make: impl FnOnce(Square) -> Box<[u32]>) -> Option<&[u32]> {
        let at = point / self.cell_m;
        let (column, row) = (at.x.floor(), at.y.floor());
        let inside =
            |place: f64, count: usize| (place >= 0.0 && place < count as f64).then_some(place as usize);
        let i = inside(column - f64::from(self.first[0]), self.columns)?;
        let j = inside(row - f64::from(self.first[1]), self.rows)?;
        let lists = self.filled(&self.cells[j * self.columns + i])?;
        let fine = |part: f64| ((part * FINE as f64) as usize).min(FINE - 1);
        let (i, j) = (fine(at.x - column), fine(at.y - row));
        let list = lists[j * FINE + i].get_or_init(|| {
            let side_m = self.cell_m / FINE as f64;
            let within = Vec2::new(i as f64 + 0.5, j as f64 + 0.5) * side_m;
            make(Square { centre: Vec2::new(column, row) * self.cell_m + within, side_m })
        });
        Some(list)
    }

    fn filled<'a>(&self, cell: &'a OnceLock<Box<Lists>>) -> Option<&'a Lists> {
        if let Some(lists) = cell.get() {
            return Some(lists);
        }
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).ok()?;
        Some(cell.get_or_init(|| Box::new(std::array::from_fn(|_| OnceLock::new()))))
    }

    /// Approximate bytes of memory of the lists.
    pub(super) fn bytes(&self) -> usize {
        let kept = MOST_KEPT - self.left.load(Ordering::Relaxed);
        let list = size_of::<OnceLock<Box<[u32]>>>() + USUAL * size_of::<u32>();
        self.cells.len() * size_of::<OnceLock<Box<Lists>>>() + kept * FINE * FINE * list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_made_once_for_all_points_of_its_fine_cell() {
        let cells = FineCells::new(8.0, [-1, 2], 2, 1);
        let made = std::cell::Cell::new(0);
        let ask = |x: f64, y: f64| {
            let list = cells.list(Vec2::new(x, y), |square| {
                made.set(made.get() + 1);
                assert_eq!(square.side_m, 2.0);
                Box::new([(square.centre.x + 100.0) as u32, square.centre.y as u32])
            });
            list.map(<[u32]>::to_vec)
        };
        assert_eq!(ask(-7.9, 16.1), Some(vec![93, 17]));
        assert_eq!(ask(-6.1, 17.9), Some(vec![93, 17]));
        assert_eq!(made.get(), 1);
        assert_eq!(ask(7.9, 23.9), Some(vec![107, 23]));
        let outside =
            [(-8.1, 17.0), (8.0, 17.0), (0.0, 15.9), (0.0, 24.0), (f64::NAN, 17.0), (0.0, f64::NAN)];
        assert!(outside.iter().all(|(x, y)| ask(*x, *y).is_none()));
        assert_eq!(made.get(), 2);
    }

    #[test]
    fn memory_is_bounded() {
        let cells = FineCells::new(8.0, [0, 0], 3_000, 1);
        let kept = (0..3_000).filter(|i| {
            let point = Vec2::new(8.0 * f64::from(*i) + 1.0, 1.0);
            cells.list(point, |_| Box::default()).is_some()
        });
        assert_eq!(kept.count(), MOST_KEPT);
        assert!(cells.list(Vec2::new(3.0, 1.0), |_| Box::default()).is_some(), "what is there stays");
        assert!(cells.bytes() < 4 << 20);
    }
}
