//! Random draws: one counter-based generator for each purpose of a seed, and the few distributions
//! that traffic needs.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use scene::Vec2;
use std::f64::consts::TAU;

/// What a stream of draws decides. Streams of one seed are independent, so that a change in one part
/// leaves the draws of the others as they were.
#[derive(Clone, Copy, Debug)]
pub enum Purpose {
    /// Roads and junctions.
    Network = 1,
    /// Who drives where and when.
    Demand = 2,
    /// Parked cars.
    Parking = 3,
    /// Wander and ripple of tracks.
    Motion = 4,
    /// Choice of windows.
    Windows = 5,
    /// Manoeuvres that SUMO does not know.
    Scripted = 6,
    /// What the map leaves out.
    Map = 7,
}

/// A stream of random draws.
#[derive(Clone, Debug)]
pub struct Draw(ChaCha8Rng);

impl Draw {
    /// The stream of a seed for one purpose.
    pub fn new(seed: u64, purpose: Purpose) -> Self {
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        generator.set_stream(purpose as u64);
        Self(generator)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// Uniform in 0 .. n; zero when n is.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n.saturating_sub(1))
    }

    /// One of a fixed set of values.
    pub fn one_of<T: Copy, const N: usize>(&mut self, values: [T; N]) -> T {
        values[self.below(N)]
    }

    /// An index, drawn by weight.
    pub fn weighted(&mut self, weights: &[f64]) -> usize {
        let mut left = self.unit() * weights.iter().sum::<f64>();
        for (i, w) in weights.iter().enumerate() {
            left -= w;
            if left < 0.0 {
                return i;
            }
        }
        weights.len().saturating_sub(1)
    }

    /// Standard normal (Box and Muller).
    pub fn gauss(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (TAU * self.unit()).cos()
    }

    /// Normal with this mean and deviation.
    pub fn normal(&mut self, mean: f64, deviation: f64) -> f64 {
        mean + deviation * self.gauss()
    }

    /// Normal, clamped.
    pub fn clipped(&mut self, mean: f64, deviation: f64, low: f64, high: f64) -> f64 {
        self.normal(mean, deviation).clamp(low, high)
    }

    /// Exponential with this mean.
    pub fn exponential(&mut self, mean: f64) -> f64 {
        -mean * (1.0 - self.unit()).ln()
    }

    /// Poisson with this mean (by waiting times; the means here are small).
    pub fn poisson(&mut self, mean: f64) -> usize {
        let mut time = self.exponential(1.0);
        let mut count = 0;
        while time < mean {
            count += 1;
            time += self.exponential(1.0);
        }
        count
    }

    /// Beta with these shape parameters, both above 1 (by rejection under the density's peak).
    pub fn beta(&mut self, a: f64, b: f64) -> f64 {
        let density = |x: f64| x.powf(a - 1.0) * (1.0 - x).powf(b - 1.0);
        let peak = density((a - 1.0) / (a + b - 2.0));
        loop {
            let x = self.unit();
            if self.unit() * peak <= density(x) {
                return x;
            }
        }
    }

    /// Two independent normals with zero mean.
    pub fn gauss_point(&mut self, deviation: f64) -> Vec2 {
        Vec2::new(self.normal(0.0, deviation), self.normal(0.0, deviation))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_repeat_and_differ() {
        let draw = |seed, purpose| Draw::new(seed, purpose).unit();
        assert_eq!(draw(7, Purpose::Network), draw(7, Purpose::Network));
        assert_ne!(draw(7, Purpose::Network), draw(7, Purpose::Demand));
        assert_ne!(draw(7, Purpose::Network), draw(8, Purpose::Network));
    }

    #[test]
    fn moments() {
        let mut draw = Draw::new(1, Purpose::Motion);
        let n = 20_000;
        let mut mean =
            |f: &mut dyn FnMut(&mut Draw) -> f64| (0..n).map(|_| f(&mut draw)).sum::<f64>() / n as f64;
        assert!((mean(&mut |d| d.normal(2.0, 3.0)) - 2.0).abs() < 0.1);
        assert!((mean(&mut |d| (d.gauss()).powi(2)) - 1.0).abs() < 0.05);
        assert!((mean(&mut |d| d.exponential(4.0)) - 4.0).abs() < 0.15);
        assert!((mean(&mut |d| d.poisson(5.0) as f64) - 5.0).abs() < 0.1);
        assert!((mean(&mut |d| d.beta(2.0, 2.3)) - 2.0 / 4.3).abs() < 0.01);
        assert!((mean(&mut |d| d.weighted(&[1.0, 0.0, 3.0]) as f64) - 1.5).abs() < 0.05);
    }
}
