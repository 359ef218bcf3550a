//! The part of a map where road users are placed.

use scene::geometry::Extent;
use scene::{LaneMap, Vec2};

/// The region in which placed centres may lie.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Region {
    /// The whole map.
    #[default]
    Everywhere,
    /// Inside an open ring of at least three corners, metres; even-odd rule where it crosses itself.
    Polygon(Vec<Vec2>),
    /// Inside a circle.
    Circle {
        /// Metres.
        center: Vec2,
        /// Metres.
        radius_m: f64,
    },
}

impl Region {
    /// Whether the point lies inside.
    pub fn contains(&self, p: Vec2) -> bool {
        match self {
            Self::Everywhere => true,
            Self::Circle { center, radius_m } => (p - center).norm() <= *radius_m,
            Self::Polygon(ring) => in_ring(ring, p),
        }
    }

    /// A cheap test by rectangle: false means that no point within `reach_m` of `p` is inside.
    pub(super) fn may_hold(&self, p: Vec2, reach_m: f64) -> bool {
        match self {
            Self::Everywhere => true,
            Self::Circle { center, radius_m } => (p - center).norm() <= radius_m + reach_m,
            Self::Polygon(ring) => Extent::of(ring.iter().copied()).outside_m(p) <= reach_m,
        }
    }
}

/// Whether the point lies in the ring, by the even-odd rule.
pub(super) fn in_ring(ring: &[Vec2], p: Vec2) -> bool {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = ends
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y));
    crossed.count() % 2 == 1
}

/// Area of a ring, m2; for a ring that crosses itself, by winding number.
pub fn ring_area_m2(ring: &[Vec2]) -> f64 {
    let ends = ring.iter().zip(ring.iter().cycle().skip(1));
    (0.5 * ends.map(|(a, b)| scene::geometry::cross(*a, *b)).sum::<f64>()).abs()
}

/// The upright rectangle around a map's lanes, edges and crosswalks; `None` for a map without any.
pub fn map_extent(map: &LaneMap) -> Option<Extent> {
    let lanes = map.lanes.iter().flat_map(|l| &l.points.xy);
    let edges = map.road_edges.iter().flat_map(|l| &l.points.xy);
    Extent::about(lanes.chain(edges).chain(map.crosswalks.iter().flat_map(|a| &a.polygon.xy)).copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_and_outside() {
        let ring: Vec<Vec2> = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (5.0, 4.0), (0.0, 10.0)]
            .map(|(x, y)| Vec2::new(x, y))
            .into();
        let region = Region::Polygon(ring.clone());
        assert!(region.contains(Vec2::new(2.0, 2.0)) && !region.contains(Vec2::new(5.0, 6.0)));
        assert!(region.may_hold(Vec2::new(12.0, 5.0), 2.5) && !region.may_hold(Vec2::new(12.0, 5.0), 1.5));
        assert_eq!(ring_area_m2(&ring), 70.0);
        let circle = Region::Circle { center: Vec2::new(1.0, 1.0), radius_m: 2.0 };
        assert!(circle.contains(Vec2::new(3.0, 1.0)) && !circle.contains(Vec2::new(3.01, 1.0)));
        assert!(circle.may_hold(Vec2::new(4.0, 1.0), 1.0) && !circle.may_hold(Vec2::new(4.1, 1.0), 1.0));
        assert!(!Region::Polygon(Vec::new()).may_hold(Vec2::zeros(), 1e9));
    }
}
