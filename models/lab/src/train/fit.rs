//! The recording as residuals: least squares within the goal's tangent space.

use experts::features::{AgentFeatures, INSTANTS, MODES, RESIDUAL, Target};
use scene::KNOTS;

use super::route::Route;

/// Ridge, square metres per square of a normalised knot: what noise in the recording costs.
const RIDGE: f64 = 0.05;

/// The recorded residual on each mode's anchor.
pub(super) fn recorded(route: &Route, agent: &AgentFeatures, target: &Target) -> [[f32; RESIDUAL]; MODES] {
    let mut residual = [[0.0; RESIDUAL]; MODES];
    for half in 0..2 {
        let (factor, design) = factorised(route.rows(half), &agent.tangent[half], &target.valid);
        for (mode, residual) in residual.iter_mut().enumerate() {
            let wanted: [f64; INSTANTS] = std::array::from_fn(|i| {
                f64::from(match half {
                    0 => target.along[mode][i] - target.base_along[mode][i],
                    _ => target.across[mode][i],
                })
            });
            let free = solve(&factor, &project_back(&design, &wanted, &target.valid));
            for i in 0..KNOTS {
                let knot: f64 = (0..KNOTS).map(|j| f64::from(agent.tangent[half][i][j]) * free[j]).sum();
                residual[half * KNOTS + i] = knot as f32;
            }
        }
    }
    residual
}

type Matrix = [[f64; KNOTS]; KNOTS];
type Design = [[f64; KNOTS]; INSTANTS];

/// Cholesky factor of `A' A + ridge` over the valid instants, and `A = B P`.
fn factorised(
    rows: &[[f32; KNOTS]; INSTANTS],
    tangent: &[[f32; KNOTS]; KNOTS],
    valid: &[f32; INSTANTS],
) -> (Matrix, Design) {
    let mut design = [[0.0; KNOTS]; INSTANTS];
    for (row, out) in rows.iter().zip(&mut design) {
        for (k, row) in row.iter().enumerate() {
            for j in 0..KNOTS {
                out[j] += f64::from(*row) * f64::from(tangent[k][j]);
            }
        }
    }
    let mut normal = [[0.0; KNOTS]; KNOTS];
    for (row, valid) in design.iter().zip(valid) {
        for i in 0..KNOTS {
            for j in 0..KNOTS {
                normal[i][j] += f64::from(*valid) * row[i] * row[j];
            }
        }
    }
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += RIDGE;
    }
    (cholesky(&normal), design)
}

fn project_back(design: &Design, wanted: &[f64; INSTANTS], valid: &[f32; INSTANTS]) -> [f64; KNOTS] {
    let mut right = [0.0; KNOTS];
    for ((row, wanted), valid) in design.iter().zip(wanted).zip(valid) {
        for i in 0..KNOTS {
            right[i] += f64::from(*valid) * row[i] * wanted;
        }
    }
    right
}

fn cholesky(a: &Matrix) -> Matrix {
    let mut lower = [[0.0; KNOTS]; KNOTS];
    for i in 0..KNOTS {
        for j in 0..=i {
            let rest: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            lower[i][j] =
                if i == j { (a[i][i] - rest).max(1e-12).sqrt() } else { (a[i][j] - rest) / lower[j][j] };
        }
    }
    lower
}

fn solve(lower: &Matrix, right: &[f64; KNOTS]) -> [f64; KNOTS] {
    let mut x = *right;
    for i in 0..KNOTS {
        let rest: f64 = (0..i).map(|j| lower[i][j] * x[j]).sum();
        x[i] = (x[i] - rest) / lower[i][i];
    }
    for i in (0..KNOTS).rev() {
        let rest: f64 = (i + 1..KNOTS).map(|j| lower[j][i] * x[j]).sum();
        x[i] = (x[i] - rest) / lower[i][i];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::toy;

    #[test]
    fn a_recording_is_followed() {
        let route = Route::new();
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
    fn a_fixed_goal_is_kept() {
        let mut record = toy::scenes(1, 1, 3).remove(0).2.remove(0);
        record.agent.tangent[0][9] = [0.0; KNOTS];
        let residual = recorded(&Route::new(), &record.agent, &record.target);
        assert!(residual.iter().all(|r| r[9] == 0.0 && r[8] != 0.0));
    }
}
