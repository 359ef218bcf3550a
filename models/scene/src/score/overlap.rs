//! Do two motions overlap? The quick answer that the choice of futures asks for thousands of pairs.

use crate::geometry::Vec2;
use crate::geometry::obb::{OrientedBox, overlaps};
use crate::{Size, State};

/// "Close" boxes come nearer than this, metres.
pub const CLOSE_M: f64 = 0.5;
/// Boxes between two bounding rectangles.
const CHUNK: usize = 8;

/// Upright rectangle.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Vec2,
    high: Vec2,
}

impl Bounds {
    const EMPTY: Self = Self {
        low: Vec2::new(f64::INFINITY, f64::INFINITY),
        high: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn of(boxes: &[Option<OrientedBox>]) -> Self {
        boxes.iter().flatten().fold(Self::EMPTY, |bounds, b| {
            let extents = b.upright_half_extents();
            Self {
                low: bounds.low.inf(&(b.center() - extents)),
                high: bounds.high.sup(&(b.center() + extents)),
            }
        })
    }

    fn near(&self, other: &Self, margin_m: f64) -> bool {
        self.low.x < other.high.x + margin_m
            && other.low.x < self.high.x + margin_m
            && self.low.y < other.high.y + margin_m
            && other.low.y < self.high.y + margin_m
    }
}

/// The boxes of one motion at common moments (every third step in the choice of futures), with
/// bounding rectangles of the whole and of every eight.
#[derive(Clone, Debug)]
pub struct SweptBoxes {
    boxes: Vec<Option<OrientedBox>>,
    whole: Bounds,
    chunks: Vec<Bounds>,
}

impl SweptBoxes {
    /// From one box a moment; `None` where the road user is not there.
    pub fn new(boxes: Vec<Option<OrientedBox>>) -> Self {
        let whole = Bounds::of(&boxes);
        let chunks = boxes.chunks(CHUNK).map(Bounds::of).collect();
        Self { boxes, whole, chunks }
    }

    /// From states at those moments.
    pub fn of_states<'a>(states: impl IntoIterator<Item = Option<&'a State>>, size: &Size) -> Self {
        Self::new(states.into_iter().map(|s| s.map(|s| OrientedBox::of_state(s, size))).collect())
    }

    /// Box at a moment.
    pub fn at(&self, moment: usize) -> Option<&OrientedBox> {
        self.boxes.get(moment)?.as_ref()
    }

    /// Moments.
    pub fn len(&self) -> usize {
        self.boxes.len()
    }

    /// No moments at all.
    pub fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }
}

/// How two motions meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Overlap {
    /// The boxes share area at some moment.
    pub overlaps: bool,
    /// The boxes come nearer than [`CLOSE_M`] at some moment; true whenever `overlaps` is.
    pub close: bool,
}

/// Overlap of two motions at their common moments. Motions with separate bounding rectangles cost four
/// comparisons; crossing ones about a microsecond.
///
/// ```
/// use scene::geometry::{Vec2, obb::OrientedBox};
/// use scene::score::{Overlap, SweptBoxes, overlap};
/// let row = |y: f64, speed: f64| {
///     let at = |i| Some(OrientedBox::new(Vec2::new(i as f64 * 0.3 * speed, y), 2.3, 1.0, 0.0));
///     SweptBoxes::new((0..31).map(at).collect())
/// };
/// let beside = overlap(&row(0.0, 10.0), &row(2.3, 10.0));
/// assert_eq!(beside, Overlap { overlaps: false, close: true });
/// ```
pub fn overlap(a: &SweptBoxes, b: &SweptBoxes) -> Overlap {
    let mut found = Overlap::default();
    if !a.whole.near(&b.whole, CLOSE_M) {
        return found;
    }
    for (chunk, (in_a, in_b)) in a.chunks.iter().zip(&b.chunks).enumerate() {
        if !in_a.near(in_b, CLOSE_M) {
            continue;
        }
        let moments = chunk * CHUNK..((chunk + 1) * CHUNK).min(a.len()).min(b.len());
        for (p, q) in a.boxes[moments.clone()].iter().zip(&b.boxes[moments]) {
            let (Some(p), Some(q)) = (p, q) else { continue };
            if overlaps(p, q, 0.0) {
                return Overlap { overlaps: true, close: true };
            }
            found.close = found.close || overlaps(p, q, CLOSE_M);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(from: (f64, f64), heading: f64, speed: f64) -> SweptBoxes {
        let forward = crate::geometry::direction(heading);
        let start = Vec2::new(from.0, from.1);
        let at = |i: usize| OrientedBox::new(start + forward * (speed * 0.3 * i as f64), 2.3, 1.0, heading);
        SweptBoxes::new((0..31).map(|i| Some(at(i))).collect())
    }

    #[test]
    fn known_meetings() {
        let east = straight((0.0, 0.0), 0.0, 10.0);
        let north_through = straight((45.0, -45.0), std::f64::consts::FRAC_PI_2, 10.0);
        let north_late = straight((45.0, -85.0), std::f64::consts::FRAC_PI_2, 10.0);
        let beside = straight((0.0, 2.4), 0.0, 10.0);
        let far = straight((0.0, 50.0), 0.0, 10.0);
        let meetings = [north_through, north_late, beside, far].map(|other| overlap(&east, &other));
        let pairs = meetings.map(|o| (o.overlaps, o.close));
        assert_eq!(pairs, [(true, true), (false, false), (false, true), (false, false)]);
    }

    #[test]
    fn absent_moments_do_not_meet() {
        let east = straight((0.0, 0.0), 0.0, 10.0);
        let gone = SweptBoxes::new(vec![None; 31]);
        assert_eq!(overlap(&east, &gone), Overlap::default());
        assert_eq!(overlap(&east, &SweptBoxes::new(Vec::new())), Overlap::default());
    }
}
