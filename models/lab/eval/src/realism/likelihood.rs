//! Likelihood of logged features under histograms of simulated ones.

use super::features::{FEATURES, Feature, Motion};

/// Count added to every bin, so that no value is impossible.
const PSEUDOCOUNT: f64 = 0.1;
/// Count added for yes-or-no features.
const PSEUDOCOUNT_FLAG: f64 = 0.001;

/// The likelihoods of one scene, 0 to 1; `None` if nothing was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Likelihoods {
    pub(super) by_feature: [Option<f64>; FEATURES.len()],
}

impl Likelihoods {
    /// Weighted mean over the features that were measured.
    pub(super) fn composite(&self) -> Option<f64> {
        let known = FEATURES.iter().zip(self.by_feature).filter_map(|(f, l)| Some((f.weight, l?)));
        let (sum, weight) = known.fold((0.0, 0.0), |(sum, weight), (w, l)| (sum + w * l, weight + w));
        (weight > 0.0).then(|| sum / weight)
    }
}

/// Likelihoods of logged road users under rollouts of the same road users: geometric mean over road users and
/// steps. Each road user has its own histogram over all rollouts and steps.
pub(super) fn likelihoods(log: &[Motion], rollouts: &[Vec<Motion>]) -> Likelihoods {
    let mut out = Likelihoods::default();
    for (i, feature) in FEATURES.iter().enumerate() {
        let (mut sum, mut n) = (0.0, 0.0);
        for (agent, logged) in log.iter().enumerate() {
            let simulated = || rollouts.iter().flat_map(move |r| r[agent].values[i].iter().copied());
            if logged.values[i].is_empty() || simulated().next().is_none() {
                continue;
            }
            let histogram = ReferenceHistogram::new(feature, simulated());
            sum += logged.values[i].iter().map(|v| histogram.probability(*v).ln()).sum::<f64>();
            n += logged.values[i].len() as f64;
        }
        if n > 0.0 {
            out.by_feature[i] = Some((sum / n).exp());
        }
    }
    out
}

struct ReferenceHistogram {
    low: f64,
    high: f64,
    shares: Vec<f64>,
}

impl ReferenceHistogram {
    fn new(feature: &Feature, values: impl Iterator<Item = f64>) -> Self {
        let (low, high, bins) = feature.bins.unwrap_or((-0.5, 1.5, 2));
        let pseudocount = if feature.bins.is_some() { PSEUDOCOUNT } else { PSEUDOCOUNT_FLAG };
        let mut out = Self { low, high, shares: vec![pseudocount; bins] };
        for value in values {
            let bin = out.bin(value);
            out.shares[bin] += 1.0;
        }
        let total: f64 = out.shares.iter().sum();
        out.shares.iter_mut().for_each(|s| *s /= total);
        out
    }

    fn bin(&self, value: f64) -> usize {
        let at = (value - self.low) / (self.high - self.low) * self.shares.len() as f64;
        (at.max(0.0) as usize).min(self.shares.len() - 1)
    }

    fn probability(&self, value: f64) -> f64 {
        self.shares[self.bin(value)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(speeds: &[f64], collides: f64) -> Motion {
        let mut motion = Motion::default();
        motion.values[0] = speeds.to_vec();
        motion.values[5] = vec![collides];
        motion
    }

    #[test]
    fn known_likelihoods() {
        // Bins of 2.5 m/s. Of four simulated values, one is in the log's bin: (1 + 0.1) / (4 + 1).
        let log = [moving(&[1.0, 1.0], 0.0)];
        let rollouts = [vec![moving(&[1.0, 6.0], 0.0)], vec![moving(&[6.0, 6.0], 1.0)]];
        let found = likelihoods(&log, &rollouts);
        assert!((found.by_feature[0].unwrap() - 0.22).abs() < 1e-9);
        assert!((found.by_feature[5].unwrap() - 1.001 / 2.002).abs() < 1e-9);
        assert_eq!(found.by_feature[8], None);
        let expected = (0.05 * 0.22 + 0.25 * 0.5) / 0.3;
        assert!((found.composite().unwrap() - expected).abs() < 1e-9);
    }

    #[test]
    fn values_beyond_the_bounds_fall_into_the_last_bins() {
        let found = likelihoods(&[moving(&[99.0], 0.0)], &[vec![moving(&[30.0], 0.0)]]);
        assert!((found.by_feature[0].unwrap() - 1.1 / 2.0).abs() < 1e-9);
    }
}
