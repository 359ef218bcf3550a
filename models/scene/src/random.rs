//! Random numbers that depend only on their purpose. Neither the order of road users, nor the batch, nor the
//! number of threads changes a byte. All random numbers come from here.
//!
//! ```
//! use scene::random::Key;
//! let stream = || Key::default().number(7).text("car 12").stream();
//! assert_eq!(stream().unit(), stream().unit());
//! assert_ne!(stream().unit(), Key::default().number(8).text("car 12").stream().unit());
//! ```

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use rand_distr::{Beta, Distribution, Exp1, Poisson};
use std::f64::consts::TAU;

/// The purpose of a stream: numbers and words, hashed by BLAKE3 in the given order.
///
/// Words are hashed without a separator. Put a number between two of them, or two keys may coincide.
#[derive(Clone, Debug, Default)]
pub struct Key(blake3::Hasher);

impl Key {
    /// Adds a number: a seed, a sample, a step.
    #[must_use]
    pub fn number(mut self, number: u64) -> Self {
        self.0.update(&number.to_le_bytes());
        self
    }

    /// Adds a word: a purpose, a road user's id.
    #[must_use]
    pub fn text(mut self, text: &str) -> Self {
        self.0.update(text.as_bytes());
        self
    }

    /// Adds words, each after its length, so that no two lists coincide.
    #[must_use]
    pub fn words(self, words: &[&str]) -> Self {
        words.iter().fold(self, |key, word| key.number(word.len() as u64).text(word))
    }

    /// The stream of this key, from its beginning.
    pub fn stream(&self) -> Stream {
        Stream(ChaCha12Rng::from_seed(*self.0.finalize().as_bytes()))
    }
}

/// A stream of random numbers: ChaCha12.
#[derive(Clone, Debug)]
pub struct Stream(ChaCha12Rng);

impl Stream {
    /// Uniform in 0 .. 1, in steps of 2^-53.
    pub fn unit(&mut self) -> f64 {
        self.0.random()
    }

    /// Uniform in `low` .. `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// Uniform in 0 .. `count`; zero if `count` is zero.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Index in proportion to the positive weights; `None` if no weight is positive.
    pub fn among(&mut self, weights: impl Iterator<Item = f64> + Clone) -> Option<usize> {
        let total: f64 = weights.clone().sum();
        let mut left = self.unit() * total;
        let mut last = None;
        for (i, weight) in weights.enumerate().filter(|(_, w)| *w > 0.0) {
            last = Some(i);
            left -= weight;
            if left < 0.0 {
                break;
            }
        }
        last.filter(|_| total > 0.0 && total.is_finite())
    }

    /// One of some values, with equal probability.
    pub fn one_of<T: Copy, const N: usize>(&mut self, values: [T; N]) -> T {
        values[self.below(N)]
    }

    /// One of some values in proportion to its weight; the first if no weight is positive.
    pub fn weighted<T: Copy, const N: usize>(&mut self, values: [(T, f64); N]) -> T {
        let index = self.among(values.iter().map(|(_, weight)| *weight));
        values[index.unwrap_or(0)].0
    }

    /// Two standard normal numbers by the Box-Muller formula. It gives the same bits on every machine, and
    /// earlier answers depend on them.
    pub fn normal_pair(&mut self) -> [f64; 2] {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        let (sin, cos) = (TAU * self.unit()).sin_cos();
        [radius * cos, radius * sin]
    }

    /// A standard normal number.
    pub fn normal(&mut self) -> f64 {
        self.normal_pair()[0]
    }

    /// A normal number with this mean and standard deviation.
    pub fn normal_about(&mut self, mean: f64, deviation: f64) -> f64 {
        mean + deviation * self.normal()
    }

    /// The same, clamped to `low` .. `high`.
    pub fn clipped(&mut self, mean: f64, deviation: f64, low: f64, high: f64) -> f64 {
        self.normal_about(mean, deviation).clamp(low, high)
    }

    /// Exponential with this mean.
    pub fn exponential(&mut self, mean: f64) -> f64 {
        mean * self.draw::<f64>(&Exp1)
    }

    /// Poisson number with this mean; zero if the mean is not positive.
    pub fn poisson(&mut self, mean: f64) -> usize {
        Poisson::new(mean).map_or(0, |often| self.draw::<f64>(&often) as usize)
    }

    /// Beta distributed share with these two shapes, which must be positive; 0.5 otherwise.
    pub fn beta(&mut self, a: f64, b: f64) -> f64 {
        Beta::new(a, b).map_or(0.5, |share| self.draw(&share))
    }

    /// A value of any other distribution.
    pub fn draw<T>(&mut self, distribution: &impl Distribution<T>) -> T {
        distribution.sample(&mut self.0)
    }

    /// Puts a list into a random order.
    pub fn shuffle<T>(&mut self, list: &mut [T]) {
        list.shuffle(&mut self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_their_own_and_repeat() {
        let first = |seed, word| Key::default().number(seed).text(word).stream().unit();
        assert_eq!(first(1, "a"), first(1, "a"));
        assert!(first(1, "a") != first(2, "a") && first(1, "a") != first(1, "b"));
    }

    #[test]
    fn moments_are_right() {
        let mut stream = Key::default().number(1).stream();
        let mean = |of: &mut dyn FnMut() -> f64| (0..20_000).map(|_| of()).sum::<f64>() / 20_000.0;
        assert!((mean(&mut || stream.between(2.0, 4.0)) - 3.0).abs() < 0.02);
        assert!(mean(&mut || stream.normal()).abs() < 0.03);
        assert!((mean(&mut || stream.normal().powi(2)) - 1.0).abs() < 0.05);
        assert!((mean(&mut || f64::from(u8::from(stream.chance(0.2)))) - 0.2).abs() < 0.02);
        assert!((mean(&mut || stream.below(5) as f64) - 2.0).abs() < 0.05);
        assert!((mean(&mut || stream.normal_about(2.0, 3.0)) - 2.0).abs() < 0.1);
        assert!((mean(&mut || stream.exponential(4.0)) - 4.0).abs() < 0.15);
        assert!((mean(&mut || stream.poisson(5.0) as f64) - 5.0).abs() < 0.1);
        assert!((mean(&mut || stream.beta(2.0, 2.3)) - 2.0 / 4.3).abs() < 0.01);
        assert!((mean(&mut || stream.weighted([(0.0, 1.0), (7.0, 0.0), (2.0, 3.0)])) - 1.5).abs() < 0.05);
        assert_eq!(
            (stream.poisson(0.0), stream.one_of([4]), stream.clipped(9.0, 1.0, 0.0, 1.0)),
            (0, 4, 1.0)
        );
    }

    #[test]
    fn draws_follow_the_weights() {
        let mut stream = Key::default().stream();
        let mut counts = [0.0; 4];
        for _ in 0..4_000 {
            counts[stream.among([1.0, 0.0, 3.0, -2.0].map(|w: f64| w.max(0.0)).into_iter()).unwrap()] += 1.0;
        }
        assert_eq!((counts[1], counts[3]), (0.0, 0.0));
        assert!((counts[0] - 1_000.0f64).abs() < 120.0, "{counts:?}");
        assert_eq!(stream.among([0.0, 0.0].into_iter()), None);
        assert_eq!(stream.among([0.0, 2.0].into_iter()), Some(1));
        let mut list: Vec<usize> = (0..50).collect();
        stream.shuffle(&mut list);
        assert!(list != (0..50).collect::<Vec<_>>());
        list.sort_unstable();
        assert!(list == (0..50).collect::<Vec<_>>());
    }
}
