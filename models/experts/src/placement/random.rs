//! Draws in proportion to changing weights.

use scene::AgentType;
use scene::random::{Key, Stream};

/// The random stream of a seed, for a purpose of placement and an index within it.
pub(super) fn stream(seed: u64, purpose: &str, number: usize) -> Stream {
    Key::default().text("place").number(seed).number(number as u64).text(purpose).stream()
}

/// Name of a type in the keys of its random streams.
pub(super) fn stream_name(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

/// Weights of many items, drawn from and changed in logarithmic time (a binary tree of sums).
pub(super) struct WeightTree {
    /// `sums[1]` is the total; the children of `i` are `2 i` and `2 i + 1`.
    sums: Vec<f64>,
    leaves: usize,
}

impl WeightTree {
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

    /// An item in proportion to its weight; `None` if all weights are zero.
    pub(super) fn draw(&self, stream: &mut Stream) -> Option<usize> {
        let total = self.sums[1];
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let mut left = stream.unit() * total;
        let mut i = 1;
        while i < self.leaves {
            let first = self.sums[2 * i];
            // Rounding may leave slightly more than the right half holds; never descend into an empty half.
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
        let mut weights = WeightTree::new(&[1.0, 0.0, 3.0, 4.0, 2.0]);
        weights.set(3, 0.0);
        let mut stream = stream(5, "test", 0);
        let mut counts = [0; 5];
        for _ in 0..6_000 {
            counts[weights.draw(&mut stream).unwrap()] += 1;
        }
        assert_eq!((counts[1], counts[3]), (0, 0));
        for (at, expected) in [(0, 1_000.0), (2, 3_000.0), (4, 2_000.0)] {
            assert!((f64::from(counts[at]) - expected).abs() < 150.0, "{counts:?}");
        }
        for at in [0, 2, 4] {
            weights.set(at, 0.0);
        }
        assert_eq!(weights.draw(&mut stream), None);
        assert_eq!(WeightTree::new(&[]).draw(&mut stream), None);
    }
}
