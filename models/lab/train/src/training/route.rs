//! Converts residuals to positions: along and across an anchor, then on its path.

use experts::planning::{ACROSS_SCALE, ALONG_SCALE, Basis, INSTANTS, RESIDUAL};
use scene::KNOTS;

use super::{AnchorPath, Record};

/// Progress and offset at the instants, metres.
pub(crate) type RouteCoordinates = [[f32; 2]; INSTANTS];

/// The basis, including the scales of normalised residuals.
#[derive(Clone, Debug)]
pub(super) struct ResidualBasis {
    along: [[f32; KNOTS]; INSTANTS],
    across: [[f32; KNOTS]; INSTANTS],
}

impl ResidualBasis {
    pub(super) fn new() -> Self {
        let basis = Basis::new();
        let scaled =
            |rows: [[f32; KNOTS]; INSTANTS], scale: f32| rows.map(|row| row.map(|value| scale * value));
        Self { along: scaled(basis.along, ALONG_SCALE), across: scaled(basis.across, ACROSS_SCALE) }
    }

    /// Metres that a residual adds along (0) or across (1) at the instants.
    pub(super) fn rows(&self, half: usize) -> &[[f32; KNOTS]; INSTANTS] {
        if half == 0 { &self.along } else { &self.across }
    }

    /// Coordinates of a mode's residual at the instants.
    pub(super) fn coordinates(
        &self,
        base_along: &[f32; INSTANTS],
        residual: &[f32; RESIDUAL],
    ) -> RouteCoordinates {
        std::array::from_fn(|i| {
            let sum =
                |row: &[f32; KNOTS], knots: &[f32]| row.iter().zip(knots).map(|(b, r)| b * r).sum::<f32>();
            [
                base_along[i] + sum(&self.along[i], &residual[..KNOTS]),
                sum(&self.across[i], &residual[KNOTS..]),
            ]
        })
    }
}

/// A draft as boxes, with the directions (cosine, sine) of the path at their positions.
pub(crate) struct DraftPoses {
    pub(crate) poses: scene::geometry::overlap_energy::Poses<INSTANTS>,
    pub(super) directions: [[f32; 2]; INSTANTS],
}

impl DraftPoses {
    /// Boxes of route coordinates on a mode's path.
    pub(crate) fn new(record: &Record, mode: usize, coordinates: &RouteCoordinates) -> Self {
        let mut placed = Self { poses: [[0.0; 4]; INSTANTS], directions: [[1.0, 0.0]; INSTANTS] };
        for (i, &[along, across]) in coordinates.iter().enumerate() {
            let (point, [c, s]) = at(&record.paths[mode], along);
            let ahead = record.centre_ahead;
            placed.poses[i] = [point[0] - across * s + ahead * c, point[1] + across * c + ahead * s, c, s];
            placed.directions[i] = [c, s];
        }
        placed
    }

    /// Boxes of a residual on a mode's path.
    pub(super) fn of(
        route: &ResidualBasis,
        record: &Record,
        mode: usize,
        residual: &[f32; RESIDUAL],
    ) -> Self {
        Self::new(record, mode, &route.coordinates(&record.target.base_along[mode], residual))
    }

    /// Converts a gradient in x and y to one in progress and offset.
    pub(super) fn along_across(&self, gradient: &[[f32; 2]; INSTANTS]) -> [[f32; 2]; INSTANTS] {
        std::array::from_fn(|i| {
            let ([x, y], [c, s]) = (gradient[i], self.directions[i]);
            [x * c + y * s, -x * s + y * c]
        })
    }
}

/// Point and direction at a progress; the path continues straight before the first and after the last point.
fn at(path: &AnchorPath, along: f32) -> ([f32; 2], [f32; 2]) {
    let last = path.points.len().saturating_sub(2);
    let place = along - path.start;
    let index = if place.is_finite() { (place.max(0.0) as usize).min(last) } else { 0 };
    let (a, b) = (path.points[index], path.points[index + 1]);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = (dx * dx + dy * dy).sqrt();
    let direction = if length > 1e-6 { [dx / length, dy / length] } else { [1.0, 0.0] };
    let rest = place - index as f32;
    ([a[0] + rest * direction[0], a[1] + rest * direction[1]], direction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_go_on_straight_at_both_ends() {
        let path = AnchorPath { start: -1.0, points: vec![[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]] };
        assert_eq!(at(&path, -3.0), ([-3.0, 0.0], [1.0, 0.0]));
        assert_eq!(at(&path, -0.25), ([-0.25, 0.0], [1.0, 0.0]));
        assert_eq!(at(&path, 0.5), ([0.0, 0.5], [0.0, 1.0]));
        assert_eq!(at(&path, 9.0), ([0.0, 9.0], [0.0, 1.0]));
    }
}
