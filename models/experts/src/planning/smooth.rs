//! Correlation between the knots of a future. Network outputs, noise and gradient steps all pass through it,
//! so that neighbouring knots move together.

use scene::KNOTS;
use scene::motion::knot_covariance_factor;

/// Length scale of the squared-exponential correlation, seconds.
const LENGTH_S: f64 = 1.5;

/// Lower Cholesky factor of the knots' correlation, `[KNOTS][KNOTS]`; its rows have length 1.
pub fn factor() -> [[f64; KNOTS]; KNOTS] {
    let lower = knot_covariance_factor(LENGTH_S);
    // The first row holds only the standard deviation.
    let deviation = lower[(0, 0)];
    std::array::from_fn(|i| std::array::from_fn(|j| lower[(i, j)] / deviation))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_length_1_and_neighbours_go_together() {
        let factor = factor();
        for (i, row) in factor.iter().enumerate() {
            assert!((row.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 1e-9);
            assert!(row[i + 1..].iter().all(|v| *v == 0.0));
        }
        let correlation = |i: usize, j: usize| (0..KNOTS).map(|k| factor[i][k] * factor[j][k]).sum::<f64>();
        assert!((correlation(3, 4) - (-0.5f64 / (LENGTH_S * LENGTH_S)).exp()).abs() < 1e-3);
    }
}
