//! Random streams of drafts, keyed by their purpose.

use crate::planning::{MODES, RESIDUAL};
use scene::random;

/// Purpose of a random stream.
#[derive(Clone, Copy, Debug)]
pub(super) struct NoiseKey<'a> {
    pub(super) seed: u64,
    pub(super) sample: usize,
    pub(super) agent: &'a str,
    pub(super) window: usize,
    /// Denoising step, or another purpose.
    pub(super) step: u64,
}

impl NoiseKey<'_> {
    fn stream(&self) -> random::Stream {
        let numbers = [self.seed, self.sample as u64, self.window as u64, self.step];
        let key = numbers.into_iter().fold(random::Key::default(), random::Key::number);
        key.text(self.agent).stream()
    }

    /// One uniform number in 0 .. 1.
    pub(super) fn unit(&self) -> f64 {
        self.stream().unit()
    }

    /// Standard normal numbers for the six modes, times `scale`.
    pub(super) fn normals(&self, scale: f64) -> [[f32; RESIDUAL]; MODES] {
        let mut stream = self.stream();
        let mut out = [[0.0; RESIDUAL]; MODES];
        for pair in out.as_flattened_mut().chunks_mut(2) {
            for (value, normal) in pair.iter_mut().zip(stream.normal_pair()) {
                *value = (scale * normal) as f32;
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_their_own_and_repeat() {
        let key = NoiseKey { seed: 7, sample: 0, agent: "12", window: 0, step: 3 };
        assert_eq!(key.normals(1.0), key.normals(1.0));
        assert_ne!(key.normals(1.0), NoiseKey { agent: "13", ..key }.normals(1.0));
        assert_ne!(key.normals(1.0), NoiseKey { step: 4, ..key }.normals(1.0));
        let all: Vec<f32> =
            (0..400).flat_map(|step| NoiseKey { step, ..key }.normals(1.0).as_flattened().to_vec()).collect();
        let mean = all.iter().sum::<f32>() / all.len() as f32;
        let power = all.iter().map(|x| x * x).sum::<f32>() / all.len() as f32;
        assert!(mean.abs() < 0.02 && (power - 1.0).abs() < 0.03, "{mean} {power}");
    }
}
