//! Correlation between the knots of a future: what a network says, and all noise, passes through it,
//! so that neighbouring knots move together.

use candle_core::{Device, Result, Tensor};

use crate::features::RESIDUAL;
use scene::{KNOT_S, KNOTS};

/// Length of the squared-exponential correlation, seconds.
const LENGTH: f64 = 1.5;

/// Lower Cholesky factor of the knots' correlation, `[KNOTS][KNOTS]`; its rows have length 1.
pub fn factor() -> [[f64; KNOTS]; KNOTS] {
    let correlation = |i: usize, j: usize| {
        let gap = (i as f64 - j as f64) * KNOT_S / LENGTH;
        let nugget = if i == j { 1e-4 } else { 0.0 };
        ((-0.5 * gap * gap).exp() + nugget) / (1.0 + 1e-4)
    };
    let mut lower = [[0.0; KNOTS]; KNOTS];
    for i in 0..KNOTS {
        for j in 0..=i {
            let rest: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let value = correlation(i, j) - rest;
            lower[i][j] = if i == j { value.max(0.0).sqrt() } else { value / lower[j][j] };
        }
    }
    lower
}

/// The factor for both halves of a residual as a right-hand matrix [RESIDUAL, RESIDUAL]: `z M`.
///
/// # Errors
/// When the tensor cannot be made.
pub fn matrix(device: &Device) -> Result<Tensor> {
    let lower = factor();
    let mut values = vec![0f32; RESIDUAL * RESIDUAL];
    for half in 0..2 {
        for i in 0..KNOTS {
            for j in 0..KNOTS {
                values[(half * KNOTS + j) * RESIDUAL + half * KNOTS + i] = lower[i][j] as f32;
            }
        }
    }
    Tensor::from_vec(values, (RESIDUAL, RESIDUAL), device)
}
