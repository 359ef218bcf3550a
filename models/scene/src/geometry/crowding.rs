//! Density of lines, which determines the cost of work with a grid over them.
//!
//! A query about a place looks at the pieces in the cells around it. Where a thousand lines overlap, each
//! query costs as much as a whole map elsewhere.

use super::Vec2;
use super::segments::{Segment, cells_along};
use crate::message::Message;
use crate::sentences::{self, what};

/// Limit of cells that pieces pass through, counted once per piece: ten times the number of a large map.
pub const MAX_CELLS: usize = 2_000_000;
/// Limit of pieces in one cell of 8 m x 8 m.
pub const MAX_CELL_PIECES: u64 = 8_192;
/// Limit of pairs of pieces that pass through the same cell, over all cells.
pub const MAX_CELL_PAIRS: u64 = 100_000_000;

/// Pieces of lines by the cells that they pass through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Crowding {
    /// Number of cells, counted once per piece in them; more than [`MAX_CELLS`] if counting stopped early.
    pub entries: usize,
    /// Largest number of pieces in one cell.
    pub most: u64,
    /// Sum over all cells of the squared number of pieces.
    pub pairs: u64,
}

impl Crowding {
    /// Counts lines, each with whether it is closed.
    pub fn of<'a>(lines: impl Iterator<Item = (&'a [Vec2], bool)>) -> Self {
        let mut cells: Vec<u64> = Vec::new();
        let mut own: Vec<u64> = Vec::new();
        for (points, closed) in lines {
            let back = closed.then(|| Some((*points.last()?, *points.first()?))).flatten();
            for (from, to) in points.iter().copied().zip(points.iter().copied().skip(1)).chain(back) {
                own.clear();
                cells_along(&Segment { from, to, owner: 0, piece: 0 }, |cell| own.push(cell));
                own.sort_unstable();
                own.dedup();
                cells.extend(&own);
                if cells.len() > MAX_CELLS {
                    return Self { entries: cells.len(), most: 0, pairs: 0 };
                }
            }
        }
        cells.sort_unstable();
        let counts = cells.chunk_by(|a, b| a == b).map(|cell| cell.len() as u64);
        let start = Self { entries: cells.len(), ..Self::default() };
        counts.fold(start, |sum, count| Self {
            most: sum.most.max(count),
            pairs: sum.pairs + count * count,
            ..sum
        })
    }

    /// The exceeded limit as a message; `None` if all limits hold.
    pub fn excess(&self) -> Option<Message> {
        if self.entries > MAX_CELLS {
            return Some(sentences::more_than(MAX_CELLS, what::SQUARES));
        }
        if self.most > MAX_CELL_PIECES {
            return Some(sentences::at_most(self.most, what::PIECES, MAX_CELL_PIECES));
        }
        (self.pairs > MAX_CELL_PAIRS).then(|| sentences::at_most(self.pairs, what::PAIRS, MAX_CELL_PAIRS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Key;

    fn tangle(points: usize, side_m: f64) -> Vec<Vec2> {
        let mut random = Key::default().text("tangle").stream();
        let mut at = || side_m * (random.unit() - 0.5);
        (0..points).map(|_| Vec2::new(at(), at())).collect()
    }

    #[test]
    fn pieces_are_counted_once_a_cell() {
        let line = [Vec2::new(1.0, 1.0), Vec2::new(7.0, 1.0), Vec2::new(15.0, 1.0), Vec2::new(1.0, 2.0)];
        let open = Crowding::of([(&line[..], false)].into_iter());
        assert_eq!((open.entries, open.most, open.pairs), (5, 3, 9 + 4));
        let closed = Crowding::of([(&line[..], true)].into_iter());
        assert_eq!((closed.entries, closed.most, closed.pairs), (6, 4, 16 + 4));
        assert_eq!(Crowding::of([(&line[..1], true), (&[][..], true)].into_iter()).most, 1);
    }

    #[test]
    fn what_a_street_has_passes_and_tangles_do_not() {
        let street: Vec<Vec2> = (0..4_000).map(|i| Vec2::new(f64::from(i) * 0.5, 0.0)).collect();
        let streets = (0..30).map(|_| (&street[..], false));
        assert_eq!(Crowding::of(streets).excess(), None, "thirty lanes over each other");
        let one_place = tangle(30_000, 8.0);
        assert!(
            Crowding::of([(&one_place[..], false)].into_iter())
                .excess()
                .unwrap()
                .english
                .contains("8 m x 8 m")
        );
        let tangled: Vec<Vec<Vec2>> = (0..5).map(|_| tangle(4_096, 400.0)).collect();
        let of_all = Crowding::of(tangled.iter().map(|line| (&line[..], false)));
        assert!(
            of_all.most <= MAX_CELL_PIECES && of_all.excess().unwrap().english.contains("pairs"),
            "{of_all:?}"
        );
        let far: Vec<Vec<Vec2>> = (0..100).map(|_| tangle(4_096, 20_000.0)).collect();
        let of_all = Crowding::of(far.iter().map(|line| (&line[..], false)));
        // Counting stops soon after the limit.
        assert!(of_all.entries < MAX_CELLS + 20_000 && of_all.excess().is_some(), "{of_all:?}");
    }
}
