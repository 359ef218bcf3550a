//! Figures with intervals: means and shares with 95 % bootstrap intervals. Whole scenes are resampled,
//! because road users of one scene share its map, its signals and each other.

use lab_train::quantile;
use scene::random::Key;
use serde::Serialize;

/// Resamples drawn.
const REPLICATES: usize = 1000;

/// One measured value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Index of its scene, below the count of the [`Bootstrap`].
    pub scene: usize,
    /// Numerator: the value itself, or a count.
    pub value: f64,
    /// Denominator: 1, or the total of which the count is a share.
    pub weight: f64,
}

impl Value {
    /// A plain value.
    pub fn new(scene: usize, value: f64) -> Self {
        Self { scene, value, weight: 1.0 }
    }

    /// `value` out of `weight`.
    pub fn share(scene: usize, value: f64, weight: f64) -> Self {
        Self { scene, value, weight }
    }

    /// One or zero.
    pub fn flag(scene: usize, holds: bool) -> Self {
        Self::new(scene, f64::from(u8::from(holds)))
    }
}

/// A mean (or share) with its 95 % interval, in the unit of its values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Estimate {
    pub mean: f64,
    pub low: f64,
    pub high: f64,
    /// Number of measurements: the sum of the weights.
    pub samples: u64,
    /// Number of scenes with measurements.
    pub scenes: u64,
}

/// Resamples of a list of scenes, the same for every figure, so that paired figures stay paired.
pub struct Bootstrap {
    /// Count of each scene, one list per replicate.
    counts: Vec<Vec<u16>>,
}

impl Bootstrap {
    /// Resamples of this many scenes.
    pub fn new(scenes: usize, seed: u64) -> Self {
        let mut draw = Key::default().number(seed).words(&["bootstrap"]).stream();
        let replicate = |_| {
            let mut counts = vec![0; scenes];
            for _ in 0..scenes {
                if let Some(count) = counts.get_mut(draw.below(scenes)) {
                    *count += 1;
                }
            }
            counts
        };
        Self { counts: (0..REPLICATES).map(replicate).collect() }
    }

    /// Mean of values, or the share if values are counts; `None` without values.
    pub fn estimate(&self, values: impl IntoIterator<Item = Value>) -> Option<Estimate> {
        let scenes = self.counts.first().map_or(0, Vec::len);
        let mut sums = vec![(0.0, 0.0); scenes];
        for v in values {
            if let Some(sum) = sums.get_mut(v.scene) {
                *sum = (sum.0 + v.value, sum.1 + v.weight);
            }
        }
        let total = sums.iter().fold((0.0, 0.0), |t, s| (t.0 + s.0, t.1 + s.1));
        if total.1 <= 0.0 {
            return None;
        }
        let mut means: Vec<f64> = self.counts.iter().filter_map(|counts| resampled(counts, &sums)).collect();
        means.sort_by(f64::total_cmp);
        Some(Estimate {
            mean: total.0 / total.1,
            low: quantile(&means, 0.025),
            high: quantile(&means, 0.975),
            samples: total.1.round() as u64,
            scenes: sums.iter().filter(|s| s.1 > 0.0).count() as u64,
        })
    }
}

/// Mean of one replicate; `None` if none of its scenes has a value.
fn resampled(counts: &[u16], sums: &[(f64, f64)]) -> Option<f64> {
    let (value, weight) = counts.iter().zip(sums).fold((0.0, 0.0), |(value, weight), (count, sum)| {
        (value + f64::from(*count) * sum.0, weight + f64::from(*count) * sum.1)
    });
    (weight > 0.0).then(|| value / weight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_have_no_spread() {
        let found = Bootstrap::new(5, 1).estimate((0..5).map(|s| Value::new(s, 2.5))).unwrap();
        assert_eq!((found.mean, found.low, found.high), (2.5, 2.5, 2.5));
        assert_eq!((found.samples, found.scenes), (5, 5));
    }

    #[test]
    fn nothing_has_no_estimate() {
        assert_eq!(Bootstrap::new(3, 1).estimate([]), None);
        assert_eq!(Bootstrap::new(0, 1).estimate([Value::new(0, 1.0)]), None);
    }

    #[test]
    fn interval_of_a_mean_is_that_of_the_normal_approximation() {
        // 400 scenes, half 0 and half 1: the standard error is 0.5 / 20, the interval 0.5 +- 0.049.
        let found = Bootstrap::new(400, 3).estimate((0..400).map(|s| Value::flag(s, s % 2 == 0))).unwrap();
        assert_eq!(found.mean, 0.5);
        assert!((found.low - 0.451).abs() < 0.006, "{}", found.low);
        assert!((found.high - 0.549).abs() < 0.006, "{}", found.high);
    }

    #[test]
    fn scenes_not_values_are_resampled() {
        // A thousand equal values per scene carry no more information than one.
        let few = Bootstrap::new(20, 1).estimate((0..20).map(|s| Value::new(s, s as f64))).unwrap();
        let many: Vec<Value> = (0..20_000).map(|i| Value::new(i % 20, (i % 20) as f64)).collect();
        let many = Bootstrap::new(20, 1).estimate(many).unwrap();
        assert!((few.low - many.low).abs() < 1e-9 && (few.high - many.high).abs() < 1e-9);
        assert_eq!(many.samples, 20_000);
    }

    #[test]
    fn paired_differences_are_tighter_than_their_parts() {
        let boot = Bootstrap::new(50, 9);
        let base = |s: usize| (s * 37 % 50) as f64;
        let parts = boot.estimate((0..50).map(|s| Value::new(s, base(s)))).unwrap();
        let paired = boot.estimate((0..50).map(|s| Value::new(s, base(s) + 1.0 - base(s)))).unwrap();
        assert!(parts.high - parts.low > 5.0);
        assert!((paired.low - 1.0).abs() < 1e-9 && (paired.high - 1.0).abs() < 1e-9);
    }

    #[test]
    fn shares_weigh_scenes_by_what_they_hold() {
        let found = Bootstrap::new(2, 1).estimate([Value::share(0, 1.0, 1.0), Value::share(1, 0.0, 3.0)]);
        assert_eq!(found.map(|e| e.mean), Some(0.25));
    }

    #[test]
    fn repeats_for_a_seed() {
        let of = |seed| Bootstrap::new(30, seed).estimate((0..30).map(|s| Value::new(s, s as f64)));
        assert_eq!(of(4), of(4));
        assert_ne!(of(4), of(5));
    }
}
