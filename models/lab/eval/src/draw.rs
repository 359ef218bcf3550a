//! Random draws of an evaluation: one stream for each purpose, the same on every machine.

use rand_chacha::ChaCha12Rng;
use rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

/// A stream of random numbers.
pub(super) struct Draw(ChaCha12Rng);

impl Draw {
    /// The stream of a seed for a purpose named by words.
    pub(super) fn new(seed: u64, purpose: &[&str]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&seed.to_le_bytes());
        for word in purpose {
            hasher.update(&(word.len() as u64).to_le_bytes());
            hasher.update(word.as_bytes());
        }
        Self(ChaCha12Rng::from_seed(*hasher.finalize().as_bytes()))
    }

    /// Even over 0 .. 1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even over 0 .. `count` (0 for none).
    pub(super) fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Standard normal.
    pub(super) fn normal(&mut self) -> f64 {
        // Box and Muller.
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (TAU * self.unit()).cos()
    }

    /// In place.
    pub(super) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            let j = self.below(i + 1);
            list.swap(i, j);
        }
    }
}
