//! Fits residuals to the recording: least squares within the goal's tangent space.

use experts::features::{AgentFeatures, GroundTruth};

use experts::planning::{INSTANTS, MODES, RESIDUAL};
use nalgebra::{Cholesky, Const, SMatrix, SVector};
use scene::KNOTS;

use super::Record;
use super::route::ResidualBasis;

/// Ridge, square metres per square of a normalised knot, against noise in the recording.
const RIDGE: f64 = 0.05;

/// The recorded residual on each mode's anchor.
pub(super) fn recorded(
    route: &ResidualBasis,
    agent: &AgentFeatures,
    target: &GroundTruth,
) -> [[f32; RESIDUAL]; MODES] {
    let mut residual = [[0.0; RESIDUAL]; MODES];
    for half in 0..2 {
        // The ridge keeps it definite; a recording with NaN leaves the residual at zero.
        let found = factorised(route.rows(half), &agent.tangent[half], &target.valid);
        let Some((factor, design)) = found else { continue };
        for (mode, residual) in residual.iter_mut().enumerate() {
            let wanted = SVector::<f64, INSTANTS>::from_fn(|i, _| {
                f64::from(match half {
                    0 => target.along[mode][i] - target.base_along[mode][i],
                    _ => target.across[mode][i],
                })
            });
            let free = factor.solve(&design.tr_mul(&wanted));
            for i in 0..KNOTS {
                let knot: f64 = (0..KNOTS).map(|j| f64::from(agent.tangent[half][i][j]) * free[j]).sum();
                residual[half * KNOTS + i] = knot as f32;
            }
        }
    }
    residual
}

/// Distance of recordings from their best residual: the error that training cannot remove.
pub struct FitError(ResidualBasis);

impl FitError {
    /// Prepares the measurement.
    pub fn new() -> Self {
        Self(ResidualBasis::new())
    }

    /// Mean distance over the recorded instants, metres, between a recording and its own residual (the
    /// training target) on the anchor with the least distance. `None` if no instant is recorded.
    pub fn of(&self, record: &Record) -> Option<f64> {
        let target = &record.target;
        let valid: Vec<usize> = (0..INSTANTS).filter(|i| target.valid[*i] > 0.0).collect();
        if valid.is_empty() {
            return None;
        }
        let residual = recorded(&self.0, &record.agent, target);
        let apart = |mode: usize| {
            let found = self.0.coordinates(&target.base_along[mode], &residual[mode]);
            let distance = |&i: &usize| {
                let along = f64::from(found[i][0]) - f64::from(target.along[mode][i]);
                let across = f64::from(found[i][1]) - f64::from(target.across[mode][i]);
                along.hypot(across)
            };
            valid.iter().map(distance).sum::<f64>() / valid.len() as f64
        };
        (0..MODES).map(apart).min_by(f64::total_cmp)
    }
}

impl Default for FitError {
    fn default() -> Self {
        Self::new()
    }
}

type Design = SMatrix<f64, INSTANTS, KNOTS>;
type Factor = Cholesky<f64, Const<KNOTS>>;

/// Rows of unrecorded instants are zero: `A = B P` of the others, and the factor of `A' A + ridge`.
fn factorised(
    rows: &[[f32; KNOTS]; INSTANTS],
    tangent: &[[f32; KNOTS]; KNOTS],
    valid: &[f32; INSTANTS],
) -> Option<(Factor, Design)> {
    let basis = Design::from_fn(|i, k| f64::from(valid[i] * rows[i][k]));
    let tangent = SMatrix::<f64, KNOTS, KNOTS>::from_fn(|i, j| f64::from(tangent[i][j]));
    let design = basis * tangent;
    let normal = design.tr_mul(&design) + SMatrix::identity() * RIDGE;
    Some((normal.cholesky()?, design))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::toy;

    #[test]
    fn a_recording_is_followed() {
        let route = ResidualBasis::new();
        for record in &toy::scenes(1, 20, 3)[0].2 {
            let residual = recorded(&route, &record.agent, &record.target);
            for mode in 0..MODES {
                let found = route.coordinates(&record.target.base_along[mode], &residual[mode]);
                for i in (0..INSTANTS).filter(|&i| record.target.valid[i] > 0.0) {
                    assert!((found[i][0] - record.target.along[mode][i]).abs() < 0.3);
                    assert!((found[i][1] - record.target.across[mode][i]).abs() < 0.2);
                }
            }
        }
    }

    #[test]
    fn errors_are_those_of_the_best_anchor() {
        let fit = FitError::new();
        let mut record = toy::scenes(1, 1, 3).remove(0).2.remove(0);
        let good = fit.of(&record).unwrap();
        assert!(good < 0.2, "{good}");
        // One knot per second cannot represent an oscillation of a metre each half second. All other anchors
        // have it, so the unchanged one counts.
        let zigzag = |record: &mut Record, mode: usize| {
            for (i, across) in record.target.across[mode].iter_mut().enumerate() {
                *across += if i % 2 == 0 { 1.0 } else { -1.0 };
            }
        };
        (1..MODES).for_each(|mode| zigzag(&mut record, mode));
        assert!((fit.of(&record).unwrap() - good).abs() < 0.1);
        zigzag(&mut record, 0);
        let bad = fit.of(&record).unwrap();
        assert!((0.5..1.5).contains(&bad), "{bad}");
        record.target.valid = [0.0; INSTANTS];
        assert_eq!(fit.of(&record), None);
    }

    #[test]
    fn a_fixed_goal_is_kept() {
        let mut record = toy::scenes(1, 1, 3).remove(0).2.remove(0);
        record.agent.tangent[0][9] = [0.0; KNOTS];
        let residual = recorded(&ResidualBasis::new(), &record.agent, &record.target);
        assert!(residual.iter().all(|r| r[9] == 0.0 && r[8] != 0.0));
    }
}
