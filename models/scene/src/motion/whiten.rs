//! The metric of knot changes: changes of neighbouring knots are correlated, and curvature counts more at
//! higher speed. Of the correlation lengths tried, 4 s for acceleration and 1.5 s for curvature gave the
//! motions nearest to recorded ones.

use super::{CONTROLS, MotionKind, MotionModel};
use crate::{KNOT_S, KNOTS};
use nalgebra::SMatrix;
use std::sync::LazyLock;

type Square = SMatrix<f64, KNOTS, KNOTS>;

/// Lower Cholesky factor of the squared-exponential covariance between knots, `[KNOTS, KNOTS]`: variance one,
/// plus a nugget of 1e-4 that keeps it positive definite.
pub fn knot_covariance_factor(correlation_s: f64) -> Square {
    let covariance = Square::from_fn(|i, j| {
        let d = (i as f64 - j as f64) * KNOT_S / correlation_s;
        (-0.5 * d * d).exp() + if i == j { 1e-4 } else { 0.0 }
    });
    covariance.cholesky().map_or_else(Square::identity, |c| c.l())
}

static ACCELERATION: LazyLock<Square> = LazyLock::new(|| knot_covariance_factor(4.0));
static CURVATURE: LazyLock<Square> = LazyLock::new(|| knot_covariance_factor(1.5));
/// Walking: the first knot is the fixed start velocity, so the others are conditioned on it.
static VELOCITY: LazyLock<Square> = LazyLock::new(|| {
    let correlation = |i: usize, j: usize| {
        let d = (i as f64 - j as f64) * KNOT_S;
        (-0.5 * d * d).exp() + if i == j { 1e-3 } else { 0.0 }
    };
    let rest = SMatrix::<f64, { KNOTS - 1 }, { KNOTS - 1 }>::from_fn(|i, j| {
        correlation(i + 1, j + 1) - correlation(i + 1, 0) * correlation(0, j + 1) / correlation(0, 0)
    });
    let mut out = Square::zeros();
    if let Some(cholesky) = rest.cholesky() {
        out.fixed_view_mut::<{ KNOTS - 1 }, { KNOTS - 1 }>(1, 1).copy_from(&cholesky.l());
    }
    out
});

/// Maps a whitened change to a change of the knots: `du = S z`, block diagonal over the channels.
pub(crate) struct Whitening {
    first: Square,
    second: Square,
}

impl Whitening {
    /// For a model that travels at about `speed_mps`.
    pub(crate) fn new(model: &MotionModel, speed_mps: f64) -> Self {
        match model.kind {
            MotionKind::Drive => {
                let slow = if model.limits.curvature_per_m > 0.5 { 0.15 } else { 0.08 };
                let curvature_sd = (1.2 / (speed_mps * speed_mps + 0.5)).min(slow);
                Self { first: *ACCELERATION, second: *CURVATURE * curvature_sd }
            }
            MotionKind::Walk => Self { first: *VELOCITY * 0.5, second: *VELOCITY * 0.5 },
        }
    }

    /// `J S` of a Jacobian by knots.
    pub(crate) fn whitened<const ROWS: usize>(
        &self,
        jacobian: &SMatrix<f64, ROWS, CONTROLS>,
    ) -> SMatrix<f64, ROWS, CONTROLS> {
        let mut out = SMatrix::<f64, ROWS, CONTROLS>::zeros();
        let first = jacobian.fixed_columns::<KNOTS>(0) * self.first;
        let second = jacobian.fixed_columns::<KNOTS>(KNOTS) * self.second;
        out.fixed_columns_mut::<KNOTS>(0).copy_from(&first);
        out.fixed_columns_mut::<KNOTS>(KNOTS).copy_from(&second);
        out
    }

    /// `S z`.
    pub(crate) fn colour(&self, z: &SMatrix<f64, CONTROLS, 1>) -> SMatrix<f64, CONTROLS, 1> {
        let mut out = SMatrix::<f64, CONTROLS, 1>::zeros();
        let first = self.first * z.fixed_rows::<KNOTS>(0);
        let second = self.second * z.fixed_rows::<KNOTS>(KNOTS);
        out.fixed_rows_mut::<KNOTS>(0).copy_from(&first);
        out.fixed_rows_mut::<KNOTS>(KNOTS).copy_from(&second);
        out
    }
}
