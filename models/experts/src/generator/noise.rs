//! Random numbers that depend on nothing but what they are for, so that neither the order of road
//! users, nor the batch, nor the number of threads changes a byte.

use crate::features::{MODES, RESIDUAL};
use rand_chacha::ChaCha12Rng;
use rand_core::{Rng, SeedableRng};

/// What a stream of numbers is for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key<'a> {
    pub(super) seed: u64,
    pub(super) sample: usize,
    pub(super) agent: &'a str,
    pub(super) window: usize,
    /// Denoising step, or another purpose.
    pub(super) step: usize,
}

impl Key<'_> {
    fn stream(&self) -> ChaCha12Rng {
        let mut hasher = blake3::Hasher::new();
        for number in [self.seed, self.sample as u64, self.window as u64, self.step as u64] {
            hasher.update(&number.to_le_bytes());
        }
        hasher.update(self.agent.as_bytes());
        ChaCha12Rng::from_seed(*hasher.finalize().as_bytes())
    }

    /// One number, even over 0 .. 1.
    pub(super) fn unit(&self) -> f64 {
        unit(&mut self.stream())
    }

    /// Standard normal numbers for the six modes, times `scale`.
    pub(super) fn normals(&self, scale: f64) -> [[f32; RESIDUAL]; MODES] {
        let mut stream = self.stream();
        let mut out = [[0.0; RESIDUAL]; MODES];
        for pair in out.as_flattened_mut().chunks_mut(2) {
            // Box and Muller.
            let radius = (-2.0 * (1.0 - unit(&mut stream)).ln()).sqrt();
            let (sin, cos) = (std::f64::consts::TAU * unit(&mut stream)).sin_cos();
            for (value, part) in pair.iter_mut().zip([cos, sin]) {
                *value = (scale * radius * part) as f32;
            }
        }
        out
    }
}

fn unit(stream: &mut ChaCha12Rng) -> f64 {
    (stream.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_their_own_and_repeat() {
        let key = Key { seed: 7, sample: 0, agent: "12", window: 0, step: 3 };
        assert_eq!(key.normals(1.0), key.normals(1.0));
        assert_ne!(key.normals(1.0), Key { agent: "13", ..key }.normals(1.0));
        assert_ne!(key.normals(1.0), Key { step: 4, ..key }.normals(1.0));
        let all: Vec<f32> =
            (0..400).flat_map(|step| Key { step, ..key }.normals(1.0).as_flattened().to_vec()).collect();
        let mean = all.iter().sum::<f32>() / all.len() as f32;
        let power = all.iter().map(|x| x * x).sum::<f32>() / all.len() as f32;
        assert!(mean.abs() < 0.02 && (power - 1.0).abs() < 0.03, "{mean} {power}");
    }
}
