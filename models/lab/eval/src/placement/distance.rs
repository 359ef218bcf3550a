//! Distances between two samples, and their intervals.

use experts::placement::learn::SPEED_CLASSES;

/// Wasserstein-1 distance of two samples: mean distance between equal quantiles. Infinite when one of them
/// is empty and the other is not.
pub fn wasserstein(a: &[f64], b: &[f64]) -> f64 {
    if a.is_empty() || b.is_empty() {
        return if a.len() == b.len() { 0.0 } else { f64::INFINITY };
    }
    let sorted = |values: &[f64]| {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values
    };
    let (a, b) = (sorted(a), sorted(b));
    let (mut i, mut j, mut at, mut sum) = (0, 0, 0.0, 0.0);
    // Quantile functions are steps: walk over the joint steps.
    while i < a.len() && j < b.len() {
        let (end_a, end_b) = ((i + 1) as f64 / a.len() as f64, (j + 1) as f64 / b.len() as f64);
        let end = end_a.min(end_b);
        sum += (end - at) * (a[i] - b[j]).abs();
        at = end;
        if end_a <= end {
            i += 1;
        }
        if end_b <= end {
            j += 1;
        }
    }
    sum
}

/// Jensen-Shannon divergence of two samples over even classes from `low` to `high`, bits: 0 the same, 1 apart.
pub fn jensen_shannon(a: &[f64], b: &[f64], low: f64, high: f64) -> f64 {
    let shares = |values: &[f64]| {
        let mut shares = [0.0; SPEED_CLASSES];
        for value in values {
            let class = (value - low) / (high - low) * SPEED_CLASSES as f64;
            shares[(class.max(0.0) as usize).min(SPEED_CLASSES - 1)] += 1.0 / values.len() as f64;
        }
        shares
    };
    if a.is_empty() || b.is_empty() {
        return f64::from(u8::from(a.len() != b.len()));
    }
    let towards = |p: f64, q: f64| if p > 0.0 { p * (2.0 * p / (p + q)).log2() } else { 0.0 };
    shares(a).iter().zip(shares(b)).map(|(p, q)| 0.5 * (towards(*p, q) + towards(q, *p))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_distances() {
        assert_eq!(wasserstein(&[1.0, 2.0, 3.0], &[3.0, 1.0, 2.0]), 0.0);
        assert!((wasserstein(&[0.0, 1.0], &[2.0, 3.0]) - 2.0).abs() < 1e-12);
        assert!((wasserstein(&[0.0], &[0.0, 1.0]) - 0.5).abs() < 1e-12);
        assert!((wasserstein(&[0.0, 0.0, 3.0], &[0.0, 3.0]) - 0.5).abs() < 1e-12);
        assert_eq!(wasserstein(&[], &[1.0]), f64::INFINITY);
        assert_eq!(jensen_shannon(&[1.0, 2.0], &[2.0, 1.0], 0.0, 24.0), 0.0);
        assert!((jensen_shannon(&[1.0], &[20.0], 0.0, 24.0) - 1.0).abs() < 1e-12);
        let half = jensen_shannon(&[1.0, 1.0], &[1.0, 20.0], 0.0, 24.0);
        assert!(half > 0.2 && half < 0.5, "{half}");
    }
}
