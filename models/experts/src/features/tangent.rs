//! Projections that keep a fixed goal when knots change.

use crate::planning::{hat, integrated_hat, twice_integrated_hat};
use nalgebra::DMatrix;
use scene::motion::Target;
use scene::{KNOT_S, KNOTS, STEP_S};

/// Projections of the residual knots onto the subspace that does not change the fixed goal fields. The base
/// already meets the goal. Along the path, these are position and speed at the goal's step; across it, offset
/// and, if the heading is fixed, drift.
pub(super) fn tangent(target: &Target) -> [[[f32; KNOTS]; KNOTS]; 2] {
    let t = target.step as f64 * STEP_S;
    let row = |f: fn(usize, f64) -> f64| (0..KNOTS).map(|k| f(k, t)).collect::<Vec<_>>();
    let mut along = Vec::new();
    if target.position.is_some() {
        along.push(row(twice_integrated_hat));
    }
    if target.speed_mps.is_some() {
        along.push(row(integrated_hat));
    }
    // The first offset is zero by definition.
    let mut across = vec![(0..KNOTS).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect::<Vec<_>>()];
    if target.position.is_some() {
        across.push(row(hat));
    }
    if target.position.is_some() && target.heading_rad.is_some() {
        let last = (t / KNOT_S - 1e-9).floor() as usize;
        let drift = (0..KNOTS).map(|k| match k {
            k if k == last => -1.0,
            k if k == last + 1 => 1.0,
            _ => 0.0,
        });
        across.push(drift.collect());
    }
    [null_space_projection(&along), null_space_projection(&across)]
}

/// `I - A' (A A')^-1 A` of the rows of A.
fn null_space_projection(rows: &[Vec<f64>]) -> [[f32; KNOTS]; KNOTS] {
    let mut projection = DMatrix::<f64>::identity(KNOTS, KNOTS);
    if !rows.is_empty() {
        let a = DMatrix::from_fn(rows.len(), KNOTS, |i, j| rows[i][j]);
        let gram = &a * a.transpose() + DMatrix::identity(rows.len(), rows.len()) * 1e-9;
        if let Some(gram) = gram.cholesky() {
            projection -= a.transpose() * gram.solve(&a);
        }
    }
    let mut out = [[0.0; KNOTS]; KNOTS];
    for i in 0..KNOTS {
        for j in 0..KNOTS {
            out[i][j] = projection[(i, j)] as f32;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;

    fn apply(projection: &[[f32; KNOTS]; KNOTS], knots: &[f32; KNOTS]) -> [f64; KNOTS] {
        projection.map(|row| row.iter().zip(knots).map(|(p, k)| f64::from(p * k)).sum())
    }

    #[test]
    fn projected_knots_leave_the_goal_alone() {
        let knots: [f32; KNOTS] = std::array::from_fn(|k| (k as f32 * 1.7).sin());
        let sum = |knots: &[f64; KNOTS], basis: fn(usize, f64) -> f64, t: f64| {
            (0..KNOTS).map(|k| knots[k] * basis(k, t)).sum::<f64>()
        };
        for step in [17, 40, 90] {
            let position = Some(Vec2::new(30.0, 2.0));
            let target = Target { step, position, heading_rad: Some(0.1), speed_mps: Some(5.0) };
            let [along, across] = tangent(&target);
            let t = step as f64 * STEP_S;
            let (along, across) = (apply(&along, &knots), apply(&across, &knots));
            assert!(sum(&along, twice_integrated_hat, t).abs() < 1e-4, "position at {t} s");
            assert!(sum(&along, integrated_hat, t).abs() < 1e-4, "speed at {t} s");
            assert!(sum(&across, hat, t).abs() < 1e-4, "offset at {t} s");
            let drift = sum(&across, hat, t) - sum(&across, hat, t - 0.1);
            assert!(drift.abs() < 1e-4 && across[0].abs() < 1e-6, "drift {drift} at {t} s");
            assert!(along.iter().map(|k| k.abs()).sum::<f64>() > 1.0, "something is left to change");
        }
    }

    #[test]
    fn without_a_goal_only_the_first_offset_is_held() {
        let target = Target { step: 90, position: None, heading_rad: None, speed_mps: None };
        let [along, across] = tangent(&target);
        for i in 0..KNOTS {
            for j in 0..KNOTS {
                let one = f32::from(u8::from(i == j));
                assert!((along[i][j] - one).abs() < 1e-6);
                assert!((across[i][j] - if i == 0 || j == 0 { 0.0 } else { one }).abs() < 1e-6);
            }
        }
    }
}
