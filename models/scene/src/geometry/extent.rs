//! Upright rectangles around points.

use super::Vec2;

/// Upright rectangle, metres. The empty rectangle ([`Extent::NONE`]) is far from everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Smallest coordinates.
    pub low: Vec2,
    /// Largest coordinates.
    pub high: Vec2,
}

impl Extent {
    /// The empty rectangle.
    pub const NONE: Self = Self {
        low: Vec2::new(f64::INFINITY, f64::INFINITY),
        high: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest rectangle around these points; empty if there are none.
    pub fn of(places: impl IntoIterator<Item = Vec2>) -> Self {
        places.into_iter().fold(Self::NONE, Self::with)
    }

    /// The smallest rectangle around these points; `None` if there are none.
    pub fn about(places: impl IntoIterator<Item = Vec2>) -> Option<Self> {
        let extent = Self::of(places);
        (extent.low.x <= extent.high.x).then_some(extent)
    }

    /// The smallest rectangle around this one and a point.
    #[must_use]
    pub fn with(self, place: Vec2) -> Self {
        Self { low: self.low.inf(&place), high: self.high.sup(&place) }
    }

    /// The smallest rectangle around this one and another.
    #[must_use]
    pub fn joined(self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The rectangle extended by `by_m` on each side, metres.
    #[must_use]
    pub fn grown(self, by_m: f64) -> Self {
        let by = Vec2::repeat(by_m);
        Self { low: self.low - by, high: self.high + by }
    }

    /// Its centre.
    pub fn middle(&self) -> Vec2 {
        0.5 * (self.low + self.high)
    }

    /// Width and height.
    pub fn size(&self) -> Vec2 {
        self.high - self.low
    }

    /// The larger of the two distances by which a point is outside along x and along y, metres; at most zero
    /// for a point inside.
    pub fn outside_m(&self, place: Vec2) -> f64 {
        let beyond = (self.low - place).sup(&(place - self.high));
        beyond.x.max(beyond.y)
    }

    /// Whether two rectangles are closer than a margin along both axes.
    pub fn is_near(&self, other: &Self, margin_m: f64) -> bool {
        self.low.x < other.high.x + margin_m
            && other.low.x < self.high.x + margin_m
            && self.low.y < other.high.y + margin_m
            && other.low.y < self.high.y + margin_m
    }

    /// Whether two rectangles share a point.
    pub fn touches(&self, other: &Self) -> bool {
        self.low.x <= other.high.x
            && other.low.x <= self.high.x
            && self.low.y <= other.high.y
            && other.low.y <= self.high.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extent(places: &[(f64, f64)]) -> Extent {
        Extent::of(places.iter().map(|(x, y)| Vec2::new(*x, *y)))
    }

    #[test]
    fn it_holds_its_places_and_no_more() {
        let about = extent(&[(1.0, 5.0), (4.0, 2.0)]);
        assert_eq!((about.low, about.high), (Vec2::new(1.0, 2.0), Vec2::new(4.0, 5.0)));
        assert_eq!((about.middle(), about.size()), (Vec2::new(2.5, 3.5), Vec2::new(3.0, 3.0)));
        assert_eq!(about.outside_m(Vec2::new(4.0, 2.0)), 0.0);
        assert_eq!(about.outside_m(Vec2::new(6.0, 1.0)), 2.0);
        assert_eq!(about.grown(2.0).outside_m(Vec2::new(6.0, 1.0)), 0.0);
    }

    #[test]
    fn without_places_it_is_away_from_everything() {
        assert_eq!(Extent::about([]), None);
        assert_eq!(Extent::NONE.outside_m(Vec2::zeros()), f64::INFINITY);
        let some = extent(&[(0.0, 0.0)]);
        assert!(!Extent::NONE.is_near(&some, 1e9) && !some.touches(&Extent::NONE));
        assert_eq!(Extent::NONE.joined(&some), some);
    }

    #[test]
    fn near_is_below_the_margin_and_touching_begins_at_zero() {
        let (a, b) = (extent(&[(0.0, 0.0), (1.0, 1.0)]), extent(&[(3.0, 0.5)]));
        assert!(!a.is_near(&b, 2.0) && a.is_near(&b, 2.1) && b.is_near(&a, 2.1));
        assert!(!a.touches(&b) && a.touches(&extent(&[(1.0, 1.0)])));
    }
}
