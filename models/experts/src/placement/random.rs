//! Random numbers by purpose, and draws in proportion to weights that change.

use rand_chacha::ChaCha12Rng;
use rand_core::{Rng, SeedableRng};

/// A stream of numbers that depends on the seed and on what it is for.
pub(super) struct Dice(ChaCha12Rng);

impl Dice {
    pub(super) fn new(seed: u64, purpose: &str, number: usize) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(b"place");
        hasher.update(&seed.to_le_bytes());
        hasher.update(&(number as u64).to_le_bytes());
        hasher.update(purpose.as_bytes());
        Self(ChaCha12Rng::from_seed(*hasher.finalize().as_bytes()))
    }

    /// Even over 0 .. 1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even over `low` .. `high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Index in proportion to the weights; `None` when none is positive.
    pub(super) fn among(&mut self, weights: impl Iterator<Item = f64> + Clone) -> Option<usize> {
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
}

/// Weights of many places, drawn from and changed in logarithmic time (a binary tree of sums).
pub(super) struct Weights {
    /// `sums[1]` is the whole; the children of `i` are `2 i` and `2 i + 1`.
    sums: Vec<f64>,
    leaves: usize,
}

impl Weights {
    pub(super) fn new(weights: &[f64]) -> Self {
        let leaves = weights.len().next_power_of_two().max(1);
        let mut sums = vec![0.0; 2 * leaves];
        sums[leaves..leaves + weights.len()].copy_from_slice(weights);
        for i in (1..leaves).rev() {
            sums[i] = sums[2 * i] + sums[2 * i + 1];
        }
        Self { sums, leaves }
    }

    pub(super) fn get(&self, at: usize) -> f64 {
        self.sums[self.leaves + at]
    }

    pub(super) fn set(&mut self, at: usize, weight: f64) {
        let mut i = self.leaves + at;
        self.sums[i] = weight;
        while i > 1 {
            i /= 2;
            self.sums[i] = self.sums[2 * i] + self.sums[2 * i + 1];
        }
    }

    /// A place in proportion to its weight; `None` when all are zero.
    pub(super) fn draw(&self, dice: &mut Dice) -> Option<usize> {
        let total = self.sums[1];
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let mut left = dice.unit() * total;
        let mut i = 1;
        while i < self.leaves {
            let first = self.sums[2 * i];
            // Rounding may leave a little more than the right half holds; never step onto nothing.
            let go_left = left < first || self.sums[2 * i + 1] <= 0.0;
            i = if go_left { 2 * i } else { 2 * i + 1 };
            if !go_left {
                left -= first;
            }
        }
        Some(i - self.leaves).filter(|at| self.get(*at) > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_follow_the_weights() {
        let mut weights = Weights::new(&[1.0, 0.0, 3.0, 4.0, 2.0]);
        weights.set(3, 0.0);
        let mut dice = Dice::new(5, "test", 0);
        let mut counts = [0; 5];
        for _ in 0..6_000 {
            counts[weights.draw(&mut dice).unwrap()] += 1;
        }
        assert_eq!((counts[1], counts[3]), (0, 0));
        for (at, expected) in [(0, 1_000.0), (2, 3_000.0), (4, 2_000.0)] {
            assert!((f64::from(counts[at]) - expected).abs() < 150.0, "{counts:?}");
        }
        for at in [0, 2, 4] {
            weights.set(at, 0.0);
        }
        assert_eq!(weights.draw(&mut dice), None);
        assert_eq!(Weights::new(&[]).draw(&mut dice), None);
    }

    #[test]
    fn streams_are_their_own_and_repeat() {
        let first = |seed, purpose, number| Dice::new(seed, purpose, number).unit();
        assert_eq!(first(1, "a", 0), first(1, "a", 0));
        let others = [first(2, "a", 0), first(1, "b", 0), first(1, "a", 1)];
        assert!(others.iter().all(|o| *o != first(1, "a", 0)));
        assert_eq!(Dice::new(1, "a", 0).among([0.0, 0.0].into_iter()), None);
        assert_eq!(Dice::new(1, "a", 0).among([0.0, 2.0].into_iter()), Some(1));
    }
}
