//! The correlation between knots as a tensor.

use crate::planning::{RESIDUAL, smooth};
use candle_core::{Device, Result, Tensor};
use scene::KNOTS;

/// The factor for both halves of a residual as a right-hand matrix [RESIDUAL, RESIDUAL]: `z M`.
///
/// # Errors
/// When the tensor cannot be made.
pub fn matrix(device: &Device) -> Result<Tensor> {
    let lower = smooth::factor();
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
