//! How experts are made: records from recorded scenes, training, the learned rivals that training makes by the
//! same means, and the weights of placement.

pub mod baselines;
pub mod placement;
pub mod polylines;
pub mod prepare;
pub mod provenance;
#[cfg(any(test, feature = "samples"))]
pub mod samples;
pub mod scenes;
pub mod training;

/// Linear between the two nearest of sorted values; zero of none.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (below, f) = (at.floor() as usize, at.fract());
    let above = (below + 1).min(last);
    sorted[below] + f * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn quantiles_lie_between_the_nearest_values() {
        assert_eq!(quantile(&[0.0, 10.0], 0.25), 2.5);
        assert_eq!((quantile(&[], 0.5), quantile(&[3.0], 0.9)), (0.0, 3.0));
    }
}
